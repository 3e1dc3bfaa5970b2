/* SPDX-License-Identifier: MIT */
/* The program fieldcast-algebra, which lies beside this one: it finds and proves equations of
 * parametric surfaces and makes Groebner bases, in a process of its own, with bounds of processor
 * time and memory (algebra_seconds, algebra_bytes). */
#ifndef SERVER_ALGEBRA_H
#define SERVER_ALGEBRA_H

#include <cjson/cJSON.h>
#include <stdbool.h>

#include "protocol/record.h"
#include "protocol/surface.h"

struct algebra;

struct algebra *algebra_create(struct error *err);
/* A question: of surface_question_type, or of ideal_type. Waits for the process. The caller deletes
 * *out: its answer as main.c of renderer/algebra has it. The place of an error is a member's name,
 * or "". `tell` gets the line of each step, in the caller's thread; NULL: nobody asks.
 * algebra_cancel with the same `data` ends the process. Any thread, one at a time. */
bool algebra_ask(struct algebra *algebra, const struct record *asked,
                 void (*tell)(void *data, const char *line), void *data, cJSON **out,
                 struct error *err);
/* Any thread. Does nothing where no process runs for `data`. */
void algebra_cancel(struct algebra *algebra, const void *data);

struct algebra_proof {
    enum surface_verdict verdict;
    char reason[512];
    cJSON *coverage; /* where it is verified: coverage_answer of renderer/algebra; else NULL */
};
/* Whether the equation of an `implicit` with these parameters is that of its parametric surface.
 * Where time or memory end it, it is not checked. The caller deletes the coverage. Waits, as
 * above. */
bool algebra_verify(struct algebra *algebra, const struct record *params, struct algebra_proof *out,
                    struct error *err);
/* Calls `run` once on a thread where it may call these two; clients take turns. `dropped`
 * and the limits of waiting: tasks.h. */
bool algebra_add(struct algebra *algebra, const char *account, void (*run)(void *, bool dropped),
                 void *data, struct error *err);
/* Ends the process; drops what waits and all that comes later. */
void algebra_stop(struct algebra *algebra);
void algebra_destroy(struct algebra *algebra); /* may be NULL */

#endif
