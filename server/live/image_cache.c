/* SPDX-License-Identifier: MIT */
#include "image_cache.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "server/net/shared_buffer.h"

enum { LARGEST_PART = 4 }; /* one picture takes at most this part of the limit */

static size_t weight(const struct cached_image *image)
{
    return sizeof *image + strlen(image->key) + image->bytes->length;
}

static void unlink_image(struct image_cache *cache, struct cached_image *image)
{
    *(image->before ? &image->before->after : &cache->first) = image->after;
    *(image->after ? &image->after->before : &cache->last) = image->before;
}

static void link_first(struct image_cache *cache, struct cached_image *image)
{
    image->before = NULL;
    image->after = cache->first;
    *(cache->first ? &cache->first->before : &cache->last) = image;
    cache->first = image;
}

static void drop(struct image_cache *cache, struct cached_image *image)
{
    unlink_image(cache, image);
    cache->bytes -= weight(image);
    shared_buffer_unref(image->bytes);
    free(image->key);
    free(image);
}

void image_cache_finish(struct image_cache *cache)
{
    while (cache->first) {
        drop(cache, cache->first);
    }
}

const struct cached_image *image_cache_find(struct image_cache *cache, const char *key)
{
    struct cached_image *image = cache->first;

    while (image && strcmp(image->key, key) != 0) {
        image = image->after;
    }
    if (image) {
        unlink_image(cache, image);
        link_first(cache, image);
    }
    return image;
}

void image_cache_add(struct image_cache *cache, const char *key, enum codec codec,
                     uint64_t revision, struct shared_buffer *bytes)
{
    if (strlen(key) + bytes->length > cache->limit / LARGEST_PART || image_cache_find(cache, key)) {
        return;
    }
    struct cached_image *image = memory_alloc(1, sizeof *image);
    image->key = memory_text(key);
    image->codec = codec;
    image->revision = revision;
    image->bytes = shared_buffer_ref(bytes);
    link_first(cache, image);
    cache->bytes += weight(image);
    while (cache->bytes > cache->limit) {
        drop(cache, cache->last);
    }
}
