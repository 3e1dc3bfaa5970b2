/* SPDX-License-Identifier: MIT */
/* A field with its numbers on the device, shared by the snapshots that show it. A numeric edit
 * patches both into the field and the numbers of a snapshot that is no longer drawn. No memory of
 * the size of a field is allocated or copied. References are counted by the drawing thread. */
#ifndef RENDERER_UPLOAD_H
#define RENDERER_UPLOAD_H

#include "renderer/field/field_patch.h"
#include "renderer/gl/param_buffer.h"

struct upload {
    int references;
    struct field *field;
    struct param_buffer params; /* none until they are asked for */
    struct field_span stale;    /* those that are others in the field */
};

/* Takes the reference of the field. */
struct upload *upload_create(struct field *field);
struct upload *upload_ref(struct upload *upload);
void upload_unref(struct upload *upload, const struct gl *gl); /* NULL: nothing */
/* As field_patch: NULL where the field has to be compiled. `spare` (may be NULL): the caller
 * holds its only reference. */
struct upload *upload_patch(struct upload *from, struct upload *spare, const struct scene *scene,
                            const cJSON *ops);
/* On the device as in the field. `capacity`: vec4s that programs declare. */
const struct param_buffer *upload_params(struct upload *upload, const struct gl *gl, bool software,
                                         size_t capacity);

/* The last patched ones of a scene: one that is drawn, the newest, and one to write into. */
enum { UPLOADS_KEPT = 3 };
struct upload_pool {
    struct upload *kept[UPLOADS_KEPT];
};
/* One without other references; NULL: none. */
struct upload *upload_pool_spare(const struct upload_pool *pool);
/* Keeps it in the place of one that is not held, or of the first. */
void upload_pool_keep(struct upload_pool *pool, struct upload *upload, const struct gl *gl);
void upload_pool_empty(struct upload_pool *pool, const struct gl *gl);

#endif
