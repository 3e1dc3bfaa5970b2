/* SPDX-License-Identifier: MIT */
#include "answers.h"

#include <stdlib.h>

#include "protocol/memory.h"
#include "shared_buffer.h"

/* So much of each is not counted, so that large ones cannot keep small ones out. */
enum { SMALL_BYTES = 65536 };

struct answer {
    struct answers *answers;
    struct shared_buffer *shared; /* NULL: `body` is its own */
    void *body;
    size_t length;
};

void answers_init(struct answers *answers)
{
    pthread_mutex_init(&answers->lock, NULL);
    answers->held = 0;
}

void answers_finish(struct answers *answers)
{
    pthread_mutex_destroy(&answers->lock);
}

static size_t counted(size_t length)
{
    return length > SMALL_BYTES ? length - SMALL_BYTES : 0;
}

struct answer *answers_add(struct answers *answers, const struct response *response)
{
    struct shared_buffer *shared = response->shared;
    const size_t length = response->borrowed ? 0 : shared ? shared->length : response->length;

    pthread_mutex_lock(&answers->lock);
    const size_t more = shared && shared->answers > 0 ? 0 : counted(length);
    const bool room = more == 0 || answers->held + more <= LIMIT_ANSWERS_BYTES;
    if (room) {
        answers->held += more;
        if (shared) {
            shared->answers++;
        }
    }
    pthread_mutex_unlock(&answers->lock);
    if (!room) {
        return NULL;
    }
    struct answer *answer = memory_alloc(1, sizeof *answer);
    *answer = (struct answer){answers, shared, response->borrowed ? NULL : response->body, length};
    return answer;
}

void answer_destroy(void *data)
{
    struct answer *answer = data;
    struct answers *answers = answer->answers;

    pthread_mutex_lock(&answers->lock);
    if (!answer->shared || --answer->shared->answers == 0) {
        answers->held -= counted(answer->length);
    }
    pthread_mutex_unlock(&answers->lock);
    shared_buffer_unref(answer->shared);
    free(answer->body);
    free(answer);
}
