/* SPDX-License-Identifier: MIT */
/* Registry: two-dimensional shapes, children of extrude and revolve. */
#include "rows.h"

#define QUILEZ_FLAT "Inigo Quilez, 2D distance functions, iquilezles.org/articles/distfunctions2d"
#define PI 3.141592653589793

/* The full width of a line. */
#define WIDTH SIZE, .main = true, .doc = "Full width of the line, half on each side."

/* Handles: a corner, the sides of a rectangle, and beside a point of a line that runs there in
 * the direction from a to END. */
#define CORNER(P) P ".x, " P ".y, 0"
#define SIDES "size.x/2, 0, 0; 0, size.y/2, 0"
#define WAY(END) "sqrt((" END ".x - a.x)^2 + (" END ".y - a.y)^2)"
#define HALF(END, X) "thickness/2*(" END "." X " - a." X ")/" WAY(END)
#define BESIDE(SPOT, END) SPOT("x") " - " HALF(END, "y") ", " SPOT("y") " + " HALF(END, "x") ", 0"
#define STRAIGHT(X) "(a." X " + 3*b." X ")/4"
#define CURVED(X) "(a." X " + 2*b." X " + c." X ")/4"

static const double corners[] = {-0.5, -0.5, 0.5,  -0.5, 0.5,  -0.1,
                                 -0.1, -0.1, -0.1, 0.5,  -0.5, 0.5};

