/* SPDX-License-Identifier: MIT */
/* Numbers that an instance of a model has of its own: the nodes of the model's tree as they are in
 * this instance. Private to this folder. */
#ifndef RENDERER_FIELD_INSTANCE_H
#define RENDERER_FIELD_INSTANCE_H

#include "protocol/limits.h"
#include "protocol/scene.h"

/* What the innermost instance around sets. Points into its node, which has to stay. */
struct instance_values {
    struct instance_value {
        struct model_target target;
        const struct param *row;
        const struct value *value;
    } set[LIMIT_DECLARED];
    size_t count;
};

/* Of an instance of the model. */
struct instance_values instance_values_of(const struct scene *scene, const struct node *instance,
                                          const struct resource *model);

/* A node with these numbers: itself, or a copy of its own numbers in `room`, which has all else of
 * the node. `values` may be NULL: it is in no instance. The room is to be finished. */
struct instance_room {
    struct node node;
    struct value *values[2]; /* owned; of transform and params, NULL: the node's */
};
const struct node *instance_node(const struct instance_values *values, const struct node *node,
                                 struct instance_room *room);
void instance_room_finish(struct instance_room *room);

#endif
