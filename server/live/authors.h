/* SPDX-License-Identifier: MIT */
/* The authors of a scene: who is connected, and who has an edit in its log. Found by id in a search
 * tree; a list in the order of their newest edits tells who leaves when the log is cut, and so
 * bounds them. Pure. */
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
    char id[LIMIT_ID_BYTES + 1]; /* `client` of hello; told to nobody */
    /* Digest of the key; "": of an author from before there were keys, who gets one next time. */
    char key[ASSET_ID_CHARACTERS + 1];
    char name[AUTHOR_NAME_CHARACTERS + 1]; /* told to all; follows from `key` */
    int64_t edit;                          /* newest number in the log; 0: none */
    uint64_t revision;                     /* that it made */
    struct session *session;               /* connected; NULL: none */
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
/* One that is not there yet; it has no key. */
struct author *authors_add(struct authors *authors, const char *id);
void authors_remove(struct authors *authors, struct author *author);
/* An edit of the author is in the log. Revisions come in rising order. */
void authors_edited(struct authors *authors, struct author *author, int64_t edit,
                    uint64_t revision);
/* The log was cut up to `revision`: removes who is not connected and has no edit in it any more,
 * and calls `each` before. */
void authors_cut(struct authors *authors, uint64_t revision,
                 void (*each)(void *data, const struct author *author), void *data);

void author_make_key(char out[MESSAGE_KEY_CHARACTERS + 1]);
void author_set_key(struct author *author, const char *key);
/* As it was kept: the digest of a key, or "". */
void author_set_digest(struct author *author, const char *digest);
/* Whether `key` is the author's, in the same time for every key of one length. */
bool author_has_key(const struct author *author, const char *key);

#endif
