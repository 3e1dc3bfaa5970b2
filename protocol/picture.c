/* SPDX-License-Identifier: MIT */
#include "picture.h"

#include <string.h>

static const struct aov_row aovs[AOV_COUNT] = {
    [AOV_COLOR] = {"color", 4, false, true, "What is seen, with its coverage."},
    [AOV_DEPTH] = {"depth", 1, false, true, "Distance along the ray; infinite where nothing is."},
    [AOV_NORMAL] = {"normal", 3, false, true, "Unit normal in the world; 0 where nothing is."},
    [AOV_POSITION] = {"position", 3, false, false, "Place in the world; 0 where nothing is."},
    [AOV_ID] = {"id", 1, true, true, "1 + the leaf's place in the tree; 0 where nothing is."},
    [AOV_STEPS] = {"steps", 1, false, true, "Steps that the ray took."},
    [AOV_ALBEDO] = {"albedo", 3, false, true, "Colour of the surface, without light."},
    [AOV_SPECULAR] = {"specular", 3, false, true, "Colour of its mirror image, head-on."},
    [AOV_OPTICAL] = {"optical", 4, false, true,
                     "Reflectivity, index of refraction, opacity, roughness."},
    [AOV_SHADOW] = {"shadow", 3, false, true, "Part of the lights' light that arrives."},
    [AOV_OCCLUSION] = {"occlusion", 1, false, true, "Part of the environment's that arrives."},
};

const struct aov_row *aov_row(enum aov aov)
{
    return &aovs[aov];
}

const char *aov_name(enum aov aov)
{
    return aovs[aov].name;
}

int aov_find(const char *name)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        if (strcmp(aovs[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

/* clang-format off */
static const struct quality levels[QUALITY_COUNT] = {
    [QUALITY_DRAFT] = {"draft", "The shape and its light, as fast as can be.",
        .samples = 1, .antialiasing = ANTIALIASING_NONE, .shadow_steps = 32,
        .occlusion_samples = 3, .volume_steps = 12, .volume_shadow_steps = 3},
    [QUALITY_INTERACTIVE] = {"interactive", "For pictures that move.",
        .samples = 1, .antialiasing = ANTIALIASING_EDGES, .shadow_steps = 64,
        .occlusion_samples = 5, .ray_depth = 2, .rays = 3, .ray_least = 0.04, .clear_depth = 2,
        .volume_steps = 24, .volume_shadow_steps = 4},
    [QUALITY_STILL] = {"still", "For pictures that rest.",
        .antialiasing = ANTIALIASING_ADAPTIVE, .lens_samples = 16, .shadow_steps = 64,
        .occlusion_samples = 5, .ray_depth = 4, .rays = 12, .ray_least = 0.01, .clear_depth = 4,
        .volume_steps = 48, .volume_shadow_steps = 6},
    [QUALITY_FINAL] = {"final", "For pictures that are kept.",
        .samples = 4, .antialiasing = ANTIALIASING_ADAPTIVE, .lens_samples = 64,
        .shadow_steps = 96, .occlusion_samples = 8, .ray_depth = 8, .rays = 24,
        .ray_least = 0.004, .clear_depth = 8, .volume_steps = 96, .volume_shadow_steps = 12},
};
/* clang-format on */

const char *const quality_names[] = {"draft", "interactive", "still", "final", NULL};

const struct quality *quality_row(enum quality_level level)
{
    return &levels[level];
}

int quality_find(const char *name)
{
    for (int i = 0; i < QUALITY_COUNT; i++) {
        if (strcmp(levels[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

static const struct stage_row stages[FRAME_STAGES] = {
    [FRAME_QUEUE] = {"queue", "Waiting for other pictures."},
    [FRAME_ENVIRONMENT] = {"environment", "Light of the environment, when it is new."},
    [FRAME_MARCH] = {"march", "Rays from the camera to their surfaces."},
    [FRAME_MATTER] = {"matter", "What the surfaces are made of."},
    [FRAME_SHADOW] = {"shadow", "Shadows and occlusion."},
    [FRAME_SHADE] = {"shade", "Light on surfaces, fog, background, tone mapping."},
    [FRAME_RAYS] = {"rays", "Mirrored and broken rays, and light through glass."},
    [FRAME_VOLUME] = {"volume", "Smoke and clouds."},
    [FRAME_RESOLVE] = {"resolve", "Samples to pixels."},
    [FRAME_READ] = {"read", "Pixels to the processor."},
    [FRAME_ENCODE] = {"encode", "Pixels to a file."},
};

const struct stage_row *stage_row(enum frame_stage stage)
{
    return &stages[stage];
}
