/* SPDX-License-Identifier: MIT */
/* The rows of the registry. Not here: the tables of camera, lights and the like (tables.c). */
#include "nodes.h"

#include <string.h>

#include "limits.h"

#define PARAMS(...) ((const struct param[]){__VA_ARGS__, {.name = NULL}})

/* Sources that many rows share. */
#define QUILEZ_DISTANCE "Inigo Quilez, Distance functions, iquilezles.org/articles/distfunctions"
#define QUILEZ_SMIN "Inigo Quilez, Smooth minimum, iquilezles.org/articles/smin"
#define QUILEZ_REPEAT "Inigo Quilez, Domain repetition, iquilezles.org/articles/sdfrepetition"
#define HART "John C. Hart, Sphere tracing, The Visual Computer 12 (1996)"

/* A length that must not be zero. */
#define SIZE UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .above_min = true, .step = 0.05
/* A length that may be zero. */
#define REACH UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.01
/* A place. */
#define PLACE UNIT_LENGTH, .step = 0.05

static const char *const kernels[] = {"quadratic", NULL};

static const struct param no_params[] = {{.name = NULL}};

/* clang-format off */
static const struct param blend_params[] = {
    {"k", PARAM_FLOAT, SIZE, .def = {0.1}, .main = true,
     .doc = "Greatest reach of the blend: nothing changes where the distances differ by more."},
    {"kernel", PARAM_ENUM, .choices = kernels, .doc = "Profile of the blend."},
    {.name = NULL},
};

static const struct node_type rows[] = {
    /* --- primitives: numbers 1 to 99 --- */
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

    /* --- operations: numbers 101 to 199 --- */
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
     .source = QUILEZ_SMIN ", quadratic polynomial"},
    {.record = {"smooth_intersection", "An intersection with softened edges.", blend_params},
     .number = 105, .group = GROUP_OPERATION, .kind = KIND_COMBINE, .exactness = BOUND,
     .lipschitz = 1, .glsl = "op_smooth_intersection", .words = "blend and common overlap",
     .source = QUILEZ_SMIN ", quadratic polynomial"},
    {.record = {"smooth_difference", "The first child minus every other, with softened edges.",
                blend_params},
     .number = 106, .group = GROUP_OPERATION, .kind = KIND_COMBINE, .exactness = BOUND,
     .lipschitz = 1, .glsl = "op_smooth_difference", .words = "blend subtract minus carve dent",
     .source = QUILEZ_SMIN ", quadratic polynomial"},

    /* --- modifiers: numbers 201 to 299 --- */
    {.record = {"round", "Grows its children outwards, so that edges become round.", PARAMS(
        {"radius", PARAM_FLOAT, REACH, .def = {0.05}, .main = true, .doc = "How far it grows."})},
     .number = 201, .group = GROUP_MODIFIER, .kind = KIND_DISTANCE, .exactness = EXACT,
     .lipschitz = 1, .glsl = "mod_round", .words = "grow offset inflate fillet soften",
     .source = QUILEZ_DISTANCE ", Rounding"},
    {.record = {"shell", "Keeps only a wall on both sides of the surface.", PARAMS(
        {"thickness", PARAM_FLOAT, SIZE, .def = {0.05}, .main = true,
         .doc = "Half of the wall: the surface to either side."})},
     .number = 202, .group = GROUP_MODIFIER, .kind = KIND_DISTANCE, .exactness = EXACT,
     .lipschitz = 1, .glsl = "mod_shell", .words = "onion hollow wall skin",
     .source = QUILEZ_DISTANCE ", Onion"},
    {.record = {"mirror", "Shows the positive side on both sides.", PARAMS(
        {"axes", PARAM_BVEC3, .def = {1, 0, 0}, .main = true, .doc = "Axes that are mirrored."})},
     .number = 203, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 1, .glsl = "dom_mirror", .words = "symmetry reflect flip",
     .source = QUILEZ_DISTANCE ", Symmetry"},
    {.record = {"repeat", "Copies its children along the axes.", PARAMS(
        {"spacing", PARAM_VEC3, SIZE, .def = {1, 1, 1}, .main = true, .doc = "Copy to copy."},
        {"count", PARAM_IVEC3, UNIT_NONE, .min = -1, .max = 10000, .step = 1, .main = true,
         .doc = "Copies along each axis, centred; 0: no repetition, -1: without end."})},
     .number = 204, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 1, .glsl = "dom_repeat", .words = "array tile grid copies pattern infinite",
     .source = QUILEZ_REPEAT},
    {.record = {"twist", "Turns each section about the Y axis by its height.", PARAMS(
        {"rate", PARAM_FLOAT, UNIT_ANGLE, .def = {1}, .min = -1000, .max = 1000, .step = 0.05,
         .main = true, .doc = "Turn for each unit of height, right-handed."})},
     .number = 205, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 0, .glsl = "dom_twist", .words = "spiral screw helix wring turn",
     .source = QUILEZ_DISTANCE ", Twist; the bound is " HART ", section 3"},

    /* --- structure: numbers 301 to 399 --- */
    {.record = {"group", "A union, for order and a common transform.", no_params},
     .number = 301, .group = GROUP_STRUCTURE, .kind = KIND_GROUP, .exactness = BOUND,
     .lipschitz = 1, .glsl = "op_union", .words = "folder collection null parent", .source = HART},
};
/* clang-format on */

const char *node_group_name(enum node_group group)
{
    static const char *const names[] = {
        [GROUP_PRIMITIVE] = "primitive",
        [GROUP_OPERATION] = "operation",
        [GROUP_MODIFIER] = "modifier",
        [GROUP_STRUCTURE] = "structure",
    };
    return names[group];
}

size_t node_type_count(void)
{
    return sizeof rows / sizeof rows[0];
}

const struct node_type *node_type_at(size_t index)
{
    return index < node_type_count() ? &rows[index] : NULL;
}

const struct node_type *node_type_find(const char *name)
{
    for (size_t i = 0; i < node_type_count(); i++) {
        if (strcmp(rows[i].record.name, name) == 0) {
            return &rows[i];
        }
    }
    return NULL;
}
