/* SPDX-License-Identifier: MIT */
/* Finds the kind of shaders that a GPU draws faster with. The trial is made once for a device and
 * its driver. Its result is kept beside the compiled shaders. */
#ifndef RENDERER_STAGE_TRIAL_H
#define RENDERER_STAGE_TRIAL_H

#include "renderer.h"

/* RENDER_COMPUTE or RENDER_FRAGMENT: the kept result, or that of a trial, which compiles a small
 * scene for both and draws it for a few milliseconds. RENDER_COMPUTE where nothing can be kept, or
 * where a trial has ended the process. Called on the renderer's thread; the renderer's own threads
 * compile. */
enum render_stage stage_trial(struct renderer *renderer);

#endif
