/* SPDX-License-Identifier: MIT */
/* The files that scenes may name: how many and how much of them is kept. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "server/live/asset_index.h"

static void add(struct asset_index *assets, int number, size_t length)
{
    struct store_asset asset = {.info = {.type = "image/png", .width = 1, .height = 1},
                                .length = length};

    snprintf(asset.id, sizeof asset.id, "%064x", (unsigned)number);
    asset_index_add(assets, &asset);
}

static void remove_number(struct asset_index *assets, int number)
{
    char id[ASSET_ID_CHARACTERS + 1];

    snprintf(id, sizeof id, "%064x", (unsigned)number);
    asset_index_remove(assets, id);
}

static void all_together_are_bounded_in_bytes(void **state)
{
    const int most = LIMIT_ASSETS_BYTES / LIMIT_ASSET_BYTES;
    struct asset_index assets = {0};

    (void)state;
    for (int i = 0; i < most; i++) {
        assert_true(asset_index_have_room(&assets, LIMIT_ASSET_BYTES));
        add(&assets, i, LIMIT_ASSET_BYTES);
    }
    assert_false(asset_index_have_room(&assets, 1));
    remove_number(&assets, most);
    assert_false(asset_index_have_room(&assets, 1));
    remove_number(&assets, 0);
    assert_true(asset_index_have_room(&assets, LIMIT_ASSET_BYTES));
    assert_false(asset_index_have_room(&assets, LIMIT_ASSET_BYTES + 1));
    assert_int_equal(assets.count, most - 1);
    assets.pending_bytes = LIMIT_ASSET_BYTES;
    assert_false(asset_index_have_room(&assets, 1));
    asset_index_finish(&assets);
}

static void and_in_number(void **state)
{
    struct asset_index assets = {0};

    (void)state;
    for (int i = 0; i < LIMIT_ASSETS - 1; i++) {
        add(&assets, i, 1);
    }
    add(&assets, 0, 1);
    assert_int_equal(assets.count, LIMIT_ASSETS - 1);
    assert_int_equal(assets.bytes, LIMIT_ASSETS - 1);
    assert_true(asset_index_have_room(&assets, 1));
    assets.pending_count = 1;
    assert_false(asset_index_have_room(&assets, 1));
    asset_index_finish(&assets);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_together_are_bounded_in_bytes),
        cmocka_unit_test(and_in_number),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
