/* SPDX-License-Identifier: MIT */
/* Work on documents, on threads of its own. The tasks of one scene run one after the other, in the
 * order of arrival. Between scenes, the client whose tasks took the least time is next
 * (protocol/accounts.h). At most one heavy task runs at a time, so a light task never waits for a
 * heavy one of another scene; its thread gives way to threads that draw. */
#ifndef SERVER_TASKS_H
#define SERVER_TASKS_H

#include <stdbool.h>
#include <stddef.h>

#include "protocol/error.h"
#include "server/metrics.h"

struct tasks;

enum {
    TASK_LIGHT_BYTES = 65536, /* bytes sent by the client; more is heavy */
    TASK_LIGHT_NODES = 4096,  /* nodes of the scene; more is heavy */
};

struct task_order {
    const char *scene;   /* id of the scene; "": no order is kept; copied */
    const char *account; /* the client who pays for its time; copied */
    bool heavy;
    bool bounded; /* refused when many heavy tasks wait */
    /* Called once, on a thread of the tasks, without locks. `dropped`: the server shuts down, and
     * the function only frees `data`. */
    void (*run)(void *data, bool dropped);
    void *data;
};

/* `metrics` may be NULL. */
struct tasks *tasks_create(struct metrics *metrics, struct error *err);
/* Any thread, with or without locks. False: the task is refused, and `run` is never called. */
bool tasks_add(struct tasks *tasks, const struct task_order *order, struct error *err);
/* Waits for the running tasks; drops the waiting ones and all that come later. */
void tasks_stop(struct tasks *tasks);
void tasks_destroy(struct tasks *tasks);

#endif
