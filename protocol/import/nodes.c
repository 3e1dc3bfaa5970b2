/* SPDX-License-Identifier: MIT */
/* Trees of models and scenes: {"type": "Primitives/Sphere", "data": [0.5], ...}. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "parts.h"
#include "protocol/nearest.h"

/* THE TABLE of built-in types: what a primitive reads of its `data`, in order. */
static const struct built_in {
    const char *group, *name, *type;
    struct {
        const char *param;
        int components;
        double factor;
    } data[2];
} built_ins[] = {
    {"Primitives", "Sphere", "sphere", {{"radius", 1, 1}}},
    {"Primitives", "Cuboid", "box", {{"size", 3, 1}}},
    {"Primitives", "Box", "box", {{"size", 3, 1}}},
    {"Primitives", "Cylinder", "cylinder", {{"height", 1, 2}, {"radius", 1, 1}}},
    {"Primitives", "Plane", "plane", {{"normal", 3, 1}, {"offset", 1, -1}}},
    {"Operations", "Union", "union", {{NULL, 0, 0}}},
    {"Operations", "Intersection", "intersection", {{NULL, 0, 0}}},
    {"Operations", "Subtraction", "difference", {{NULL, 0, 0}}},
    {"Operations", "SmoothUnion", "smooth_union", {{"k", 1, 1}}},
    {"Operations", "SmoothIntersection", "smooth_intersection", {{"k", 1, 1}}},
    {"Operations", "SmoothSubtraction", "smooth_difference", {{"k", 1, 1}}},
};
enum { BUILT_INS = sizeof built_ins / sizeof built_ins[0], BUILT_IN_VALUES = 2 };

static const char *const node_members[] = {"type",        "model",    "data", "transform",
                                           "material_id", "children", NULL};

/* --- what a node is --- */

/* "Group/Name" of a node, under `type` or, as one listing has it, under `model`. */
static const struct import_value *type_value(const struct importing *importing,
                                             const struct import_item *item,
                                             const struct import_value *node)
{
    const struct import_value *type, *model;

    if (node->kind != IMPORT_OBJECT) {
        import_fail(importing, item, node, "expected a node {\"type\": ...}");
        return NULL;
    }
    if (!import_take(importing, item, node, "type", IMPORT_TEXT, &type) ||
        !import_take(importing, item, node, "model", IMPORT_TEXT, &model)) {
        return NULL;
    }
    if (!type == !model) {
        import_fail(importing, item, node, "expected one member type, as \"Primitives/Sphere\"");
        return NULL;
    }
    return type ? type : model;
}

/* What stands behind "GROUP/"; NULL: another group. */
static const char *name_in(const char *type, const char *group)
{
    const size_t length = strlen(group);

    return strncmp(type, group, length) == 0 && type[length] == '/' ? type + length + 1 : NULL;
}

static const struct built_in *find_built_in(const char *type)
{
    for (size_t i = 0; i < BUILT_INS; i++) {
        const char *name = name_in(type, built_ins[i].group);

        if (name && strcmp(name, built_ins[i].name) == 0) {
            return &built_ins[i];
        }
    }
    return NULL;
}

static bool fail_type(const struct importing *importing, const struct import_item *item,
                      const struct import_value *type)
{
    struct nearest nearest = {.text = type->text};
    char names[BUILT_INS][40], hint[64];

    for (size_t i = 0; i < BUILT_INS; i++) {
        snprintf(names[i], sizeof names[i], "%s/%s", built_ins[i].group, built_ins[i].name);
        nearest_consider(&nearest, names[i]);
    }
    return import_fail(importing, item, type,
                       "\"%.64s\" is no type: expected Primitives/NAME, Operations/NAME or "
                       "Models/NAME%s",
                       type->text, nearest_hint(&nearest, hint, sizeof hint));
}

/* --- its numbers --- */

static bool read_data(const struct importing *importing, const struct import_item *item,
                      const struct import_value *list, double out[IMPORT_DATA_MAX])
{
    size_t count = 0;

    for (const struct import_value *one = list->first; one; one = one->next) {
        if (one->kind != IMPORT_NUMBER) {
            return import_fail(importing, item, one, "data: expected a number");
        }
        if (count == IMPORT_DATA_MAX) {
            return import_fail(importing, item, one, "data: more than %d numbers", IMPORT_DATA_MAX);
        }
        out[count++] = one->number;
    }
    return true;
}

