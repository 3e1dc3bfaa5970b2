/* SPDX-License-Identifier: MIT */
#include "bases.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

#include "protocol/limits.h"
#include "protocol/memory.h"

enum state { WAITING, RUNNING, DONE, FAILED, CANCELLED };

static const char *const state_names[] = {"waiting", "running", "done", "failed", "cancelled"};

struct basis {
    struct bases *bases;
    char id[BASIS_ID_BYTES];
    char *client;
    struct record asked;
    enum state state;
    bool in_hands; /* of a thread, or of the tasks */
    char **steps;  /* lines of JSON */
    size_t count;
    cJSON *answer;
    struct error err;
    struct basis *next;
};

struct bases {
    struct algebra *algebra;
    pthread_mutex_t lock; /* guards all that follows, and the bases in it */
    struct basis *first;  /* the newest */
};

struct bases *bases_create(struct algebra *algebra)
{
    struct bases *bases = memory_alloc(1, sizeof *bases);

    bases->algebra = algebra;
    pthread_mutex_init(&bases->lock, NULL);
    return bases;
}

static void basis_destroy(struct basis *basis)
{
    for (size_t i = 0; i < basis->count; i++) {
        free(basis->steps[i]);
    }
    free(basis->steps);
    cJSON_Delete(basis->answer);
    record_finish(&basis->asked);
    free(basis->client);
    free(basis);
}

void bases_destroy(struct bases *bases)
{
    if (!bases) {
        return;
    }
    while (bases->first) {
        struct basis *next = bases->first->next;
        basis_destroy(bases->first);
        bases->first = next;
    }
    pthread_mutex_destroy(&bases->lock);
    free(bases);
}

static struct basis *find(const struct bases *bases, const char *id)
{
    struct basis *basis = bases->first;

    while (basis && strcmp(basis->id, id) != 0) {
        basis = basis->next;
    }
    return basis;
}

/* --- making one --- */

static void keep_step(void *data, const char *line)
{
    struct basis *basis = data;

    pthread_mutex_lock(&basis->bases->lock);
    basis->steps = memory_open_slot(basis->steps, basis->count, basis->count);
    basis->steps[basis->count++] = memory_text(line);
    const bool cancelled = basis->state == CANCELLED;
    pthread_mutex_unlock(&basis->bases->lock);
    if (cancelled) { /* before the process had started */
        algebra_cancel(basis->bases->algebra, basis);
    }
}

/* True: it is to be made. */
static bool begin(struct basis *basis, bool dropped)
{
    pthread_mutex_lock(&basis->bases->lock);
    const bool wanted = !dropped && basis->state == WAITING;
    basis->state = wanted ? RUNNING : CANCELLED;
    pthread_mutex_unlock(&basis->bases->lock);
    return wanted;
}

static void end(struct basis *basis, bool made, cJSON *answer, const struct error *err)
{
    pthread_mutex_lock(&basis->bases->lock);
    if (basis->state == RUNNING) {
        basis->state = made ? DONE : FAILED;
        basis->answer = answer;
        basis->err = *err;
    } else {
        cJSON_Delete(answer);
    }
    basis->in_hands = false;
    pthread_mutex_unlock(&basis->bases->lock);
}

static void make(void *data, bool dropped)
{
    struct basis *basis = data;
    struct error err = {0};
    cJSON *answer = NULL;
    const bool made =
        begin(basis, dropped) &&
        algebra_groebner(basis->bases->algebra, &basis->asked, keep_step, basis, &answer, &err);

    end(basis, made, answer, &err);
}

/* --- the list --- */

static bool make_id(char out[BASIS_ID_BYTES], struct error *err)
{
    unsigned char bytes[(BASIS_ID_BYTES - 1) / 2];

    if (getrandom(bytes, sizeof bytes, 0) != sizeof bytes) {
        return error_set(err, ERROR_INTERNAL, "", "no random numbers");
    }
    for (size_t i = 0; i < sizeof bytes; i++) {
        snprintf(out + 2 * i, 3, "%02x", bytes[i]);
    }
    return true;
}

/* The link to the oldest one that is over, of `client`; NULL: of anybody. `*out_count`: how many
 * there are. NULL: none is over. */
