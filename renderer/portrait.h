/* SPDX-License-Identifier: MIT */
/* A document as a portrait of what its tree shows. Lights, surroundings, settings and camera are
 * the same for every portrait, so that pictures of parts of a scene can be compared. The camera
 * looks from the right and a little from above. The part fills a picture that is PORTRAIT_ASPECT
 * times as wide as high. A part without an end is cut by a box around its middle. Pure; any
 * thread. */
#ifndef RENDERER_PORTRAIT_H
#define RENDERER_PORTRAIT_H

#include "protocol/scene.h"

#define PORTRAIT_ASPECT 1.5

/* The scene to be drawn, of a document that has no camera, lights, environment and render
 * settings; they are added to it. NULL and `err` where it cannot be read, or shows nothing. Takes
 * some milliseconds at most. Caller destroys. */
struct scene *portrait_scene(cJSON *document, struct error *err);

#endif
