/* SPDX-License-Identifier: MIT */
/* The measurements of `fieldcast bench`; each returns the JSON that it prints. */
#ifndef SERVER_BENCH_H
#define SERVER_BENCH_H

#include <cjson/cJSON.h>

#include "local_render.h"
#include "server/embedded.h"

enum bench_part {
    BENCH_ALL,
    BENCH_DRAWING,
    BENCH_GROWTH,
    BENCH_CHANGES,
    BENCH_STAGES,
    BENCH_PROGRAMS,
    BENCH_DOCUMENTS,
    BENCH_EDITS
};
/* The name of a part; NULL behind the last one. */
const char *bench_part_name(size_t part);

struct bench_effort {
    int rounds;     /* of each measurement; the median counts */
    int scale_down; /* divides the sides of pictures */
};

/* Sorts `count` numbers and returns their quantile (0.5: the median). */
double bench_quantile(double *numbers, size_t count, double quantile);
/* Adds a number, rounded to three decimals. */
void bench_add(cJSON *object, const char *name, double value);
double bench_number(const cJSON *object, const char *name);
double bench_ms_since(int64_t start_us);

/* Name and version of the renderer. */
cJSON *bench_renderer(const struct renderer_params *params, struct error *err);

/* One row for each example, or for the example `only`: times of compilation, of drawing by pass and
 * size, and of encoding. NULL and `err` when one cannot be drawn. */
cJSON *bench_drawing(const struct renderer_params *params, const char *only,
                     const struct bench_effort *effort, struct error *err);

/* Opens an example with the file that it names. NULL and `err` when it is no scene. */
struct resident *bench_open(struct renderer *renderer, const struct embedded *example,
                            struct error *err);

/* Draws one picture for its times, as if it were the first of its scene. */
bool bench_draw(struct renderer *renderer, struct resident *resident, const struct job_desc *desc,
                struct job_times *out_times, struct error *err);

/* Adds medians over the rounds: `ms` of the whole picture and of each stage that took time. */
bool bench_medians(struct renderer *renderer, struct resident *resident,
                   const struct job_desc *desc, int rounds, cJSON *row, struct error *err);

/* Adds `fragment_ratio` and `engine_ratio`: the time of a picture by compute shaders, divided by
 * its time by fragment shaders and by the engine; and `fragment_differs` and `engine_differs`: the
 * part of its pixels in which the two pictures differ by more than 1/255. */
bool bench_compare_stages(struct renderer *renderer, const struct embedded *example,
                          const struct job_desc *desc, int rounds, cJSON *row, struct error *err);

/* One row of that for each example, or for the example `only`, with small pictures. */
cJSON *bench_stages(const struct renderer_params *params, const char *only,
                    const struct bench_effort *effort, struct error *err);

/* Adds `effects_off_ratio`: the time of the example with reflections and refractions off, divided
 * by its time with materials that need neither. */
bool bench_effects(struct renderer *renderer, const struct embedded *example,
                   const struct bench_effort *effort, cJSON *row, struct error *err);

/* So many shapes in a cube of side 2, in one union. */
struct scene *bench_union(int count, struct error *err);
/* Moves a shape of such a scene, another one each turn, by a tenth of the way to the next one. */
bool bench_move_one(struct resident *resident, int turn, struct error *err);
/* For each way to draw a field, rows of examples and unions with milliseconds: of the first
 * picture, with what is compiled for it; of the next ones, by size; after an edit of a shape. */
cJSON *bench_programs(const struct renderer_params *params, const struct bench_effort *effort,
                      struct error *err);
/* One row for each number of shapes: the processor's time of a picture that is the first of its
 * scene, that follows an edit of one shape's place, that shows another view, and that does both;
 * the same as a ratio to that of the first; and the part of the pixels that was drawn after an
 * edit. */
cJSON *bench_changes(const struct renderer_params *params, const struct bench_effort *effort,
                     struct error *err);

/* One row for each family of scenes, drawn by the engine: the processor's time of a picture by the
 * number of shapes, the same as a ratio to that of the fewest, and the exponent of growth from 100
 * to 10,000 shapes. */
cJSON *bench_growth(const struct renderer_params *params, const struct bench_effort *effort,
                    struct error *err);

/* Adds `edit_us` and `edit_p95_us`: times of edits that move each node of the scene in turn. */
bool bench_edits(struct resident *resident, cJSON *row, struct error *err);

/* A document of `nodes` nodes, named node-I, in groups of a hundred; caller frees. */
char *bench_document(size_t nodes, size_t *out_length);
/* Times of reading, copying, printing and editing documents of 1,000 to 100,000 nodes. The row of
 * 10,000 nodes has bench_edits too, in `drawn`. */
cJSON *bench_documents(const struct renderer_params *params, struct error *err);

/* Times of edits that are applied and committed, in scenes of one and of 10,000 nodes. The store is
 * a new one below `directory`. */
cJSON *bench_store(const char *directory, struct error *err);

#endif
