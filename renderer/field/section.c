/* SPDX-License-Identifier: MIT */
#include "section.h"

#include <math.h>

struct section section_from_record(const struct record *record)
{
    struct section section = {.cuts = record && !record_is_empty(record)};

    if (section.cuts) {
        const double *n = record_vector(record, "normal");
        /* In units of the greatest one, so that no square is too small. */
        const double unit = fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2])));
        const double length = sqrt(n[0] / unit * (n[0] / unit) + n[1] / unit * (n[1] / unit) +
                                   n[2] / unit * (n[2] / unit));

        for (int i = 0; i < 3; i++) {
            section.normal[i] = n[i] / unit / length;
        }
        section.offset = record_number(record, "offset");
    }
    return section;
}

double section_beyond(const struct section *section, const double p[3])
{
    const double *n = section->normal;

    return section->cuts ? n[0] * p[0] + n[1] * p[1] + n[2] * p[2] - section->offset : -INFINITY;
}
