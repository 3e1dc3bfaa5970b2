/* SPDX-License-Identifier: MIT */
/* The tables beside the registry: what every node has, camera, lights, shaders, environment,
 * render settings. */
#include <string.h>

#include "equation.h"
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
     .doc = "Scales the colour. With pi, a white matt surface that faces the light is as bright " \
            "as the colour, because it reflects 1 / pi of the light in each direction."}
#define LIGHT_REACH \
    {"radius", PARAM_FLOAT, UNIT_LENGTH, .def = {0.1}, .min = 0, .max = LIMIT_COORDINATE, \
     .above_min = true, .step = 0.05, \
     .doc = "The light falls with the inverse square of the distance and is 1 at distance 1. " \
            "Below this radius it grows no more. Shadows do not depend on it."}, \
    {"range", PARAM_FLOAT, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.5, \
     .zero = "unlimited", .doc = "There is no light beyond this distance; 0: no limit."}
#define LIGHT_SHADOW \
    {"shadow", PARAM_ENUM, .choices = shadow_kinds, .def = {SHADOW_SOFT}, .group = "shadow", \
     .doc = "Kind of shadow."}, \
    {"size", PARAM_FLOAT, .def = {8}, .min = 0, .max = 1000, .above_min = true, .step = 0.5, \
     .group = "shadow", .when = "shadow=soft", \
     .doc = "Sharpness of soft shadows; a larger value is sharper. The radius has no influence."}

const struct record_type node_common_type = {"node", "What every node has.", PARAMS(
    {"name", PARAM_TEXT, .doc = "Shown instead of the id."},
    {"material", PARAM_MATERIAL,
     .doc = "Material of the node and of all nodes below it; empty: the parent's material."},
    {"visible", PARAM_BOOL, .def = {1},
     .doc = "Whether the node and all nodes below it are drawn."})};

const struct record_type transform_type = {
    "transform", "Scale, then rotation, then translation.", PARAMS(
    {"translation", PARAM_VEC3, UNIT_LENGTH, .step = 0.05, .main = true, .doc = "Moves the node."},
    {"rotation", PARAM_VEC3, UNIT_ANGLE, .step = 0.0872664625997165, .main = true,
     .doc = "Angles about X, Y and Z, applied in this order."},
    {"scale", PARAM_VEC3, .def = {1, 1, 1}, .nonzero = true, .uniform = true, .step = 0.05,
     .doc = "Factors along X, Y and Z. The distance is scaled by the smallest one."})};

const struct record_type scene_info_type = {"scene", "Properties of a scene.", PARAMS(
    {"name", PARAM_TEXT, .doc = "Title of the scene."})};

const struct record_type camera_type = {"camera", "The view of the scene.", PARAMS(
    {"type", PARAM_ENUM, .choices = camera_kinds, .doc = "Kind of projection."},
    {"position", PARAM_VEC3, UNIT_LENGTH, .def = {0, 1, 5}, .step = 0.05, .main = true,
     .doc = "Position of the eye."},
    {"target", PARAM_VEC3, UNIT_LENGTH, .step = 0.05, .main = true,
     .doc = "The point that the eye looks at."},
    {"up", PARAM_VEC3, .def = {0, 1, 0}, .direction = true, .step = 0.05,
     .doc = "Direction that is up in the picture."},
    {"fov", PARAM_FLOAT, UNIT_DEGREES, .def = {45}, .min = 1, .max = 170, .step = 1,
     .when = "type=perspective", .doc = "Full vertical angle of a perspective picture."},
    {"height", PARAM_FLOAT, UNIT_LENGTH, .def = {4}, .min = 0, .max = LIMIT_COORDINATE,
     .above_min = true, .step = 0.1, .when = "type=orthographic",
     .doc = "Full height of an orthographic picture."},
    {"aperture", PARAM_FLOAT, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.01,
     .group = "lens", .zero = "off",
     .doc = "Radius of the lens. Still pictures blur what is out of focus; 0: all is sharp."},
    {"focus", PARAM_FLOAT, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.1,
     .group = "lens", .when = "aperture!=0", .zero = "at the target",
     .doc = "Distance in focus, along the view; 0: the distance of the target."})};

