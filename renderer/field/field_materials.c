/* SPDX-License-Identifier: MIT */
/* The table of materials, and the shaders of users that they are made by. */
#include "field_materials.h"

#include <string.h>

#include "field_code.h"

size_t field_material_slot(const struct scene *scene, const char *name)
{
    const struct resource *found = resource_find(&scene->materials, name);
    for (size_t i = 0; found && i < scene->materials.count; i++) {
        if (scene->materials.items[i] == found) {
            return i + 1;
        }
    }
    return 0;
}

static void put_color(float *to, const struct record *record, const char *name)
{
    const double *color = record_vector(record, name);
    for (int i = 0; i < 3; i++) {
        to[i] = (float)color[i];
    }
}

static void put_phong(float *to, const struct record *record)
{
    put_color(to, record, "diffuse");
    to[3] = (float)record_number(record, "shininess");
    put_color(to + 4, record, "specular");
    put_color(to + 8, record, "emission");
    put_color(to + 12, record, "ambient");
}

/* Nothing but what its shader gives. */
static void put_custom(struct builder *b, uint32_t vec4, const struct resource *material,
                       int shader)
{
    float *to = b->field->numbers + 4 * (size_t)vec4;
    bool unlit = record_is(&material->shader->record, "lighting", "unlit");
    const struct record *own = &material->record;
    uint32_t arguments = builder_add_arguments(b, SDF_NUMBERS_MAX);
    for (int i = 0; i < 3; i++) {
        to[12 + i] = unlit ? 0 : 1;
    }
    to[3] = 1;
    to[FIELD_SHADER] = (float)(shader + 1);
    to[FIELD_UNLIT] = unlit;
    builder_put_params(b, own->type->params, own->values, NULL, 1, vec4 + FIELD_MATERIAL_VEC4S, 0,
                       arguments);
}

/* The buffer's size is part of the shape; padded, it leaves room for some more materials. */
enum { PADDING = 256 };

/* Compiles the shaders that are used; `out_shaders` tells for each material which, -1: none. */
static void add_shaders(struct builder *b, int *out_shaders)
{
    const struct resource_list *materials = &b->scene->materials;
    size_t most = 0;
    for (size_t i = 0; i < materials->count; i++) {
        const struct resource *material = materials->items[i], *shader = material->shader;
        out_shaders[i] = -1;
        if (shader && material->users > 0) {
            char place[ERROR_PLACE_BYTES];
            snprintf(place, sizeof place, "/shaders/%s/code", shader->name);
            out_shaders[i] = field_code_add(b, CODE_SHADE, record_text(&shader->record, "code"),
                                            material->record.type->params, place);
        }
        if (out_shaders[i] >= 0) {
            size_t vec4s = (size_t)b->field->shaders[out_shaders[i]].vec4s;
            most = vec4s > most ? vec4s : most;
        }
    }
    b->field->material_stride = FIELD_MATERIAL_VEC4S + most;
}

void field_add_materials(struct builder *b)
{
    struct field *field = b->field;
    const struct resource_list *materials = &b->scene->materials;
    int shaders[LIMIT_MATERIALS];
    add_shaders(b, shaders);
    field->material_count = materials->count;
    field->material_base = builder_add_vec4s(b, (materials->count + 1) * field->material_stride);
    struct record standard;
    record_init(&standard, record_type_in(shader_types, "phong"));
    put_phong(field->numbers + 4 * field->material_base, &standard);
    for (size_t i = 0; i < materials->count; i++) {
        const struct resource *material = materials->items[i];
        size_t vec4 = field->material_base + (i + 1) * field->material_stride;
        if (shaders[i] >= 0) {
            put_custom(b, (uint32_t)vec4, material, shaders[i]);
        } else {
            put_phong(field->numbers + 4 * vec4, strcmp(material->record.type->name, "phong") == 0 ? &material->record : &standard);
        }
    }
    record_finish(&standard);
    builder_place_points(b);
    builder_add_vec4s(b, (PADDING - field->vec4_count % PADDING) % PADDING);
}
