/* SPDX-License-Identifier: MIT */
/* A record is a list of named, typed values described by a table. Node parameters, transforms,
 * cameras, lights, materials: everything that a document holds is one, so reading, checking,
 * printing, setting and describing are written once. */
#ifndef PROTOCOL_RECORD_H
#define PROTOCOL_RECORD_H

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
    PARAM_BVEC3,    /* three booleans */
    PARAM_IVEC3,    /* three integers */
    PARAM_COLOR,    /* linear RGB, three numbers >= 0; a zero pair bounds it by LIMIT_COORDINATE */
    PARAM_ENUM,     /* one of `choices`; number[0] is its index */
    PARAM_TEXT,     /* free text, at most LIMIT_NAME_BYTES */
    PARAM_MATERIAL, /* name of a material of the scene, or "" for the parent's */
    PARAM_POINTS,   /* a list of points of the plane, [[x, y], ...]; `min` to `max` of them */
    PARAM_CODE,     /* GLSL text of several lines, at most LIMIT_CODE_BYTES */
    PARAM_MODEL,    /* name of a model of the scene, or "" */
    PARAM_FUNCTION, /* name of a distance function among `primitives`, or "" */
    PARAM_ROWS, /* parameters that a document declares: [{name, type, default, range, doc}, ...];
                     * `text` is their canonical JSON */
};

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
    const char *doc;
};

/* A table: `params` ends with a row whose name is NULL. */
struct record_type {
    const char *name;
    const char *doc;
    const struct param *params;
};

struct value {
    double number[4]; /* names, texts and code use `text` */
    char *text;       /* owned; never NULL for text types */
    double *points;   /* owned; PARAM_POINTS: x, y of `number[0]` points */
    bool set;         /* false: holds the default and is not printed */
};

/* Owned by whatever contains it. values[i] belongs to type->params[i] and always holds something
 * valid, the default where the document is silent. */
struct record {
    const struct record_type *type;
    struct value *values;
};

/* [A-Za-z0-9_.-]{1,64}: what ids of nodes and lights and names of materials look like. */
bool record_name_valid(const char *name);

size_t record_type_count(const struct record_type *type);
int record_type_find(const struct record_type *type, const char *name); /* -1: none */
/* Fills `err` for a name that record_type_find does not know, with the nearest one; false. */
bool record_type_unknown(const struct record_type *type, const char *name, const char *place,
                         struct error *err);
int param_components(enum param_type type);        /* 1 to 4, or 0 for texts and points */
const char *param_type_name(enum param_type type); /* "float", "vec3", "color", ... */
const char *param_unit_name(enum param_unit unit);
/* The range that holds, also where the row names none. */
void param_range(const struct param *param, double *out_min, double *out_max);
/* Checks JSON against the row; its numbers go to `out` (a text stays in the JSON). */
bool param_read(const struct param *param, const cJSON *json, double out[4], const char *place,
                struct error *err);
/* JSON of a value of this row; `text` is for the text types. Caller frees. */
cJSON *param_value_json(const struct param *param, const double number[4], const char *text);

void record_init(struct record *record, const struct record_type *type);
void record_finish(struct record *record);
void record_copy(struct record *to, const struct record *from);

/* Sets value `index` from JSON; JSON null restores the default. On failure nothing has changed
 * and `err` names `place` and the limit. */
bool record_set(struct record *record, int index, const cJSON *json, const char *place,
                struct error *err);
/* The same for a value in a document, where null has no meaning and is refused. */
bool record_read_value(struct record *record, int index, const cJSON *json, const char *place,
                       struct error *err);
/* The JSON of one value, or NULL where it is not set. Caller frees. */
cJSON *record_get(const struct record *record, int index);
/* Reads an object: unknown names are refused, names absent keep their default. `place` is the
 * path of the object. */
bool record_read(struct record *record, const cJSON *object, const char *place, struct error *err);
/* Adds every set value to `object`, in table order. */
void record_print(const struct record *record, cJSON *object);
/* The description of one row, for the schema: {name, type, unit, default, min, max, ...}. */
cJSON *param_describe(const struct param *param);

/* First component by name, for code that knows its table; asserts that the name exists. */
double record_number(const struct record *record, const char *name);
const double *record_vector(const struct record *record, const char *name);
const char *record_text(const struct record *record, const char *name);
/* Whether an enum holds this choice. */
bool record_is(const struct record *record, const char *name, const char *choice);

#endif