const struct record_type environment_type = {
    "environment", "The surroundings of the scene, and their ambient light.", PARAMS(
    {"type", PARAM_ENUM, .choices = sky_kinds,
     .doc = "Kind: a gradient with a sun, one colour, or a picture."},
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
     .doc = "Picture by longitude and latitude, with up at the top: PNG or Radiance HDR."},
    {"rotation", PARAM_FLOAT, UNIT_ANGLE, .min = -100, .max = 100, .step = 0.0872664625997165,
     .when = "type=image", .doc = "Turns the picture about Y."},
    {"brightness", PARAM_FLOAT, .def = {1}, .min = 0, .max = 1000, .step = 0.05,
     .when = "type=image", .doc = "Scales the picture, both as background and as light."},
    {"intensity", PARAM_FLOAT, .def = {1}, .min = 0, .max = 1000, .step = 0.05,
     .doc = "Scales the ambient light of the environment."},
    {"fog", PARAM_FLOAT, .min = 0, .max = 1000, .step = 0.01,
     .group = "fog", .zero = "none",
     .doc = "Density of the fog: part of the light lost per unit of length; 0: no fog."},
    {"fog_color", PARAM_COLOR, .def = {0.7, 0.75, 0.8}, .step = 0.05, .group = "fog",
     .when = "fog!=0", .doc = "Colour of fog."},
    {"fog_height", PARAM_FLOAT, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.1,
     .group = "fog", .when = "fog!=0", .zero = "everywhere",
     .doc = "Height over which the fog thins to 1/e; 0: the density is the same everywhere."},
    {"fog_base", PARAM_FLOAT, UNIT_LENGTH, .step = 0.1,
     .group = "fog", .when = "fog_height!=0",
     .doc = "Height at which the fog has its full density."},
    {"floor", PARAM_BOOL, .group = "floor", .doc = "Whether there is an endless ground plane."},
    {"floor_height", PARAM_FLOAT, UNIT_LENGTH, .step = 0.1, .group = "floor", .when = "floor=true",
     .doc = "Height of the floor."},
    {"floor_color", PARAM_COLOR, .def = {0.6, 0.6, 0.6}, .min = 0, .max = 1, .step = 0.05,
     .group = "floor", .when = "floor=true", .doc = "Colour of the floor."},
    {"floor_reflectivity", PARAM_FLOAT, .min = 0, .max = 1, .step = 0.05,
     .group = "floor", .when = "floor=true",
     .doc = "Part of the light that the floor mirrors, seen head-on."})};

const struct record_type render_type = {"render", "How the scene becomes a picture.", PARAMS(
    {"level", PARAM_ENUM, .def = {QUALITY_STILL}, .choices = quality_names, .main = true,
     .doc = "Quality of still pictures."},
    {"samples", PARAM_INT, .def = {2}, .min = 1, .max = 4, .step = 1,
     .when = "antialiasing!=none",
     .doc = "Samples per pixel along each axis, in still pictures."},
    {"antialiasing", PARAM_ENUM, .choices = antialiasing_kinds,
     .doc = "How edges are softened. none: not at all; edges: blended with their surroundings; "
            "adaptive: all samples at edges, one elsewhere; full: all samples everywhere; auto: by "
            "the level."},
    {"transparent", PARAM_BOOL,
     .doc = "Whether pictures have an alpha channel instead of a background."},
    {"shadows", PARAM_BOOL, .def = {1}, .group = "effects", .doc = "Whether lights cast shadows."},
    {"occlusion", PARAM_BOOL, .def = {1}, .group = "effects",
     .doc = "Whether corners get less ambient light. The loss is the mean of max(0, 1 - d / t) "
            "over u from 0 to 1. There t = reach u u is a distance along the normal, and d is the "
            "distance to the scene at that point (after Evans, 2006)."},
    {"occlusion_reach", PARAM_FLOAT, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.05,
     .group = "effects", .when = "occlusion=true", .zero = "auto",
     .doc = "Greatest distance of surfaces that darken a corner; 0: 0.06 of the distance from the "
            "scene's camera to its target."},
    {"occlusion_strength", PARAM_FLOAT, .def = {0.9}, .min = 0, .max = 4, .step = 0.05,
     .group = "effects", .when = "occlusion=true",
     .doc = "Part of the ambient light that is lost where surfaces are all around."},
    {"occlusion_samples", PARAM_INT, .min = 0, .max = 16, .step = 1,
     .group = "effects", .when = "occlusion=true", .zero = "auto",
     .doc = "Number of points along the normal that occlusion samples. More points make it "
            "smoother, not darker; 0: by the level."},
    {"reflections", PARAM_BOOL, .def = {1}, .group = "effects",
     .doc = "Whether reflections show the scene."},
    {"refractions", PARAM_BOOL, .def = {1}, .group = "effects",
     .doc = "Whether the scene is visible through glass."},
    {"ray_depth", PARAM_INT, .min = 0, .max = 8, .step = 1,
     .group = "effects",
     .zero = "auto",
     .doc = "Greatest number of reflections and refractions of a ray; 0: by the level."},
    {"exposure", PARAM_FLOAT, .min = -20, .max = 20, .step = 0.1, .main = true,
     .group = "tone", .doc = "Brightness in stops: each stop doubles the light."},
    {"tone_map", PARAM_ENUM, .choices = tone_maps, .def = {TONE_ACES},
     .group = "tone", .doc = "How bright light is mapped into the range of the picture."},
    {"max_steps", PARAM_INT, .def = {256}, .min = 16, .max = 1024, .step = 16,
     .group = "limits", .doc = "Greatest number of steps of a ray."},
    {"max_distance", PARAM_FLOAT, UNIT_LENGTH, .def = {200}, .min = 0, .max = LIMIT_COORDINATE,
     .above_min = true, .step = 10, .group = "limits",
     .doc = "Greatest distance from the eye at which surfaces are drawn."})};

