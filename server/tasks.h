/* SPDX-License-Identifier: MIT */
/* Work on documents, on threads that nobody else waits for. Tasks of one scene are done one after
 * the other as they came; apart from that clients take turns. One task that is heavy is done at a
 * time: a light one never waits for a heavy one of another scene. */
#ifndef SERVER_TASKS_H
#define SERVER_TASKS_H

#include <stdbool.h>
#include <stddef.h>

#include "protocol/error.h"
#include "server/metrics.h"

struct tasks;

enum {
    TASK_LIGHT_BYTES = 65536, /* of what was sent; more is heavy */
    TASK_LIGHT_NODES = 4096,  /* of the scene; more is heavy */
};

struct task_order {
    const char *scene;   /* its id, or what else tasks do by turns; "": nothing; copied */
    const char *account; /* whose turn it takes; copied */
    bool heavy;
    bool bounded; /* refused where many heavy ones wait */
    /* Called once, on a thread of the tasks, without locks. `dropped`: the server is shutting down,
     * and nothing is to be done any more. */
    void (*run)(void *data, bool dropped);
    void *data;
};

/* `metrics` may be NULL. */
struct tasks *tasks_create(struct metrics *metrics, struct error *err);
/* Any thread, locks held or not. False: refused, `run` is not called. */
bool tasks_add(struct tasks *tasks, const struct task_order *order, struct error *err);
/* Ends what is being done, drops the rest and what still comes. */
void tasks_stop(struct tasks *tasks);
void tasks_destroy(struct tasks *tasks);

#endif
