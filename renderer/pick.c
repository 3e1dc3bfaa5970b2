/* SPDX-License-Identifier: MIT */
#include "pick.h"

#include <stdatomic.h>
#include <stdlib.h>

#include "protocol/memory.h"
#include "renderer/draw/camera.h"
#include "renderer/field/field.h"

/* How far a picked point may be off the surface, for each unit of the greatest distance. */
static const double TOLERANCE = 1e-6;

struct pick_field {
    atomic_int references;
    struct field *field;
    struct record camera; /* the scene's */
    double max_distance;
    uint64_t work; /* of one evaluation, at most */
};

struct pick_field *pick_field_create(const struct scene *scene, const char *const *isolated,
                                     size_t isolated_count, struct error *err)
{
    const struct field_options options = {.isolated = isolated, .isolated_count = isolated_count};
    struct field *compiled = field_compile_as(scene, &options, err);

    if (!compiled) {
        return NULL;
    }
    struct pick_field *field = memory_alloc(1, sizeof *field);
    field->references = 1;
    field->field = compiled;
    record_copy(&field->camera, &scene->camera);
    field->max_distance = record_number(&scene->render, "max_distance");
    field->work = field_work(compiled);
    return field;
}

struct pick_field *pick_field_ref(struct pick_field *field)
{
    atomic_fetch_add(&field->references, 1);
    return field;
}

void pick_field_unref(struct pick_field *field)
{
    if (field && atomic_fetch_sub(&field->references, 1) == 1) {
        field_unref(field->field);
        record_finish(&field->camera);
        free(field);
    }
}

/* Where the ray meets the surface; -1: nowhere. */
static double march(const struct pick_field *field, const double origin[3],
                    const double direction[3])
{
    return field_march_within(field->field, origin, direction, field->max_distance,
                              TOLERANCE * field->max_distance,
                              (int)(LIMIT_PICK_WORK / field->work));
}

struct pick_result pick_at(const struct pick_field *field, const struct pick_question *question)
{
    const int width = question->width, height = question->height;
    const struct camera camera =
        camera_from_record(question->camera ? question->camera : &field->camera, width, height);
    struct pick_result result = {0};
    double origin[3], direction[3];

    camera_ray(&camera, width, height, question->x, question->y, origin, direction);
    const double t = march(field, origin, direction);
    if (t < 0) {
        return result;
    }
    for (int i = 0; i < 3; i++) {
        result.position[i] = origin[i] + t * direction[i];
    }
    const double print = camera.pixel_radius * (camera.orthographic ? 1 : t);
    field_normal(field->field, result.position, 0.5 * print + 1e-6, result.normal);
    result.distance = t;
    result.hit = true;
    const char *id =
        field_leaf_id(field->field, field_surface(field->field, result.position, NULL).number);
    snprintf(result.node, sizeof result.node, "%s", id ? id : "");
    return result;
}
