/* SPDX-License-Identifier: MIT */
/* Scenes in the JSON files of Schneider's ray-marching renderer (2024): primitives, shaders,
 * materials, models and scenes, a file each. README.md says what becomes what. Pure: whoever calls
 * reads the files. */
#ifndef PROTOCOL_IMPORT_H
#define PROTOCOL_IMPORT_H

#include "protocol/scene.h"

struct import_file {
    const char *path; /* as messages name it; the last part without .json is what others name */
    const char *text;
    size_t length;
};

struct import_source {
    const struct import_file *files; /* those of which import_reads is false are passed over */
    size_t count;
    const char *scene; /* which, by name or file; NULL: the only one */
    const char *title; /* of the scene; NULL: its own name */
};

/* Whether files of this name are read: those that end with .json. */
bool import_reads(const char *path);
/* NULL and `err`: place is the file, with line and column. `*out_notes` (may be NULL) is an array
 * of texts, what was put right while reading. Caller destroys both. */
struct scene *import_scene(const struct import_source *source, cJSON **out_notes,
                           struct error *err);

#endif
