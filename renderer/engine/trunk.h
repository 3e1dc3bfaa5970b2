/* SPDX-License-Identifier: MIT */
/* The upper part of the trees of cubes (cells.c), which all threads share. There tapes are long,
 * and what a child leaves out of them takes most of the time of a first picture of many shapes. The
 * thread that first needs something of a cube makes it; others that need it meanwhile wait.
 *
 * Of any thread, but for trunk_create(), trunk_end(), trunk_rename() and trunk_destroy(), while no
 * other uses it. */
#ifndef RENDERER_ENGINE_TRUNK_H
#define RENDERER_ENGINE_TRUNK_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { TRUNK_TAPE = 128 }; /* words of a tape, at least */

enum trunk_state { TRUNK_NEW, TRUNK_TAKEN, TRUNK_KNOWN };

/* The tape of a child. */
struct trunk_tape {
    _Atomic enum trunk_state state;
    uint32_t *words; /* NULL: its parent's */
    uint32_t count;
    struct trunk_cube *cube; /* of the child; NULL: its tape is short */
};

/* What is known of a cube's children, as in struct cell. */
struct trunk_cube {
    _Atomic enum trunk_state state; /* of all but the tapes */
    float distances[8];
    uint16_t dropping, *drops;
    struct trunk_tape tapes[8];
    struct trunk_cube *older; /* of a root: that of another size, which is no longer asked for */
};

struct matches;
struct trunk;
struct trunk *trunk_create(void);
/* No cube that is begun from now on shares anything. Those that do stay as they are. */
void trunk_end(struct trunk *trunk);
bool trunk_has_ended(const struct trunk *trunk);
void trunk_destroy(struct trunk *trunk); /* NULL is nothing */
/* Of the operations in all tapes: matches.h. */
void trunk_rename(struct trunk *trunk, const struct matches *matches);
size_t trunk_bytes(const struct trunk *trunk);

/* The root of a space whose half is this; NULL: after trunk_end(). */
struct trunk_cube *trunk_root(struct trunk *trunk, int space, float half);
/* True: the caller makes what the state is of, and then calls trunk_tell(). False: it is known. */
bool trunk_take(struct trunk *trunk, _Atomic enum trunk_state *state);
void trunk_tell(struct trunk *trunk, _Atomic enum trunk_state *state);
/* Zeros, which the trunk frees. */
uint16_t *trunk_drops(struct trunk *trunk, struct trunk_cube *cube, size_t count);
/* A child's tape, whose words are copied; NULL: it is its parent's. */
void trunk_put(struct trunk *trunk, struct trunk_tape *tape, const uint32_t *words, uint32_t count);

#endif
