/* SPDX-License-Identifier: MIT */
/* Numbers of instances in their places. */
#include "field_instance.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

struct instance_values instance_values_of(const struct scene *scene, const struct node *instance,
                                          const struct resource *model)
{
    struct instance_values own = {.count = 0};
    const struct record *params = &instance->params;

    for (size_t i = model->declared->first_declared; params->type->params[i].name; i++) {
        if (params->values[i].set) {
            own.set[own.count++] =
                (struct instance_value){.target = model_target_of(scene, model, i),
                                        .row = &params->type->params[i],
                                        .value = &params->values[i]};
        }
    }
    return own;
}

/* The values of the record, to be changed. Texts and points stay the node's. */
static struct value *open_record(struct record *record, struct value **owned)
{
    if (!*owned) {
        const size_t count = record_type_count(record->type);
        *owned = memory_alloc(count, sizeof **owned);
        memcpy(*owned, record->values, count * sizeof **owned);
        record->values = *owned;
    }
    return *owned;
}

const struct node *instance_node(const struct instance_values *values, const struct node *node,
                                 struct instance_room *room)
{
    room->values[0] = room->values[1] = NULL;
    for (size_t i = 0; values && i < values->count; i++) {
        const struct instance_value *own = &values->set[i];
        const struct model_target *target = &own->target;
        if (target->node != node) {
            continue;
        }
        if (!room->values[0] && !room->values[1]) {
            room->node = *node;
        }
        struct value *of = target->of_transform
                               ? open_record(&room->node.transform, &room->values[0])
                               : open_record(&room->node.params, &room->values[1]);
        model_target_put(target, own->row, own->value, &of[target->index]);
    }
    return room->values[0] || room->values[1] ? &room->node : node;
}

void instance_room_finish(struct instance_room *room)
{
    free(room->values[0]);
    free(room->values[1]);
}
