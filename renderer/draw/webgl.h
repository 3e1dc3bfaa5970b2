/* SPDX-License-Identifier: MIT */
/* A picture of a scene as the text of one fragment shader of WebGL 2 (GLSL ES 3.00): all numbers
 * are constants, the field is not interpreted, nothing is pruned, and no texture is read. */
#ifndef RENDERER_WEBGL_H
#define RENDERER_WEBGL_H

#include "frame_uniforms.h"
#include "render_settings.h"
#include "renderer/field/field.h"

/* `target`: what the camera turns around. A picture of the environment is left out. Any thread, no
 * GL. Caller frees; NULL and `err` where a file is missing. */
char *webgl_text(const struct field *field, const struct frame_uniforms *frame,
                 const struct render_settings *settings, const double target[3], struct error *err);

#endif
