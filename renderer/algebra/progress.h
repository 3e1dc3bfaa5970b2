/* SPDX-License-Identifier: MIT */
/* The steps of implicitization as they happen, each a line of JSON: {"step", "count", "ms" since
 * the start, "text"}. One thread. */
#ifndef RENDERER_ALGEBRA_PROGRESS_H
#define RENDERER_ALGEBRA_PROGRESS_H

#include <stdio.h>
#include <time.h>

enum progress_step {
    PROGRESS_DEGREE,      /* count: of the equation */
    PROGRESS_SUPPORT,     /* its terms */
    PROGRESS_PRIME,       /* primes so far */
    PROGRESS_PAIRS,       /* of a basis, so far */
    PROGRESS_EXACT,       /* its terms; the parts put into it give 0 */
    PROGRESS_IRREDUCIBLE, /* its factors: 1, or 0 where nobody knows */
    PROGRESS_COVERAGE,    /* points */
};

struct progress {
    FILE *out;
    struct timespec start;
};

void progress_init(struct progress *progress, FILE *out);
__attribute__((format(printf, 4, 5))) void progress_tell(const struct progress *progress,
                                                         enum progress_step step, long count,
                                                         const char *format, ...);

#endif
