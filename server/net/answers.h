/* SPDX-License-Identifier: MIT */
/* The memory of answers until their clients have read them, with one bound for all. Bytes that
 * several answers share count once. Any thread. */
#ifndef SERVER_ANSWERS_H
#define SERVER_ANSWERS_H

#include <pthread.h>

#include "request.h"

/* All answers together. */
struct answers {
    pthread_mutex_t lock;
    size_t held; /* bytes, without the first block of each answer */
};

struct answer;

void answers_init(struct answers *answers);
void answers_finish(struct answers *answers);
/* Takes the body. NULL: all would exceed LIMIT_ANSWERS_BYTES; nothing is taken. */
struct answer *answers_add(struct answers *answers, const struct response *response);
/* Frees the body, or gives it back. `data`: a struct answer. */
void answer_destroy(void *data);

#endif
