/* SPDX-License-Identifier: MIT */
/* The tables beside the registry: what every node has, camera, lights, shaders, environment,
 * render settings. */
#include <string.h>

#include "limits.h"
#include "nodes.h"

#define PARAMS(...) ((const struct param[]){__VA_ARGS__, {.name = NULL}})

static const char *const camera_kinds[] = {"perspective", "orthographic", NULL};
static const char *const sky_kinds[] = {"sky", "solid", NULL};
static const char *const shadow_kinds[] = {"none", "hard", "soft", NULL};
static const char *const lighting_kinds[] = {"lit", "unlit", NULL};
static const char *const tone_maps[] = {"none", "reinhard", "aces", NULL};

/* clang-format off */
/* What the lights have in common. */
#define LIGHT_COLOR \
    {"color", PARAM_COLOR, .def = {1, 1, 1}, .step = 0.05, .doc = "Colour of the light."}, \
    {"intensity", PARAM_FLOAT, .def = {1}, .min = 0, .max = LIMIT_COORDINATE, .step = 0.1, \
     .main = true, .doc = "Scales the colour."}
#define LIGHT_SHADOW \
    {"size", PARAM_FLOAT, .def = {8}, .min = 0, .max = 1000, .above_min = true, .step = 0.5, \
     .doc = "Sharpness of soft shadows: larger is harder."}, \
    {"shadow", PARAM_ENUM, .choices = shadow_kinds, .def = {2}, .doc = "Kind of shadow."}

const struct record_type node_common_type = {"node", "What every node has.", PARAMS(
    {"name", PARAM_TEXT, .doc = "Shown instead of the id."},
    {"material", PARAM_MATERIAL,
     .doc = "Material of the node and all below it; empty: its parent's."},
    {"visible", PARAM_BOOL, .def = {1}, .doc = "Whether the node and all below it are drawn."})};

const struct record_type transform_type = {
    "transform", "Scale, then rotation, then translation.", PARAMS(
    {"translation", PARAM_VEC3, UNIT_LENGTH, .step = 0.05, .main = true, .doc = "Moves the node."},
    {"rotation", PARAM_VEC3, UNIT_ANGLE, .step = 0.0872664625997165, .main = true,
     .doc = "Angles about X, Y and Z, applied in this order."},
    {"scale", PARAM_VEC3, .def = {1, 1, 1}, .nonzero = true, .uniform = true, .step = 0.05,
     .doc = "Factors along X, Y and Z; distances shrink by the least."})};

const struct record_type scene_info_type = {"scene", "What a scene says of itself.", PARAMS(
    {"name", PARAM_TEXT, .doc = "Title of the scene."})};

const struct record_type camera_type = {"camera", "Where the scene is seen from.", PARAMS(
    {"type", PARAM_ENUM, .choices = camera_kinds, .doc = "Kind of projection."},
    {"position", PARAM_VEC3, UNIT_LENGTH, .def = {0, 1, 5}, .step = 0.05, .main = true,
     .doc = "The eye."},
    {"target", PARAM_VEC3, UNIT_LENGTH, .step = 0.05, .main = true,
     .doc = "What the eye looks at."},
    {"up", PARAM_VEC3, .def = {0, 1, 0}, .direction = true, .step = 0.05,
     .doc = "Direction that is up in the picture."},
    {"fov", PARAM_FLOAT, UNIT_DEGREES, .def = {45}, .min = 1, .max = 170, .step = 1,
     .doc = "Full vertical angle of a perspective picture."},
    {"height", PARAM_FLOAT, UNIT_LENGTH, .def = {4}, .min = 0, .max = LIMIT_COORDINATE,
     .above_min = true, .step = 0.1, .doc = "Full height of an orthographic picture."})};

const struct record_type environment_type = {
    "environment", "What is around the scene, and its ambient light.", PARAMS(
    {"type", PARAM_ENUM, .choices = sky_kinds, .doc = "A gradient, or one colour."},
    {"zenith", PARAM_COLOR, .def = {0.12, 0.26, 0.55}, .step = 0.05, .main = true,
     .doc = "Colour of the sky straight up."},
    {"horizon", PARAM_COLOR, .def = {0.68, 0.77, 0.86}, .step = 0.05, .main = true,
     .doc = "Colour of the sky at the horizon."},
    {"ground", PARAM_COLOR, .def = {0.2, 0.18, 0.16}, .step = 0.05,
     .doc = "Colour straight down."},
    {"color", PARAM_COLOR, .def = {0.05, 0.055, 0.065}, .step = 0.05,
     .doc = "The one colour of a solid environment."},
    {"intensity", PARAM_FLOAT, .def = {1}, .min = 0, .max = 1000, .step = 0.05,
     .doc = "Scales the ambient light that it gives."})};

