/* SPDX-License-Identifier: MIT */
#include "numeric_edit.h"

#include <math.h>
#include <string.h>

static const struct node *any_node(struct random *random, const struct scene *scene)
{
    const struct node *found = scene->root;
    size_t seen = 0;

    for (size_t tree = 0; tree <= scene->models.count; tree++) {
        const struct node *top =
            tree < scene->models.count ? scene->models.items[tree]->root : scene->root;
        for (const struct node *node = top; node; node = node_next(node, top)) {
            found = random_below(random, ++seen) == 0 ? node : found;
        }
    }
    return found;
}

static bool is_numeric(enum param_type type)
{
    return type == PARAM_POINTS || (type != PARAM_ENUM && param_components(type) > 0);
}

/* The row of one of its numbers; -1: it has none. */
static int any_row(struct random *random, const struct record *record)
{
    int found = -1;
    size_t seen = 0;

    for (int i = 0; record->type->params[i].name; i++) {
        if (is_numeric(record->type->params[i].type) && random_below(random, ++seen) == 0) {
            found = i;
        }
    }
    return found;
}

static void move_number(struct random *random, const struct param *param, cJSON *number)
{
    double low, high;

    param_range(param, &low, &high);
    const double by = fabs(number->valuedouble) * 0.1 + 0.02;
    const double moved = number->valuedouble + random_between(random, -by, by);
    cJSON_SetNumberValue(number, fmin(fmax(moved, low), high));
}

static void move_all(struct random *random, const struct param *param, cJSON *json)
{
    if (cJSON_IsNumber(json)) {
        move_number(random, param, json);
    }
    for (cJSON *child = cJSON_IsArray(json) ? json->child : NULL; child; child = child->next) {
        move_all(random, param, child);
    }
}

static cJSON *any_value(struct random *random, const struct record *record, int row, bool wild)
{
    const struct param *param = &record->type->params[row];

    if (wild || param_is_whole(param->type)) {
        return random_value(random, param, NULL);
    }
    cJSON *json = param_value_json(param, &record->values[row]);
    move_all(random, param, json);
    return json;
}

static void add(cJSON *ops, const char *at, cJSON *value)
{
    cJSON *op = cJSON_CreateObject();

    cJSON_AddStringToObject(op, "op", "set");
    cJSON_AddStringToObject(op, "at", at);
    cJSON_AddItemToObject(op, "value", value);
    cJSON_AddItemToArray(ops, op);
}

static void add_in(cJSON *ops, struct random *random, const char *of, const struct record *record,
                   bool wild)
{
    const int row = any_row(random, record);
    char at[200];

    if (row < 0) {
        return;
    }
    snprintf(at, sizeof at, "%s/%s", of, record->type->params[row].name);
    add(ops, at, any_value(random, record, row, wild));
}

static void add_node(cJSON *ops, struct random *random, const struct scene *scene, bool wild)
{
    const struct node *node = any_node(random, scene);
    const bool transform = random_chance(random, 0.4);
    char of[160];

    snprintf(of, sizeof of, "/nodes/%s/%s", node->id, transform ? "transform" : "params");
    add_in(ops, random, of, transform ? &node->transform : &node->params, wild);
}

static void add_material(cJSON *ops, struct random *random, const struct scene *scene, bool wild)
{
    if (scene->materials.count > 0) {
        const struct resource *material =
            scene->materials.items[random_below(random, scene->materials.count)];
        char of[160];
        snprintf(of, sizeof of, "/materials/%s/properties", material->name);
        add_in(ops, random, of, &material->record, wild);
    }
}

static void add_beside(cJSON *ops, struct random *random, const struct scene *scene, bool wild)
{
    static const char *const places[] = {"/camera", "/environment"};
    const size_t which = random_below(random, 2);

    add_in(ops, random, places[which], which ? &scene->environment : &scene->camera, wild);
}

cJSON *numeric_edit(struct random *random, const struct scene *scene, bool wild)
{
    cJSON *ops = cJSON_CreateArray();

    for (size_t left = 1 + random_below(random, 3); left > 0 || !ops->child; left -= left > 0) {
        const double what = random_between(random, 0, 1);
        if (what < 0.8) {
            add_node(ops, random, scene, wild);
        } else if (what < 0.9) {
            add_material(ops, random, scene, wild);
        } else {
            add_beside(ops, random, scene, wild);
        }
    }
    return ops;
}
