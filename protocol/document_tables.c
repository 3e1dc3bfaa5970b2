/* SPDX-License-Identifier: MIT */
/* The tables beside the registry: what every node has, camera, lights, shaders, environment,
 * render settings. */
#include <string.h>

#include "kinds.h"
#include "limits.h"
#include "nodes.h"
#include "picture.h"

#define PARAMS(...) ((const struct param[]){__VA_ARGS__, {.name = NULL}})

static const char *const camera_kinds[] = {"perspective", "orthographic", NULL};
static const char *const sky_kinds[] = {SKY_KINDS(KINDS_WORD) NULL};
static const char *const density_kinds[] = {DENSITY_KINDS(KINDS_WORD) NULL};
static const char *const antialiasing_kinds[] = {"auto", "none", "edges", "adaptive", "full", NULL};
static const char *const shadow_kinds[] = {SHADOW_KINDS(KINDS_WORD) NULL};
static const char *const lighting_kinds[] = {"lit", "unlit", NULL};
static const char *const tone_maps[] = {TONE_MAPS(KINDS_WORD) NULL};

/* clang-format off */
/* What the lights have in common. */
#define LIGHT_COLOR \
    {"visible", PARAM_BOOL, .def = {1}, .doc = "Whether it gives light."}, \
    {"color", PARAM_COLOR, .def = {1, 1, 1}, .step = 0.05, .doc = "Colour of the light."}, \
    {"intensity", PARAM_FLOAT, .def = {1}, .min = 0, .max = LIMIT_COORDINATE, .step = 0.1, \
     .main = true, \
     .doc = "Scales the colour. pi makes a white matt surface that faces the light as bright as " \
            "the colour: what it throws back goes to all sides, 1 / pi of it to each."}
#define LIGHT_REACH \
    {"radius", PARAM_FLOAT, UNIT_LENGTH, .def = {0.1}, .min = 0, .max = LIMIT_COORDINATE, \
     .above_min = true, .step = 0.05, \
     .doc = "Below this distance the light no longer grows with the inverse square, which is 1 " \
            "at the distance 1. Shadows do not know it: they have a size."}, \
    {"range", PARAM_FLOAT, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.5, \
     .zero = "unlimited", .doc = "Beyond this distance there is no light; 0: no limit."}
#define LIGHT_SHADOW \
    {"shadow", PARAM_ENUM, .choices = shadow_kinds, .def = {SHADOW_SOFT}, .group = "shadow", \
     .doc = "Kind of shadow."}, \
    {"size", PARAM_FLOAT, .def = {8}, .min = 0, .max = 1000, .above_min = true, .step = 0.5, \
     .group = "shadow", .when = "shadow=soft", \
     .doc = "Sharpness of soft shadows, whatever the light's radius: larger is harder."}

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
     .when = "type=perspective", .doc = "Full vertical angle of a perspective picture."},
    {"height", PARAM_FLOAT, UNIT_LENGTH, .def = {4}, .min = 0, .max = LIMIT_COORDINATE,
     .above_min = true, .step = 0.1, .when = "type=orthographic",
     .doc = "Full height of an orthographic picture."},
    {"aperture", PARAM_FLOAT, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.01,
     .group = "lens", .zero = "off",
     .doc = "Radius of the lens: what is out of focus blurs in stills; 0: all is sharp."},
    {"focus", PARAM_FLOAT, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.1,
     .group = "lens", .when = "aperture!=0", .zero = "at the target",
     .doc = "Distance along the view that is in focus; 0: the target's."})};

