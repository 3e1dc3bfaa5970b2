/* SPDX-License-Identifier: MIT */
/* A field's tapes on the device. Uploads that come of each other by numeric edits share them: who
 * draws has them renewed for its numbers, and what has changed is written into the texture. Of the
 * drawing thread. */
#ifndef RENDERER_SHARED_TAPES_H
#define RENDERER_SHARED_TAPES_H

#include "renderer/engine/engine.h"
#include "renderer/gl/gl.h"

struct field;
struct shared_tapes;

/* Of the numbers of the field. The program is of its structure. */
struct shared_tapes *shared_tapes_create(const struct gl *gl, struct engine_program *program,
                                         const struct field *field,
                                         const struct engine_extent *extent);
struct shared_tapes *shared_tapes_ref(struct shared_tapes *tapes); /* NULL: nothing */
void shared_tapes_unref(struct shared_tapes *tapes);
/* Makes them those of the numbers of another field. False: they cannot be renewed, and the texture
 * is as it was. */
bool shared_tapes_renew(struct shared_tapes *tapes, const struct engine_program *program,
                        const struct field *field, const struct engine_extent *extent);
GLuint shared_tapes_texture(const struct shared_tapes *tapes);

/* Whose numbers the texture has. NULL: nobody's any more. */
const void *shared_tapes_owner(const struct shared_tapes *tapes);
void shared_tapes_own(struct shared_tapes *tapes, const void *owner);

#endif
