/* SPDX-License-Identifier: MIT */
/* A plane that cuts a scene, for the C evaluator; glsl/section.glsl is the same in shaders. */
#ifndef RENDERER_SECTION_H
#define RENDERER_SECTION_H

#include <stdbool.h>

#include "protocol/record.h"

struct section {
    bool cuts;        /* false: there is none */
    double normal[3]; /* of length 1 */
    double offset;    /* what has dot(normal, p) <= offset is kept */
};

/* Of a record of section_type; NULL, or nothing of it set: it does not cut. */
struct section section_from_record(const struct record *record);
/* How far beyond the plane a point is; -infinity where nothing is cut. */
double section_beyond(const struct section *section, const double p[3]);

#endif