/* The spot's handle: on the rim of its cone at distance 1. A unit vector across the unit axis
 * (x, y, z) is (1 - x^2 / (1 - y), x, -x z / (1 - y)), but where the spot shines straight up: after
 * Frisvad, Building an orthonormal basis from a 3D unit vector without normalization, Journal of
 * Graphics Tools 16 (2012). */
#define AXIS_LENGTH "sqrt(direction.x^2 + direction.y^2 + direction.z^2)"
#define ACROSS "sin(angle)*direction.x/" AXIS_LENGTH
#define PER_REST "/(" AXIS_LENGTH " - direction.y)"
#define ON_CONE \
    "cos(angle)*direction.x/" AXIS_LENGTH " + sin(angle) - " ACROSS "*direction.x" PER_REST ", " \
    "cos(angle)*direction.y/" AXIS_LENGTH " + " ACROSS ", " \
    "cos(angle)*direction.z/" AXIS_LENGTH " - " ACROSS "*direction.z" PER_REST

const struct record_type light_types[] = {
    [LIGHT_DIRECTIONAL] = {"directional", "Parallel light from far away, like sunlight.", PARAMS(
        {"direction", PARAM_VEC3, .def = {-0.5, -0.8, -0.4}, .direction = true, .step = 0.05,
         .main = true, .doc = "Direction in which the light travels; any length but 0."},
        LIGHT_COLOR, LIGHT_SHADOW)},
    [LIGHT_POINT] = {"point", "Light from one point in all directions.", PARAMS(
        {"position", PARAM_VEC3, UNIT_LENGTH, .def = {2, 4, 3}, .step = 0.05, .main = true,
         .doc = "Where the light is."},
        LIGHT_COLOR, LIGHT_REACH, LIGHT_SHADOW)},
    [LIGHT_SPOT] = {"spot", "Light from one point into a cone.", PARAMS(
        {"position", PARAM_VEC3, UNIT_LENGTH, .def = {2, 4, 3}, .step = 0.05, .main = true,
         .doc = "Where the light is."},
        {"direction", PARAM_VEC3, .def = {-0.4, -0.8, -0.6}, .direction = true, .step = 0.05,
         .doc = "Axis of the cone, away from the light; any length but 0."},
        {"angle", PARAM_FLOAT, UNIT_ANGLE, .def = {0.5}, .min = 0.01, .max = 1.5707,
         .step = 0.0872664625997165, .handle = ON_CONE, .doc = "Half the angle of the cone."},
        {"softness", PARAM_FLOAT, .def = {0.2}, .min = 0, .max = 1, .step = 0.05,
         .doc = "Part of the angle over which the light fades towards the rim."},
        LIGHT_COLOR, LIGHT_REACH, LIGHT_SHADOW)},
    [LIGHT_KIND_COUNT] = {.name = NULL},
};

