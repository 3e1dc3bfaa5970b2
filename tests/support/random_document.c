/* SPDX-License-Identifier: MIT */
/* Random documents. */
#include "random_document.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/edit.h"

const struct random_kind random_kinds[RANDOM_KINDS] = {
    [RANDOM_LIGHTS] = {"lights", offsetof(struct scene, lights), "type", NULL, light_types},
    [RANDOM_VOLUMES] = {"volumes", offsetof(struct scene, volumes), "type", NULL, volume_types},
    [RANDOM_PRIMITIVES] = {"primitives", offsetof(struct scene, primitives), NULL, NULL,
                           &primitive_type},
    [RANDOM_SHADERS] = {"shaders", offsetof(struct scene, shaders), NULL, NULL, &shader_type},
    [RANDOM_MATERIALS] = {"materials", offsetof(struct scene, materials), "shader", "properties",
                          shader_types},
    [RANDOM_MODELS] = {"models", offsetof(struct scene, models), NULL, NULL, NULL},
};

const struct resource_list *random_list(const struct scene *scene, int kind)
{
    return (const struct resource_list *)((const char *)scene + random_kinds[kind].offset);
}

bool random_chance(struct random *random, double probability)
{
    return random_between(random, 0, 1) < probability;
}

/* --- values --- */

static double random_number(struct random *random, const struct param *param)
{
    static const double odd[] = {0.1, 1.0 / 3, 1e-7, 5e-324, 123456.789, 1, 2, 0.30000000000000004};
    double min, max, number;

    param_range(param, &min, &max);
    do {
        const double low = fmax(min, -100), high = fmin(max, 100);
        number = random_chance(random, 0.3) ? odd[random_below(random, sizeof odd / sizeof odd[0])]
                                            : random_between(random, low, high);
        if (param_is_whole(param->type)) {
            number = floor(number);
        }
    } while (number < min || number > max || (param->above_min && number == min) ||
             (param->nonzero && number == 0));
    return number;
}

static cJSON *random_text(struct random *random)
{
    static const char *const texts[] = {"",
                                        "a",
                                        "Schneemann \xe2\x98\x83",
                                        "\"quoted\" \\ back/slash",
                                        "\xf0\x9f\x90\xa7 penguin",
                                        "two words"};

    return cJSON_CreateString(texts[random_below(random, sizeof texts / sizeof texts[0])]);
}

static cJSON *random_part(struct random *random, const struct param *param)
{
    if (param->type == PARAM_BOOL || param->type == PARAM_BVEC3) {
        return cJSON_CreateBool(random_chance(random, 0.5));
    }
    return cJSON_CreateNumber(random_number(random, param));
}

static cJSON *random_points(struct random *random, const struct param *param)
{
    static const struct param number = {.type = PARAM_FLOAT};
    cJSON *list = cJSON_CreateArray();
    const size_t least = (size_t)param->min, most = (size_t)param->max;

    for (size_t i = least + random_below(random, most - least + 1); i > 0; i--) {
        cJSON *pair = cJSON_CreateArray();
        cJSON_AddItemToArray(pair, random_part(random, &number));
        cJSON_AddItemToArray(pair, random_part(random, &number));
        cJSON_AddItemToArray(list, pair);
    }
    return list;
}

/* A row named after `index`; few names and many types, so that edits change the types of names. */
static cJSON *random_row(struct random *random, size_t index)
{
    static const enum param_type types[] = {PARAM_FLOAT, PARAM_INT,  PARAM_BOOL,  PARAM_VEC2,
                                            PARAM_VEC3,  PARAM_VEC4, PARAM_IVEC2, PARAM_IVEC3,
                                            PARAM_IVEC4, PARAM_COLOR};
    struct param param = {.type = types[random_below(random, sizeof types / sizeof types[0])]};
    char name[24];
    cJSON *row = cJSON_CreateObject();

    snprintf(name, sizeof name, "%c%zu", random_below(random, 2) ? 'a' : 'b', index);
    cJSON_AddStringToObject(row, "name", name);
    cJSON_AddStringToObject(row, "type", param_type_name(param.type));
    if (param.type != PARAM_BOOL && param.type != PARAM_COLOR && random_chance(random, 0.4)) {
        const double range[] = {floor(random_between(random, -4, 4)),
                                floor(random_between(random, 5, 9))};
        cJSON_AddItemToObject(row, "range", cJSON_CreateDoubleArray(range, 2));
        param.min = range[0];
        param.max = range[1];
    }
    if (random_chance(random, 0.6)) {
        cJSON_AddItemToObject(row, "default", random_value(random, &param, NULL));
    }
    if (random_chance(random, 0.3)) {
        cJSON_AddItemToObject(row, "doc", random_text(random));
    }
    return row;
}

