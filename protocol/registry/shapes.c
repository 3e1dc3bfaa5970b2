/* SPDX-License-Identifier: MIT */
/* Registry: primitives in three dimensions. */
#include "rows.h"

/* From the +Y axis to either side. */
#define HALF_ANGLE UNIT_ANGLE, .min = 0, .max = 3.141592653589793, .step = 0.05, .main = true

/* Of capsule.radius, plane.offset and death_star.radius2. */
#define AXIS "sqrt((b.x - a.x)^2 + (b.y - a.y)^2 + (b.z - a.z)^2)"
#define BEYOND(X) "b." X " + radius*(b." X " - a." X ")/" AXIS
#define ALONG(X) "offset*normal." X "/sqrt(normal.x^2 + normal.y^2 + normal.z^2)"
#define RIM "(distance + (radius1^2 - radius2^2)/distance)/2"

/* clang-format off */
const struct node_type node_shapes[] = {
    {.record = {"sphere", "A ball.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "radius, 0, 0", .doc = "Centre to surface."})},
     .number = 1, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_sphere", .words = "ball round globe", .source = QUILEZ_DISTANCE ", Sphere"},
    {.record = {"ellipsoid", "A ball with a radius for each axis.", PARAMS(
        {"radii", PARAM_VEC3, SIZE, .def = {0.5, 0.3, 0.4}, .main = true,
         .handle = "radii.x, 0, 0; 0, radii.y, 0; 0, 0, radii.z",
         .doc = "Semi-axes along X, Y and Z."})},
     /* The unit ball's distance at p / radii times the least radius: its gradient is a direction
      * divided by radii and times their least, so never longer than 1. The distance of a box around
      * the ellipsoid is a bound as well, and the greater one of the two where a radius is long. */
     .number = 2, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = BOUND, .lipschitz = 1,
     .glsl = "sd_ellipsoid", .words = "egg ball oval spheroid",
     .source = QUILEZ_DISTANCE ", Ellipsoid, in a form that is a bound everywhere"},
    {.record = {"box", "A cuboid.", PARAMS(
        {"size", PARAM_VEC3, SIZE, .def = {1, 1, 1}, .main = true,
         .handle = BOX_HANDLES, .doc = "Full lengths of the edges."})},
     .number = 3, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_box", .words = "cube cuboid block brick", .source = QUILEZ_DISTANCE ", Box"},
    {.record = {"round_box", "A cuboid with rounded edges.", PARAMS(
        {"size", PARAM_VEC3, SIZE, .def = {1, 1, 1}, .main = true,
         .handle = BOX_HANDLES, .doc = "Full outer lengths, the rounding included."},
        {"radius", PARAM_FLOAT, REACH, .def = {0.1}, .main = true,
         .handle = "size.x/2 - " ROUNDED("radius") ", size.y/2 - " ROUNDED("radius") ", 0",
         .doc = "Radius of the edges; at most half of the least length counts."})},
     .number = 4, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_round_box", .words = "cube cuboid block pillow soap",
     .source = QUILEZ_DISTANCE ", Round Box"},
    {.record = {"torus", "A ring around the Y axis.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "radius + tube, 0, 0", .doc = "Centre of the ring to centre of the tube."},
        {"tube", PARAM_FLOAT, SIZE, .def = {0.15}, .main = true,
         .handle = "radius, tube, 0", .doc = "Radius of the tube."})},
     .number = 5, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_torus", .words = "donut ring doughnut tyre", .source = QUILEZ_DISTANCE ", Torus"},
    {.record = {"cylinder", "A cylinder along the Y axis.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "radius, 0, 0", .doc = "Axis to wall."},
        {"height", PARAM_FLOAT, SIZE, .def = {1}, .main = true,
         .handle = "0, height/2, 0", .doc = "Full height."})},
     .number = 6, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_cylinder", .words = "tube pipe disc disk rod coin",
     .source = QUILEZ_DISTANCE ", Capped Cylinder"},
    {.record = {"capsule", "All points near a segment.", PARAMS(
        {"a", PARAM_VEC3, PLACE, .def = {0, -0.5, 0},
         .handle = POINT("a"), .doc = "One end of the segment."},
        {"b", PARAM_VEC3, PLACE, .def = {0, 0.5, 0}, .main = true,
         .handle = POINT("b"), .doc = "Its other end."},
        {"radius", PARAM_FLOAT, SIZE, .def = {0.25}, .main = true,
         .handle = BEYOND("x") ", " BEYOND("y") ", " BEYOND("z"), .doc = "Segment to surface."})},
     .number = 7, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_capsule", .words = "pill line stick sausage bone",
     .source = QUILEZ_DISTANCE ", Capsule"},
    {.record = {"cone", "A cone along the Y axis, its tip up.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "radius, -height/2, 0", .doc = "Radius of the base at y = -height/2."},
        {"height", PARAM_FLOAT, SIZE, .def = {1}, .main = true,
         .handle = "0, height/2, 0", .doc = "Base to tip."})},
     .number = 8, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_cone", .words = "hat spike funnel tip", .source = QUILEZ_DISTANCE ", Cone"},
    {.record = {"plane", "Everything on one side of a plane.", PARAMS(
        {"normal", PARAM_VEC3, UNIT_NONE, .def = {0, 1, 0}, .direction = true, .step = 0.05,
         .doc = "Points out of the solid side; any length but 0."},
        {"offset", PARAM_FLOAT, PLACE, .main = true,
         .handle = ALONG("x") ", " ALONG("y") ", " ALONG("z"),
         .doc = "Distance of the surface from the origin, along the normal."})},
     .number = 9, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_plane", .words = "floor ground half-space wall",
     .source = QUILEZ_DISTANCE ", Plane"},
    {.record = {"box_frame", "The edges of a cuboid as bars.", PARAMS(
        {"size", PARAM_VEC3, SIZE, .def = {1, 1, 1}, .main = true,
         .handle = "size.x/2, 0, (size.z - thickness)/2; (size.x - thickness)/2, size.y/2, 0; "
                   "0, (size.y - thickness)/2, size.z/2",
         .doc = "Full outer lengths."},
        {"thickness", PARAM_FLOAT, SIZE, .def = {0.05}, .main = true,
         .handle = "size.x/2 - thickness, size.y/2 - thickness, 0",
         .doc = "Side of the bars' square section, inside the size; bars that meet close the sides "
                "between them."})},
     .number = 10, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_box_frame", .words = "cube wireframe cage scaffold edges",
     .source = QUILEZ_DISTANCE ", Box Frame; the inside from the openings between the bars"},
    {.record = {"capped_torus", "A part of a ring around the Z axis, with round ends.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "0, radius + tube, 0", .doc = "Centre of the ring to centre of the tube."},
        {"tube", PARAM_FLOAT, SIZE, .def = {0.15},
         .handle = "0, radius, tube", .doc = "Radius of the tube."},
        {"angle", PARAM_FLOAT, HALF_ANGLE, .def = {2},
         .handle = "(radius + tube)*sin(angle), (radius + tube)*cos(angle), 0",
         .doc = "From the +Y axis to each end; at the maximum the ring is closed."})},
     .number = 11, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_capped_torus", .words = "arc horseshoe handle hook donut ring",
     .source = QUILEZ_DISTANCE ", Capped Torus; the inside from the seams where it meets itself"},
    {.record = {"link", "A link of a chain, along the Y axis.", PARAMS(
        {"length", PARAM_FLOAT, REACH, .def = {0.5}, .main = true,
         .handle = "0, length/2 + radius + tube, 0", .doc = "Length of the straight parts."},
        {"radius", PARAM_FLOAT, SIZE, .def = {0.3}, .main = true,
         .handle = "radius + tube, 0, 0", .doc = "Radius of the bends, to the centre of the tube."},
        {"tube", PARAM_FLOAT, SIZE, .def = {0.1},
         .handle = "radius, 0, tube", .doc = "Radius of the tube."})},
     .number = 12, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_link", .words = "chain ring oval shackle", .source = QUILEZ_DISTANCE ", Link"},
    {.record = {"round_cylinder", "A cylinder along the Y axis with rounded edges.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "radius, 0, 0", .doc = "Axis to wall, the rounding included."},
        {"height", PARAM_FLOAT, SIZE, .def = {1}, .main = true,
         .handle = "0, height/2, 0", .doc = "Full height, the rounding included."},
        {"rounding", PARAM_FLOAT, REACH, .def = {0.1},
         .handle = "radius - " ROUNDED("rounding") ", height/2 - " ROUNDED("rounding") ", 0",
         .doc = "Radius of the edges; at most the radius and half of the height count."})},
     .number = 13, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_round_cylinder", .words = "pill puck button cushion disc drum",
     .source = QUILEZ_DISTANCE ", Rounded Cylinder"},
    {.record = {"capped_cone", "A cone along the Y axis without its tip.", PARAMS(
        {"radius1", PARAM_FLOAT, REACH, .def = {0.5}, .main = true,
         .handle = "radius1, -height/2, 0", .doc = "Radius at the bottom."},
        {"radius2", PARAM_FLOAT, REACH, .def = {0.25}, .main = true,
         .handle = "radius2, height/2, 0", .doc = "Radius at the top."},
        {"height", PARAM_FLOAT, SIZE, .def = {1},
         .handle = "0, height/2, 0", .doc = "Full height."})},
     .number = 14, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_capped_cone", .words = "frustum truncated bucket cup mug lampshade",
     .source = QUILEZ_DISTANCE ", Capped Cone"},
    {.record = {"round_cone", "Two balls, one above the other, and a cone's wall.", PARAMS(
        {"radius1", PARAM_FLOAT, REACH, .def = {0.4}, .main = true,
         .handle = "0, -radius1, 0", .doc = "Radius of the ball at the origin."},
        {"radius2", PARAM_FLOAT, REACH, .def = {0.2}, .main = true,
         .handle = "radius2*sqrt(1 - ((radius1 - radius2)/height)^2), "
                   "height + radius2*(radius1 - radius2)/height, 0",
         .doc = "Radius of the ball above it."},
        {"height", PARAM_FLOAT, SIZE, .def = {0.6},
         .handle = "0, height + radius2, 0", .doc = "From centre to centre."})},
     .number = 15, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_round_cone", .words = "egg drop pear capsule bulb",
     .source = QUILEZ_DISTANCE ", Round cone"},
    {.record = {"solid_angle", "The part of a ball that a cone around +Y cuts out.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "0, radius, 0", .doc = "Radius of the ball."},
        {"angle", PARAM_FLOAT, HALF_ANGLE, .def = {0.5},
         .handle = "radius*sin(angle), radius*cos(angle), 0",
         .doc = "From the +Y axis to the side; at the maximum the ball is whole."})},
     .number = 16, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_solid_angle", .words = "sector wedge cone ice cream spotlight",
     .source = QUILEZ_DISTANCE ", Solid Angle"},
    {.record = {"cut_sphere", "The part of a ball above a plane.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "0, radius, 0", .doc = "Radius of the ball."},
        {"height", PARAM_FLOAT, PLACE, .def = {0.2}, .main = true,
         .handle = "0, height, 0",
         .doc = "Where the cut is on the Y axis; at most the radius counts, up and down."})},
     .number = 17, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_cut_sphere", .words = "dome cap hemisphere half ball lens",
     .source = QUILEZ_DISTANCE ", Cut Sphere"},
    {.record = {"cut_hollow_sphere", "A bowl: a hollow ball below a plane, its rim round.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "0, -radius - thickness, 0", .doc = "Centre to the middle of the wall."},
        {"height", PARAM_FLOAT, PLACE, .def = {0.2}, .main = true,
         .handle = "(1 + thickness/radius)*sqrt(radius^2 - height^2), "
                   "(1 + thickness/radius)*height, 0",
         .doc = "Where the cut is on the Y axis; at most the radius counts, up and down."},
        {"thickness", PARAM_FLOAT, SIZE, .def = {0.05},
         .handle = "0, thickness - radius, 0", .doc = "Half of the thickness of the wall."})},
     .number = 18, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_cut_hollow_sphere", .words = "bowl cup shell dish hemisphere",
     .source = QUILEZ_DISTANCE ", Cut Hollow Sphere; its section is the flat arc"},
    {.record = {"death_star", "A ball with a hollow as from another ball.", PARAMS(
        {"radius1", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "-radius1, 0, 0", .doc = "Radius of the ball."},
        {"radius2", PARAM_FLOAT, SIZE, .def = {0.4}, .main = true,
         .handle = RIM ", sqrt(radius1^2 - (" RIM ")^2), 0",
         .doc = "Radius of the ball that is taken away; at most radius1 + distance counts."},
        {"distance", PARAM_FLOAT, REACH, .def = {0.5},
         .handle = "distance - radius2, 0, 0",
         .doc = "Where the centre of that ball is on the X axis."})},
     .number = 19, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_death_star", .words = "crater moon bite crescent dent",
     .source = QUILEZ_DISTANCE ", Death Star"},
    {.record = {.name = NULL}},
};
/* clang-format on */
