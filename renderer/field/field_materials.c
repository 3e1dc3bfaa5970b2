/* SPDX-License-Identifier: MIT */
/* The table of materials, and the shaders that they are made by. */
#include "field_materials.h"

#include <math.h>
#include <string.h>

#include "field_code.h"
#include "protocol/memory.h"
#include "renderer/code/shades.h"
#include "renderer/glsl/interface.h"

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

size_t field_floor_slot(const struct scene *scene)
{
    return scene->materials.count + 1;
}

/* --- materials of the registry --- */

static double transmission_of(const struct record *record)
{
    if (record_type_find(record->type, "opacity") >= 0) {
        return 1 - record_number(record, "opacity");
    }
    return record_type_find(record->type, "transmission") >= 0
               ? record_number(record, "transmission")
               : 0;
}

bool field_material_transmissive(const struct builder *b, size_t slot)
{
    const struct resource_list *materials = &b->scene->materials;
    const struct resource *material =
        slot > 0 && slot <= materials->count ? materials->items[slot - 1] : NULL;

    return material && (material->shader ? b->material_shaders[slot - 1].transmissive
                                         : transmission_of(&material->record) > 0);
}

static void put_vector(float *to, const struct record *record, const char *name)
{
    const double *vector = record_vector(record, name);

    for (int i = 0; i < 3; i++) {
        to[i] = (float)vector[i];
    }
}

/* Of what light meets inside, so much is left at least after the attenuation distance: any less
 * is black, and would take its place in the G-buffer from the other colours. */
#define LEFT_LEAST 1e-4
#define ABSORPTION_MAX 65000.0

/* Light falls by Beer and Lambert's law, exp(-absorption * way). */
static void put_inside(float *to, const struct record *record)
{
    const double *left = record_vector(record, "attenuation_color");
    const double way = record_number(record, "attenuation_distance");

    for (int i = 0; i < 3; i++) {
        const double absorption = log(1 / fmax(left[i], LEFT_LEAST)) / way;
        to[FIELD_ABSORPTION + i] = (float)fmin(absorption, ABSORPTION_MAX);
    }
    to[FIELD_TRANSMISSION] = (float)transmission_of(record);
    to[FIELD_IOR] = (float)record_number(record, "ior");
}

/* All of phong's but its colour. */
static void put_checker(float *to, const struct record *record)
{
    put_vector(to + FIELD_AMBIENT, record, "ambient");
    put_vector(to + FIELD_SPECULAR, record, "specular");
    put_vector(to + FIELD_EMISSION, record, "emission");
    to[FIELD_GLOSS] = (float)record_number(record, "shininess");
    to[FIELD_REFLECTIVITY] = (float)record_number(record, "reflectivity");
    put_inside(to, record);
}

static void put_phong(float *to, const struct record *record)
{
    put_vector(to + FIELD_DIFFUSE, record, "diffuse");
    put_checker(to, record);
}

/* What is reflected at normal incidence, of a metal its colour, else by Fresnel's equations. */
static void put_standard(float *to, const struct record *record)
{
    const double *base = record_vector(record, "base_color");
    const double metallic = record_number(record, "metallic"), ior = record_number(record, "ior");
    double reflected = (ior - 1) * (ior - 1) / ((ior + 1) * (ior + 1)), most = 0;

    for (int i = 0; i < 3; i++) {
        const double specular = reflected + (base[i] - reflected) * metallic;
        to[FIELD_DIFFUSE + i] = (float)(base[i] * (1 - metallic));
        to[FIELD_SPECULAR + i] = (float)specular;
        most = fmax(most, specular);
    }
    put_vector(to + FIELD_EMISSION, record, "emission");
    to[FIELD_GLOSS] = (float)record_number(record, "roughness");
    to[FIELD_REFLECTIVITY] = (float)most;
    put_inside(to, record);
}

static void put_unlit(float *to, const struct record *record)
{
    put_vector(to + FIELD_EMISSION, record, "color");
}

