/* SPDX-License-Identifier: MIT */
/* Whose picture goes on next: the queue of the drawing thread, without anything to draw. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "renderer/worker/turns.h"
#include "renderer/worker/worker_protocol.h"

enum { MOVING, STILL, LOSSLESS, IMAGE };

struct picture {
    const char *account;
    int priority;
    uint64_t step_us; /* that one of its steps takes */
    uint64_t pixels;
    struct turn *turn;
    int steps;    /* done */
    bool waiting; /* for a compiler */
};

static struct turns turns;

static void join(struct picture *picture)
{
    picture->turn = turns_join(&turns, picture->account);
}

static void leave(struct picture *picture)
{
    turns_leave(&turns, picture->turn);
}

/* The one that has a step; NULL: none. */
static struct picture *step(struct picture *pictures, int count)
{
    turns_begin(&turns);
    for (int i = 0; i < count; i++) {
        if (!pictures[i].waiting) {
            turns_offer(
                &turns, pictures[i].turn,
                &(struct turns_offer){pictures[i].priority, pictures[i].pixels, &pictures[i]});
        }
    }
    struct picture *chosen = turns_choose(&turns);
    if (chosen) {
        turns_charge(&turns, chosen->turn, chosen->priority, chosen->step_us);
        chosen->steps++;
    }
    return chosen;
}

static void finish(void)
{
    turns_finish(&turns);
    assert_null(turns.first);
    turns = (struct turns){0};
}

static void run(struct picture *pictures, int count, int steps)
{
    for (int i = 0; i < count; i++) {
        join(&pictures[i]);
    }
    for (int i = 0; i < steps; i++) {
        step(pictures, count);
    }
    for (int i = 0; i < count; i++) {
        leave(&pictures[i]);
    }
    finish();
}

static void nothing_is_taken_of_nothing(void **state)
{
    (void)state;
    assert_null(step(NULL, 0));
}

/* By drawing time, not by steps. */
static void equal_shares(void **state)
{
    struct picture two[] = {{.account = "heavy", .priority = STILL, .step_us = 200000},
                            {.account = "light", .priority = STILL, .step_us = 5000}};

    (void)state;
    run(two, 2, 4100);
    assert_in_range(two[0].steps, 99, 101);
    assert_in_range(two[1].steps, 3999, 4001);
}

/* However many pictures a client has, it has one share. */
static void clients_count(void **state)
{
    struct picture many[] = {{.account = "a", .priority = IMAGE, .step_us = 1000},
                             {.account = "b", .priority = IMAGE, .step_us = 1000},
                             {.account = "b", .priority = IMAGE, .step_us = 1000},
                             {.account = "b", .priority = IMAGE, .step_us = 1000}};

    (void)state;
    run(many, 4, 2000);
    assert_in_range(many[0].steps, 999, 1001);
    assert_in_range(many[1].steps + many[2].steps + many[3].steps, 999, 1001);
    assert_true(many[1].steps > many[2].steps + many[3].steps); /* the oldest first, to its end */
}

/* A small picture does not wait for a client's large ones, which still go on. */
static void small_first(void **state)
{
    struct picture two[] = {
        {.account = "a", .priority = IMAGE, .step_us = 1000, .pixels = 1 << 28},
        {.account = "a", .priority = IMAGE, .step_us = 1000, .pixels = 64 * 48}};

    (void)state;
    run(two, 2, 800);
    assert_int_equal(two[0].steps, 800 / TURNS_OLDEST_EVERY);
}

static void urgent_first(void **state)
{
    struct picture two[] = {{.account = "a", .priority = IMAGE, .step_us = 10000},
                            {.account = "b", .priority = MOVING, .step_us = 10000}};

    (void)state;
    join(&two[0]);
    for (int i = 0; i < 50; i++) {
        step(two, 1);
    }
    join(&two[1]);
    for (int i = 0; i < 20; i++) { /* a whole picture of it */
        assert_ptr_equal(step(two, 2), &two[1]);
    }
    leave(&two[0]);
    leave(&two[1]);
    finish();
}

