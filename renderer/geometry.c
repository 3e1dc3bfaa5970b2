/* SPDX-License-Identifier: MIT */
#include "geometry.h"

#include <math.h>
#include <string.h>

bool geometry_init(struct geometry *out, const struct scene *scene,
                   const struct field_options *options, struct error *err)
{
    *out = (struct geometry){.field = field_compile_as(scene, options, err)};
    return out->field;
}

void geometry_finish(struct geometry *geometry)
{
    field_unref(geometry->field);
    *geometry = (struct geometry){NULL};
}

struct bounds geometry_bounds(const struct geometry *geometry)
{
    return geometry->field->bounds;
}

uint64_t geometry_work(const struct geometry *geometry)
{
    return field_work(geometry->field);
}

struct geometry_hit geometry_trace(const struct geometry *geometry, const struct geometry_ray *ray)
{
    const double distance =
        field_march_within(geometry->field, ray->origin, ray->direction, ray->section,
                           ray->max_distance, ray->tolerance, ray->max_steps);

    return (struct geometry_hit){distance >= 0, GEOMETRY_FIELD, distance};
}

const char *geometry_leaf(const struct geometry *geometry, enum geometry_source source,
                          const double p[3])
{
    const struct field *field = geometry->field;

    switch (source) {
    case GEOMETRY_FIELD:
        return field_leaf_id(field, field_surface(field, p, NULL).number);
    }
    return NULL;
}

void geometry_normal(const struct geometry *geometry, enum geometry_source source,
                     const struct section *section, const double p[3], double width, double out[3])
{
    switch (source) {
    case GEOMETRY_FIELD:
        if (section_beyond(section, p) > field_distance(geometry->field, p)) {
            memcpy(out, section->normal, sizeof section->normal);
        } else {
            field_normal(geometry->field, p, width, out);
        }
        break;
    }
}

double geometry_distance(const struct geometry *geometry, enum geometry_source source,
                         const struct section *section, const double p[3])
{
    switch (source) {
    case GEOMETRY_FIELD:
        return fmax(field_distance(geometry->field, p), section_beyond(section, p));
    }
    return INFINITY;
}
