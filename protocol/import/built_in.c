/* SPDX-License-Identifier: MIT */
/* Built-in types by their names in the format, and what their `data` says. Every shape, operation
 * and modifier of the registry has one: "Primitives/RoundBox" is `round_box`. */
#include <assert.h>
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "import_internal.h"
#include "protocol/memory.h"
#include "protocol/suggest.h"

enum { NAME_BYTES = 48, NUMBERS_MAX = 2 * LIMIT_POINTS + 16 };

/* What the thesis itself has built in. Its names come before those of files, and its `data` may be
 * of another order or measure than the row. */
static const struct import_own {
    const char *name, *type;
    struct {
        const char *param; /* NULL in the first: as the row has it */
        double factor;
    } data[2];
} own_types[] = {
    {"Primitives/Sphere", "sphere", {{NULL, 0}}},
    {"Primitives/Cuboid", "box", {{NULL, 0}}},
    {"Primitives/Box", "box", {{NULL, 0}}},
    {"Primitives/Cylinder", "cylinder", {{"height", 2}, {"radius", 1}}},
    {"Primitives/Plane", "plane", {{"normal", 1}, {"offset", -1}}},
    {"Operations/Subtraction", "difference", {{NULL, 0}}},
    {"Operations/SmoothSubtraction", "smooth_difference", {{NULL, 0}}},
};
enum { OWN_TYPES = sizeof own_types / sizeof own_types[0], OWN_VALUES = 2 };

/* --- names --- */

/* The groups that name a row; modifiers are operations too. NULL: files name it. */
static const char *const *groups_of(const struct node_type *type)
{
    static const char *const primitives[] = {"Primitives", NULL};
    static const char *const operations[] = {"Operations", NULL};
    static const char *const modifiers[] = {"Modifiers", "Operations", NULL};

    switch (type->kind) {
    case KIND_SHAPE:
    case KIND_FLAT:
        return primitives;
    case KIND_COMBINE:
    case KIND_GROUP:
        return operations;
    case KIND_DISTANCE:
    case KIND_DOMAIN:
        return modifiers;
    case KIND_MODEL:
    case KIND_CODE:
    case KIND_EQUATION:
    case KIND_SURFACE:
        break;
    }
    return NULL;
}

/* "Primitives/RoundBox" of round_box. */
static void make_name(const struct node_type *type, const char *group, char out[NAME_BYTES])
{
    size_t used = (size_t)snprintf(out, NAME_BYTES, "%s/", group);
    bool first = true;

    for (const char *at = type->record.name; *at && used + 1 < NAME_BYTES; at++) {
        if (*at != '_') {
            out[used++] = (char)(first ? toupper((unsigned char)*at) : *at);
        }
        first = *at == '_';
    }
    out[used] = '\0';
}

static bool is_named(const struct node_type *type, const char *name)
{
    const char *const *groups = groups_of(type);
    char own[NAME_BYTES];

    for (; groups && *groups; groups++) {
        make_name(type, *groups, own);
        if (strcmp(own, name) == 0) {
            return true;
        }
    }
    return false;
}

static bool find_own(const char *name, struct import_built_in *out)
{
    size_t i = 0;

    while (i < OWN_TYPES && strcmp(own_types[i].name, name) != 0) {
        i++;
    }
    if (i < OWN_TYPES) {
        *out = (struct import_built_in){node_type_find(own_types[i].type), &own_types[i]};
    }
    return i < OWN_TYPES;
}

bool import_find_built_in(const struct importing *importing, const char *name,
                          struct import_built_in *out)
{
    const char *primitive = import_name_in(name, "Primitives");

    if (find_own(name, out)) {
        return true;
    }
    if (primitive && import_has(importing, IMPORT_PRIMITIVE, primitive)) {
        return false;
    }
    for (size_t i = 0; i < node_type_count(); i++) {
        if (is_named(node_type_at(i), name)) {
            *out = (struct import_built_in){node_type_at(i), NULL};
            return true;
        }
    }
    return false;
}

bool import_fail_type(const struct importing *importing, const struct import_item *item,
                      const struct import_value *type)
{
    const char *primitive = import_name_in(type->text, "Primitives");
    const size_t count = node_type_count();

    char(*names)[NAME_BYTES] = memory_alloc(count, sizeof *names), hint[96];
    struct suggestion suggestion = {.text = type->text};

    for (size_t i = 0; i < OWN_TYPES; i++) {
        suggest_consider(&suggestion, own_types[i].name);
    }
    for (size_t i = 0; i < count; i++) {
        const char *const *groups = groups_of(node_type_at(i));

        if (groups) {
            make_name(node_type_at(i), *groups, names[i]);
            suggest_consider(&suggestion, names[i]);
        }
    }
    suggest_hint(&suggestion, hint, sizeof hint);
    if (primitive) {
        import_fail(importing, item, type,
                    "no file has the primitive \"%.64s\", and it is not built in%s", primitive,
                    hint);
    } else {
        import_fail(importing, item, type,
                    "\"%.64s\" is no type: expected Primitives/NAME, Operations/NAME, "
                    "Modifiers/NAME or Models/NAME%s",
                    type->text, hint);
    }
    free(names);
    return false;
}

/* --- data --- */