/* However urgent one client's pictures are, another's go on. */
static void nobody_starves(void **state)
{
    for (int priority = MOVING; priority <= IMAGE; priority++) {
        struct picture two[] = {{.account = "heavy", .priority = MOVING, .step_us = 50000},
                                {.account = "other", .priority = priority, .step_us = 10000}};

        run(two, 2, 1000);
        assert_true(two[1].steps * 10000 * 6 > two[0].steps * 50000);
    }
    (void)state;
}

/* Of fifty-one who ask for the next picture a little after each, the one does not get less. */
static void many_readers(void **state)
{
    enum { READERS = 51, EACH = 100 };
    struct picture readers[READERS];
    char accounts[READERS][16];
    int idle[READERS] = {0}; /* steps of others until it asks again */

    (void)state;
    for (int i = 0; i < READERS; i++) {
        snprintf(accounts[i], sizeof accounts[i], "%d", i);
        readers[i] = (struct picture){.account = accounts[i], .priority = MOVING, .step_us = 8000};
        join(&readers[i]);
    }
    for (int done = 0; done < READERS * EACH; done++) {
        struct picture *drawn = step(readers, READERS);
        const int who = (int)(drawn - readers);

        leave(drawn);
        drawn->waiting = true;
        idle[who] = 1 + who % 7;
        for (int i = 0; i < READERS; i++) {
            if (readers[i].waiting && --idle[i] == 0) {
                readers[i].waiting = false;
                join(&readers[i]);
            }
        }
    }
    for (int i = 0; i < READERS; i++) {
        assert_in_range(readers[i].steps, 0.8 * EACH, 1.2 * EACH);
        if (!readers[i].waiting) {
            leave(&readers[i]);
        }
    }
    finish();
}

/* Newcomers get as much as all others together, who are equal among themselves. */
static void newcomers_have_half(void **state)
{
    enum { MOST = 40, STEPS = 4000 };
    const int counts[] = {1, 2, MOST};

    (void)state;
    for (int k = 0; k < (int)(sizeof counts / sizeof *counts); k++) {
        struct picture all[MOST + 1] = {
            {.account = ACCOUNT_NEWCOMERS, .priority = MOVING, .step_us = 8000}};
        char accounts[MOST][16];

        for (int i = 0; i < counts[k]; i++) {
            snprintf(accounts[i], sizeof accounts[i], "%d", i);
            all[i + 1] =
                (struct picture){.account = accounts[i], .priority = MOVING, .step_us = 8000};
        }
        run(all, counts[k] + 1, STEPS);
        assert_in_range(all[0].steps, 0.45 * STEPS, 0.55 * STEPS);
        for (int i = 1; i <= counts[k]; i++) {
            assert_in_range(all[i].steps * counts[k], 0.4 * STEPS, 0.6 * STEPS);
        }
    }
}

/* What is not urgent waits for as much drawing beside ten as beside one. */
static void image_beside_readers(void **state)
{
    enum { READERS = 10, STEP_US = 10000, AHEAD = IMAGE * TURNS_AHEAD_US / STEP_US };
    enum { TILES = 5, COST = 4 }; /* of the image */
    struct picture all[READERS + 1];
    char accounts[READERS + 1][16];
    int steps = 0;

    (void)state;
    for (int i = 0; i <= READERS; i++) {
        snprintf(accounts[i], sizeof accounts[i], "%d", i);
        all[i] = (struct picture){
            .account = accounts[i], .priority = i < READERS ? MOVING : IMAGE, .step_us = STEP_US};
    }
    for (int i = 0; i < READERS; i++) {
        join(&all[i]);
    }
    for (int i = 0; i < 1000; i++) {
        step(all, READERS);
    }
    join(&all[READERS]);
    while (step(all, READERS + 1) != &all[READERS]) {
        steps++;
    }
    assert_in_range(steps, 0, AHEAD + READERS);
    while (all[READERS].steps < TILES) {
        step(all, READERS + 1);
        steps++;
    }
    assert_in_range(steps, TILES * READERS, AHEAD + TILES * COST * READERS);
    for (int i = 0; i <= READERS; i++) {
        leave(&all[i]);
    }
    finish();
}

