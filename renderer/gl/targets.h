/* SPDX-License-Identifier: MIT */
/* Textures, lists and framebuffers of the passes, all of one size, created once and used for every
 * tile. Their formats are defined only here, because some drivers recompile a program that draws
 * into another format. */
#ifndef RENDERER_TARGETS_H
#define RENDERER_TARGETS_H

#include "texture.h"

/* Of each sample: its ray, and what that met. */
struct ray_set {
    GLuint origin, direction;              /* rgba32f: glsl/ray_load.glsl */
    GLuint geometry, material0, material1; /* rgba32f, rgba32ui twice: glsl/gbuffer.glsl */
    GLuint throughput,
        absorption; /* rgba32f, rgba16f: glsl/stack.glsl, glsl/transmission_pass.glsl */
    GLuint steps;   /* rg32f: of the march, and the surface's curvature */
};

/* Lists of samples. */
enum target_list {
    LIST_EDGES, /* those that are sampled again */
    LIST_RAYS,  /* those with a reflected or refracted ray, and the next ones */
    LIST_RAYS_NEXT,
    LIST_TRANSMISSION, /* those with a ray to a light, and the next ones */
    LIST_TRANSMISSION_NEXT,
    LIST_COUNT
};

struct targets {
    int side;             /* in samples; a multiple of GROUP_SIDE */
    struct ray_set eye;   /* rays that end in the eye */
    struct ray_set light; /* rays to lights, through transmissive objects */
    GLuint starts;        /* r32f, one texel for each block of march_pass.glsl */
    GLuint visibility;    /* rgba16f, a layer for each light */
    GLuint inscattering;  /* rgba16f */
    GLuint total, pixels; /* rgba32f: light of the sample, and summed up over the pixel's */
    GLuint counted;       /* r32f: samples of the pixel */
    struct outputs outputs;
    GLuint lists[LIST_COUNT];
    GLuint stack;    /* glsl/stack.glsl */
    GLuint vertices; /* the empty vertex array that core profiles want */
};

/* Of a texture with a texel for each block of a tile. Blocks lie where they do in the picture, so a
 * tile may touch one more; whole work groups. A power of two as all sides are: llvmpipe compiles
 * again for a texture whose side is none. */
int targets_starts_side(int side);
/* For the current context: framebuffers are not shared. */
bool targets_init(struct targets *out_targets, const struct gl *gl, int side, struct error *err);
void targets_finish(struct targets *targets, const struct gl *gl);
/* Binds what all passes share. */
void targets_bind(const struct targets *targets, const struct gl *gl);
/* Binds a set for reading, and the images that passes with a field in them write. */
void targets_bind_field(const struct targets *targets, const struct gl *gl,
                        const struct ray_set *set);
/* The same for the other passes: `read` is read, `write` is written. */
void targets_bind_static(const struct targets *targets, const struct gl *gl,
                         const struct ray_set *read, const struct ray_set *write);
/* Empties a list and binds it as the one that is added to. */
void targets_begin_list(const struct targets *targets, const struct gl *gl, enum target_list list);

#endif
