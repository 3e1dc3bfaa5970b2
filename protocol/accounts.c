/* SPDX-License-Identifier: MIT */
#include "accounts.h"

#include <stdlib.h>
#include <string.h>

#include "memory.h"

struct account {
    struct account *next;
    char *name;
    int works; /* that wait or are done */
    int64_t us;
};

static int64_t first_us(const struct accounts *accounts)
{
    return accounts->now_us - ACCOUNTS_CREDIT_US;
}

struct account *accounts_join(struct accounts *accounts, const char *name)
{
    struct account **at = &accounts->first;

    while (*at && strcmp((*at)->name, name) != 0) {
        at = &(*at)->next;
    }
    if (!*at) {
        *at = memory_alloc(1, sizeof **at);
        (*at)->name = memory_text(name);
        (*at)->us = first_us(accounts);
    }
    if ((*at)->works++ == 0 && (*at)->us < first_us(accounts)) {
        (*at)->us = first_us(accounts);
    }
    return *at;
}

static void forget(struct account **at)
{
    struct account *account = *at;

    *at = account->next;
    free(account->name);
    free(account);
}

/* Accounts without work are remembered while they have more than a new one; not too many. */
void accounts_leave(struct accounts *accounts, struct account *account)
{
    struct account **least = NULL;
    int idle = 0;

    account->works--;
    for (struct account **at = &accounts->first; *at;) {
        if ((*at)->works == 0 && (*at)->us <= first_us(accounts)) {
            forget(at);
            continue;
        }
        if ((*at)->works == 0) {
            least = !least || (*at)->us < (*least)->us ? at : least;
            idle++;
        }
        at = &(*at)->next;
    }
    if (idle > ACCOUNTS_REMEMBERED) {
        forget(least);
    }
}

int accounts_count(const struct accounts *accounts)
{
    int count = 0;

    for (const struct account *account = accounts->first; account; account = account->next) {
        count++;
    }
    return count;
}

void accounts_finish(struct accounts *accounts)
{
    while (accounts->first) {
        forget(&accounts->first);
    }
}

const char *account_name(const struct account *account)
{
    return account->name;
}

bool account_is_before(const struct account *a, const struct account *b)
{
    return a->us < b->us;
}

void accounts_begin(struct accounts *accounts, const struct account *account)
{
    if (account->us > accounts->now_us) {
        accounts->now_us = account->us;
    }
}

void accounts_charge(struct account *account, int64_t us)
{
    account->us += us > ACCOUNTS_LEAST_US ? us : ACCOUNTS_LEAST_US;
}
