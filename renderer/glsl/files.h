/* SPDX-License-Identifier: MIT */
/* The files of renderer/glsl/ as text, embedded by the build. */
#ifndef RENDERER_GLSL_H
#define RENDERER_GLSL_H

struct glsl_file {
    const char *name; /* "march.glsl" */
    const char *text; /* NUL-terminated */
};

/* Sorted by name; the last row has NULL as its name. */
extern const struct glsl_file glsl_files[];

#endif
