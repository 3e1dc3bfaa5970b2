/* SPDX-License-Identifier: MIT */
/* Shared by compute and fragment shaders: the objects of a picture, and reading its pixels back.
 * Private to draw_compute.c and draw_fragment.c. */
#ifndef RENDERER_DRAW_GL_H
#define RENDERER_DRAW_GL_H

#include "draw_internal.h"

bool draw_gl_begin(struct draw *draw, struct draw_picture *picture, enum shader_kind shader_kind,
                   const struct frame_uniforms *block, struct error *err);
void draw_gl_end(struct draw *draw, struct draw_picture *picture);

/* Makes textures for the sums of a region; `counted`: the format of those that count samples. */
void draw_gl_keep(struct draw *draw, struct draw_picture *picture, struct tile region,
                  GLenum counted);
/* Copies the tile's sums and counts from these textures to the kept ones, or `back`. */
void draw_gl_copy_kept(const struct gl *gl, const struct draw_picture *picture, struct tile tile,
                       GLuint pixels, GLuint counted, bool back);

/* Of the slot's tile, with its margin. */
struct dispatch_args draw_gl_dispatch(const struct draw_picture *picture,
                                      const struct tile_in_flight *slot);
/* Binds what is the same for a whole picture. */
void draw_gl_bind(const struct draw *draw, const struct draw_picture *picture,
                  const struct draw_scene *scene);
/* Resolves one output to pixels and starts to read them back. Its inputs are bound already. */
void draw_gl_resolve(struct draw *draw, const struct draw_picture *picture,
                     const struct tile_in_flight *slot, const struct outputs *outputs,
                     const struct output_format *format);
/* Starts to read the current framebuffer back. */
void draw_gl_read(const struct gl *gl, GLuint buffer, int width, int height, GLenum format,
                  GLenum type);
/* Sets the fence behind all commands of a tile. */
void draw_gl_send(struct draw *draw, struct tile_in_flight *slot);
bool draw_gl_wait(const struct draw *draw, struct tile_in_flight *slot, struct error *err);
bool draw_gl_collect(struct draw *draw, struct draw_picture *picture, int index, enum aov aov,
                     uint8_t *to, size_t stride, struct error *err);

#endif
