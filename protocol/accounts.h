/* SPDX-License-Identifier: MIT */
/* Accounts of time, for work of many on one thread: whose account has the least goes first. Who
 * had nothing to do for a while begins at most ACCOUNTS_CREDIT_US behind the others. Not
 * thread-safe. */
#ifndef PROTOCOL_ACCOUNTS_H
#define PROTOCOL_ACCOUNTS_H

#include <stdbool.h>
#include <stdint.h>

enum {
    ACCOUNTS_CREDIT_US = 20000,
    ACCOUNTS_REMEMBERED = 64, /* that have no work now */
    ACCOUNTS_LEAST_US = 1000, /* that a piece of work costs, so that short ones take turns */
};

struct account;

struct accounts {
    struct account *first;
    int64_t now_us; /* the least of those that could go on, as last seen */
};

/* Work of that name waits, or is done, from now on until accounts_leave. */
struct account *accounts_join(struct accounts *accounts, const char *name);
void accounts_leave(struct accounts *accounts, struct account *account);
int accounts_count(const struct accounts *accounts); /* that are known */
/* Forgets all. */
void accounts_finish(struct accounts *accounts);
const char *account_name(const struct account *account);
/* Whether the work of `a` goes before that of `b`. */
bool account_is_before(const struct account *a, const struct account *b);
/* Work of this account is begun, which none that could be begun goes before. */
void accounts_begin(struct accounts *accounts, const struct account *account);
/* It took so long. */
void accounts_charge(struct account *account, int64_t us);

#endif
