/* SPDX-License-Identifier: MIT */
/* The parts of a scene as scene.c, scene_json.c and edit.c build and change them. Private to this
 * layer: others change a scene by edits only. */
#ifndef PROTOCOL_SCENE_PARTS_H
#define PROTOCOL_SCENE_PARTS_H

#include "scene.h"

#define SCENE_FORMAT "fieldcast/1"

struct scene *scene_create_without_root(void); /* only until it gets one or is destroyed */

struct node *node_create(const struct node_type *type);
/* With everything below; NULL is fine. The subtree is not part of a scene (any more). */
void node_destroy(struct node *node);
/* Levels of the subtree (1: no children), and of the node counted from the root (1: the root). */
size_t node_height(const struct node *node);
size_t node_depth(const struct node *node);
const char *node_material_name(const struct node *node);

/* Reads a subtree without a scene: ids may be missing, materials unknown. `place` is what messages
 * call a node without an id. NULL and `err` on failure. */
struct node *node_read(const cJSON *json, const char *place, struct error *err);

/* Adds to a subtree that is not part of a scene. */
void node_append(struct node *parent, struct node *child);

/* Makes a subtree part of the scene at `position` under `parent` (NULL: as the root), or refuses:
 * id in use, unknown material, a limit. Missing ids are filled in. On failure the subtree is the
 * caller's as before, but its filled-in ids stay. `place` is the parent's, for limits. */
bool scene_attach(struct scene *scene, struct node *node, struct node *parent, size_t position,
                  const char *place, struct error *err);
/* Takes a subtree out; the caller owns it then. Not for the root. */
void scene_detach(struct scene *scene, struct node *node);
/* Refuses what would be nested too deep or among too many siblings. */
bool scene_check_room(const struct node *parent, const struct node *node, const char *place,
                      struct error *err);
/* Another parent or place; what may not move there is checked before. */
void scene_move(struct node *node, struct node *parent, size_t position);
/* Refuses a name that no material has; "" is fine. */
bool scene_check_material(const struct scene *scene, const char *name, const char *place,
                          struct error *err);
/* Counts the node in or out (`by` 1 or -1) among the users of the material that it names. */
void scene_count_user(struct scene *scene, const struct node *node, int by);

struct resource *resource_create(const char *name, const struct record_type *type);
void resource_destroy(struct resource *resource);
/* `name` may be NULL: a light gets the first free id of its type. `place` is the resource's. */
struct resource *resource_read_light(const cJSON *json, const struct resource_list *lights,
                                     const char *place, struct error *err);
struct resource *resource_read_material(const char *name, const cJSON *json, const char *place,
                                        struct error *err);
cJSON *resource_light_json(const struct resource *light);
cJSON *resource_material_json(const struct resource *material);
void resource_list_insert(struct resource_list *list, struct resource *resource, size_t position);
void resource_list_remove(struct resource_list *list, struct resource *resource);
size_t resource_list_position(const struct resource_list *list, const struct resource *resource);

/* Fills `err` for a type that `table` or the registry does not have, with the nearest; false. */
bool node_type_unknown(const char *name, const char *place, struct error *err);
bool resource_type_unknown(const struct record_type *table, const char *name, const char *place,
                           struct error *err);

#endif
