/* SPDX-License-Identifier: MIT */
/* Which nodes are seen where some are isolated. Private to this folder. */
#ifndef RENDERER_FIELD_ISOLATE_H
#define RENDERER_FIELD_ISOLATE_H

#include "protocol/scene.h"

enum isolated_part {
    ISOLATED_AWAY,   /* neither of the others */
    ISOLATED_AROUND, /* something below it is isolated */
    ISOLATED_ITSELF, /* with all that is below it */
};

/* Nodes by their address; as short-lived as the state of the scene. */
struct isolation;

/* What holds a model with such a node is around it too. NULL where the scene has none of the ids,
 * or there are none: nothing is isolated. */
struct isolation *isolation_create(const struct scene *scene, const char *const *ids, size_t count);
void isolation_destroy(struct isolation *isolation); /* NULL: nothing */
enum isolated_part isolation_part(const struct isolation *isolation, const struct node *node);

#endif
