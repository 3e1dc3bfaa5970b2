/* SPDX-License-Identifier: MIT */
/* Shared code of the commands that draw: the device by the options, scenes by name. */
#ifndef SERVER_LOCAL_RENDER_H
#define SERVER_LOCAL_RENDER_H

#include "options.h"
#include "renderer/renderer.h"

/* Fills in the renderer's parameters by the options, which own the strings. The renderer logs to
 * stderr. Makes the cache directory; where that fails, the renderer has no cache. */
void local_render_params(const struct options *options, struct renderer_params *out);

/* Gives the renderer the file that the scene names: a built-in one or one of --asset. */
bool local_render_give_files(struct renderer *renderer, const struct scene *scene,
                             const struct options *options, struct error *err);
/* The same for a built-in file. */
void local_render_give_example_file(struct renderer *renderer, const struct scene *scene);

/* Opens a scene: a file, "-" for stdin, or "example:NAME". NULL and `err`, whose place starts with
 * the name. Caller destroys. */
struct scene *scene_open(const char *name, struct error *err);

#endif
