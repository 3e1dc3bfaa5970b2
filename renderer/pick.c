/* SPDX-License-Identifier: MIT */
#include "pick.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "renderer/draw/camera.h"
#include "renderer/geometry.h"

/* How far a picked point may be off the surface, for each unit of the greatest distance. */
static const double TOLERANCE = 1e-6;
/* The least step of a ray that goes through surfaces, for each unit of the greatest distance. */
static const double LEAST_STEP = 1e-5;

struct pick_field {
    atomic_int references;
    struct geometry geometry;
    struct record camera; /* the scene's */
    double max_distance;
    uint64_t work; /* of one evaluation, at most */
};

struct pick_field *pick_field_create(const struct scene *scene, const char *const *isolated,
                                     size_t isolated_count, struct error *err)
{
    const struct field_options options = {.isolated = isolated, .isolated_count = isolated_count};
    struct geometry geometry;

    if (!geometry_init(&geometry, scene, &options, err)) {
        return NULL;
    }
    struct pick_field *field = memory_alloc(1, sizeof *field);
    field->references = 1;
    field->geometry = geometry;
    record_copy(&field->camera, &scene->camera);
    field->max_distance = record_number(&scene->render, "max_distance");
    field->work = geometry_work(&geometry);
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
        geometry_finish(&field->geometry);
        record_finish(&field->camera);
        free(field);
    }
}

bool pick_bounds(const struct scene *scene, const char *const *isolated, size_t isolated_count,
                 double out_low[3], double out_high[3])
{
    const struct field_options options = {
        .isolated = isolated, .isolated_count = isolated_count, .ended = true};
    struct geometry geometry;

    if (!geometry_init(&geometry, scene, &options, NULL)) {
        return false;
    }
    const struct bounds box = geometry_bounds(&geometry);
    geometry_finish(&geometry);
    memcpy(out_low, box.low, sizeof box.low);
    memcpy(out_high, box.high, sizeof box.high);
    return !bounds_is_empty(&box);
}

static void at(const double origin[3], const double direction[3], double t, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = origin[i] + t * direction[i];
    }
}

static const char *leaf_at(const struct pick_field *field, enum geometry_source source,
                           const double p[3])
{
    const char *id = geometry_leaf(&field->geometry, source, p);

    return id ? id : "";
}

static void add_through(struct pick_result *result, const char *id)
{
    bool known = !*id || result->through_count == LIMIT_PICK_THROUGH;

    for (int i = 0; i < result->through_count; i++) {
        known = known || strcmp(result->through[i], id) == 0;
    }
    if (!known) {
        char *out = result->through[result->through_count++];

        snprintf(out, sizeof result->through[0], "%s", id);
    }
}

/* A field changes no faster than the way, inside too: where its sign changes is a surface. */
static void follow_through(const struct pick_field *field, const struct geometry_ray *ray,
                           enum geometry_source source, struct pick_result *result)
{
    const double least = LEAST_STEP * field->max_distance;
    bool inside = true;
    double t = result->distance + least, p[3];

    add_through(result, result->node);
    for (uint64_t work = 0; t < field->max_distance && work < LIMIT_PICK_WORK;
         work += field->work) {
        at(ray->origin, ray->direction, t, p);
        const double d = geometry_distance(&field->geometry, source, ray->section, p);
        if ((d < 0) != inside) {
            inside = d < 0;
            add_through(result, leaf_at(field, source, p));
        }
        t += fmax(fabs(d), least);
    }
}

struct pick_result pick_at(const struct pick_field *field, const struct pick_question *question)
{
    const int width = question->width, height = question->height;
    const struct camera camera =
        camera_from_record(question->camera ? question->camera : &field->camera, width, height);
    const struct section section = section_from_record(question->section);
    struct geometry_ray ray = {.section = &section,
                               .max_distance = field->max_distance,
                               .tolerance = TOLERANCE * field->max_distance,
                               .max_steps = (int)(LIMIT_PICK_WORK / field->work)};
    struct pick_result result = {0};

    camera_ray(&camera, width, height, question->x, question->y, ray.origin, ray.direction);
    const struct geometry_hit found = geometry_trace(&field->geometry, &ray);
    if (!found.hit) {
        return result;
    }
    at(ray.origin, ray.direction, found.distance, result.position);
    const double print = camera.pixel_radius * (camera.orthographic ? 1 : found.distance);
    geometry_normal(&field->geometry, found.source, &section, result.position, 0.5 * print + 1e-6,
                    result.normal);
    result.distance = found.distance;
    result.hit = true;
    snprintf(result.node, sizeof result.node, "%s", leaf_at(field, found.source, result.position));
    if (question->through) {
        follow_through(field, &ray, found.source, &result);
    }
    return result;
}
