/* SPDX-License-Identifier: MIT */
/* The queue and its thread. */
#include "store.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "protocol/memory.h"
#include "server/clock.h"
#include "server/directory.h"
#include "server/log.h"
#include "store_sqlite.h"

struct store {
    struct store_sqlite *db;
    struct metrics *metrics;
    int lock_fd;
    pthread_t thread;
    bool running;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    struct store_write *first, **end; /* waiting */
    uint64_t pushed, told;
    bool closing;
};

void store_step_finish(struct store_step *step)
{
    free(step->group);
    free(step->label);
    free(step->inverse);
    *step = (struct store_step){0};
}

static void write_destroy(struct store_write *write)
{
    free(write->text);
    free(write->name);
    store_step_finish(&write->step);
    if (write->asset) {
        free(write->asset->bytes);
        free(write->asset);
    }
    free(write);
}

static void edits_destroy(struct store_edit *edits, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        free(edits[i].ops);
        store_step_finish(&edits[i].step);
    }
    free(edits);
}

void store_loaded_finish(struct store_loaded *loaded)
{
    edits_destroy(loaded->edits, loaded->edit_count);
    edits_destroy(loaded->past, loaded->past_count);
    free(loaded->authors);
    free(loaded->document);
    memset(loaded, 0, sizeof *loaded);
}

static void commit_batch(struct store *store, const struct store_write *batch)
{
    struct error err = {0};
    int64_t start = clock_us(), edits = 0;

    if (!store_sqlite_commit(store->db, batch, &err)) {
        log_error("store", "%s: %s; ending, so that nothing is told durable that is not", err.place,
                  err.message);
        _exit(STORE_EXIT_STATUS);
    }
    for (; batch; batch = batch->next) {
        edits += batch->kind == STORE_EDIT;
    }
    metric_add(store->metrics, METRIC_COMMITS, 1);
    metric_add(store->metrics, METRIC_COMMIT_US, clock_us() - start);
    metric_add(store->metrics, METRIC_EDITS_DURABLE, edits);
}

/* Tells and frees a committed batch; returns how many writes it held. */
static uint64_t tell_batch(struct store_write *batch)
{
    uint64_t count = 0;

    while (batch) {
        struct store_write *next = batch->next;

        if (batch->on_durable) {
            batch->on_durable(batch->data);
        }
        write_destroy(batch);
        batch = next;
        count++;
    }
    return count;
}

static void *run(void *data)
{
    struct store *store = data;

    pthread_mutex_lock(&store->lock);
    for (;;) {
        while (!store->first && !store->closing) {
            pthread_cond_wait(&store->changed, &store->lock);
        }
        if (!store->first) {
            break;
        }
        struct store_write *batch = store->first;
        store->first = NULL;
        store->end = &store->first;
        pthread_mutex_unlock(&store->lock);

        commit_batch(store, batch);
        const uint64_t count = tell_batch(batch);

        pthread_mutex_lock(&store->lock);
        store->told += count;
        pthread_cond_broadcast(&store->changed);
    }
    pthread_mutex_unlock(&store->lock);
    return NULL;
}

/* The lock goes with the process, whatever ends it. */
static bool take_directory(struct store *store, const char *directory, struct error *err)
{
    char path[4096];

    if (mkdir(directory, 0700) == 0) {
        directory_sync_parent(directory);
    } else if (errno != EEXIST) {
        return error_set(err, ERROR_UNAVAILABLE, directory, "cannot be made: %s", strerror(errno));
    }
    if (snprintf(path, sizeof path, "%s/lock", directory) >= (int)sizeof path) {
        return error_set(err, ERROR_LIMIT, directory, "the path is too long");
    }
    store->lock_fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (store->lock_fd < 0) {
        return error_set(err, ERROR_UNAVAILABLE, path, "%s", strerror(errno));
    }
    if (flock(store->lock_fd, LOCK_EX | LOCK_NB) != 0) {
        return error_set(err, ERROR_CONFLICT, directory, "another fieldcast uses this directory");
    }
    return true;
}

static void database_path(char *out, size_t size, const char *directory)
{
    snprintf(out, size, "%s/scenes.sqlite", directory);
}

