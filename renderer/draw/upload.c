/* SPDX-License-Identifier: MIT */
/* Fields with their numbers on the device. */
#include "upload.h"

#include <stdlib.h>

#include "protocol/memory.h"

struct upload *upload_create(struct field *field)
{
    struct upload *upload = memory_alloc(1, sizeof *upload);

    upload->references = 1;
    upload->field = field;
    return upload;
}

struct upload *upload_ref(struct upload *upload)
{
    upload->references++;
    return upload;
}

static void drop_tapes(struct upload *upload)
{
    if (upload->tapes && shared_tapes_owner(upload->tapes) == upload) {
        shared_tapes_own(upload->tapes, NULL);
    }
    shared_tapes_unref(upload->tapes);
    upload->tapes = NULL;
}

/* Those of the upload that it was patched of. They have other numbers. */
static void share_tapes(struct upload *upload, const struct upload *from)
{
    struct shared_tapes *tapes = shared_tapes_ref(from->tapes);

    drop_tapes(upload);
    upload->tapes = tapes;
}

void upload_unref(struct upload *upload, const struct gl *gl)
{
    if (!upload || --upload->references > 0) {
        return;
    }
    for (int i = 0; i < 2; i++) {
        param_buffer_finish(&upload->copies[i].params, gl);
    }
    drop_tapes(upload);
    field_unref(upload->field);
    free(upload);
}

static void add_stale(struct field_span *stale, const struct field_span *changed)
{
    if (stale->first == stale->end) {
        *stale = *changed;
        return;
    }
    stale->first = changed->first < stale->first ? changed->first : stale->first;
    stale->end = changed->end > stale->end ? changed->end : stale->end;
}

struct upload *upload_patch(struct upload *from, struct upload *spare, const struct scene *scene,
                            const cJSON *ops)
{
    struct field_span changed;
    struct field *field =
        field_patch(from->field, spare ? spare->field : NULL, scene, ops, &changed);

    if (!field) {
        return NULL;
    }
    if (field == from->field) {
        field_unref(field);
        return upload_ref(from);
    }
    if (spare && field == spare->field) {
        field_unref(field);
        add_stale(&spare->copies[0].stale, &changed);
        add_stale(&spare->copies[1].stale, &changed);
        share_tapes(spare, from);
        return upload_ref(spare);
    }
    struct upload *upload = upload_create(field);
    share_tapes(upload, from);
    return upload;
}

const struct param_buffer *upload_params(struct upload *upload, const struct gl *gl,
                                         bool in_texture, size_t capacity)
{
    const struct field *field = upload->field;
    struct upload_copy *copy = &upload->copies[in_texture];
    struct param_buffer *params = &copy->params;
    const struct field_span *stale = &copy->stale;

    if (params->buffer + params->texture == 0) {
        param_buffer_init(params, gl, in_texture, field->params, field->vec4_count, capacity);
    } else if (stale->first < stale->end) {
        param_buffer_update(params, gl, field->params, stale->first, stale->end);
    }
    copy->stale = (struct field_span){0, 0};
    return params;
}

GLuint upload_tapes(struct upload *upload, const struct gl *gl, struct engine_program *program,
                    const struct engine_extent *extent)
{
    const bool has =
        upload->tapes && (shared_tapes_owner(upload->tapes) == upload ||
                          shared_tapes_renew(upload->tapes, program, upload->field, extent));

    if (!has) {
        drop_tapes(upload);
        upload->tapes = shared_tapes_create(gl, program, upload->field, extent);
    }
    shared_tapes_own(upload->tapes, upload);
    return shared_tapes_texture(upload->tapes);
}

struct upload *upload_pool_spare(const struct upload_pool *pool)
{
    for (int i = 0; i < UPLOADS_KEPT; i++) {
        if (pool->kept[i] && pool->kept[i]->references == 1) {
            return pool->kept[i];
        }
    }
    return NULL;
}

void upload_pool_keep(struct upload_pool *pool, struct upload *upload, const struct gl *gl)
{
    int place = 0;

    for (int i = 0; i < UPLOADS_KEPT; i++) {
        if (pool->kept[i] == upload) {
            return;
        }
        if (!pool->kept[i] || pool->kept[i]->references == 1) {
            place = i;
        }
    }
    upload_unref(pool->kept[place], gl);
    pool->kept[place] = upload_ref(upload);
}

void upload_pool_empty(struct upload_pool *pool, const struct gl *gl)
{
    for (int i = 0; i < UPLOADS_KEPT; i++) {
        upload_unref(pool->kept[i], gl);
        pool->kept[i] = NULL;
    }
}