const struct record_type environment_type = {
    "environment", "What is around the scene, and its ambient light.", PARAMS(
    {"type", PARAM_ENUM, .choices = sky_kinds,
     .doc = "A gradient with the sun, one colour, or a picture."},
    {"zenith", PARAM_COLOR, .def = {0.12, 0.26, 0.55}, .step = 0.05, .main = true,
     .when = "type=sky", .doc = "Colour of the sky straight up."},
    {"horizon", PARAM_COLOR, .def = {0.68, 0.77, 0.86}, .step = 0.05, .main = true,
     .when = "type=sky", .doc = "Colour of the sky at the horizon."},
    {"ground", PARAM_COLOR, .def = {0.2, 0.18, 0.16}, .step = 0.05,
     .when = "type=sky", .doc = "Colour straight down."},
    {"color", PARAM_COLOR, .def = {0.05, 0.055, 0.065}, .step = 0.05,
     .when = "type=solid", .doc = "The one colour of a solid environment."},
    {"sun", PARAM_BOOL, .def = {1},
     .when = "type=sky",
     .doc = "Whether the gradient shows a sun where the first directional light comes from."},
    {"image", PARAM_ASSET,
     .when = "type=image",
     .doc = "Picture by longitude and latitude, up on top: PNG or Radiance HDR."},
    {"rotation", PARAM_FLOAT, UNIT_ANGLE, .min = -100, .max = 100, .step = 0.0872664625997165,
     .when = "type=image", .doc = "Turns the picture about Y."},
    {"brightness", PARAM_FLOAT, .def = {1}, .min = 0, .max = 1000, .step = 0.05,
     .when = "type=image", .doc = "Scales the picture, as seen and as light."},
    {"intensity", PARAM_FLOAT, .def = {1}, .min = 0, .max = 1000, .step = 0.05,
     .doc = "Scales the ambient light that it gives."},
    {"fog", PARAM_FLOAT, .min = 0, .max = 1000, .step = 0.01,
     .group = "fog", .zero = "none",
     .doc = "Density of fog: part of the light lost for each unit of length; 0: none."},
    {"fog_color", PARAM_COLOR, .def = {0.7, 0.75, 0.8}, .step = 0.05, .group = "fog",
     .when = "fog!=0", .doc = "Colour of fog."},
    {"fog_height", PARAM_FLOAT, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.1,
     .group = "fog", .when = "fog!=0", .zero = "everywhere",
     .doc = "Height over which fog thins to 1/e; 0: it is the same everywhere."},
    {"fog_base", PARAM_FLOAT, UNIT_LENGTH, .step = 0.1,
     .group = "fog", .when = "fog_height!=0", .doc = "Height at which fog has its density."},
    {"floor", PARAM_BOOL, .group = "floor", .doc = "Whether there is an endless ground plane."},
    {"floor_height", PARAM_FLOAT, UNIT_LENGTH, .step = 0.1, .group = "floor", .when = "floor=true",
     .doc = "Its height."},
    {"floor_color", PARAM_COLOR, .def = {0.6, 0.6, 0.6}, .min = 0, .max = 1, .step = 0.05,
     .group = "floor", .when = "floor=true", .doc = "Its colour."},
    {"floor_reflectivity", PARAM_FLOAT, .min = 0, .max = 1, .step = 0.05,
     .group = "floor", .when = "floor=true",
     .doc = "Part of the light that it mirrors, seen head-on."})};

const struct record_type render_type = {"render", "How the scene becomes a picture.", PARAMS(
    {"level", PARAM_ENUM, .def = {QUALITY_STILL}, .choices = quality_names, .main = true,
     .doc = "Quality of still pictures."},
    {"samples", PARAM_INT, .def = {2}, .min = 1, .max = 4, .step = 1,
     .when = "antialiasing!=none",
     .doc = "Samples for each pixel along one axis, in still pictures."},
    {"antialiasing", PARAM_ENUM, .choices = antialiasing_kinds,
     .doc = "How edges are softened: none; edges: blended with what is around them; adaptive: "
            "samples at edges, one elsewhere; full: samples everywhere; auto: as the level says."},
    {"transparent", PARAM_BOOL,
     .doc = "Whether the background is left out: pictures have an alpha channel."},
    {"shadows", PARAM_BOOL, .def = {1}, .group = "effects", .doc = "Whether lights cast shadows."},
    {"occlusion", PARAM_BOOL, .def = {1}, .group = "effects",
     .doc = "Whether ambient light is less in corners: by the mean of max(0, 1 - d / t), where d "
            "is the distance to the scene at t along the normal, over u from 0 to 1 with "
            "t = reach u u (after Evans, 2006)."},
    {"occlusion_reach", PARAM_FLOAT, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.05,
     .group = "effects", .when = "occlusion=true", .zero = "auto",
     .doc = "How far away things may be that darken a corner; 0: 0.06 of the way from the scene's "
            "camera to its target."},
    {"occlusion_strength", PARAM_FLOAT, .def = {0.9}, .min = 0, .max = 4, .step = 0.05,
     .group = "effects", .when = "occlusion=true",
     .doc = "Part of the ambient light that is kept off where things are all around."},
    {"occlusion_samples", PARAM_INT, .min = 0, .max = 16, .step = 1,
     .group = "effects", .when = "occlusion=true", .zero = "auto",
     .doc = "Places along the normal looked at for occlusion, which more of them make smoother, "
            "not darker; 0: as the level says."},
    {"reflections", PARAM_BOOL, .def = {1}, .group = "effects",
     .doc = "Whether mirrors show the scene."},
    {"refractions", PARAM_BOOL, .def = {1}, .group = "effects",
     .doc = "Whether the scene is seen through glass."},
    {"ray_depth", PARAM_INT, .min = 0, .max = 8, .step = 1,
     .group = "effects",
     .zero = "auto", .doc = "How often a ray is mirrored or broken at most; 0: as the level says."},
    {"exposure", PARAM_FLOAT, .min = -20, .max = 20, .step = 0.1, .main = true,
     .group = "tone", .doc = "Brightness in stops: one more doubles the light."},
    {"tone_map", PARAM_ENUM, .choices = tone_maps, .def = {TONE_ACES},
     .group = "tone", .doc = "How bright light is fitted into the picture."},
    {"max_steps", PARAM_INT, .def = {256}, .min = 16, .max = 1024, .step = 16,
     .group = "limits", .doc = "Steps after which a ray gives up."},
    {"max_distance", PARAM_FLOAT, UNIT_LENGTH, .def = {200}, .min = 0, .max = LIMIT_COORDINATE,
     .above_min = true, .step = 10, .group = "limits",
     .doc = "Nothing farther from the eye is seen."})};

