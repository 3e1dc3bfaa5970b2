/* SPDX-License-Identifier: MIT */
/* A cache of finished pictures. The least recently used picture leaves first. Every function is
 * called under the hub's lock. */
#ifndef SERVER_IMAGE_CACHE_H
#define SERVER_IMAGE_CACHE_H

#include <stddef.h>
#include <stdint.h>

#include "protocol/codec.h"

struct shared_buffer;

struct cached_image {
    struct cached_image *before, *after;
    char *key; /* everything that the pixels and their encoding depend on */
    enum codec codec;
    uint64_t revision;
    struct shared_buffer *bytes;
};

/* `first` was used most recently. */
struct image_cache {
    struct cached_image *first, *last;
    size_t bytes, limit;
};

void image_cache_finish(struct image_cache *cache);
/* NULL: not in the cache. The result is valid until the next addition. */
const struct cached_image *image_cache_find(struct image_cache *cache, const char *key);
/* Copies the key, takes a reference. Skips pictures that would fill a large part of the cache. */
void image_cache_add(struct image_cache *cache, const char *key, enum codec codec,
                     uint64_t revision, struct shared_buffer *bytes);

#endif
