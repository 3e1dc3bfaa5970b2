/* SPDX-License-Identifier: MIT */
/* "Did you mean": the nearest of some names to one that is not known. */
#ifndef PROTOCOL_NEAREST_H
#define PROTOCOL_NEAREST_H

#include <stddef.h>

/* Start with {.text = what was written}. */
struct nearest {
    const char *text;
    const char *best; /* NULL: none of the names is near */
    size_t distance;
};

void nearest_consider(struct nearest *nearest, const char *name);
/* `; did you mean "sphere"?`, or nothing; returns `out`, of which it uses at most `size` bytes. */
const char *nearest_hint(const struct nearest *nearest, char *out, size_t size);

#endif
