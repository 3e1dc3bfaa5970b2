/* SPDX-License-Identifier: MIT */
/* The parts of a scene as scene*.c, resource.c and edit*.c build and change them. Private to this
 * layer: others change a scene by edits only. */
#ifndef PROTOCOL_SCENE_INTERNAL_H
#define PROTOCOL_SCENE_INTERNAL_H

#include "scene.h"

#define SCENE_FORMAT "fieldcast/1"

/* --- kinds of resources: what a document has beside the tree (resource.c) --- */

struct resource_kind {
    const char *list;    /* member of the document, and first part of places: "materials" */
    const char *item;    /* one of them: "material" */
    const char *user;    /* what names it: "node"; NULL: nothing does */
    size_t offset;       /* of the list in struct scene */
    size_t limit;        /* most of a scene */
    bool array;          /* the list is an array of objects with ids, not an object */
    int named_by;        /* the enum param_type of values that name one; 0: none */
    const char *type;    /* member that chooses a row of `table`; NULL: `table` is the row */
    const char *values;  /* member with the record's values; NULL: they stand beside the type */
    const char *extends; /* node type whose rows its declared ones follow; NULL: none */
    const struct record_type *table;
};

/* In the order in which they are read and printed: what is named comes first. The end has no
 * list. */
extern const struct resource_kind resource_kinds[];

struct resource_list *resource_list_of(const struct resource_kind *kind, struct scene *scene);
const struct resource_kind *resource_kind_find(const char *list); /* NULL: none */
/* The kind that values of this type name; NULL: they name nothing. */
const struct resource_kind *resource_kind_named_by(enum param_type type);

struct resource *resource_create(const char *name, const struct record_type *type);
/* NULL is fine. Nobody may use it any more. */
void resource_destroy(struct resource *resource);
void resource_list_insert(struct resource_list *list, struct resource *resource, size_t position);
void resource_list_remove(struct resource_list *list, struct resource *resource);
size_t resource_list_position(const struct resource_list *list, const struct resource *resource);
/* The row that a light's type or a material's shader means; `*out_shader` is the document's own
 * shader, or NULL. NULL and `err` where there is none. */
const struct record_type *resource_type(const struct scene *scene, const struct resource_kind *kind,
                                        const char *name, struct resource **out_shader,
                                        const char *place, struct error *err);
/* Counts a material in or out (`by` 1 or -1) among the users of its shader. */
void resource_count_user(struct resource *material, int by);
/* Index of the row that declares parameters; -1: none. */
int resource_rows(const struct record_type *type);
/* Checks declarations for a resource of this kind, beyond what record_set does. */
bool resource_check_rows(const struct resource_kind *kind, const cJSON *rows, const char *place,
                         struct error *err);
/* From the rows that the record holds. */
struct declared_params *resource_define(const struct resource_kind *kind,
                                        const struct resource *resource);

/* --- reading and printing (scene_json.c, resource_json.c, scene_print.c) --- */

/* A subtree that is not part of the scene yet: ids may be missing, what it names but primitives
 * unknown. `place` is what messages call a node without an id. NULL and `err` on failure. */
struct node *node_read(const struct scene *scene, const cJSON *json, const char *place,
                       struct error *err);
/* `name` NULL: a light gets its id or the first that is free. Not part of the scene yet; a model
 * has no tree yet. `place` is the resource's. */
struct resource *resource_read(const struct scene *scene, const struct resource_kind *kind,
                               const char *name, const cJSON *json, const char *place,
                               struct error *err);
/* Reads a model's tree, once what its instances name is known; others have none. The tree is not
 * part of the scene yet. */
bool resource_read_tree(const struct scene *scene, struct resource *resource,
                        const struct resource_kind *kind, const cJSON *json, const char *place,
                        struct error *err);
cJSON *resource_json(const struct resource_kind *kind, const struct resource *resource);
/* Reads the member of an object into the record, if it is there. */
bool scene_read_record(struct record *record, const cJSON *json, const char *place,
                       const char *member, struct error *err);
/* Reads an id; `json` NULL: absent, `*out` stays NULL. */
bool scene_read_id(const cJSON *json, const char **out, const char *place, struct error *err);
/* Adds the record as an object, unless nothing in it is set. */
void scene_add_record(cJSON *object, const char *name, const struct record *record);
/* Fills `err` for a type that the registry does not have, with the nearest; false. */
bool node_type_unknown(const char *name, const char *place, struct error *err);

