/* SPDX-License-Identifier: MIT */
#include "trunk.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "engine_internal.h"
#include "matches.h"
#include "protocol/limits.h"
#include "protocol/memory.h"

/* Then no more is shared. */
enum { TRUNK_BYTES = LIMIT_CUBES_BYTES / 4 };

struct trunk {
    pthread_mutex_t lock;
    pthread_cond_t known;
    struct trunk_cube *roots[ENGINE_SPACES];
    float halves[ENGINE_SPACES];
    bool ended;
    atomic_size_t bytes;
};

struct trunk *trunk_create(void)
{
    struct trunk *trunk = memory_alloc(1, sizeof *trunk);

    pthread_mutex_init(&trunk->lock, NULL);
    pthread_cond_init(&trunk->known, NULL);
    return trunk;
}

void trunk_end(struct trunk *trunk)
{
    trunk->ended = true;
}

bool trunk_has_ended(const struct trunk *trunk)
{
    return trunk->ended;
}

static void cube_destroy(struct trunk_cube *cube)
{
    if (!cube) {
        return;
    }
    for (int i = 0; i < CUBE_CHILDREN; i++) {
        free(cube->tapes[i].words);
        cube_destroy(cube->tapes[i].cube);
    }
    free(cube->drops);
    free(cube);
}

void trunk_destroy(struct trunk *trunk)
{
    if (!trunk) {
        return;
    }
    for (int i = 0; i < ENGINE_SPACES; i++) {
        for (struct trunk_cube *root = trunk->roots[i], *older; root; root = older) {
            older = root->older;
            cube_destroy(root);
        }
    }
    pthread_cond_destroy(&trunk->known);
    pthread_mutex_destroy(&trunk->lock);
    free(trunk);
}

/* A child's tape holds no operation that its parent's does not. */
static void cube_rename(struct trunk_cube *cube, const struct matches *matches)
{
    for (int i = 0; cube && i < CUBE_CHILDREN; i++) {
        struct trunk_tape *tape = &cube->tapes[i];
        if (!tape->words || matches_rename(matches, tape->words, tape->count)) {
            cube_rename(tape->cube, matches);
        }
    }
}

void trunk_rename(struct trunk *trunk, const struct matches *matches)
{
    for (int i = 0; matches_move(matches) && i < ENGINE_SPACES; i++) {
        for (struct trunk_cube *root = trunk->roots[i]; root; root = root->older) {
            cube_rename(root, matches);
        }
    }
}

size_t trunk_bytes(const struct trunk *trunk)
{
    return trunk ? atomic_load(&trunk->bytes) : 0;
}

static void *room(struct trunk *trunk, size_t count, size_t size)
{
    atomic_fetch_add(&trunk->bytes, count * size);
    return memory_alloc(count, size);
}

struct trunk_cube *trunk_root(struct trunk *trunk, int space, float half)
{
    struct trunk_cube *root = NULL;

    pthread_mutex_lock(&trunk->lock);
    if (!trunk->ended) {
        root = trunk->roots[space];
        if (!root || trunk->halves[space] != half) {
            root = room(trunk, 1, sizeof *root);
            root->older = trunk->roots[space];
            trunk->roots[space] = root;
            trunk->halves[space] = half;
        }
    }
    pthread_mutex_unlock(&trunk->lock);
    return root;
}

bool trunk_take(struct trunk *trunk, _Atomic enum trunk_state *state)
{
    if (atomic_load_explicit(state, memory_order_acquire) == TRUNK_KNOWN) {
        return false;
    }
    pthread_mutex_lock(&trunk->lock);
    while (atomic_load(state) == TRUNK_TAKEN) {
        pthread_cond_wait(&trunk->known, &trunk->lock);
    }
    const bool mine = atomic_load(state) == TRUNK_NEW;
    if (mine) {
        atomic_store(state, TRUNK_TAKEN);
    }
    pthread_mutex_unlock(&trunk->lock);
    return mine;
}

void trunk_tell(struct trunk *trunk, _Atomic enum trunk_state *state)
{
    pthread_mutex_lock(&trunk->lock);
    atomic_store_explicit(state, TRUNK_KNOWN, memory_order_release);
    pthread_cond_broadcast(&trunk->known);
    pthread_mutex_unlock(&trunk->lock);
}

uint16_t *trunk_drops(struct trunk *trunk, struct trunk_cube *cube, size_t count)
{
    return cube->drops = room(trunk, count, sizeof *cube->drops);
}

void trunk_put(struct trunk *trunk, struct trunk_tape *tape, const uint32_t *words, uint32_t count)
{
    tape->count = count;
    tape->cube = count >= TRUNK_TAPE && trunk_bytes(trunk) < TRUNK_BYTES
                     ? room(trunk, 1, sizeof *tape->cube)
                     : NULL;
    if (words) {
        tape->words = room(trunk, count, sizeof *words);
        memcpy(tape->words, words, count * sizeof *words);
    }
}
