/* SPDX-License-Identifier: MIT */
#include "code_engine.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/scene.h"
#include "renderer/engine/engine.h"

/* A scene of nothing but this function. */
static struct scene *scene_of(const char *text)
{
    struct error err = {0};
    cJSON *document = cJSON_CreateObject();

    cJSON_AddStringToObject(document, "format", "fieldcast/1");
    cJSON *root = cJSON_AddObjectToObject(document, "root");
    cJSON_AddStringToObject(root, "id", "code");
    cJSON_AddStringToObject(root, "type", "field");
    cJSON *params = cJSON_AddObjectToObject(root, "params");
    cJSON_AddStringToObject(params, "code", text);
    struct scene *scene = scene_read(document, &err);
    cJSON_Delete(document);
    if (!scene) {
        fail_msg("%s: %s\n%s", err.place, err.message, text);
    }
    return scene;
}

void engine_agree(const struct field *field, const float (*points)[3], size_t count, float *out)
{
    float *again = calloc(count, sizeof *again);

    assert_non_null(again);
    for (size_t i = 0; engine_lanes(i) > 0; i++) {
        struct engine_program *program =
            engine_program_create((struct field *)field, engine_lanes(i), 0);
        assert_non_null(program);
        engine_distances(program, field->params, points, count, INFINITY, i == 0 ? out : again);
        engine_program_destroy(program);
        if (i > 0) {
            assert_memory_equal(out, again, count * sizeof *out);
        }
    }
    free(again);
}

void code_engine_run(const char *text, const float (*points)[3], size_t count, float *out)
{
    struct error err = {0};
    struct scene *scene = scene_of(text);
    struct field *field = field_compile(scene, &err);

    if (!field) {
        fail_msg("%s: %s\n%s", err.place, err.message, text);
    }
    engine_agree(field, points, count, out);
    field_unref(field);
    scene_destroy(scene);
}
