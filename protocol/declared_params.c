/* SPDX-License-Identifier: MIT */
/* Declared parameters: from JSON to rows of a table. */
#include "declared_params.h"

#include <assert.h>
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "limits.h"
#include "memory.h"
#include "suggest.h"

static const enum param_type types[] = {
    PARAM_FLOAT, PARAM_INT,   PARAM_BOOL,  PARAM_VEC2,  PARAM_VEC3,
    PARAM_VEC4,  PARAM_IVEC2, PARAM_IVEC3, PARAM_IVEC4, PARAM_COLOR,
};

const char *const declared_param_types[] = {"float", "int",   "bool",  "vec2",  "vec3", "vec4",
                                            "ivec2", "ivec3", "ivec4", "color", NULL};

const struct declared_param_alias declared_param_aliases[] = {
    {"float2", "vec2"}, {"float3", "vec3"}, {"float4", "vec4"}, {"int2", "ivec2"},
    {"int3", "ivec3"},  {"int4", "ivec4"},  {NULL, NULL},
};

enum { ROW_NAME, ROW_TYPE, ROW_SETS, ROW_DEFAULT, ROW_RANGE, ROW_DOC, ROW_MEMBERS };
static const char *const row_members[] = {"name", "type", "sets", "default", "range", "doc", NULL};

/* --- one row --- */

static bool is_identifier(const char *name)
{
    size_t length = 0;

    while (isalnum((unsigned char)name[length]) || name[length] == '_') {
        length++;
    }
    return length > 0 && length <= LIMIT_ID_BYTES && !name[length] &&
           !isdigit((unsigned char)name[0]) && strncmp(name, "gl_", 3) != 0 && !strstr(name, "__");
}

static bool read_name(struct param *out, const cJSON *json, const char *place, struct error *err)
{
    char path[ERROR_PLACE_BYTES];

    if (!json_read_text(json, &out->name, place, row_members[ROW_NAME], err)) {
        return false;
    }
    return is_identifier(out->name) ||
           error_set(
               err, ERROR_INVALID, error_place(path, place, row_members[ROW_NAME]),
               "\"%.80s\" is not a name for code: expected 1 to %d of A-Z a-z 0-9 _, no digit "
               "or gl_ first and no __",
               out->name, LIMIT_ID_BYTES);
}

/* The canonical name; others stay as they are. */
static const char *canonical(const char *name)
{
    int i = 0;

    while (declared_param_aliases[i].name && strcmp(declared_param_aliases[i].name, name) != 0) {
        i++;
    }
    return declared_param_aliases[i].name ? declared_param_aliases[i].type : name;
}

static bool read_type(struct param *out, const cJSON *json, const char *place, struct error *err)
{
    struct suggestion suggestion = {0};
    char path[ERROR_PLACE_BYTES], hint[64];

    if (!json_read_text(json, &suggestion.text, place, row_members[ROW_TYPE], err)) {
        return false;
    }
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        if (strcmp(param_type_name(types[i]), canonical(suggestion.text)) == 0) {
            out->type = types[i];
            return true;
        }
        suggest_consider(&suggestion, param_type_name(types[i]));
    }
    return error_set(err, ERROR_INVALID, error_place(path, place, row_members[ROW_TYPE]),
                     "\"%.64s\" is no type of a parameter%s", suggestion.text,
                     suggest_hint(&suggestion, hint, sizeof hint));
}

static bool read_range(struct param *out, const cJSON *json, const char *place, struct error *err)
{
    const struct param pair = {.type = param_is_whole(out->type) ? PARAM_INT : PARAM_FLOAT};
    char path[ERROR_PLACE_BYTES];
    double low[4], high[4];

    if (!json) {
        return true;
    }
    error_place(path, place, row_members[ROW_RANGE]);
    if (out->type == PARAM_BOOL || out->type == PARAM_COLOR) {
        return error_set(err, ERROR_INVALID, path, "a %s has no range", param_type_name(out->type));
    }
    if (!cJSON_IsArray(json) || cJSON_GetArraySize(json) != 2) {
        return error_set(err, ERROR_INVALID, path, "expected two numbers");
    }
    if (!param_read(&pair, json->child, low, path, err) ||
        !param_read(&pair, json->child->next, high, path, err)) {
        return false;
    }
    out->min = low[0];
    out->max = high[0];
    return low[0] < high[0] ||
           error_set(err, ERROR_INVALID, path, "the first number is not below the second");
}

