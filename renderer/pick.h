/* SPDX-License-Identifier: MIT */
/* What is under a place of a picture, and how large it is, asked of the C evaluator: no GL and no
 * render process. */
#ifndef RENDERER_PICK_H
#define RENDERER_PICK_H

#include "protocol/limits.h"
#include "protocol/scene.h"

/* A scene as rays meet it, at one state. Immutable; the references are counted across threads, and
 * any number of threads may ask at once. */
struct pick_field;

/* With one reference; `scene` is not kept. `isolated`: as in job_desc. NULL and `err` where the
 * scene is no field. */
struct pick_field *pick_field_create(const struct scene *scene, const char *const *isolated,
                                     size_t isolated_count, struct error *err);
struct pick_field *pick_field_ref(struct pick_field *field);
void pick_field_unref(struct pick_field *field); /* NULL: nothing */

/* A box in the world around what is to be seen and has an end: operands of unions without one, and
 * the floor, are left out. False: nothing is left. */
bool pick_bounds(const struct scene *scene, const char *const *isolated, size_t isolated_count,
                 double out_low[3], double out_high[3]);

struct pick_question {
    const struct record *camera;  /* camera_type; NULL: the scene's */
    const struct record *section; /* section_type; NULL: nothing is cut */
    int width, height;            /* of the whole picture, pixels */
    double x, y;                  /* in it, from its left top */
    bool through;                 /* follow the ray on, behind the surface */
};

struct pick_result {
    bool hit;
    char node[LIMIT_ID_BYTES + 1]; /* the leaf that gave the surface; "": the floor */
    double position[3], normal[3], distance;
    /* Of a question `through`: the leaves whose surfaces the ray passes, into solids and out of
     * them, the nearest first, each once. */
    char through[LIMIT_PICK_THROUGH][LIMIT_ID_BYTES + 1];
    int through_count;
};

/* Follows the ray, which hits nothing where that takes more than LIMIT_PICK_WORK; what is behind
 * the surface may take as much again. */
struct pick_result pick_at(const struct pick_field *field, const struct pick_question *question);

#endif
