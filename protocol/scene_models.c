/* SPDX-License-Identifier: MIT */
/* Models that name each other: never in a circle. Each has a level above those of all models in
 * its tree. Where a new name keeps to that, nothing more is looked at; else all levels are found
 * anew. */
#include <stdio.h>
#include <string.h>

#include "limits.h"
#include "scene_internal.h"

enum { UNSEEN, OPEN, DONE };

struct search {
    const struct scene *scene;
    const struct resource *path[LIMIT_MODELS + 1]; /* each names the next */
    size_t count;
    const char *place;
    struct error *err;
};

/* The end of the path stands in it a second time. */
static bool fail_circle(const struct search *search)
{
    char text[256] = "";
    size_t first = 0, used = 0;

    while (search->path[first] != search->path[search->count - 1]) {
        first++;
    }
    for (size_t i = first; i < search->count && used < sizeof text; i++) {
        used += (size_t)snprintf(text + used, sizeof text - used, "%s/models/%s",
                                 i > first ? " -> " : "", search->path[i]->name);
    }
    return error_set(search->err, ERROR_CONFLICT, search->place, "models in a circle: %s", text);
}

static bool find_level(struct search *search, struct resource *model)
{
    if (model->search == DONE) {
        return true;
    }
    search->path[search->count++] = model;
    if (model->search == OPEN) {
        return fail_circle(search);
    }
    model->search = OPEN;
    size_t level = 0;
    for (const struct node *node = model->root; node; node = node_next(node, model->root)) {
        struct resource *named = (struct resource *)node_model(search->scene, node);
        if (named) {
            if (!find_level(search, named)) {
                return false;
            }
            level = named->found >= level ? named->found + 1 : level;
        }
    }
    model->found = level;
    model->search = DONE;
    search->count--;
    return true;
}

/* On failure all levels stay: they are those of the scene before what was tried. */
bool scene_check_all_models(struct scene *scene, const char *place, struct error *err)
{
    struct search search = {.scene = scene, .place = place, .err = err};

    for (size_t i = 0; i < scene->models.count; i++) {
        scene->models.items[i]->search = UNSEEN;
    }
    for (size_t i = 0; i < scene->models.count; i++) {
        if (!find_level(&search, scene->models.items[i])) {
            return false;
        }
    }
    for (size_t i = 0; i < scene->models.count; i++) {
        scene->models.items[i]->level = scene->models.items[i]->found;
    }
    return true;
}

bool scene_check_models(struct scene *scene, const struct node *top, const char *place,
                        struct error *err)
{
    const struct resource *owner = node_owner(top);

    for (const struct node *node = owner ? top : NULL; node; node = node_next(node, top)) {
        const struct resource *named = node_model(scene, node);
        if (named && named->level >= owner->level) {
            return scene_check_all_models(scene, place, err);
        }
    }
    return true;
}
