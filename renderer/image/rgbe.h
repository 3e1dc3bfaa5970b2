/* SPDX-License-Identifier: MIT */
/* Pixels of Radiance files: three mantissas of 8 bits and their common exponent. */
#ifndef RENDERER_RGBE_H
#define RENDERER_RGBE_H

enum {
    RGBE_BIAS = 136,        /* mantissas count 2 to (exponent - RGBE_BIAS) */
    RGBE_RUNS_LEAST = 8,    /* widths of rows with runs of each component: from these */
    RGBE_RUNS_MOST = 32767, /* to these */
};

#endif
