/* SPDX-License-Identifier: MIT */
/* Random edits. */
#include "random_edit.h"

#include <string.h>

/* A node of any tree. */
static const struct node *random_node_of(struct random *random, const struct scene *scene)
{
    size_t index = random_below(random, scene->node_count);

    for (size_t tree = 0; tree <= scene->models.count; tree++) {
        const struct node *top =
            tree < scene->models.count ? scene->models.items[tree]->root : scene->root;
        for (const struct node *node = top; node; node = node_next(node, top)) {
            if (index-- == 0) {
                return node;
            }
        }
    }
    return NULL;
}

/* More often than by chance one that names a primitive or model. */
static const struct node *random_node_to_set(struct random *random, const struct scene *scene)
{
    const struct node *node = random_node_of(random, scene);

    for (int i = 0; i < 4 && node->type->kind != KIND_CODE && node->type->kind != KIND_MODEL; i++) {
        node = random_node_of(random, scene);
    }
    return node;
}

/* Mostly good, at times null, at times of another row, so that it is often refused. */
static cJSON *any_value(struct random *random, const struct param *param, const struct scene *scene)
{
    if (random_chance(random, 0.1)) {
        return cJSON_CreateNull();
    }
    if (random_chance(random, 0.05)) {
        return cJSON_CreateNumber(-1e7);
    }
    return random_value(random, param, scene);
}

static cJSON *begin(const char *name, const char *member, const char *place)
{
    cJSON *op = cJSON_CreateObject();

    cJSON_AddStringToObject(op, "op", name);
    cJSON_AddStringToObject(op, member, place);
    return op;
}

/* Sets PREFIX/NAME, or only PREFIX where `name` is NULL. */
static cJSON *set(const char *prefix, const char *name, cJSON *value)
{
    char at[200];

    snprintf(at, sizeof at, "%s%s%s", prefix, name ? "/" : "", name ? name : "");
    cJSON *op = begin("set", "at", at);
    cJSON_AddItemToObject(op, "value", value);
    return op;
}

static cJSON *set_in(struct random *random, const struct scene *scene, const char *prefix,
                     const struct record_type *type)
{
    const size_t count = record_type_count(type);

    if (count == 0) {
        return set(prefix, "nothing", cJSON_CreateNumber(1));
    }
    const struct param *param = &type->params[random_below(random, count)];
    return set(prefix, param->name, any_value(random, param, scene));
}

static cJSON *set_whole(struct random *random, const struct scene *scene, const char *at,
                        const struct record_type *type)
{
    return set(at, NULL,
               random_chance(random, 0.1) ? cJSON_CreateNull()
                                          : random_record(random, type, scene));
}

static cJSON *set_in_node(struct random *random, const struct scene *scene)
{
    static const char *const types[] = {"field", "model", "sphere"};
    const struct node *node = random_node_to_set(random, scene);
    char place[160];
    const size_t choice = random_below(random, 6),
                 type = random_below(random, 2 * node_type_count());

    snprintf(place, sizeof place, "/nodes/%s%s", node->id,
             choice == 0   ? "/transform"
             : choice <= 3 ? "/params"
                           : "");
    switch (choice) {
    case 0:
        return random_chance(random, 0.3) ? set_whole(random, scene, place, &transform_type)
                                          : set_in(random, scene, place, &transform_type);
    case 4:
        return set_in(random, scene, place, &node_common_type);
    case 5:
        return set(place, "type",
                   cJSON_CreateString(type < node_type_count() ? node_type_at(type)->record.name
                                                               : types[type % 3]));
    default:
        return choice == 1 && node->type->kind == KIND_CODE
                   ? set(place, "primitive", any_value(random, node->params.type->params, scene))
                   : set_in(random, scene, place, node->params.type);
    }
}

static cJSON *set_in_resource(struct random *random, const struct scene *scene)
{
    const int kind = (int)random_below(random, RANDOM_KINDS);
    const struct random_kind *row = &random_kinds[kind];
    const struct resource_list *list = random_list(scene, kind);

    if (list->count == 0) {
        return set_in_node(random, scene);
    }
    const struct resource *resource = list->items[random_below(random, list->count)];
    char place[160];
    const int used = snprintf(place, sizeof place, "/%s/%s", row->list, resource->name);
    if (row->type && random_chance(random, 0.3)) {
        return set(place, row->type, cJSON_CreateString(random_type_name(random, kind, scene)));
    }
    if (resource->root) {
        return set(place, "params", random_model_rows(random, resource));
    }
    if (!row->type && row->table && random_chance(random, 0.3)) { /* what it declares */
        const struct param *rows = row->table->params;
        while (rows->type != PARAM_ROWS) {
            rows++;
        }
        return set(place, rows->name, any_value(random, rows, scene));
    }
    if (row->values) {
        snprintf(place + used, sizeof place - (size_t)used, "/%s", row->values);
    }
    return set_in(random, scene, place, resource->record.type);
}

