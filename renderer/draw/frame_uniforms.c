/* SPDX-License-Identifier: MIT */
/* Records become the numbers of the uniform block. */
#include "frame_uniforms.h"

#include <math.h>
#include <string.h>

/* Stands for infinity where products of it must stay numbers. */
static const double FAR_AWAY = 1e9;

static void set3(float out[3], const double *v, double scale)
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

/* Of length 1, times `sign`; any direction of length 0 stays. */
static void set_direction(float out[3], const double *d, double sign)
{
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);

    set3(out, d, length > 0 ? sign / length : sign);
}

static void pack_directional(struct frame_light *light, const struct record *record)
{
    set_direction(light->position, record_vector(record, "direction"), -1);
}

static void pack_point(struct frame_light *light, const struct record *record)
{
    set3(light->position, record_vector(record, "position"), 1);
    light->radius = (float)record_number(record, "radius");
    light->range = (float)record_number(record, "range");
}

static void pack_spot(struct frame_light *light, const struct record *record)
{
    const double angle = record_number(record, "angle");

    pack_point(light, record);
    set_direction(light->axis, record_vector(record, "direction"), 1);
    light->fade_cosine = (float)cos(angle * (1 - record_number(record, "softness")));
    light->rim_cosine = (float)cos(angle);
}

static void (*const light_packers[LIGHT_KIND_COUNT])(struct frame_light *light,
                                                     const struct record *record) = {
    [LIGHT_DIRECTIONAL] = pack_directional,
    [LIGHT_POINT] = pack_point,
    [LIGHT_SPOT] = pack_spot,
};

static struct frame_light make_light(const struct record *record)
{
    struct frame_light light = {.kind = (int32_t)(record->type - light_types)};

    /* One that gives no light is black and casts no shadow: numbers, so nothing is compiled. */
    const bool lit = record_number(record, "visible") != 0;

    light_packers[light.kind](&light, record);
    set3(light.color, record_vector(record, "color"), lit ? record_number(record, "intensity") : 0);
    light.sharpness = (float)record_number(record, "size");
    light.shadow = lit ? choice(record, "shadow") : SHADOW_NONE;
    return light;
}

static void set_fog(struct frame_uniforms *block, const struct record *environment)
{
    const double height = record_number(environment, "fog_height");

    set3(block->fog_color, record_vector(environment, "fog_color"), 1);
    block->fog_density = (float)record_number(environment, "fog");
    block->fog_thinning = height > 0 ? (float)fmin(1 / height, LIMIT_COORDINATE) : 0;
    block->fog_base = (float)record_number(environment, "fog_base");
}

static void set_environment(struct frame_uniforms *block, const struct record *environment)
{
    const int kind = choice(environment, "type");
    const bool gradient = kind == SKY_GRADIENT, image = kind == SKY_IMAGE;
    const double turn = image ? record_number(environment, "rotation") : 0;

    /* What stands for a picture that cannot be shown is the one colour. */
    set3(block->zenith, record_vector(environment, gradient ? "zenith" : "color"), 1);
    set3(block->horizon, record_vector(environment, "horizon"), 1);
    set3(block->ground, record_vector(environment, "ground"), 1);
    block->ambient = (float)record_number(environment, "intensity");
    block->sky_rotation[0] = (float)cos(turn);
    block->sky_rotation[1] = (float)sin(turn);
    block->sky_brightness = image ? (float)record_number(environment, "brightness") : 1;
    block->sky_kind = kind;
    block->effects |= gradient && record_number(environment, "sun") > 0 ? EFFECT_SUN : 0;
    set_fog(block, environment);
}

/* The height above which waves of noise fill this part of space. Sums of octaves are spread much as
 * the logistic distribution of this deviation, which was measured. */
static double waves_above(double part, int octaves)
{
    const double deviation = 0.46 * sqrt((1 - pow(0.25, octaves)) / 0.75);
    const double odds = fmax(1 - part, 1e-6) / fmax(part, 1e-6);

    return deviation * sqrt(3) / M_PI * log(odds);
}

static void pack_box(struct frame_volume *volume, const struct record *record)
{
    set3(volume->extent, record_vector(record, "size"), 0.5);
    volume->kind = VOLUME_BOX;
}

/* A ball is an ellipsoid with three radii alike. */
static void pack_sphere(struct frame_volume *volume, const struct record *record)
{
    const double radius = record_number(record, "radius");

    set3(volume->extent, (const double[]){radius, radius, radius}, 1);
    volume->kind = VOLUME_ELLIPSOID;
}