static bool read_default(struct param *out, const cJSON *json, const char *place, struct error *err)
{
    char path[ERROR_PLACE_BYTES];

    if (json) {
        return param_read(out, json, out->def, error_place(path, place, row_members[ROW_DEFAULT]),
                          err);
    }
    const double nearest_to_0 = out->min > 0 ? out->min : out->max < 0 ? out->max : 0;
    for (int i = 0; i < param_components(out->type); i++) {
        out->def[i] = nearest_to_0;
    }
    return true;
}

/* Texts stay in the JSON. */
static bool read_row(struct param *out, const cJSON *json, const char *place, struct error *err)
{
    static const struct param doc = {.type = PARAM_TEXT};
    char path[ERROR_PLACE_BYTES];
    const cJSON *found[ROW_MEMBERS];

    *out = (struct param){.doc = ""};
    if (!json_sort_members(json, row_members, found, place, err) ||
        !read_name(out, found[ROW_NAME], place, err) ||
        !read_type(out, found[ROW_TYPE], place, err) ||
        !read_range(out, found[ROW_RANGE], place, err) ||
        !read_default(out, found[ROW_DEFAULT], place, err)) {
        return false;
    }
    if (!found[ROW_DOC]) {
        return true;
    }
    error_place(path, place, row_members[ROW_DOC]);
    out->doc = cJSON_GetStringValue(found[ROW_DOC]);
    return param_read(&doc, found[ROW_DOC], NULL, path, err);
}

/* What is said is said again, in one form. */
static cJSON *row_json(const struct param *row, const cJSON *json)
{
    cJSON *out = cJSON_CreateObject();

    cJSON_AddStringToObject(out, row_members[ROW_NAME], row->name);
    cJSON_AddStringToObject(out, row_members[ROW_TYPE], param_type_name(row->type));
    const cJSON *sets = cJSON_GetObjectItemCaseSensitive(json, row_members[ROW_SETS]);
    if (sets) {
        cJSON_AddStringToObject(out, row_members[ROW_SETS], sets->valuestring);
    }
    if (cJSON_GetObjectItemCaseSensitive(json, row_members[ROW_DEFAULT])) {
        cJSON_AddItemToObject(out, row_members[ROW_DEFAULT], param_default(row));
    }
    if (cJSON_GetObjectItemCaseSensitive(json, row_members[ROW_RANGE])) {
        const double range[] = {row->min, row->max};
        cJSON_AddItemToObject(out, row_members[ROW_RANGE], cJSON_CreateDoubleArray(range, 2));
    }
    if (cJSON_GetObjectItemCaseSensitive(json, row_members[ROW_DOC])) {
        cJSON_AddStringToObject(out, row_members[ROW_DOC], row->doc);
    }
    return out;
}

/* What rows of models have and others do not, and the other way. */
static bool check_kind(const cJSON *row, enum declared_of of, const char *place, struct error *err)
{
    const cJSON *sets = cJSON_GetObjectItemCaseSensitive(row, row_members[ROW_SETS]);
    char path[ERROR_PLACE_BYTES];

    error_place(path, place, row_members[ROW_SETS]);
    if (sets && !cJSON_IsString(sets)) {
        return error_set(err, ERROR_INVALID, path, "expected a text");
    }
    if (sets && of == DECLARED_OF_CODE) {
        return error_set(err, ERROR_INVALID, path, "only a parameter of a model sets something");
    }
    if (of != DECLARED_OF_MODEL) {
        return true;
    }
    if (cJSON_GetObjectItemCaseSensitive(row, row_members[ROW_DEFAULT])) {
        return error_set(err, ERROR_INVALID, error_place(path, place, row_members[ROW_DEFAULT]),
                         "what a model's tree has is the default");
    }
    return sets || error_set(err, ERROR_INVALID, path,
                             "is missing, expected a place such as \"/nodes/ID/params/radius\"");
}

