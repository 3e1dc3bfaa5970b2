/* SPDX-License-Identifier: MIT */
/* The list of environments, and the pictures that each is made of. */
#include "environment.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "protocol/memory.h"
#include "renderer/gl/pass.h"

enum {
    PLAIN_WIDTH = 128, /* of what is drawn where there is no picture; twice the height */
    MIRROR_WIDTH = 128,
    MATT_WIDTH = 32,
};

enum maker { MAKE_PLAIN, MAKE_MIRROR, MAKE_MATT, MAKER_COUNT };

struct environments {
    bool read; /* into memory */
    const struct gl *gl;
    struct pass makers[MAKER_COUNT];
    GLuint frame;
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

/* --- pictures --- */

static int levels_of(int width, int height)
{
    int levels = 1;

    for (int side = width > height ? width : height; side > 1; side /= 2) {
        levels++;
    }
    return levels;
}

static size_t texels_of(int width, int height, int level)
{
    const size_t across = width >> level ? (size_t)(width >> level) : 1;
    const size_t down = height >> level ? (size_t)(height >> level) : 1;

    return across * down;
}

/* Longitudes meet, latitudes end. Counts its bytes with those of its levels. */
static GLuint create_picture(const struct gl *gl, int width, int height, int levels,
                             size_t *out_bytes)
{
    GLuint texture;

    for (int level = 0; level < levels; level++) {
        *out_bytes += DECODED_TEXEL_BYTES * texels_of(width, height, level);
    }

    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->TexStorage2D(GL_TEXTURE_2D, levels, GL_RGBA16F, width, height);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                      levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

/* Draws one mip level of a picture. */
static void make(const struct environments *environments, enum maker maker, GLuint out, int level,
                 int width)
{
    const struct gl *gl = environments->gl;
    const struct pass_place place = {.width = width, .height = width / 2, .mode = PASS_TILE};

    gl->BindImageTexture(IMAGE_ENVIRONMENT, out, level, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    pass_compute(&environments->makers[maker], gl, &place,
                 PASS_ARGS(struct environment_args, .level = level));
}

/* The gradient, or the one colour. */
static void make_plain(const struct environments *environments, struct environment *out)
{
    out->panorama = create_picture(environments->gl, PLAIN_WIDTH, PLAIN_WIDTH / 2,
                                   levels_of(PLAIN_WIDTH, PLAIN_WIDTH / 2), &out->bytes);
    make(environments, MAKE_PLAIN, out->panorama, 0, PLAIN_WIDTH);
}

static void upload(const struct environments *environments, const struct decoded *image,
                   struct environment *out)
{
    const struct gl *gl = environments->gl;

    out->panorama = create_picture(gl, image->width, image->height,
                                   levels_of(image->width, image->height), &out->bytes);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image->width, image->height, GL_RGBA, GL_HALF_FLOAT,
                      image->rgba);
}

/* What is made of `panorama`. */
static void make_light(const struct environments *environments, struct environment *out)
{
    const struct gl *gl = environments->gl;

    out->mirrored = create_picture(gl, MIRROR_WIDTH, MIRROR_WIDTH / 2, MIRROR_LEVELS, &out->bytes);
    out->irradiance = create_picture(gl, MATT_WIDTH, MATT_WIDTH / 2, 1, &out->bytes);
    gl->ActiveTexture(GL_TEXTURE0 + UNIT_PANORAMA);
    gl->BindTexture(GL_TEXTURE_2D, out->panorama);
    gl->GenerateMipmap(GL_TEXTURE_2D);
    for (int level = 0; level < MIRROR_LEVELS; level++) {
        make(environments, MAKE_MIRROR, out->mirrored, level, MIRROR_WIDTH >> level);
    }
    make(environments, MAKE_MATT, out->irradiance, 0, MATT_WIDTH);
}

static void read_picture(const struct gl *gl, GLuint texture, int width, int height, int levels,
                         struct environment *out, int index)
{
    struct engine_sky *sky = &out->skies[index];
    size_t count = 0;

    *sky = (struct engine_sky){.width = width, .height = height, .levels = levels};
    for (int level = 0; level < levels; level++) {
        sky->starts[level] = count;
        count += texels_of(width, height, level);
    }
    sky->texels = memory_alloc(count, 4 * sizeof *sky->texels);
    out->bytes += count * 4 * sizeof *sky->texels;
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    for (int level = 0; level < levels; level++) {
        gl->GetTexImage(GL_TEXTURE_2D, level, GL_RGBA, GL_FLOAT,
                        sky->texels + 4 * sky->starts[level]);
    }
}

/* Into memory. */
static void read_back(const struct gl *gl, const struct decoded *image, struct environment *out)
{
    const int width = image ? image->width : PLAIN_WIDTH;
    const int height = image ? image->height : PLAIN_WIDTH / 2;

    read_picture(gl, out->panorama, width, height, levels_of(width, height), out, 0);
    read_picture(gl, out->mirrored, MIRROR_WIDTH, MIRROR_WIDTH / 2, MIRROR_LEVELS, out, 1);
    read_picture(gl, out->irradiance, MATT_WIDTH, MATT_WIDTH / 2, 1, out, 2);
}

/* --- the list --- */

static void destroy(const struct environments *environments, struct environment *environment)
{
    const GLuint textures[] = {environment->panorama, environment->mirrored,
                               environment->irradiance};

    environments->gl->DeleteTextures(3, textures);
    for (int i = 0; i < ENGINE_SKIES; i++) {
        free(environment->skies[i].texels);
    }
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

static struct environment *create(struct environments *environments,
                                  const struct frame_block *block, const struct decoded *image,
                                  struct error *err)
{
    const struct gl *gl = environments->gl;
    struct environment *environment = memory_alloc(1, sizeof *environment);

    gl->BindBuffer(GL_UNIFORM_BUFFER, environments->frame);
    gl->BufferData(GL_UNIFORM_BUFFER, sizeof *block, block, GL_STREAM_DRAW);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, BINDING_FRAME, environments->frame);
    gl->ActiveTexture(GL_TEXTURE0 + UNIT_PANORAMA);
    if (image) {
        upload(environments, image, environment);
    } else {
        make_plain(environments, environment);
    }
    make_light(environments, environment);
    if (environments->read) {
        read_back(gl, image, environment);
    }
    gl->Finish(); /* so that its time is told apart */
    if (!gl_check(gl, "environment", err)) {
        destroy(environments, environment);
        return NULL;
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
                                     const struct decoded *decoded, uint32_t *out_us,
                                     struct error *err)
{
    const uint64_t begun = now_us(), key = key_of(block, image);
    struct environment **at = find(environments, key), *environment = *at;

    *out_us = 0;
    if (environment) {
        *at = environment->next;
    } else {
        environment = create(environments, block, decoded, err);
        if (!environment) {
            return NULL;
        }
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

struct environments *environments_create(const struct gl *gl, bool read, struct error *err)
{
    static const char *const files[MAKER_COUNT] = {[MAKE_PLAIN] = "environment_sky.glsl",
                                                   [MAKE_MIRROR] = "environment_mirror.glsl",
                                                   [MAKE_MATT] = "environment_matt.glsl"};
    struct environments *environments = memory_alloc(1, sizeof *environments);

    environments->gl = gl;
    environments->read = read;
    gl->GenBuffers(1, &environments->frame);
    for (int i = 0; i < MAKER_COUNT; i++) {
        const struct pass_source source = {.compute = true, .file = files[i]};

        if (!pass_init(&environments->makers[i], gl, &source, err)) {
            environments_destroy(environments);
            return NULL;
        }
    }
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
    for (int i = 0; i < MAKER_COUNT; i++) {
        pass_finish(&environments->makers[i], environments->gl);
    }
    environments->gl->DeleteBuffers(1, &environments->frame);
    free(environments);
}
