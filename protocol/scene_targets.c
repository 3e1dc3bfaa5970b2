/* SPDX-License-Identifier: MIT */
/* What parameters of models set: "/nodes/ID/params/radius", "/nodes/ID/transform/scale", or one
 * component, "/nodes/ID/params/size.y", of a node in the model's tree. */
#include <string.h>

#include "limits.h"
#include "scene_internal.h"

static const char components[] = "xyzw";

/* A place cut at its slashes. */
struct target_place {
    char id[LIMIT_ID_BYTES + 1], group[16], name[LIMIT_ID_BYTES + 1], component[2];
};

static bool copy_part(char *out, size_t bytes, const char **text, const char *ends)
{
    const size_t length = strcspn(*text, ends);

    snprintf(out, bytes, "%.*s", (int)length, *text);
    *text += length;
    return length > 0 && length < bytes;
}

static bool split(const char *place, struct target_place *out)
{
    static const char home[] = "/nodes/";
    const char *text = place + strlen(home);

    *out = (struct target_place){.component = ""};
    if (strncmp(place, home, strlen(home)) != 0 ||
        !copy_part(out->id, sizeof out->id, &text, "/") || *text++ != '/' ||
        !copy_part(out->group, sizeof out->group, &text, "/") || *text++ != '/' ||
        !copy_part(out->name, sizeof out->name, &text, "./")) {
        return false;
    }
    return !*text ||
           (*text++ == '.' && copy_part(out->component, sizeof out->component, &text, "") &&
            strchr(components, out->component[0]));
}

/* What the place means for a node whose parameters are of these rows; false: nothing. */
static bool resolve(const struct target_place *place, const struct node *node,
                    const struct record_type *params, struct model_target *out)
{
    const bool of_transform = strcmp(place->group, "transform") == 0;
    const struct record_type *type = of_transform ? &transform_type : params;

    *out = (struct model_target){
        .node = node,
        .of_transform = of_transform,
        .index = record_type_find(type, place->name),
        .component =
            *place->component ? (int)(strchr(components, place->component[0]) - components) : -1};
    return out->index >= 0 && (of_transform || strcmp(place->group, "params") == 0);
}

static const struct param *row_of(const struct model_target *target,
                                  const struct record_type *params)
{
    return &(target->of_transform ? &transform_type : params)->params[target->index];
}

static enum param_type part_type(enum param_type type)
{
    return type == PARAM_BVEC3 ? PARAM_BOOL : param_is_whole(type) ? PARAM_INT : PARAM_FLOAT;
}

static bool takes_type(const struct model_target *target, const struct param *row,
                       const struct param *own)
{
    const int count = param_components(own->type);

    if (own->type == PARAM_ENUM || count == 0) {
        return false;
    }
    if (target->component >= 0) {
        return target->component < count && count > 1 && row->type == part_type(own->type);
    }
    return row->type == own->type || (own->uniform && row->type == PARAM_FLOAT);
}

static bool takes_range(const struct param *row, const struct param *own)
{
    double low, high, least, most;

    param_range(row, &low, &high);
    param_range(own, &least, &most);
    const bool beside_0 = low > 0 || high < 0;
    return row->type == PARAM_BOOL ||
           (low >= least && high <= most && (low > least || !own->above_min) &&
            (beside_0 || !(own->nonzero || own->direction)));
}

static bool fail_range(const struct param *own, const char *sets, const char *place,
                       struct error *err)
{
    char path[ERROR_PLACE_BYTES];
    double least, most;

    param_range(own, &least, &most);
    return error_set(err, ERROR_INVALID, error_place(path, place, "range"),
                     "leaves that of %.160s: %s%.9g%s to %.9g%s", sets,
                     own->above_min ? "above " : "", least, own->above_min ? "," : "", most,
                     own->nonzero || own->direction ? ", without 0" : "");
}

static bool check_target(const struct model_target *target, const struct record_type *params,
                         const struct param *row, const char *sets, const char *place,
                         struct error *err)
{
    const struct param *own = row_of(target, params);
    char path[ERROR_PLACE_BYTES];

    if (!takes_type(target, row, own)) {
        return error_set(err, ERROR_INVALID, error_place(path, place, "sets"),
                         "a %s cannot set %.160s, which is a %s", param_type_name(row->type), sets,
                         param_type_name(own->type));
    }
    return takes_range(row, own) || fail_range(own, sets, place, err);
}

static bool check_row(const struct scene *scene, const struct resource *model,
                      const struct param *row, const char *sets, const char *place,
                      struct error *err)
{
    struct target_place at;
    struct model_target target;
    char path[ERROR_PLACE_BYTES];