static cJSON *random_rows(struct random *random)
{
    cJSON *rows = cJSON_CreateArray();

    for (size_t i = random_below(random, 6); i > 0; i--) {
        cJSON_AddItemToArray(rows, random_row(random, i));
    }
    return rows;
}

static cJSON *random_code(struct random *random)
{
    static const char *const texts[] = {"", "float sdf(vec3 p)\n{\n\treturn length(p) - 0.5;\n}\n",
                                        "no code \xe2\x98\x83 \"at all\"\\"};

    return cJSON_CreateString(texts[random_below(random, sizeof texts / sizeof texts[0])]);
}

/* A file that nobody has, or none. */
static cJSON *random_asset(struct random *random)
{
    char digest[DIGEST_DIGITS + 1] = "";

    for (size_t i = 0, count = random_chance(random, 0.7) ? DIGEST_DIGITS : 0; i < count; i++) {
        digest[i] = "0123456789abcdef"[random_below(random, 16)];
    }
    return cJSON_CreateString(digest);
}

/* One of the list, or "". */
static cJSON *random_name(struct random *random, const struct scene *scene, int kind)
{
    static const struct resource_list none = {0};
    const struct resource_list *list = scene ? random_list(scene, kind) : &none;
    const size_t index = random_below(random, list->count + 1);

    return cJSON_CreateString(index < list->count ? list->items[index]->name : "");
}

static cJSON *random_numbers_of(struct random *random, const struct param *param)
{
    cJSON *array = cJSON_CreateArray();

    for (int i = 0; i < param_components(param->type); i++) {
        cJSON_AddItemToArray(array, random_part(random, param));
    }
    if (param->direction) {
        cJSON_SetNumberValue(array->child, 1); /* never 0, 0, 0 */
    }
    return array;
}

cJSON *random_value(struct random *random, const struct param *param, const struct scene *scene)
{
    size_t count = 0;

    switch (param->type) {
    case PARAM_TEXT:
        return random_text(random);
    case PARAM_CODE:
        return random_code(random);
    case PARAM_EQUATION:
        return cJSON_CreateString(random_chance(random, 0.5) ? "x^2 + y^2 = z + a" : "");
    case PARAM_SURFACE:
        return cJSON_Parse(
            random_chance(random, 0.5)
                ? "{\"x\":\"s*t\",\"y\":\"s\",\"z\":\"t^2\",\"s\":[-1,1],\"t\":[0,2.5]}"
                : "{}");
    case PARAM_ROWS:
        return random_rows(random);
    case PARAM_POINTS:
        return random_points(random, param);
    case PARAM_MODEL:
        return random_name(random, scene, RANDOM_MODELS);
    case PARAM_FUNCTION:
        return random_name(random, scene, RANDOM_PRIMITIVES);
    case PARAM_MATERIAL:
        return random_name(random, scene, RANDOM_MATERIALS);
    case PARAM_ASSET:
        return random_asset(random);
    case PARAM_ENUM:
        while (param->choices[count]) {
            count++;
        }
        return cJSON_CreateString(param->choices[random_below(random, count)]);
    default:
        return param_components(param->type) == 1 || (param->uniform && random_chance(random, 0.3))
                   ? random_part(random, param)
                   : random_numbers_of(random, param);
    }
}

static void add_values(struct random *random, cJSON *object, const struct record_type *type,
                       const struct scene *scene)
{
    const double likely = random_chance(random, 0.5) ? 0.2 : 0.8;

    for (const struct param *param = type->params; param->name; param++) {
        if (random_chance(random, likely) &&
            !cJSON_GetObjectItemCaseSensitive(object, param->name)) {
            cJSON_AddItemToObject(object, param->name, random_value(random, param, scene));
        }
    }
}

cJSON *random_record(struct random *random, const struct record_type *type,
                     const struct scene *scene)
{
    cJSON *object = cJSON_CreateObject();

    add_values(random, object, type, scene);
    return object;
}

/* --- trees --- */

/* What names something is more likely than by its one row. */
static const struct node_type *random_node_type(struct random *random)
{
    return random_chance(random, 0.2)   ? node_type_find("field")
           : random_chance(random, 0.2) ? node_type_find("model")
                                        : node_type_at(random_below(random, node_type_count()));
}

