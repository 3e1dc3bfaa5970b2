/* SPDX-License-Identifier: MIT */
/* Records become the numbers of the uniform block. */
#include "frame.h"

#include <math.h>
#include <string.h>

enum {
    SHADOW_STEPS = 64,
    OCCLUSION_SAMPLES = 5,
    /* llvmpipe (Mesa 22.3, lp_bld_limits.h) ends all loops of a shader after 65,535 iterations
     * together, silently. Some are left for loops around the marching. */
    LOOP_BUDGET = 65000,
};

/* Stands for infinity where products of it must stay numbers. */
static const double FAR_AWAY = 1e9;

/* Values of glsl/frame.glsl and glsl/resolve.glsl. */
enum { LIGHT_DIRECTIONAL, LIGHT_POINT };

static void set3(float out[4], const double *v, double scale)
{
    for (int i = 0; i < 3; i++) {
        out[i] = (float)(v[i] * scale);
    }
}

static double clamp(double x, double low, double high)
{
    return fmin(fmax(x, low), high);
}

static int choice(const struct record *record, const char *name)
{
    return (int)record_number(record, name);
}

static struct frame_light make_light(const struct record *record)
{
    struct frame_light light = {0};
    const double intensity = record_number(record, "intensity");

    if (strcmp(record->type->name, "directional") == 0) {
        const double *d = record_vector(record, "direction");
        const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        set3(light.place, d, length > 0 ? -1 / length : -1);
        light.place[3] = LIGHT_DIRECTIONAL;
    } else {
        set3(light.place, record_vector(record, "position"), 1);
        light.place[3] = LIGHT_POINT;
        light.extent[0] = (float)record_number(record, "radius");
        light.extent[1] = (float)record_number(record, "range");
    }
    set3(light.color, record_vector(record, "color"), intensity);
    light.color[3] = (float)record_number(record, "size");
    light.extent[2] = (float)choice(record, "shadow");
    return light;
}

static void set_environment(struct frame_block *block, const struct record *environment)
{
    const bool solid = record_is(environment, "type", "solid");

    set3(block->zenith, record_vector(environment, solid ? "color" : "zenith"), 1);
    set3(block->horizon, record_vector(environment, "horizon"), 1);
    set3(block->ground, record_vector(environment, "ground"), 1);
    block->horizon[3] = (float)record_number(environment, "intensity");
    block->modes[1] = choice(environment, "type");
}

static void set_bounds(struct frame_block *block, const struct frame_extent *extent)
{
    for (int i = 0; i < 3; i++) {
        /* A little room, so that a surface on the bounds is inside of them. */
        const double room = 1e-3 * (1 + fabs(extent->scale));
        block->bounds_min[i] = (float)clamp(extent->min[i] - room, -FAR_AWAY, FAR_AWAY);
        block->bounds_max[i] = (float)clamp(extent->max[i] + room, -FAR_AWAY, FAR_AWAY);
    }
}

/* Steps such that marching, or all shadows, stay within the driver's budget of iterations. */
static bool set_steps(struct frame_block *block, int wanted, const struct frame_extent *extent)
{
    const int each = 1 + extent->loop_trips;
    const int lights = block->modes[0] > 0 ? block->modes[0] : 1;
    int steps = wanted, shadow_steps = SHADOW_STEPS;

    if (extent->limit_loops) {
        /* Four points for the normal, and one evaluation of the surface. */
        const int most = LOOP_BUDGET / each - 5;
        const int most_shadow = (LOOP_BUDGET / each - OCCLUSION_SAMPLES) / lights - 1;
        steps = most < steps ? most : steps;
        shadow_steps = most_shadow < shadow_steps ? most_shadow : shadow_steps;
    }
    block->size[3] = steps > 1 ? steps : 1;
    block->modes[3] = shadow_steps > 1 ? shadow_steps : 1;
    return steps < wanted || shadow_steps < SHADOW_STEPS;
}

bool frame_set_scene(struct frame_block *block, const struct scene *scene,
                     const struct frame_extent *extent)
{
    const struct record *render = &scene->render;

    *block = (struct frame_block){0};
    for (size_t i = 0; i < scene->lights.count && i < LIMIT_LIGHTS; i++) {
        block->lights[i] = make_light(&scene->lights.items[i]->record);
        block->modes[0]++;
    }
    set_environment(block, &scene->environment);
    set_bounds(block, extent);
    block->bounds_max[3] = (float)record_number(render, "max_distance");
    block->zenith[3] = (float)exp2(record_number(render, "exposure"));
    block->ground[3] = (float)(0.06 * extent->scale);
    block->modes[2] = choice(render, "tone_map");
    return set_steps(block, (int)record_number(render, "max_steps"), extent);
}

void frame_set_camera(struct frame_block *block, const struct camera *camera, int width, int height,
                      int samples)
{
    set3(block->eye, camera->eye, 1);
    set3(block->forward, camera->forward, 1);
    set3(block->right, camera->right, 1);
    set3(block->up, camera->up, 1);
    block->eye[3] = camera->orthographic ? 1 : 0;
    block->forward[3] = (float)camera->pixel_radius;
    block->size[0] = width;
    block->size[1] = height;
    block->size[2] = samples;
}
