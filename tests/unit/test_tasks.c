/* SPDX-License-Identifier: MIT */
/* Who waits for whom: light tasks for no heavy one, those of a scene for each other, clients by
 * turns. */
#include <pthread.h>
#include <semaphore.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/limits.h"
#include "server/clock.h"
#include "server/tasks.h"

enum { MOST = 200 };

/* What was done, in order: names of one letter. */
struct diary {
    pthread_mutex_t lock;
    char done[MOST + 1];
    size_t count, dropped;
    sem_t written;
};

struct errand {
    struct diary *diary;
    char name;
    sem_t *begun, *go; /* NULL: it does not wait */
    int ms;            /* of the processor that it takes */
};

static void spend(int ms)
{
    const int64_t end_us = clock_thread_us() + (int64_t)1000 * ms;

    while (clock_thread_us() < end_us) {
    }
}

static struct diary *open_diary(struct diary *diary)
{
    *diary = (struct diary){.lock = PTHREAD_MUTEX_INITIALIZER};
    sem_init(&diary->written, 0, 0);
    return diary;
}

static void write_down(void *data, bool dropped)
{
    struct errand *errand = data;
    struct diary *diary = errand->diary;

    if (errand->begun) {
        sem_post(errand->begun);
    }
    if (errand->go && !dropped) {
        sem_wait(errand->go);
    }
    spend(errand->ms);
    pthread_mutex_lock(&diary->lock);
    diary->dropped += dropped;
    diary->done[diary->count++] = errand->name;
    pthread_mutex_unlock(&diary->lock);
    sem_post(&diary->written);
}

static bool add(struct tasks *tasks, struct errand *errand, const char *scene, const char *account,
                bool heavy)
{
    return tasks_add(tasks,
                     &(struct task_order){.scene = scene,
                                          .account = account,
                                          .heavy = heavy,
                                          .bounded = true,
                                          .run = write_down,
                                          .data = errand},
                     NULL);
}

static void wait_for(struct diary *diary, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        sem_wait(&diary->written);
    }
}

static void light_passes_heavy(void **state)
{
    struct diary diary;
    sem_t go;
    struct tasks *tasks = tasks_create(NULL, NULL);
    struct errand heavy = {open_diary(&diary), 'H', NULL, &go, 0},
                  next = {&diary, 'h', NULL, NULL, 0}, light = {&diary, 'l', NULL, NULL, 0};

    (void)state;
    sem_init(&go, 0, 0);
    assert_true(add(tasks, &heavy, "a", "one", true));
    assert_true(add(tasks, &next, "b", "one", true));
    assert_true(add(tasks, &light, "c", "one", false));
    assert_true(add(tasks, &light, "c", "two", false));
    wait_for(&diary, 2);
    sem_post(&go);
    wait_for(&diary, 2);
    assert_string_equal(diary.done, "llHh");
    tasks_destroy(tasks);
}

static void one_scene_is_in_order(void **state)
{
    struct diary diary;
    sem_t go;
    struct tasks *tasks = tasks_create(NULL, NULL);
    struct errand heavy = {open_diary(&diary), 'H', NULL, &go, 0},
                  same = {&diary, 's', NULL, NULL, 0}, other = {&diary, 'o', NULL, NULL, 0};

    (void)state;
    sem_init(&go, 0, 0);
    assert_true(add(tasks, &heavy, "a", "one", true));
    assert_true(add(tasks, &same, "a", "two", false));
    assert_true(add(tasks, &other, "b", "three", false));
    wait_for(&diary, 1);
    sem_post(&go);
    wait_for(&diary, 2);
    assert_string_equal(diary.done, "oHs");
    tasks_destroy(tasks);
}

static void clients_take_turns(void **state)
{
    struct diary diary;
    sem_t begun, go;
    struct tasks *tasks = tasks_create(NULL, NULL);
    struct errand first = {open_diary(&diary), 'H', &begun, &go, 0},
                  many = {&diary, 'm', NULL, NULL, 0}, other = {&diary, 'o', NULL, NULL, 0};

    (void)state;
    sem_init(&begun, 0, 0);
    sem_init(&go, 0, 0);
    assert_true(add(tasks, &first, "", "many", true));
    sem_wait(&begun);
    for (int i = 0; i < 4; i++) {
        assert_true(add(tasks, &many, "", "many", true));
    }
    assert_true(add(tasks, &other, "", "other", true));
    assert_true(add(tasks, &other, "", "other", true));
    sem_post(&go);
    wait_for(&diary, 7);
    assert_string_equal(diary.done, "Homommm");
    tasks_destroy(tasks);
}

