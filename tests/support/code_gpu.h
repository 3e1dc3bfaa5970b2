/* SPDX-License-Identifier: MIT */
/* Runs what code_write writes, on whatever device EGL gives: points in, values out. */
#ifndef TESTS_SUPPORT_CODE_GPU_H
#define TESTS_SUPPORT_CODE_GPU_H

#include "renderer/code/code.h"
#include "renderer/gl/egl.h"
#include "renderer/gl/gl.h"

enum { CODE_GPU_POINTS = 1024 };

struct code_gpu {
    struct egl egl;
    struct gl gl;
    GLuint buffers[3]; /* points, numbers, values */
};

/* One of those that share a program. */
struct code_gpu_job {
    const struct code *code;
    enum code_use use;
    const struct param *params; /* as compiled */
};

bool code_gpu_init(struct code_gpu *gpu, struct error *err);
void code_gpu_finish(struct code_gpu *gpu);
/* What a shader is told about a point. */
struct code_shading code_gpu_shading(const double p[3]);
/* What stands for a Surface among the values. */
void code_gpu_digest(const struct code_surface *surface, double out[4]);
/* Value of job j at point i: out[j * CODE_GPU_POINTS + i], a distance in its first component. All
 * get the same numbers. False: the driver refuses the program, and `err` has its words. */
bool code_gpu_run(struct code_gpu *gpu, const struct code_gpu_job *jobs, size_t count,
                  const float (*points)[4], const float *numbers, float (*out)[4],
                  struct error *err);

#endif