/* Whether a row before this one sets the same. */
static bool check_alone(const cJSON *rows, const cJSON *row, const char *place, struct error *err)
{
    const char *sets =
        cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(row, row_members[ROW_SETS]));
    char path[ERROR_PLACE_BYTES];

    for (const cJSON *other = rows->child; sets && other != row; other = other->next) {
        const char *taken =
            cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(other, row_members[ROW_SETS]));
        if (taken && strcmp(taken, sets) == 0) {
            return error_set(err, ERROR_INVALID, error_place(path, place, row_members[ROW_SETS]),
                             "another parameter sets %.160s", sets);
        }
    }
    return true;
}

/* --- all rows --- */

bool declared_params_check(const cJSON *rows, enum declared_of of, const struct record_type *taken,
                           const char *place, struct error *err)
{
    struct param seen[LIMIT_DECLARED + 1] = {{.name = NULL}};
    const struct record_type before = {.params = seen};
    int count = 0;

    if (!cJSON_IsArray(rows)) {
        return error_set(err, ERROR_INVALID, place, "expected a list of parameters");
    }
    if (cJSON_GetArraySize(rows) > LIMIT_DECLARED) {
        return error_set(err, ERROR_LIMIT, place, "%d parameters are above the maximum %d",
                         cJSON_GetArraySize(rows), LIMIT_DECLARED);
    }
    for (const cJSON *row = rows->child; row; row = row->next) {
        char path[ERROR_PLACE_BYTES], number[24];
        struct param param;
        snprintf(number, sizeof number, "%d", count);
        if (!read_row(&param, row, error_place(path, place, number), err) ||
            !check_kind(row, of, path, err) || !check_alone(rows, row, path, err)) {
            return false;
        }
        error_place(path, path, row_members[ROW_NAME]);
        if (record_type_find(&before, param.name) >= 0) {
            return error_set(err, ERROR_INVALID, path, "\"%s\" is declared twice", param.name);
        }
        if (taken && record_type_find(taken, param.name) >= 0) {
            return error_set(err, ERROR_INVALID, path, "every %s has a \"%s\" already", taken->name,
                             param.name);
        }
        seen[count++] = param;
    }
    return true;
}

char *declared_params_text(const cJSON *rows)
{
    cJSON *canonical = cJSON_CreateArray();

    for (const cJSON *row = rows->child; row; row = row->next) {
        struct param param;
        read_row(&param, row, "", NULL);
        cJSON_AddItemToArray(canonical, row_json(&param, row));
    }
    char *text = json_print(canonical, false);
    cJSON_Delete(canonical);
    return text;
}

struct declared_params *declared_params_create(const char *name, const struct record_type *first,
                                               const char *text)
{
    struct declared_params *declared = memory_alloc(1, sizeof *declared);
    size_t count = first ? record_type_count(first) : 0;
    cJSON *rows = json_parse(text, strlen(text), NULL);

    assert(rows);
    struct param *params =
        memory_alloc(count + (size_t)cJSON_GetArraySize(rows) + 1, sizeof *params);
    if (first) {
        memcpy(params, first->params, count * sizeof *params);
    }
    declared->first_declared = count;
    declared->sets = memory_alloc((size_t)cJSON_GetArraySize(rows) + 1, sizeof *declared->sets);
    declared->type = (struct record_type){.name = memory_text(name), .doc = "", .params = params};
    for (const cJSON *row = rows->child; row; row = row->next, count++) {
        read_row(&params[count], row, "", NULL);
        params[count].name = memory_text(params[count].name);
        params[count].doc = memory_text(params[count].doc);
        const cJSON *sets = cJSON_GetObjectItemCaseSensitive(row, row_members[ROW_SETS]);
        declared->sets[count - declared->first_declared] =
            sets ? memory_text(sets->valuestring) : NULL;
    }
    cJSON_Delete(rows);
    return declared;
}

void declared_params_destroy(struct declared_params *declared)
{
    if (!declared) {
        return;
    }
    for (const struct param *row = declared->type.params + declared->first_declared; row->name;
         row++) {
        free(declared->sets[row - declared->type.params - declared->first_declared]);
        free((char *)row->name);
        free((char *)row->doc);
    }
    free(declared->sets);
    free((struct param *)declared->type.params);
    free((char *)declared->type.name);
    free(declared);
}