static bool add_built_in_data(const struct importing *importing, const struct import_item *item,
                              const struct built_in *built_in, const struct import_value *list,
                              cJSON *node)
{
    double data[IMPORT_DATA_MAX];
    size_t wanted = 0, used = 0;

    for (int i = 0; i < BUILT_IN_VALUES; i++) {
        wanted += (size_t)built_in->data[i].components;
    }
    if (!read_data(importing, item, list, data)) {
        return false;
    }
    if (list->count < wanted || (wanted == 0 && list->count > 0)) {
        return import_fail(importing, item, list, "data: expected %zu number%s for %s", wanted,
                           wanted == 1 ? "" : "s", built_in->name);
    }
    cJSON *params = wanted ? cJSON_AddObjectToObject(node, "params") : NULL;
    for (int i = 0; i < BUILT_IN_VALUES && built_in->data[i].param; i++) {
        const int count = built_in->data[i].components;

        for (int k = 0; k < count; k++) {
            data[used + (size_t)k] *= built_in->data[i].factor;
        }
        cJSON_AddItemToObject(params, built_in->data[i].param,
                              count == 1 ? cJSON_CreateNumber(data[used])
                                         : cJSON_CreateDoubleArray(data + used, count));
        used += (size_t)count;
    }
    return true;
}

/* Numbers that are not given are 0, as in the buffer of eight that the format speaks of. */
static bool add_custom_data(const struct importing *importing, const struct import_item *item,
                            const struct import_item *primitive, const struct import_value *list,
                            cJSON *params)
{
    double data[IMPORT_DATA_MAX] = {0};

    if (!list) {
        return true;
    }
    if (!read_data(importing, item, list, data)) {
        return false;
    }
    for (int i = 0; i < primitive->numbers; i++) {
        char name[16];

        snprintf(name, sizeof name, "data%d", i);
        cJSON_AddNumberToObject(params, name, data[i]);
    }
    return true;
}

/* --- its transform --- */

static bool add_vector(const struct importing *importing, const struct import_item *item,
                       const struct import_value *transform, const char *name, const char *to,
                       const double signs[3], double fallback, cJSON *json)
{
    static const char *const axes[] = {"x", "y", "z", NULL};
    const struct import_value *vector, *part;
    double v[3];

    if (!import_take(importing, item, transform, name, IMPORT_OBJECT, &vector)) {
        return false;
    }
    if (!vector) {
        return true;
    }
    if (!import_check_members(importing, item, vector, axes)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        if (!import_take(importing, item, vector, axes[i], IMPORT_NUMBER, &part)) {
            return false;
        }
        v[i] = part ? signs[i] * part->number : fallback;
    }
    cJSON_AddItemToObject(json, to, cJSON_CreateDoubleArray(v, 3));
    return true;
}

/* Radians, R = Rz Ry Rx as ours; but the matrices printed for X and Y turn the other way. */
static bool add_transform(const struct importing *importing, const struct import_item *item,
                          const struct import_value *value, cJSON *node)
{
    static const char *const members[] = {"position", "rotation", "scale", NULL};
    static const double plain[3] = {1, 1, 1}, turned[3] = {-1, -1, 1};
    const struct import_value *transform;

    if (!import_take(importing, item, value, "transform", IMPORT_OBJECT, &transform)) {
        return false;
    }
    if (!transform) {
        return true;
    }
    cJSON *json = cJSON_AddObjectToObject(node, "transform");
    return import_check_members(importing, item, transform, members) &&
           add_vector(importing, item, transform, "position", "translation", plain, 0, json) &&
           add_vector(importing, item, transform, "rotation", "rotation", turned, 0, json) &&
           add_vector(importing, item, transform, "scale", "scale", plain, 1, json);
}

static bool add_material(const struct importing *importing, const struct import_item *item,
                         const struct import_value *value, cJSON *node)
{
    const struct import_value *id;

    if (!import_take(importing, item, value, "material_id", IMPORT_NUMBER, &id)) {
        return false;
    }
    if (id && (id->number < 0 || id->number >= (double)item->material_count ||
               id->number != floor(id->number))) {
        return import_fail(importing, item, id, "material_id: %g is none of the %zu `materials`",
                           id->number, item->material_count);
    }
    if (id) {
        cJSON_AddStringToObject(node, "material", item->materials[(size_t)id->number]);
    }
    return true;
}

/* --- nodes --- */

cJSON *import_bare_node(struct importing *importing, const char *type,
                        const struct import_item *item, const struct import_value *value)
{
    cJSON *node = cJSON_CreateObject();
    char id[LIMIT_ID_BYTES + 1];
    size_t index = 0;

    while (strcmp(node_type_at(index)->record.name, type) != 0) {
        index++;
    }
    snprintf(id, sizeof id, "%s-%zu", type, ++importing->numbers[index]);
    import_mark(importing, "nodes", id, item, value);
    cJSON_AddStringToObject(node, "id", id);
    cJSON_AddStringToObject(node, "type", type);
    return node;
}

