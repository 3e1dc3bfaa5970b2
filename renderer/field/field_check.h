/* SPDX-License-Identifier: MIT */
/* All code of a document: what no node or material uses, and what is hidden, too. */
#ifndef RENDERER_FIELD_CHECK_H
#define RENDERER_FIELD_CHECK_H

#include "protocol/scene.h"

/* Compiles the code of every primitive, shader and node, and reads every equation. False, and the
 * first error with its place. Any thread. */
bool field_check_code(const struct scene *scene, struct error *err);

#endif
