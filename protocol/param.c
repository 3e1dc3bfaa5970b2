/* SPDX-License-Identifier: MIT */
/* Values described by a row: read, checked, kept, printed and described. */
#include "param.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "declared_params.h"
#include "json.h"
#include "limits.h"
#include "memory.h"
#include "record.h"
#include "suggest.h"
#include "surface.h"

static const struct {
    const char *name;
    int components;
} types[] = {
    [PARAM_FLOAT] = {"float", 1},       [PARAM_INT] = {"int", 1},
    [PARAM_BOOL] = {"bool", 1},         [PARAM_VEC3] = {"vec3", 3},
    [PARAM_BVEC3] = {"bvec3", 3},       [PARAM_IVEC3] = {"ivec3", 3},
    [PARAM_COLOR] = {"color", 3},       [PARAM_ENUM] = {"enum", 1},
    [PARAM_TEXT] = {"text", 0},         [PARAM_MATERIAL] = {"material", 0},
    [PARAM_VEC2] = {"vec2", 2},         [PARAM_VEC4] = {"vec4", 4},
    [PARAM_POINTS] = {"points", 0},     [PARAM_CODE] = {"code", 0},
    [PARAM_MODEL] = {"model", 0},       [PARAM_FUNCTION] = {"function", 0},
    [PARAM_ROWS] = {"rows", 0},         [PARAM_ASSET] = {"asset", 0},
    [PARAM_IVEC2] = {"ivec2", 2},       [PARAM_IVEC4] = {"ivec4", 4},
    [PARAM_EQUATION] = {"equation", 0}, [PARAM_SURFACE] = {"surface", 0},
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

bool param_is_text(enum param_type type)
{
    return param_components(type) == 0 && type != PARAM_POINTS;
}

size_t param_text_bytes(enum param_type type)
{
    return type == PARAM_CODE       ? LIMIT_CODE_BYTES
           : type == PARAM_EQUATION ? LIMIT_EQUATION_BYTES
                                    : LIMIT_NAME_BYTES;
}

bool param_is_whole(enum param_type type)
{
    return type == PARAM_INT || type == PARAM_IVEC2 || type == PARAM_IVEC3 || type == PARAM_IVEC4;
}

void param_range(const struct param *param, double *out_min, double *out_max)
{
    const bool bounded = param->min != 0 || param->max != 0;

    *out_min = bounded ? param->min : param->type == PARAM_COLOR ? 0 : -LIMIT_COORDINATE;
    *out_max = bounded ? param->max : LIMIT_COORDINATE;
}

/* --- reading --- */

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
    if (param_is_whole(param->type) && number != floor(number)) {
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
    const int count = param_components(param->type);
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
    struct suggestion suggestion = {.text = text};
    char hint[64], list[160] = "";

    for (int i = 0; param->choices[i]; i++) {
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s\"%s\"", i ? ", " : "", param->choices[i]);
        suggest_consider(&suggestion, param->choices[i]);
    }
    return error_set(err, ERROR_INVALID, place, "\"%.64s\" is none of %s%s", text, list,
                     suggest_hint(&suggestion, hint, sizeof hint));
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

static bool read_points(const struct param *param, const cJSON *json, double *out_count,
                        const char *place, struct error *err)
{
    static const struct param point = {.type = PARAM_VEC2};
    size_t count = 0;

    if (!cJSON_IsArray(json)) {
        return error_set(err, ERROR_INVALID, place, "expected a list of points");
    }
    for (const cJSON *item = json->child; item; item = item->next, count++) {
        char path[ERROR_PLACE_BYTES], number[24];
        double pair[4];
        snprintf(number, sizeof number, "%zu", count);
        if (!read_vector(&point, item, pair, error_place(path, place, number), err)) {
            return false;
        }
    }
    *out_count = (double)count;
    if (*out_count > param->max) {
        return error_set(err, ERROR_LIMIT, place, "%zu points are above the maximum %g", count,
                         param->max);
    }
    return *out_count >= param->min ||
           error_set(err, ERROR_INVALID, place, "%zu points are below the minimum %g", count,
                     param->min);
}

static bool check_characters(const char *text, const char *allowed, const char *place,
                             struct error *err)
{
    for (; *text; text++) {
        if (((unsigned char)*text < 0x20 || *text == 0x7f) && !strchr(allowed, *text)) {
            return error_set(err, ERROR_INVALID, place, "control character %d is not allowed",
                             *text);
        }
    }
    return true;
}

static bool check_digest(const char *text, const char *place, struct error *err)
{
    const size_t length = strlen(text);

    return length == 0 || (length == DIGEST_DIGITS && strspn(text, "0123456789abcdef") == length) ||
           error_set(err, ERROR_INVALID, place, "\"%.80s\" is not %d small hexadecimal digits",
                     text, DIGEST_DIGITS);
}

static bool check_text(const struct param *param, const cJSON *json, const char *place,
                       struct error *err)
{
    if (!cJSON_IsString(json)) {
        return error_set(err, ERROR_INVALID, place, "expected a text");
    }
    const char *text = json->valuestring;
    const size_t length = strlen(text);
    if (param->type == PARAM_CODE || param->type == PARAM_EQUATION) {
        const size_t most = param_text_bytes(param->type);
        return length > most
                   ? error_set(err, ERROR_LIMIT, place, "%zu bytes are above the maximum %zu (%s)",
                               length, most,
                               param->type == PARAM_CODE ? "code_bytes" : "equation_bytes")
                   : check_characters(text, "\t\n", place, err);
    }
    if (param->type == PARAM_TEXT) {
        return length > LIMIT_NAME_BYTES
                   ? error_set(err, ERROR_INVALID, place, "%zu bytes are above the maximum %d",
                               length, LIMIT_NAME_BYTES)
                   : check_characters(text, "", place, err);
    }
    if (param->type == PARAM_ASSET) {
        return check_digest(text, place, err);
    }
    return !*text || record_check_name(text, place, err);
}

bool param_read(const struct param *param, const cJSON *json, double out[4], const char *place,
                struct error *err)
{
    struct surface surface;

    switch (param->type) {
    case PARAM_SURFACE:
        return surface_read(&surface, json, place, err);
    case PARAM_POINTS:
        return read_points(param, json, &out[0], place, err);
    case PARAM_ROWS:
        return declared_params_check(json, DECLARED_OF_ANY, NULL, place, err);
    case PARAM_ENUM:
        return read_choice(param, json, &out[0], place, err);
    default:
        break;
    }
    if (param_is_text(param->type)) {
        return check_text(param, json, place, err);
    }
    return param_components(param->type) == 1 ? read_part(param, 0, json, &out[0], place, err)
                                              : read_vector(param, json, out, place, err);
}

/* --- values --- */

void param_value_finish(struct value *value)
{
    free(value->text);
    free(value->points);
    *value = (struct value){0};
}

void param_value_reset(const struct param *param, struct value *value)
{
    param_value_finish(value);
    memcpy(value->number, param->def, sizeof value->number);
    if (param_is_text(param->type)) {
        value->text = memory_text(param->type == PARAM_ROWS      ? "[]"
                                  : param->type == PARAM_SURFACE ? "{}"
                                                                 : "");
    }
    if (param->type == PARAM_POINTS) {
        const size_t count = 2 * (size_t)param->def[0];
        value->points = memory_alloc(count, sizeof *value->points);
        memcpy(value->points, param->def_points, count * sizeof *value->points);
    }
}

void param_value_copy(struct value *to, const struct value *from)
{
    *to = *from;
    if (from->text) {
        to->text = memory_text(from->text);
    }
    if (from->points) {
        const size_t count = 2 * (size_t)from->number[0];
        to->points = memory_alloc(count, sizeof *to->points);
        memcpy(to->points, from->points, count * sizeof *to->points);
    }
}

bool param_value_equal(const struct value *a, const struct value *b)
{
    return a->set == b->set && memcmp(a->number, b->number, sizeof a->number) == 0 &&
           (!a->text || strcmp(a->text, b->text) == 0) &&
           (!a->points ||
            memcmp(a->points, b->points, 2 * (size_t)a->number[0] * sizeof *a->points) == 0);
}

static double *points_of(const cJSON *json, size_t count)
{
    double *points = memory_alloc(2 * count, sizeof *points), *at = points;

    for (const cJSON *item = json->child; item; item = item->next) {
        *at++ = item->child->valuedouble + 0.0; /* -0 becomes 0 */
        *at++ = item->child->next->valuedouble + 0.0;
    }
    return points;
}

bool param_value_set(const struct param *param, struct value *value, const cJSON *json,
                     const char *place, struct error *err)
{
    struct value fresh = {.set = true};

    if (!param_read(param, json, fresh.number, place, err)) {
        return false;
    }
    if (param->type == PARAM_POINTS) {
        fresh.points = points_of(json, (size_t)fresh.number[0]);
    } else if (param->type == PARAM_ROWS) {
        fresh.text = declared_params_text(json);
    } else if (param->type == PARAM_SURFACE) {
        fresh.text = surface_text(json);
    } else if (param_is_text(param->type)) {
        fresh.text = memory_text(json->valuestring);
    }
    param_value_finish(value);
    *value = fresh;
    return true;
}

/* --- giving --- */

static cJSON *number_to_json(const struct param *param, double number)
{
    const bool is_bool = param->type == PARAM_BOOL || param->type == PARAM_BVEC3;

    return is_bool ? cJSON_CreateBool(number != 0) : cJSON_CreateNumber(number);
}

static cJSON *numbers_to_json(const struct param *param, const double *numbers, int count)
{
    cJSON *array = cJSON_CreateArray();

    for (int i = 0; i < count; i++) {
        cJSON_AddItemToArray(array, number_to_json(param, numbers[i]));
    }
    return array;
}

static cJSON *points_to_json(const struct param *param, const struct value *value)
{
    cJSON *array = cJSON_CreateArray();

    for (size_t i = 0; i < (size_t)value->number[0]; i++) {
        cJSON_AddItemToArray(array, numbers_to_json(param, value->points + 2 * i, 2));
    }
    return array;
}

cJSON *param_value_json(const struct param *param, const struct value *value)
{
    const int components = param_components(param->type);

    switch (param->type) {
    case PARAM_POINTS:
        return points_to_json(param, value);
    case PARAM_ROWS:
    case PARAM_SURFACE:
        return json_parse(value->text, strlen(value->text), NULL);
    case PARAM_ENUM:
        return cJSON_CreateString(param->choices[(int)value->number[0]]);
    default:
        break;
    }
    return components == 0   ? cJSON_CreateString(value->text)
           : components == 1 ? number_to_json(param, value->number[0])
                             : numbers_to_json(param, value->number, components);
}

cJSON *param_default(const struct param *param)
{
    struct value value = {0};

    param_value_reset(param, &value);
    cJSON *json = param_value_json(param, &value);
    param_value_finish(&value);
    return json;
}

cJSON *param_describe(const struct param *param)
{
    cJSON *row = cJSON_CreateObject();

    cJSON_AddStringToObject(row, "name", param->name);
    cJSON_AddStringToObject(row, "type", param_type_name(param->type));
    if (param->unit != UNIT_NONE) {
        cJSON_AddStringToObject(row, "unit", param_unit_name(param->unit));
    }
    cJSON_AddItemToObject(row, "default", param_default(param));
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
    const struct {
        const char *name, *text;
    } texts[] = {{"group", param->group},
                 {"when", param->when},
                 {"zero", param->zero},
                 {"means", param->means},
                 {"handle", param->handle}};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        if (texts[i].text) {
            cJSON_AddStringToObject(row, texts[i].name, texts[i].text);
        }
    }
    cJSON_AddStringToObject(row, "doc", param->doc);
    return row;
}
