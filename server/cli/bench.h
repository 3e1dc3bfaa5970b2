/* SPDX-License-Identifier: MIT */
/* The measurements of `fieldcast bench`; each returns the JSON that it prints. */
#ifndef SERVER_BENCH_H
#define SERVER_BENCH_H

#include <cjson/cJSON.h>

#include "local_render.h"
#include "server/embedded.h"

enum bench_part { BENCH_ALL, BENCH_DRAWING, BENCH_GROWTH, BENCH_DOCUMENTS, BENCH_EDITS };
/* NULL behind the last. */
const char *bench_part_name(size_t part);

/* Sorts `count` numbers; the one below which lies this share of them (0.5: the median). */
double bench_quantile(double *numbers, size_t count, double quantile);
/* Adds a number with three decimals; more would be noise. */
void bench_add(cJSON *object, const char *name, double value);
double bench_number(const cJSON *object, const char *name);
double bench_ms_since(int64_t start_us);

/* Name and version of what draws. */
cJSON *bench_renderer(const struct renderer_params *params, struct error *err);

/* One row for each example, or for that called `only`: compiling, drawing by pass and size,
 * encoding. NULL and `err` when something cannot be drawn. */
cJSON *bench_drawing(const struct renderer_params *params, const char *only, int rounds,
                     struct error *err);

/* An example with the file that it names. NULL and `err` when it is no scene. */
struct resident *bench_open(struct renderer *renderer, const struct embedded *example,
                            struct error *err);

/* One picture, for its times alone. */
bool bench_draw(struct renderer *renderer, struct resident *resident, const struct job_desc *desc,
                struct job_times *out_times, struct error *err);

/* Adds medians over the rounds: `ms` of the whole, and of each stage that took any. */
bool bench_medians(struct renderer *renderer, struct resident *resident,
                   const struct job_desc *desc, int rounds, cJSON *row, struct error *err);

/* `engine_ratio`: what a picture takes by compute shaders, by what it takes by the engine. */
bool bench_stages(struct renderer *renderer, const struct embedded *example,
                  const struct job_desc *desc, int rounds, cJSON *row, struct error *err);

/* `effects_off_ratio`: what the example takes with reflections and refractions off, by what it
 * takes where no material asks for any. */
bool bench_effects(struct renderer *renderer, const struct embedded *example, int rounds,
                   cJSON *row, struct error *err);

/* One row for each family of scenes: `ms` of a picture by the number of shapes, the `ratio` of the
 * most to the fewest, and the exponent of growth without these. By the engine. */
cJSON *bench_growth(const struct renderer_params *params, int rounds, struct error *err);

/* `edit_us` and `edit_p95_us`: edits that move one node of the scene after the other. */
bool bench_edits(struct resident *resident, cJSON *row, struct error *err);

/* A document of so many nodes, node-I in groups of a hundred; caller frees. */
char *bench_document(size_t nodes, size_t *out_length);
/* Reading, copying, printing and editing of documents of 1,000 to 100,000 nodes. */
cJSON *bench_documents(struct error *err);

/* Edits applied and committed in a store of its own below `directory`: of a scene of one node and
 * of 10,000. */
cJSON *bench_store(const char *directory, struct error *err);

#endif
