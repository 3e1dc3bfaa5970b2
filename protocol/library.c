/* SPDX-License-Identifier: MIT */
#include "library.h"

#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "limits.h"
#include "memory.h"
#include "scene_internal.h"

static const char *const kind_names[LIBRARY_KINDS] = {
    [LIBRARY_PRIMITIVE] = "primitive", [LIBRARY_MATERIAL] = "material", [LIBRARY_MODEL] = "model"};

const char *library_kind_name(enum library_kind kind)
{
    return kind_names[kind];
}

enum library_kind library_kind_find(const char *name)
{
    int kind = 0;

    while (kind < LIBRARY_KINDS && strcmp(kind_names[kind], name) != 0) {
        kind++;
    }
    return (enum library_kind)kind;
}

/* Puts the place of an error below another: "/root" becomes "/entries/2/document/root". */
static bool fail_below(struct error *err, const char *place)
{
    char joined[ERROR_PLACE_BYTES];

    if (err) {
        const char *own = err->place + (*err->place == '/');

        snprintf(err->place, sizeof err->place, "%s",
                 *own ? error_place(joined, place, own) : place);
    }
    return false;
}

/* A camera, lights and what is around are the scene's that takes the entry. */
static bool check_members(const cJSON *document, const char *place, struct error *err)
{
    char path[ERROR_PLACE_BYTES];
    const cJSON *member;

    cJSON_ArrayForEach(member, document)
    {
        const struct resource_kind *kind = resource_kind_find(member->string);

        if (!(kind && kind->user) && strcmp(member->string, "format") != 0 &&
            strcmp(member->string, "name") != 0 && strcmp(member->string, "root") != 0) {
            return error_set(err, ERROR_INVALID, error_place(path, place, member->string),
                             "an entry has format, name, root, and what the root uses");
        }
    }
    return true;
}

/* Code, an equation, a surface, or the name of a primitive of the document. */
static bool is_written(const struct node *node)
{
    for (const struct param *param = node->params.type->params; param->name; param++) {
        if (param->type == PARAM_CODE || param->type == PARAM_EQUATION ||
            param->type == PARAM_SURFACE || param->type == PARAM_FUNCTION) {
            return node->child_count == 0;
        }
    }
    return false;
}

static bool check_kind(const struct library_entry *entry, const char *place, struct error *err)
{
    const struct scene *scene = entry->scene;
    char path[ERROR_PLACE_BYTES];

    if (entry->kind == LIBRARY_PRIMITIVE && !is_written(scene->root)) {
        return error_set(err, ERROR_INVALID, error_place(path, place, "root"),
                         "a primitive is one node with code, an equation or a surface");
    }
    if (entry->kind == LIBRARY_MATERIAL &&
        (scene->materials.count != 1 || !node_material(scene, scene->root))) {
        return error_set(err, ERROR_INVALID, error_place(path, place, "materials"),
                         "expected one material, which the root names");
    }
    return true;
}

static bool check_scene(const struct library_entry *entry, const char *place, struct error *err)
{
    const struct scene *scene = entry->scene;
    char path[ERROR_PLACE_BYTES];

    if (!*record_text(&scene->info, "name")) {
        return error_set(err, ERROR_INVALID, error_place(path, place, "name"), "is missing");
    }
    if (scene->node_count > LIMIT_LIBRARY_NODES) {
        return error_set(err, ERROR_LIMIT, place, "%zu nodes are above the limit %d",
                         scene->node_count, LIMIT_LIBRARY_NODES);
    }
    return check_kind(entry, place, err);
}

static bool read_kind(const cJSON *json, const char *place, enum library_kind *out,
                      struct error *err)
{
    char path[ERROR_PLACE_BYTES];
    const char *name;

    if (!json_read_text(json, &name, place, "kind", err)) {
        return false;
    }
    *out = library_kind_find(name);
    return *out < LIBRARY_KINDS ||
           error_set(err, ERROR_INVALID, error_place(path, place, "kind"),
                     "\"%.64s\" is not one of primitive, material, model", name);
}

bool library_entry_read(const cJSON *json, const char *place, struct library_entry *out,
                        struct error *err)
{
    static const char *const members[] = {"id", "kind", "document", NULL};
    const cJSON *found[3];
    char path[ERROR_PLACE_BYTES];

    *out = (struct library_entry){0};
    error_place(path, place, "document");
    if (!json_sort_members(json, members, found, place, err) ||
        (found[0] && !json_read_text(found[0], &out->id, place, "id", err)) ||
        !read_kind(found[1], place, &out->kind, err)) {
        return false;
    }
    if (!cJSON_IsObject(found[2])) {
        return error_set(err, ERROR_INVALID, path, found[2] ? "expected an object" : "is missing");
    }
    if (!check_members(found[2], path, err)) {
        return false;
    }
    out->scene = scene_read(found[2], err);
    if (!out->scene) {
        return fail_below(err, path);
    }
    if (!check_scene(out, path, err)) {
        library_entry_finish(out);
        return false;
    }
    out->text = scene_print(out->scene, false);
    return true;
}

void library_entry_finish(struct library_entry *entry)
{
    scene_destroy(entry->scene);
    free(entry->text);
    *entry = (struct library_entry){0};
}

static bool check_file(const cJSON *const found[2], struct error *err)
{
    const char *format;

    if (!json_read_text(found[0], &format, "", "format", err)) {
        return false;
    }
    if (strcmp(format, LIBRARY_FORMAT) != 0) {
        return error_set(err, ERROR_INVALID, "/format", "\"%.64s\" is not \"%s\"", format,
                         LIBRARY_FORMAT);
    }
    if (!cJSON_IsArray(found[1])) {
        return error_set(err, ERROR_INVALID, "/entries",
                         found[1] ? "expected an array" : "is missing");
    }
    const int count = cJSON_GetArraySize(found[1]);
    return count <= LIMIT_LIBRARY_ENTRIES ||
           error_set(err, ERROR_LIMIT, "/entries", "%d entries are above the limit %d", count,
                     LIMIT_LIBRARY_ENTRIES);
}

struct library_entry *library_entries_read(const cJSON *json, size_t *out_count, struct error *err)
{
    static const char *const members[] = {"format", "entries", NULL};
    const cJSON *found[2], *item;
    size_t count = 0;

    if (!json_sort_members(json, members, found, "", err) || !check_file(found, err)) {
        return NULL;
    }
    struct library_entry *entries =
        memory_alloc((size_t)cJSON_GetArraySize(found[1]) + 1, sizeof *entries);
    cJSON_ArrayForEach(item, found[1])
    {
        char place[40];

        snprintf(place, sizeof place, "/entries/%zu", count);
        if (!library_entry_read(item, place, &entries[count], err)) {
            library_entries_destroy(entries, count);
            return NULL;
        }
        count++;
    }
    *out_count = count;
    return entries;
}

void library_entries_destroy(struct library_entry *entries, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        library_entry_finish(&entries[i]);
    }
    free(entries);
}
