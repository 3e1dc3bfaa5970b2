/* SPDX-License-Identifier: MIT */
/* A field after an edit, out of the one before. */
#include "field_patch.h"

#include <stdlib.h>
#include <string.h>

#include "field_materials.h"
#include "field_sites.h"
#include "protocol/memory.h"

/* --- what operations change --- */

enum { PARTS_MAX = 4, PLACE_BYTES = 256 };

struct parts {
    char text[PLACE_BYTES];
    const char *at[PARTS_MAX];
    size_t count;
};

/* "/nodes/body/params/radius" cut at its slashes; false: it has more parts than any place. */
static bool split(struct parts *out, const char *place)
{
    char *save = NULL;

    out->count = 0;
    snprintf(out->text, sizeof out->text, "%s", place);
    for (char *part = strtok_r(out->text, "/", &save); part; part = strtok_r(NULL, "/", &save)) {
        if (out->count == PARTS_MAX) {
            return false;
        }
        out->at[out->count++] = part;
    }
    return out->count > 0;
}

/* Whether setting this value changes numbers alone; what it is in the program is decided there. */
static bool is_numeric(const struct record *record, const char *name)
{
    const int index = record_type_find(record->type, name);
    const enum param_type type = index < 0 ? PARAM_TEXT : record->type->params[index].type;

    return type == PARAM_POINTS || (type != PARAM_ENUM && param_components(type) > 0);
}

static void mark(struct field_sites *sites, const struct node *node, enum site_change change)
{
    /* What is hidden and left out has no numbers in the program. */
    sites->changed = sites_mark(sites, node, change) || sites->changed;
}

/* What a parameter of a model sets in this instance, however many models further. */
static void mark_target(struct field_sites *sites, const struct scene *scene,
                        const struct node *instance, const struct node *node, int index)
{
    const struct resource *model = node_model(scene, node);

    if (!model || (size_t)index < model->declared->first_declared) {
        return;
    }
    const struct model_target target = model_target_of(scene, model, (size_t)index);
    sites_mark_within(sites, target.node, instance, target.of_transform ? SITE_ALL : SITE_INSIDE);
    if (!target.of_transform) {
        mark_target(sites, scene, instance, target.node, target.index);
    }
}

static bool mark_node(struct field_sites *sites, const struct scene *scene,
                      const struct parts *parts)
{
    const struct node *node = scene_find(scene, parts->at[1]);
    const char *member = parts->at[2];

    if (!node) {
        return false;
    }
    if (strcmp(member, "transform") == 0) {
        mark(sites, node, SITE_ALL);
        return true;
    }
    if (strcmp(member, "params") == 0 && parts->count == 4 &&
        is_numeric(&node->params, parts->at[3])) {
        mark(sites, node, SITE_INSIDE);
        mark_target(sites, scene, node, node, record_type_find(node->params.type, parts->at[3]));
        return true;
    }
    return strcmp(member, "name") == 0;
}

static bool mark_material(struct field_sites *sites, const struct scene *scene,
                          const struct parts *parts)
{
    const size_t slot = field_material_slot(scene, parts->at[1]);

    if (slot == 0 || slot >= sites->slot_count || parts->count != 4 ||
        strcmp(parts->at[2], "properties") != 0 ||
        !is_numeric(&scene->materials.items[slot - 1]->record, parts->at[3])) {
        return false;
    }
    sites->repaint[slot] = sites->changed = true;
    return true;
}

/* Of nothing that a field is made of. */
static bool is_beside(const struct scene *scene, const char *first)
{
    static const char *const beside[] = {"camera", "render", "lights", "volumes"};

    for (size_t i = 0; i < sizeof beside / sizeof beside[0]; i++) {
        if (strcmp(first, beside[i]) == 0) {
            return true;
        }
    }
    return record_type_find(scene->info.type, first) >= 0;
}

/* False: it changes more than numbers. */
static bool mark_operation(struct field_sites *sites, const struct scene *scene, const cJSON *op)
{
    const char *name = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(op, "op"));
    const char *at = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(op, "at"));
    const char *into = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(op, "into"));
    struct parts parts;

    if (!name || !(at || into) || !split(&parts, at ? at : into)) {
        return false;
    }
    if (is_beside(scene, parts.at[0])) {
        return true;
    }
    if (strcmp(name, "set") != 0) {
        return false;
    }
    if (strcmp(parts.at[0], "environment") == 0) {
        sites->floor_changed = sites->changed = true;
        return true;
    }
    return parts.count >= 3 &&
           (strcmp(parts.at[0], "nodes") == 0
                ? mark_node(sites, scene, &parts)
                : strcmp(parts.at[0], "materials") == 0 && mark_material(sites, scene, &parts));
}

