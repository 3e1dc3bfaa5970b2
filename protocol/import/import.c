/* SPDX-License-Identifier: MIT */
/* The document that the files of a folder make. */
#include "import.h"

#include <stdlib.h>
#include <string.h>

#include "import_internal.h"
#include "protocol/memory.h"
#include "protocol/scene_internal.h"

static bool list_materials(const struct importing *importing, struct import_item *item)
{
    const struct import_value *list;

    if (!import_take(importing, item, item->value, "materials", IMPORT_LIST, &list)) {
        return false;
    }
    if (!list) {
        return true;
    }
    item->materials = memory_alloc(list->count, sizeof *item->materials);
    for (const struct import_value *one = list->first; one; one = one->next) {
        if (one->kind != IMPORT_TEXT) {
            return import_fail(importing, item, one,
                               "materials: expected names of files in quotes");
        }
        const struct import_item *material =
            import_find(importing, item, one, IMPORT_MATERIAL, one->text);
        if (!material) {
            return false;
        }
        item->materials[item->material_count++] = material->id;
    }
    return true;
}

static cJSON *import_model(struct importing *importing, const struct import_item *item)
{
    static const char *const members[] = {"name", "materials", "model", NULL};
    const struct import_value *tree;

    if (!import_check_members(importing, item, item->value, members) ||
        !import_take(importing, item, item->value, "model", IMPORT_OBJECT, &tree)) {
        return NULL;
    }
    cJSON *root = import_node(importing, item, tree);
    if (root && *item->name && !cJSON_HasObjectItem(root, "name")) {
        cJSON_AddStringToObject(root, "name", item->name);
    }
    return root;
}

static bool add_resources(struct importing *importing, cJSON *document)
{
    static cJSON *(*const make[IMPORT_ROLES])(struct importing *, const struct import_item *) = {
        [IMPORT_MODEL] = import_model,
        [IMPORT_MATERIAL] = import_material,
        [IMPORT_SHADER] = import_shader,
        [IMPORT_PRIMITIVE] = import_primitive,
    };

    for (size_t i = 0; i < importing->count; i++) {
        const struct import_item *item = &importing->items[i];
        const char *name = import_role_list(item->role);

        if (!name) {
            continue;
        }
        cJSON *list = cJSON_GetObjectItemCaseSensitive(document, name);
        cJSON *json = make[item->role](importing, item);
        if (!json) {
            return false;
        }
        import_mark(importing, name, item->id, item, item->value);
        cJSON_AddItemToObject(list ? list : cJSON_AddObjectToObject(document, name), item->id,
                              json);
    }
    return true;
}

static bool add_scene(struct importing *importing, const struct import_item *item, cJSON *children)
{
    static const char *const members[] = {"name", "materials", "scene", NULL};
    const struct import_value *list;

    if (!import_check_members(importing, item, item->value, members) ||
        !import_take(importing, item, item->value, "scene", IMPORT_LIST, &list)) {
        return false;
    }
    for (const struct import_value *one = list->first; one; one = one->next) {
        cJSON *node = import_node(importing, item, one);
        if (!node) {
            return false;
        }
        cJSON_AddItemToArray(children, node);
    }
    return true;
}

static const char *title_of(const struct import_item *item)
{
    return *item->name ? item->name : item->stem;
}

/* A node that shows what is in the file. */
static cJSON *exhibit(struct importing *importing, const struct import_item *item, const char *type,
                      const char *member)
{
    cJSON *node = import_bare_node(importing, type, item, item->value);

    if (!node) {
        return NULL;
    }
    cJSON_AddStringToObject(node, "name", title_of(item));
    cJSON_AddStringToObject(
        strcmp(member, "material") == 0 ? node : cJSON_AddObjectToObject(node, "params"), member,
        item->id);
    return node;
}

/* A material of the shader as it is. */
static void add_plain_material(const struct import_item *shader, cJSON *document)
{
    cJSON *list = cJSON_GetObjectItemCaseSensitive(document, "materials");
    cJSON *material = cJSON_AddObjectToObject(
        list ? list : cJSON_AddObjectToObject(document, "materials"), shader->id);

    cJSON_AddStringToObject(material, "shader", shader->id);
}

static bool has_role(const struct importing *importing, enum import_role role)
{
    size_t i = 0;

    while (i < importing->count && importing->items[i].role != role) {
        i++;
    }
    return i < importing->count;
}

/* Where there is no scene: all models; without any, primitives, and balls of all materials; without
 * any, of all shaders. */
static void add_exhibits(struct importing *importing, cJSON *document, cJSON *children)
{
    const bool models = has_role(importing, IMPORT_MODEL);
    const bool materials = has_role(importing, IMPORT_MATERIAL);

    for (size_t i = 0; i < importing->count; i++) {
        const struct import_item *item = &importing->items[i];
        cJSON *node = NULL;

        if (item->role == IMPORT_MODEL) {
            node = exhibit(importing, item, "model", "model");
        } else if (item->role == IMPORT_PRIMITIVE && !models) {
            node = exhibit(importing, item, "field", "primitive");
        } else if (item->role == IMPORT_MATERIAL && !models) {
            node = exhibit(importing, item, "sphere", "material");
        } else if (item->role == IMPORT_SHADER && !models && !materials) {
            add_plain_material(item, document);
            node = exhibit(importing, item, "sphere", "material");
        }
        if (node) {
            cJSON_AddItemToArray(children, node);
        }
    }
}