/* --- single nodes and subtrees (scene_node.c) --- */

struct node *node_create(const struct node_type *type, const struct record_type *params);
/* With everything below; NULL is fine. The subtree is not part of a scene (any more). */
void node_destroy(struct node *node);
/* The rows of a node of this type whose parameters are `params`: the type's own, or those of the
 * primitive or model that is named. */
const struct record_type *node_params_type(const struct scene *scene, const struct node_type *type,
                                           const struct record *params);
/* Nodes of the subtree. */
size_t node_count(const struct node *node);
/* The node's level, counted from its root (1: the root). */
size_t node_depth(const struct node *node);
void node_add_child(struct node *parent, struct node *child, size_t position);
void node_remove_child(struct node *child);
/* To another parent or place, counted without the node. */
void node_move(struct node *node, struct node *parent, size_t position);

/* --- what is part of a scene (scene.c, scene_tree.c, scene_models.c) --- */

struct node_index {
    void *nodes;               /* search tree by id */
    size_t next[NODE_NUMBERS]; /* for each type's number: those below are not given out */
};

struct scene *scene_create_without_root(void); /* only until it gets one or is destroyed */
bool scene_index_node(struct scene *scene, struct node *node); /* false: the id is in use */

/* Makes a subtree part of the scene at `position` under `parent`, or with `parent` NULL as the tree
 * of a model that is in its list; or refuses: id in use, unknown name, a limit, models in a circle.
 * Missing ids are filled in. On failure the subtree is the caller's as before, but its filled-in
 * ids stay. `place` is the parent's, for limits. */
bool scene_attach(struct scene *scene, struct node *node, struct node *parent, size_t position,
                  const char *place, struct error *err);
/* The same for all trees of a new scene, that of the scene and those of its models, which stand in
 * their places. On failure the scene can only be destroyed. */
bool scene_attach_all(struct scene *scene, struct error *err);
/* Takes a subtree out; the caller owns it then. Not for the scene's root. */
void scene_detach(struct scene *scene, struct node *node);
/* Another parent or place. Refuses what would be nested too deep, among too many siblings, or
 * models in a circle. */
bool scene_move(struct scene *scene, struct node *node, struct node *parent, size_t position,
                const char *place, struct error *err);
/* A resource with all that belongs to it: a model's tree, the use of a shader. */
bool scene_attach_resource(struct scene *scene, const struct resource_kind *kind,
                           struct resource *resource, size_t position, const char *place,
                           struct error *err);
void scene_detach_resource(struct scene *scene, const struct resource_kind *kind,
                           struct resource *resource);

/* Refuses a name that nothing of the kind has; "" is fine. */
bool scene_check_name(const struct scene *scene, const struct resource_kind *kind, const char *name,
                      const char *place, struct error *err);
/* Counts the node in or out (`by` 1 or -1) among the users of what it names. */
void scene_count_user(struct scene *scene, const struct node *node, int by);

/* Refuses a subtree that is in its place where models would name each other in a circle. */
bool scene_check_models(struct scene *scene, const struct node *node, const char *place,
                        struct error *err);
bool scene_check_all_models(struct scene *scene, const char *place, struct error *err);

/* --- what parameters of models set (scene_targets.c) --- */

/* Whether all that `declared` sets is in the model's tree, and takes what the rows accept. `place`
 * is that of the rows. */
bool scene_check_targets(const struct scene *scene, const struct resource *model,
                         const struct declared_params *declared, const char *place,
                         struct error *err);
/* Refuses to take a subtree out of its tree where a parameter sets something in it. */
bool scene_check_untargeted(const struct scene *scene, const struct node *top, const char *place,
                            struct error *err);
/* Refuses other rows for a node's parameters where a parameter sets what these do not have. */
bool scene_check_retyped(const struct scene *scene, const struct node *node,
                         const struct record_type *params, const char *place, struct error *err);
/* The same for all nodes whose rows are `old`. */
bool scene_check_all_retyped(const struct scene *scene, const struct record_type *old,
                             const struct record_type *params, const char *place,
                             struct error *err);

#endif
