/* SPDX-License-Identifier: MIT */
/* Records: values described by a table are read, checked, printed and described here. */
#include "record.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "limits.h"
#include "memory.h"
#include "nearest.h"

static const struct {
    const char *name;
    int components;
} types[] = {
    [PARAM_FLOAT] = {"float", 1},       [PARAM_INT] = {"int", 1},     [PARAM_BOOL] = {"bool", 1},
    [PARAM_VEC3] = {"vec3", 3},         [PARAM_BVEC3] = {"bvec3", 3}, [PARAM_IVEC3] = {"ivec3", 3},
    [PARAM_COLOR] = {"color", 3},       [PARAM_ENUM] = {"enum", 1},   [PARAM_TEXT] = {"text", 0},
    [PARAM_MATERIAL] = {"material", 0}, [PARAM_VEC2] = {"vec2", 2},   [PARAM_VEC4] = {"vec4", 4},
    [PARAM_POINTS] = {"points", 0},     [PARAM_CODE] = {"code", 0},   [PARAM_MODEL] = {"model", 0},
    [PARAM_FUNCTION] = {"function", 0}, [PARAM_ROWS] = {"rows", 0},
};

int param_components(enum param_type type)
{
    return types[type].components;
}

const char *param_type_name(enum param_type type)
{
    return types[type].name;
}

const char *param_unit_name(enum param_unit unit)
{
    static const char *const names[] = {
        [UNIT_NONE] = "none",
        [UNIT_LENGTH] = "length",
        [UNIT_ANGLE] = "angle",
        [UNIT_DEGREES] = "degrees",
    };
    return names[unit];
}

void param_range(const struct param *param, double *out_min, double *out_max)
{
    bool bounded = param->min != 0 || param->max != 0;
    *out_min = bounded ? param->min : param->type == PARAM_COLOR ? 0 : -LIMIT_COORDINATE;
    *out_max = bounded ? param->max : LIMIT_COORDINATE;
}

bool record_name_valid(const char *name)
{
    size_t length = strspn(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                 "0123456789_.-");
    return length > 0 && length <= LIMIT_ID_BYTES && name[length] == '\0';
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
    struct nearest nearest = {.text = name};
    char hint[64];
    for (const struct param *param = type->params; param->name; param++) {
        nearest_consider(&nearest, param->name);
    }
    return error_set(err, ERROR_INVALID, place, "%s has no member \"%.64s\"%s", type->name, name,
                     nearest_hint(&nearest, hint, sizeof hint));
}

static bool is_text(const struct param *param)
{
    return param_components(param->type) == 0;
}

static void restore_default(struct value *value, const struct param *param)
{
    memcpy(value->number, param->def, sizeof value->number);
    if (is_text(param)) {
        free(value->text);
        value->text = memory_text("");
    }
    value->set = false;
}

void record_init(struct record *record, const struct record_type *type)
{
    size_t count = record_type_count(type);
    record->type = type;
    record->values = memory_alloc(count, sizeof *record->values);
    for (size_t i = 0; i < count; i++) {
        restore_default(&record->values[i], &type->params[i]);
    }
}

void record_finish(struct record *record)
{
    if (!record->values) {
        return;
    }
    for (size_t i = 0; record->type->params[i].name; i++) {
        free(record->values[i].text);
    }
    free(record->values);
    *record = (struct record){0};
}

void record_copy(struct record *to, const struct record *from)
{
    size_t count = record_type_count(from->type);
    to->type = from->type;
    to->values = memory_alloc(count, sizeof *to->values);
    for (size_t i = 0; i < count; i++) {
        to->values[i] = from->values[i];
        if (from->values[i].text) {
            to->values[i].text = memory_text(from->values[i].text);
        }
    }
}

/* --- setting --- */

/* " (x)" for a part of a vector, nothing for a number alone. */
static const char *part_name(const struct param *param, int part)
{
    static const char *const axes[] = {" (x)", " (y)", " (z)", " (w)"};
    static const char *const colors[] = {" (red)", " (green)", " (blue)"};
    if (param_components(param->type) == 1) {
        return "";
    }
    return param->type == PARAM_COLOR ? colors[part] : axes[part];
}

/* NULL: nothing is wrong. `*out_limit` is the limit broken, NAN where there is none. */
static const char *number_fault(const struct param *param, double number, double *out_limit)
{
    double min, max;
    param_range(param, &min, &max);
    *out_limit = NAN;
    if (!isfinite(number)) {
        return "is not a finite number";
    }
    if ((param->type == PARAM_INT || param->type == PARAM_IVEC3) && number != floor(number)) {
        return "is not a whole number";
    }
    if (param->nonzero && number == 0) {
        return "is not allowed here";
    }
    *out_limit = number > max ? max : min;
    return number > max                        ? "is above the maximum "
           : number < min                      ? "is below the minimum "
           : param->above_min && number == min ? "is not above the minimum "
                                               : NULL;
}

