/* SPDX-License-Identifier: MIT */
/* Nearest names by edit distance (Levenshtein), for short names only. */
#include "nearest.h"

#include <stdio.h>
#include <string.h>

enum { LONGEST = 40 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

static size_t edit_distance(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t row[LONGEST + 1];
    for (size_t j = 0; j <= b_length; j++) {
        row[j] = j;
    }
    for (size_t i = 1; i <= a_length; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = least(replaced, least(row[j], row[j - 1]) + 1);
        }
    }
    return row[b_length];
}

void nearest_consider(struct nearest *nearest, const char *name)
{
    size_t written = strnlen(nearest->text, LONGEST + 1), length = strnlen(name, LONGEST + 1);
    if (written > LONGEST || length > LONGEST) {
        return;
    }
    size_t distance = edit_distance(nearest->text, written, name, length);
    size_t allowed = length <= 3 ? 1 : length <= 7 ? 2 : 3;
    if (distance <= allowed && distance < length &&
        (!nearest->best || distance < nearest->distance)) {
        nearest->best = name;
        nearest->distance = distance;
    }
}

const char *nearest_hint(const struct nearest *nearest, char *out, size_t size)
{
    *out = '\0';
    if (nearest->best) {
        snprintf(out, size, "; did you mean \"%s\"?", nearest->best);
    }
    return out;
}
