/* SPDX-License-Identifier: MIT */
/* Doorbells wait while their thread holds them, and those of other threads do not. */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmocka.h>

#include "server/doorbell.h"
#include "server/live/hub.h"
#include "server/metrics.h"
#include "server/net/ws.h"

enum { BELLS = 9 };

static int rung[BELLS];

static void ring(void *data)
{
    (*(int *)data)++;
}

static int silence(void **state)
{
    (void)state;
    for (int i = 0; i < BELLS; i++) {
        rung[i] = 0;
    }
    return 0;
}

static void rings_at_once(void **state)
{
    const struct doorbell bell = {ring, &rung[0]};

    (void)state;
    doorbell_ring(&bell);
    doorbell_ring(&bell);
    assert_int_equal(rung[0], 2);
}

static void waits_while_held(void **state)
{
    const struct doorbell bells[] = {{ring, &rung[0]}, {ring, &rung[1]}};

    (void)state;
    doorbells_hold();
    doorbell_ring(&bells[0]);
    doorbell_ring(&bells[1]);
    doorbell_ring(&bells[0]);
    assert_int_equal(rung[0] + rung[1], 0);
    doorbells_release();
    assert_int_equal(rung[0], 1);
    assert_int_equal(rung[1], 1);
    doorbells_release();
    assert_int_equal(rung[0], 1);
    doorbell_ring(&bells[0]);
    assert_int_equal(rung[0], 2);
}

static void none_is_lost(void **state)
{
    struct doorbell bells[BELLS];

    (void)state;
    doorbells_hold();
    for (int i = 0; i < 2 * BELLS; i++) {
        bells[i % BELLS] = (struct doorbell){ring, &rung[i % BELLS]};
        doorbell_ring(&bells[i % BELLS]);
    }
    doorbells_release();
    for (int i = 0; i < BELLS; i++) {
        assert_true(rung[i] >= 1);
    }
}

static void ring_next(void *data)
{
    doorbell_ring(data);
}

/* What a doorbell rings does not wait either. */
static void rings_on(void **state)
{
    struct doorbell last = {ring, &rung[0]};
    const struct doorbell first = {ring_next, &last};

    (void)state;
    doorbells_hold();
    doorbell_ring(&first);
    doorbells_release();
    assert_int_equal(rung[0], 1);
}

static void *ring_elsewhere(void *data)
{
    doorbell_ring(data);
    return NULL;
}

static void other_threads_do_not_wait(void **state)
{
    struct doorbell bell = {ring, &rung[0]};
    pthread_t thread;

    (void)state;
    doorbells_hold();
    assert_int_equal(pthread_create(&thread, NULL, ring_elsewhere, &bell), 0);
    pthread_join(thread, NULL);
    assert_int_equal(rung[0], 1);
    doorbells_release();
    assert_int_equal(rung[0], 1);
}

static void the_lock_of_the_hub_holds_them(void **state)
{
    const struct doorbell bell = {ring, &rung[0]};
    struct hub hub = {0};

    (void)state;
    pthread_mutex_init(&hub.lock, NULL);
    hub_lock(&hub);
    doorbell_ring(&bell);
    assert_int_equal(rung[0], 0);
    hub_unlock(&hub);
    assert_int_equal(rung[0], 1);
    pthread_mutex_destroy(&hub.lock);
}

static void pass(struct hub *hub)
{
    (void)hub;
}

/* The server may stop before it has adopted the connection, or after. */
static struct session *open_none(struct hub *hub, void (*wake)(void *connection), void *connection)
{
    (void)hub;
    (void)wake;
    (void)connection;
    return NULL;
}

/* Under the hub's lock a thread wakes a connection; the server stops before it has let go. */
static void one_rings_after_the_end(void **state)
{
    struct metrics metrics = {0};
    const struct ws_app app = {
        .metrics = &metrics, .lock = pass, .unlock = pass, .open = open_none};
    const struct http_head head = {0};
    struct error err = {0};
    struct ws *ws = ws_create(&app, &err);
    int ends[2];

    (void)state;
    assert_non_null(ws);
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
    doorbells_hold();
    ws_adopt(ws, ends[0], &head, "scene");
    ws_stop(ws);
    doorbells_release();
    ws_destroy(ws);
    close(ends[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(rings_at_once, silence),
        cmocka_unit_test_setup(waits_while_held, silence),
        cmocka_unit_test_setup(none_is_lost, silence),
        cmocka_unit_test_setup(rings_on, silence),
        cmocka_unit_test_setup(other_threads_do_not_wait, silence),
        cmocka_unit_test_setup(the_lock_of_the_hub_holds_them, silence),
        cmocka_unit_test_setup(one_rings_after_the_end, silence),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
