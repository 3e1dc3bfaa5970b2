/* SPDX-License-Identifier: MIT */
/* Orders of pictures: which of them are given up when the worker says nothing of them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "protocol/memory.h"
#include "server/clock.h"
#include "server/live/render_queue.h"
#include "tests/support/silent_hub.h"

static void on_done(void *data, const struct picture_answer *answer, const struct error *err)
{
    assert_null(answer);
    assert_int_equal(err->kind, ERROR_UNAVAILABLE);
    ++*(int *)data;
}

/* Returns the order; `failed` counts its failures. */
static uint32_t order(struct hub *hub, const char *account, int *failed)
{
    static const char *const document = "{\"format\":\"fieldcast/1\"}";
    struct render_order order = {.document = memory_text(document),
                                 .priority = RENDER_IMAGE,
                                 .account = account,
                                 .on_done = on_done,
                                 .data = failed};
    struct error err = {0};

    render_request_init(&order.request);
    const uint32_t id = render_queue_submit(hub, &order, &err);
    assert_int_not_equal(id, 0);
    return id;
}

/* A client's second picture is drawn after the first, however long that takes. */
static void what_waits_for_an_older_picture_is_not_given_up(void **state)
{
    struct hub *hub = silent_hub_open();
    int first = 0, second = 0, other = 0;

    (void)state;
    hub_lock(hub);
    const int64_t now = clock_ms();
    const uint32_t drawn = order(hub, "client", &first);
    order(hub, "client", &second);
    order(hub, "another", &other);
    render_queue_worker_ready(hub);
    for (struct render_entry *entry = hub->render_queue->first; entry; entry = entry->next) {
        assert_true(entry->sent);
        entry->deadline = now;
    }
    render_queue_progress(hub, drawn);
    render_queue_tick(hub, now);
    assert_int_equal(first, 0);
    assert_int_equal(second, 0);
    assert_int_equal(other, 1);
    hub_unlock(hub);
    silent_hub_close(hub);
    assert_int_equal(first, 1);
    assert_int_equal(second, 1);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_waits_for_an_older_picture_is_not_given_up),
    };

    if (silent_hub_was_worker(argc, argv)) {
        return 0;
    }
    return cmocka_run_group_tests_name("render_queue", tests, silent_hub_make_directory,
                                       silent_hub_remove_directory);
}