/* What light that enters a surface meets inside. */
#define INSIDE(WHEN) \
    {"attenuation_color", PARAM_COLOR, .def = {1, 1, 1}, .min = 0, .max = 1, .step = 0.05, \
     .group = "optics", .when = WHEN, \
     .doc = "Colour of white light after the attenuation distance inside the material. It " \
            "colours transmitted light."}, \
    {"attenuation_distance", PARAM_FLOAT, UNIT_LENGTH, .def = {1}, .min = 0, \
     .max = LIMIT_COORDINATE, .above_min = true, .step = 0.1, \
     .group = "optics", .when = WHEN, \
     .doc = "Distance inside the material at which white light has the attenuation colour."}
#define IOR \
    {"ior", PARAM_FLOAT, .def = {1.5}, .min = 1, .max = 4, .step = 0.01, \
     .group = "optics", .means = "ior", \
     .doc = "Index of refraction, which bends transmitted light."}
#define EMISSION \
    {"emission", PARAM_COLOR, .step = 0.05, .means = "emission", \
     .doc = "Light that the surface emits, added to transmitted light."}
/* All of Blinn's and Phong's but the colour. */
#define GLOSS \
    {"ambient", PARAM_COLOR, .def = {1, 1, 1}, .min = 0, .max = 1, .step = 0.05, \
     .doc = "Part of the ambient light that the surface gets. No effect on transmitted light."}, \
    {"specular", PARAM_COLOR, .def = {0.2, 0.2, 0.2}, .min = 0, .max = 1, .step = 0.05, \
     .means = "highlight", \
     .doc = "Colour of the highlight, which is added. Its greatest brightness is 2 / pi of the " \
            "light. No effect on transmitted light."}, \
    {"shininess", PARAM_FLOAT, .def = {32}, .min = 1, .max = 2048, .step = 1, .main = true, \
     .means = "gloss", .doc = "Narrowness of the highlight."}, \
    EMISSION, \
    {"reflectivity", PARAM_FLOAT, .min = 0, .max = 1, .step = 0.05, \
     .group = "optics", .means = "mirror", \
     .doc = "Part of the light that is mirrored, seen head-on. This part is not transmitted."}, \
    IOR, \
    {"opacity", PARAM_FLOAT, .def = {1}, .min = 0, .max = 1, .step = 0.05, \
     .group = "optics", .means = "opacity", \
     .doc = "Part of the light that is not transmitted; it also scales the surface's colours. " \
            "Only the attenuation changes the colour of transmitted light."}, \
    INSIDE("opacity!=1")
#define DIFFUSE \
    {"diffuse", PARAM_COLOR, .def = {0.8, 0.8, 0.8}, .min = 0, .max = 1, .step = 0.05, \
     .main = true, .means = "color", \
     .doc = "Colour of the surface. No effect on transmitted light."}

