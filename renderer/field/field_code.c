/* SPDX-License-Identifier: MIT */
/* Code: found, compiled once for each text, and where its parameters lie. */
#include "field_code.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

uint64_t field_text_hash(uint64_t state, const char *text)
{
    for (; *text; text++) {
        state = builder_hash(state, (unsigned char)*text);
    }
    return builder_hash(state, 0);
}

static uint64_t hash_code(const char *text, const struct param *params)
{
    uint64_t state = field_text_hash(BUILDER_HASH_START, text);

    for (; params->name; params++) {
        state = field_text_hash(builder_hash(state, (uint32_t)params->type), params->name);
    }
    return state;
}

static struct field_code *append(struct field_code **list, size_t *count)
{
    *list = memory_one_more(*list, *count, sizeof **list);
    struct field_code *last = &(*list)[(*count)++];
    *last = (struct field_code){0};
    return last;
}

static struct field_code **list_of(struct field *field, enum code_use use, size_t **out_count)
{
    const bool distance = use == CODE_DISTANCE;

    *out_count = distance ? &field->code_count : &field->shader_count;
    return distance ? &field->codes : &field->shaders;
}

/* Where it is in the list; -1: nowhere, and the builder has failed if it makes no new ones. */
static int find(struct builder *b, enum code_use use, const char *text)
{
    size_t *count;

    struct field_code *const *list = list_of(b->field, use, &count);
    for (size_t i = 0; i < *count; i++) {
        if ((*list)[i].text == text) {
            return (int)i;
        }
    }
    b->failed = b->failed || b->again;
    return -1;
}

/* `text` is what it is found by; `source`, what is compiled. */
static int add(struct builder *b, const char *text, const struct code_source *source,
               const char *place)
{
    size_t *count;
    struct field_code **list = list_of(b->field, source->use, &count);
    struct error err = {0};
    struct code *code = code_compile(source, &err);

    if (!code) {
        builder_fail(b, &err, place);
        return -1;
    }
    struct field_code *added = append(list, count);
    added->text = text;
    added->own = source->ours;
    added->code = code;
    added->hash = hash_code(source->text, source->params);
    snprintf(added->place, sizeof added->place, "%s", place);
    struct param_slot places[SDF_PARAMS_MAX];
    added->vec4s = field_layout(source->params, 0, places);
    while (source->params[added->place_count].name) {
        assert(added->place_count < SDF_PARAMS_MAX);
        added->places[added->place_count] = places[added->place_count];
        added->place_count++;
    }
    return (int)*count - 1;
}

int field_code_add(struct builder *b, enum code_use use, const char *text,
                   const struct param *params, const char *place)
{
    const int found = find(b, use, text);

    return found >= 0 || b->failed
               ? found
               : add(b, text, &(struct code_source){use, text, params, false}, place);
}

static void fail_equation(struct builder *b, const struct equation_errors *errors,
                          const char *place)
{
    struct error err = {0};

    equation_errors_tell(errors, ERROR_COMPILE, "", &err);
    builder_fail(b, &err, place);
}

struct equation *field_read_equation(struct builder *b, const char *text, const char *place)
{
    struct equation_errors errors;
    struct equation *equation = equation_read(text, equation_letters, &errors);

    if (!equation) {
        fail_equation(b, &errors, place);
    }
    return equation;
}

/* Code is bounded by what it takes to run it. `besides`: why it is not taken as a polynomial. */
static bool check_operations(struct builder *b, const struct equation *equation,
                             const char *besides, const char *place)
{
    struct error err = {0};

    if (equation->count <= LIMIT_EQUATION_OPERATIONS) {
        return true;
    }
    error_set_at(&err, ERROR_LIMIT, "", 1, 1,
                 "%zu different operations%s, above the maximum %d (equation_operations)",
                 equation->count, besides, LIMIT_EQUATION_OPERATIONS);
    builder_fail(b, &err, place);
    return false;
}

/* Found by what is compiled: one node may have several forms, and many nodes one text. */
static int find_own(const struct field *field, uint64_t hash)
{
    for (size_t i = 0; i < field->code_count; i++) {
        if (field->codes[i].own && field->codes[i].hash == hash) {
            return (int)i;
        }
    }
    return -1;
}