static cJSON *random_params(struct random *random, const struct node_type *type,
                            const struct scene *scene)
{
    const struct resource_list *primitives = &scene->primitives;
    const struct record_type *params = &type->record;
    cJSON *object = cJSON_CreateObject();
    const size_t index = random_below(random, primitives->count + 1);

    if (type->kind == KIND_CODE) {
        const bool named = index < primitives->count;
        params = named ? &primitives->items[index]->declared->type : params;
        cJSON_AddStringToObject(object, "primitive", named ? params->name : "");
    }
    add_values(random, object, params, scene);
    return object;
}

cJSON *random_tree(struct random *random, size_t nodes, const struct scene *scene)
{
    const struct node_type *type = random_node_type(random);
    cJSON *node = cJSON_CreateObject();

    cJSON_AddStringToObject(node, "type", type->record.name);
    add_values(random, node, &node_common_type, scene);
    cJSON_AddItemToObject(node, "transform", random_record(random, &transform_type, scene));
    cJSON_AddItemToObject(node, "params", random_params(random, type, scene));
    cJSON *children = cJSON_AddArrayToObject(node, "children");
    for (nodes--; nodes > 0;) {
        const size_t share = 1 + random_below(random, nodes);
        cJSON_AddItemToArray(children, random_tree(random, share, scene));
        nodes -= share;
    }
    return node;
}

/* --- parameters of models --- */

static const struct node *random_node_below(struct random *random, const struct node *top)
{
    const struct node *node = top;

    while (node->child_count > 0 && random_chance(random, 0.7)) {
        node = node->children[random_below(random, node->child_count)];
    }
    return node;
}

/* Within what the row takes. */
static cJSON *random_range(struct random *random, const struct param *param)
{
    double least, most;

    param_range(param, &least, &most);
    const bool beside_0 = param->above_min || param->nonzero || param->direction;
    const double whole = param_is_whole(param->type) ? 1 : 0.25;
    double low = fmax(least, -2), high;
    low = beside_0 && least >= -2 ? least + whole : beside_0 ? whole : low;
    high = fmin(most, low + whole * (1 + (double)random_below(random, 8)));
    const double range[] = {low, high};
    return cJSON_CreateDoubleArray(range, 2);
}

/* NULL: nothing that could be a parameter was hit upon. */
static cJSON *random_model_row(struct random *random, const struct resource *model, size_t index)
{
    const struct node *node = random_node_below(random, model->root);
    const bool moved = random_chance(random, 0.3);
    const struct record_type *type = moved ? &transform_type : node->params.type;
    const size_t count = record_type_count(type);
    const struct param *param = count ? &type->params[random_below(random, count)] : NULL;
    const int components = param && param->type != PARAM_ENUM ? param_components(param->type) : 0;

    if (components == 0) {
        return NULL;
    }
    const bool part = components > 1 && (param->type == PARAM_BVEC3 || random_chance(random, 0.5));
    const bool flag = param->type == PARAM_BOOL || param->type == PARAM_BVEC3;
    const char *part_type = flag ? "bool" : param_is_whole(param->type) ? "int" : "float";
    char name[24], sets[200];
    cJSON *row = cJSON_CreateObject();
    snprintf(name, sizeof name, "%c%zu", random_below(random, 2) ? 'a' : 'b', index);
    snprintf(sets, sizeof sets, "/nodes/%s/%s/%s%s%c", node->id, moved ? "transform" : "params",
             param->name, part ? "." : "",
             part ? "xyzw"[random_below(random, (size_t)components)] : '\0');
    cJSON_AddStringToObject(row, "name", name);
    cJSON_AddStringToObject(row, "type",
                            part ? part_type
                            : param->uniform && random_chance(random, 0.5)
                                ? "float"
                                : param_type_name(param->type));
    cJSON_AddStringToObject(row, "sets", sets);
    if (!flag && (part || param->type != PARAM_COLOR)) {
        cJSON_AddItemToObject(row, "range", random_range(random, param));
    }
    return row;
}

cJSON *random_model_rows(struct random *random, const struct resource *model)
{
    cJSON *rows = cJSON_CreateArray();

    for (size_t i = random_below(random, 6); i > 0; i--) {
        cJSON *row = random_model_row(random, model, i);
        if (row) {
            cJSON_AddItemToArray(rows, row);
        }
    }
    return rows;
}

/* --- resources and documents --- */

