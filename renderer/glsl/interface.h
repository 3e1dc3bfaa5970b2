/* SPDX-License-Identifier: MIT */
/* What C and GLSL have in common. Each fact stands once, in a list here: C makes its enums and
 * structs of it, and interface_write the text that shaders include as "interface.glsl".
 *
 * A struct is a list of X(type, name) with types of GLSL. Its members lie as std140 wants them
 * (OpenGL 4.3, 7.6.2.2), because C aligns each as much; a struct begins with a vec3, so that it is
 * itself aligned by 16 bytes. tests/property/test_interface.c asks the driver. */
#ifndef RENDERER_INTERFACE_H
#define RENDERER_INTERFACE_H

#include <stdint.h>
#include <stdio.h>

#include "protocol/kinds.h"
#include "protocol/limits.h"

/* --- kinds --- */

/* What a ray has met: renderer/geometry.h, surface_of.glsl. */
#define GEOMETRY_SOURCES(X) X(GEOMETRY_FIELD)

#define SURFACE_MODELS(X)                                                                          \
    X(MODEL_PHONG)    /* highlights by the halfway vector */                                       \
    X(MODEL_BLINN)    /* highlights by the reflected vector */                                     \
    X(MODEL_STANDARD) /* microfacets */
/* Bits of frame.effects. */
#define FRAME_EFFECTS(X)                                                                           \
    X(EFFECT_SHADOWS, 1)                                                                           \
    X(EFFECT_REFLECTIONS, 2)                                                                       \
    X(EFFECT_REFRACTIONS, 4)                                                                       \
    X(EFFECT_SUN, 8)                                                                               \
    X(EFFECT_TRANSPARENT, 16)                                                                      \
    X(EFFECT_CURVATURE, 32) /* of surfaces is wanted */                                            \
    X(EFFECT_SECTION, 64)                                                                          \
    X(EFFECT_ESTIMATES, 128) /* some shapes estimate their distance: field_mask.glsl */            \
    X(EFFECT_RISE, 256)      /* how a field rises from its surface is looked at: shadow.glsl */
/* A field as data for an interpreter of shaders: a texture of whole numbers, four in a texel. Its
 * places are texels of a row behind each other.
 *
 *   0          first texel of the operations; of the words of tapes; first vec4 of the materials;
 *              vec4s of each
 *   1          length of the grid's unit, as bits of a float
 *   2, 4, 6    of all shapes, of the opaque ones, of the transmissive ones (field_mask): the first
 *              cube; the one that lookups begin at, counted from that, and its bits; then the
 *              latter's least coordinates on the grid
 *   cubes      each: its first child, counted from the first cube, or 0; first word of its tape;
 *              words; the field in its middle, as bits of a float
 *   operations two each: TAPE_OP_... and flags, from bit 16 on its kind in the vocabulary; slots of
 *              a and, from bit 16 on, b; of point and out; first vec4 of its numbers. Then the
 *              number that tells what is seen; operations of a loop
 *   words      four in a texel: the number of an operation; bit 30: b alone; bit 31: minus b */
#define TAPE_NUMBERS(X)                                                                            \
    X(TAPES_ROW_BITS, 11) /* of the width of the texture */                                        \
    X(TAPES_ROW, 1 << TAPES_ROW_BITS)                                                              \
    X(TAPE_INDEX, 0x3fffffff)                                                                      \
    X(TAPE_SEEN, 0x100)  /* flags: there is a number that tells what is seen; */                   \
    X(TAPE_MIXES, 0x200) /* surfaces mix */                                                        \
    X(TAPE_GRID_BITS, 24)                                                                          \
    X(TAPE_ORIGIN, 0x555555) /* where 0, 0, 0 is on the grid */                                    \
    X(TAPE_BOUND, 24)        /* operations that take longer than more steps by a bound */          \
    X(TAPE_AHEAD, 6)         /* vec4s of a shape that are read ahead, */                           \
    X(TAPE_AHEAD_OTHERS, 4)  /* and of other operations: all of theirs */                          \
    X(TAPE_SPACES, 2)        /* the texel of the first space */                                    \
    X(TAPE_SPACE_TEXELS, 2)
