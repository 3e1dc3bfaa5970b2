/* SPDX-License-Identifier: MIT */
#include "turns.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "worker_protocol.h"

struct turn {
    struct turn *next;
    char *account;
    bool newcomers; /* have as much as all others together */
    int pictures;
    uint64_t us;              /* drawing time, weighed by how urgent it was */
    uint64_t steps;           /* ever */
    uint64_t round;           /* in which it could go on last */
    struct turns_offer offer; /* the best of this round; no picture: none */
};

/* What a microsecond costs, by priority. */
static const uint64_t costs[TURNS_PRIORITIES] = {1, 1, 2, 4};

static int clamped(int priority)
{
    return priority < 0 ? 0 : priority >= TURNS_PRIORITIES ? TURNS_PRIORITIES - 1 : priority;
}

/* --- accounts --- */

struct turn *turns_join(struct turns *turns, const char *account)
{
    struct turn **at = &turns->first;

    while (*at && strcmp((*at)->account, account) != 0) {
        at = &(*at)->next;
    }
    if (!*at) {
        *at = memory_alloc(1, sizeof **at);
        (*at)->account = memory_text(account);
        (*at)->newcomers = strcmp(account, ACCOUNT_NEWCOMERS) == 0;
        turns->accounts++;
    }
    (*at)->pictures++;
    return *at;
}

/* The least that an account begins with. */
static uint64_t first_us(const struct turns *turns)
{
    return turns->now_us > TURNS_CREDIT_US ? turns->now_us - TURNS_CREDIT_US : 0;
}

static void forget(struct turns *turns, struct turn **at)
{
    struct turn *turn = *at;

    *at = turn->next;
    turns->accounts--;
    turns->last = turns->last == turn ? NULL : turns->last;
    free(turn->account);
    free(turn);
}

/* Accounts without pictures are remembered while they have more than a new one; not too many. */
static void forget_some(struct turns *turns)
{
    struct turn **least = NULL;
    int busy = 0;

    for (struct turn **at = &turns->first; *at;) {
        if ((*at)->pictures == 0 && (*at)->us <= first_us(turns)) {
            forget(turns, at);
            continue;
        }
        if ((*at)->pictures > 0) {
            busy++;
        } else if (!least || (*at)->us < (*least)->us) {
            least = at;
        }
        at = &(*at)->next;
    }
    if (turns->accounts - busy > TURNS_REMEMBERED) {
        forget(turns, least);
    }
}

void turns_leave(struct turns *turns, struct turn *turn)
{
    turn->pictures--;
    forget_some(turns);
}

void turns_finish(struct turns *turns)
{
    while (turns->first) {
        forget(turns, &turns->first);
    }
}

/* --- choosing --- */

void turns_begin(struct turns *turns)
{
    turns->round++;
    for (struct turn *turn = turns->first; turn; turn = turn->next) {
        turn->offer.picture = NULL;
    }
}

static bool is_better(const struct turns_offer *a, const struct turns_offer *b)
{
    return a->priority != b->priority ? a->priority < b->priority : a->pixels < b->pixels;
}

void turns_offer(struct turns *turns, struct turn *turn, const struct turns_offer *offer)
{
    const bool oldest = turn->steps % TURNS_OLDEST_EVERY == TURNS_OLDEST_EVERY - 1;
    const struct turns_offer wanted = {clamped(offer->priority), offer->pixels, offer->picture};

    if (turn->round + 1 < turns->round && turn->us < first_us(turns)) {
        turn->us = first_us(turns);
    }
    turn->round = turns->round;
    if (!turn->offer.picture || (!oldest && is_better(&wanted, &turn->offer))) {
        turn->offer = wanted;
    }
}

/* `ahead_us`: by which each account may run ahead. */
static uint64_t due(const struct turn *turn, uint64_t ahead_us)
{
    return turn->us + (uint64_t)turn->offer.priority * ahead_us;
}

static uint64_t count_offers(const struct turns *turns)
{
    uint64_t count = 0;

    for (const struct turn *turn = turns->first; turn; turn = turn->next) {
        count += turn->offer.picture != NULL;
    }
    return count;
}

void *turns_choose(struct turns *turns)
{
    const uint64_t offers = count_offers(turns);
    const uint64_t ahead_us = offers > 0 ? TURNS_AHEAD_US / offers : 0;
    const struct turn *best = NULL;
    uint64_t least = UINT64_MAX, best_due = UINT64_MAX;

    for (const struct turn *turn = turns->first; turn; turn = turn->next) {
        if (!turn->offer.picture) {
            continue;
        }
        least = turn->us < least ? turn->us : least;
        const uint64_t at = due(turn, ahead_us);
        if (!best || at < best_due || (at == best_due && best == turns->last)) {
            best = turn;
            best_due = at;
        }
    }
    if (best && least > turns->now_us) {
        turns->now_us = least;
    }
    return best ? best->offer.picture : NULL;
}

void turns_charge(struct turns *turns, struct turn *turn, int priority, uint64_t us)
{
    const uint64_t others = turn->newcomers ? count_offers(turns) - 1 : 1;

    turn->us += us * costs[clamped(priority)] / (others > 1 ? others : 1);
    turn->steps++;
    turns->last = turn;
}