const struct record_type render_type = {"render", "How the scene becomes a picture.", PARAMS(
    {"samples", PARAM_INT, .def = {2}, .min = 1, .max = 4, .step = 1, .main = true,
     .doc = "Samples for each pixel along one axis, in still pictures."},
    {"max_steps", PARAM_INT, .def = {256}, .min = 16, .max = 1024, .step = 16,
     .doc = "Steps after which a ray gives up."},
    {"max_distance", PARAM_FLOAT, UNIT_LENGTH, .def = {200}, .min = 0, .max = LIMIT_COORDINATE,
     .above_min = true, .step = 10, .doc = "Nothing farther from the eye is seen."},
    {"exposure", PARAM_FLOAT, .min = -20, .max = 20, .step = 0.1, .main = true,
     .doc = "Brightness in stops: one more doubles the light."},
    {"tone_map", PARAM_ENUM, .choices = tone_maps, .def = {2},
     .doc = "How bright light is fitted into the picture."})};

const struct record_type light_types[] = {
    {"directional", "Light from far away, like the sun's.", PARAMS(
        {"direction", PARAM_VEC3, .def = {-0.5, -0.8, -0.4}, .direction = true, .step = 0.05,
         .main = true, .doc = "Where the light goes; any length but 0."},
        LIGHT_COLOR, LIGHT_SHADOW)},
    {"point", "Light from one place to all sides.", PARAMS(
        {"position", PARAM_VEC3, UNIT_LENGTH, .def = {2, 4, 3}, .step = 0.05, .main = true,
         .doc = "Where the light is."},
        LIGHT_COLOR,
        {"radius", PARAM_FLOAT, UNIT_LENGTH, .def = {0.1}, .min = 0, .max = LIMIT_COORDINATE,
         .above_min = true, .step = 0.05,
         .doc = "Below this distance the light no longer grows with the inverse square."},
        {"range", PARAM_FLOAT, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.5,
         .doc = "Beyond this distance there is no light; 0: no limit."},
        LIGHT_SHADOW)},
    {.name = NULL},
};

const struct record_type shader_types[] = {
    {"phong", "Matt and shiny surfaces after Blinn and Phong.", PARAMS(
        {"ambient", PARAM_COLOR, .def = {1, 1, 1}, .min = 0, .max = 1, .step = 0.05,
         .doc = "Part of the environment's light that is taken up."},
        {"diffuse", PARAM_COLOR, .def = {0.8, 0.8, 0.8}, .min = 0, .max = 1, .step = 0.05,
         .main = true, .doc = "Colour of the surface."},
        {"specular", PARAM_COLOR, .def = {0.2, 0.2, 0.2}, .min = 0, .max = 1, .step = 0.05,
         .doc = "Colour of the highlight."},
        {"shininess", PARAM_FLOAT, .def = {32}, .min = 1, .max = 2048, .step = 1, .main = true,
         .doc = "Narrowness of the highlight."},
        {"emission", PARAM_COLOR, .step = 0.05, .doc = "Light that the surface gives by itself."})},
    {.name = NULL},
};

const struct record_type primitive_type = {
    "primitive", "A distance function of the document.", PARAMS(
    {"params", PARAM_ROWS, .doc = "Parameters that nodes give it."},
    {"code", PARAM_CODE, .main = true,
     .doc = "GLSL with a function float sdf(vec3 p): the distance, negative inside."},
    {"lipschitz", PARAM_FLOAT, .def = {1}, .min = 0, .max = LIMIT_COORDINATE, .above_min = true,
     .step = 0.1, .doc = "How much the function changes at most for each unit of length."},
    {"size", PARAM_VEC3, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.1,
     .doc = "Full lengths of a box around the origin that cuts the shape; 0: no end there."},
    {"doc", PARAM_TEXT, .doc = "What it is."})};

const struct record_type shader_type = {"shader", "A class of materials.", PARAMS(
    {"properties", PARAM_ROWS, .doc = "What its materials set."},
    {"code", PARAM_CODE, .main = true,
     .doc = "GLSL with a function vec3 shade(FragmentProperties properties): the colour."},
    {"lighting", PARAM_ENUM, .choices = lighting_kinds,
     .doc = "Whether lights fall on the colour, or it is what is seen."},
    {"doc", PARAM_TEXT, .doc = "What it is."})};

const struct record_type model_type = {"model", "A tree of nodes to be instanced.",
                                       PARAMS({.name = NULL})};
/* clang-format on */

const struct record_type *record_type_in(const struct record_type *table, const char *name)
{
    for (; table->name; table++) {
        if (strcmp(table->name, name) == 0) {
            return table;
        }
    }
    return NULL;
}