const struct record_type shader_types[] = {
    {"phong", "Matt and shiny surfaces, with highlights by the halfway vector.",
     PARAMS(DIFFUSE, GLOSS)},
    {"blinn", "Like phong, with highlights by the reflected vector.", PARAMS(DIFFUSE, GLOSS)},
    {"standard", "Physically based surfaces: metals and dielectrics, rough to smooth.", PARAMS(
        {"base_color", PARAM_COLOR, .def = {0.8, 0.8, 0.8}, .min = 0, .max = 1, .step = 0.05,
         .main = true, .means = "color",
         .doc = "Colour of the surface, or of a metal's reflection. It colours transmitted light "
                "each time that light enters."},
        {"metallic", PARAM_FLOAT, .min = 0, .max = 1, .step = 0.05,
         .means = "mirror", .doc = "From 0, dielectric, to 1, metal. Metal transmits no light."},
        {"roughness", PARAM_FLOAT, .def = {0.5}, .min = 0, .max = 1, .step = 0.05, .main = true,
         .means = "roughness",
         .doc = "From 0, a mirror, to 1, matt. Transmitted light is not blurred."},
        EMISSION, IOR,
        {"transmission", PARAM_FLOAT, .min = 0, .max = 1, .step = 0.05,
         .group = "optics", .means = "transmission",
         .doc = "Part of the light that is transmitted, as in glass."},
        INSIDE("transmission!=0"))},
    {"unlit", "One colour without lighting. It transmits no light.", PARAMS(
        {"color", PARAM_COLOR, .def = {0.8, 0.8, 0.8}, .step = 0.05, .main = true,
         .means = "color", .doc = "Colour in the picture."})},
    {"normals", "The normal as a colour, for inspection. It transmits no light.",
     PARAMS({.name = NULL})},
    {"checker", "Cubes of two colours, shiny like phong.", PARAMS(
        {"color1", PARAM_COLOR, .def = {0.8, 0.8, 0.8}, .min = 0, .max = 1, .step = 0.05,
         .main = true, .means = "color",
         .doc = "Colour of the cubes whose coordinates have an even sum. Neither colour affects "
                "transmitted light."},
        {"color2", PARAM_COLOR, .def = {0.2, 0.2, 0.2}, .min = 0, .max = 1, .step = 0.05,
         .doc = "Colour of the other cubes."},
        {"scale", PARAM_FLOAT, UNIT_LENGTH, .def = {1}, .min = 0, .max = LIMIT_COORDINATE,
         .above_min = true, .step = 0.1, .doc = "Side of a cube."},
        GLOSS)},
    {"map", "Colours by the value of a function of the place in the object, with contour lines. It "
     "transmits no light.", PARAMS(
        {"function", PARAM_EQUATION, .main = true,
         .doc = "Such as sqrt(x^2 + z^2), or an equation, of which the left side less the right "
                "one counts. Empty: y."},
        {"from", PARAM_FLOAT, .def = {-1}, .step = 0.05, .doc = "Value with the low colour."},
        {"to", PARAM_FLOAT, .def = {1}, .step = 0.05, .doc = "Value with the high colour."},
        {"low", PARAM_COLOR, .def = {0.03, 0.13, 0.42}, .min = 0, .max = 1, .step = 0.05,
         .doc = "Colour of the lowest value, and of those below."},
        {"middle", PARAM_COLOR, .def = {0.86, 0.82, 0.72}, .min = 0, .max = 1, .step = 0.05,
         .means = "color", .doc = "Colour of the value half-way."},
        {"high", PARAM_COLOR, .def = {0.52, 0.05, 0.04}, .min = 0, .max = 1, .step = 0.05,
         .doc = "Colour of the highest value, and of those above."},
        {"lines", PARAM_INT, .def = {10}, .min = 0, .max = 1000, .step = 1, .main = true,
         .doc = "Contour lines between the two values; 0 for none. One of them is at 0."},
        {"slope", PARAM_BOOL,
         .doc = "Colours by the length of the function's gradient, not by its value."}
        EQUATION_LETTERS_EACH(LETTER_ROW, "function"),
        {"roughness", PARAM_FLOAT, .def = {0.4}, .min = 0, .max = 1, .step = 0.05,
         .means = "roughness", .doc = "From 0, a mirror, to 1, matt."})},
    {.name = NULL},
};

/* What volumes have in common. */
#define DENSITY \
    {"color", PARAM_COLOR, .def = {0.9, 0.9, 0.9}, .min = 0, .max = 1, .step = 0.05, .main = true, \
     .doc = "Part of the light that is scattered; the rest is absorbed."}, \
    {"emission", PARAM_COLOR, .step = 0.05, \
     .doc = "Light emitted per unit of length at density 1."}, \
    {"density", PARAM_FLOAT, .def = {1}, .min = 0, .max = 1000, .step = 0.1, .main = true, \
     .group = "density", \
     .doc = "Part of the light that is scattered or absorbed per unit of length."}, \
    {"source", PARAM_ENUM, .choices = density_kinds, .def = {DENSITY_NOISE}, \
     .group = "density", \
     .doc = "Variation of the density: constant, noise, or distance to the scene's surfaces."}, \
    {"falloff", PARAM_FLOAT, UNIT_LENGTH, .def = {0.2}, .min = 0, .max = LIMIT_COORDINATE, \
     .step = 0.05, .group = "density", \
     .doc = "Distance from the rim inwards over which the density grows."}, \
    {"frequency", PARAM_FLOAT, .def = {1.5}, .min = 0, .max = 1000, .step = 0.1, \
     .group = "density", .when = "source=noise", \
     .doc = "Waves of noise per unit of length."}, \
    {"octaves", PARAM_INT, .def = {4}, .min = 1, .max = 8, .step = 1, .group = "density", \
     .when = "source=noise", .doc = "Layers of noise."}, \
    {"seed", PARAM_INT, .min = 0, .max = 65535, .step = 1, .group = "density", \
     .when = "source=noise", .doc = "Each number gives another noise."}, \
    {"cover", PARAM_FLOAT, .def = {0.5}, .min = 0, .max = 1, .step = 0.05, \
     .group = "density", .when = "source=noise", .doc = "Part of the volume that noise fills."}, \
    {"reach", PARAM_FLOAT, UNIT_LENGTH, .def = {0.5}, .min = 0, .max = LIMIT_COORDINATE, \
     .above_min = true, .step = 0.05, \
     .group = "density", .when = "source=field", \
     .doc = "Distance from surfaces over which the density thins to 1/e."}, \
    {"anisotropy", PARAM_FLOAT, .min = -0.95, .max = 0.95, .step = 0.05, \
     .doc = "Direction of scattering: forwards above 0, backwards below 0."}