const struct record_type light_types[] = {
    [LIGHT_DIRECTIONAL] = {"directional", "Light from far away, like the sun's.", PARAMS(
        {"direction", PARAM_VEC3, .def = {-0.5, -0.8, -0.4}, .direction = true, .step = 0.05,
         .main = true, .doc = "Where the light goes; any length but 0."},
        LIGHT_COLOR, LIGHT_SHADOW)},
    [LIGHT_POINT] = {"point", "Light from one place to all sides.", PARAMS(
        {"position", PARAM_VEC3, UNIT_LENGTH, .def = {2, 4, 3}, .step = 0.05, .main = true,
         .doc = "Where the light is."},
        LIGHT_COLOR, LIGHT_REACH, LIGHT_SHADOW)},
    [LIGHT_SPOT] = {"spot", "Light from one place into a cone.", PARAMS(
        {"position", PARAM_VEC3, UNIT_LENGTH, .def = {2, 4, 3}, .step = 0.05, .main = true,
         .doc = "Where the light is."},
        {"direction", PARAM_VEC3, .def = {-0.4, -0.8, -0.6}, .direction = true, .step = 0.05,
         .doc = "Axis of the cone, away from the light; any length but 0."},
        {"angle", PARAM_FLOAT, UNIT_ANGLE, .def = {0.5}, .min = 0.01, .max = 1.5707,
         .step = 0.0872664625997165, .doc = "Half the angle of the cone."},
        {"softness", PARAM_FLOAT, .def = {0.2}, .min = 0, .max = 1, .step = 0.05,
         .doc = "Part of the angle over which the light fades to the rim."},
        LIGHT_COLOR, LIGHT_REACH, LIGHT_SHADOW)},
    [LIGHT_KIND_COUNT] = {.name = NULL},
};

/* What light that enters a surface meets inside. */
#define INSIDE(WHEN) \
    {"attenuation_color", PARAM_COLOR, .def = {1, 1, 1}, .min = 0, .max = 1, .step = 0.05, \
     .group = "optics", .when = WHEN, \
     .doc = "What is left of white light inside, after the attenuation distance: this dyes what " \
            "goes through."}, \
    {"attenuation_distance", PARAM_FLOAT, UNIT_LENGTH, .def = {1}, .min = 0, \
     .max = LIMIT_COORDINATE, .above_min = true, .step = 0.1, \
     .group = "optics", .when = WHEN, \
     .doc = "Way inside after which the attenuation colour is left."}
#define IOR \
    {"ior", PARAM_FLOAT, .def = {1.5}, .min = 1, .max = 4, .step = 0.01, \
     .group = "optics", .means = "ior", .doc = "Index of refraction: bends what goes through."}
