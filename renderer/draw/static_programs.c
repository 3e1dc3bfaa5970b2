/* SPDX-License-Identifier: MIT */
#include "static_programs.h"

static const struct pass_source sources[STATIC_COUNT] = {
    [STATIC_CAMERA] = {true, .file = "camera_pass.glsl"},
    [STATIC_TRANSMISSION] = {true, .file = "transmission_pass.glsl"},
    [STATIC_SHADE] = {true, .file = "shade_pass.glsl"},
    [STATIC_PLAIN] = {true, "#define PLAIN\n", .file = "shade_pass.glsl"},
    [STATIC_ACCUMULATE] = {true, .file = "accumulate_pass.glsl"},
    [STATIC_EDGE_DETECT] = {true, .file = "edge_detect_pass.glsl"},
    [STATIC_RESAMPLE] = {true, .file = "resample_pass.glsl"},
};

bool static_programs_init(struct static_programs *out_programs, const struct gl *gl,
                          struct error *err)
{
    struct static_programs common = {0};

    for (int i = 0; i < STATIC_COUNT; i++) {
        if (!pass_init(&common.passes[i], gl, &sources[i], err)) {
            static_programs_finish(&common, gl);
            return false;
        }
    }
    *out_programs = common;
    return true;
}

void static_programs_finish(struct static_programs *programs, const struct gl *gl)
{
    for (int i = 0; i < STATIC_COUNT; i++) {
        pass_finish(&programs->passes[i], gl);
    }
}
