/* SPDX-License-Identifier: MIT */
/* Finished pictures, kept for those who ask for the same again; the longest unused goes first.
 * Under the hub's lock. */
#ifndef SERVER_IMAGE_CACHE_H
#define SERVER_IMAGE_CACHE_H

#include <stddef.h>
#include <stdint.h>

#include "protocol/codec.h"

struct cached_image {
    struct cached_image *before, *after;
    char *key; /* all that the pixels and their encoding depend on */
    enum codec codec;
    uint64_t revision;
    size_t length;
    uint8_t bytes[];
};

/* The newest used is `first`. */
struct image_cache {
    struct cached_image *first, *last;
    size_t bytes;
};

void image_cache_finish(struct image_cache *cache);
/* NULL: not there. Valid until the next addition. */
const struct cached_image *image_cache_find(struct image_cache *cache, const char *key);
/* Copies all it is given. What is larger than a part of the limit is not kept. */
void image_cache_add(struct image_cache *cache, const char *key, enum codec codec,
                     uint64_t revision, const void *bytes, size_t length);

#endif
