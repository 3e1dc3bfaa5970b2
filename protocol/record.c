/* SPDX-License-Identifier: MIT */
/* Records: lists of values by name. A single value is param.c. */
#include "record.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "limits.h"
#include "memory.h"
#include "suggest.h"

bool record_name_valid(const char *name)
{
    const size_t length = strspn(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                       "0123456789_.-");

    return length > 0 && length <= LIMIT_ID_BYTES && name[length] == '\0';
}

bool record_check_name(const char *name, const char *place, struct error *err)
{
    return record_name_valid(name) ||
           error_set(err, ERROR_INVALID, place,
                     "\"%.80s\" is not a name: expected 1 to %d of A-Z a-z 0-9 _ . -", name,
                     LIMIT_ID_BYTES);
}

size_t record_type_count(const struct record_type *type)
{
    size_t count = 0;

    while (type->params[count].name) {
        count++;
    }
    return count;
}

int record_type_find(const struct record_type *type, const char *name)
{
    for (int i = 0; type->params[i].name; i++) {
        if (strcmp(type->params[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

bool record_type_unknown(const struct record_type *type, const char *name, const char *place,
                         struct error *err)
{
    struct suggestion suggestion = {.text = name};
    char hint[64];

    for (const struct param *param = type->params; param->name; param++) {
        suggest_consider(&suggestion, param->name);
    }
    return error_set(err, ERROR_INVALID, place, "%s has no member \"%.64s\"%s", type->name, name,
                     suggest_hint(&suggestion, hint, sizeof hint));
}

void record_init(struct record *record, const struct record_type *type)
{
    const size_t count = record_type_count(type);

    record->type = type;
    record->values = memory_alloc(count, sizeof *record->values);
    for (size_t i = 0; i < count; i++) {
        param_value_reset(&type->params[i], &record->values[i]);
    }
}

void record_finish(struct record *record)
{
    if (!record->values) {
        return;
    }
    for (size_t i = 0; record->type->params[i].name; i++) {
        param_value_finish(&record->values[i]);
    }
    free(record->values);
    *record = (struct record){0};
}

void record_copy(struct record *to, const struct record *from)
{
    const size_t count = record_type_count(from->type);

    to->type = from->type;
    to->values = memory_alloc(count, sizeof *to->values);
    for (size_t i = 0; i < count; i++) {
        param_value_copy(&to->values[i], &from->values[i]);
    }
}

bool record_equal(const struct record *a, const struct record *b)
{
    int i = 0;

    while (a->type->params[i].name && param_value_equal(&a->values[i], &b->values[i])) {
        i++;
    }
    return !a->type->params[i].name;
}

void record_merge(struct record *record, const struct record *changes)
{
    for (int i = 0; record->type->params[i].name; i++) {
        if (changes->values[i].set) {
            param_value_finish(&record->values[i]);
            param_value_copy(&record->values[i], &changes->values[i]);
        }
    }
}

/* --- setting --- */

bool record_set(struct record *record, int index, const cJSON *json, const char *place,
                struct error *err)
{
    const struct param *param = &record->type->params[index];

    if (cJSON_IsNull(json)) {
        param_value_reset(param, &record->values[index]);
        return true;
    }
    return param_value_set(param, &record->values[index], json, place, err);
}

bool record_read_value(struct record *record, int index, const cJSON *json, const char *place,
                       struct error *err)
{
    if (cJSON_IsNull(json)) {
        return error_set(err, ERROR_INVALID, place, "null is not a value: leave the member out");
    }
    return record_set(record, index, json, place, err);
}

bool record_read_member(struct record *record, const cJSON *member, const char *place,
                        struct error *err)
{
    char path[ERROR_PLACE_BYTES];
    const int index = record_type_find(record->type, member->string);

    error_place(path, place, member->string);
    return index < 0 ? record_type_unknown(record->type, member->string, path, err)
                     : record_read_value(record, index, member, path, err);
}

bool record_read(struct record *record, const cJSON *object, const char *place, struct error *err)
{
    if (!cJSON_IsObject(object)) {
        return error_set(err, ERROR_INVALID, place, "expected an object");
    }
    for (const cJSON *member = object->child; member; member = member->next) {
        if (!record_read_member(record, member, place, err)) {
            return false;
        }
    }
    return true;
}

/* --- giving --- */

cJSON *record_get(const struct record *record, int index)
{
    const struct value *value = &record->values[index];

    return value->set ? param_value_json(&record->type->params[index], value) : NULL;
}

void record_print(const struct record *record, cJSON *object)
{
    for (int i = 0; record->type->params[i].name; i++) {
        cJSON *json = record_get(record, i);
        if (json) {
            cJSON_AddItemToObject(object, record->type->params[i].name, json);
        }
    }
}

static struct value *named_value(const struct record *record, const char *name)
{
    const int index = record_type_find(record->type, name);

    assert(index >= 0);
    return &record->values[index];
}

double record_number(const struct record *record, const char *name)
{
    return named_value(record, name)->number[0];
}

const double *record_vector(const struct record *record, const char *name)
{
    return named_value(record, name)->number;
}

const char *record_text(const struct record *record, const char *name)
{
    return named_value(record, name)->text;
}

bool record_is_set(const struct record *record, const char *name)
{
    return named_value(record, name)->set;
}

bool record_is_empty(const struct record *record)
{
    int i = 0;

    while (record->type->params[i].name && !record->values[i].set) {
        i++;
    }
    return !record->type->params[i].name;
}

void record_put(struct record *record, const char *name, double number)
{
    struct value *value = named_value(record, name);

    value->number[0] = number;
    value->set = true;
}

void record_put_text(struct record *record, const char *name, const char *text)
{
    struct value *value = named_value(record, name);

    free(value->text);
    value->text = memory_text(text);
    value->set = true;
}

bool record_is(const struct record *record, const char *name, const char *choice)
{
    const int index = record_type_find(record->type, name);

    assert(index >= 0 && record->type->params[index].choices);
    return strcmp(record->type->params[index].choices[(int)record->values[index].number[0]],
                  choice) == 0;
}
