/* SPDX-License-Identifier: MIT */
/* Scenes and pictures for tests that draw: whatever goes wrong fails the test with its message. */
#ifndef TESTS_SUPPORT_DRAWING_H
#define TESTS_SUPPORT_DRAWING_H

#include "renderer/renderer.h"

/* On the best device, with the shader cache of the environment's FIELDCAST_CACHE, if any. */
struct renderer *drawing_renderer(void);
struct scene *drawing_parse(const char *text);
struct scene *drawing_read(const char *path);
/* One output, of the newest revision. `desc` says the rest. */
struct image drawing_of(struct resident *resident, const struct job_desc *desc, enum aov aov);

#endif
