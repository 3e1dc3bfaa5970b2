/* SPDX-License-Identifier: MIT */
/* Nearest names by edit distance, two letters swapped counting as one change (Damerau 1964, in the
 * restricted form). For short names only. */
#include "suggest.h"

#include <stdio.h>
#include <string.h>

enum { LONGEST = 40 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

static size_t edit_distance(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t rows[3][LONGEST + 1]; /* the newest three of the table of distances of prefixes */

    for (size_t i = 0; i <= a_length; i++) {
        size_t *row = rows[i % 3], *above = rows[(i + 2) % 3], *second = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            if (i == 0) {
                row[j] = j;
                continue;
            }
            row[j] = least(above[j - 1] + (a[i - 1] != b[j - 1]), least(row[j - 1], above[j]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = least(row[j], second[j - 2] + 1);
            }
        }
    }
    return rows[a_length % 3][b_length];
}

void suggest_consider(struct suggestion *suggestion, const char *name)
{
    const size_t written = strnlen(suggestion->text, LONGEST + 1),
                 length = strnlen(name, LONGEST + 1);

    if (written > LONGEST || length > LONGEST) {
        return;
    }
    size_t distance = edit_distance(suggestion->text, written, name, length);
    const size_t allowed = length <= 3 ? 1 : length <= 7 ? 2 : 3;
    if (distance <= allowed && distance < length &&
        (!suggestion->best || distance < suggestion->distance)) {
        suggestion->best = name;
        suggestion->distance = distance;
    }
}

const char *suggest_hint(const struct suggestion *suggestion, char *out, size_t size)
{
    *out = '\0';
    if (suggestion->best) {
        snprintf(out, size, "; did you mean \"%s\"?", suggestion->best);
    }
    return out;
}