int field_equation_add(struct builder *b, const struct equation *equation,
                       struct equation_form form, int vectors, const char *place)
{
    char no_polynomial[80];
    struct param params[EQUATION_VECTORS + 1];

    snprintf(no_polynomial, sizeof no_polynomial,
             " and no polynomial of degree %d at most (polynomial_degree)",
             LIMIT_POLYNOMIAL_DEGREE);
    if (!check_operations(b, equation, no_polynomial, place)) {
        return -1;
    }
    char *text = equation_code(equation, form);
    equation_code_params(vectors, params);
    int index = find_own(b->field, hash_code(text, params));
    b->failed = b->failed || (index < 0 && b->again);
    if (index < 0 && !b->failed) {
        index = add(b, NULL, &(struct code_source){CODE_DISTANCE, text, params, true}, place);
    }
    free(text);
    return index;
}

static int add_map(struct builder *b, const char *text, const char *shade,
                   const struct param *params, const char *place)
{
    struct equation *equation = field_read_equation(b, text, place);

    if (!equation || !check_operations(b, equation, "", place)) {
        free(equation);
        return -1;
    }
    char *whole = equation_function_code(equation, equation_letters, shade);
    const struct code_source source = {CODE_SHADE, whole, params, true};
    const int index = add(b, text, &source, place);
    free(whole);
    free(equation);
    return index;
}

int field_map_add(struct builder *b, const char *equation, const char *shade,
                  const struct param *params, const char *place)
{
    const int found = find(b, CODE_SHADE, equation);

    return found >= 0 || b->failed ? found : add_map(b, equation, shade, params, place);
}

/* Its numbers begin with `size`. */
static void call_equation(const struct node *node, struct field_call *out)
{
    const struct record *params = &node->params;
    const struct param *first = params->type->params;

    while (strcmp(first->name, "size") != 0) {
        first++;
    }
    const double across = 2 * record_number(params, "radius");
    *out = (struct field_call){.text = record_text(params, "equation"),
                               .is_equation = true,
                               .form = {.sheet = record_is(params, "mode", "sheet"),
                                        .ball = record_is(params, "clip", "ball")},
                               .ball = {across, across, across},
                               .params = first,
                               .values = params->values + (first - params->type->params),
                               .lipschitz = 1,
                               .size = record_vector(params, "size")};
    out->extent = 0.5 * hypot(hypot(out->size[0], out->size[1]), out->size[2]);
    if (out->form.ball) {
        out->size = out->ball;
        out->extent = across / 2;
    }
    snprintf(out->place, sizeof out->place, "/nodes/%s/params/equation", node->id);
}

static void call_code(const struct scene *scene, const struct node *node, struct field_call *out)
{
    const struct resource *primitive = node_primitive(scene, node);
    const struct record *source = primitive ? &primitive->record : &node->params;
    const size_t first = record_type_count(&node->type->record);
    static const struct param nothing = {.name = NULL};

    *out = (struct field_call){.text = record_text(source, "code"),
                               .lipschitz = record_number(source, "lipschitz"),
                               .size = record_vector(source, "size"),
                               .params = &nothing,
                               .values = node->params.values};
    if (primitive) {
        out->params = node->params.type->params + first;
        out->values = node->params.values + first;
        snprintf(out->place, sizeof out->place, "/primitives/%s/code", primitive->name);
    } else {
        snprintf(out->place, sizeof out->place, "/nodes/%s/params/code", node->id);
    }
}

bool field_call_of(const struct scene *scene, const struct node *node, struct field_call *out)
{
    if (node->type->kind == KIND_CODE) {
        call_code(scene, node, out);
    } else if (node->type->kind == KIND_EQUATION) {
        call_equation(node, out);
    } else {
        return false;
    }
    return *out->text != '\0';
}

int field_shader_numbers(const struct field *field, size_t slot, double *out_n)
{
    const float *block = field->params + 4 * (field->material_base + slot * field->material_stride);
    const int shader = (int)block[FIELD_SHADER] - 1;
    int count = 0;

    for (int i = 0; shader >= 0 && i < field->shaders[shader].place_count; i++) {
        const struct param_slot *place = &field->shaders[shader].places[i];
        const float *from = block + 4 * (FIELD_MATERIAL_VEC4S + place->vec4) + place->component;
        for (int c = 0; c < place->count; c++) {
            out_n[count++] = from[c];
        }
    }
    return shader;
}
