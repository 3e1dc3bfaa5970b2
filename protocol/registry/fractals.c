/* SPDX-License-Identifier: MIT */
/* Registry: fractals, minimal surfaces and landscapes. */
#include "protocol/equation.h"
#include "rows.h"

/* Handle: half of the wall along its normal (1, 1, -1). */
#define BESIDE "thickness/(2*sqrt(3))"
#define COUNT PARAM_INT, UNIT_NONE, .step = 1, .main = true

/* clang-format off */
const struct node_type node_fractals[] = {
    {.record = {"gyroid", "A sponge of two equal mazes with one wall between them, cut by a box.",
        PARAMS(
        {"period", PARAM_FLOAT, SIZE, .def = {1}, .main = true,
         .handle = "period/2, 0, 0", .doc = "Length after which it repeats."},
        {"thickness", PARAM_FLOAT, SIZE, .def = {0.1}, .main = true,
         .handle = BESIDE ", period/2 + " BESIDE ", -" BESIDE,
         .doc = "Of the wall where it is thinnest; elsewhere up to twice as much."},
        {"size", PARAM_VEC3, SIZE, .def = {1, 1, 1},
         .handle = BOX_HANDLES, .doc = "Full lengths of the box."})},
     /* With g = sin x cos y + sin y cos z + sin z cos x, dg/dx = (cos x, sin x) (cos y, -sin z) has
      * a square of at most cos^2 y + sin^2 z. The three of these add up to 3, so g divided by the
      * square root of 3 and by 2 pi / period is as slow as the distance. */
     .number = 70, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = BOUND, .lipschitz = 1,
     .glsl = "sd_gyroid", .words = "minimal surface sponge lattice infill schwarz tpms",
     .source = "Alan H. Schoen, Infinite periodic minimal surfaces, NASA TN D-5541 (1970)"},
    {.record = {"mandelbulb", "All points whose orbit under z -> z^power + point stays near the "
                "origin.", PARAMS(
        {"power", COUNT, .min = 2, .max = 16, .def = {8},
         .doc = "Factor on angles about the origin."},
        {"iterations", COUNT, .min = 1, .max = 12, .def = {8}, .doc = "Steps of an orbit."})},
     .number = 71, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = BOUND, .lipschitz = 1,
     .creased = true, .glsl = "sd_mandelbulb", .words = "fractal mandelbrot broccoli",
     .source = "Daniel White and Paul Nylander, The unravelling of the real 3D Mandelbulb, "
               "skytopia.com/project/fractal/mandelbulb.html"},
    {.record = {"menger", "A cube without its middle, repeated in each of the remaining cubes.",
        PARAMS(
        {"size", PARAM_FLOAT, SIZE, .def = {1}, .main = true,
         .handle = "size/2, size/2, size/2", .doc = "Edge of the cube."},
        {"iterations", COUNT, .min = 1, .max = 8, .def = {4},
         .doc = "How often the middle is taken out."})},
     .number = 72, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = BOUND, .lipschitz = 1,
     .glsl = "sd_menger", .words = "fractal sponge cube sierpinski holes",
     .source = "Karl Menger, Dimensionstheorie (1928); Inigo Quilez, Menger fractal, "
               "iquilezles.org/articles/menger"},
    {.record = {"julia", "All points whose orbit under q -> q^2 + c in the quaternions stays near "
                "the origin.", PARAMS(
        {"c", PARAM_VEC4, UNIT_NONE, .min = -2, .max = 2, .def = {-0.2, 0.6, 0.2, 0.2},
         .step = 0.02, .main = true, .doc = "The constant c; its first component is real."},
        {"iterations", COUNT, .min = 1, .max = 20, .def = {10}, .doc = "Steps of an orbit."})},
     .number = 73, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = BOUND, .lipschitz = 1,
     .creased = true, .glsl = "sd_julia", .words = "fractal quaternion",
     .source = "Hart, Sandin and Kauffman, Ray tracing deterministic 3-D fractals, SIGGRAPH 1989"},
    {.record = {"terrain", "A landscape on a rectangle. Hills are as wide as a quarter of the "
                "greater horizontal size; each octave adds some half as wide and half as high.",
        PARAMS(
        {"size", PARAM_VEC3, SIZE, .def = {8, 1, 8}, .main = true,
         .handle = "size.x/2, -size.y/2, 0; 0, size.y/2, 0; 0, -size.y/2, size.z/2",
         .doc = "Full lengths of the box around it; the middle one is from bottom to peaks."},
        {"octaves", COUNT, .min = 1, .max = 12, .def = {5}, .doc = "Layers of detail."},
        {"seed", PARAM_INT, UNIT_NONE, .min = 0, .max = 65535, .step = 1,
         .doc = "Each number gives another landscape."})},
     .number = 74, .group = GROUP_PRIMITIVE, .kind = KIND_SHAPE, .exactness = BOUND, .lipschitz = 1,
     .glsl = "sd_terrain", .words = "landscape mountains hills ground noise height field",
     .source = "Inigo Quilez, Value noise derivatives, iquilezles.org/articles/morenoise"},
    {.record = {"implicit", "The zero set of an equation in x, y and z.", PARAMS(
        {"equation", PARAM_EQUATION, .main = true,
         .doc = "Such as x^2 + y^2 - z^2 = a. With < or > the solid is where that holds."},
        {"parametric", PARAM_SURFACE,
         .doc = "The parametric surface that the equation was found for. It is proved again, "
                "never trusted, and changes no picture."},
        {"mode", PARAM_ENUM, .choices = (const char *const[]){"solid", "sheet", NULL},
         .doc = "What is behind the surface too, or the surface alone."},
        {"clip", PARAM_ENUM, .choices = (const char *const[]){"box", "ball", NULL},
         .doc = "What cuts it."},
        {"size", PARAM_VEC3, SIZE, .def = {3, 3, 3}, .when = "clip=box",
         .handle = BOX_HANDLES, .doc = "Full lengths of the box."},
        {"radius", PARAM_FLOAT, SIZE, .def = {1.5}, .when = "clip=ball",
         .handle = "radius, 0, 0", .doc = "Of the ball."},
        {"thickness", PARAM_FLOAT, SIZE, .def = {0.03}, .when = "mode=sheet",
         .doc = "Of the sheet."}
        EQUATION_LETTERS_EACH(LETTER_ROW, "equation"))},
     .number = 75, .group = GROUP_PRIMITIVE, .kind = KIND_EQUATION, .exactness = BOUND,
     .lipschitz = 0, .glsl = "", .words = "equation function algebraic surface polynomial "
     "isosurface maths formula quadric",
     .source = "Mitchell, Robust ray intersection with interval arithmetic, Graphics Interface "
               "(1990)"},
    {.record = {"parametric", "A surface whose x, y and z are expressions in two parameters, as a "
                "sheet. It is drawn by patches through its points.", PARAMS(
        {"surface", PARAM_SURFACE, .main = true,
         .doc = "Such as x = s*cos(t), y = a*t, z = s*sin(t), and the ranges of s and t."},
        {"detail", PARAM_ENUM, .choices = (const char *const[]){"coarse", "fine", "finest", NULL},
         .def = {1}, .doc = "Patches along each parameter: 16, 32 or 64."},
        {"thickness", PARAM_FLOAT, SIZE, .def = {0.05}, .main = true, .handle = OUT("thickness/2"),
         .doc = "Of the sheet."}
        EQUATION_LETTERS_EACH(LETTER_ROW, "surface"))},
     .number = 76, .group = GROUP_PRIMITIVE, .kind = KIND_SURFACE, .exactness = BOUND,
     .lipschitz = 0, .glsl = "", .words = "function patch spline bezier sheet helicoid maths "
     "formula mesh curve",
     .source = "Newton's method for the nearest point of bicubic patches; a tree of boxes and a "
               "grid of distances tell which"},
    {.record = {.name = NULL}},
};
/* clang-format on */
