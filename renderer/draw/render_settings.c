/* SPDX-License-Identifier: MIT */
#include "render_settings.h"

enum {
    /* llvmpipe (Mesa 22.3, lp_bld_limits.h) ends all loops of a shader after 65,535 iterations
     * together, silently. Some are left for loops around the marching. */
    LOOP_BUDGET = 65000,
};

static bool is_on(const struct record *render, const char *name)
{
    return record_number(render, name) != 0;
}

/* The scene's own number, or the level's where that is 0. */
static int own_or(const struct record *render, const char *name, int level)
{
    const int own = (int)record_number(render, name);

    return own > 0 ? own : level;
}

/* Steps such that marching, or all shadows, stay within the driver's budget of iterations. */
static bool set_steps(struct frame_uniforms *block, int wanted, int wanted_shadow,
                      const struct scene_bounds *extent)
{
    const int each = 1 + extent->loop_trips, twice = extent->estimates ? 2 : 1;
    const int lights = block->light_count > 0 ? block->light_count : 1;
    const int rounds = block->has_transmissive ? 2 : 1; /* of a ray inside, for each step */
    int steps = wanted, shadow_steps = wanted_shadow;

    if (extent->limit_loops) {
        /* Eight points for the normal, and one evaluation of the surface. */
        const int most = (LOOP_BUDGET / each - 9) / rounds;
        const int most_shadow =
            (LOOP_BUDGET / each - block->occlusion_samples) / lights / twice - 1;
        steps = most < steps ? most : steps;
        shadow_steps = most_shadow < shadow_steps ? most_shadow : shadow_steps;
    }
    block->max_steps = steps > 1 ? steps : 1;
    block->shadow_steps = shadow_steps > 1 ? shadow_steps : 1;
    return steps < wanted || shadow_steps < wanted_shadow;
}

/* Rounds of the loops in glsl/volume.glsl for one step of a ray, when map() takes `each`. */
static int volume_rounds(const struct frame_uniforms *block, int each)
{
    const int lights = block->light_count > 0 ? block->light_count : 1;
    int density = 0;

    for (int i = 0; i < block->volume_count; i++) {
        density += 1 + block->volumes[i].octaves;
    }
    const int step_to_light = each + density;
    return 1 + block->volume_count +
           lights * (1 + block->volume_count + (1 + 3 * block->volume_light_steps) * step_to_light);
}

/* The same for volumes: light in them is looked at less closely first, then they are. */
static void set_volume_steps(struct frame_uniforms *block, const struct quality *q,
                             const struct scene_bounds *extent)
{
    const int edges = 1 + 3 * block->volume_count; /* and the surface */
    int most = q->volume_steps;

    block->volume_steps = q->volume_steps;
    block->volume_light_steps = q->volume_shadow_steps;
    do {
        most = LOOP_BUDGET / volume_rounds(block, 1 + extent->loop_trips) - edges;
    } while (extent->limit_loops && most < block->volume_steps && --block->volume_light_steps > 1);
    if (extent->limit_loops && most < block->volume_steps) {
        block->volume_steps = most > 1 ? most : 1;
    }
}

/* Of moving pictures the scene decides only that there is none. */
static enum antialiasing choose_antialiasing(const struct record *render, const struct quality *q,
                                             enum quality_level level, int samples)
{
    const enum antialiasing own = (enum antialiasing)record_number(render, "antialiasing");
    const bool owns =
        own == ANTIALIASING_NONE || (own != ANTIALIASING_AUTO && level >= QUALITY_STILL);
    const enum antialiasing chosen = owns ? own : q->antialiasing;

    return samples == 1 && chosen > ANTIALIASING_EDGES ? ANTIALIASING_NONE : chosen;
}

static void set_samples(struct render_settings *settings, struct frame_uniforms *block,
                        const struct record *render, const struct quality *q,
                        enum quality_level level, int wanted)
{
    const int own = q->samples ? q->samples : (int)record_number(render, "samples");
    const int n = wanted ? wanted : own;

    settings->antialiasing = choose_antialiasing(render, q, level, n);
    settings->samples = settings->antialiasing > ANTIALIASING_EDGES ? n * n : 1;
    if (q->lens_samples == 0) {
        block->camera.lens_radius = 0; /* no lens */
    } else if (block->camera.lens_radius > 0) {
        settings->antialiasing = ANTIALIASING_FULL;
        settings->samples =
            settings->samples > q->lens_samples ? settings->samples : q->lens_samples;
    }
    block->samples = settings->samples;
}

static void set_effects(struct render_settings *settings, struct frame_uniforms *block,
                        const struct record *render, const struct quality *q,
                        const struct scene_bounds *extent, bool transparent)
{
    const bool rays =
        settings->reflective && (is_on(render, "reflections") || is_on(render, "refractions"));
    const bool pictured = settings->reflective && block->sky_kind == SKY_IMAGE;
    const int depth = q->ray_depth ? own_or(render, "ray_depth", q->ray_depth) : 0;

    block->occlusion_samples =
        is_on(render, "occlusion") ? own_or(render, "occlusion_samples", q->occlusion_samples) : 0;
    block->ray_depth = rays ? depth : 0;
    block->effects = (block->effects & (EFFECT_SUN | EFFECT_SECTION)) |
                     (is_on(render, "shadows") ? EFFECT_SHADOWS : 0) |
                     (is_on(render, "reflections") ? EFFECT_REFLECTIONS : 0) |
                     (is_on(render, "refractions") ? EFFECT_REFRACTIONS : 0) |
                     (transparent ? EFFECT_TRANSPARENT : 0) | (pictured ? EFFECT_CURVATURE : 0) |
                     (extent->estimates ? EFFECT_ESTIMATES : 0) | (extent->rise ? EFFECT_RISE : 0);
    block->min_throughput = (float)q->min_throughput;
    settings->rays = block->ray_depth ? q->rays : 0;
    settings->transmission_depth = is_on(render, "shadows") ? q->transmission_depth : 0;
    settings->volumes = block->volume_count > 0;
}

bool render_settings_make(struct render_settings *out_settings, struct frame_uniforms *block,
                          const struct record *render, const struct settings_request *request,
                          const struct scene_bounds *extent)
{
    const int own = (int)record_number(render, "level");
    const enum quality_level level =
        (enum quality_level)(request->level >= 0 ? request->level : own);
    const struct quality *q = quality_row(level);
    struct render_settings settings = {.reflective = extent->reflective};

    frame_uniforms_set_section(block, &request->section);
    set_samples(&settings, block, render, q, level, request->samples);
    set_effects(&settings, block, render, q, extent,
                request->transparent >= 0 ? request->transparent : is_on(render, "transparent"));
    settings.sparse = request->sparse && settings.samples == 1;
    *out_settings = settings;
    set_volume_steps(block, q, extent);
    return set_steps(block, (int)record_number(render, "max_steps"), q->shadow_steps, extent);
}