/* clang-format off */
const struct node_type node_flat[] = {
    {.record = {"circle", "A disc.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "radius, 0, 0", .doc = "Centre to edge."})},
     .number = 401, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_circle", .words = "disc disk round dot", .source = QUILEZ_FLAT ", Circle"},
    {.record = {"rectangle", "A rectangle.", PARAMS(
        {"size", PARAM_VEC2, SIZE, .def = {1, 0.6}, .main = true,
         .handle = SIDES, .doc = "Full lengths of the sides."})},
     .number = 402, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_rectangle", .words = "square box quad", .source = QUILEZ_FLAT ", Box"},
    {.record = {"round_rectangle", "A rectangle with rounded corners.", PARAMS(
        {"size", PARAM_VEC2, SIZE, .def = {1, 0.6}, .main = true,
         .handle = SIDES, .doc = "Full outer lengths, the rounding included."},
        {"radius", PARAM_FLOAT, REACH, .def = {0.15}, .main = true,
         .handle = "size.x/2 - " ROUNDED("radius") ", size.y/2 - " ROUNDED("radius") ", 0",
         .doc = "Radius of the corners; at most half of the lesser length counts."})},
     .number = 403, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_round_rectangle", .words = "square box pill stadium soft",
     .source = QUILEZ_FLAT ", Rounded Box"},
    {.record = {"triangle2", "A triangle in the plane.", PARAMS(
        {"a", PARAM_VEC2, PLACE, .def = {-0.5, -0.4},
         .handle = CORNER("a"), .doc = "One corner."},
        {"b", PARAM_VEC2, PLACE, .def = {0.5, -0.4},
         .handle = CORNER("b"), .doc = "Another."},
        {"c", PARAM_VEC2, PLACE, .def = {0, 0.5}, .main = true,
         .handle = CORNER("c"), .doc = "The third."})},
     .number = 404, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_triangle2", .words = "wedge gable delta", .source = QUILEZ_FLAT ", Triangle"},
    {.record = {"regular_polygon", "A polygon of equal sides, its first corner up.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "0, radius, 0", .doc = "Centre to corners."},
        {"sides", PARAM_INT, UNIT_NONE, .def = {6}, .min = 3, .max = 64, .step = 1, .main = true,
         .doc = "How many sides."})},
     .number = 405, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_regular_polygon", .words = "ngon pentagon hexagon octagon nut",
     .source = "its symmetry, and the distance to half of one side"},
    {.record = {"polygon", "A polygon, its corners in either order.", PARAMS(
        {"points", PARAM_POINTS, UNIT_LENGTH, .def = {6}, .def_points = corners, .min = 3,
         .max = LIMIT_POINTS, .main = true, .doc = "The corners; its sides must not cross."})},
     .number = 406, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_polygon", .words = "outline path shape freeform profile",
     .source = QUILEZ_FLAT ", Polygon"},
    {.record = {"star", "A star, its first point up.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "0, radius, 0", .doc = "Centre to points."},
        {"points", PARAM_INT, UNIT_NONE, .def = {5}, .min = 2, .max = 64, .step = 1, .main = true,
         .doc = "How many points."},
        {"inner", PARAM_FLOAT, REACH, .def = {0.22},
         .handle = "inner*sin(pi/points), inner*cos(pi/points), 0",
         .doc = "Centre to the corners between the points; may be above the radius."})},
     .number = 407, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_star", .words = "asterisk spikes gear", .source = QUILEZ_FLAT ", Star"},
    {.record = {"ring", "A line along a circle.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.4}, .main = true,
         .handle = "radius + thickness/2, 0, 0", .doc = "Centre to the middle of the line."},
        {"thickness", PARAM_FLOAT, WIDTH, .def = {0.1}, .handle = "0, radius - thickness/2, 0"})},
     .number = 408, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_ring", .words = "annulus hoop washer circle", .source = QUILEZ_FLAT ", Ring"},
    {.record = {"arc", "A part of a ring with round ends.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.4}, .main = true,
         .handle = "0, radius + thickness/2, 0", .doc = "Centre to the middle of the line."},
        {"angle", PARAM_FLOAT, UNIT_ANGLE, .def = {2}, .min = 0, .max = PI, .step = 0.05,
         .handle = "(radius + thickness/2)*sin(angle), (radius + thickness/2)*cos(angle), 0",
         .doc = "From the +Y axis to each end; at the maximum it is a ring."},
        {"thickness", PARAM_FLOAT, WIDTH, .def = {0.1}, .handle = "0, radius - thickness/2, 0"})},
     .number = 409, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_arc", .words = "ring horseshoe rainbow hook curve",
     .source = QUILEZ_FLAT ", Arc; the inside from the circles that bound it"},
    {.record = {"vesica", "The intersection of two equal discs.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.6}, .main = true,
         .handle = "radius - distance/2, 0, 0", .doc = "Radius of the discs."},
        {"distance", PARAM_FLOAT, REACH, .def = {0.6}, .main = true,
         .handle = "0, sqrt(radius^2 - distance^2/4), 0",
         .doc = "Between their centres, on X; at most twice the radius counts."})},
     .number = 410, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_vesica", .words = "lens eye leaf almond lemon",
     .source = QUILEZ_FLAT ", Vesica"},
    {.record = {"cross", "Two equal bars.", PARAMS(
        {"size", PARAM_FLOAT, SIZE, .def = {1}, .main = true,
         .handle = "size/2, 0, 0", .doc = "Full length of both bars."},
        {"thickness", PARAM_FLOAT, SIZE, .def = {0.3}, .main = true,
         .handle = "thickness/2, thickness/2, 0",
         .doc = "Full width of the bars; at most their length counts."})},
     .number = 411, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_cross", .words = "plus x add", .source = "its symmetry, and one end of a bar"},
    {.record = {"bezier", "A line along a quadratic curve, with round ends.", PARAMS(
        {"a", PARAM_VEC2, PLACE, .def = {-0.5, -0.4},
         .handle = CORNER("a"), .doc = "Where the curve starts."},
        {"b", PARAM_VEC2, PLACE, .def = {0, 0.8}, .main = true,
         .handle = CORNER("b"),
         .doc = "Where it is drawn to; its tangents at both ends meet there."},
        {"c", PARAM_VEC2, PLACE, .def = {0.5, -0.4},
         .handle = CORNER("c"), .doc = "Where it ends."},
        {"thickness", PARAM_FLOAT, WIDTH, .def = {0.1}, .handle = BESIDE(CURVED, "c")})},
     /* Exact but for the inside of a line that overlaps itself, where it is a bound. */
     .number = 412, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_bezier", .words = "curve spline path stroke parabola",
     .source = QUILEZ_FLAT ", Quadratic Bezier; its cubic by Newton's method from both ends"},
    {.record = {"heart", "A heart that stands on the origin.", PARAMS(
        {"size", PARAM_FLOAT, SIZE, .def = {0.9}, .main = true,
         .handle = "0, size, 0", .doc = "Tip to the notch between its two half discs."})},
     .number = 413, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_heart", .words = "love valentine card suit", .source = QUILEZ_FLAT ", Heart"},
    {.record = {"ellipse", "A disc with a radius for each axis.", PARAMS(
        {"radii", PARAM_VEC2, SIZE, .def = {0.5, 0.3}, .main = true,
         .handle = "radii.x, 0, 0; 0, radii.y, 0", .doc = "Semi-axes along X and Y."})},
     .number = 414, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = BOUND, .lipschitz = 1,
     .glsl = "sd2_ellipse", .words = "oval egg circle disc",
     .source = "the unit circle's distance by the lesser radius: a bound everywhere"},
    {.record = {"segment", "A straight line with round ends.", PARAMS(
        {"a", PARAM_VEC2, PLACE, .def = {-0.4, -0.2},
         .handle = CORNER("a"), .doc = "One end."},
        {"b", PARAM_VEC2, PLACE, .def = {0.4, 0.2}, .main = true,
         .handle = CORNER("b"), .doc = "The other end."},
        {"thickness", PARAM_FLOAT, WIDTH, .def = {0.1}, .handle = BESIDE(STRAIGHT, "b")})},
     .number = 415, .group = GROUP_SHAPE, .kind = KIND_FLAT, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd2_segment", .words = "line stroke bar stick", .source = QUILEZ_FLAT ", Segment"},
    {.record = {.name = NULL}},
};
/* clang-format on */
