/* SPDX-License-Identifier: MIT */
/* The files that scenes may name: how many and how much of them is kept. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "server/live/uploads.h"

static void add(struct uploads *uploads, int number, size_t length)
{
    struct store_asset asset = {.info = {.type = "image/png", .width = 1, .height = 1},
                                .length = length};

    snprintf(asset.id, sizeof(asset.id), "%064x", (unsigned)number);
    uploads_add(uploads, &asset);
}

static void remove_number(struct uploads *uploads, int number)
{
    char id[ASSET_ID_CHARACTERS + 1];

    snprintf(id, sizeof(id), "%064x", (unsigned)number);
    uploads_remove(uploads, id);
}

static void all_together_are_bounded_in_bytes(void **state)
{
    const int most = LIMIT_ASSETS_BYTES / LIMIT_ASSET_BYTES;
    struct uploads uploads = {0};

    (void)state;
    for (int i = 0; i < most; i++) {
        assert_true(uploads_have_room(&uploads, LIMIT_ASSET_BYTES));
        add(&uploads, i, LIMIT_ASSET_BYTES);
    }
    assert_false(uploads_have_room(&uploads, 1));
    remove_number(&uploads, most);
    assert_false(uploads_have_room(&uploads, 1));
    remove_number(&uploads, 0);
    assert_true(uploads_have_room(&uploads, LIMIT_ASSET_BYTES));
    assert_false(uploads_have_room(&uploads, LIMIT_ASSET_BYTES + 1));
    assert_int_equal(uploads.count, most - 1);
    uploads.pending_bytes = LIMIT_ASSET_BYTES;
    assert_false(uploads_have_room(&uploads, 1));
    uploads_finish(&uploads);
}

static void and_in_number(void **state)
{
    struct uploads uploads = {0};

    (void)state;
    for (int i = 0; i < LIMIT_ASSETS - 1; i++) {
        add(&uploads, i, 1);
    }
    add(&uploads, 0, 1);
    assert_int_equal(uploads.count, LIMIT_ASSETS - 1);
    assert_int_equal(uploads.bytes, LIMIT_ASSETS - 1);
    assert_true(uploads_have_room(&uploads, 1));
    uploads.pending_count = 1;
    assert_false(uploads_have_room(&uploads, 1));
    uploads_finish(&uploads);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_together_are_bounded_in_bytes),
        cmocka_unit_test(and_in_number),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
