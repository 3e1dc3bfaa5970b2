/* SPDX-License-Identifier: MIT */
/* What the commands that draw have in common: the device from the options, scenes by name. */
#ifndef SERVER_LOCAL_RENDER_H
#define SERVER_LOCAL_RENDER_H

#include "options.h"
#include "renderer/renderer.h"

/* The renderer's parameters by the options; strings stay the options'. The renderer's lines go to
 * stderr. Makes the cache directory, and does without one where that fails. */
void local_render_params(const struct options *options, struct renderer_params *out);

/* Gives the renderer the file that the scene names: one that is built in, or one of --asset. */
bool local_render_give_files(struct renderer *renderer, const struct scene *scene,
                             const struct options *options, struct error *err);
/* One that is built in. */
void local_render_give_example_file(struct renderer *renderer, const struct scene *scene);

/* The scene called `name`: a file, "-" for stdin, or "example:NAME". NULL and `err`, whose place
 * starts with the name. Caller destroys. */
struct scene *scene_open(const char *name, struct error *err);

#endif
