/* SPDX-License-Identifier: MIT */
#include "common.h"

static const struct pass_source sources[COMMON_COUNT] = {
    [COMMON_CAMERA] = {true, .file = "camera_pass.glsl"},
    [COMMON_CLEAR] = {true, .file = "clear_pass.glsl"},
    [COMMON_SHADE] = {true, .file = "shade_pass.glsl"},
    [COMMON_PLAIN] = {true, "#define PLAIN\n", "shade_pass.glsl"},
    [COMMON_GATHER] = {true, .file = "gather_pass.glsl"},
    [COMMON_EDGES] = {true, .file = "edges_pass.glsl"},
    [COMMON_AGAIN] = {true, .file = "again_pass.glsl"},
};

bool common_init(struct common *out_common, const struct gl *gl, struct error *err)
{
    struct common common = {0};

    for (int i = 0; i < COMMON_COUNT; i++) {
        if (!pass_init(&common.passes[i], gl, &sources[i], err)) {
            common_finish(&common, gl);
            return false;
        }
    }
    *out_common = common;
    return true;
}

void common_finish(struct common *common, const struct gl *gl)
{
    for (int i = 0; i < COMMON_COUNT; i++) {
        pass_finish(&common->passes[i], gl);
    }
}
