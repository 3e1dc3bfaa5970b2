/* SPDX-License-Identifier: MIT */
/* Textures, lists and framebuffers of a tile. */
#include "targets.h"

#include <stddef.h>
#include <stdint.h>

#include "pass.h"
#include "protocol/limits.h"

enum { STACK_HEAD_BYTES = 16, WAITING_BYTES = 64, LIST_HEAD_BYTES = 16 };

/* All textures but the outputs and the array. */
static const struct {
    size_t offset; /* in struct targets */
    GLenum format;
} textures[] = {
#define SET(name)                                                                                  \
    {offsetof(struct targets, name.origin), GL_RGBA32F},                                           \
        {offsetof(struct targets, name.direction), GL_RGBA32F},                                    \
        {offsetof(struct targets, name.geometry), GL_RGBA32F},                                     \
        {offsetof(struct targets, name.material0), GL_RGBA32UI},                                   \
        {offsetof(struct targets, name.material1), GL_RGBA32UI},                                   \
        {offsetof(struct targets, name.throughput), GL_RGBA32F},                                   \
        {offsetof(struct targets, name.absorption), GL_RGBA16F},                                   \
    {                                                                                              \
        offsetof(struct targets, name.steps), GL_RG32F                                             \
    }
    SET(eye),
    SET(light),
#undef SET
    {offsetof(struct targets, inscattering), GL_RGBA16F},
    {offsetof(struct targets, total), GL_RGBA32F},
    {offsetof(struct targets, pixels), GL_RGBA32F},
    {offsetof(struct targets, counted), GL_RG32F},
};
enum { TEXTURE_COUNT = sizeof textures / sizeof textures[0] };

static GLuint *texture_at(struct targets *targets, int i)
{
    return (GLuint *)(void *)((char *)targets + textures[i].offset);
}

static GLuint make_storage(const struct gl *gl, size_t bytes)
{
    GLuint buffer = 0;

    gl->GenBuffers(1, &buffer);
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer);
    gl->BufferData(GL_SHADER_STORAGE_BUFFER, (GLsizeiptr)bytes, NULL, GL_DYNAMIC_COPY);
    return buffer;
}

static void make_buffers(struct targets *targets, const struct gl *gl)
{
    const size_t samples = (size_t)targets->side * (size_t)targets->side;
    const uint32_t head[4] = {0, (uint32_t)targets->side};

    for (int i = 0; i < LIST_COUNT; i++) {
        targets->lists[i] = make_storage(gl, LIST_HEAD_BYTES + 4 * samples);
        targets_begin_list(targets, gl, (enum target_list)i);
    }
    targets->stack = make_storage(gl, STACK_HEAD_BYTES + WAITING_BYTES * STACK_DEPTH * samples);
    gl->BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof head, head);
}

int targets_starts_side(int side)
{
    int blocks = GROUP_SIDE;

    while (blocks * BLOCK_SIDE < side + BLOCK_SIDE) {
        blocks *= 2;
    }
    return blocks;
}

bool targets_init(struct targets *out_targets, const struct gl *gl, int side, struct error *err)
{
    const int blocks = targets_starts_side(side);
    struct targets targets = {.side = side};
    bool complete;

    for (int i = 0; i < TEXTURE_COUNT; i++) {
        *texture_at(&targets, i) = texture_create(gl, textures[i].format, side, side);
    }
    targets.starts = texture_create(gl, GL_R32F, blocks, blocks);
    targets.visibility = texture_create_layers(gl, GL_RGBA16F, side, LIMIT_LIGHTS);
    complete = outputs_init(&targets.outputs, gl, side);
    make_buffers(&targets, gl);
    /* The same state in every context: drivers compile anew for another one. */
    gl->Disable(GL_DITHER);
    gl->GenVertexArrays(1, &targets.vertices);
    gl->BindVertexArray(targets.vertices);
    if (!gl_check(gl, "making targets", err)) {
        goto fail;
    }
    if (!complete) {
        error_set(err, ERROR_UNAVAILABLE, "", "the driver cannot draw into the formats needed");
        goto fail;
    }
    *out_targets = targets;
    return true;
fail:
    targets_finish(&targets, gl);
    return false;
}

