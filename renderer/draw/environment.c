/* SPDX-License-Identifier: MIT */
/* The list of environments, and the pictures that each is made of. */
#include "environment.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "protocol/memory.h"
#include "renderer/gl/texture.h"

struct environments {
    const struct gl *gl;
    struct environment *first; /* the last used first */
};

/* --- what tells one from another --- */

static uint64_t mix(uint64_t state, const void *bytes, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        state = (state ^ ((const uint8_t *)bytes)[i]) * UINT64_C(0x100000001b3);
    }
    return state;
}

/* What sky_sun() of glsl/sky.glsl looks at. */
static uint64_t mix_sun(uint64_t state, const struct frame_uniforms *block)
{
    for (int i = 0; i < block->light_count; i++) {
        const struct frame_light *light = &block->lights[i];

        if (light->kind == LIGHT_DIRECTIONAL) {
            return mix(mix(state, light->position, sizeof light->position), light->color,
                       sizeof light->color);
        }
    }
    return state;
}

static uint64_t key_of(const struct frame_uniforms *block, const char *image)
{
    const int32_t sun = block->effects & EFFECT_SUN;
    uint64_t state = mix(UINT64_C(0xcbf29ce484222325), &block->sky_kind, sizeof block->sky_kind);

    if (block->sky_kind == SKY_IMAGE) {
        return mix(state, image, strlen(image));
    }
    state = mix(state, block->zenith, sizeof block->zenith);
    if (block->sky_kind == SKY_SOLID) {
        return state;
    }
    state = mix(state, block->horizon, sizeof block->horizon);
    state = mix(state, block->ground, sizeof block->ground);
    state = mix(state, &sun, sizeof sun);
    return sun ? mix_sun(state, block) : state;
}

/* --- pictures on the device --- */

static GLuint upload(const struct gl *gl, const struct engine_map *map)
{
    GLuint texture;

    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    texture_set_environment(gl, map->levels);
    texture_allocate(gl, GL_RGBA16F, map->levels, map->width, map->height);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    for (int level = 0; level < map->levels; level++) {
        gl->TexSubImage2D(GL_TEXTURE_2D, level, 0, 0, engine_map_side(map->width, level),
                          engine_map_side(map->height, level), GL_RGBA, GL_HALF_FLOAT,
                          map->texels[level]);
    }
    return texture;
}

void environment_bind(struct environment *environment, const struct gl *gl)
{
    static const GLenum units[ENGINE_MAPS] = {UNIT_ENVIRONMENT_MAP, UNIT_SPECULAR_MAP,
                                              UNIT_IRRADIANCE_MAP};

    for (int i = 0; i < ENGINE_MAPS; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + units[i]);
        if (environment->textures[i] == 0) {
            environment->textures[i] = upload(gl, &environment->maps[i]);
        }
        gl->BindTexture(GL_TEXTURE_2D, environment->textures[i]);
    }
}

/* --- the list --- */

static void destroy(const struct environments *environments, struct environment *environment)
{
    if (environment->textures[0]) {
        environments->gl->DeleteTextures(ENGINE_MAPS, environment->textures);
    }
    engine_maps_finish(environment->maps);
    free(environment);
}

/* NULL stands there where there is none. */
static struct environment **find(struct environments *environments, uint64_t key)
{
    struct environment **at = &environments->first;

    while (*at && (*at)->key != key) {
        at = &(*at)->next;
    }
    return at;
}

static void clean(struct environments *environments)
{
    size_t bytes = 0;

    for (struct environment **at = &environments->first; *at;) {
        struct environment *environment = *at;

        bytes += environment->references == 0 ? environment->bytes : 0;
        if (environment->references == 0 && bytes > LIMIT_PANORAMA_BYTES) {
            *at = environment->next;
            destroy(environments, environment);
        } else {
            at = &environment->next;
        }
    }
}

static struct environment *create(const struct frame_uniforms *block, struct engine_map *maps)
{
    struct environment *environment = memory_alloc(1, sizeof *environment);

    if (maps) {
        memcpy(environment->maps, maps, sizeof environment->maps);
        memset(maps, 0, sizeof environment->maps);
    } else {
        engine_maps_make(block, NULL, 0, 0, environment->maps);
    }
    for (int i = 0; i < ENGINE_MAPS; i++) {
        environment->bytes += environment->maps[i].bytes;
    }
    return environment;
}

void environment_leave_out(struct frame_uniforms *block)
{
    block->sky_kind = SKY_SOLID;
    block->sky_rotation[0] = 1;
    block->sky_rotation[1] = 0;
    block->sky_brightness = 1;
}

static uint64_t now_us(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000 + (uint64_t)now.tv_nsec / 1000;
}

bool environments_have(struct environments *environments, const struct frame_uniforms *block,
                       const char *image)
{
    return *find(environments, key_of(block, image)) != NULL;
}

struct environment *environments_get(struct environments *environments,
                                     const struct frame_uniforms *block, const char *image,
                                     struct engine_map *maps, uint32_t *out_us)
{
    const uint64_t begun = now_us(), key = key_of(block, image);
    struct environment **at = find(environments, key), *environment = *at;

    *out_us = 0;
    if (environment) {
        *at = environment->next;
    } else {
        environment = create(block, maps);
        environment->key = key;
        *out_us = (uint32_t)(now_us() - begun);
    }
    environment->references++;
    environment->next = environments->first;
    environments->first = environment;
    clean(environments);
    return environment;
}

void environment_unref(struct environments *environments, struct environment *environment)
{
    if (environment && --environment->references == 0) {
        clean(environments);
    }
}

/* --- birth and death --- */

struct environments *environments_create(const struct gl *gl)
{
    struct environments *environments = memory_alloc(1, sizeof *environments);

    environments->gl = gl;
    return environments;
}

void environments_destroy(struct environments *environments)
{
    if (!environments) {
        return;
    }
    while (environments->first) {
        struct environment *environment = environments->first;

        environments->first = environment->next;
        destroy(environments, environment);
    }
    free(environments);
}
