/* SPDX-License-Identifier: MIT */
#include "pictures.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/limits.h"
#include "protocol/memory.h"

enum { LARGEST_PART = 4 }; /* one picture takes at most this part of the limit */

static size_t weight(const struct picture *picture)
{
    return sizeof(*picture) + strlen(picture->key) + picture->length;
}

static void unlink_picture(struct pictures *pictures, struct picture *picture)
{
    *(picture->before ? &picture->before->after : &pictures->first) = picture->after;
    *(picture->after ? &picture->after->before : &pictures->last) = picture->before;
}

static void link_first(struct pictures *pictures, struct picture *picture)
{
    picture->before = NULL;
    picture->after = pictures->first;
    *(pictures->first ? &pictures->first->before : &pictures->last) = picture;
    pictures->first = picture;
}

static void drop(struct pictures *pictures, struct picture *picture)
{
    unlink_picture(pictures, picture);
    pictures->bytes -= weight(picture);
    free(picture->key);
    free(picture);
}

void pictures_finish(struct pictures *pictures)
{
    while (pictures->first) {
        drop(pictures, pictures->first);
    }
}

const struct picture *pictures_find(struct pictures *pictures, const char *key)
{
    struct picture *picture = pictures->first;

    while (picture && strcmp(picture->key, key) != 0) {
        picture = picture->after;
    }
    if (picture) {
        unlink_picture(pictures, picture);
        link_first(pictures, picture);
    }
    return picture;
}

void pictures_add(struct pictures *pictures, const char *key, enum codec codec, uint64_t revision,
                  const void *bytes, size_t length)
{
    if (strlen(key) + length > LIMIT_IMAGE_CACHE_BYTES / LARGEST_PART ||
        pictures_find(pictures, key)) {
        return;
    }
    struct picture *picture = memory_alloc(1, sizeof(*picture) + length);
    picture->key = memory_text(key);
    picture->codec = codec;
    picture->revision = revision;
    picture->length = length;
    memcpy(picture->bytes, bytes, length);
    link_first(pictures, picture);
    pictures->bytes += weight(picture);
    while (pictures->bytes > LIMIT_IMAGE_CACHE_BYTES) {
        drop(pictures, pictures->last);
    }
}