#define EMISSION \
    {"emission", PARAM_COLOR, .step = 0.05, .means = "emission", \
     .doc = "Light that the surface gives by itself, besides what goes through."}
/* All of Blinn's and Phong's but the colour. */
#define GLOSS \
    {"ambient", PARAM_COLOR, .def = {1, 1, 1}, .min = 0, .max = 1, .step = 0.05, \
     .doc = "Part of the environment's light that is taken up; nothing to what goes through."}, \
    {"specular", PARAM_COLOR, .def = {0.2, 0.2, 0.2}, .min = 0, .max = 1, .step = 0.05, \
     .means = "highlight", \
     .doc = "Colour of the highlight, which adds up to the rest: 2 / pi of the light where it is " \
            "brightest; it takes nothing from what goes through."}, \
    {"shininess", PARAM_FLOAT, .def = {32}, .min = 1, .max = 2048, .step = 1, .main = true, \
     .means = "gloss", .doc = "Narrowness of the highlight."}, \
    EMISSION, \
    {"reflectivity", PARAM_FLOAT, .min = 0, .max = 1, .step = 0.05, \
     .group = "optics", .means = "mirror", \
     .doc = "Part of the light that is mirrored, seen head-on; it does not go through."}, \
    IOR, \
    {"opacity", PARAM_FLOAT, .def = {1}, .min = 0, .max = 1, .step = 0.05, \
     .group = "optics", .means = "opacity", \
     .doc = "Part of the light that does not go through. The rest keeps its colour, but for " \
            "what the attenuation takes; the surface's own colours count by this part."}, \
    INSIDE("opacity!=1")
#define DIFFUSE \
    {"diffuse", PARAM_COLOR, .def = {0.8, 0.8, 0.8}, .min = 0, .max = 1, .step = 0.05, \
     .main = true, .means = "color", \
     .doc = "Colour of the surface; it does not dye what goes through."}

const struct record_type shader_types[] = {
    {"phong", "Matt and shiny surfaces after Blinn and Phong: highlights by the halfway vector.",
     PARAMS(DIFFUSE, GLOSS)},
    {"blinn", "The same with highlights by the reflected vector.", PARAMS(DIFFUSE, GLOSS)},
    {"standard", "Physically based surfaces: metals and everything else, rough to smooth.", PARAMS(
        {"base_color", PARAM_COLOR, .def = {0.8, 0.8, 0.8}, .min = 0, .max = 1, .step = 0.05,
         .main = true, .means = "color",
         .doc = "Colour of the surface; of a metal's mirror image. It dyes light that goes "
                "through, each time it enters."},
        {"metallic", PARAM_FLOAT, .min = 0, .max = 1, .step = 0.05,
         .means = "mirror", .doc = "From 0, no metal, to 1, metal, which nothing goes through."},
        {"roughness", PARAM_FLOAT, .def = {0.5}, .min = 0, .max = 1, .step = 0.05, .main = true,
         .means = "roughness",
         .doc = "From 0, a mirror, to 1, matt; what goes through is not blurred."},
        EMISSION, IOR,
        {"transmission", PARAM_FLOAT, .min = 0, .max = 1, .step = 0.05,
         .group = "optics", .means = "transmission",
         .doc = "Part of the light that enters and goes through, as in glass."},
        INSIDE("transmission!=0"))},
    {"unlit", "One colour, whatever the light, of which nothing goes through.", PARAMS(
        {"color", PARAM_COLOR, .def = {0.8, 0.8, 0.8}, .step = 0.05, .main = true,
         .means = "color", .doc = "What is seen."})},
    {"normals", "The normal as a colour, for looking at shapes; nothing goes through.",
     PARAMS({.name = NULL})},
    {"checker", "Two colours in cubes, shiny like phong.", PARAMS(
        {"color1", PARAM_COLOR, .def = {0.8, 0.8, 0.8}, .min = 0, .max = 1, .step = 0.05,
         .main = true, .means = "color",
         .doc = "Colour of the cubes whose places add up to an even number; neither dyes what goes "
                "through."},
        {"color2", PARAM_COLOR, .def = {0.2, 0.2, 0.2}, .min = 0, .max = 1, .step = 0.05,
         .doc = "Colour of the others."},
        {"scale", PARAM_FLOAT, UNIT_LENGTH, .def = {1}, .min = 0, .max = LIMIT_COORDINATE,
         .above_min = true, .step = 0.1, .doc = "Side of a cube."},
        GLOSS)},
    {.name = NULL},
};