#define TAPE_OPS(X)                                                                                \
    X(TAPE_OP_EMPTY)                                                                               \
    X(TAPE_OP_SHAPE)                                                                               \
    X(TAPE_OP_COMBINE)                                                                             \
    X(TAPE_OP_DISTANCE)                                                                            \
    X(TAPE_OP_TRANSFORM)                                                                           \
    X(TAPE_OP_WARP)                                                                                \
    X(TAPE_OP_AFTER)                                                                               \
    X(TAPE_OP_LOOP)                                                                                \
    X(TAPE_OP_LOOP_END)
/* The samples that a dispatch is for. */
#define PASS_MODES(X)                                                                              \
    X(PASS_TILE)   /* all of the tile's */                                                         \
    X(PASS_COARSE) /* one for each block: march alone */                                           \
    X(PASS_LIST)   /* those of a list: group.glsl */
/* What a ray through transmissive objects does next: transmission_pass.glsl. */
#define TRANSMISSION_PHASES(X)                                                                     \
    X(TRANSMISSION_AIM)  /* it is sent towards the light */                                        \
    X(TRANSMISSION_STEP) /* through the surface that it met */                                     \
    X(TRANSMISSION_END)  /* the same for the last time */

/* What becomes of a pixel: outputs.glsl. RAW: numbers, instead of colours for a screen. */
#define OUTPUTS(X)                                                                                 \
    X(OUT_COLOR)                                                                                   \
    X(OUT_LINEAR)                                                                                  \
    X(OUT_DEPTH)                                                                                   \
    X(OUT_NORMAL)                                                                                  \
    X(OUT_NORMAL_RAW)                                                                              \
    X(OUT_POSITION)                                                                                \
    X(OUT_ID)                                                                                      \
    X(OUT_ID_RAW)                                                                                  \
    X(OUT_STEPS)                                                                                   \
    X(OUT_STEPS_RAW)                                                                               \
    X(OUT_ALBEDO)                                                                                  \
    X(OUT_ALBEDO_RAW)                                                                              \
    X(OUT_SPECULAR)                                                                                \
    X(OUT_SPECULAR_RAW)                                                                            \
    X(OUT_OPTICAL)                                                                                 \
    X(OUT_OPTICAL_RAW)                                                                             \
    X(OUT_SHADOW)                                                                                  \
    X(OUT_SHADOW_RAW)                                                                              \
    X(OUT_OCCLUSION)                                                                               \
    X(OUT_OCCLUSION_RAW)

/* --- bindings --- */

#define UNIFORM_BLOCKS(X) X(BINDING_FRAME) X(BINDING_PARAMS)
#define STORAGE_BLOCKS(X) X(BINDING_LIST) X(BINDING_NEXT) X(BINDING_STACK)
/* Textures that are read. */
#define TEXTURE_UNITS(X)                                                                           \
    X(UNIT_GEOMETRY)                                                                               \
    X(UNIT_MATERIAL0)                                                                              \
    X(UNIT_MATERIAL1)                                                                              \
    X(UNIT_PARAMS)                                                                                 \
    X(UNIT_TOTAL)                                                                                  \
    X(UNIT_RAY_ORIGIN)                                                                             \
    X(UNIT_RAY_DIRECTION)                                                                          \
    X(UNIT_VISIBILITY)                                                                             \
    X(UNIT_ENVIRONMENT_MAP)                                                                        \
    X(UNIT_SPECULAR_MAP)                                                                           \
    X(UNIT_IRRADIANCE_MAP)                                                                         \
    X(UNIT_INSCATTERING)                                                                           \
    X(UNIT_STEPS)                                                                                  \
    X(UNIT_PIXELS)                                                                                 \
    X(UNIT_COUNTED)                                                                                \
    X(UNIT_STARTS)                                                                                 \
    X(UNIT_MASK)                                                                                   \
    X(UNIT_NORMAL)                                                                                 \
    X(UNIT_DIFFUSE)                                                                                \
    X(UNIT_SPECULAR)                                                                               \
    X(UNIT_OPTICAL)                                                                                \
    X(UNIT_LIGHTS)                                                                                 \
    X(UNIT_TAPES)