static cJSON *random_set(struct random *random, const struct scene *scene)
{
    const struct record_type *const records[] = {&camera_type, &environment_type, &render_type};
    const struct record_type *record = records[random_below(random, 3)];
    char place[40];

    switch (random_below(random, 8)) {
    case 0:
        return set_in(random, scene, "", &scene_info_type);
    case 1:
        snprintf(place, sizeof place, "/%s", record->name);
        return random_chance(random, 0.3) ? set_whole(random, scene, place, record)
                                          : set_in(random, scene, place, record);
    case 2:
    case 3:
    case 4:
        return set_in_resource(random, scene);
    default:
        return set_in_node(random, scene);
    }
}

static void add_before(struct random *random, cJSON *op, const char *name)
{
    if (random_chance(random, 0.1)) {
        name = "nobody";
    }
    cJSON_AddItemToObject(op, "before", name ? cJSON_CreateString(name) : cJSON_CreateNull());
}

static const char *some_child(struct random *random, const struct node *node)
{
    const size_t index = random_below(random, node->child_count + 1);

    return index < node->child_count ? node->children[index]->id : NULL;
}

static const char *some_name(struct random *random, const struct resource_list *list)
{
    const size_t index = random_below(random, list->count + 1);

    return index < list->count ? list->items[index]->name : NULL;
}

static cJSON *random_insert(struct random *random, const struct scene *scene)
{
    char text[100];
    cJSON *op;

    if (random_chance(random, 0.5)) {
        const int kind = (int)random_below(random, RANDOM_KINDS);
        snprintf(text, sizeof text, "/%s", random_kinds[kind].list);
        op = begin("insert", "into", text);
        add_before(random, op, some_name(random, random_list(scene, kind)));
        snprintf(text, sizeof text, "%c", 'a' + (char)random_below(random, 8));
        cJSON_AddStringToObject(op, "name", text);
        cJSON_AddItemToObject(op, "value", random_resource(random, kind, scene));
        return op;
    }
    const struct node *parent = random_node_of(random, scene);
    snprintf(text, sizeof text, "/nodes/%s", parent->id);
    op = begin("insert", "into", text);
    add_before(random, op, some_child(random, parent));
    cJSON_AddItemToObject(op, "value", random_tree(random, 1 + random_below(random, 4), scene));
    return op;
}

/* The place of something to be removed or moved, at times of nobody. Returns its kind, -1: a
 * node. */
static int random_thing(struct random *random, const struct scene *scene, char place[100])
{
    const int kind = (int)random_below(random, 2 * RANDOM_KINDS);

    if (kind >= RANDOM_KINDS) {
        snprintf(place, 100, "/nodes/%s", random_node_of(random, scene)->id);
        return -1;
    }
    const char *name = some_name(random, random_list(scene, kind));
    snprintf(place, 100, "/%s/%s", random_kinds[kind].list, name ? name : "nobody");
    return kind;
}

static cJSON *random_move(struct random *random, const struct scene *scene)
{
    char place[100], into[100];
    const int kind = random_thing(random, scene, place);
    const struct node *parent = random_node_of(random, scene);
    cJSON *op = begin("move", "at", place);

    if (kind >= 0) {
        snprintf(into, sizeof into, "/%s", random_kinds[kind].list);
    } else {
        snprintf(into, sizeof into, "/nodes/%s", parent->id);
    }
    cJSON_AddStringToObject(op, "into", into);
    add_before(random, op,
               kind >= 0 ? some_name(random, random_list(scene, kind))
                         : some_child(random, parent));
    return op;
}

static cJSON *random_operation(struct random *random, const struct scene *scene)
{
    char place[100];

    switch (random_below(random, 8)) {
    case 0:
        return random_insert(random, scene);
    case 1:
        random_thing(random, scene, place);
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

    for (size_t i = random_chance(random, 0.5) ? 1 : 2 + random_below(random, 3); i > 0; i--) {
        cJSON_AddItemToArray(ops, random_operation(random, scene));
    }
    return ops;
}

void random_damage(struct random *random, char *text, size_t length)
{
    static const char likely[] = "{}[],:\"/0123456789-+.eEtfnul\\ax_ ";

    for (size_t i = 1 + random_below(random, 4); i > 0; i--) {
        const size_t from = random_below(random, length), to = random_below(random, length);
        text[to] = random_chance(random, 0.4)   ? text[from]
                   : random_chance(random, 0.9) ? likely[random_below(random, sizeof likely - 1)]
                                                : (char)random_below(random, 256);
    }
}
