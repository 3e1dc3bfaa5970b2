/* SPDX-License-Identifier: MIT */
/* "Did you mean": the nearest of some names to one that is not known. */
#ifndef PROTOCOL_SUGGEST_H
#define PROTOCOL_SUGGEST_H

#include <stddef.h>

/* Start with {.text = what was written}. */
struct suggestion {
    const char *text;
    const char *best; /* NULL: none of the names is near */
    size_t distance;
};

void suggest_consider(struct suggestion *suggestion, const char *name);
/* `; did you mean "sphere"?`, or nothing; returns `out`, of which it uses at most `size` bytes. */
const char *suggest_hint(const struct suggestion *suggestion, char *out, size_t size);

#endif
