/* SPDX-License-Identifier: MIT */
/* The memory of answers until their clients have read them, with a bound for all and one for each
 * client. Bytes that several answers share count once, for the client who was first. Any thread. */
#ifndef SERVER_ANSWERS_H
#define SERVER_ANSWERS_H

#include <pthread.h>

#include "request.h"

struct answers_client;

/* All answers together. */
struct answers {
    pthread_mutex_t lock;
    size_t held;                    /* bytes, without the first block of each answer */
    struct answers_client *clients; /* that hold some; a list */
};

struct answer;

void answers_init(struct answers *answers);
void answers_finish(struct answers *answers);
/* Takes the body. NULL: all would exceed LIMIT_ANSWERS_BYTES, or several of the client's
 * LIMIT_ANSWERS_SHARE_BYTES; nothing is taken. `client`: as of struct request. */
struct answer *answers_add(struct answers *answers, const char *client,
                           const struct response *response);
/* Frees the body, or gives it back. `data`: a struct answer. */
void answer_destroy(void *data);

#endif
