/* SPDX-License-Identifier: MIT */
/* Which kind of shaders a GPU draws faster by. It is tried once for a device and its driver, and
 * kept beside compiled shaders. */
#ifndef RENDERER_STAGE_TRIAL_H
#define RENDERER_STAGE_TRIAL_H

#include "renderer.h"

/* RENDER_COMPUTE or RENDER_FRAGMENT: what is kept, or else what a trial says, which compiles a
 * small scene by both and draws it for a few milliseconds. Compute where nothing can be kept, or
 * where a trial ended the process. On the thread of the renderer, whose threads compile. */
enum render_stage stage_trial(struct renderer *renderer);

#endif
