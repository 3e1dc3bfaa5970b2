/* SPDX-License-Identifier: MIT */
/* Whose picture goes on next: each client has an account of drawing time, and the one that had
 * least goes first, so that no client waits for another's pictures. Start-time fair queueing (Goyal
 * et al. 1996) by steps of a few milliseconds. Who had nothing to draw for a while begins at most
 * TURNS_CREDIT_US behind the others, so that the pictures of a client that asks for less than its
 * share are drawn at once, not between the tiles of others. Newcomers share an account
 * (ACCOUNT_NEWCOMERS) that may have as much as all others together: however many come at once,
 * those who are there keep half, and however many are there, who comes sees something soon.
 *
 * What is urgent (a low priority number) may run ahead by TURNS_AHEAD_US for each number, all
 * accounts together, and what is not costs its account more: for the long run urgent pictures get
 * the larger share, and never all. Within an account the most urgent goes first, then the smallest,
 * then the oldest; now and then the oldest in any case. Pure; not thread-safe. */
#ifndef RENDERER_TURNS_H
#define RENDERER_TURNS_H

#include <stdint.h>

enum {
    TURNS_PRIORITIES = 4,
    TURNS_AHEAD_US = 100000,
    TURNS_CREDIT_US = 50000,
    TURNS_OLDEST_EVERY = 8, /* steps of an account */
    TURNS_REMEMBERED = 64,  /* accounts that have no picture now */
};

struct turn; /* an account */

struct turns {
    struct turn *first;
    int accounts;            /* that are known */
    const struct turn *last; /* had the last step */
    uint64_t now_us;         /* the least account of those that could go on, as last seen */
    uint64_t round;
};

/* A picture of the account waits from now on, until turns_leave. */
struct turn *turns_join(struct turns *turns, const char *account);
void turns_leave(struct turns *turns, struct turn *turn);
/* Forgets all accounts. */
void turns_finish(struct turns *turns);

/* A choice: turns_begin, then turns_offer for each picture that can go on, in order of arrival,
 * then turns_choose. */
void turns_begin(struct turns *turns);
struct turns_offer {
    int priority;
    uint64_t pixels; /* of the picture */
    void *picture;   /* that goes on if this is chosen */
};
void turns_offer(struct turns *turns, struct turn *turn, const struct turns_offer *offer);
/* The picture of one of the offers; NULL: there was none. */
void *turns_choose(struct turns *turns);
/* A picture of the account had a step that took so long. */
void turns_charge(struct turns *turns, struct turn *turn, int priority, uint64_t us);

#endif