/* All ten of one client take less than one of another. */
static void the_client_that_took_the_least_time_is_next(void **state)
{
    struct diary diary;
    sem_t begun, go;
    struct tasks *tasks = tasks_create(NULL, NULL);
    struct errand first = {open_diary(&diary), 'H', &begun, &go, 0},
                  slow = {&diary, 's', NULL, NULL, 200}, quick = {&diary, 'q', NULL, NULL, 2};

    (void)state;
    sem_init(&begun, 0, 0);
    sem_init(&go, 0, 0);
    assert_true(add(tasks, &first, "", "first", true));
    sem_wait(&begun);
    for (int i = 0; i < 3; i++) {
        assert_true(add(tasks, &slow, "", "slow", true));
    }
    for (int i = 0; i < 10; i++) {
        assert_true(add(tasks, &quick, "", "quick", true));
    }
    sem_post(&go);
    wait_for(&diary, 14);
    assert_string_equal(diary.done, "Hsqqqqqqqqqqss");
    tasks_destroy(tasks);
}

static void heavy_ones_are_bounded(void **state)
{
    struct diary diary;
    sem_t begun, go;
    struct error err = {0};
    struct metrics metrics = {0};
    struct tasks *tasks = tasks_create(&metrics, NULL);
    struct errand first = {open_diary(&diary), 'H', &begun, &go, 0},
                  many = {&diary, 'm', NULL, NULL, 0};

    (void)state;
    sem_init(&begun, 0, 0);
    sem_init(&go, 0, 0);
    assert_true(add(tasks, &first, "", "many", true));
    sem_wait(&begun);
    for (int i = 0; i < LIMIT_DOCUMENT_SHARE; i++) {
        assert_true(add(tasks, &many, "", "many", true));
    }
    assert_false(tasks_add(
        tasks, &(struct task_order){.scene = "", .account = "many", .heavy = true, .bounded = true},
        &err));
    assert_int_equal(err.kind, ERROR_SHARE);
    assert_true(err.retry_ms > 0);
    assert_int_equal(metric_get(&metrics, METRIC_DOCUMENTS_OVER_SHARE), 1);
    for (int i = LIMIT_DOCUMENT_SHARE; i < LIMIT_DOCUMENT_QUEUE; i++) {
        char account[16];

        snprintf(account, sizeof account, "%d", i);
        assert_true(add(tasks, &many, "", account, true));
    }
    assert_false(add(tasks, &many, "", "last", true));
    assert_int_equal(metric_get(&metrics, METRIC_DOCUMENTS_OVER_QUEUE), 1);
    assert_int_equal(metric_get(&metrics, METRIC_DOCUMENTS_OVER_SHARE), 1);
    assert_true(add(tasks, &many, "", "many", false));
    sem_post(&go);
    wait_for(&diary, LIMIT_DOCUMENT_QUEUE + 2);
    tasks_destroy(tasks);
}

static void what_waits_is_dropped_at_the_end(void **state)
{
    struct diary diary;
    sem_t begun, go;
    struct error err = {0};
    struct metrics metrics = {0};
    struct tasks *tasks = tasks_create(&metrics, NULL);
    struct errand first = {open_diary(&diary), 'H', &begun, &go, 0},
                  next = {&diary, 'h', NULL, NULL, 0};

    (void)state;
    sem_init(&begun, 0, 0);
    sem_init(&go, 0, 0);
    assert_true(add(tasks, &first, "a", "one", true));
    sem_wait(&begun);
    assert_true(add(tasks, &next, "a", "one", true));
    assert_int_equal(metric_get(&metrics, METRIC_DOCUMENTS_WAITING), 2);
    sem_post(&go);
    tasks_stop(tasks);
    wait_for(&diary, 2);
    assert_string_equal(diary.done, "Hh");
    assert_int_equal(metric_get(&metrics, METRIC_DOCUMENTS_WAITING), 0);
    assert_false(tasks_add(tasks, &(struct task_order){.scene = "", .account = ""}, &err));
    assert_int_equal(err.kind, ERROR_UNAVAILABLE);
    tasks_destroy(tasks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_passes_heavy),
        cmocka_unit_test(one_scene_is_in_order),
        cmocka_unit_test(clients_take_turns),
        cmocka_unit_test(the_client_that_took_the_least_time_is_next),
        cmocka_unit_test(heavy_ones_are_bounded),
        cmocka_unit_test(what_waits_is_dropped_at_the_end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
