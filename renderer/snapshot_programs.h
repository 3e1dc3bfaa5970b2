/* SPDX-License-Identifier: MIT */
/* The back end of a snapshot, for snapshot.c. */
#ifndef RENDERER_SNAPSHOT_PROGRAMS_H
#define RENDERER_SNAPSHOT_PROGRAMS_H

#include "snapshot.h"

/* Of struct snapshot. */
uint64_t snapshot_structure(const struct renderer *renderer, const struct field *field,
                            const struct scene *scene);
/* Programs for the device, or one for the engine, which draws what is too much for the device's
 * compiler, too. What is made of instructions alone is shared with a snapshot of the same ones
 * (`before`; NULL: none). False and `err` where there is none; `*out_refused`: its structure is
 * refused. */
bool snapshot_find_back_end(struct renderer *renderer, struct snapshot *snapshot,
                            const struct scene *scene, const struct snapshot *before,
                            uint64_t *out_refused, struct error *err);
void snapshot_leave_back_end(struct renderer *renderer, struct snapshot *snapshot);
/* None of the wanted programs is there yet. */
bool snapshot_is_compiling(const struct snapshot *snapshot);

#endif