static bool check_number(const struct param *param, int part, double number, const char *place,
                         struct error *err)
{
    double limit;
    const char *fault = number_fault(param, number, &limit);
    if (!fault) {
        return true;
    }
    char shown[32], limit_shown[32] = "";
    json_number(number, shown);
    if (!isnan(limit)) {
        json_number(limit, limit_shown);
    }
    return error_set(err, ERROR_INVALID, place, "%s%s %s%s", shown, part_name(param, part), fault,
                     limit_shown);
}

static bool read_part(const struct param *param, int part, const cJSON *json, double *out,
                      const char *place, struct error *err)
{
    const char *of = part_name(param, part);
    if (param->type == PARAM_BOOL || param->type == PARAM_BVEC3) {
        *out = cJSON_IsTrue(json);
        return cJSON_IsBool(json) ||
               error_set(err, ERROR_INVALID, place, "expected true or false%s", of);
    }
    if (!cJSON_IsNumber(json)) {
        return error_set(err, ERROR_INVALID, place, "expected a number%s", of);
    }
    *out = json->valuedouble + 0.0; /* -0 becomes 0 */
    return check_number(param, part, *out, place, err);
}

static bool read_vector(const struct param *param, const cJSON *json, double out[4],
                        const char *place, struct error *err)
{
    if (param->uniform && cJSON_IsNumber(json)) {
        if (!read_part(param, 0, json, &out[0], place, err)) {
            return false;
        }
        out[1] = out[2] = out[0];
        return true;
    }
    static const char *const counts[] = {"no", "one", "two", "three", "four"};
    const char *what = param->type == PARAM_BVEC3 ? "true or false" : "numbers";
    const cJSON *part = cJSON_IsArray(json) ? json->child : NULL;
    int count = param_components(param->type);
    for (int i = 0; i < count; i++, part = part->next) {
        if (!part) {
            return error_set(err, ERROR_INVALID, place, "expected %s %s%s", counts[count], what,
                             param->uniform ? " or one" : "");
        }
        if (!read_part(param, i, part, &out[i], place, err)) {
            return false;
        }
    }
    if (part) {
        return error_set(err, ERROR_INVALID, place, "expected %s %s, not more", counts[count],
                         what);
    }
    if (param->direction && out[0] == 0 && out[1] == 0 && out[2] == 0) {
        return error_set(err, ERROR_INVALID, place, "0, 0, 0 has no direction");
    }
    return true;
}

static bool fail_choice(const struct param *param, const char *text, const char *place,
                        struct error *err)
{
    struct nearest nearest = {.text = text};
    char hint[64], list[160] = "";
    for (int i = 0; param->choices[i]; i++) {
        size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s\"%s\"", i ? ", " : "", param->choices[i]);
        nearest_consider(&nearest, param->choices[i]);
    }
    return error_set(err, ERROR_INVALID, place, "\"%.64s\" is none of %s%s", text, list,
                     nearest_hint(&nearest, hint, sizeof hint));
}

static bool read_choice(const struct param *param, const cJSON *json, double *out,
                        const char *place, struct error *err)
{
    if (!cJSON_IsString(json)) {
        return error_set(err, ERROR_INVALID, place, "expected a text");
    }
    for (int i = 0; param->choices[i]; i++) {
        if (strcmp(param->choices[i], json->valuestring) == 0) {
            *out = i;
            return true;
        }
    }
    return fail_choice(param, json->valuestring, place, err);
}

static bool check_text(const struct param *param, const cJSON *json, const char *place,
                       struct error *err)
{
    if (!cJSON_IsString(json)) {
        return error_set(err, ERROR_INVALID, place, "expected a text");
    }
    const char *text = json->valuestring;
    if (param->type == PARAM_MATERIAL) {
        return !*text || record_name_valid(text) ||
               error_set(err, ERROR_INVALID, place,
                         "\"%.80s\" is not a name: expected 1 to %d of A-Z a-z 0-9 _ . -", text,
                         LIMIT_ID_BYTES);
    }
    size_t length = strlen(text);
    if (length > LIMIT_NAME_BYTES) {
        return error_set(err, ERROR_INVALID, place, "%zu bytes is above the maximum %d", length,
                         LIMIT_NAME_BYTES);
    }
    for (size_t i = 0; i < length; i++) {
        if ((unsigned char)text[i] < 0x20 || text[i] == 0x7f) {
            return error_set(err, ERROR_INVALID, place, "control character %d is not allowed",
                             text[i]);
        }
    }
    return true;
}

