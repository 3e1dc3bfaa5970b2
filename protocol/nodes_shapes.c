/* SPDX-License-Identifier: MIT */
/* Registry: primitives in three dimensions. */
#include "nodes_parts.h"

/* clang-format off */
const struct node_type node_shapes[] = {
    {.record = {"sphere", "A ball.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true, .doc = "Centre to surface."})},
     .number = 1, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_sphere", .words = "ball round globe", .source = QUILEZ_DISTANCE ", Sphere"},
    {.record = {"ellipsoid", "A ball with three radii of its own.", PARAMS(
        {"radii", PARAM_VEC3, SIZE, .def = {0.5, 0.3, 0.4}, .main = true,
         .doc = "Semi-axes along X, Y and Z."})},
     /* The unit ball's distance at p / radii times the least radius: its gradient is a direction
      * divided by radii and times their least, so never longer than 1. */
     .number = 2, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = BOUND, .lipschitz = 1,
     .glsl = "sd_ellipsoid", .words = "egg ball oval spheroid",
     .source = QUILEZ_DISTANCE ", Ellipsoid, in the form that is a bound everywhere"},
    {.record = {"box", "A cuboid.", PARAMS(
        {"size", PARAM_VEC3, SIZE, .def = {1, 1, 1}, .main = true,
         .doc = "Full lengths of the edges."})},
     .number = 3, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_box", .words = "cube cuboid block brick", .source = QUILEZ_DISTANCE ", Box"},
    {.record = {"round_box", "A cuboid with rounded edges.", PARAMS(
        {"size", PARAM_VEC3, SIZE, .def = {1, 1, 1}, .main = true,
         .doc = "Full outer lengths, the rounding included."},
        {"radius", PARAM_FLOAT, REACH, .def = {0.1}, .main = true,
         .doc = "Radius of the edges; at most half of the least length counts."})},
     .number = 4, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_round_box", .words = "cube cuboid block pillow soap",
     .source = QUILEZ_DISTANCE ", Round Box"},
    {.record = {"torus", "A ring around the Y axis.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .doc = "Centre of the ring to centre of the tube."},
        {"tube", PARAM_FLOAT, SIZE, .def = {0.15}, .main = true, .doc = "Radius of the tube."})},
     .number = 5, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_torus", .words = "donut ring doughnut tyre", .source = QUILEZ_DISTANCE ", Torus"},
    {.record = {"cylinder", "A cylinder along the Y axis.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true, .doc = "Axis to wall."},
        {"height", PARAM_FLOAT, SIZE, .def = {1}, .main = true, .doc = "Full height."})},
     .number = 6, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_cylinder", .words = "tube pipe disc disk rod coin",
     .source = QUILEZ_DISTANCE ", Capped Cylinder"},
    {.record = {"capsule", "All points near a segment.", PARAMS(
        {"a", PARAM_VEC3, PLACE, .def = {0, -0.5, 0}, .doc = "One end of the segment."},
        {"b", PARAM_VEC3, PLACE, .def = {0, 0.5, 0}, .main = true, .doc = "Its other end."},
        {"radius", PARAM_FLOAT, SIZE, .def = {0.25}, .main = true, .doc = "Segment to surface."})},
     .number = 7, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_capsule", .words = "pill line stick sausage bone",
     .source = QUILEZ_DISTANCE ", Capsule"},
    {.record = {"cone", "A cone along the Y axis, its tip up.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .doc = "Radius of the base at y = -height/2."},
        {"height", PARAM_FLOAT, SIZE, .def = {1}, .main = true, .doc = "Base to tip."})},
     .number = 8, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_cone", .words = "hat spike funnel tip", .source = QUILEZ_DISTANCE ", Cone"},
    {.record = {"plane", "Everything on one side of a plane.", PARAMS(
        {"normal", PARAM_VEC3, UNIT_NONE, .def = {0, 1, 0}, .direction = true, .step = 0.05,
         .doc = "Points out of the solid side; any length but 0."},
        {"offset", PARAM_FLOAT, PLACE, .main = true,
         .doc = "Distance of the surface from the origin, along the normal."})},
     .number = 9, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_plane", .words = "floor ground half-space wall",
     .source = QUILEZ_DISTANCE ", Plane"},
    {.record = {.name = NULL}},
};
/* clang-format on */
