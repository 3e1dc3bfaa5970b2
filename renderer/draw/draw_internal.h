/* SPDX-License-Identifier: MIT */
/* Shared by the files that draw tiles: draw.c and its back ends. */
#ifndef RENDERER_DRAW_INTERNAL_H
#define RENDERER_DRAW_INTERNAL_H

#include "draw.h"
#include "static_programs.h"

struct draw {
    const struct gl *gl;
    bool software;
    int side;                    /* of a tile with its margin */
    bool prepared[SHADER_KINDS]; /* targets and static programs are there: */
    struct targets targets[DRAW_SETS];
    struct static_programs static_programs;
    struct fragment_targets fragment[DRAW_SETS];
    struct pass mask, count;                         /* glsl/mask_pass.glsl, glsl/rays_pass.glsl */
    struct pass resolve[SHADER_KINDS][OUTPUT_COUNT]; /* linked when first needed */
    uint64_t compilations;
    uint64_t rays[DRAW_SETS]; /* by compute shaders */
    uint64_t more_rays;       /* by others */
    uint64_t pixels;          /* by the engine, and not copied */
    struct engine_cubes *cubes;
    struct engine_pause pause;
    long kept_pixels; /* of all pictures in rounds */
};

/* What draws a picture's tiles. Each is called by the function of draw.h that is named alike. */
struct draw_backend {
    bool (*begin)(struct draw *draw, struct draw_picture *picture, const struct draw_scene *scene,
                  const struct frame_uniforms *block, struct error *err);
    void (*end)(struct draw *draw, struct draw_picture *picture);
    /* Sums of samples are kept between rounds. */
    void (*keep)(struct draw *draw, struct draw_picture *picture, struct tile region);
    /* The tile of the slot. */
    bool (*draw)(struct draw *draw, struct draw_picture *picture, const struct draw_scene *scene,
                 int slot, struct error *err);
    bool (*more)(struct draw *draw, struct draw_picture *picture, const struct draw_scene *scene,
                 int slot, struct error *err);
    bool (*wait)(struct draw *draw, struct draw_picture *picture, int slot, struct error *err);
    bool (*collect)(struct draw *draw, struct draw_picture *picture, int slot, enum aov aov,
                    uint8_t *to, size_t stride, struct error *err);
};

extern const struct draw_backend draw_compute;  /* by compute shaders */
extern const struct draw_backend draw_fragment; /* by fragment shaders */
extern const struct draw_backend draw_engine;   /* by renderer/engine */

bool draw_compute_prepare(struct draw *draw, struct error *err);
void draw_compute_finish(struct draw *draw);
bool draw_fragment_prepare(struct draw *draw, struct error *err);
void draw_fragment_finish(struct draw *draw);

/* Pixels around a tile that the passes see. */
int draw_margin(const struct render_settings *settings);
/* Where its samples lie. */
enum draw_set draw_set_of(const struct draw_picture *picture);
/* The last stage that one of the picture's outputs needs. */
enum program_stage draw_last_stage(const struct draw_picture *picture);
uint64_t draw_now_us(void);

#endif
