/* SPDX-License-Identifier: MIT */
#include "scene_bin.h"

#include <pthread.h>
#include <stdlib.h>

#include "patient.h"
#include "protocol/memory.h"

enum { SMALL_NODES = 1000 };

struct gone {
    struct scene *scene;
    struct gone *next;
};

struct scene_bin {
    pthread_t thread;
    pthread_mutex_t lock; /* guards what follows */
    pthread_cond_t change;
    struct gone *first;
    bool stop;
};

static void *work(void *data)
{
    struct scene_bin *bin = data;

    pthread_mutex_lock(&bin->lock);
    while (bin->first || !bin->stop) {
        struct gone *gone = bin->first;

        if (!gone) {
            pthread_cond_wait(&bin->change, &bin->lock);
            continue;
        }
        bin->first = gone->next;
        pthread_mutex_unlock(&bin->lock);
        scene_destroy(gone->scene);
        free(gone);
        pthread_mutex_lock(&bin->lock);
    }
    pthread_mutex_unlock(&bin->lock);
    return NULL;
}

struct scene_bin *scene_bin_create(void)
{
    struct scene_bin *bin = memory_alloc(1, sizeof *bin);

    pthread_mutex_init(&bin->lock, NULL);
    pthread_cond_init(&bin->change, NULL);
    if (!patient_create(&bin->thread, work, bin)) {
        abort();
    }
    return bin;
}

void scene_bin_take(struct scene_bin *bin, struct scene *scene)
{
    if (!scene || scene->node_count <= SMALL_NODES) {
        scene_destroy(scene);
        return;
    }
    struct gone *gone = memory_alloc(1, sizeof *gone);

    pthread_mutex_lock(&bin->lock);
    *gone = (struct gone){scene, bin->first};
    bin->first = gone;
    pthread_cond_signal(&bin->change);
    pthread_mutex_unlock(&bin->lock);
}

void scene_bin_destroy(struct scene_bin *bin)
{
    if (!bin) {
        return;
    }
    pthread_mutex_lock(&bin->lock);
    bin->stop = true;
    pthread_cond_signal(&bin->change);
    pthread_mutex_unlock(&bin->lock);
    pthread_join(bin->thread, NULL);
    pthread_cond_destroy(&bin->change);
    pthread_mutex_destroy(&bin->lock);
    free(bin);
}
