/* SPDX-License-Identifier: MIT */
/* Trees of models and scenes: {"type": "Primitives/Sphere", "data": [0.5], ...}. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "import_internal.h"

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

const char *import_name_in(const char *type, const char *group)
{
    const size_t length = strlen(group);

    return strncmp(type, group, length) == 0 && type[length] == '/' ? type + length + 1 : NULL;
}

/* --- its numbers --- */

bool import_read_data(const struct importing *importing, const struct import_item *item,
                      const struct import_value *list, size_t most, double *out)
{
    size_t count = 0;

    for (const struct import_value *one = list->first; one; one = one->next) {
        if (one->kind != IMPORT_NUMBER) {
            return import_fail(importing, item, one, "data: expected a number");
        }
        if (count == most) {
            return import_fail(importing, item, one, "data: more than %zu numbers", most);
        }
        out[count++] = one->number;
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
    if (!import_read_data(importing, item, list, IMPORT_DATA_MAX, data)) {
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
    char id[LIMIT_ID_BYTES + 1];
    size_t index = 0;

    if (++importing->nodes > LIMIT_NODES) {
        import_fail_limit(importing, item, value, importing->nodes, "nodes", LIMIT_NODES);
        return NULL;
    }
    while (strcmp(node_type_at(index)->record.name, type) != 0) {
        index++;
    }
    snprintf(id, sizeof id, "%s-%zu", type, ++importing->numbers[index]);
    cJSON *node = cJSON_CreateObject();
    import_mark(importing, "nodes", id, item, value);
    cJSON_AddStringToObject(node, "id", id);
    cJSON_AddStringToObject(node, "type", type);
    return node;
}

static cJSON *built_in_node(struct importing *importing, const struct import_item *item,
                            const struct import_value *value,
                            const struct import_built_in *built_in, const char *name,
                            const struct import_value *data)
{
    cJSON *node = import_bare_node(importing, built_in->type->record.name, item, value);

    if (node && data && !import_add_data(importing, item, built_in, name, data, node)) {
        cJSON_Delete(node);
        return NULL;
    }
    return node;
}

/* A node of what a file has: a model or a primitive. */
static cJSON *named_node(struct importing *importing, const struct import_item *item,
                         const struct import_value *value, const struct import_item *named,
                         const struct import_value *data)
{
    const bool model = named->role == IMPORT_MODEL;
    cJSON *node, *params;

    if (model && data && data->count > 0) {
        import_fail(importing, item, data, "data: a model takes no numbers");
        return NULL;
    }
    node = import_bare_node(importing, model ? "model" : "field", item, value);
    if (!node) {
        return NULL;
    }
    cJSON_AddStringToObject(node, "name", *named->name ? named->name : named->stem);
    params = cJSON_AddObjectToObject(node, "params");
    cJSON_AddStringToObject(params, model ? "model" : "primitive", named->id);
    if (!model && !add_custom_data(importing, item, named, data, params)) {
        cJSON_Delete(node);
        return NULL;
    }
    return node;
}

/* A node with what its type and data make of it. */
static cJSON *typed_node(struct importing *importing, const struct import_item *item,
                         const struct import_value *value)
{
    const struct import_value *type = type_value(importing, item, value), *data;
    const struct import_item *named;
    struct import_built_in built_in;

    if (!type || !import_take(importing, item, value, "data", IMPORT_LIST, &data)) {
        return NULL;
    }
    if (import_find_built_in(importing, type->text, &built_in)) {
        return built_in_node(importing, item, value, &built_in, strchr(type->text, '/') + 1, data);
    }
    const char *model = import_name_in(type->text, "Models");
    const char *primitive = import_name_in(type->text, "Primitives");
    if (!model && !(primitive && import_has(importing, IMPORT_PRIMITIVE, primitive))) {
        import_fail_type(importing, item, type);
        return NULL;
    }
    named = import_find(importing, item, type, model ? IMPORT_MODEL : IMPORT_PRIMITIVE,
                        model ? model : primitive);
    return named ? named_node(importing, item, value, named, data) : NULL;
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
    const char *name = type ? import_name_in(type->text, "Primitives") : NULL;
    struct import_built_in built_in;
    bool ok = type != NULL;

    if (name && data && !import_find_built_in(importing, type->text, &built_in) &&
        import_has(importing, IMPORT_PRIMITIVE, name)) {
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
