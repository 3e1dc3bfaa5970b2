/* SPDX-License-Identifier: MIT */
/* One row of a table and one value that it describes. Rows decide how a value is read, checked,
 * printed and described. */
#ifndef PROTOCOL_PARAM_H
#define PROTOCOL_PARAM_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>

#include "error.h"

enum param_type {
    PARAM_FLOAT,
    PARAM_INT,
    PARAM_BOOL,
    PARAM_VEC2,
    PARAM_VEC3,
    PARAM_VEC4,
    PARAM_BVEC3, /* three booleans */
    PARAM_IVEC2, /* two integers */
    PARAM_IVEC3,
    PARAM_IVEC4,
    PARAM_COLOR,    /* linear RGB, three numbers >= 0; a zero pair bounds it by LIMIT_COORDINATE */
    PARAM_ENUM,     /* one of `choices`; number[0] is its index */
    PARAM_TEXT,     /* free text, at most LIMIT_NAME_BYTES */
    PARAM_MATERIAL, /* name of a material of the scene, or "" for the parent's */
    PARAM_POINTS,   /* a list of points of the plane, [[x, y], ...]; `min` to `max` of them */
    PARAM_CODE,     /* GLSL text of several lines, at most LIMIT_CODE_BYTES */
    PARAM_MODEL,    /* name of a model of the scene, or "" */
    PARAM_FUNCTION, /* name of a distance function among `primitives`, or "" */
    PARAM_ASSET,    /* an uploaded file: its SHA-256 in 64 small hex digits, or "" */
    PARAM_EQUATION, /* an equation (equation.h) of several lines, at most LIMIT_EQUATION_BYTES */
    PARAM_SURFACE,  /* a parametric surface (surface.h); `text` is its JSON */
    PARAM_ROWS, /* parameters that a document declares (declared_params.h); `text` is their JSON */
};

enum { DIGEST_DIGITS = 64 }; /* of a SHA-256 */

enum param_unit { UNIT_NONE, UNIT_LENGTH, UNIT_ANGLE /* radians */, UNIT_DEGREES };

/* One row. A zero `min` and `max` pair means: only LIMIT_COORDINATE bounds it. */
struct param {
    const char *name;
    enum param_type type;
    enum param_unit unit;
    double def[4];
    const double *def_points; /* PARAM_POINTS: the default's coordinates, `def[0]` points */
    double min, max;
    bool above_min;             /* the minimum itself is excluded (radius > 0) */
    bool nonzero;               /* every component differs from 0 (scale) */
    bool direction;             /* a vector with a length: not all three are 0 */
    bool uniform;               /* a vector that is also read from one number, for all three */
    double step;                /* what one arrow key adds; 0 lets the editor choose */
    const char *const *choices; /* PARAM_ENUM: NULL-terminated */
    bool main;                  /* among the two that a compact view shows */
    const char *group;          /* the heading that forms put it under; NULL: none */
    /* It matters only then: "type=sky", "opacity!=1", "equation~a" (that equation has the letter
     * a); NULL: always. */
    const char *when;
    const char *zero;  /* what forms show for 0: "auto"; NULL: 0 is a number like others */
    const char *means; /* what it shares with rows of other shaders; NULL: nothing */
    /* Where an editor lets a hand change the value, in the node's own space; NULL: nowhere. One
     * point "X, Y, Z" for all of the value, or one for each component, with ";" between them. X, Y
     * and Z are expressions of numbers, + - * / ^ ( ), sqrt, sin, cos, pi and numbers of the same
     * record: `radius`, `size.x`. The point of a length or an angle of a shape lies on its surface,
     * that of a place at the place. Where it is not finite, there is none. Of lights and volumes it
     * is relative to their position. `skin` is a point of the surface that the node has or changes,
     * before the change, and `out` the unit vector out of it there: the editor finds them. */
    const char *handle;
    const char *doc;
};

/* One more row: of a letter of an equation, which matters where it stands in the parameter IN. */
#define LETTER_ROW(LETTER, IN)                                                                     \
    ,                                                                                              \
    {                                                                                              \
        LETTER, PARAM_FLOAT, UNIT_NONE, .def = {1}, .step = 0.01, .when = IN "~" LETTER,           \
                                        .doc = "The letter " LETTER "."                            \
    }

/* Always holds something that its row accepts. */
struct value {
    double number[4]; /* names, texts and code use `text` */
    char *text;       /* owned; never NULL for text types */
    double *points;   /* owned; PARAM_POINTS: x, y of `number[0]` points */
    bool set;         /* false: holds the default and is not printed */
};

int param_components(enum param_type type);        /* 1 to 4, or 0 for texts and points */
const char *param_type_name(enum param_type type); /* "float", "vec3", "color", ... */
const char *param_unit_name(enum param_unit unit);
bool param_is_text(enum param_type type);      /* a value's `text` is used */
size_t param_text_bytes(enum param_type type); /* of PARAM_TEXT, _CODE, _EQUATION at most */
bool param_is_whole(enum param_type type);     /* its numbers have no fraction */
/* The range that holds, also where the row names none. */
void param_range(const struct param *param, double *out_min, double *out_max);
/* Checks JSON against the row; numbers go to `out` (a text and points stay in the JSON). */
bool param_read(const struct param *param, const cJSON *json, double out[4], const char *place,
                struct error *err);
/* The description of one row, for the schema: {name, type, unit, default, min, max, ...}. */
cJSON *param_describe(const struct param *param);
/* The default as JSON. Caller frees. */
cJSON *param_default(const struct param *param);

/* Values of this row. A zeroed value may be given to _reset and _finish. */
void param_value_reset(const struct param *param, struct value *value); /* to the default */
void param_value_finish(struct value *value);
void param_value_copy(struct value *to, const struct value *from); /* `to` is overwritten */
bool param_value_equal(const struct value *a, const struct value *b);
/* Reads and keeps JSON that is no null; on failure nothing has changed. */
bool param_value_set(const struct param *param, struct value *value, const cJSON *json,
                     const char *place, struct error *err);
/* Also of a value that holds the default. Caller frees. */
cJSON *param_value_json(const struct param *param, const struct value *value);

#endif