static bool mark_all(struct field_sites *sites, const struct scene *scene, const cJSON *ops)
{
    sites->changed = false;
    for (const cJSON *op = ops->child; op; op = op->next) {
        if (!mark_operation(sites, scene, op)) {
            return false;
        }
    }
    return true;
}

/* --- numbers of its own --- */

static void widen(struct field_span *span, size_t first, size_t end)
{
    const bool none = span->first == span->end;

    span->first = none || first < span->first ? first : span->first;
    span->end = none || end > span->end ? end : span->end;
}

static void widen_by(struct field_span *span, const struct sites_patch *patch)
{
    for (size_t i = 0; i < patch->counts[SITES_PARAMS]; i++) {
        widen(span, patch->ranges[SITES_PARAMS][i].first, patch->ranges[SITES_PARAMS][i].end);
    }
}

static void copy_patch(struct field *to, const struct field *from, const struct sites_patch *patch)
{
    for (size_t i = 0; i < patch->counts[SITES_PARAMS]; i++) {
        const struct sites_range *range = &patch->ranges[SITES_PARAMS][i];
        memcpy(to->params + 4 * range->first, from->params + 4 * range->first,
               (range->end - range->first) * 4 * sizeof *to->params);
    }
    for (size_t i = 0; i < patch->counts[SITES_ARGUMENTS]; i++) {
        const struct sites_range *range = &patch->ranges[SITES_ARGUMENTS][i];
        memcpy(to->arguments + range->first, from->arguments + range->first,
               (range->end - range->first) * sizeof *to->arguments);
    }
}

/* Whether the patches that `to` lacks are all known. */
static bool is_near(const struct field_sites *sites, const struct field *to)
{
    if (sites->version - to->version > SITES_PATCHES) {
        return false;
    }
    for (uint64_t version = to->version + 1; version <= sites->version; version++) {
        if (sites->patches[version % SITES_PATCHES].all) {
            return false;
        }
    }
    return true;
}

static void copy_all(struct field *to, const struct field *from, struct field_span *out_changed)
{
    memcpy(to->params, from->params, from->vec4_count * 4 * sizeof *to->params);
    if (from->argument_count > 0) {
        memcpy(to->arguments, from->arguments, from->argument_count * sizeof *to->arguments);
    }
    widen(out_changed, 0, from->vec4_count);
}

/* The numbers of `from`. */
static void catch_up(struct field *to, const struct field *from, struct field_span *out_changed)
{
    const struct field_sites *sites = from->sites;

    if (!is_near(sites, to)) {
        copy_all(to, from, out_changed);
        return;
    }
    for (uint64_t version = to->version + 1; version <= sites->version; version++) {
        const struct sites_patch *patch = &sites->patches[version % SITES_PATCHES];
        copy_patch(to, from, patch);
        widen_by(out_changed, patch);
    }
}

static struct field *copy(struct field *from, struct field_span *out_changed)
{
    struct field *to = memory_alloc(1, sizeof *to);

    *to = *from;
    to->references = 1;
    to->base = field_ref(from->base ? from->base : from);
    to->sites = NULL;
    to->params = memory_alloc(from->vec4_count + SITES_ROOM, 4 * sizeof *to->params);
    to->arguments = memory_alloc(from->argument_count + SITES_ROOM, sizeof *to->arguments);
    copy_all(to, from, out_changed);
    return to;
}

void field_end_patches(struct field *from)
{
    sites_destroy(from->sites);
    from->sites = NULL;
}

static struct field *give_up(struct field *from, struct field *to)
{
    field_end_patches(from);
    field_unref(to);
    return NULL;
}

/* A field with the numbers of `from`. */
static struct field *begin(struct field *from, struct field *spare, struct field_span *out_changed)
{
    if (!spare || !spare->base || spare->base != (from->base ? from->base : from)) {
        return copy(from, out_changed);
    }
    catch_up(spare, from, out_changed);
    return field_ref(spare);
}

struct field *field_patch(struct field *from, struct field *spare, const struct scene *scene,
                          const cJSON *ops, struct field_span *out_changed)
{
    struct field_sites *sites = from->sites;

    *out_changed = (struct field_span){0, 0};
    if (!sites || !mark_all(sites, scene, ops)) {
        return give_up(from, NULL);
    }
    if (!sites->changed) {
        return field_ref(from);
    }
    struct field *to = begin(from, spare, out_changed);
    struct sites_patch *patch = &sites->patches[++sites->version % SITES_PATCHES];
    patch->all = false;
    memset(patch->counts, 0, sizeof patch->counts);
    if (!field_run_again(to, sites, scene)) {
        return give_up(from, to);
    }
    if (patch->all) {
        widen(out_changed, 0, to->vec4_count);
    }
    widen_by(out_changed, patch);
    from->sites = NULL;
    to->sites = sites;
    to->version = sites->version;
    return to;
}
