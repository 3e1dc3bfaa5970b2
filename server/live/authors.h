/* SPDX-License-Identifier: MIT */
/* The authors of a scene: those who are connected, and those who have an edit in its log or on the
 * way to it. A search tree finds them by id. A list in the order of their newest edits tells which
 * authors leave when the log is cut. The size of the log therefore bounds their number. Pure. */
#ifndef SERVER_AUTHORS_H
#define SERVER_AUTHORS_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/limits.h"
#include "protocol/messages.h"
#include "server/digest.h"

struct session;

enum { AUTHOR_NAME_CHARACTERS = 16 };

struct author {
    char id[LIMIT_ID_BYTES + 1]; /* `client` of hello; other clients never see it */
    /* Digest of the key. "": the author is older than keys and gets one with the next hello. */
    char key[ASSET_ID_CHARACTERS + 1];
    char name[AUTHOR_NAME_CHARACTERS + 1]; /* public; derived from `key` */
    int64_t edit;                          /* number of its newest edit in the log; 0: none */
    uint64_t revision;                     /* which that edit made */
    struct session *session;               /* its connection; NULL: not connected */
    int applying;                          /* edits that are being applied; it stays meanwhile */
    struct author *older, *newer;
};

struct authors {
    void *by_id;
    struct author *oldest, *newest;
    size_t count;
};

void authors_finish(struct authors *authors);
/* NULL: there is none. */
struct author *authors_find(const struct authors *authors, const char *id);
/* Adds an author without a key. The id must be new. */
struct author *authors_add(struct authors *authors, const char *id);
void authors_remove(struct authors *authors, struct author *author);
/* Records that an edit of the author is in the log. Revisions rise from call to call. */
void authors_edited(struct authors *authors, struct author *author, int64_t edit,
                    uint64_t revision);
/* Call it when the log was cut up to `revision`. Removes each author who is not connected, has no
 * edit left in the log, and none that is being applied. Calls `each` before it removes one. */
void authors_cut(struct authors *authors, uint64_t revision,
                 void (*each)(void *data, const struct author *author), void *data);

void author_make_key(char out[MESSAGE_KEY_CHARACTERS + 1]);
void author_set_key(struct author *author, const char *key);
/* Takes the digest as the store has it; "": none. */
void author_set_digest(struct author *author, const char *digest);
/* Whether `key` is the author's. Takes the same time for all keys of one length. */
bool author_has_key(const struct author *author, const char *key);

#endif