/* Images that are written. There may be but eight at once, so the passes with a field in them, the
 * others, and those that make environments have sets of their own. */
#define FIELD_IMAGES(X)                                                                            \
    X(IMAGE_GEOMETRY)                                                                              \
    X(IMAGE_MATERIAL0)                                                                             \
    X(IMAGE_MATERIAL1)                                                                             \
    X(IMAGE_STEPS)                                                                                 \
    X(IMAGE_STARTS)                                                                                \
    X(IMAGE_VISIBILITY)                                                                            \
    X(IMAGE_INSCATTERING)
#define STATIC_IMAGES(X)                                                                           \
    X(IMAGE_RAY_ORIGIN)                                                                            \
    X(IMAGE_RAY_DIRECTION)                                                                         \
    X(IMAGE_THROUGHPUT)                                                                            \
    X(IMAGE_ABSORPTION)                                                                            \
    X(IMAGE_TOTAL)                                                                                 \
    X(IMAGE_STATIC_VISIBILITY)                                                                     \
    X(IMAGE_PIXELS)                                                                                \
    X(IMAGE_COUNTED)
/* What sample_pass.glsl writes, and the textures are read as afterwards. X(name, unit) */
#define SAMPLE_TEXTURES(X)                                                                         \
    X(SAMPLE_PIXELS, UNIT_PIXELS)                                                                  \
    X(SAMPLE_COUNTED, UNIT_COUNTED)                                                                \
    X(SAMPLE_GEOMETRY, UNIT_GEOMETRY)                                                              \
    X(SAMPLE_NORMAL, UNIT_NORMAL)                                                                  \
    X(SAMPLE_DIFFUSE, UNIT_DIFFUSE)                                                                \
    X(SAMPLE_SPECULAR, UNIT_SPECULAR)                                                              \
    X(SAMPLE_OPTICAL, UNIT_OPTICAL)                                                                \
    X(SAMPLE_LIGHTS, UNIT_LIGHTS)

/* --- the uniform block of a picture --- */

#define LIGHT_MEMBERS(X)                                                                           \
    X(vec3, position)   /* of a directional one: the direction towards it */                       \
    X(int, kind)        /* LIGHT_... */                                                            \
    X(vec3, color)      /* times intensity */                                                      \
    X(int, shadow)      /* SHADOW_... */                                                           \
    X(vec3, axis)       /* of a cone, away from the light, of length 1 */                          \
    X(float, radius)    /* nearer it does not grow by the inverse square */                        \
    X(float, range)     /* where it ends; 0: nowhere */                                            \
    X(float, sharpness) /* of the soft shadow */                                                   \
    X(float, rim_cosine)                                                                           \
    X(float, fade_cosine) /* where light begins to fade to the rim */

#define VOLUME_MEMBERS(X)                                                                          \
    X(vec3, center)                                                                                \
    X(int, kind)    /* VOLUME_BOX or VOLUME_ELLIPSOID */                                           \
    X(vec3, extent) /* half lengths, or radii */                                                   \
    X(float, falloff)                                                                              \
    X(vec3, color)                                                                                 \
    X(float, density)                                                                              \
    X(vec3, emission)                                                                              \
    X(float, anisotropy)                                                                           \
    X(int, source) /* DENSITY_... */                                                               \
    X(int, octaves)                                                                                \
    X(int, seed)                                                                                   \
    X(float, frequency)                                                                            \
    X(float, threshold) /* height of waves above which noise fills it */                           \
    X(float, reach)     /* of a density by the field */

#define CAMERA_MEMBERS(X)                                                                          \
    X(vec3, eye)                                                                                   \
    X(int, orthographic)                                                                           \
    X(vec3, forward)                                                                               \
    X(float, pixel_radius) /* per unit of distance, or absolute if orthographic */                 \
    X(vec3, right)         /* half the picture's width, at distance 1 if perspective */            \
    X(float, lens_radius)                                                                          \
    X(vec3, up) /* half the picture's height */                                                    \
    X(float, focus_distance)                                                                       \
    X(ivec2, size) /* of the picture, in pixels */

