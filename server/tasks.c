/* SPDX-License-Identifier: MIT */
#include "tasks.h"

#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "clock.h"
#include "protocol/accounts.h"
#include "protocol/limits.h"
#include "protocol/memory.h"
#include "renderer/slice.h"

enum { THREADS = 2, LIGHT_THREAD = 0, HEAVY_NICE = 5 };

struct task {
    struct task *next;
    char *scene;
    struct account *account;
    struct task_order order;
};

struct tasks {
    struct metrics *metrics; /* NULL: none */
    pthread_mutex_t lock;    /* taken after any other */
    pthread_cond_t news;
    pthread_t threads[THREADS];
    int started;
    bool stopping;
    struct task *first, **end; /* in order of arrival */
    struct task *current[THREADS];
    struct accounts accounts;
};

static void task_destroy(struct tasks *tasks, struct task *task)
{
    accounts_leave(&tasks->accounts, task->account);
    free(task->scene);
    free(task);
}

/* --- whose turn it is --- */

static bool same_scene(const struct task *a, const struct task *b)
{
    return *a->scene && strcmp(a->scene, b->scene) == 0;
}

/* Its scene is worked on, or something else of it comes first. */
static bool is_behind(const struct tasks *tasks, const struct task *task)
{
    for (int i = 0; i < THREADS; i++) {
        if (tasks->current[i] && same_scene(task, tasks->current[i])) {
            return true;
        }
    }
    for (const struct task *other = tasks->first; other != task; other = other->next) {
        if (same_scene(task, other)) {
            return true;
        }
    }
    return false;
}

/* The next one that this thread may do; NULL: none. */
static struct task *take(struct tasks *tasks, int thread)
{
    struct task **best = NULL;

    for (struct task **link = &tasks->first; *link; link = &(*link)->next) {
        struct task *task = *link;

        if ((!best || account_is_before(task->account, (*best)->account)) &&
            !(task->order.heavy && thread == LIGHT_THREAD) && !is_behind(tasks, task)) {
            best = link;
        }
    }
    if (!best) {
        return NULL;
    }
    struct task *task = *best;
    *best = task->next;
    tasks->end = task->next ? tasks->end : best;
    accounts_begin(&tasks->accounts, task->account);
    return task;
}

static void add(struct tasks *tasks, const struct task_order *order)
{
    struct task *task = memory_alloc(1, sizeof *task);

    task->order = *order;
    task->scene = memory_text(order->scene);
    task->account = accounts_join(&tasks->accounts, order->account);
    *tasks->end = task;
    tasks->end = &task->next;
}

static void count(const struct tasks *tasks, enum metric metric, int by)
{
    if (tasks->metrics) {
        metric_add(tasks->metrics, metric, by);
    }
}

static bool admits(const struct tasks *tasks, const struct task_order *order, struct error *err)
{
    int all = 0, own = 0;

    for (const struct task *task = tasks->first; task; task = task->next) {
        all += task->order.heavy;
        own += task->order.heavy && strcmp(account_name(task->account), order->account) == 0;
    }
    if (tasks->stopping) {
        return error_set(err, ERROR_UNAVAILABLE, "", "the server is shutting down");
    }
    if (!order->heavy || !order->bounded ||
        (own < LIMIT_DOCUMENT_SHARE && all < LIMIT_DOCUMENT_QUEUE)) {
        return true;
    }
    const bool share = own >= LIMIT_DOCUMENT_SHARE;
    count(tasks, share ? METRIC_DOCUMENTS_OVER_SHARE : METRIC_DOCUMENTS_OVER_QUEUE, 1);
    error_set(err, share ? ERROR_SHARE : ERROR_UNAVAILABLE, "",
              "%d large tasks%s wait already; the limit is %d", share ? own : all,
              share ? " of this client" : "", share ? LIMIT_DOCUMENT_SHARE : LIMIT_DOCUMENT_QUEUE);
    if (err) {
        err->retry_ms = 1000;
    }
    return false;
}

bool tasks_add(struct tasks *tasks, const struct task_order *order, struct error *err)
{
    pthread_mutex_lock(&tasks->lock);
    const bool ok = admits(tasks, order, err);
    if (ok) {
        add(tasks, order);
        count(tasks, METRIC_DOCUMENTS_WAITING, 1);
        pthread_cond_broadcast(&tasks->news);
    }
    pthread_mutex_unlock(&tasks->lock);
    return ok;
}

/* --- threads --- */

struct seat {
    struct tasks *tasks;
    int thread;
};

static void *run(void *data)
{
    struct seat *seat = data;
    struct tasks *tasks = seat->tasks;
    const int thread = seat->thread;

    free(seat);
    if (thread != LIGHT_THREAD) { /* Linux has a priority for each thread. */
        setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + HEAVY_NICE);
        slice_long();
    }
    pthread_mutex_lock(&tasks->lock);
    while (!tasks->stopping) {
        struct task *task = take(tasks, thread);

        if (!task) {
            pthread_cond_wait(&tasks->news, &tasks->lock);
            continue;
        }
        tasks->current[thread] = task;
        pthread_mutex_unlock(&tasks->lock);
        const int64_t begun_us = clock_thread_us();
        task->order.run(task->order.data, false);
        const int64_t spent_us = clock_thread_us() - begun_us;
        pthread_mutex_lock(&tasks->lock);
        tasks->current[thread] = NULL;
        accounts_charge(task->account, spent_us);
        count(tasks, METRIC_DOCUMENTS_WAITING, -1);
        task_destroy(tasks, task);
        pthread_cond_broadcast(&tasks->news); /* others of its scene may go */
    }
    pthread_mutex_unlock(&tasks->lock);
    return NULL;
}

struct tasks *tasks_create(struct metrics *metrics, struct error *err)
{
    struct tasks *tasks = memory_alloc(1, sizeof *tasks);

    tasks->metrics = metrics;
    tasks->end = &tasks->first;
    pthread_mutex_init(&tasks->lock, NULL);
    pthread_cond_init(&tasks->news, NULL);
    while (tasks->started < THREADS) {
        struct seat *seat = memory_alloc(1, sizeof *seat);

        *seat = (struct seat){.tasks = tasks, .thread = tasks->started};
        if (pthread_create(&tasks->threads[tasks->started], NULL, run, seat) != 0) {
            free(seat);
            error_set(err, ERROR_INTERNAL, "tasks", "a thread cannot be started");
            tasks_destroy(tasks);
            return NULL;
        }
        tasks->started++;
    }
    return tasks;
}

void tasks_stop(struct tasks *tasks)
{
    pthread_mutex_lock(&tasks->lock);
    tasks->stopping = true;
    struct task *left = tasks->first;
    tasks->first = NULL;
    tasks->end = &tasks->first;
    pthread_cond_broadcast(&tasks->news);
    pthread_mutex_unlock(&tasks->lock);
    for (; tasks->started > 0; tasks->started--) {
        pthread_join(tasks->threads[tasks->started - 1], NULL);
    }
    while (left) {
        struct task *task = left;

        left = task->next;
        task->order.run(task->order.data, true);
        count(tasks, METRIC_DOCUMENTS_WAITING, -1);
        task_destroy(tasks, task);
    }
}

void tasks_destroy(struct tasks *tasks)
{
    if (!tasks) {
        return;
    }
    tasks_stop(tasks);
    accounts_finish(&tasks->accounts);
    pthread_cond_destroy(&tasks->news);
    pthread_mutex_destroy(&tasks->lock);
    free(tasks);
}
