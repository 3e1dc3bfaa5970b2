/* SPDX-License-Identifier: MIT */
/* Scenes about 1 in radius around the origin that are thin, tiny, hollow, overlapping, turned,
 * sheared or blended. */
#ifndef TESTS_SUPPORT_COMPOSITIONS_H
#define TESTS_SUPPORT_COMPOSITIONS_H

#include <stdbool.h>
#include <stddef.h>

struct composition {
    const char *name;
    const char *head, *root; /* members of the document; a node */
    bool inside;             /* seen from there alone */
    bool alone;              /* takes long to compile: not with others in one program */
};

extern const struct composition compositions[];
extern const size_t composition_count;

#endif
