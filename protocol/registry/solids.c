/* SPDX-License-Identifier: MIT */
/* Registry: primitives in three dimensions with flat sides, and flat ones with a thickness. */
#include "rows.h"

#define REGULAR "H. S. M. Coxeter, Regular Polytopes (1973), chapter 5, The Kaleidoscope"
#define CIRCUMRADIUS(HANDLE)                                                                       \
    PARAMS({"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true, .handle = (HANDLE),           \
            .doc = "Centre to corners."})
#define CORNER PARAM_VEC3, PLACE
#define AROUND SIZE, .def = {0.02}, .main = true

/* From a place within the corners along the normal of a, b and c; not in the middle of four, where
 * the gizmo is. */
#define NORMAL(Y, Z)                                                                               \
    "((b." Y " - a." Y ")*(c." Z " - a." Z ") - (b." Z " - a." Z ")*(c." Y " - a." Y "))"
#define SQUARES NORMAL("y", "z") "^2 + " NORMAL("z", "x") "^2 + " NORMAL("x", "y") "^2"
#define OVER(SPOT, X, Y, Z) SPOT(X) " + thickness*" NORMAL(Y, Z) "/sqrt(" SQUARES ")"
#define THICK(SPOT)                                                                                \
    OVER(SPOT, "x", "y", "z") ", " OVER(SPOT, "y", "z", "x") ", " OVER(SPOT, "z", "x", "y")
#define THIRD(X) "(a." X " + b." X " + c." X ")/3"
#define QUARTER(X) "(a." X " + 3*c." X ")/4"

/* clang-format off */
const struct node_type node_solids[] = {
    {.record = {"hex_prism", "A rod with six equal sides along the Z axis.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "0, radius, 0",
         .doc = "Axis to the middle of a side; two sides face up and down."},
        {"height", PARAM_FLOAT, SIZE, .def = {1}, .main = true,
         .handle = "0, 0, height/2", .doc = "Full length along Z."})},
     .number = 40, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_hex_prism", .words = "hexagon nut pencil honeycomb rod",
     .source = QUILEZ_DISTANCE ", Hexagonal Prism"},
    {.record = {"tri_prism", "A rod with three equal sides along the Z axis, an edge up.", PARAMS(
        {"radius", PARAM_FLOAT, SIZE, .def = {0.5}, .main = true,
         .handle = "0, -radius, 0",
         .doc = "Axis to the middle of a side, half as far as to an edge."},
        {"height", PARAM_FLOAT, SIZE, .def = {1}, .main = true,
         .handle = "0, 0, height/2", .doc = "Full length along Z."})},
     .number = 41, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_tri_prism", .words = "triangle wedge roof tent toblerone",
     .source = QUILEZ_DISTANCE ", Triangular Prism, in a form that is exact"},
    {.record = {"octahedron", "A regular solid of eight triangles, its corners on the axes.",
                CIRCUMRADIUS("0, radius, 0")},
     .number = 42, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_octahedron", .words = "diamond platonic crystal eight d8",
     .source = QUILEZ_DISTANCE ", Octahedron"},
    {.record = {"tetrahedron", "A regular solid of four triangles.",
                CIRCUMRADIUS("radius/sqrt(3), radius/sqrt(3), radius/sqrt(3)")},
     .number = 43, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_tetrahedron", .words = "pyramid platonic crystal four d4", .source = REGULAR},
    {.record = {"dodecahedron", "A regular solid of twelve pentagons.",
                CIRCUMRADIUS("radius/sqrt(3), radius/sqrt(3), radius/sqrt(3)")},
     .number = 44, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_dodecahedron", .words = "platonic pentagon crystal twelve d12", .source = REGULAR},
    {.record = {"icosahedron", "A regular solid of twenty triangles.",
                CIRCUMRADIUS("0, radius*sqrt((1 - sqrt(1/5))/2), radius*sqrt((1 + sqrt(1/5))/2)")},
     .number = 45, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_icosahedron", .words = "platonic crystal twenty d20", .source = REGULAR},
    {.record = {"pyramid", "A pyramid on a square that lies at y = 0.", PARAMS(
        {"base", PARAM_FLOAT, SIZE, .def = {1}, .main = true,
         .handle = "base/2, 0, 0", .doc = "Side of the square."},
        {"height", PARAM_FLOAT, SIZE, .def = {1}, .main = true,
         .handle = "0, height, 0", .doc = "Square to tip."})},
     .number = 46, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_pyramid", .words = "egypt roof spike tip",
     .source = QUILEZ_DISTANCE ", Pyramid, by the nearest point of one side"},
    {.record = {"rhombus", "A plate in the form of a diamond with rounded corners.", PARAMS(
        {"width", PARAM_FLOAT, SIZE, .def = {0.8}, .main = true,
         .handle = "width/2 + rounding, 0, 0",
         .doc = "Full diagonal along X, without the rounding."},
        {"depth", PARAM_FLOAT, SIZE, .def = {0.4}, .main = true,
         .handle = "0, 0, depth/2 + rounding",
         .doc = "Full diagonal along Z, without the rounding."},
        {"height", PARAM_FLOAT, SIZE, .def = {0.1},
         .handle = "0, height/2, 0", .doc = "Full height along Y."},
        {"rounding", PARAM_FLOAT, REACH, .def = {0.05},
         .handle = "width/4 + rounding*depth/sqrt(width^2 + depth^2), 0, "
                   "depth/4 + rounding*width/sqrt(width^2 + depth^2)",
         .doc = "By how much the diamond grows in its plane."})},
     .number = 47, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_rhombus", .words = "diamond lozenge plate kite",
     .source = QUILEZ_DISTANCE ", Rhombus"},
    {.record = {"triangle", "All points near a triangle, which may be as narrow as a segment.",
        PARAMS(
        {"a", CORNER, .def = {-0.5, -0.4, 0},
         .handle = POINT("a"), .doc = "One corner."},
        {"b", CORNER, .def = {0.5, -0.4, 0},
         .handle = POINT("b"), .doc = "Another."},
        {"c", CORNER, .def = {0, 0.5, 0}, .main = true,
         .handle = POINT("c"), .doc = "The third."},
        {"thickness", PARAM_FLOAT, AROUND,
         .handle = THICK(THIRD), .doc = "Triangle to surface, on either side."})},
     .number = 48, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_triangle", .words = "face facet polygon sheet sail",
     .source = QUILEZ_DISTANCE ", Triangle"},
    {.record = {"quad", "All points near the two triangles a, b, c and a, c, d. Where these form "
                "no flat convex quadrilateral, distances inside are bounds.", PARAMS(
        {"a", CORNER, .def = {-0.5, -0.4, 0},
         .handle = POINT("a"), .doc = "One corner."},
        {"b", CORNER, .def = {0.5, -0.4, 0},
         .handle = POINT("b"), .doc = "The next, in order around."},
        {"c", CORNER, .def = {0.5, 0.4, 0}, .main = true,
         .handle = POINT("c"), .doc = "The corner opposite to a."},
        {"d", CORNER, .def = {-0.5, 0.4, 0},
         .handle = POINT("d"), .doc = "The last."},
        {"thickness", PARAM_FLOAT, AROUND,
         .handle = THICK(QUARTER), .doc = "Quadrilateral to surface, on either side."})},
     .number = 49, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = EXACT, .lipschitz = 1,
     .glsl = "sd_quad", .words = "face facet polygon sheet panel card",
     .source = QUILEZ_DISTANCE ", Quad"},
    {.record = {.name = NULL}},
};
/* clang-format on */
