/* SPDX-License-Identifier: MIT */
/* Whose work goes first: that of the account with the least time, without too old a past. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#include "protocol/accounts.h"

enum { MANY = 1000 };

static struct accounts accounts;

static void work(struct account *account, int64_t us)
{
    accounts_begin(&accounts, account);
    accounts_charge(account, us);
}

static void the_least_goes_first(void **state)
{
    struct account *a = accounts_join(&accounts, "a"), *b = accounts_join(&accounts, "b");

    (void)state;
    assert_false(account_is_before(a, b) || account_is_before(b, a));
    work(a, 50000);
    assert_true(account_is_before(b, a));
    work(b, 70000);
    assert_true(account_is_before(a, b));
    assert_ptr_equal(accounts_join(&accounts, "a"), a);
    accounts_leave(&accounts, a);
    assert_true(account_is_before(a, b));
    accounts_leave(&accounts, a);
    accounts_leave(&accounts, b);
    accounts_finish(&accounts);
}

static void short_work_costs_something(void **state)
{
    struct account *a = accounts_join(&accounts, "a"), *b = accounts_join(&accounts, "b");

    (void)state;
    work(a, 0);
    assert_true(account_is_before(b, a));
    accounts_leave(&accounts, a);
    accounts_leave(&accounts, b);
    accounts_finish(&accounts);
}

/* Who comes or comes back is ahead by the credit, not by all that the others had meanwhile. */
static void nobody_saves_up(void **state)
{
    struct account *old = accounts_join(&accounts, "old"), *busy = accounts_join(&accounts, "busy");

    (void)state;
    accounts_leave(&accounts, old);
    for (int i = 0; i < MANY; i++) {
        work(busy, 10000);
    }
    accounts_begin(&accounts, busy);
    old = accounts_join(&accounts, "old");
    assert_true(account_is_before(old, busy));
    work(old, ACCOUNTS_CREDIT_US);
    work(old, ACCOUNTS_LEAST_US);
    assert_true(account_is_before(busy, old));
    accounts_leave(&accounts, old);
    accounts_leave(&accounts, busy);
    accounts_finish(&accounts);
}

static void what_was_taken_is_not_forgotten_by_leaving(void **state)
{
    struct account *stays = accounts_join(&accounts, "stays");
    struct account *leaves = accounts_join(&accounts, "leaves");

    (void)state;
    work(leaves, 500000);
    accounts_leave(&accounts, leaves);
    work(stays, 10000);
    assert_true(account_is_before(stays, accounts_join(&accounts, "leaves")));
    accounts_leave(&accounts, accounts.first);
    accounts_finish(&accounts);
}

static void not_all_are_remembered(void **state)
{
    (void)state;
    for (int i = 0; i < MANY; i++) {
        char name[16];

        snprintf(name, sizeof name, "%d", i);
        struct account *account = accounts_join(&accounts, name);
        work(account, 1000);
        accounts_leave(&accounts, account);
    }
    assert_true(accounts_count(&accounts) <= ACCOUNTS_REMEMBERED);
    accounts_finish(&accounts);
    assert_int_equal(accounts_count(&accounts), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_least_goes_first),
        cmocka_unit_test(short_work_costs_something),
        cmocka_unit_test(nobody_saves_up),
        cmocka_unit_test(what_was_taken_is_not_forgotten_by_leaving),
        cmocka_unit_test(not_all_are_remembered),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
