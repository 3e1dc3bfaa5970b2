/* SPDX-License-Identifier: MIT */
/* Finished pictures, kept for those who ask for the same again; the longest unused goes first.
 * Under the hub's lock. */
#ifndef SERVER_PICTURES_H
#define SERVER_PICTURES_H

#include <stddef.h>
#include <stdint.h>

#include "protocol/codec.h"

struct picture {
    struct picture *before, *after;
    char *key; /* all that the pixels and their encoding depend on */
    enum codec codec;
    uint64_t revision;
    size_t length;
    uint8_t bytes[];
};

/* The newest used is `first`. */
struct pictures {
    struct picture *first, *last;
    size_t bytes;
};

void pictures_finish(struct pictures *pictures);
/* NULL: not there. Valid until the next addition. */
const struct picture *pictures_find(struct pictures *pictures, const char *key);
/* Copies all it is given. What is larger than a part of the limit is not kept. */
void pictures_add(struct pictures *pictures, const char *key, enum codec codec, uint64_t revision,
                  const void *bytes, size_t length);

#endif
