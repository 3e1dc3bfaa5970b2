/* SPDX-License-Identifier: MIT */
/* A record is a list of named, typed values described by a table. Node parameters, transforms,
 * cameras, lights, materials: everything that a document holds is one, so reading, checking,
 * printing, setting and describing are written once. */
#ifndef PROTOCOL_RECORD_H
#define PROTOCOL_RECORD_H

#include "param.h"

/* A table: `params` ends with a row whose name is NULL. */
struct record_type {
    const char *name;
    const char *doc;
    const struct param *params;
};

/* Owned by its container. values[i] belongs to type->params[i] and always holds something
 * valid, the default where the document is silent. */
struct record {
    const struct record_type *type;
    struct value *values;
};

/* [A-Za-z0-9_.-]{1,64}: what ids of nodes and lights and names of materials look like. */
bool record_name_valid(const char *name);
/* The same with an error. */
bool record_check_name(const char *name, const char *place, struct error *err);

size_t record_type_count(const struct record_type *type);
int record_type_find(const struct record_type *type, const char *name); /* -1: none */
/* Fills `err` for a name that record_type_find does not know, with the nearest one; false. */
bool record_type_unknown(const struct record_type *type, const char *name, const char *place,
                         struct error *err);

void record_init(struct record *record, const struct record_type *type);
void record_finish(struct record *record);
void record_copy(struct record *to, const struct record *from);
bool record_equal(const struct record *a, const struct record *b); /* of one type */
/* What is set in `changes`, of the same type, is set in `record` too. */
void record_merge(struct record *record, const struct record *changes);

/* Sets value `index` from JSON; JSON null restores the default. On failure nothing has changed
 * and `err` names `place` and the limit. */
bool record_set(struct record *record, int index, const cJSON *json, const char *place,
                struct error *err);
/* The same for a value in a document, where null has no meaning and is refused. */
bool record_read_value(struct record *record, int index, const cJSON *json, const char *place,
                       struct error *err);
/* The JSON of one value, or NULL where it is not set. Caller frees. */
cJSON *record_get(const struct record *record, int index);
/* Reads an object: unknown names are refused, values of names that are absent stay. `place` is the
 * path of the object. */
bool record_read(struct record *record, const cJSON *object, const char *place, struct error *err);
/* One member of such an object, by its name; `place` is the object's. */
bool record_read_member(struct record *record, const cJSON *member, const char *place,
                        struct error *err);
/* Adds every set value to `object`, in table order. */
void record_print(const struct record *record, cJSON *object);
/* First component by name, for code that knows its table; asserts that the name exists. */
double record_number(const struct record *record, const char *name);
const double *record_vector(const struct record *record, const char *name);
const char *record_text(const struct record *record, const char *name);
bool record_is_set(const struct record *record, const char *name);
bool record_is_empty(const struct record *record); /* nothing is set */
/* Sets a value that its row accepts: a number, an enum's index, a switch; or a text. */
void record_put(struct record *record, const char *name, double number);
void record_put_text(struct record *record, const char *name, const char *text);
/* Whether an enum holds this choice. */
bool record_is(const struct record *record, const char *name, const char *choice);

#endif
