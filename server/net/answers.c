/* SPDX-License-Identifier: MIT */
#include "answers.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "shared_buffer.h"

/* So much of each is not counted, so that large ones cannot keep small ones out. */
enum { SMALL_BYTES = 65536 };

/* Who holds counted bytes. */
struct answers_client {
    struct answers_client *next;
    size_t held;
    char name[INET6_ADDRSTRLEN];
};

struct answer {
    struct answers *answers;
    struct answers_client *payer; /* NULL: nothing was counted for it */
    struct shared_buffer *shared; /* NULL: `body` is its own */
    void *body;
    size_t length;
};

void answers_init(struct answers *answers)
{
    pthread_mutex_init(&answers->lock, NULL);
    answers->held = 0;
    answers->clients = NULL;
}

void answers_finish(struct answers *answers)
{
    pthread_mutex_destroy(&answers->lock);
}

static size_t counted(size_t length)
{
    return length > SMALL_BYTES ? length - SMALL_BYTES : 0;
}

static struct answers_client *find_client(struct answers *answers, const char *name)
{
    struct answers_client *client = answers->clients;

    while (client && strcmp(client->name, name) != 0) {
        client = client->next;
    }
    return client;
}

static struct answers_client *add_client(struct answers *answers, const char *name)
{
    struct answers_client *client = memory_alloc(1, sizeof *client);

    snprintf(client->name, sizeof client->name, "%s", name);
    client->next = answers->clients;
    return answers->clients = client;
}

static void charge(struct answers *answers, struct answers_client *client, size_t more)
{
    answers->held += more;
    client->held += more;
}

static void give_back(struct answers *answers, struct answers_client *client, size_t less)
{
    struct answers_client **at = &answers->clients;

    answers->held -= less;
    client->held -= less;
    if (client->held > 0) {
        return;
    }
    while (*at != client) {
        at = &(*at)->next;
    }
    *at = client->next;
    free(client);
}

/* Under the lock: who pays for so much; NULL: there is no room. */
static struct answers_client *find_payer(struct answers *answers, const char *name, size_t more)
{
    struct answers_client *client = find_client(answers, name);
    const size_t own = client ? client->held : 0;

    if (answers->held + more > LIMIT_ANSWERS_BYTES ||
        (own > 0 && own + more > LIMIT_ANSWERS_SHARE_BYTES)) {
        return NULL;
    }
    return client ? client : add_client(answers, name);
}

struct answer *answers_add(struct answers *answers, const char *client,
                           const struct response *response)
{
    struct shared_buffer *shared = response->shared;
    const size_t length = response->borrowed ? 0 : shared ? shared->length : response->length;
    struct answers_client *payer = NULL;

    pthread_mutex_lock(&answers->lock);
    const size_t more = shared && shared->answers > 0 ? 0 : counted(length);
    if (more > 0) {
        payer = find_payer(answers, client, more);
    }
    const bool room = more == 0 || payer;
    if (payer) {
        charge(answers, payer, more);
    }
    if (room && shared) {
        shared->payer = shared->answers++ == 0 ? payer : shared->payer;
    }
    pthread_mutex_unlock(&answers->lock);
    if (!room) {
        return NULL;
    }
    struct answer *answer = memory_alloc(1, sizeof *answer);
    *answer =
        (struct answer){answers, payer, shared, response->borrowed ? NULL : response->body, length};
    return answer;
}

void answer_destroy(void *data)
{
    struct answer *answer = data;
    struct answers *answers = answer->answers;
    struct shared_buffer *shared = answer->shared;

    pthread_mutex_lock(&answers->lock);
    struct answers_client *payer = !shared                  ? answer->payer
                                   : --shared->answers == 0 ? shared->payer
                                                            : NULL;
    if (payer) {
        give_back(answers, payer, counted(answer->length));
    }
    pthread_mutex_unlock(&answers->lock);
    shared_buffer_unref(shared);
    free(answer->body);
    free(answer);
}
