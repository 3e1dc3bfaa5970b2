/* SPDX-License-Identifier: MIT */
/* The bound of bodies of requests. They are made long without bytes being copied. */
#include <pthread.h>
#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "server/net/body.h"

enum { ROUNDS = 10, BODIES = 50000, LARGE = 70000 }; /* a round's together less than the bound */

struct crowd {
    struct bodies bodies;
    struct body all[BODIES];
    atomic_size_t grown; /* of them */
};

/* As the threads do that answer whose client has left. */
static void *finish_each(void *data)
{
    struct crowd *crowd = data;

    for (size_t i = 0; i < BODIES; i++) {
        while (atomic_load(&crowd->grown) <= i) {
            sched_yield();
        }
        body_finish(&crowd->all[i]);
    }
    return NULL;
}

static void grow_and_finish(void)
{
    struct crowd *crowd = calloc(1, sizeof *crowd);
    pthread_t thread;

    assert_int_equal(pthread_create(&thread, NULL, finish_each, crowd), 0);
    for (size_t i = 0; i < BODIES; i++) {
        struct body *body = &crowd->all[i];
        struct request request = {.body_length = LARGE};

        body->bodies = &crowd->bodies;
        body->most = LARGE;
        assert_true(body_add(body, &request, "", 0));
        free(request.body);
        atomic_fetch_add(&crowd->grown, 1);
    }
    pthread_join(thread, NULL);
    assert_int_equal(atomic_load(&crowd->bodies.held), 0);
    free(crowd);
}

static void end_on_any_thread(void **state)
{
    (void)state;
    for (int i = 0; i < ROUNDS; i++) {
        grow_and_finish();
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(end_on_any_thread),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
