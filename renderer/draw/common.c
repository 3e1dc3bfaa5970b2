/* SPDX-License-Identifier: MIT */
#include "common.h"

#define SHADE_FILES                                                                                \
    "frame.glsl", "group.glsl", "ray.glsl", "ray_load.glsl", "surface.glsl", "gbuffer.glsl",       \
        "lights.glsl", "optics.glsl", "brdf.glsl", "sky.glsl", "fog.glsl", "list.glsl",            \
        "stack.glsl", "shade.glsl", "paths.glsl", "shade_pass.glsl"

static const char *const files[COMMON_COUNT][20] = {
    [COMMON_CAMERA] = {"frame.glsl", "group.glsl", "ray.glsl", "camera.glsl", "camera_pass.glsl",
                       NULL},
    [COMMON_CLEAR] = {"frame.glsl", "group.glsl", "ray.glsl", "ray_load.glsl", "surface.glsl",
                      "gbuffer.glsl", "lights.glsl", "optics.glsl", "list.glsl", "clear_pass.glsl",
                      NULL},
    [COMMON_SHADE] = {SHADE_FILES},
    [COMMON_PLAIN] = {SHADE_FILES},
    [COMMON_GATHER] = {"frame.glsl", "group.glsl", "tone.glsl", "gather_pass.glsl", NULL},
    [COMMON_EDGES] = {"frame.glsl", "group.glsl", "ray.glsl", "camera.glsl", "list.glsl",
                      "edges.glsl", "edges_pass.glsl", NULL},
    [COMMON_AGAIN] = {"frame.glsl", "group.glsl", "list.glsl", "again_pass.glsl", NULL},
};

bool common_init(struct common *out_common, const struct gl *gl, struct error *err)
{
    struct common common = {0};

    for (int i = 0; i < COMMON_COUNT; i++) {
        const struct pass_source source = {.compute = true,
                                           .defines = i == COMMON_PLAIN ? "#define PLAIN\n" : "",
                                           .files = files[i]};

        if (!pass_init(&common.passes[i], gl, &source, err)) {
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