#define FRAME_MEMBERS(X)                                                                           \
    X(vec3, bounds_min) /* nothing is outside of these */                                          \
    X(float, exposure)                                                                             \
    X(vec3, bounds_max)                                                                            \
    X(float, max_distance)    /* along a ray */                                                    \
    X(vec3, transmissive_min) /* what light goes through is inside of these */                     \
    X(int, has_transmissive)                                                                       \
    X(vec3, transmissive_max)                                                                      \
    X(float, min_throughput) /* what a reflected or refracted ray adds at least */                 \
    X(vec3, section_normal)  /* of length 1: what is beyond this plane is cut off */               \
    X(float, section_offset)                                                                       \
    X(vec3, zenith)   /* the colour of a solid environment */                                      \
    X(float, ambient) /* intensity of the environment's light */                                   \
    X(vec3, horizon)                                                                               \
    X(float, occlusion_reach)                                                                      \
    X(vec3, ground)                                                                                \
    X(float, occlusion_strength)                                                                   \
    X(vec3, fog_color)                                                                             \
    X(float, fog_density)                                                                          \
    X(vec2, sky_rotation) /* cosine and sine of the picture's rotation */                          \
    X(float, sky_brightness)                                                                       \
    X(float, fog_thinning) /* 1 / height; 0: it does not thin */                                   \
    X(float, fog_base)                                                                             \
    X(int, samples) /* of a pixel */                                                               \
    X(int, max_steps)                                                                              \
    X(int, shadow_steps)                                                                           \
    X(int, occlusion_samples)                                                                      \
    X(int, ray_depth)                                                                              \
    X(int, volume_steps)                                                                           \
    X(int, volume_light_steps)                                                                     \
    X(int, effects)  /* EFFECT_... bits */                                                         \
    X(int, sky_kind) /* SKY_... */                                                                 \
    X(int, tone_map) /* TONE_... */                                                                \
    X(int, light_count)                                                                            \
    X(int, volume_count)

/* --- arguments of a dispatch --- */

#define DISPATCH_MEMBERS(X)                                                                        \
    X(ivec2, origin) /* first pixel of the tile, with its margin */                                \
    X(int, mode)     /* PASS_... */                                                                \
    X(int, zero)     /* always 0, so that loops starting there are not unrolled */

/* The arguments of each pass, all of them integers. X(name). */
#define SAMPLE_ARGS(X)                                                                             \
    X(sample_index) /* of its pixel */                                                             \
    X(first)        /* the rays come from the camera */
#define TRANSMISSION_ARGS(X)                                                                       \
    X(light)                                                                                       \
    X(phase) /* TRANSMISSION_... */
#define SHADE_ARGS(X)                                                                              \
    X(first)                                                                                       \
    X(last)    /* no rays follow */                                                                \
    X(volumes) /* there are volumes */
#define ACCUMULATE_ARGS(X) X(sample_index)
#define LISTING_ARGS(X)                                                                            \
    X(width)                                                                                       \
    X(height)  /* of the tile with its margin */                                                   \
    X(samples) /* that a listed pixel has had */
#define RESOLVE_ARGS(X)                                                                            \
    X(margin)                                                                                      \
    X(blend_edges)
#define TRACE_ARGS(X)                                                                              \
    X(sample_index)                                                                                \
    X(rays)    /* after the first */                                                               \
    X(depth)   /* surfaces between what is met and a light */                                      \
    X(shadows) /* shadows are wanted, */                                                           \
    X(lights)  /* light too */                                                                     \
    X(masked)  /* for the pixels of a mask */

/* --- the same in C --- */

