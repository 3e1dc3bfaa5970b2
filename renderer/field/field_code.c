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
    *list = memory_resize(*list, *count + 1, sizeof **list);
    struct field_code *last = &(*list)[(*count)++];
    *last = (struct field_code){0};
    return last;
}

int field_code_add(struct builder *b, enum code_use use, const char *text,
                   const struct param *params, const char *place)
{
    struct field *field = b->field;
    bool distance = use == CODE_DISTANCE;
    struct field_code **list = distance ? &field->codes : &field->shaders;
    size_t *count = distance ? &field->code_count : &field->shader_count;
    for (size_t i = 0; i < *count; i++) {
        if ((*list)[i].text == text) {
            return (int)i;
        }
    }
    struct error err = {0};
    if (b->again) {
        b->failed = true;
        return -1;
    }
    struct code *code = code_compile(&(struct code_source){use, text, params}, &err);
    if (!code) {
        builder_fail(b, &err, place);
        return -1;
    }
    struct field_code *added = append(list, count);
    added->text = text;
    added->code = code;
    added->hash = hash_code(text, params);
    snprintf(added->place, sizeof added->place, "%s", place);
    struct field_place places[SDF_PARAMS_MAX];
    added->vec4s = field_layout(params, 0, places);
    while (params[added->place_count].name) {
        assert(added->place_count < LIMIT_DECLARED);
        added->places[added->place_count] = places[added->place_count];
        added->place_count++;
    }
    return (int)*count - 1;
}

bool field_call_of(const struct scene *scene, const struct node *node, struct field_call *out)
{
    const struct resource *primitive = node_primitive(scene, node);
    const struct record *source = primitive ? &primitive->record : &node->params;
    size_t first = record_type_count(&node->type->record);
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
    return *out->text != '\0';
}

int field_shader_numbers(const struct field *field, size_t slot, double *out_n)
{
    const float *block =
        field->numbers + 4 * (field->material_base + slot * field->material_stride);
    int shader = (int)block[FIELD_SHADER] - 1;
    int count = 0;
    for (int i = 0; shader >= 0 && i < field->shaders[shader].place_count; i++) {
        const struct field_place *place = &field->shaders[shader].places[i];
        const float *from = block + 4 * (FIELD_MATERIAL_VEC4S + place->vec4) + place->component;
        for (int c = 0; c < place->count; c++) {
            out_n[count++] = from[c];
        }
    }
    return shader;
}