/* Numbers that a parameter takes of `left`. */
static size_t numbers_of(const struct param *param, size_t left)
{
    return param->type == PARAM_POINTS ? left : (size_t)param_components(param->type);
}

static cJSON *read_switch(double number)
{
    return number == 0 || number == 1 ? cJSON_CreateBool(number != 0) : NULL;
}

/* NULL: the number is none of this kind. */
static cJSON *read_number(const struct param *param, double number)
{
    int choices = 0;

    if (param->type == PARAM_BOOL || param->type == PARAM_BVEC3) {
        return read_switch(number);
    }
    if (param->type != PARAM_ENUM) {
        return cJSON_CreateNumber(number);
    }
    while (param->choices[choices]) {
        choices++;
    }
    return number >= 0 && number < choices && number == floor(number)
               ? cJSON_CreateString(param->choices[(int)number])
               : NULL;
}

static cJSON *read_points(const double *data, size_t count)
{
    cJSON *points = cJSON_CreateArray();

    for (size_t i = 0; i + 1 < count; i += 2) {
        cJSON_AddItemToArray(points, cJSON_CreateDoubleArray(data + i, 2));
    }
    return points;
}

/* `count` numbers as the parameter takes them. */
static cJSON *read_param(const struct param *param, const double *data, size_t count)
{
    cJSON *json;

    if (param->type == PARAM_POINTS) {
        return count % 2 == 0 ? read_points(data, count) : NULL;
    }
    if (count == 1) {
        return read_number(param, data[0]);
    }
    json = cJSON_CreateArray();
    for (size_t i = 0; i < count; i++) {
        cJSON *part = read_number(param, data[i]);

        if (!part) {
            cJSON_Delete(json);
            return NULL;
        }
        cJSON_AddItemToArray(json, part);
    }
    return json;
}

static bool fail_param(const struct importing *importing, const struct import_item *item,
                       const struct import_value *list, const struct param *param, size_t count)
{
    const char *wanted = param->type == PARAM_ENUM     ? "the place of one of its choices, from 0"
                         : param->type == PARAM_POINTS ? "x and y of each point"
                         : count == 1                  ? "0 or 1"
                                                       : "0 or 1 for each axis";

    return import_fail(importing, item, list, "data: expected %s for %s", wanted, param->name);
}

/* What `data` gives, in the order of the row; what it does not reach keeps its default. */
static bool add_in_order(const struct importing *importing, const struct import_item *item,
                         const struct node_type *type, const struct import_value *list,
                         const double *data, cJSON *params)
{
    const struct param *param = type->record.params;

    for (size_t used = 0; param->name && used < list->count; param++) {
        const size_t left = list->count - used, count = numbers_of(param, left);
        cJSON *json;

        if (left < count) {
            return import_fail(importing, item, list,
                               "data: expected %zu numbers for %s, and %zu %s left", count,
                               param->name, left, left == 1 ? "is" : "are");
        }
        json = read_param(param, data + used, count);
        if (!json) {
            return fail_param(importing, item, list, param, count);
        }
        cJSON_AddItemToObject(params, param->name, json);
        used += count;
    }
    return true;
}

static void add_own(const struct import_own *own, const struct node_type *type, const double *data,
                    cJSON *params)
{
    double numbers[4];

    for (int i = 0; i < OWN_VALUES && own->data[i].param; i++) {
        const int index = record_type_find(&type->record, own->data[i].param);
        const int count = param_components(type->record.params[index].type);

        for (int k = 0; k < count; k++) {
            numbers[k] = *data++ * own->data[i].factor;
        }
        cJSON_AddItemToObject(params, own->data[i].param,
                              count == 1 ? cJSON_CreateNumber(numbers[0])
                                         : cJSON_CreateDoubleArray(numbers, count));
    }
}

/* Of all parameters. */
static size_t most_numbers(const struct node_type *type)
{
    size_t count = 0;

    for (const struct param *param = type->record.params; param->name; param++) {
        count += numbers_of(param, 2 * LIMIT_POINTS);
    }
    return count;
}

/* The thesis gives all numbers of its types; of others the first parameter has to be there. */
static size_t least_numbers(const struct import_built_in *built_in)
{
    const struct param *first = built_in->type->record.params;
    const bool all = built_in->own && built_in->own->data[0].param;

    return all ? most_numbers(built_in->type) : first->name ? numbers_of(first, 6) : 0;
}

bool import_add_data(const struct importing *importing, const struct import_item *item,
                     const struct import_built_in *built_in, const char *name,
                     const struct import_value *list, cJSON *node)
{
    const size_t least = least_numbers(built_in), most = most_numbers(built_in->type);
    double data[NUMBERS_MAX];

    assert(most <= NUMBERS_MAX);
    if (!import_read_data(importing, item, list, most > IMPORT_DATA_MAX ? most : IMPORT_DATA_MAX,
                          data)) {
        return false;
    }
    if (list->count < least || (least == 0 && list->count > 0)) {
        return import_fail(importing, item, list, "data: expected %zu number%s for %s", least,
                           least == 1 ? "" : "s", name);
    }
    cJSON *params = least ? cJSON_AddObjectToObject(node, "params") : NULL;
    if (built_in->own && built_in->own->data[0].param) {
        add_own(built_in->own, built_in->type, data, params);
        return true;
    }
    return add_in_order(importing, item, built_in->type, list, data, params);
}
