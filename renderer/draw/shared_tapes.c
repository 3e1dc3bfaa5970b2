/* SPDX-License-Identifier: MIT */
#include "shared_tapes.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "renderer/engine/tapes.h"
#include "renderer/gl/tape_texture.h"

struct shared_tapes {
    int references;
    const struct gl *gl;
    const void *owner;
    struct engine_extent asked, made; /* larger cubes are made than those that are asked for, */
    size_t rows_most;                 /* where a texture has no more rows */
    struct engine_tapes *tapes;
    size_t rows; /* of the texture */
    GLuint texture;
};

static void write_rows(void *data, size_t first, size_t count, const uint32_t (*texels)[4])
{
    const struct shared_tapes *tapes = data;

    tape_texture_write(tapes->texture, tapes->gl, first, count, texels);
}

static void drop_texture(struct shared_tapes *tapes)
{
    if (tapes->texture) {
        tapes->gl->DeleteTextures(1, &tapes->texture);
    }
    tapes->texture = 0;
}

static void write_texture(struct shared_tapes *tapes)
{
    const size_t rows = engine_tapes_rows(tapes->tapes);

    if (rows != tapes->rows) {
        drop_texture(tapes);
        tapes->texture = tape_texture_create(tapes->gl, rows);
        tapes->rows = rows;
    }
    engine_tapes_tell(tapes->tapes, write_rows, tapes);
}

static bool has_rows(const struct shared_tapes *tapes)
{
    return engine_tapes_rows(tapes->tapes) <= tapes->rows_most;
}

static void make(struct shared_tapes *tapes, struct engine_program *program,
                 const struct field *field)
{
    struct vocabulary vocabulary = vocabulary_of(field);

    tapes->tapes = engine_tapes_create(program, field->params, &tapes->made, &vocabulary);
    while (!has_rows(tapes) && tapes->made.least < tapes->made.reach) {
        engine_tapes_destroy(tapes->tapes);
        tapes->made.least *= 4;
        tapes->tapes = engine_tapes_create(program, field->params, &tapes->made, &vocabulary);
    }
    vocabulary_finish(&vocabulary);
}

struct shared_tapes *shared_tapes_create(const struct gl *gl, struct engine_program *program,
                                         const struct field *field,
                                         const struct engine_extent *extent)
{
    struct shared_tapes *tapes = memory_alloc(1, sizeof *tapes);
    GLint rows = 0;

    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &rows);
    *tapes = (struct shared_tapes){
        .references = 1, .gl = gl, .asked = *extent, .made = *extent, .rows_most = (size_t)rows};
    make(tapes, program, field);
    write_texture(tapes);
    return tapes;
}

struct shared_tapes *shared_tapes_ref(struct shared_tapes *tapes)
{
    if (tapes) {
        tapes->references++;
    }
    return tapes;
}

void shared_tapes_unref(struct shared_tapes *tapes)
{
    if (tapes && --tapes->references == 0) {
        drop_texture(tapes);
        engine_tapes_destroy(tapes->tapes);
        free(tapes);
    }
}

bool shared_tapes_renew(struct shared_tapes *tapes, const struct engine_program *program,
                        const struct field *field, const struct engine_extent *extent)
{
    if (memcmp(&tapes->asked, extent, sizeof *extent) != 0 ||
        !engine_tapes_renew(tapes->tapes, program, field->params, &tapes->made) ||
        !has_rows(tapes)) {
        return false;
    }
    write_texture(tapes);
    return true;
}

GLuint shared_tapes_texture(const struct shared_tapes *tapes)
{
    return tapes->texture;
}

const void *shared_tapes_owner(const struct shared_tapes *tapes)
{
    return tapes->owner;
}

void shared_tapes_own(struct shared_tapes *tapes, const void *owner)
{
    tapes->owner = owner;
}
