/* SPDX-License-Identifier: MIT */
#include "authors.h"

#include <nettle/memops.h>
#include <search.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

#include "protocol/memory.h"

/* The id is the first member: a text and an author compare alike. */
static int compare_ids(const void *a, const void *b)
{
    return strcmp(a, b);
}

static void unlink_author(struct authors *authors, struct author *author)
{
    *(author->older ? &author->older->newer : &authors->oldest) = author->newer;
    *(author->newer ? &author->newer->older : &authors->newest) = author->older;
}

static void link_newest(struct authors *authors, struct author *author)
{
    author->newer = NULL;
    author->older = authors->newest;
    *(author->older ? &author->older->newer : &authors->oldest) = author;
    authors->newest = author;
}

struct author *authors_find(const struct authors *authors, const char *id)
{
    struct author *const *found = tfind(id, &authors->by_id, compare_ids);

    return found ? *found : NULL;
}

struct author *authors_add(struct authors *authors, const char *id)
{
    struct author *author = memory_alloc(1, sizeof *author);

    snprintf(author->id, sizeof author->id, "%s", id);
    if (!tsearch(author, &authors->by_id, compare_ids)) {
        abort();
    }
    link_newest(authors, author);
    authors->count++;
    return author;
}

void authors_remove(struct authors *authors, struct author *author)
{
    tdelete(author, &authors->by_id, compare_ids);
    unlink_author(authors, author);
    authors->count--;
    free(author);
}

void authors_finish(struct authors *authors)
{
    while (authors->oldest) {
        authors_remove(authors, authors->oldest);
    }
}

void authors_edited(struct authors *authors, struct author *author, int64_t edit, uint64_t revision)
{
    author->edit = edit;
    author->revision = revision;
    unlink_author(authors, author);
    link_newest(authors, author);
}

/* Those without an edit are connected, and stand anywhere. */
void authors_cut(struct authors *authors, uint64_t revision,
                 void (*each)(void *data, const struct author *author), void *data)
{
    struct author *author = authors->oldest;

    while (author && author->revision <= revision) {
        struct author *next = author->newer;

        if (!author->session && author->applying == 0) {
            each(data, author);
            authors_remove(authors, author);
        }
        author = next;
    }
}

/* --- keys --- */

void author_make_key(char out[MESSAGE_KEY_CHARACTERS + 1])
{
    unsigned char bytes[MESSAGE_KEY_CHARACTERS / 2];

    if (getrandom(bytes, sizeof bytes, 0) != sizeof bytes) {
        abort();
    }
    for (size_t i = 0; i < sizeof bytes; i++) {
        snprintf(out + 2 * i, 3, "%02x", bytes[i]);
    }
}

void author_set_digest(struct author *author, const char *digest)
{
    char name[ASSET_ID_CHARACTERS + 1] = "";

    snprintf(author->key, sizeof author->key, "%s", digest);
    if (*digest) {
        digest_text(author->key, strlen(author->key), name);
    }
    snprintf(author->name, sizeof author->name, "%.*s", AUTHOR_NAME_CHARACTERS, name);
}

void author_set_key(struct author *author, const char *key)
{
    char digest[ASSET_ID_CHARACTERS + 1];

    digest_text(key, strlen(key), digest);
    author_set_digest(author, digest);
}

bool author_has_key(const struct author *author, const char *key)
{
    char digest[ASSET_ID_CHARACTERS + 1];

    digest_text(key, strlen(key), digest);
    return memeql_sec(digest, author->key, sizeof digest) != 0;
}