struct store *store_open(const char *directory, struct metrics *metrics, struct error *err)
{
    struct store *store = memory_alloc(1, sizeof *store);
    char path[4096];

    store->metrics = metrics;
    store->lock_fd = -1;
    store->end = &store->first;
    pthread_mutex_init(&store->lock, NULL);
    pthread_cond_init(&store->changed, NULL);
    if (!take_directory(store, directory, err)) {
        goto fail;
    }
    database_path(path, sizeof path, directory);
    store->db = store_sqlite_open(path, err);
    if (!store->db) {
        goto fail;
    }
    if (*store_damage(store)) {
        log_error("store", "%s is damaged: %s; what can be read is served", path,
                  store_damage(store));
    }
    if (pthread_create(&store->thread, NULL, run, store) != 0) {
        error_set(err, ERROR_INTERNAL, "store", "no thread can be started");
        goto fail;
    }
    store->running = true;
    return store;
fail:
    store_close(store);
    return NULL;
}

const char *store_damage(const struct store *store)
{
    return store_sqlite_damage(store->db);
}

bool store_check(const char *directory, struct error *err)
{
    char path[4096];

    database_path(path, sizeof path, directory);
    return access(path, F_OK) != 0 || store_sqlite_check(path, err);
}

void store_close(struct store *store)
{
    if (!store) {
        return;
    }
    if (store->running) {
        pthread_mutex_lock(&store->lock);
        store->closing = true;
        pthread_cond_broadcast(&store->changed);
        pthread_mutex_unlock(&store->lock);
        pthread_join(store->thread, NULL);
    }
    store_sqlite_close(store->db);
    if (store->lock_fd >= 0) {
        close(store->lock_fd);
    }
    pthread_cond_destroy(&store->changed);
    pthread_mutex_destroy(&store->lock);
    free(store);
}

bool store_list(struct store *store, void (*each)(void *data, const struct store_scene *scene),
                void *data, struct error *err)
{
    return store_sqlite_list(store->db, each, data, err);
}

bool store_load(struct store *store, const char *scene, struct store_loaded *out, struct error *err)
{
    return store_sqlite_load(store->db, scene, out, err);
}

bool store_find_edit(struct store *store, const char *scene, const char *author, int64_t edit,
                     uint64_t *out_revision, struct error *err)
{
    return store_sqlite_find_edit(store->db, scene, author, edit, out_revision, err);
}

bool store_list_assets(struct store *store,
                       void (*each)(void *data, const struct store_asset *asset), void *data,
                       struct error *err)
{
    return store_sqlite_list_assets(store->db, each, data, err);
}

bool store_list_texts(struct store *store,
                      void (*each)(void *data, const char *scene, const char *text), void *data,
                      struct error *err)
{
    return store_sqlite_list_texts(store->db, each, data, err);
}

bool store_load_asset(struct store *store, const char *id, void **out_bytes, size_t *out_length,
                      struct error *err)
{
    return store_sqlite_load_asset(store->db, id, out_bytes, out_length, err);
}

bool store_load_poster(struct store *store, const char *scene, void **out_bytes, size_t *out_length,
                       struct error *err)
{
    return store_sqlite_load_poster(store->db, scene, out_bytes, out_length, err);
}

bool store_list_library(struct store *store,
                        void (*each)(void *data, const struct store_entry *entry), void *data,
                        struct error *err)
{
    return store_sqlite_list_library(store->db, each, data, err);
}

void store_push(struct store *store, struct store_write *write)
{
    write->next = NULL;
    store_push_all(store, write);
}

void store_push_all(struct store *store, struct store_write *first)
{
    struct timespec now;

    clock_gettime(CLOCK_REALTIME, &now);
    pthread_mutex_lock(&store->lock);
    *store->end = first;
    for (struct store_write *write = first; write; write = write->next) {
        write->time_ms = (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
        store->end = &write->next;
        store->pushed++;
    }
    pthread_cond_broadcast(&store->changed);
    pthread_mutex_unlock(&store->lock);
}

void store_flush(struct store *store)
{
    pthread_mutex_lock(&store->lock);
    const uint64_t wanted = store->pushed;
    while (store->told < wanted) {
        pthread_cond_wait(&store->changed, &store->lock);
    }
    pthread_mutex_unlock(&store->lock);
}