/* Those that have numbers of their own. */
static const struct {
    const char *shader;
    void (*put)(float *to, const struct record *record);
    enum surface_model model;
} rows[] = {
    {"phong", put_phong, MODEL_PHONG},     {"blinn", put_phong, MODEL_BLINN},
    {"checker", put_checker, MODEL_PHONG}, {"standard", put_standard, MODEL_STANDARD},
    {"unlit", put_unlit, MODEL_PHONG},
};

static void put_material(float *to, const struct record *record)
{
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (strcmp(rows[i].shader, record->type->name) == 0) {
            to[FIELD_MODEL] = (float)rows[i].model;
            rows[i].put(to, record);
        }
    }
}

/* What stands in a slot before: dull, and to be mixed with others without harm. */
static void put_nothing(float *to)
{
    for (int i = 0; i < 3; i++) {
        to[FIELD_AMBIENT + i] = 1;
    }
    to[FIELD_GLOSS] = 1;
    to[FIELD_IOR] = 1.5f;
}

static void put_default(float *to)
{
    struct record phong;

    record_init(&phong, record_type_in(shader_types, "phong"));
    put_nothing(to);
    put_material(to, &phong);
    record_finish(&phong);
}

static void put_floor(float *to, const struct record *environment)
{
    put_default(to);
    put_vector(to + FIELD_DIFFUSE, environment, "floor_color");
    to[FIELD_REFLECTIVITY] = (float)record_number(environment, "floor_reflectivity");
}

/* --- shaders --- */

void field_put_surface(double to[FIELD_MATERIAL_NUMBERS], const struct code_surface *surface)
{
    const double r = (surface->ior - 1) / (surface->ior + 1);
    const double f0 = fmax(r * r, surface->reflectivity);

    if (to[FIELD_UNLIT] > 0) {
        for (int i = 0; i < 3; i++) {
            to[FIELD_EMISSION + i] += surface->color[i] + surface->emission[i];
        }
        return;
    }
    double most = 0;
    for (int i = 0; i < 3; i++) {
        const double reflected = f0 + (surface->color[i] - f0) * surface->metallic;
        to[FIELD_DIFFUSE + i] = surface->color[i] * (1 - surface->metallic);
        to[FIELD_SPECULAR + i] = reflected;
        to[FIELD_EMISSION + i] = surface->emission[i];
        to[FIELD_AMBIENT + i] = 1;
        to[FIELD_ABSORPTION + i] = surface->absorption[i];
        most = fmax(most, reflected);
    }
    to[FIELD_GLOSS] = surface->roughness;
    to[FIELD_REFLECTIVITY] = most;
    /* What may be transmissive always is a little: see glsl/mixture.glsl. */
    to[FIELD_TRANSMISSION] =
        fmax(surface->transmission, to[FIELD_TRANSMISSION] > 0 ? 1.0 / 255 : 0);
    to[FIELD_IOR] = surface->ior;
    to[FIELD_MODEL] = MODEL_STANDARD;
}

static struct builder_material_shader material_shader_of(const struct resource *material)
{
    const struct resource *shader = material->shader;
    const struct shade *own = shader ? NULL : shade_find(material->record.type->name);
    struct builder_material_shader material_shader = {.own = own, .index = -1};

    if (material->users > 0 && shader) {
        material_shader.text = record_text(&shader->record, "code");
        material_shader.unlit = record_is(&shader->record, "lighting", "unlit");
    } else if (material->users > 0 && own) {
        const char *function = own->function ? record_text(&material->record, own->function) : "";

        material_shader.text = !own->function ? own->text : *function ? function : "y";
        material_shader.unlit = own->unlit;
        material_shader.first = own->function != NULL;
    }
    return material_shader;
}

static int add_code(struct builder *b, const struct resource *material,
                    const struct builder_material_shader *material_shader)
{
    const struct param *params = material->record.type->params + material_shader->first;
    const struct shade *own = material_shader->own;
    char place[ERROR_PLACE_BYTES] = "";

    if (own && own->function) {
        snprintf(place, sizeof place, "/materials/%s/properties/%s", material->name, own->function);
        return field_map_add(b, material_shader->text, own->text, params, place);
    }
    if (material->shader) {
        snprintf(place, sizeof place, "/shaders/%s/code", material->shader->name);
    }
    return field_code_add(b, CODE_SHADE, material_shader->text, params, place);
}