/* What volumes have in common. */
#define DENSITY \
    {"color", PARAM_COLOR, .def = {0.9, 0.9, 0.9}, .min = 0, .max = 1, .step = 0.05, .main = true, \
     .doc = "Part of the light that is scattered, not swallowed."}, \
    {"emission", PARAM_COLOR, .step = 0.05, \
     .doc = "Light given by each unit of length at density 1."}, \
    {"density", PARAM_FLOAT, .def = {1}, .min = 0, .max = 1000, .step = 0.1, .main = true, \
     .group = "density", .doc = "Part of the light met for each unit of length."}, \
    {"source", PARAM_ENUM, .choices = density_kinds, .def = {DENSITY_NOISE}, \
     .group = "density", \
     .doc = "What the density follows: nothing, noise, or the distance to the scene's surfaces."}, \
    {"falloff", PARAM_FLOAT, UNIT_LENGTH, .def = {0.2}, .min = 0, .max = LIMIT_COORDINATE, \
     .step = 0.05, .group = "density", \
     .doc = "Way from the rim inwards on which the density grows."}, \
    {"frequency", PARAM_FLOAT, .def = {1.5}, .min = 0, .max = 1000, .step = 0.1, \
     .group = "density", .when = "source=noise", \
     .doc = "Waves of noise for each unit of length."}, \
    {"octaves", PARAM_INT, .def = {4}, .min = 1, .max = 8, .step = 1, .group = "density", \
     .when = "source=noise", .doc = "Layers of noise."}, \
    {"seed", PARAM_INT, .min = 0, .max = 65535, .step = 1, .group = "density", \
     .when = "source=noise", .doc = "Which noise."}, \
    {"cover", PARAM_FLOAT, .def = {0.5}, .min = 0, .max = 1, .step = 0.05, \
     .group = "density", .when = "source=noise", .doc = "Part of the volume that noise fills."}, \
    {"reach", PARAM_FLOAT, UNIT_LENGTH, .def = {0.5}, .min = 0, .max = LIMIT_COORDINATE, \
     .above_min = true, .step = 0.05, \
     .group = "density", .when = "source=field", \
     .doc = "Distance from surfaces over which a density by field thins to 1/e."}, \
    {"anisotropy", PARAM_FLOAT, .min = -0.95, .max = 0.95, .step = 0.05, \
     .doc = "Above 0 light is scattered forwards, below 0 backwards."}

const struct record_type volume_types[] = {
    [VOLUME_BOX] = {"box", "Smoke or cloud in a box.", PARAMS(
        {"position", PARAM_VEC3, UNIT_LENGTH, .step = 0.05, .doc = "Its centre."},
        {"size", PARAM_VEC3, UNIT_LENGTH, .def = {2, 2, 2}, .min = 0, .max = LIMIT_COORDINATE,
         .above_min = true, .step = 0.05, .doc = "Full lengths."},
        DENSITY)},
    [VOLUME_SPHERE] = {"sphere", "Smoke or cloud in a ball.", PARAMS(
        {"position", PARAM_VEC3, UNIT_LENGTH, .step = 0.05, .doc = "Its centre."},
        {"radius", PARAM_FLOAT, UNIT_LENGTH, .def = {1}, .min = 0, .max = LIMIT_COORDINATE,
         .above_min = true, .step = 0.05, .doc = "Its radius."},
        DENSITY)},
    [VOLUME_ELLIPSOID] = {"ellipsoid", "Smoke or cloud in a ball with three radii of its own.",
     PARAMS(
        {"position", PARAM_VEC3, UNIT_LENGTH, .step = 0.05, .doc = "Its centre."},
        {"radii", PARAM_VEC3, UNIT_LENGTH, .def = {1.5, 0.75, 1}, .min = 0,
         .max = LIMIT_COORDINATE, .above_min = true, .step = 0.05,
         .doc = "Semi-axes along X, Y and Z."},
        DENSITY)},
    [VOLUME_KIND_COUNT] = {.name = NULL},
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
     .doc = "GLSL with a function vec3 shade(FragmentProperties properties): the colour; or one "
            "that returns Surface: all of color, metallic, roughness, reflectivity, transmission, "
            "ior, emission, absorption."},
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
