/* SPDX-License-Identifier: MIT */
#include "code_text.h"

#include <string.h>

static const char member[] = "code"; /* of primitives, shaders and nodes: nothing else has it */

/* --- in JSON --- */

static bool is_code(const cJSON *json)
{
    return cJSON_IsString(json) && *json->valuestring;
}

static bool is_named(const cJSON *json, const char *name)
{
    return json->string && strcmp(json->string, name) == 0;
}

static bool ends_with_member(const char *place)
{
    const char *slash = strrchr(place, '/');

    return slash && strcmp(slash + 1, member) == 0;
}

/* The value of an operation that sets code; NULL: it does something else. */
static cJSON *code_set(const cJSON *json)
{
    const cJSON *at = cJSON_GetObjectItemCaseSensitive(json, "at");
    cJSON *value = cJSON_GetObjectItemCaseSensitive(json, "value");

    return cJSON_IsString(at) && is_code(value) && ends_with_member(at->valuestring) ? value : NULL;
}

/* Where a value is: what it is a member of, and so on. Edits of thousands of operations are looked
 * through, so a place is printed only where code is. */
struct way {
    const struct way *outer; /* NULL: the whole */
    const cJSON *json;
    size_t index;
};

static void print_way(const struct way *way, char out_place[ERROR_PLACE_BYTES])
{
    char number[24];

    if (!way->outer) {
        out_place[0] = '\0';
        return;
    }
    print_way(way->outer, out_place);
    snprintf(number, sizeof number, "%zu", way->index);
    error_place(out_place, out_place, way->json->string ? way->json->string : number);
}

/* Sets the place of code that is set, or else where the code is; true. */
static bool tell(const struct way *way, const cJSON *set, char *out_place)
{
    if (out_place && set) {
        snprintf(out_place, ERROR_PLACE_BYTES, "%s",
                 cJSON_GetObjectItemCaseSensitive(way->json, "at")->valuestring);
    } else if (out_place) {
        print_way(way, out_place);
    }
    return true;
}

static bool find_below(const struct way *way, char *out_place)
{
    const cJSON *set = code_set(way->json);
    struct way next = {.outer = way};

    if (set) {
        return tell(way, set, out_place);
    }
    for (const cJSON *child = way->json->child; child; child = child->next, next.index++) {
        next.json = child;
        if (is_code(child) && is_named(child, member)) {
            return tell(&next, NULL, out_place);
        }
        if (child->child && find_below(&next, out_place)) {
            return true;
        }
    }
    return false;
}

bool code_text_find(const cJSON *json, char *out_place)
{
    return find_below(&(struct way){.json = json}, out_place);
}

void code_text_remove(cJSON *json)
{
    cJSON *set = code_set(json);

    if (set) {
        cJSON_SetValuestring(set, "");
    }
    for (cJSON *child = json->child; child; child = child->next) {
        if (is_code(child) && is_named(child, member)) {
            cJSON_SetValuestring(child, "");
        } else {
            code_text_remove(child);
        }
    }
}

/* --- in scenes --- */

/* What is looked for: any code, or with `before` what is not the same there. */
struct search {
    const struct scene *before;
    char *out_place; /* NULL: of no interest */
};

static bool is_found(const struct search *search, const char *text, const struct record *before)
{
    return *text && (!search->before || !before || strcmp(text, record_text(before, member)) != 0);
}

static bool put_place(const struct search *search, const char *list, const char *name,
                      const char *between)
{
    if (search->out_place) {
        snprintf(search->out_place, ERROR_PLACE_BYTES, "/%s/%s/%s%s", list, name, between, member);
    }
    return true;
}

static bool search_list(const struct search *search, const struct resource_list *list,
                        const struct resource_list *before, const char *name)
{
    for (size_t i = 0; i < list->count; i++) {
        const struct resource *resource = list->items[i];
        const struct resource *old = before ? resource_find(before, resource->name) : NULL;

        if (is_found(search, record_text(&resource->record, member), old ? &old->record : NULL)) {
            return put_place(search, name, resource->name, "");
        }
    }
    return false;
}

static bool search_tree(const struct search *search, const struct node *root)
{
    for (const struct node *node = root; node; node = node_next(node, root)) {
        if (node->type->kind != KIND_CODE) {
            continue;
        }
        const struct node *old = search->before ? scene_find(search->before, node->id) : NULL;
        const bool same_kind = old && old->type->kind == KIND_CODE;
        if (is_found(search, record_text(&node->params, member), same_kind ? &old->params : NULL)) {
            return put_place(search, "nodes", node->id, "params/");
        }
    }
    return false;
}

static bool search_scene(const struct search *search, const struct scene *scene)
{
    const struct scene *before = search->before;

    if (search_list(search, &scene->primitives, before ? &before->primitives : NULL,
                    "primitives") ||
        search_list(search, &scene->shaders, before ? &before->shaders : NULL, "shaders")) {
        return true;
    }
    for (size_t i = 0; i < scene->models.count; i++) {
        if (search_tree(search, scene->models.items[i]->root)) {
            return true;
        }
    }
    return search_tree(search, scene->root);
}

bool code_text_in_scene(const struct scene *scene)
{
    return search_scene(&(struct search){0}, scene);
}

const char *code_text_changed(const struct scene *scene, const struct scene *before,
                              char out_place[ERROR_PLACE_BYTES])
{
    *out_place = '\0';
    if (!before || !search_scene(&(struct search){before, out_place}, scene)) {
        search_scene(&(struct search){NULL, out_place}, scene);
    }
    return out_place;
}
