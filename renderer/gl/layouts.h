/* SPDX-License-Identifier: MIT */
/* Where the uniforms of a fragment shader are. The text says it by layout(binding = ...) and
 * layout(location = ...), which OpenGL 3.3 has not for uniforms. So drivers get the text without
 * these, and what they say is set after linking. */
#ifndef RENDERER_LAYOUTS_H
#define RENDERER_LAYOUTS_H

#include "gl.h"
#include "renderer/glsl/interface.h"

/* Spaces in the place of each; lines and columns stay. */
void layouts_leave_out(char *text);
/* Sets units and blocks of a linked program as `text` has them. Writes the location of each member
 * of `dispatch` and `args` to where the text wants it; -1: the program does not use it. */
void layouts_set(const struct gl *gl, GLuint program, const char *text,
                 GLint out_locations[LOCATION_COUNT]);

#endif
