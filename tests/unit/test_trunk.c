/* SPDX-License-Identifier: MIT */
/* What threads share of the upper cubes: each thing is made once, and all see it whole. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include <pthread.h>

#include "renderer/engine/matches.h"
#include "renderer/engine/trunk.h"

enum { THREADS = 4, DEPTH = 2000, WORDS = TRUNK_TAPE };

struct walk {
    pthread_t thread;
    struct trunk *trunk;
    struct trunk_cube *root;
    int made, wrong;
};

/* Words of the tape at a depth. */
static uint32_t word_at(int depth, uint32_t i)
{
    return (uint32_t)depth * 7 + i;
}

static void make(struct trunk *trunk, struct trunk_tape *tape, int depth)
{
    uint32_t words[WORDS];

    for (uint32_t i = 0; i < WORDS; i++) {
        words[i] = word_at(depth, i);
    }
    trunk_put(trunk, tape, words, WORDS);
}

static pthread_barrier_t start;

static void *walk_down(void *data)
{
    struct walk *walk = data;
    struct trunk_cube *cube = walk->root;

    pthread_barrier_wait(&start);

    for (int depth = 0; depth < DEPTH; depth++) {
        struct trunk_tape *tape = &cube->tapes[depth % 8];
        if (trunk_take(walk->trunk, &tape->state)) {
            make(walk->trunk, tape, depth);
            trunk_tell(walk->trunk, &tape->state);
            walk->made++;
        }
        for (uint32_t i = 0; i < WORDS; i++) {
            walk->wrong += tape->words[i] != word_at(depth, i);
        }
        cube = tape->cube;
    }
    return NULL;
}

static void threads_make_each_thing_once(void **state)
{
    (void)state;
    struct trunk *trunk = trunk_create();
    struct walk walks[THREADS] = {{.trunk = trunk}};
    int made = 0;

    pthread_barrier_init(&start, NULL, THREADS);
    for (int i = 0; i < THREADS; i++) {
        walks[i] = (struct walk){.trunk = trunk, .root = trunk_root(trunk, 0, 1)};
        assert_int_equal(pthread_create(&walks[i].thread, NULL, walk_down, &walks[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_join(walks[i].thread, NULL), 0);
        assert_int_equal(walks[i].wrong, 0);
        made += walks[i].made;
    }
    assert_int_equal(made, DEPTH);
    pthread_barrier_destroy(&start);
    assert_true(trunk_bytes(trunk) >= DEPTH * WORDS * sizeof(uint32_t));
    trunk_destroy(trunk);
}

static void roots_are_of_a_space_and_a_size(void **state)
{
    (void)state;
    struct trunk *trunk = trunk_create();
    struct trunk_cube *root = trunk_root(trunk, 0, 2);

    assert_non_null(root);
    assert_ptr_equal(trunk_root(trunk, 0, 2), root);
    assert_ptr_not_equal(trunk_root(trunk, 1, 2), root);
    assert_ptr_not_equal(trunk_root(trunk, 0, 4), root);
    assert_false(trunk_has_ended(trunk));
    trunk_end(trunk);
    assert_true(trunk_has_ended(trunk));
    assert_null(trunk_root(trunk, 0, 4));
    trunk_destroy(trunk);
}

static void short_tapes_and_those_of_parents_are_told(void **state)
{
    (void)state;
    struct trunk *trunk = trunk_create();
    struct trunk_cube *root = trunk_root(trunk, 0, 1);
    const uint32_t words[TRUNK_TAPE] = {5};

    trunk_put(trunk, &root->tapes[0], words, TRUNK_TAPE - 1);
    assert_null(root->tapes[0].cube);
    assert_int_equal(root->tapes[0].words[0], 5);
    trunk_put(trunk, &root->tapes[1], NULL, TRUNK_TAPE);
    assert_null(root->tapes[1].words);
    assert_int_equal(root->tapes[1].count, TRUNK_TAPE);
    assert_non_null(root->tapes[1].cube);
    trunk_destroy(trunk);
}

/* --- after an edit --- */

enum { BEFORE = 300, FIRST = 200 };

/* A tape with the operations from this one on; answers the cube of its child. */
static struct trunk_cube *put_from(struct trunk *trunk, struct trunk_tape *tape, uint32_t operation)
{
    uint32_t words[WORDS];

    for (uint32_t i = 0; i < WORDS; i++) {
        words[i] = operation + i;
    }
    trunk_put(trunk, tape, words, WORDS);
    return tape->cube;
}

static void assert_renamed(const struct trunk_tape *tape, const struct matches *matches,
                           uint32_t operation)
{
    for (uint32_t i = 0; i < WORDS; i++) {
        assert_int_equal(tape->words[i], matches->now[operation + i]);
    }
}

static void operations_are_renamed_in_all_cubes(void **state)
{
    (void)state;
    uint32_t now[BEFORE];
    const struct matches matches = {.now = now, .before = BEFORE, .first = FIRST};
    struct trunk *trunk = trunk_create();
    struct trunk_cube *older = trunk_root(trunk, 0, 1), *root = trunk_root(trunk, 0, 2);

    for (uint32_t i = 0; i < BEFORE; i++) {
        now[i] = i < FIRST ? i : i < BEFORE - 1 ? i + 1 : MATCH_NONE;
    }
    struct trunk_cube *child = put_from(trunk, &root->tapes[2], FIRST - WORDS / 2);
    trunk_put(trunk, &child->tapes[5], NULL, WORDS);
    struct trunk_cube *same = child->tapes[5].cube;
    put_from(trunk, &same->tapes[7], FIRST - WORDS + 1);
    put_from(trunk, &same->tapes[0], FIRST - WORDS);
    put_from(trunk, &older->tapes[0], BEFORE - WORDS);
    trunk_rename(trunk, &matches);
    assert_renamed(&root->tapes[2], &matches, FIRST - WORDS / 2);
    assert_renamed(&same->tapes[7], &matches, FIRST - WORDS + 1);
    assert_renamed(&same->tapes[0], &matches, FIRST - WORDS);
    assert_renamed(&older->tapes[0], &matches, BEFORE - WORDS);
    trunk_destroy(trunk);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_make_each_thing_once),
        cmocka_unit_test(roots_are_of_a_space_and_a_size),
        cmocka_unit_test(short_tapes_and_those_of_parents_are_told),
        cmocka_unit_test(operations_are_renamed_in_all_cubes),
    };

    return cmocka_run_group_tests_name("trunk of the cubes", tests, NULL, NULL);
}
