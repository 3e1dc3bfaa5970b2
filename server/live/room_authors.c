/* SPDX-License-Identifier: MIT */
#include "room_authors.h"

#include <inttypes.h>
#include <stdio.h>

#include "hub.h"
#include "room_apart.h"
#include "room_history.h"
#include "room_store.h"

void room_authors_load(struct room *room, const struct store_loaded *loaded)
{
    for (size_t i = 0; i < loaded->author_count; i++) {
        const struct store_author *kept = &loaded->authors[i];
        struct author *author = authors_add(&room->authors, kept->author);

        author_set_digest(author, kept->key);
        authors_edited(&room->authors, author, kept->edit, kept->revision);
    }
}

/* An author of the log who has no key is claimed by the first who asks: its id is all there is. */
static void give_key(struct room *room, struct author *author, const char *key,
                     char out_key[MESSAGE_KEY_CHARACTERS + 1])
{
    if (*key) {
        snprintf(out_key, MESSAGE_KEY_CHARACTERS + 1, "%s", key);
    } else {
        author_make_key(out_key);
    }
    author_set_key(author, out_key);
    if (author->edit > 0) {
        room_store_author(room, author);
    }
}

struct author *room_authors_admit(struct room *room, const char *client, const char *key,
                                  char out_key[MESSAGE_KEY_CHARACTERS + 1], struct error *err)
{
    struct author *author = authors_find(&room->authors, client);

    if (!author) {
        author = authors_add(&room->authors, client);
    }
    if (!*author->key) {
        give_key(room, author, key, out_key);
    } else if (author_has_key(author, key)) {
        snprintf(out_key, MESSAGE_KEY_CHARACTERS + 1, "%s", key);
    } else {
        error_set(err, ERROR_FORBIDDEN, "/key",
                  *key
                      ? "this is not the key of this client"
                      : "this client is connected or has edits here: say the key that it was told");
        return NULL;
    }
    return author;
}

static void remove_unneeded(struct room *room, struct author *author)
{
    if (!author->session && author->edit == 0 && author->applying == 0) {
        authors_remove(&room->authors, author);
    }
}

void room_authors_left(struct room *room, struct author *author)
{
    author->session = NULL;
    remove_unneeded(room, author);
}

void room_authors_hold(struct author *author)
{
    author->applying++;
}

void room_authors_release(struct room *room, struct author *author)
{
    author->applying--;
    remove_unneeded(room, author);
}

static void forget(void *data, const struct author *author)
{
    history_forget(data, author->id);
}

void room_authors_cut(struct room *room)
{
    if (room->revision > STORE_LOG_KEPT) {
        authors_cut(&room->authors, room->revision - STORE_LOG_KEPT, forget, room->history);
        room_drop_steps(room);
    }
}

/* What memory has let go of is committed and at or before log_from; only if very much waits to be
 * committed, a part of it is in neither place. */
static enum room_outcome ask_store(const struct room *room, const struct room_change *change,
                                   uint64_t *out_revision, struct error *err)
{
    uint64_t revision = 0;

    if (!store_find_edit(room->hub->store, room->id, change->author, change->edit, &revision,
                         err)) {
        return ROOM_REFUSED;
    }
    if (revision > 0 && revision <= room->log_from) {
        *out_revision = revision;
        return ROOM_KNOWN;
    }
    if (room->log_from > room->durable) {
        error_set(err, ERROR_UNAVAILABLE, "/edit",
                  "edits wait to be stored; whether %" PRId64 " is one of them is known then",
                  change->edit);
    } else {
        error_set(err, ERROR_CONFLICT, "/edit",
                  "numbers count up: %" PRId64 " is not in the log, and not above %" PRId64,
                  change->edit, change->by->edit);
    }
    return ROOM_REFUSED;
}

enum room_outcome room_authors_check_number(const struct room *room,
                                            const struct room_change *change,
                                            uint64_t *out_revision, struct error *err)
{
    if (!change->by || change->edit > change->by->edit) {
        return ROOM_APPLIED;
    }
    const struct room_entry *entry = room_history_find(room, change->author, change->edit);
    if (!entry) {
        return ask_store(room, change, out_revision, err);
    }
    *out_revision = entry->revision;
    return ROOM_KNOWN;
}