    error_place(path, place, "sets");
    if (!split(sets, &at)) {
        return error_set(err, ERROR_INVALID, path,
                         "\"%.160s\" is not a place such as \"/nodes/ID/params/radius\"", sets);
    }
    const struct node *node = scene_find(scene, at.id);
    if (!node || node_owner(node) != model) {
        return error_set(err, ERROR_INVALID, path, "the model has no node \"%s\"", at.id);
    }
    if (!resolve(&at, node, node->params.type, &target)) {
        return error_set(err, ERROR_INVALID, path, "the node has no number \"%s/%s\"", at.group,
                         at.name);
    }
    return check_target(&target, node->params.type, row, sets, place, err);
}

bool scene_check_targets(const struct scene *scene, const struct resource *model,
                         const struct declared_params *declared, const char *place,
                         struct error *err)
{
    const struct param *rows = declared->type.params + declared->first_declared;

    for (size_t i = 0; rows[i].name; i++) {
        char path[ERROR_PLACE_BYTES], number[24];
        snprintf(number, sizeof number, "%zu", i);
        if (!check_row(scene, model, &rows[i], declared->sets[i], error_place(path, place, number),
                       err)) {
            return false;
        }
    }
    return true;
}

/* --- what has to stay --- */

static bool fail_use(const struct resource *model, const struct param *row, const char *sets,
                     const char *place, struct error *err)
{
    return error_set(err, ERROR_CONFLICT, place, "the parameter \"%s\" of /models/%s sets %.160s",
                     row->name, model->name, sets);
}

static bool is_below(const struct node *node, const struct node *top)
{
    while (node && node != top) {
        node = node->parent;
    }
    return node;
}

bool scene_check_untargeted(const struct scene *scene, const struct node *top, const char *place,
                            struct error *err)
{
    const struct resource *model = node_owner(top);
    const struct declared_params *declared = model ? model->declared : NULL;
    const struct param *rows = declared ? declared->type.params + declared->first_declared : NULL;
    struct target_place at;

    for (size_t i = 0; rows && rows[i].name; i++) {
        split(declared->sets[i], &at);
        if (is_below(scene_find(scene, at.id), top)) {
            return fail_use(model, &rows[i], declared->sets[i], place, err);
        }
    }
    return true;
}

/* What parameters of the model set of its nodes that have `old` rows (NULL: any), or of `node`. */
static bool check_retyped(const struct scene *scene, const struct resource *model,
                          const struct node *node, const struct record_type *old,
                          const struct record_type *params, const char *place, struct error *err)
{
    const struct declared_params *declared = model->declared;
    const struct param *rows = declared->type.params + declared->first_declared;

    for (size_t i = 0; rows[i].name; i++) {
        const char *sets = declared->sets[i];
        struct target_place at;
        struct model_target target;
        split(sets, &at);
        const struct node *set = scene_find(scene, at.id);
        if (old ? set->params.type != old : set != node) {
            continue;
        }
        if (!resolve(&at, set, params, &target) ||
            !check_target(&target, params, &rows[i], sets, place, NULL)) {
            return fail_use(model, &rows[i], sets, place, err);
        }
    }
    return true;
}

bool scene_check_retyped(const struct scene *scene, const struct node *node,
                         const struct record_type *params, const char *place, struct error *err)
{
    const struct resource *model = node_owner(node);

    return !model || check_retyped(scene, model, node, NULL, params, place, err);
}

bool scene_check_all_retyped(const struct scene *scene, const struct record_type *old,
                             const struct record_type *params, const char *place, struct error *err)
{
    for (size_t i = 0; i < scene->models.count; i++) {
        if (!check_retyped(scene, scene->models.items[i], NULL, old, params, place, err)) {
            return false;
        }
    }
    return true;
}

/* --- what is set --- */

struct model_target model_target_of(const struct scene *scene, const struct resource *model,
                                    size_t row)
{
    const struct declared_params *declared = model->declared;
    struct target_place at;
    struct model_target target;

    split(declared->sets[row - declared->first_declared], &at);
    const struct node *node = scene_find(scene, at.id);
    resolve(&at, node, node->params.type, &target);
    return target;
}

void model_target_put(const struct model_target *target, const struct param *row,
                      const struct value *value, struct value *out)
{
    const int given = param_components(row->type);

    out->set = true;
    if (target->component >= 0) {
        out->number[target->component] = value->number[0];
        return;
    }
    for (int i = 0; i < 4; i++) {
        out->number[i] = value->number[given == 1 ? 0 : i];
    }
}
