/* SPDX-License-Identifier: MIT */
/* Thumbnails: small pictures of nodes and materials, each a portrait of that part alone
 * (renderer/portrait.h). A session says which ones it shows; it gets them all once, and later those
 * that look different. At most one message of a session is unacknowledged.
 *
 * The digest of a part's text is the key of its picture, for all scenes and sessions. So nothing
 * has to follow changes: after an edit every part is looked at anew, and those with another key
 * come again, most of them from the cache after an undo. A part that cannot be drawn has an empty
 * picture, which is kept too.
 *
 * One thumbnail is drawn at a time, and none until THUMBNAIL_REST_MS after the last change of the
 * scene or of a view of it. What moves cancels the one that is being drawn. Moving pictures go
 * first; the still picture of the view is there by then, and its samples share the time. Parts are
 * printed under the lock: a session rests as long as it had them printed (workload.h), and all
 * sessions leave the lock to others for three quarters of the time. Every function is called under
 * the hub's lock. */
#ifndef SERVER_THUMBNAILS_H
#define SERVER_THUMBNAILS_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/asset.h"
#include "protocol/error.h"
#include "protocol/limits.h"
#include "protocol/messages.h"
#include "server/net/workload.h"

struct hub;
struct session;
struct thumbnails; /* of the server */

enum {
    THUMBNAIL_REST_MS = 400,
    THUMBNAIL_KEY_BYTES = ASSET_ID_CHARACTERS + 8,
    THUMBNAIL_MESSAGE_BYTES = 49152, /* one that is longer gets no more pictures */
};

struct thumbnail {
    enum thumbnail_kind kind;
    char id[LIMIT_ID_BYTES + 1];
    int width;
    uint64_t looked;                /* revision that `key` belongs to; 0: none */
    char key[THUMBNAIL_KEY_BYTES];  /* how it looks; "": nothing is known */
    char sent[THUMBNAIL_KEY_BYTES]; /* what the client has */
};

/* Those of a session. */
struct thumbnail_list {
    struct thumbnail *items;
    size_t count;
    uint32_t number; /* of the last message */
    bool unacknowledged;
    uint64_t turn; /* when it was looked at last */
    struct workload work;
    int64_t rests_until_us;
};

struct thumbnails *thumbnails_create(void);
void thumbnails_destroy(struct thumbnails *thumbnails); /* NULL: nothing */

/* Takes a `thumbnails` message. */
void thumbnails_ask(struct session *session, const struct message *message);
void thumbnails_acknowledge(struct session *session, uint32_t number);
/* The session wants none any more. */
void thumbnails_stop(struct session *session);
/* Does what is due, for some milliseconds at most. Returns the time of the next call (clock_ms), or
 * 0. */
int64_t thumbnails_pump(struct hub *hub, int64_t now_ms);

#endif
