/* SPDX-License-Identifier: MIT */
#include "field_check.h"

#include <stdlib.h>

#include "field_code.h"
#include "protocol/memory.h"
#include "renderer/code/equation_pole.h"

enum { LETTERS_MAX = 8 };

/* A wall is drawn at a pole, which no one has asked for. */
static void check_poles(struct builder *b, const struct node *node, const struct field_call *call,
                        struct error *out_warning)
{
    double letters[LETTERS_MAX], half[3], at[3];
    struct equation *equation = field_call_equation(b, call);

    for (int i = 0; equation_letters[i]; i++) {
        letters[i] = record_number(&node->params, equation_letters[i]);
    }
    for (int i = 0; i < 3; i++) {
        half[i] = call->form.ball ? record_number(&node->params, "radius")
                                  : record_vector(&node->params, "size")[i] / 2;
    }
    if (equation && equation_pole(equation, letters, half, at)) {
        error_set(out_warning, ERROR_INVALID, call->place,
                  "changes its sign without being 0 near (%.3g, %.3g, %.3g): a pole or a jump, "
                  "where a wall is drawn",
                  at[0], at[1], at[2]);
    }
    free(equation);
}

static void check_tree(struct builder *b, const struct node *top, struct error *out_warning)
{
    for (const struct node *node = top; node && !b->failed; node = node_next(node, top)) {
        struct field_call call;
        if (!field_call_of(b->scene, node, &call)) {
            continue;
        }
        field_call_add(b, &call);
        if (call.is_equation && !b->failed && out_warning->kind == ERROR_NONE) {
            check_poles(b, node, &call, out_warning);
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

bool field_check_code(const struct scene *scene, struct error *out_warning, struct error *err)
{
    struct field *field = memory_alloc(1, sizeof *field);

    field->references = 1;
    struct builder builder = {.field = field, .scene = scene};
    check_tree(&builder, scene->root, out_warning);
    for (size_t i = 0; i < scene->models.count; i++) {
        check_tree(&builder, scene->models.items[i]->root, out_warning);
    }
    check_resources(&builder, CODE_DISTANCE, &scene->primitives, "primitives");
    check_resources(&builder, CODE_SHADE, &scene->shaders, "shaders");
    if (builder.failed) {
        *err = builder.err;
    }
    field_unref(field);
    return !builder.failed;
}