#define INTERFACE_vec2(name) _Alignas(8) float name[2];
#define INTERFACE_vec3(name) _Alignas(16) float name[3];
#define INTERFACE_float(name) float name;
#define INTERFACE_int(name) int32_t name;
#define INTERFACE_ivec2(name) _Alignas(8) int32_t name[2];
#define INTERFACE_MEMBER(type, name) INTERFACE_##type(name)
#define INTERFACE_NAME(name) name,
#define INTERFACE_FIRST(name, ...) name,
#define INTERFACE_VALUE(name, value) name = (value),
#define INTERFACE_ARG(name) int32_t name;

enum geometry_source { GEOMETRY_SOURCES(INTERFACE_NAME) };
enum surface_model { SURFACE_MODELS(INTERFACE_NAME) };
enum { FRAME_EFFECTS(INTERFACE_VALUE) };
enum { TAPE_NUMBERS(INTERFACE_VALUE) };
enum tape_op { TAPE_OPS(INTERFACE_NAME) };
enum pass_mode { PASS_MODES(INTERFACE_NAME) };
enum { TRANSMISSION_PHASES(INTERFACE_NAME) };
enum output { OUTPUTS(INTERFACE_NAME) OUTPUT_COUNT };
enum { UNIFORM_BLOCKS(INTERFACE_NAME) };
enum { STORAGE_BLOCKS(INTERFACE_NAME) };
enum { TEXTURE_UNITS(INTERFACE_NAME) UNIT_COUNT };
enum { FIELD_IMAGES(INTERFACE_NAME) };
enum { STATIC_IMAGES(INTERFACE_NAME) };
enum { SAMPLE_TEXTURES(INTERFACE_FIRST) SAMPLE_TEXTURE_COUNT };
enum {
    GROUP_SIZE = 64, /* of a work group: GROUP_SIDE x GROUP_SIDE samples */
    GROUP_SIDE = 8,  /* samples that one work group covers: group.glsl */
    BLOCK_BITS = 3,
    BLOCK_SIDE = 1 << BLOCK_BITS, /* pixels that share a start: march_pass.glsl */
    PARAMS_ROW = 256,             /* vec4s in a row of the texture of params.glsl */
    STACK_DEPTH = 8,              /* rays of a sample that wait: stack.glsl */
    SPECULAR_LEVELS = 4,          /* of roughness, in the specular map */
    DISPATCH_LOCATION = 0,        /* the first one of struct Dispatch, */
    ARGS_LOCATION = 4,            /* of a pass's args */
    LOCATION_COUNT = 10,          /* of both together */
};

struct frame_light {
    LIGHT_MEMBERS(INTERFACE_MEMBER)
};
struct frame_volume {
    VOLUME_MEMBERS(INTERFACE_MEMBER)
};
struct frame_camera {
    CAMERA_MEMBERS(INTERFACE_MEMBER)
};
struct frame_uniforms {
    struct frame_camera camera;
    FRAME_MEMBERS(INTERFACE_MEMBER)
    struct frame_light lights[LIMIT_LIGHTS];
    struct frame_volume volumes[LIMIT_VOLUMES];
};

struct sample_args {
    SAMPLE_ARGS(INTERFACE_ARG)
};
struct transmission_args {
    TRANSMISSION_ARGS(INTERFACE_ARG)
};
struct shade_args {
    SHADE_ARGS(INTERFACE_ARG)
};
struct accumulate_args {
    ACCUMULATE_ARGS(INTERFACE_ARG)
};
struct listing_args {
    LISTING_ARGS(INTERFACE_ARG)
};
struct resolve_args {
    RESOLVE_ARGS(INTERFACE_ARG)
};
struct trace_args {
    TRACE_ARGS(INTERFACE_ARG)
};

/* The number that stands for a binding, unit or location in texts: "UNIT_MASK". -1: none does. */
int interface_place(const char *name);
/* The text of "interface.glsl". */
void interface_write(FILE *out);
/* The same for a program without uniforms: `frame` is a constant, `camera` and `dispatch`
 * are variables that begin with this picture's values. */
void interface_write_constant(FILE *out, const struct frame_uniforms *row);
/* A number as GLSL writes it; TYPE(a, b, ...). */
void interface_write_float(FILE *out, float value);
void interface_write_floats(FILE *out, const char *type, const float *values, int count);

#endif
