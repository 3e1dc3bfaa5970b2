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
static uint64_t mix_sun(uint64_t state, const struct frame_block *block)
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

static uint64_t key_of(const struct frame_block *block, const char *image)
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

static GLuint upload(const struct gl *gl, const struct engine_sky *sky)
{
    GLuint texture;

    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->TexStorage2D(GL_TEXTURE_2D, sky->levels, GL_RGBA16F, sky->width, sky->height);
    texture_set_sky(gl, sky->levels);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    for (int level = 0; level < sky->levels; level++) {
        gl->TexSubImage2D(GL_TEXTURE_2D, level, 0, 0, engine_sky_side(sky->width, level),
                          engine_sky_side(sky->height, level), GL_RGBA, GL_HALF_FLOAT,
                          sky->texels[level]);
    }
    return texture;
}

void environment_bind(struct environment *environment, const struct gl *gl)
{
    static const GLenum units[ENGINE_SKIES] = {UNIT_PANORAMA, UNIT_MIRRORED, UNIT_IRRADIANCE};

    for (int i = 0; i < ENGINE_SKIES; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + units[i]);
        if (environment->textures[i] == 0) {
            environment->textures[i] = upload(gl, &environment->skies[i]);
        }
        gl->BindTexture(GL_TEXTURE_2D, environment->textures[i]);
    }
}

/* --- the list --- */

static void destroy(const struct environments *environments, struct environment *environment)
{
    if (environment->textures[0]) {
        environments->gl->DeleteTextures(ENGINE_SKIES, environment->textures);
    }
    engine_skies_finish(environment->skies);
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

static struct environment *create(const struct frame_block *block, struct engine_sky *skies)
{
    struct environment *environment = memory_alloc(1, sizeof *environment);

    if (skies) {
        memcpy(environment->skies, skies, sizeof environment->skies);
        memset(skies, 0, sizeof environment->skies);
    } else {
        engine_skies_make(block, NULL, 0, 0, environment->skies);
    }
    for (int i = 0; i < ENGINE_SKIES; i++) {
        environment->bytes += environment->skies[i].bytes;
    }
    return environment;
}

void environment_leave_out(struct frame_block *block)
{
    block->sky_kind = SKY_SOLID;
    block->sky_turn[0] = 1;
    block->sky_turn[1] = 0;
    block->sky_brightness = 1;
}

static uint64_t now_us(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000 + (uint64_t)now.tv_nsec / 1000;
}

bool environments_have(struct environments *environments, const struct frame_block *block,
                       const char *image)
{
    return *find(environments, key_of(block, image)) != NULL;
}

struct environment *environments_get(struct environments *environments,
                                     const struct frame_block *block, const char *image,
                                     struct engine_sky *skies, uint32_t *out_us)
{
    const uint64_t begun = now_us(), key = key_of(block, image);
    struct environment **at = find(environments, key), *environment = *at;

    *out_us = 0;
    if (environment) {
        *at = environment->next;
    } else {
        environment = create(block, skies);
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