static void add_material_shader(struct builder *b, const struct resource *material,
                                struct builder_material_shader *material_shader)
{
    material_shader->index = add_code(b, material, material_shader);
    if (material_shader->index >= 0) {
        struct field_code *shader = &b->field->shaders[material_shader->index];
        shader->own = material_shader->own != NULL;
        material_shader->transmissive =
            !material_shader->unlit && code_is_transmissive(shader->code);
    }
}

/* And leaves room for what they read. */
void field_add_material_shaders(struct builder *b)
{
    const struct resource_list *materials = &b->scene->materials;
    size_t most = 0;

    b->material_shaders = memory_alloc(materials->count + 1, sizeof *b->material_shaders);
    for (size_t i = 0; i < materials->count; i++) {
        struct builder_material_shader *material_shader = &b->material_shaders[i];
        *material_shader = material_shader_of(materials->items[i]);
        if (material_shader->text) {
            add_material_shader(b, materials->items[i], material_shader);
        }
        if (material_shader->index >= 0) {
            const size_t vec4s = (size_t)b->field->shaders[material_shader->index].vec4s;
            most = vec4s > most ? vec4s : most;
        }
    }
    b->field->material_stride = FIELD_MATERIAL_VEC4S + most;
}

/* What the shader reads, where its colour goes, and what it may do besides. */
static void put_painter(struct builder *b, uint32_t vec4, const struct record *record,
                        const struct builder_material_shader *material_shader)
{
    const struct field_code *shader = &b->field->shaders[material_shader->index];
    float *to = b->field->params + 4 * (size_t)vec4;
    const uint32_t arguments = builder_add_arguments(b, SDF_NUMBERS_MAX);

    to[FIELD_SHADER] = (float)(material_shader->index + 1);
    to[FIELD_UNLIT] = material_shader->unlit;
    if (!material_shader->unlit && code_gives_surface(shader->code)) {
        to[FIELD_REFLECTIVITY] = 1;
        to[FIELD_TRANSMISSION] = material_shader->transmissive;
    }
    builder_put_params(b, record->type->params + material_shader->first,
                       record->values + material_shader->first, NULL, 1,
                       vec4 + FIELD_MATERIAL_VEC4S, 0, arguments);
}

/* The buffer's size is part of the shape; padded, it leaves room for some more materials. */
enum { PADDING = 256 };

static float *slot_numbers(const struct builder *b, size_t slot)
{
    const struct field *field = b->field;

    return field->params + 4 * (field->material_base + slot * field->material_stride);
}

void field_put_floor(const struct builder *b)
{
    put_floor(slot_numbers(b, field_floor_slot(b->scene)), &b->scene->environment);
}

void field_put_material(struct builder *b, size_t slot)
{
    const struct resource *material = b->scene->materials.items[slot - 1];
    const struct builder_material_shader *material_shader = &b->material_shaders[slot - 1];
    float *to = slot_numbers(b, slot);

    put_nothing(to);
    put_material(to, &material->record);
    if (material_shader->index >= 0) {
        put_painter(b, (uint32_t)(b->field->material_base + slot * b->field->material_stride),
                    &material->record, material_shader);
    }
}

size_t field_material_arguments(const struct builder *b, size_t slot)
{
    size_t before = 0;

    for (size_t i = 1; i < slot; i++) {
        before += b->material_shaders[i - 1].index >= 0;
    }
    return before * SDF_NUMBERS_MAX;
}

void field_add_materials(struct builder *b)
{
    struct field *field = b->field;
    const size_t count = b->scene->materials.count;

    field->material_count = count;
    field->material_base = builder_add_vec4s(b, (count + 2) * field->material_stride);
    put_default(slot_numbers(b, 0));
    field_put_floor(b);
    for (size_t slot = 1; slot <= count; slot++) {
        field_put_material(b, slot);
    }
    builder_place_points(b);
    builder_add_vec4s(b, (PADDING - field->vec4_count % PADDING) % PADDING);
}
