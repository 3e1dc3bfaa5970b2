/* SPDX-License-Identifier: MIT */
/* Texts of shaders with what they include in its place.
 *
 * A line `#include "ray.glsl"` stands for that file of glsl/, the first time that it is named; each
 * file includes whatever it uses. "interface.glsl" is the text of interface.h. A caller adds texts
 * of its own by name, such as the field of a scene; they go before files of that name. Lines keep
 * their numbers by #line, so that drivers' messages can be turned back into file and line. */
#ifndef RENDERER_INCLUDE_H
#define RENDERER_INCLUDE_H

#include "protocol/error.h"
#include "renderer/glsl/files.h"

enum { INCLUDE_FILES_MAX = 64 };

struct shader_text {
    char *text;
    const char *names[INCLUDE_FILES_MAX]; /* borrowed; the index is the number that #line gives */
    int count;
};

/* `head` stands before all, from #version on. `own` ends with a row whose name is NULL, or is NULL.
 * ERROR_INTERNAL where a name is not known. */
bool include_resolve(struct shader_text *out, const char *head, const char *name,
                     const struct glsl_file *own, struct error *err);
void include_finish(struct shader_text *text);

#endif
