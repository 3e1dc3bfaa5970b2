/* SPDX-License-Identifier: MIT */
/* Reads documents and compiles their fields on a thread of its own, one at a time, so that who
 * draws does not wait. Every function belongs to the drawing thread. */
#ifndef RENDERER_SCENE_READER_H
#define RENDERER_SCENE_READER_H

#include "renderer.h"

struct scene_reader;

/* Borrowed until it was read. */
struct scene_document {
    const void *text;
    size_t length;
    bool portrait;       /* only its nodes count (portrait.h) */
    struct scene *scene; /* instead of a text: it has been read, and its field is recompiled */
    struct field *drawn; /* as opened_scene_make has it */
};

/* Here and now. Where there is no scene, `error` says why. Any thread. */
struct opened_scene scene_document_open(const struct scene_document *document);

struct scene_reader *scene_reader_create(void); /* starts the thread; dies without one (aborts) */
/* Waits for what is being read, and drops it. */
void scene_reader_destroy(struct scene_reader *reader);
/* While nothing else is being read. */
void scene_reader_begin(struct scene_reader *reader, const struct scene_document *document);
/* Gives out what was read, once; false: it is being read, or there is none. */
bool scene_reader_take(struct scene_reader *reader, struct opened_scene *out);
/* It has taken more of the processor than it may. */
bool scene_reader_stuck(const struct scene_reader *reader);

#endif