static struct basis **find_oldest(struct bases *bases, const char *client, int *out_count)
{
    struct basis **oldest = NULL;

    *out_count = 0;
    for (struct basis **at = &bases->first; *at; at = &(*at)->next) {
        if (!client || strcmp((*at)->client, client) == 0) {
            oldest = (*at)->in_hands ? oldest : at;
            ++*out_count;
        }
    }
    return oldest;
}

static void drop(struct basis **at)
{
    struct basis *over = *at;

    *at = over->next;
    basis_destroy(over);
}

/* Drops the oldest one that is over where there are as many as are kept, of the client or of all.
 * Under the lock. */
static bool make_room(struct bases *bases, const char *client, struct error *err)
{
    int count;
    struct basis **oldest = find_oldest(bases, client, &count);

    if (count >= LIMIT_GROEBNER_SHARE) {
        if (!oldest) {
            err->retry_ms = 1000;
            return error_set(err, ERROR_SHARE, "",
                             "%d bases are being made for this client (groebner_share)",
                             LIMIT_GROEBNER_SHARE);
        }
        drop(oldest);
    }
    oldest = find_oldest(bases, NULL, &count);
    if (count < LIMIT_GROEBNER_KEPT) {
        return true;
    }
    if (!oldest) {
        return error_set(err, ERROR_UNAVAILABLE, "", "%d bases are being made (groebner_kept)",
                         LIMIT_GROEBNER_KEPT);
    }
    drop(oldest);
    return true;
}

bool bases_add(struct bases *bases, const char *client, const struct record *asked,
               char out_id[BASIS_ID_BYTES], struct error *err)
{
    struct basis *basis = memory_alloc(1, sizeof *basis);

    basis->bases = bases;
    basis->client = memory_text(client);
    record_copy(&basis->asked, asked);
    pthread_mutex_lock(&bases->lock);
    bool ok = make_id(basis->id, err) && make_room(bases, client, err);
    if (ok) {
        basis->in_hands = true;
        basis->next = bases->first;
        bases->first = basis;
    }
    pthread_mutex_unlock(&bases->lock);
    if (!ok) {
        basis_destroy(basis);
        return false;
    }
    snprintf(out_id, BASIS_ID_BYTES, "%s", basis->id);
    ok = algebra_add(bases->algebra, client, make, basis, err);
    if (!ok) {
        end(basis, false, NULL, err); /* nobody knows its id */
    }
    return ok;
}

/* --- looking on --- */

static cJSON *describe_error(const struct error *err)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "code", error_kind_name(err->kind));
    cJSON_AddStringToObject(json, "place", err->place);
    cJSON_AddStringToObject(json, "message", err->message);
    if (err->line) {
        cJSON_AddNumberToObject(json, "line", err->line);
        cJSON_AddNumberToObject(json, "column", err->column);
    }
    return json;
}

static cJSON *describe(const struct basis *basis, size_t from)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "state", state_names[basis->state]);
    cJSON *steps = cJSON_AddArrayToObject(json, "steps");
    for (size_t i = from; i < basis->count; i++) {
        cJSON_AddItemToArray(steps, cJSON_Parse(basis->steps[i]));
    }
    cJSON_AddNumberToObject(json, "next", (double)basis->count);
    if (basis->state == DONE) {
        cJSON_AddItemToObject(json, "answer", cJSON_Duplicate(basis->answer, true));
    } else if (basis->state == FAILED) {
        cJSON_AddItemToObject(json, "error", describe_error(&basis->err));
    }
    return json;
}

cJSON *bases_look(struct bases *bases, const char *id, size_t from)
{
    pthread_mutex_lock(&bases->lock);
    const struct basis *basis = find(bases, id);
    cJSON *json = basis ? describe(basis, from) : NULL;
    pthread_mutex_unlock(&bases->lock);
    return json;
}

bool bases_cancel(struct bases *bases, const char *id)
{
    pthread_mutex_lock(&bases->lock);
    struct basis *basis = find(bases, id);
    const bool runs = basis && basis->state == RUNNING;
    if (basis && (runs || basis->state == WAITING)) {
        basis->state = CANCELLED;
    }
    pthread_mutex_unlock(&bases->lock);
    if (runs) {
        algebra_cancel(bases->algebra, basis);
    }
    return basis != NULL;
}
