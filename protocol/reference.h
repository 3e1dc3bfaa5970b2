/* SPDX-License-Identifier: MIT */
/* The registry as a page to read: protocol/REFERENCE.md is its output. */
#ifndef PROTOCOL_REFERENCE_H
#define PROTOCOL_REFERENCE_H

/* Markdown: every node type with its picture (reference/TYPE.jpg), parameters, ranges, exactness
 * and source; then lights, volumes, shaders, camera, environment, render settings and
 * limits. Caller frees. */
char *reference_markdown(void);

#endif
