/* SPDX-License-Identifier: MIT */
/* A set of ids of nodes: each once and in order, so that equal sets compare equal. */
#ifndef PROTOCOL_ID_SET_H
#define PROTOCOL_ID_SET_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>

#include "error.h"

/* A zeroed one is empty. */
struct id_set {
    char **ids; /* owned */
    size_t count;
};

void id_set_finish(struct id_set *set);
void id_set_copy(struct id_set *to, const struct id_set *from); /* `to` is overwritten */
bool id_set_equal(const struct id_set *a, const struct id_set *b);
/* A list of at most `most` ids, which is at most LIMIT_ISOLATED. On failure `*out` is as it was. */
bool id_set_read(struct id_set *out, const cJSON *list, int most, const char *place,
                 struct error *err);
cJSON *id_set_print(const struct id_set *set); /* caller frees */

#endif