const char *random_type_name(struct random *random, int kind, const struct scene *scene)
{
    const struct record_type *table = random_kinds[kind].table;
    const struct resource_list *shaders = &scene->shaders;
    size_t count = 0, more = kind == RANDOM_MATERIALS ? shaders->count : 0;

    while (table[count].name) {
        count++;
    }
    size_t index = random_below(random, count + 3 * more);
    if (index >= count) {
        index = count + (index - count) % more;
    }
    return index < count ? table[index].name : shaders->items[index - count]->name;
}

cJSON *random_resource(struct random *random, int kind, const struct scene *scene)
{
    const struct random_kind *row = &random_kinds[kind];
    const struct record_type *type = row->table;

    if (!type) {
        return random_tree(random, 1 + random_below(random, 4), scene);
    }
    cJSON *json = cJSON_CreateObject(), *values = json;
    if (row->type) {
        const char *name = random_type_name(random, kind, scene);
        const struct resource *shader = resource_find(&scene->shaders, name);
        type = record_type_in(row->table, name);
        type = type ? type : &shader->declared->type;
        cJSON_AddStringToObject(json, row->type, name);
    }
    if (row->values) {
        values = cJSON_AddObjectToObject(json, row->values);
    }
    add_values(random, values, type, scene);
    return json;
}

static struct scene *read_again(struct scene *scene, const cJSON *document)
{
    struct error err = {0};

    scene_destroy(scene);
    scene = scene_read(document, &err);
    if (!scene) {
        error_print(&err, stderr);
        abort();
    }
    return scene;
}

/* Takes the value; it may be refused. */
static void set_value(struct scene *scene, const char *list, const char *name, const char *rest,
                      cJSON *value)
{
    cJSON *ops = cJSON_CreateArray(), *op = cJSON_CreateObject();
    char at[200];

    snprintf(at, sizeof at, "/%s/%s/params%s%s", list, name, *rest ? "/" : "", rest);
    cJSON_AddStringToObject(op, "op", "set");
    cJSON_AddStringToObject(op, "at", at);
    cJSON_AddItemToObject(op, "value", value);
    cJSON_AddItemToArray(ops, op);
    edit_apply(scene, ops, NULL, NULL, NULL);
    cJSON_Delete(ops);
}

static void set_own_numbers(struct random *random, struct scene *scene, const struct node *top)
{
    for (const struct node *node = top; node; node = node_next(node, top)) {
        const struct resource *model = node_model(scene, node);
        const struct param *rows = node->params.type->params;
        for (size_t i = model ? model->declared->first_declared : 0; model && rows[i].name; i++) {
            if (random_chance(random, 0.6)) {
                set_value(scene, "nodes", node->id, rows[i].name,
                          random_value(random, &rows[i], scene));
            }
        }
    }
}

static void add_model_params(struct random *random, struct scene *scene)
{
    for (size_t i = 0; i < scene->models.count; i++) {
        const struct resource *model = scene->models.items[i];
        set_value(scene, "models", model->name, "", random_model_rows(random, model));
    }
    for (size_t i = 0; i < scene->models.count; i++) {
        set_own_numbers(random, scene, scene->models.items[i]->root);
    }
    set_own_numbers(random, scene, scene->root);
}

/* The document is read again after each part, so that the next may name what is in it. */
struct scene *random_document(struct random *random, size_t nodes)
{
    static const char *const names[] = {"a", "b", "c"};
    const struct record_type *const records[] = {&camera_type, &environment_type, &render_type};
    struct scene *scene = scene_create_empty();
    cJSON *document = scene_to_json(scene);

    cJSON_AddItemToObject(document, "name", random_text(random));
    for (size_t i = 0; i < sizeof records / sizeof records[0]; i++) {
        cJSON_AddItemToObject(document, records[i]->name, random_record(random, records[i], scene));
    }
    for (int kind = 0; kind < RANDOM_KINDS; kind++) {
        const bool array = kind == RANDOM_LIGHTS || kind == RANDOM_VOLUMES;
        cJSON *list = array ? cJSON_CreateArray() : cJSON_CreateObject();
        cJSON_AddItemToObject(document, random_kinds[kind].list, list);
        for (size_t i = 0, count = random_below(random, 4); i < count; i++) {
            cJSON *item = random_resource(random, kind, scene);
            if (array) {
                cJSON_AddItemToArray(list, item);
            } else {
                cJSON_AddItemToObject(list, names[i], item);
            }
            scene = read_again(scene, document);
        }
    }
    cJSON_ReplaceItemInObjectCaseSensitive(document, "root", random_tree(random, nodes, scene));
    scene = read_again(scene, document);
    cJSON_Delete(document);
    if (random_chance(random, 0.5)) {
        add_model_params(random, scene);
    }
    return scene;
}
