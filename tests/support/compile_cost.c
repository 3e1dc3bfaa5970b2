/* SPDX-License-Identifier: MIT */
#include "compile_cost.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "compiled.h"
#include "drawing.h"
#include "protocol/json.h"
#include "renderer/field/shader.h"
#include "renderer/renderer_internal.h"

enum { PARAM_BUFFER_MIN = 64 }; /* vec4s, as programs of snapshot.c */

struct renderer *compile_cost_renderer(void)
{
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    return drawing_renderer(0);
}

/* Without being tried out in C, as resident_create would: the driver does not look at values. */
static struct program *add(struct program_cache *cache, const struct field *field)
{
    static uint64_t shapes;
    const size_t capacity =
        field->vec4_count < PARAM_BUFFER_MIN ? PARAM_BUFFER_MIN : field->vec4_count;
    char *map = shader_map(field), *surface = shader_surface(field);
    struct program *program =
        program_cache_add(cache, &(struct program_source){.structure_hash = ++shapes,
                                                          .map_text = map,
                                                          .surface_text = surface,
                                                          .number_count = capacity,
                                                          .user_shaders = field->shader_count > 0,
                                                          .shape_count = field->shape_count,
                                                          .code_size = field->code_size,
                                                          .map_count = field->material_base});

    free(map);
    free(surface);
    return program;
}

double compile_cost_scene(struct renderer *renderer, struct scene *scene)
{
    struct program_cache *cache = renderer->programs;
    struct field *field = compile_field(scene);
    const int64_t before_us = program_cache_cpu_us(cache);
    struct program *program = add(cache, field);

    while (program_state(program) == PROGRAM_PENDING) {
        program_cache_wait(cache, 100);
    }
    if (program_state(program) != PROGRAM_READY) {
        fail_msg("%s", program_error(program)->message);
    }
    program_unref(cache, program);
    field_unref(field);
    scene_destroy(scene);
    return (double)(program_cache_cpu_us(cache) - before_us) / 1000;
}

static int compare(const void *a, const void *b)
{
    const double first = *(const double *)a, second = *(const double *)b;

    return (first > second) - (first < second);
}

double compile_cost_plain(struct renderer *renderer)
{
    static const char *const shapes[] = {"sphere", "torus", "box"};

    enum { SHAPES = sizeof shapes / sizeof shapes[0] };
    double ms[SHAPES];
    char text[128];

    for (int i = 0; i < SHAPES; i++) {
        snprintf(text, sizeof text, "{'format':'fieldcast/1','root':{'type':'%s'}}", shapes[i]);
        ms[i] = compile_cost_scene(renderer, drawing_parse(text));
    }
    qsort(ms, SHAPES, sizeof ms[0], compare);
    return ms[SHAPES / 2];
}

static void add_shapes(cJSON *root, const char *text, int count)
{
    cJSON *children = cJSON_AddArrayToObject(root, "children");

    cJSON_AddStringToObject(root, "type", "union");
    for (int i = 0; i < count; i++) {
        cJSON *shape = cJSON_CreateObject();
        cJSON_AddStringToObject(shape, "type", "field");
        cJSON_AddStringToObject(cJSON_AddObjectToObject(shape, "params"), "code", text);
        cJSON_AddItemToArray(children, shape);
    }
}

static void add_shader(cJSON *document, cJSON *root, const char *text)
{
    cJSON *shaders = cJSON_AddObjectToObject(document, "shaders");
    cJSON *materials = cJSON_AddObjectToObject(document, "materials");

    cJSON_AddStringToObject(cJSON_AddObjectToObject(shaders, "paint"), "code", text);
    cJSON_AddStringToObject(cJSON_AddObjectToObject(materials, "red"), "shader", "paint");
    cJSON_AddStringToObject(root, "type", "sphere");
    cJSON_AddStringToObject(root, "material", "red");
}

double compile_cost_code(struct renderer *renderer, enum code_use use, const char *text, int count)
{
    cJSON *document = cJSON_CreateObject();
    cJSON *root = cJSON_AddObjectToObject(document, "root");

    cJSON_AddStringToObject(document, "format", "fieldcast/1");
    if (use == CODE_DISTANCE) {
        add_shapes(root, text, count);
    } else {
        add_shader(document, root, text);
    }
    char *whole = json_print(document, false);
    const double ms = compile_cost_scene(renderer, drawing_parse(whole));
    free(whole);
    cJSON_Delete(document);
    return ms;
}
