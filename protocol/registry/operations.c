/* SPDX-License-Identifier: MIT */
/* Registry: operations, and the nodes that only give structure. */
#include "rows.h"

/* In the order of renderer/sdf/operations.c. */
static const char *const kernels[] = {"quadratic", "cubic", "quartic",    "circular", "exponential",
                                      "root",      "power", "polynomial", NULL};

/* clang-format off */
static const struct param blend_params[] = {
    {"k", PARAM_FLOAT, SIZE, .def = {0.1}, .main = true, .handle = "k, 0, 0",
     .doc = "Reach of the blend: nothing changes where distances differ by more. Of the kernels "
            "without end: exponential, 1 by a length (greater is harder); root, the square of a "
            "length; power, an exponent of 1 or more."},
    {"kernel", PARAM_ENUM, .choices = kernels,
     .doc = "Profile of the blend; power changes distances but moves no surface. Quadratic, cubic "
            "and quartic are the polynomials of order 2, 3 and 4."},
    {"order", PARAM_INT, .def = {3}, .min = 2, .max = 16, .step = 1, .when = "kernel=polynomial",
     .doc = "Order of the polynomial: the higher, the smoother the blend and the less it fills."},
    {.name = NULL},
};

const struct node_type node_operations[] = {
    {.record = {"union", "Everything that is in any child.", no_params},
     .number = 101, .group = GROUP_OPERATION, .kind = KIND_COMBINE, .exactness = BOUND,
     .lipschitz = 1, .glsl = "op_union", .words = "or add join merge min", .source = HART},
    {.record = {"intersection", "Only what is in every child.", no_params},
     .number = 102, .group = GROUP_OPERATION, .kind = KIND_COMBINE, .exactness = BOUND,
     .lipschitz = 1, .glsl = "op_intersection", .words = "and common overlap max", .source = HART},
    {.record = {"difference", "The first child minus every other.", no_params},
     .number = 103, .group = GROUP_OPERATION, .kind = KIND_COMBINE, .exactness = BOUND,
     .lipschitz = 1, .glsl = "op_difference", .words = "subtract minus cut carve hole",
     .source = HART},
    {.record = {"smooth_union", "A union whose parts melt together.", blend_params},
     .number = 104, .group = GROUP_OPERATION, .kind = KIND_COMBINE, .exactness = BOUND,
     .lipschitz = 1, .glsl = "op_smooth_union", .words = "blend melt merge metaballs or add",
     .source = QUILEZ_SMIN},
    {.record = {"smooth_intersection", "An intersection with softened edges.", blend_params},
     .number = 105, .group = GROUP_OPERATION, .kind = KIND_COMBINE, .exactness = BOUND,
     .lipschitz = 1, .glsl = "op_smooth_intersection", .words = "blend and common overlap",
     .source = QUILEZ_SMIN},
    {.record = {"smooth_difference", "The first child minus every other, with softened edges.",
                blend_params},
     .number = 106, .group = GROUP_OPERATION, .kind = KIND_COMBINE, .exactness = BOUND,
     .lipschitz = 1, .glsl = "op_smooth_difference", .words = "blend subtract minus carve dent",
     .source = QUILEZ_SMIN},
    {.record = {"exclusive", "Everything that is in an odd number of children.", no_params},
     .number = 107, .group = GROUP_OPERATION, .kind = KIND_COMBINE, .exactness = BOUND,
     .lipschitz = 1, .glsl = "op_exclusive", .words = "xor symmetric difference either odd",
     .source = QUILEZ_DISTANCE ", Xor"},
    {.record = {"morph", "A mix of its first two children.", PARAMS(
        {"t", PARAM_FLOAT, .def = {0.5}, .min = 0, .max = 1, .step = 0.05, .main = true,
         .doc = "Share of the second child: 0 is the first alone, 1 the second alone."})},
     .number = 108, .group = GROUP_OPERATION, .kind = KIND_COMBINE, .exactness = BOUND,
     .lipschitz = 1, .glsl = "op_morph", .words = "mix lerp interpolate between transition",
     .source = "Linear interpolation of both distances"},
    {.record = {.name = NULL}},
};

const struct node_type node_structure[] = {
    {.record = {"group", "A union, for order and a common transform.", no_params},
     .number = 301, .group = GROUP_STRUCTURE, .kind = KIND_GROUP, .exactness = BOUND,
     .lipschitz = 1, .glsl = "op_union", .words = "folder collection null parent", .source = HART},
    {.record = {"material", "Gives its material to all below it.", no_params},
     .number = 302, .group = GROUP_STRUCTURE, .kind = KIND_GROUP, .exactness = BOUND,
     .lipschitz = 1, .glsl = "op_union", .words = "paint colour color surface look",
     .source = HART},
    {.record = {"model", "An instance of a model of the scene.", PARAMS(
        {"model", PARAM_MODEL, .main = true, .doc = "Name of the model."})},
     .number = 303, .group = GROUP_STRUCTURE, .kind = KIND_MODEL, .exactness = BOUND,
     .lipschitz = 1, .glsl = "", .words = "instance copy prefab symbol component reference use",
     .source = HART},
    {.record = {"field", "A distance function written in GLSL.", PARAMS(
        {"primitive", PARAM_FUNCTION, .main = true,
         .doc = "Name of a primitive of the document; empty: the code below."},
        {"code", PARAM_CODE,
         .doc = "GLSL with a function float sdf(vec3 p): the distance, negative inside."},
        {"lipschitz", PARAM_FLOAT, .def = {1}, .min = 0, .max = LIMIT_COORDINATE,
         .above_min = true, .step = 0.1,
         .doc = "Greatest change of the code's function per unit of length."},
        {"size", PARAM_VEC3, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.1,
         .doc = "Full lengths of a box that cuts the code's shape; 0: unlimited."})},
     .number = 304, .group = GROUP_STRUCTURE, .kind = KIND_CODE, .exactness = BOUND,
     .lipschitz = 0, .glsl = "", .words = "code custom glsl function implicit own script shader",
     .source = HART},
    {.record = {.name = NULL}},
};
/* clang-format on */
