/* SPDX-License-Identifier: MIT */
#include "field_check.h"

#include <stdlib.h>

#include "field_code.h"
#include "protocol/memory.h"
#include "renderer/code/equation_expand.h"

static void check_equation(struct builder *b, const struct field_call *call)
{
    struct equation *equation = field_read_equation(b, call->text, call->place);

    if (equation && equation_degree(equation) < 0) {
        field_equation_add(b, equation, call->form, EQUATION_VECTORS, call->place);
    }
    free(equation);
}

static void check_tree(struct builder *b, const struct node *top)
{
    for (const struct node *node = top; node && !b->failed; node = node_next(node, top)) {
        struct field_call call;
        if (field_call_of(b->scene, node, &call)) {
            if (call.is_equation) {
                check_equation(b, &call);
            } else {
                field_code_add(b, CODE_DISTANCE, call.text, call.params, call.place);
            }
        }
    }
}

static void check_resources(struct builder *b, enum code_use use, const struct resource_list *list,
                            const char *list_name)
{
    for (size_t i = 0; i < list->count && !b->failed; i++) {
        const struct resource *resource = list->items[i];
        const struct declared_params *declared = resource->declared;
        const char *text = record_text(&resource->record, "code");
        char place[ERROR_PLACE_BYTES];
        snprintf(place, sizeof place, "/%s/%s/code", list_name, resource->name);
        if (*text) {
            field_code_add(b, use, text, declared->type.params + declared->first_declared, place);
        }
    }
}

bool field_check_code(const struct scene *scene, struct error *err)
{
    struct field *field = memory_alloc(1, sizeof *field);

    field->references = 1;
    struct builder builder = {.field = field, .scene = scene};
    check_tree(&builder, scene->root);
    for (size_t i = 0; i < scene->models.count; i++) {
        check_tree(&builder, scene->models.items[i]->root);
    }
    check_resources(&builder, CODE_DISTANCE, &scene->primitives, "primitives");
    check_resources(&builder, CODE_SHADE, &scene->shaders, "shaders");
    if (builder.failed) {
        *err = builder.err;
    }
    field_unref(field);
    return !builder.failed;
}
