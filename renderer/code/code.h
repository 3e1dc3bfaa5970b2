/* SPDX-License-Identifier: MIT */
/* Code that users write: distance functions and the `shade` of their shaders, in the part of GLSL
 * that needs no state, with the spellings of HLSL and Slang (float3, lerp, frac, ...).
 *
 * Text is read into a tree, checked there (names, types, constant loop bounds, no recursion, the
 * limits of limits.h), and run from there in C. What the driver gets is written from the tree,
 * never the author's text, with every name changed, every index kept inside its array, and #line
 * directives, so that a driver's message, too, names a line of the author's.
 *
 * Pure and without GL. A struct code is immutable; any number of threads may run it. */
#ifndef RENDERER_CODE_H
#define RENDERER_CODE_H

#include <stdio.h>

#include "protocol/record.h"

enum code_use {
    CODE_DISTANCE, /* float sdf(vec3 p), or float NAME(vec3 p, Primitive3D primitive) */
    CODE_SHADE,    /* vec3, vec4 or Surface shade(FragmentProperties properties) */
};

/* `params` are those that the document declares, ending with a row whose name is NULL: float, int,
 * bool, vec2 to vec4, ivec2 to ivec4, color. Code reads them as variables of these names, which it
 * may declare once more without a value; primitive.data[i] is component i of all of them. */
struct code_source {
    enum code_use use;
    const char *text;
    const struct param *params;
    bool ours; /* not bounded by the code_* rows of limits.h: it has limits of its own */
};

struct code;
struct machine_code;

/* NULL and ERROR_COMPILE with line and column of the author's text, place empty. */
struct code *code_compile(const struct code_source *source, struct error *err);
void code_destroy(struct code *code); /* NULL: nothing */

/* Writes the GLSL of all functions, the last of which is
 *     float NAME(vec3 p, float a, vec3 b, ...)       CODE_DISTANCE
 *     vec4 NAME(Shading s, float a, vec3 b, ...)     CODE_SHADE (struct: glsl/surface.glsl), or
 *     CodeSurface NAME(Shading s, ...)               where code_gives_surface
 * with one argument for each of `params`, whole numbers and booleans as float. It calls functions
 * of glsl/code.glsl. All names begin with NAME, which has no two underscores in a row and none at
 * the end. `source_number` is what #line gives as the number of the string; lines after the text
 * are counted on from there. */
void code_write(const struct code *code, const char *name, int source_number, FILE *out);

/* The steps that it consists of (machine.h); they live as long as the code. */
const struct machine_code *code_steps(const struct code *code);
/* Loop iterations of one call, at most. */
int code_trips(const struct code *code);
/* How large it is for drivers: operations with every call written out, those that take long to
 * compile counted for more. At most LIMIT_CODE_SIZE. */
int code_size(const struct code *code);
/* Operations of one call, at most. */
int code_work(const struct code *code);

/* Where something first went wrong while running: a division by 0, which gives a very large number,
 * or a value that is no number, or infinite in a float. */
struct code_fault {
    int line, column; /* 0: nothing was wrong */
    bool infinite;    /* only that: what is made of it may well be a number */
    char message[80];
};

/* `n` are the numbers of `params` in order, vectors as several. `fault` may be NULL. */
double code_distance(const struct code *code, const double p[3], const double *n,
                     struct code_fault *fault);

/* Of CODE_SHADE: whether it returns a Surface; and whether it says how much light that lets
 * through. */
bool code_gives_surface(const struct code *code);
bool code_is_transmissive(const struct code *code);

struct code_shading {
    double world_position[3], object_position[3], world_normal[3], ray_direction[3], ray_distance;
};
void code_shade(const struct code *code, const struct code_shading *at, const double *n,
                double out_rgba[4], struct code_fault *fault);

/* What a shader says of a point: the members of surface_members (types.h), in their order. */
struct code_surface {
    double color[3], metallic, roughness, reflectivity, transmission, ior, emission[3],
        absorption[3];
};
/* Only where code_gives_surface, for which code_shade is not. */
void code_surface(const struct code *code, const struct code_shading *at, const double *n,
                  struct code_surface *out, struct code_fault *fault);

/* Asks the function about points all over a box, and along short ways there, one at a time. Callers
 * read `asked` and `points`, how many there are in all. */
struct code_probe {
    const struct code *code;
    const double *numbers;
    double low[3], size[3];
    double step;     /* of a short way */
    double greatest; /* slope */
    double lipschitz;
    int asked, points;
    bool slopes_only; /* where it gives no number is no fault; set after code_probe_begin */
};
/* `code` and `n` are borrowed as long as it asks. */
void code_probe_begin(struct code_probe *out, const struct code *code, const double *n,
                      const double low[3], const double high[3], double lipschitz);
/* One more point; not after the last one. False and `err`, with line and column, where the function
 * divides by 0 or gives no number; after the last point where it changes faster than `lipschitz`
 * allows (line and column 0 then; the message names the greatest slope seen). For CODE_SHADE: only
 * numbers. */
bool code_probe_ask(struct code_probe *probe, struct error *err);

#endif
