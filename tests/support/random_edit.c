/* SPDX-License-Identifier: MIT */
/* Random documents and edits. */
#include "random_edit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool chance(struct random *random, double probability)
{
    return random_between(random, 0, 1) < probability;
}

static double random_number(struct random *random, const struct param *param)
{
    static const double odd[] = {0.1, 1.0 / 3, 1e-7, 5e-324, 123456.789, 1, 2, 0.30000000000000004};
    double min, max, number;
    param_range(param, &min, &max);
    do {
        double low = fmax(min, -100), high = fmin(max, 100);
        number = chance(random, 0.3) ? odd[random_below(random, sizeof odd / sizeof odd[0])]
                                     : random_between(random, low, high);
        if (param->type == PARAM_INT || param->type == PARAM_IVEC3) {
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
        return cJSON_CreateBool(chance(random, 0.5));
    }
    return cJSON_CreateNumber(random_number(random, param));
}

static cJSON *random_points(struct random *random, const struct param *param)
{
    static const struct param number = {.type = PARAM_FLOAT};
    cJSON *list = cJSON_CreateArray();
    size_t least = (size_t)param->min, most = (size_t)param->max;
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
    static const enum param_type types[] = {PARAM_FLOAT, PARAM_INT,  PARAM_BOOL, PARAM_VEC2,
                                            PARAM_VEC3,  PARAM_VEC4, PARAM_COLOR};
    struct param param = {.type = types[random_below(random, sizeof types / sizeof types[0])]};
    char name[24];
    cJSON *row = cJSON_CreateObject();
    snprintf(name, sizeof name, "%c%zu", random_below(random, 2) ? 'a' : 'b', index);
    cJSON_AddStringToObject(row, "name", name);
    cJSON_AddStringToObject(row, "type", param_type_name(param.type));
    if (param.type != PARAM_BOOL && param.type != PARAM_COLOR && chance(random, 0.4)) {
        const double range[] = {floor(random_between(random, -4, 4)),
                                floor(random_between(random, 5, 9))};
        cJSON_AddItemToObject(row, "range", cJSON_CreateDoubleArray(range, 2));
        param.min = range[0];
        param.max = range[1];
    }
    if (chance(random, 0.6)) {
        cJSON_AddItemToObject(row, "default", random_value(random, &param, NULL));
    }
    if (chance(random, 0.3)) {
        cJSON_AddItemToObject(row, "doc", random_text(random));
    }
    return row;
}

static cJSON *random_rows(struct random *random)
{
    cJSON *rows = cJSON_CreateArray();
    for (size_t i = random_below(random, 5); i > 0; i--) {
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

cJSON *random_value(struct random *random, const struct param *param,
                    const struct resource_list *materials)
{
    size_t count = 0;
    switch (param->type) {
    case PARAM_TEXT:
        return random_text(random);
    case PARAM_CODE:
        return random_code(random);
    case PARAM_ROWS:
        return random_rows(random);
    case PARAM_POINTS:
        return random_points(random, param);
    case PARAM_MODEL:
    case PARAM_FUNCTION:
        return cJSON_CreateString("");
    case PARAM_MATERIAL:
        count = random_below(random, materials->count + 1);
        return cJSON_CreateString(count < materials->count ? materials->items[count]->name : "");
    case PARAM_ENUM:
        while (param->choices[count]) {
            count++;
        }
        return cJSON_CreateString(param->choices[random_below(random, count)]);
    default:
        break;
    }
    if (param_components(param->type) == 1 || (param->uniform && chance(random, 0.3))) {
        return random_part(random, param);
    }
    cJSON *array = cJSON_CreateArray();
    for (int i = 0; i < param_components(param->type); i++) {
        cJSON_AddItemToArray(array, random_part(random, param));
    }
    if (param->direction) {
        cJSON_SetNumberValue(array->child, 1); /* never 0, 0, 0 */
    }
    return array;
}

static void add_values(struct random *random, cJSON *object, const struct record_type *type,
                       const struct resource_list *materials)
{
    for (const struct param *param = type->params; param->name; param++) {
        if (chance(random, 0.3)) {
            cJSON_AddItemToObject(object, param->name, random_value(random, param, materials));
        }
    }
}

static cJSON *random_record(struct random *random, const struct record_type *type,
                            const struct resource_list *materials)
{
    cJSON *object = cJSON_CreateObject();
    add_values(random, object, type, materials);
    return object;
}

static cJSON *random_light(struct random *random)
{
    const struct record_type *type = &light_types[random_below(random, 2)];
    cJSON *light = cJSON_CreateObject();
    cJSON_AddStringToObject(light, "type", type->name);
    add_values(random, light, type, NULL);
    return light;
}

static cJSON *random_material(struct random *random)
{
    cJSON *material = cJSON_CreateObject();
    cJSON_AddStringToObject(material, "shader", shader_types[0].name);
    cJSON_AddItemToObject(material, "properties", random_record(random, &shader_types[0], NULL));
    return material;
}

/* A subtree of 1 to `nodes` nodes without ids. */
static cJSON *random_tree(struct random *random, size_t nodes,
                          const struct resource_list *materials)
{
    const struct node_type *type = node_type_at(random_below(random, node_type_count()));
    cJSON *node = cJSON_CreateObject();
    cJSON_AddStringToObject(node, "type", type->record.name);
    add_values(random, node, &node_common_type, materials);
    cJSON_AddItemToObject(node, "transform", random_record(random, &transform_type, NULL));
    cJSON_AddItemToObject(node, "params", random_record(random, &type->record, NULL));
    cJSON *children = cJSON_AddArrayToObject(node, "children");
    for (nodes--; nodes > 0;) {
        size_t share = 1 + random_below(random, nodes);
        cJSON_AddItemToArray(children, random_tree(random, share, materials));
        nodes -= share;
    }
    return node;
}

struct scene *random_document(struct random *random, size_t nodes)
{
    struct scene *scene = scene_create_empty();
    const struct record_type *const records[] = {&camera_type, &environment_type, &render_type};
    cJSON *document = scene_to_json(scene);
    cJSON *lights = cJSON_AddArrayToObject(document, "lights");
    cJSON *materials = cJSON_AddObjectToObject(document, "materials");
    struct resource names[3];
    struct resource *items[3] = {&names[0], &names[1], &names[2]};
    const struct resource_list list = {.items = items, .count = 3};
    for (size_t i = 0; i < 3; i++) {
        static const char *const colors[] = {"red", "green", "blue"};
        names[i].name = (char *)colors[i];
        cJSON_AddItemToObject(materials, colors[i], random_material(random));
    }
    for (size_t i = random_below(random, 4); i > 0; i--) {
        cJSON_AddItemToArray(lights, random_light(random));
    }
    for (size_t i = 0; i < sizeof records / sizeof records[0]; i++) {
        cJSON_AddItemToObject(document, records[i]->name, random_record(random, records[i], NULL));
    }
    cJSON_AddItemToObject(document, "name", random_text(random));
    cJSON_ReplaceItemInObjectCaseSensitive(document, "root", random_tree(random, nodes, &list));
    scene_destroy(scene);
    struct error err = {0};
    scene = scene_read(document, &err);
    if (!scene) {
        error_print(&err, stderr);
        abort();
    }
    cJSON_Delete(document);
    return scene;
}

/* --- edits --- */

struct pick {
    size_t index;
    const struct node *node;
};

static void pick_node(void *data, const struct node *node, size_t index)
{
    struct pick *pick = data;
    if (index == pick->index) {
        pick->node = node;
    }
}

static const struct node *random_node_of(struct random *random, const struct scene *scene)
{
    struct pick pick = {.index = random_below(random, scene->node_count)};
    scene_walk(scene, pick_node, &pick);
    return pick.node;
}

/* Mostly good, at times null, at times of another row, so that it is often refused. */
static cJSON *any_value(struct random *random, const struct param *param,
                        const struct resource_list *materials)
{
    if (chance(random, 0.1)) {
        return cJSON_CreateNull();
    }
    if (chance(random, 0.05)) {
        return cJSON_CreateNumber(-1e7);
    }
    return random_value(random, param, materials);
}

static const struct param *random_param(struct random *random, const struct record_type *type)
{
    size_t count = record_type_count(type);
    return count ? &type->params[random_below(random, count)] : NULL;
}

static cJSON *begin(const char *name, const char *member, const char *place)
{
    cJSON *op = cJSON_CreateObject();
    cJSON_AddStringToObject(op, "op", name);
    cJSON_AddStringToObject(op, member, place);
    return op;
}

static cJSON *set_in(struct random *random, const struct scene *scene, const char *prefix,
                     const struct record_type *type)
{
    const struct param *param = random_param(random, type);
    char at[200];
    snprintf(at, sizeof at, "%s/%s", prefix, param ? param->name : "nothing");
    cJSON *op = begin("set", "at", at);
    cJSON_AddItemToObject(
        op, "value", param ? any_value(random, param, &scene->materials) : cJSON_CreateNumber(1));
    return op;
}

static cJSON *set_type(struct random *random, const struct node *node)
{
    char at[200];
    snprintf(at, sizeof at, "/nodes/%s/type", node->id);
    cJSON *op = begin("set", "at", at);
    cJSON_AddStringToObject(op, "value",
                            node_type_at(random_below(random, node_type_count()))->record.name);
    return op;
}

static cJSON *set_whole(struct random *random, const char *at, const struct record_type *type)
{
    cJSON *op = begin("set", "at", at);
    cJSON_AddItemToObject(
        op, "value", chance(random, 0.1) ? cJSON_CreateNull() : random_record(random, type, NULL));
    return op;
}

static cJSON *random_set(struct random *random, const struct scene *scene)
{
    const struct record_type *const records[] = {&camera_type, &environment_type, &render_type};
    const struct record_type *record = records[random_below(random, 3)];
    const struct node *node = random_node_of(random, scene);
    const struct resource_list *lights = &scene->lights, *materials = &scene->materials;
    char place[160];
    switch (random_below(random, 9)) {
    case 0:
        return set_in(random, scene, "", &scene_info_type);
    case 1:
        snprintf(place, sizeof place, "/%s", record->name);
        return chance(random, 0.3) ? set_whole(random, place, record)
                                   : set_in(random, scene, place, record);
    case 2:
        snprintf(place, sizeof place, "/nodes/%s", node->id);
        return set_in(random, scene, place, &node_common_type);
    case 3:
        snprintf(place, sizeof place, "/nodes/%s/transform", node->id);
        return chance(random, 0.3) ? set_whole(random, place, &transform_type)
                                   : set_in(random, scene, place, &transform_type);
    case 4:
        return set_type(random, node);
    case 5:
        if (lights->count > 0) {
            const struct resource *light = lights->items[random_below(random, lights->count)];
            snprintf(place, sizeof place, "/lights/%s", light->name);
            if (chance(random, 0.3)) {
                strcat(place, "/type");
                cJSON *op = begin("set", "at", place);
                cJSON_AddStringToObject(op, "value", light_types[random_below(random, 2)].name);
                return op;
            }
            return set_in(random, scene, place, light->record.type);
        }
        break;
    case 6:
        if (materials->count > 0) {
            size_t index = random_below(random, materials->count);
            snprintf(place, sizeof place, "/materials/%s/properties",
                     materials->items[index]->name);
            return set_in(random, scene, place, materials->items[index]->record.type);
        }
        break;
    default:
        break;
    }
    snprintf(place, sizeof place, "/nodes/%s/params", node->id);
    return set_in(random, scene, place, &node->params.type[0]);
}

static void add_before(struct random *random, cJSON *op, const char *name)
{
    if (chance(random, 0.1)) {
        name = "nobody";
    }
    cJSON_AddItemToObject(op, "before", name ? cJSON_CreateString(name) : cJSON_CreateNull());
}

static const char *some_child(struct random *random, const struct node *node)
{
    size_t index = random_below(random, node->child_count + 1);
    return index < node->child_count ? node->children[index]->id : NULL;
}

static const char *some_name(struct random *random, const struct resource_list *list)
{
    size_t index = random_below(random, list->count + 1);
    return index < list->count ? list->items[index]->name : NULL;
}

static cJSON *random_insert(struct random *random, const struct scene *scene)
{
    const struct node *parent = random_node_of(random, scene);
    char into[100];
    cJSON *op;
    switch (random_below(random, 4)) {
    case 0:
        op = begin("insert", "into", "/lights");
        add_before(random, op, some_name(random, &scene->lights));
        cJSON_AddItemToObject(op, "value", random_light(random));
        return op;
    case 1:
        op = begin("insert", "into", "/materials");
        add_before(random, op, some_name(random, &scene->materials));
        snprintf(into, sizeof into, "m%zu", random_below(random, 12));
        cJSON_AddStringToObject(op, "name", into);
        cJSON_AddItemToObject(op, "value", random_material(random));
        return op;
    default:
        snprintf(into, sizeof into, "/nodes/%s", parent->id);
        op = begin("insert", "into", into);
        add_before(random, op, some_child(random, parent));
        cJSON_AddItemToObject(op, "value",
                              random_tree(random, 1 + random_below(random, 4), &scene->materials));
        return op;
    }
}

/* A thing that can be removed or moved; NULL for a list where none is. */
static const char *random_thing(struct random *random, const struct scene *scene, char place[100],
                                const char **out_home)
{
    const struct resource_list *const lists[] = {&scene->lights, &scene->materials};
    size_t list = random_below(random, 5);
    *out_home = list == 0 ? "/lights" : list == 1 ? "/materials" : NULL;
    const char *name =
        list < 2 ? some_name(random, lists[list]) : random_node_of(random, scene)->id;
    snprintf(place, 100, "%s/%s", *out_home ? *out_home : "/nodes", name ? name : "nobody");
    return name;
}

static cJSON *random_move(struct random *random, const struct scene *scene)
{
    char place[100], into[100];
    const char *home;
    random_thing(random, scene, place, &home);
    cJSON *op = begin("move", "at", place);
    if (home) {
        cJSON_AddStringToObject(op, "into", home);
        add_before(
            random, op,
            some_name(random, strcmp(home, "/lights") == 0 ? &scene->lights : &scene->materials));
    } else {
        const struct node *parent = random_node_of(random, scene);
        snprintf(into, sizeof into, "/nodes/%s", parent->id);
        cJSON_AddStringToObject(op, "into", into);
        add_before(random, op, some_child(random, parent));
    }
    return op;
}

static cJSON *random_operation(struct random *random, const struct scene *scene)
{
    char place[100];
    const char *home;
    switch (random_below(random, 8)) {
    case 0:
        return random_insert(random, scene);
    case 1:
        random_thing(random, scene, place, &home);
        return begin("remove", "at", place);
    case 2:
        return random_move(random, scene);
    default:
        return random_set(random, scene);
    }
}

cJSON *random_edit(struct random *random, const struct scene *scene)
{
    cJSON *ops = cJSON_CreateArray();
    for (size_t i = 1 + random_below(random, 4); i > 0; i--) {
        cJSON_AddItemToArray(ops, random_operation(random, scene));
    }
    return ops;
}

void random_damage(struct random *random, char *text, size_t length)
{
    static const char likely[] = "{}[],:\"/0123456789-+.eEtfnul\\ax_ ";
    for (size_t i = 1 + random_below(random, 4); i > 0; i--) {
        size_t from = random_below(random, length), to = random_below(random, length);
        text[to] = chance(random, 0.4)   ? text[from]
                   : chance(random, 0.9) ? likely[random_below(random, sizeof likely - 1)]
                                         : (char)random_below(random, 256);
    }
}
