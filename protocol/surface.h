/* SPDX-License-Identifier: MIT */
/* A parametric surface as a document keeps it beside the equation that was found for it:
 * {"x", "y", "z": expressions (equation.h), two of "s", "t", "u", "v": [low, high]}, or {}: none.
 * The expressions are read when the surface is proved, not here. */
#ifndef PROTOCOL_SURFACE_H
#define PROTOCOL_SURFACE_H

#include <cjson/cJSON.h>
#include <stdbool.h>

#include "error.h"

enum { SURFACE_PARTS = 3, SURFACE_LETTERS = 4, SURFACE_PARAMETERS = 2 };
enum { SURFACE_MEMBERS = SURFACE_PARTS + SURFACE_LETTERS };

/* The parts, then the letters; NULL at the end. */
extern const char *const surface_names[SURFACE_MEMBERS + 1];

/* What a proof says of an equation and the surface that it was found for. */
enum surface_verdict { SURFACE_VERIFIED, SURFACE_DOES_NOT_FIT, SURFACE_NOT_CHECKED };
extern const char *const surface_verdicts[];

/* How an equation is found. */
enum surface_method {
    SURFACE_BY_NULLSPACE,
    SURFACE_BY_RESULTANT,
    SURFACE_BY_GROEBNER,
    SURFACE_BY_SATURATION,
    SURFACE_METHODS,
};
extern const char *const surface_methods[]; /* NULL at the end */
#define SURFACE_METHOD_DOC                                                                         \
    "By linear algebra, by resultants, or by a Groebner basis: of the graded ideal, or of the "    \
    "one with a letter that stands for 1 / denominator."

/* What is asked: the method, the parts, and where the ranges are known, these and the clip. */
struct record;
extern const struct record_type surface_question_type;
/* Into a record of this type. All parts have to be there. The place of an error is the member's
 * name. */
bool surface_question_read(struct record *out, const cJSON *json, struct error *err);
/* The parts, with ranges of letters that have some: as surface_read takes it. Caller deletes. */
cJSON *surface_question_json(const struct record *asked);

struct surface {
    const char *parts[SURFACE_PARTS]; /* they stay in the JSON; all NULL: there is none */
    struct surface_range {
        bool set;
        double low, high;
    } ranges[SURFACE_LETTERS];
};

bool surface_read(struct surface *out, const cJSON *json, const char *place, struct error *err);
/* Canonical JSON of what surface_read takes. Caller frees. */
char *surface_text(const cJSON *json);

#endif
