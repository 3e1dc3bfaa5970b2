/* SPDX-License-Identifier: MIT */
/* Reads documents and compiles their fields on a thread of its own, one at a time, so that the
 * drawing thread does not wait. Every function belongs to the drawing thread. */
#ifndef RENDERER_SCENE_READER_H
#define RENDERER_SCENE_READER_H

#include "renderer/renderer.h"

struct scene_reader;

/* Borrowed until it was read. */
struct scene_document {
    const void *text;
    size_t length;
    bool portrait;       /* only its nodes count (portrait.h) */
    struct scene *scene; /* instead of a text: it has been read, and its field is recompiled */
    struct field *drawn; /* as opened_scene_make has it */
};

/* Opens a document on the calling thread, which may be any. Where the result has no scene, `error`
 * says why. */
struct opened_scene scene_document_open(const struct scene_document *document);

struct scene_reader *scene_reader_create(void); /* starts the thread; dies without one (aborts) */
/* Waits for what is being read, and drops it. */
void scene_reader_destroy(struct scene_reader *reader);
/* Nothing else may be under way. */
void scene_reader_begin(struct scene_reader *reader, const struct scene_document *document);
/* Gives out the result, once. False: it is not there yet, or nothing was begun. */
bool scene_reader_take(struct scene_reader *reader, struct opened_scene *out);
/* Whether the document has used more processor time than it may. */
bool scene_reader_stuck(const struct scene_reader *reader);

#endif
