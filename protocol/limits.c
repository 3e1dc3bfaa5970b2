/* SPDX-License-Identifier: MIT */
/* The limits as rows, for the schema and the documentation. */
#include "limits.h"

const struct limit *limits_table(size_t *out_count)
{
    static const struct limit rows[] = {
#define X(NAME, name, value, unit, doc) {name, value, unit, doc},
        LIMITS(X)
#undef X
    };

    *out_count = sizeof rows / sizeof rows[0];
    return rows;
}