/* A node with what its type and data make of it. */
static cJSON *typed_node(struct importing *importing, const struct import_item *item,
                         const struct import_value *value)
{
    const struct import_value *type = type_value(importing, item, value), *data;
    const struct built_in *built_in = type ? find_built_in(type->text) : NULL;
    const char *model = type ? name_in(type->text, "Models") : NULL;
    const char *primitive = type ? name_in(type->text, "Primitives") : NULL;
    cJSON *node = NULL;

    if (!type || !import_take(importing, item, value, "data", IMPORT_LIST, &data)) {
        return NULL;
    }
    if (built_in) {
        node = import_bare_node(importing, built_in->type, item, value);
        if (data && !add_built_in_data(importing, item, built_in, data, node)) {
            cJSON_Delete(node);
            return NULL;
        }
    } else if (model || primitive) {
        const struct import_item *named =
            import_find(importing, item, type, model ? IMPORT_MODEL : IMPORT_PRIMITIVE,
                        model ? model : primitive);
        if (!named) {
            return NULL;
        }
        if (model && data && data->count > 0) {
            import_fail(importing, item, data, "data: a model takes no numbers");
            return NULL;
        }
        node = import_bare_node(importing, model ? "model" : "field", item, value);
        cJSON_AddStringToObject(node, "name", *named->name ? named->name : named->stem);
        cJSON *params = cJSON_AddObjectToObject(node, "params");
        cJSON_AddStringToObject(params, model ? "model" : "primitive", named->id);
        if (primitive && !add_custom_data(importing, item, named, data, params)) {
            cJSON_Delete(node);
            return NULL;
        }
    } else {
        fail_type(importing, item, type);
    }
    return node;
}

static bool add_children(struct importing *importing, const struct import_item *item,
                         const struct import_value *value, cJSON *node)
{
    const struct import_value *list;
    cJSON *children;

    if (!import_take(importing, item, value, "children", IMPORT_LIST, &list)) {
        return false;
    }
    children = list && list->count ? cJSON_AddArrayToObject(node, "children") : NULL;
    for (const struct import_value *one = list ? list->first : NULL; one; one = one->next) {
        cJSON *child = import_node(importing, item, one);
        if (!child) {
            return false;
        }
        cJSON_AddItemToArray(children, child);
    }
    return true;
}

cJSON *import_node(struct importing *importing, const struct import_item *item,
                   const struct import_value *value)
{
    cJSON *node = typed_node(importing, item, value);

    if (node && !(import_check_members(importing, item, value, node_members) &&
                  add_transform(importing, item, value, node) &&
                  add_material(importing, item, value, node) &&
                  add_children(importing, item, value, node))) {
        cJSON_Delete(node);
        return NULL;
    }
    return node;
}

/* --- how much data primitives are given --- */

static bool count_below(struct importing *importing, const struct import_item *item,
                        const struct import_value *node)
{
    const struct import_value *type = type_value(importing, item, node);
    const struct import_value *data = import_member(node, "data");
    const struct import_value *children = import_member(node, "children");
    const char *name = type ? name_in(type->text, "Primitives") : NULL;
    bool ok = type != NULL;

    if (name && data && !find_built_in(type->text)) {
        struct import_item *primitive = import_find(importing, item, type, IMPORT_PRIMITIVE, name);

        ok = primitive != NULL;
        if (ok && (int)data->count > primitive->numbers) {
            primitive->numbers = data->count < IMPORT_DATA_MAX ? (int)data->count : IMPORT_DATA_MAX;
        }
    }
    for (const struct import_value *one = children ? children->first : NULL; ok && one;
         one = one->next) {
        ok = count_below(importing, item, one);
    }
    return ok;
}

bool import_count_data(struct importing *importing)
{
    bool ok = true;

    for (size_t i = 0; i < importing->count; i++) {
        struct import_item *item = &importing->items[i];
        const struct import_value *code = import_member(item->value, "code");

        if (item->role == IMPORT_PRIMITIVE && code->kind == IMPORT_TEXT) {
            item->numbers = import_data_read(code->text);
        }
    }
    for (size_t i = 0; ok && i < importing->count; i++) {
        const struct import_item *item = &importing->items[i];
        const struct import_value *tree = import_member(item->value, "model");

        if (item->role == IMPORT_MODEL && tree->kind == IMPORT_OBJECT) {
            ok = count_below(importing, item, tree);
        } else if (item->role == IMPORT_SCENE) {
            tree = import_member(item->value, "scene")->first;
            for (; ok && tree; tree = tree->next) {
                ok = count_below(importing, item, tree);
            }
        }
    }
    return ok;
}