static void pack_ellipsoid(struct frame_volume *volume, const struct record *record)
{
    set3(volume->extent, record_vector(record, "radii"), 1);
    volume->kind = VOLUME_ELLIPSOID;
}

static void (*const volume_packers[VOLUME_KIND_COUNT])(struct frame_volume *volume,
                                                       const struct record *record) = {
    [VOLUME_BOX] = pack_box,
    [VOLUME_SPHERE] = pack_sphere,
    [VOLUME_ELLIPSOID] = pack_ellipsoid,
};

static struct frame_volume make_volume(const struct record *record)
{
    struct frame_volume volume = {.octaves = (int32_t)record_number(record, "octaves")};

    set3(volume.center, record_vector(record, "position"), 1);
    volume_packers[record->type - volume_types](&volume, record);
    volume.falloff = (float)record_number(record, "falloff");
    set3(volume.color, record_vector(record, "color"), 1);
    volume.density = (float)record_number(record, "density");
    set3(volume.emission, record_vector(record, "emission"), 1);
    volume.anisotropy = (float)record_number(record, "anisotropy");
    volume.frequency = (float)record_number(record, "frequency");
    volume.seed = (int32_t)record_number(record, "seed");
    volume.threshold = (float)waves_above(record_number(record, "cover"), volume.octaves);
    volume.source = choice(record, "source");
    volume.reach = (float)fmax(record_number(record, "reach"), 1e-6);
    return volume;
}

static void set_volumes(struct frame_uniforms *block, const struct resource_list *volumes)
{
    for (size_t i = 0; i < volumes->count && i < LIMIT_VOLUMES; i++) {
        block->volumes[block->volume_count++] = make_volume(&volumes->items[i]->record);
    }
}

/* Outwards to steps, with a little room, so that a surface on the bounds is inside of them. */
static void set_box(float low[3], float high[3], const double min[3], const double max[3],
                    const struct scene_bounds *extent)
{
    const double room = 1e-3 * (1 + fabs(extent->scale)), step = extent->step;

    for (int i = 0; i < 3; i++) {
        const double from = min[i] - room, to = max[i] + room;
        low[i] = (float)clamp(step * floor(from / step), -FAR_AWAY, FAR_AWAY);
        high[i] = (float)clamp(step * ceil(to / step), -FAR_AWAY, FAR_AWAY);
    }
}

static void set_bounds(struct frame_uniforms *block, const struct scene_bounds *extent)
{
    set_box(block->bounds_min, block->bounds_max, extent->min, extent->max, extent);
    set_box(block->transmissive_min, block->transmissive_max, extent->transmissive_min,
            extent->transmissive_max, extent);
    block->has_transmissive = extent->transmissive;
}

static double occlusion_reach(const struct record *render, const struct scene_bounds *extent)
{
    const double own = record_number(render, "occlusion_reach");

    return own > 0 ? own : 0.06 * extent->scale;
}

void frame_uniforms_set_scene(struct frame_uniforms *block, const struct scene *scene,
                              const struct scene_bounds *extent)
{
    const struct record *render = &scene->render;

    *block = (struct frame_uniforms){0};
    for (size_t i = 0; i < scene->lights.count && i < LIMIT_LIGHTS; i++) {
        block->lights[block->light_count++] = make_light(&scene->lights.items[i]->record);
    }
    set_volumes(block, &scene->volumes);
    set_environment(block, &scene->environment);
    set_bounds(block, extent);
    block->max_distance = (float)record_number(render, "max_distance");
    block->exposure = (float)exp2(record_number(render, "exposure"));
    block->occlusion_reach = (float)occlusion_reach(render, extent);
    block->occlusion_strength = (float)record_number(render, "occlusion_strength");
    block->tone_map = choice(render, "tone_map");
}

void frame_uniforms_set_camera(struct frame_uniforms *block, const struct camera *camera, int width,
                               int height)
{
    struct frame_camera *out = &block->camera;

    set3(out->eye, camera->eye, 1);
    set3(out->forward, camera->forward, 1);
    set3(out->right, camera->right, 1);
    set3(out->up, camera->up, 1);
    out->orthographic = camera->orthographic;
    out->pixel_radius = (float)camera->pixel_radius;
    out->lens_radius = (float)camera->lens;
    out->focus_distance = (float)camera->focus;
    out->size[0] = width;
    out->size[1] = height;
}

void frame_uniforms_set_section(struct frame_uniforms *block, const struct section *section)
{
    block->effects |= section->cuts ? EFFECT_SECTION : 0;
    set3(block->section_normal, section->normal, 1);
    block->section_offset = (float)section->offset;
}
