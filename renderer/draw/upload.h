/* SPDX-License-Identifier: MIT */
/* A field with its numbers on the device, shared by the snapshots that show it. A numeric edit
 * patches both into the field and the numbers of a snapshot that is no longer drawn. No memory of
 * the size of a field is allocated or copied. References are counted by the drawing thread. */
#ifndef RENDERER_UPLOAD_H
#define RENDERER_UPLOAD_H

#include "renderer/engine/engine.h"
#include "renderer/field/field_patch.h"
#include "renderer/gl/param_buffer.h"
#include "shared_tapes.h"

struct upload {
    int references;
    struct field *field;
    struct upload_copy {
        struct param_buffer params; /* none until they are asked for */
        struct field_span stale;    /* numbers of the field that these are without yet */
    } copies[2];                    /* in a buffer, in a texture */
    struct shared_tapes *tapes;     /* for an interpreter; NULL: none are made yet */
};

/* Takes the reference of the field. */
struct upload *upload_create(struct field *field);
struct upload *upload_ref(struct upload *upload);
void upload_unref(struct upload *upload, const struct gl *gl); /* NULL: nothing */
/* Patches the field (field_patch). NULL: it has to be compiled. `spare` may be NULL; else the
 * caller holds its only reference. */
struct upload *upload_patch(struct upload *from, struct upload *spare, const struct scene *scene,
                            const cJSON *ops);
/* Brings the numbers on the device up to date, in a texture or a buffer. `capacity`: vec4s that
 * programs declare. */
const struct param_buffer *upload_params(struct upload *upload, const struct gl *gl,
                                         bool in_texture, size_t capacity);
/* The texture with the tapes of the field, made of the program when they are first asked for, or
 * renewed. Other uploads may ask for other tapes in it: it is to be asked for before each use. */
GLuint upload_tapes(struct upload *upload, const struct gl *gl, struct engine_program *program,
                    const struct engine_extent *extent);

/* The last patched uploads of a scene: the drawn one, the newest, and one to write into. */
enum { UPLOADS_KEPT = 3 };
struct upload_pool {
    struct upload *kept[UPLOADS_KEPT];
};
/* An upload of the pool that has no other reference; NULL: there is none. */
struct upload *upload_pool_spare(const struct upload_pool *pool);
/* Puts it in the place of one that nobody else holds, or of the first. */
void upload_pool_keep(struct upload_pool *pool, struct upload *upload, const struct gl *gl);
void upload_pool_empty(struct upload_pool *pool, const struct gl *gl);

#endif
