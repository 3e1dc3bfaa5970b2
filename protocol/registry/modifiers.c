/* SPDX-License-Identifier: MIT */
/* Registry: modifiers. */
#include "rows.h"

/* Handles. The first copy on the positive side: a space away, or half of one where copies are even;
 * none (0/0) where there is one. Handles of the other axes are ASIDE, each on a copy of its own. */
#define EVEN(X) "((1 + cos(pi*count." X "))/2 - 0^(count." X "^2))"
#define ASIDE(X) "-spacing." X "*" EVEN(X) "/2"
#define COPY(X) "spacing." X "*(1 - " EVEN(X) "/2) + 0/(count." X "*(count." X " - 1))"
/* The end of half a wave along each axis. */
#define WAVES "pi/frequency.x, 0, 0; 0, pi/frequency.y, 0; 0, 0, pi/frequency.z"

/* clang-format off */
const struct node_type node_modifiers[] = {
    {.record = {"round", "Grows its children outwards, so that edges become round.", PARAMS(
        {"radius", PARAM_FLOAT, REACH, .def = {0.05}, .main = true, .handle = OUT("radius"),
         .doc = "Distance of growth."})},
     .number = 201, .group = GROUP_MODIFIER, .kind = KIND_DISTANCE, .exactness = EXACT,
     .lipschitz = 1, .glsl = "mod_round", .words = "grow offset inflate fillet soften",
     .source = QUILEZ_DISTANCE ", Rounding"},
    {.record = {"shell", "Keeps a wall on both sides of the surface.", PARAMS(
        {"thickness", PARAM_FLOAT, SIZE, .def = {0.05}, .main = true, .handle = OUT("thickness"),
         .doc = "Half of the thickness of the wall."})},
     .number = 202, .group = GROUP_MODIFIER, .kind = KIND_DISTANCE, .exactness = EXACT,
     .lipschitz = 1, .glsl = "mod_shell", .words = "onion hollow wall skin",
     .source = QUILEZ_DISTANCE ", Onion"},
    {.record = {"mirror", "Mirrors the positive side to the negative side.", PARAMS(
        {"axes", PARAM_BVEC3, .def = {1, 0, 0}, .main = true, .doc = "Axes that are mirrored."})},
     .number = 203, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 1, .glsl = "dom_mirror", .words = "symmetry reflect flip",
     .source = QUILEZ_DISTANCE ", Symmetry"},
    {.record = {"repeat", "Copies its children along the axes.", PARAMS(
        {"spacing", PARAM_VEC3, SIZE, .def = {1, 1, 1}, .main = true,
         .handle = COPY("x") ", " ASIDE("y") ", " ASIDE("z") "; "
                   ASIDE("x") ", " COPY("y") ", " ASIDE("z") "; "
                   ASIDE("x") ", " ASIDE("y") ", " COPY("z"),
         .doc = "Distance between copies."},
        {"count", PARAM_IVEC3, UNIT_NONE, .min = -1, .max = 10000, .step = 1, .main = true,
         .doc = "Number of copies along each axis, centred; 0: no repetition, -1: endless."})},
     .number = 204, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 1, .glsl = "dom_repeat", .words = "array tile grid copies pattern infinite",
     .source = QUILEZ_REPEAT},
    {.record = {"repeat_polar", "Copies its children around the Y axis, from +X.", PARAMS(
        {"count", PARAM_INT, .def = {6}, .min = 1, .max = 1000, .step = 1, .main = true,
         .doc = "Number of copies, at equal angles."},
        {"radius", PARAM_FLOAT, REACH, .def = {1}, .main = true,
         .handle = "radius, 0, 0", .doc = "Distance of each copy from the axis."})},
     .number = 210, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 1, .glsl = "dom_repeat_polar", .words = "array circular radial ring around",
     .source = QUILEZ_REPEAT},
    {.record = {"twist", "Turns each section about the Y axis by its height.", PARAMS(
        {"rate", PARAM_FLOAT, UNIT_ANGLE, .def = {1}, .min = -1000, .max = 1000, .step = 0.05,
         .main = true,
         .handle = "cos(rate), 1, -sin(rate)",
         .doc = "Turn for each unit of height, right-handed."})},
     .number = 205, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 0, .glsl = "dom_twist", .words = "spiral screw helix wring turn",
     .source = QUILEZ_DISTANCE ", Twist; the bound is " HART ", section 3"},
    {.record = {"bend", "Turns each section about the Z axis by its place along X.", PARAMS(
        {"rate", PARAM_FLOAT, UNIT_ANGLE, .def = {0.5}, .min = -1000, .max = 1000, .step = 0.05,
         .main = true,
         .handle = "1/2, sin(rate/2)/cos(rate/2)/2, 0",
         .doc = "Turn for each unit of X, right-handed."})},
     .number = 207, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 0, .glsl = "dom_bend", .words = "curve arch bow fold",
     .source = QUILEZ_DISTANCE ", Bend; the bound is " HART ", section 3"},
    {.record = {"elongate", "Pulls its children apart in the middle.", PARAMS(
        {"size", PARAM_VEC3, REACH, .def = {0.2, 0, 0}, .main = true,
         .handle = "size.x, 0, 0; 0, size.y, 0; 0, 0, size.z",
         .doc = "Distance to both sides along each axis."})},
     .number = 206, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 1, .glsl = "dom_elongate", .words = "stretch lengthen extend pull",
     .source = QUILEZ_DISTANCE ", Elongation"},
    {.record = {"displace", "Waves on the surface: adds a product of three sines.", PARAMS(
        {"amplitude", PARAM_FLOAT, REACH, .def = {0.05}, .main = true, .handle = OUT("amplitude"),
         .doc = "How far the surface moves at most."},
        {"frequency", PARAM_VEC3, .def = {10, 10, 10}, .max = 1000, .uniform = true, .step = 0.5,
         .main = true, .handle = WAVES, .doc = "Radians for each unit of length."})},
     .number = 208, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 0, .glsl = "dom_displace", .words = "waves bumps displacement ripple sine",
     .source = QUILEZ_DISTANCE ", Displacement"},
    {.record = {"displace_noise", "A rough surface: adds value noise of several octaves.", PARAMS(
        {"amplitude", PARAM_FLOAT, REACH, .def = {0.1}, .main = true, .handle = OUT("amplitude"),
         .doc = "How far the surface moves at most."},
        {"frequency", PARAM_FLOAT, .def = {2}, .max = 1000, .step = 0.1, .main = true,
         .handle = "1/frequency, 0, 0",
         .doc = "Bumps for each unit of length, of the first octave."},
        {"octaves", PARAM_INT, .def = {4}, .min = 1, .max = 8, .step = 1,
         .doc = "Layers of noise; each has twice the frequency and half the height of the last."},
        {"seed", PARAM_INT, .min = 0, .max = 1000000, .step = 1,
         .doc = "Each number gives another noise."})},
     .number = 209, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 0, .glsl = "dom_displace_noise",
     .words = "rough fbm fractal random rock bumps displacement",
     .source = "Inigo Quilez, Value noise derivatives, iquilezles.org/articles/morenoise"},
    {.record = {"offset_space", "Bends space in waves: shifts each point by sines.", PARAMS(
        {"amplitude", PARAM_VEC3, UNIT_LENGTH, .def = {0.1, 0.1, 0.1}, .uniform = true,
         .step = 0.01, .main = true,
         .handle = "skin.x + amplitude.x, skin.y, skin.z; skin.x, skin.y + amplitude.y, skin.z; "
                   "skin.x, skin.y, skin.z + amplitude.z",
         .doc = "How far points are shifted at most."},
        {"frequency", PARAM_VEC3, .def = {3, 3, 3}, .min = -1000, .max = 1000, .uniform = true,
         .step = 0.1, .main = true, .handle = WAVES, .doc = "Radians for each unit of length."})},
     .number = 213, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 0, .glsl = "dom_offset_space", .words = "warp domain distort wobble waves noise",
     .source = "p + amplitude * sin(frequency * p.yzx)"},
    {.record = {"extrude", "Gives a flat shape a height along Z.", PARAMS(
        {"height", PARAM_FLOAT, SIZE, .def = {1}, .main = true,
         .handle = "0, 0, height/2", .doc = "Full length along Z, centred."},
        {"rounding", PARAM_FLOAT, REACH, .main = true,
         .handle = "skin.x - out.x*" ROUNDED("rounding") ", "
                   "skin.y - out.y*" ROUNDED("rounding") ", height/2 - " ROUNDED("rounding"),
         .doc = "Radius of the edges at both ends, inside the height; at most half of it."})},
     .number = 211, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 1, .glsl = "dom_extrude", .words = "extrusion prism thicken depth solid 2d flat",
     .source = QUILEZ_DISTANCE ", Extrusion"},
    {.record = {"revolve", "Turns a flat shape around the Y axis.", PARAMS(
        {"offset", PARAM_FLOAT, PLACE, .main = true,
         .handle = "offset, 0, 0",
         .doc = "How far the shape is moved out along X before it turns."})},
     .number = 212, .group = GROUP_MODIFIER, .kind = KIND_DOMAIN, .exactness = BOUND,
     .lipschitz = 1, .glsl = "dom_revolve", .words = "revolution lathe spin turn vase ring 2d flat",
     .source = QUILEZ_DISTANCE ", Revolution"},
    {.record = {.name = NULL}},
};
/* clang-format on */
