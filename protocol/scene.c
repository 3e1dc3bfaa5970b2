/* SPDX-License-Identifier: MIT */
/* The scene as a whole: made, copied, destroyed, walked. */
#include "scene.h"

#include <search.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "scene_internal.h"

static void keep(void *item)
{
    (void)item;
}

struct scene *scene_create_without_root(void)
{
    struct scene *scene = memory_alloc(1, sizeof *scene);

    record_init(&scene->info, &scene_info_type);
    record_init(&scene->camera, &camera_type);
    record_init(&scene->environment, &environment_type);
    record_init(&scene->render, &render_type);
    scene->index = memory_alloc(1, sizeof *scene->index);
    return scene;
}

struct scene *scene_create_empty(void)
{
    struct scene *scene = scene_create_without_root();
    const struct node_type *type = node_type_find("union");

    scene->root = node_create(type, &type->record);
    scene->root->id = memory_text("root");
    scene_attach_all(scene, NULL);
    return scene;
}

/* --- copying --- */

/* `scene` is the copy: primitives and models have to be in it already. */
static struct node *copy_node(struct scene *scene, const struct node *from)
{
    struct node *to = memory_alloc(1, sizeof *to);

    to->id = memory_text(from->id);
    to->type = from->type;
    to->height = 1;
    record_copy(&to->common, &from->common);
    record_copy(&to->transform, &from->transform);
    record_copy(&to->params, &from->params);
    to->params.type = node_params_type(scene, to->type, &to->params);
    scene_index_node(scene, to);
    for (size_t i = 0; i < from->child_count; i++) {
        node_add_child(to, copy_node(scene, from->children[i]), i);
    }
    return to;
}

static struct resource *copy_resource(struct scene *scene, const struct resource_kind *kind,
                                      const struct resource *from)
{
    struct resource *to = memory_alloc(1, sizeof *to);

    to->name = memory_text(from->name);
    to->users = from->users;
    to->level = from->level;
    record_copy(&to->record, &from->record);
    if (from->declared) {
        to->declared = resource_define(kind, to);
    }
    if (from->shader) {
        to->shader = resource_find(&scene->shaders, from->shader->name);
        to->record.type = &to->shader->declared->type;
    }
    return to;
}

/* Once all models are there. */
static void copy_trees(struct scene *copy, const struct scene *from)
{
    for (size_t i = 0; i < from->models.count; i++) {
        struct resource *model = copy->models.items[i];
        model->root = copy_node(copy, from->models.items[i]->root);
        model->root->model = model;
    }
}

struct scene *scene_copy(const struct scene *scene)
{
    struct scene *copy = memory_alloc(1, sizeof *copy);

    record_copy(&copy->info, &scene->info);
    record_copy(&copy->camera, &scene->camera);
    record_copy(&copy->environment, &scene->environment);
    record_copy(&copy->render, &scene->render);
    copy->index = memory_alloc(1, sizeof *copy->index);
    memcpy(copy->index->next, scene->index->next, sizeof copy->index->next);
    for (const struct resource_kind *kind = resource_kinds; kind->list; kind++) {
        const struct resource_list *from = resource_list_of(kind, (struct scene *)scene);
        for (size_t i = 0; i < from->count; i++) {
            resource_list_insert(resource_list_of(kind, copy),
                                 copy_resource(copy, kind, from->items[i]), i);
        }
    }
    copy_trees(copy, scene);
    copy->root = copy_node(copy, scene->root);
    copy->node_count = scene->node_count;
    return copy;
}

/* --- the end --- */

/* Trees go before the rows that instances in them have. */
static void finish_list(struct resource_list *list)
{
    tdestroy(list->names, keep);
    for (size_t i = 0; i < list->count; i++) {
        node_destroy(list->items[i]->root);
        list->items[i]->root = NULL;
    }
    for (size_t i = 0; i < list->count; i++) {
        resource_destroy(list->items[i]);
    }
    free(list->items);
}

void scene_destroy(struct scene *scene)
{
    if (!scene) {
        return;
    }
    tdestroy(scene->index->nodes, keep);
    free(scene->index);
    node_destroy(scene->root);
    const struct resource_kind *kind = resource_kinds;
    while (kind->list) {
        kind++;
    }
    while (kind-- > resource_kinds) { /* what is named goes last */
        finish_list(resource_list_of(kind, scene));
    }
    record_finish(&scene->info);
    record_finish(&scene->camera);
    record_finish(&scene->environment);
    record_finish(&scene->render);
    free(scene);
    memory_settle();
}

void scene_walk(const struct scene *scene,
                void (*visit)(void *data, const struct node *node, size_t index), void *data)
{
    size_t index = 0;

    for (const struct node *node = scene->root; node; node = node_next(node, scene->root)) {
        visit(data, node, index++);
    }
}