const struct record_type volume_types[] = {
    [VOLUME_BOX] = {"box", "Smoke or cloud in a box.", PARAMS(
        {"position", PARAM_VEC3, UNIT_LENGTH, .step = 0.05, .doc = "Centre of the volume."},
        {"size", PARAM_VEC3, UNIT_LENGTH, .def = {2, 2, 2}, .min = 0, .max = LIMIT_COORDINATE,
         .above_min = true, .step = 0.05,
         .handle = "size.x/2, 0, 0; 0, size.y/2, 0; 0, 0, size.z/2", .doc = "Full lengths."},
        DENSITY)},
    [VOLUME_SPHERE] = {"sphere", "Smoke or cloud in a ball.", PARAMS(
        {"position", PARAM_VEC3, UNIT_LENGTH, .step = 0.05, .doc = "Centre of the volume."},
        {"radius", PARAM_FLOAT, UNIT_LENGTH, .def = {1}, .min = 0, .max = LIMIT_COORDINATE,
         .above_min = true, .step = 0.05, .handle = "radius, 0, 0", .doc = "Radius of the ball."},
        DENSITY)},
    [VOLUME_ELLIPSOID] = {"ellipsoid", "Smoke or cloud in an ellipsoid.",
     PARAMS(
        {"position", PARAM_VEC3, UNIT_LENGTH, .step = 0.05, .doc = "Centre of the volume."},
        {"radii", PARAM_VEC3, UNIT_LENGTH, .def = {1.5, 0.75, 1}, .min = 0,
         .max = LIMIT_COORDINATE, .above_min = true, .step = 0.05,
         .handle = "radii.x, 0, 0; 0, radii.y, 0; 0, 0, radii.z",
         .doc = "Semi-axes along X, Y and Z."},
        DENSITY)},
    [VOLUME_KIND_COUNT] = {.name = NULL},
};

const struct record_type primitive_type = {
    "primitive", "A distance function of the document.", PARAMS(
    {"params", PARAM_ROWS, .doc = "Declared parameters. Nodes set their values."},
    {"code", PARAM_CODE, .main = true,
     .doc = "GLSL with a function float sdf(vec3 p): the distance, negative inside."},
    {"lipschitz", PARAM_FLOAT, .def = {1}, .min = 0, .max = LIMIT_COORDINATE, .above_min = true,
     .step = 0.1, .doc = "Greatest change of the function per unit of length."},
    {"size", PARAM_VEC3, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.1,
     .doc = "Full lengths of a box around the origin that cuts the shape; 0: unlimited."},
    {"doc", PARAM_TEXT, .doc = "Description for users."})};

const struct record_type shader_type = {"shader", "A class of materials.", PARAMS(
    {"properties", PARAM_ROWS, .doc = "Declared properties. Materials set their values."},
    {"code", PARAM_CODE, .main = true,
     .doc = "GLSL with a function vec3 shade(FragmentProperties properties), which returns the "
            "colour. It may return Surface instead: color, metallic, roughness, reflectivity, "
            "transmission, ior, emission, absorption."},
    {"lighting", PARAM_ENUM, .choices = lighting_kinds,
     .doc = "Whether the colour is lit, or is final."},
    {"doc", PARAM_TEXT, .doc = "Description for users."})};

const struct record_type model_type = {"model", "A tree of nodes to be instanced.", PARAMS(
    {"params", PARAM_ROWS,
     .doc = "Numbers of the tree that each instance may have of its own."})};
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
