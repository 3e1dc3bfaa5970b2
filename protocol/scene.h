/* SPDX-License-Identifier: MIT */
/* The scene document in memory: a tree of nodes plus named resources, every value checked.
 * Not thread-safe; only the owner of a scene uses it. */
#ifndef PROTOCOL_SCENE_H
#define PROTOCOL_SCENE_H

#include <stddef.h>
#include <stdint.h>

#include "declared_params.h"
#include "nodes.h"

struct node {
    char *id;
    const struct node_type *type;
    struct record common;    /* node_common_type */
    struct record transform; /* transform_type */
    struct record params;    /* type->record, or with what its primitive or model declares behind */
    struct node *parent;     /* NULL for the root of the scene or of a model */
    struct node **children;
    size_t child_count;
    size_t height;                /* levels of the subtree; 1: no children */
    const struct resource *model; /* whose root it is; else NULL */
    size_t last_position;         /* private to scene_node.c */
};

/* Something with a name of its own beside the tree. */
struct resource {
    char *name; /* a light's id */
    /* Of a light: its type's row in light_types. Of a material: its shader's row in shader_types,
     * or what a shader of the document declares. Else primitive_type, shader_type, model_type. */
    struct record record;
    size_t users;            /* nodes or materials that name it */
    struct resource *shader; /* a material's, where it is one of the document's; else NULL */
    struct declared_params *declared; /* of a primitive, shader or model; else NULL */
    struct node *root;                /* of a model; else NULL */
    size_t level, found;              /* of a model; private to scene_models.c */
    int search;                       /* the same */
};

struct resource_list {
    struct resource **items;
    size_t count;
    void *names; /* search tree, private to scene.c */
};

struct node_index; /* id -> node, private to scene.c */

struct scene {
    struct record info, camera, environment, render;
    struct resource_list lights, volumes, materials, primitives, shaders, models;
    struct node *root; /* the roots of models stand in `models`; all nodes share one index */
    size_t node_count;
    struct node_index *index;
};

/* Strictly reads a document; NULL and `err` when it breaks a rule. A node without an id gets the
 * first free of TYPE-1, TYPE-2, ..., models' nodes first; a number is not used again while the
 * scene is in memory. Caller destroys. */
struct scene *scene_parse(const char *text, size_t length, struct error *err);
/* The same of what scene_print has written, which may be longer (json_parse_printed). */
struct scene *scene_parse_printed(const char *text, size_t length, struct error *err);
struct scene *scene_read(const cJSON *document, struct error *err);
struct scene *scene_create_empty(void);
struct scene *scene_copy(const struct scene *scene);
void scene_destroy(struct scene *scene);

/* The canonical text: parse(print(s)) equals s, and print(parse(print(s))) is print(s) byte for
 * byte. Caller frees. `pretty` adds line breaks. */
char *scene_print(const struct scene *scene, bool pretty);
cJSON *scene_to_json(const struct scene *scene);
cJSON *node_to_json(const struct node *node);
/* A part as a document of its own, with the resources that it uses: a subtree, where it stands at
 * the origin, with the material that it inherits, visible even where it is hidden; or a sphere of a
 * material. Ids and names of nodes, camera, lights and the rest are left out, so parts that look
 * the same have the same text. NULL where it has more nodes than `most`, those of its models
 * included. Caller frees. */
cJSON *scene_part_of_node(const struct scene *scene, const struct node *node, size_t most);
cJSON *scene_part_of_material(const struct scene *scene, const struct resource *material);

struct node *scene_find(const struct scene *scene, const char *id);
struct resource *resource_find(const struct resource_list *list, const char *name);
/* What a node of type `model` or `field` names; NULL: nothing. */
const struct resource *node_model(const struct scene *scene, const struct node *node);
const struct resource *node_primitive(const struct scene *scene, const struct node *node);
/* The model in whose tree the node is; NULL: in the scene's own. */
const struct resource *node_owner(const struct node *node);
/* What a parameter of a model sets: a value of a node of its tree, or one component of that. */
struct model_target {
    const struct node *node;
    bool of_transform; /* else of its parameters */
    int index;         /* in the record */
    int component;     /* -1: all */
};
/* Of the declared row with this index. A scene's models have one for each. */
struct model_target model_target_of(const struct scene *scene, const struct resource *model,
                                    size_t row);
/* The value as the target takes it: `value` of the row is put into `out`, which holds a value of
 * the target's row. One number goes into all parts of what is uniform. */
void model_target_put(const struct model_target *target, const struct param *row,
                      const struct value *value, struct value *out);
/* Index among the parent's children; 0 for a root. */
size_t node_position(const struct node *node);
/* The next in pre-order below `top`, after `node`, which is `top` at first; NULL at the end. */
struct node *node_next(const struct node *node, const struct node *top);
/* The material that applies: own or inherited; NULL where none is named up to the tree's root. */
const struct resource *node_material(const struct scene *scene, const struct node *node);
/* Pre-order walk of the scene's own tree, hidden nodes too; `index` counts from 0 at the root. */
void scene_walk(const struct scene *scene,
                void (*visit)(void *data, const struct node *node, size_t index), void *data);

#endif