bool param_read(const struct param *param, const cJSON *json, double out[4], const char *place,
                struct error *err)
{
    if (is_text(param)) {
        return check_text(param, json, place, err);
    }
    if (param->type == PARAM_ENUM) {
        return read_choice(param, json, &out[0], place, err);
    }
    return param_components(param->type) == 1 ? read_part(param, 0, json, &out[0], place, err)
                                              : read_vector(param, json, out, place, err);
}

bool record_set(struct record *record, int index, const cJSON *json, const char *place,
                struct error *err)
{
    const struct param *param = &record->type->params[index];
    struct value *value = &record->values[index];
    double number[4] = {0};
    if (cJSON_IsNull(json)) {
        restore_default(value, param);
        return true;
    }
    if (!param_read(param, json, number, place, err)) {
        return false;
    }
    if (is_text(param)) {
        char *text = memory_text(json->valuestring);
        free(value->text);
        value->text = text;
    }
    memcpy(value->number, number, sizeof number);
    value->set = true;
    return true;
}

bool record_read_value(struct record *record, int index, const cJSON *json, const char *place,
                       struct error *err)
{
    if (cJSON_IsNull(json)) {
        return error_set(err, ERROR_INVALID, place, "null is not a value: leave the member out");
    }
    return record_set(record, index, json, place, err);
}

bool record_read(struct record *record, const cJSON *object, const char *place, struct error *err)
{
    if (!cJSON_IsObject(object)) {
        return error_set(err, ERROR_INVALID, place, "expected an object");
    }
    for (const cJSON *member = object->child; member; member = member->next) {
        char path[ERROR_PLACE_BYTES];
        int index = record_type_find(record->type, member->string);
        error_place(path, place, member->string);
        if (index < 0) {
            return record_type_unknown(record->type, member->string, path, err);
        }
        if (!record_read_value(record, index, member, path, err)) {
            return false;
        }
    }
    return true;
}

/* --- giving --- */

static cJSON *number_to_json(const struct param *param, double number)
{
    bool is_bool = param->type == PARAM_BOOL || param->type == PARAM_BVEC3;
    return is_bool ? cJSON_CreateBool(number != 0) : cJSON_CreateNumber(number);
}

cJSON *param_value_json(const struct param *param, const double number[4], const char *text)
{
    if (is_text(param)) {
        return cJSON_CreateString(text);
    }
    if (param->type == PARAM_ENUM) {
        return cJSON_CreateString(param->choices[(int)number[0]]);
    }
    if (param_components(param->type) == 1) {
        return number_to_json(param, number[0]);
    }
    cJSON *array = cJSON_CreateArray();
    for (int i = 0; i < param_components(param->type); i++) {
        cJSON_AddItemToArray(array, number_to_json(param, number[i]));
    }
    return array;
}

cJSON *record_get(const struct record *record, int index)
{
    const struct value *value = &record->values[index];
    return value->set ? param_value_json(&record->type->params[index], value->number, value->text)
                      : NULL;
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

cJSON *param_describe(const struct param *param)
{
    cJSON *row = cJSON_CreateObject();
    cJSON_AddStringToObject(row, "name", param->name);
    cJSON_AddStringToObject(row, "type", param_type_name(param->type));
    if (param->unit != UNIT_NONE) {
        cJSON_AddStringToObject(row, "unit", param_unit_name(param->unit));
    }
    cJSON_AddItemToObject(row, "default", param_value_json(param, param->def, ""));
    if (param->min != 0 || param->max != 0 || param->type == PARAM_COLOR) {
        double min, max;
        param_range(param, &min, &max);
        cJSON_AddNumberToObject(row, "min", min);
        cJSON_AddNumberToObject(row, "max", max);
    }
    if (param->step != 0) {
        cJSON_AddNumberToObject(row, "step", param->step);
    }
    const struct {
        const char *name;
        bool holds;
    } flags[] = {{"above_min", param->above_min},
                 {"nonzero", param->nonzero},
                 {"direction", param->direction},
                 {"uniform", param->uniform},
                 {"main", param->main}};
    for (size_t i = 0; i < sizeof flags / sizeof flags[0]; i++) {
        if (flags[i].holds) {
            cJSON_AddTrueToObject(row, flags[i].name);
        }
    }
    cJSON *choices = param->choices ? cJSON_AddArrayToObject(row, "choices") : NULL;
    for (int i = 0; choices && param->choices[i]; i++) {
        cJSON_AddItemToArray(choices, cJSON_CreateString(param->choices[i]));
    }
    cJSON_AddStringToObject(row, "doc", param->doc);
    return row;
}

static const struct value *named_value(const struct record *record, const char *name)
{
    int index = record_type_find(record->type, name);
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

bool record_is(const struct record *record, const char *name, const char *choice)
{
    int index = record_type_find(record->type, name);
    assert(index >= 0 && record->type->params[index].choices);
    return strcmp(record->type->params[index].choices[(int)record->values[index].number[0]],
                  choice) == 0;
}
