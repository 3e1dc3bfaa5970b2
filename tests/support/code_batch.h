/* SPDX-License-Identifier: MIT */
/* Users' codes that run in one program on a device and are compared with C, at random points. */
#ifndef TESTS_SUPPORT_CODE_BATCH_H
#define TESTS_SUPPORT_CODE_BATCH_H

#include "code_gpu.h"

enum { CODE_BATCH_MAX = 40 };

struct code_batch {
    struct code_gpu *gpu;
    const double *numbers; /* of all declared parameters, 4 * LIMIT_DECLARED of them */
    bool ours; /* texts are as those of equations, which may call jets.h; not for the engine */
    struct code_gpu_job jobs[CODE_BATCH_MAX];
    char *texts[CODE_BATCH_MAX];
    size_t count;
};

/* Fails the test where the text is refused. */
void code_batch_add(struct code_batch *batch, const char *text, enum code_use use,
                    const struct param *params);
/* Fails the test where the driver refuses a text, or where one of them differs from C at more than
 * `allowed` of CODE_GPU_POINTS. Empties the batch. */
void code_batch_run(struct code_batch *batch, size_t allowed);

#endif
