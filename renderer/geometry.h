/* SPDX-License-Identifier: MIT */
/* What the rays of a scene can meet, and its extent. Each hit names its source, and what is asked
 * about a hit is answered by that source. Shaders have the same seam: march() (glsl/march.glsl),
 * visible() (glsl/shadow.glsl) and surface_of() (glsl/surface_of.glsl).
 *
 * Immutable. Any number of threads may ask at once while the owner holds it. */
#ifndef RENDERER_GEOMETRY_H
#define RENDERER_GEOMETRY_H

#include "renderer/field/field.h"
#include "renderer/glsl/interface.h"

struct geometry {
    struct field *field; /* GEOMETRY_FIELD */
};

/* With a reference of the new field. False and `err` where the scene is no field. */
bool geometry_init(struct geometry *out, const struct scene *scene,
                   const struct field_options *options, struct error *err);
void geometry_finish(struct geometry *geometry);

struct bounds geometry_bounds(const struct geometry *geometry);
/* Operations of one step of a ray, at most. */
uint64_t geometry_work(const struct geometry *geometry);

struct geometry_ray {
    double origin[3], direction[3]; /* `direction` has length 1 */
    const struct section *section;  /* what is beyond it is cut off */
    double max_distance, tolerance;
    int max_steps;
};

struct geometry_hit {
    bool hit;
    enum geometry_source source;
    double distance; /* along the ray */
};

/* The first point of the ray within `tolerance` of a surface. */
struct geometry_hit geometry_trace(const struct geometry *geometry, const struct geometry_ray *ray);
/* The id of the leaf whose surface is at a point, borrowed; NULL: none has an id there. */
const char *geometry_leaf(const struct geometry *geometry, enum geometry_source source,
                          const double p[3]);
/* The unit normal at a point of a surface, by samples so far apart as `width`. Of a cut, that of
 * the section. */
void geometry_normal(const struct geometry *geometry, enum geometry_source source,
                     const struct section *section, const double p[3], double width, double out[3]);
/* The signed distance of a point to what the section leaves of a source: negative inside. */
double geometry_distance(const struct geometry *geometry, enum geometry_source source,
                         const struct section *section, const double p[3]);

#endif
