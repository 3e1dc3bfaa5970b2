/* SPDX-License-Identifier: MIT */
/* Parametric surfaces in documents: from JSON and back. */
#include "surface.h"

#include <string.h>

#include "json.h"
#include "limits.h"
#include "param.h"
#include "record.h"

const char *const surface_names[SURFACE_MEMBERS + 1] = {"x", "y", "z", "s", "t", "u", "v", NULL};

const char *const surface_verdicts[] = {[SURFACE_VERIFIED] = "verified",
                                        [SURFACE_DOES_NOT_FIT] = "does not fit",
                                        [SURFACE_NOT_CHECKED] = "not checked"};

const char *const surface_methods[] = {[SURFACE_BY_NULLSPACE] = "nullspace",
                                       [SURFACE_BY_RESULTANT] = "resultant",
                                       [SURFACE_BY_GROEBNER] = "groebner",
                                       [SURFACE_BY_SATURATION] = "saturation",
                                       [SURFACE_METHODS] = NULL};

/* clang-format off */
const struct record_type surface_question_type = {
    "implicitize", "The equation of a parametric surface.",
    (const struct param[]){
        {"method", PARAM_ENUM, .def = {SURFACE_BY_NULLSPACE}, .choices = surface_methods,
         .doc = SURFACE_METHOD_DOC},
        {"x", PARAM_EQUATION, .doc = "An expression in two of the letters s, t, u and v."},
        {"y", PARAM_EQUATION, .doc = "The same."},
        {"z", PARAM_EQUATION, .doc = "The same."},
        {"s", PARAM_VEC2, .doc = "From where to where s goes. With both ranges the answer tells "
                                 "how much of the implicit surface the patch covers, and has "
                                 "the patch alone as a node."},
        {"t", PARAM_VEC2, .doc = "The same of t."},
        {"u", PARAM_VEC2, .doc = "The same of u."},
        {"v", PARAM_VEC2, .doc = "The same of v."},
        {"size", PARAM_VEC3, UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE,
         .zero = "around the patch",
         .doc = "Full lengths of the box about the origin that cuts the implicit surface; where "
                "one is 0, the box goes around the patch."},
        {.name = NULL}}};
/* clang-format on */

static bool check_parts(const struct record *asked, struct error *err)
{
    for (int i = 0; i < SURFACE_PARTS; i++) {
        if (!record_is_set(asked, surface_names[i])) {
            return error_set(err, ERROR_INVALID, surface_names[i], "is missing");
        }
    }
    return true;
}

bool surface_question_read(struct record *out, const cJSON *json, struct error *err)
{
    const bool ok = record_read(out, json, "", err);

    if (!ok && err->place[0] == '/') {
        memmove(err->place, err->place + 1, strlen(err->place));
    }
    return ok && check_parts(out, err);
}

cJSON *surface_question_json(const struct record *asked)
{
    cJSON *json = cJSON_CreateObject();

    for (int i = 0; i < SURFACE_MEMBERS; i++) {
        if (record_is_set(asked, surface_names[i])) {
            cJSON_AddItemToObject(
                json, surface_names[i],
                record_get(asked, record_type_find(asked->type, surface_names[i])));
        }
    }
    return json;
}

static bool read_part(const char **out, const cJSON *json, int member, const char *place,
                      struct error *err)
{
    static const struct param expression = {.type = PARAM_EQUATION};
    char path[ERROR_PLACE_BYTES];

    error_place(path, place, surface_names[member]);
    if (!json) {
        return error_set(err, ERROR_INVALID, path, "is missing");
    }
    *out = cJSON_GetStringValue(json);
    return param_read(&expression, json, NULL, path, err);
}

static bool read_range(struct surface_range *out, const cJSON *json, int member, const char *place,
                       struct error *err)
{
    static const struct param pair = {.type = PARAM_VEC2};
    char path[ERROR_PLACE_BYTES];
    double numbers[4];

    error_place(path, place, surface_names[member]);
    if (!param_read(&pair, json, numbers, path, err)) {
        return false;
    }
    *out = (struct surface_range){true, numbers[0], numbers[1]};
    return numbers[0] < numbers[1] ||
           error_set(err, ERROR_INVALID, path, "the first number is not below the second");
}

bool surface_read(struct surface *out, const cJSON *json, const char *place, struct error *err)
{
    const cJSON *found[SURFACE_MEMBERS];
    int parameters = 0;

    *out = (struct surface){0};
    if (!json_sort_members(json, surface_names, found, place, err)) {
        return false;
    }
    if (!json->child) {
        return true;
    }
    for (int i = 0; i < SURFACE_PARTS; i++) {
        if (!read_part(&out->parts[i], found[i], i, place, err)) {
            return false;
        }
    }
    for (int i = SURFACE_PARTS; i < SURFACE_MEMBERS; i++) {
        parameters += found[i] != NULL;
        if (found[i] && !read_range(&out->ranges[i - SURFACE_PARTS], found[i], i, place, err)) {
            return false;
        }
    }
    return parameters == SURFACE_PARAMETERS ||
           error_set(err, ERROR_INVALID, place,
                     "the ranges of %d letters; a surface has two parameters, of s, t, u, v",
                     parameters);
}

char *surface_text(const cJSON *json)
{
    struct surface surface;
    cJSON *canonical = cJSON_CreateObject();

    surface_read(&surface, json, "", NULL);
    for (int i = 0; i < SURFACE_PARTS && surface.parts[i]; i++) {
        cJSON_AddStringToObject(canonical, surface_names[i], surface.parts[i]);
    }
    for (int i = 0; i < SURFACE_LETTERS; i++) {
        const struct surface_range *range = &surface.ranges[i];
        if (range->set) {
            const double pair[] = {range->low + 0.0, range->high + 0.0}; /* -0 becomes 0 */
            cJSON_AddItemToObject(canonical, surface_names[SURFACE_PARTS + i],
                                  cJSON_CreateDoubleArray(pair, 2));
        }
    }
    char *text = json_print(canonical, false);
    cJSON_Delete(canonical);
    return text;
}