void targets_finish(struct targets *targets, const struct gl *gl)
{
    for (int i = 0; i < TEXTURE_COUNT; i++) {
        gl->DeleteTextures(1, texture_at(targets, i));
    }
    gl->DeleteTextures(1, &targets->starts);
    gl->DeleteTextures(1, &targets->visibility);
    outputs_finish(&targets->outputs, gl);
    gl->DeleteBuffers(LIST_COUNT, targets->lists);
    gl->DeleteBuffers(1, &targets->stack);
    gl->DeleteVertexArrays(1, &targets->vertices);
    *targets = (struct targets){0};
}

static void bind_image(const struct gl *gl, GLuint unit, GLuint texture, GLenum format)
{
    gl->BindImageTexture(unit, texture, 0, GL_TRUE, 0, GL_READ_WRITE, format);
}

void targets_bind(const struct targets *targets, const struct gl *gl)
{
    gl->BindVertexArray(targets->vertices);
    texture_bind(gl, UNIT_TOTAL, targets->total);
    texture_bind(gl, UNIT_INSCATTERING, targets->inscattering);
    texture_bind(gl, UNIT_PIXELS, targets->pixels);
    texture_bind(gl, UNIT_COUNTED, targets->counted);
    gl->ActiveTexture(GL_TEXTURE0 + UNIT_VISIBILITY);
    gl->BindTexture(GL_TEXTURE_2D_ARRAY, targets->visibility);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_LIST, targets->lists[LIST_EDGES]);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_NEXT, targets->lists[LIST_EDGES]);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_STACK, targets->stack);
}

static void bind_set(const struct gl *gl, const struct ray_set *set)
{
    texture_bind(gl, UNIT_RAY_ORIGIN, set->origin);
    texture_bind(gl, UNIT_RAY_DIRECTION, set->direction);
    texture_bind(gl, UNIT_GEOMETRY, set->geometry);
    texture_bind(gl, UNIT_MATERIAL0, set->material0);
    texture_bind(gl, UNIT_MATERIAL1, set->material1);
    texture_bind(gl, UNIT_STEPS, set->steps);
}

void targets_bind_field(const struct targets *targets, const struct gl *gl,
                        const struct ray_set *set)
{
    bind_set(gl, set);
    bind_image(gl, IMAGE_GEOMETRY, set->geometry, GL_RGBA32F);
    bind_image(gl, IMAGE_MATERIAL0, set->material0, GL_RGBA32UI);
    bind_image(gl, IMAGE_MATERIAL1, set->material1, GL_RGBA32UI);
    bind_image(gl, IMAGE_STEPS, set->steps, GL_RG32F);
    bind_image(gl, IMAGE_STARTS, targets->starts, GL_R32F);
    bind_image(gl, IMAGE_VISIBILITY, targets->visibility, GL_RGBA16F);
    bind_image(gl, IMAGE_INSCATTERING, targets->inscattering, GL_RGBA16F);
}

void targets_bind_static(const struct targets *targets, const struct gl *gl,
                         const struct ray_set *read, const struct ray_set *write)
{
    bind_set(gl, read);
    bind_image(gl, IMAGE_RAY_ORIGIN, write->origin, GL_RGBA32F);
    bind_image(gl, IMAGE_RAY_DIRECTION, write->direction, GL_RGBA32F);
    bind_image(gl, IMAGE_THROUGHPUT, write->throughput, GL_RGBA32F);
    bind_image(gl, IMAGE_ABSORPTION, write->absorption, GL_RGBA16F);
    bind_image(gl, IMAGE_TOTAL, targets->total, GL_RGBA32F);
    bind_image(gl, IMAGE_STATIC_VISIBILITY, targets->visibility, GL_RGBA16F);
    bind_image(gl, IMAGE_PIXELS, targets->pixels, GL_RGBA32F);
    bind_image(gl, IMAGE_COUNTED, targets->counted, GL_RG32F);
}

void targets_begin_list(const struct targets *targets, const struct gl *gl, enum target_list list)
{
    static const uint32_t empty[4] = {0, 1, 1, 0};

    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, targets->lists[list]);
    gl->BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof empty, empty);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_NEXT, targets->lists[list]);
}