/* The scene that was asked for, or the only one; `*out` NULL where there is none at all. */
static bool choose_scene(const struct importing *importing, const char *wanted,
                         const struct import_item **out)
{
    const struct import_value start = {.line = 0};
    const struct import_item nowhere = {.path = "", .stem = "", .name = ""};
    char names[200] = "";
    size_t count = 0;

    *out = NULL;
    if (wanted) {
        *out = import_find(importing, &nowhere, &start, IMPORT_SCENE, wanted);
        return *out != NULL;
    }
    for (size_t i = 0; i < importing->count; i++) {
        const struct import_item *item = &importing->items[i];
        const size_t used = strlen(names);

        if (item->role == IMPORT_SCENE) {
            snprintf(names + used, sizeof names - used, "%s\"%s\"", count ? ", " : "",
                     title_of(item));
            *out = item;
            count++;
        }
    }
    return count <= 1 || import_fail(importing, &nowhere, &start,
                                     "there are %zu scenes: %s; say which", count, names);
}

static cJSON *build(struct importing *importing, const struct import_item *scene, const char *title)
{
    cJSON *document = cJSON_CreateObject();
    cJSON *sun, *root;

    cJSON_AddStringToObject(document, "format", SCENE_FORMAT);
    cJSON_AddStringToObject(document, "name",
                            title ? title : title_of(scene ? scene : importing->items));
    sun = cJSON_CreateObject();
    cJSON_AddItemToArray(cJSON_AddArrayToObject(document, "lights"), sun);
    cJSON_AddStringToObject(sun, "id", "sun");
    cJSON_AddStringToObject(sun, "type", "directional");
    cJSON_AddNumberToObject(sun, "intensity", 3);
    /* Colours are shown as the format's renderer shows them. */
    cJSON_AddStringToObject(cJSON_AddObjectToObject(document, "render"), "tone_map", "none");
    root = cJSON_AddObjectToObject(document, "root");
    importing->nodes = 1;
    cJSON_AddStringToObject(root, "id", "root");
    cJSON_AddStringToObject(root, "type", "union");
    cJSON *children = cJSON_AddArrayToObject(root, "children");
    bool ok = add_resources(importing, document);
    if (ok && scene) {
        ok = add_scene(importing, scene, children);
    } else if (ok) {
        add_exhibits(importing, document, children);
        ok = importing->nodes <= LIMIT_NODES;
    }
    if (!ok) {
        cJSON_Delete(document);
        return NULL;
    }
    return document;
}

/* The document breaks a rule at a place; says where in the files that came from. */
static void blame_file(const struct importing *importing, struct error *err)
{
    const struct import_mark *best = NULL;
    size_t best_length = 0;

    for (size_t i = 0; i < importing->mark_count; i++) {
        const struct import_mark *mark = &importing->marks[i];
        const size_t length = strlen(mark->place);

        if (length > best_length && strncmp(err->place, mark->place, length) == 0 &&
            (err->place[length] == '/' || err->place[length] == '\0')) {
            best = mark;
            best_length = length;
        }
    }
    if (best) {
        const char *rest = err->place + best_length;

        rest += *rest == '/';
        rest += strncmp(rest, "params/", 7) == 0 ? 7 : 0;
        error_set_at(err, err->kind, best->item->path, best->line, best->column, "%s%s%s", rest,
                     *rest ? ": " : "", err->message);
    }
}

static struct scene *convert(struct importing *importing, const struct import_source *source)
{
    const struct import_item *chosen;
    struct scene *scene = NULL;
    bool ok = choose_scene(importing, source->scene, &chosen);

    for (size_t i = 0; ok && i < importing->count; i++) {
        ok = list_materials(importing, &importing->items[i]);
    }
    ok = ok && import_count_data(importing);
    cJSON *document = ok ? build(importing, chosen, source->title) : NULL;
    if (document) {
        scene = scene_read(document, importing->err);
        if (!scene) {
            blame_file(importing, importing->err);
        }
    }
    cJSON_Delete(document);
    if (scene) {
        if (!chosen) {
            import_lay_out(scene);
        }
        import_frame(scene);
    }
    return scene;
}

struct scene *import_scene(const struct import_source *source, cJSON **out_notes, struct error *err)
{
    struct error ignored = {0};
    struct importing importing = {.err = err ? err : &ignored};
    cJSON *notes = cJSON_CreateArray();
    struct scene *scene = NULL;

    importing.numbers = memory_alloc(node_type_count(), sizeof *importing.numbers);
    if (import_read_files(&importing, source, notes)) {
        scene = convert(&importing, source);
    }
    import_finish_files(&importing);
    free(importing.marks);
    free(importing.numbers);
    if (scene && out_notes) {
        *out_notes = notes;
    } else {
        cJSON_Delete(notes);
    }
    return scene;
}