/* Within an account neither. */
static void oldest_within_account(void **state)
{
    struct picture two[] = {{.account = "a", .priority = IMAGE, .step_us = 1000},
                            {.account = "a", .priority = MOVING, .step_us = 1000}};

    (void)state;
    run(two, 2, 800);
    assert_int_equal(two[0].steps, 800 / TURNS_OLDEST_EVERY);
}

/* Who could not go on has little claim to what others got meanwhile: TURNS_CREDIT_US. */
static void little_credit(void **state)
{
    struct picture two[] = {
        {.account = "compiles", .priority = MOVING, .step_us = 10000, .waiting = true},
        {.account = "draws", .priority = MOVING, .step_us = 10000}};

    (void)state;
    join(&two[0]);
    join(&two[1]);
    for (int i = 0; i < 1000; i++) {
        assert_ptr_equal(step(two, 2), &two[1]);
    }
    two[0].waiting = false;
    for (int i = 0; i < TURNS_CREDIT_US / 10000 + 20; i++) {
        step(two, 2);
    }
    assert_int_equal(two[0].steps, TURNS_CREDIT_US / 10000 + 10);
    leave(&two[0]);
    leave(&two[1]);
    finish();
}

/* Small pictures, asked for again and again, each come between two tiles of a heavy one. */
static void small_between_heavy(void **state)
{
    enum { TILES = 100 };
    struct picture two[] = {{.account = "heavy", .priority = MOVING, .step_us = 100000},
                            {.account = "light", .priority = MOVING, .step_us = 2000}};
    int pictures = 0;

    (void)state;
    join(&two[0]);
    while (two[0].steps < TILES) {
        join(&two[1]);
        while (step(two, 2) != &two[1]) {
        }
        leave(&two[1]);
        pictures++;
    }
    assert_true(pictures >= TILES);
    leave(&two[0]);
    finish();
}

/* Pictures of a client that asks for a third of the time are not cut up, whether or not others
 * always have some. */
static void small_at_once(void **state)
{
    enum { STEPS = 4, PICTURES = 100 };

    (void)state;
    for (int pauses = 0; pauses < 2; pauses++) {
        struct picture two[] = {{.account = "heavy", .priority = MOVING, .step_us = 8000},
                                {.account = "light", .priority = MOVING, .step_us = 2000}};
        join(&two[0]);
        for (int picture = 0; picture < PICTURES; picture++) {
            step(two, 1);
            step(two, 1);
            join(&two[1]);
            for (int i = 0; i < STEPS; i++) {
                assert_ptr_equal(step(two, 2), &two[1]);
            }
            leave(&two[1]);
            if (pauses) {
                leave(&two[0]);
                join(&two[0]);
            }
        }
        leave(&two[0]);
        finish();
    }
}

/* Who comes once is not remembered for ever. */
static void few_remembered(void **state)
{
    struct picture one = {.priority = MOVING, .step_us = 1000};
    char account[16];

    (void)state;
    for (int i = 0; i < 10 * TURNS_REMEMBERED; i++) {
        snprintf(account, sizeof account, "%d", i);
        one.account = account;
        join(&one);
        step(&one, 1);
        leave(&one);
    }
    assert_in_range(turns.accounts, 1, TURNS_REMEMBERED);
    finish();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_taken_of_nothing),
        cmocka_unit_test(equal_shares),
        cmocka_unit_test(clients_count),
        cmocka_unit_test(urgent_first),
        cmocka_unit_test(small_first),
        cmocka_unit_test(nobody_starves),
        cmocka_unit_test(many_readers),
        cmocka_unit_test(newcomers_have_half),
        cmocka_unit_test(image_beside_readers),
        cmocka_unit_test(oldest_within_account),
        cmocka_unit_test(little_credit),
        cmocka_unit_test(small_between_heavy),
        cmocka_unit_test(small_at_once),
        cmocka_unit_test(few_remembered),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
