/* SPDX-License-Identifier: MIT */
#include "picture.h"

#include <stdio.h>
#include <string.h>

#include "limits.h"

/* X(NAME, "name", channels, whole, picture, "what it is") */
/* clang-format off */
#define OUTPUTS(X) \
    X(COLOR, "color", 4, false, true, "The picture: colour and coverage.") \
    X(DEPTH, "depth", 1, false, true, "Distance along the ray; infinite where nothing is hit.") \
    X(NORMAL, "normal", 3, false, true, "Unit normal in world space; 0 where nothing is hit.") \
    X(POSITION, "position", 3, false, false, "Position in world space; 0 where nothing is hit.") \
    X(ID, "id", 1, true, true, "Index of the leaf in the tree, plus 1; 0 where nothing is hit.") \
    X(STEPS, "steps", 1, false, true, \
      "Number of steps of the ray; lighter in the picture means more steps.") \
    X(ALBEDO, "albedo", 3, false, true, "Colour of the surface without lighting.") \
    X(SPECULAR, "specular", 3, false, true, "Colour of the mirror reflection, seen head-on.") \
    X(OPTICAL, "optical", 4, false, true, \
      "Reflectivity, index of refraction, opacity, roughness.") \
    X(SHADOW, "shadow", 3, false, true, \
      "Part of the light that arrives from lights with shadows; 1 where there is no such light.") \
    X(OCCLUSION, "occlusion", 1, false, true, "Part of the environment's light that arrives.")
/* clang-format on */

static const struct aov_row aovs[AOV_COUNT] = {
#define X(NAME, ...) [AOV_##NAME] = {__VA_ARGS__},
    OUTPUTS(X)
#undef X
};

const char *const aov_picture_names[] = {
#define ONLY_true(name) name,
#define ONLY_false(name)
#define X(NAME, name, channels, whole, picture, doc) ONLY_##picture(name)
    OUTPUTS(X)
#undef X
        NULL};

const unsigned char steps_colors[STEPS_COLORS][3] = {{0x00, 0x00, 0x00},
                                                     {0x4a, 0x1e, 0x8c},
                                                     {0xcc, 0x4a, 0x6a},
                                                     {0xf5, 0xa9, 0x4e},
                                                     {0xff, 0xff, 0xff}};

const struct aov_row *aov_row(enum aov aov)
{
    return &aovs[aov];
}

const char *aov_name(enum aov aov)
{
    return aovs[aov].name;
}

static int find_name(const char *name, size_t length)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        if (strlen(aovs[i].name) == length && memcmp(aovs[i].name, name, length) == 0) {
            return i;
        }
    }
    return -1;
}

int aov_find(const char *name)
{
    return find_name(name, strlen(name));
}

static bool fail_name(const char *name, size_t length, const char *place, struct error *err)
{
    enum { SHOWN = 40 };
    char all[AOVS_TEXT_BYTES];
    bool every[AOV_COUNT];

    for (int i = 0; i < AOV_COUNT; i++) {
        every[i] = true;
    }
    aovs_print(every, all);
    return error_set(err, ERROR_INVALID, place, "\"%.*s\" is none of %s",
                     (int)(length < SHOWN ? length : SHOWN), name, all);
}

bool aovs_read(const char *text, bool out[AOV_COUNT], const char *place, struct error *err)
{
    bool found[AOV_COUNT] = {false};
    size_t length;

    for (const char *name = text;; name += length + 1) {
        int aov;

        length = strcspn(name, ",");
        aov = find_name(name, length);
        if (aov < 0) {
            return fail_name(name, length, place, err);
        }
        if (found[aov]) {
            return error_set(err, ERROR_INVALID, place, "%s is named twice", aovs[aov].name);
        }
        found[aov] = true;
        if (name[length] == '\0') {
            break;
        }
    }
    memcpy(out, found, sizeof found);
    return true;
}

void aovs_print(const bool which[AOV_COUNT], char out[AOVS_TEXT_BYTES])
{
    size_t used = 0;

    out[0] = '\0';
    for (int i = 0; i < AOV_COUNT; i++) {
        if (which[i]) {
            used += (size_t)snprintf(out + used, AOVS_TEXT_BYTES - used, "%s%s", used ? "," : "",
                                     aovs[i].name);
        }
    }
}

const char *const quality_names[] = {"draft", "interactive", "still", "final", NULL};

/* clang-format off */
static const struct quality levels[QUALITY_COUNT] = {
    [QUALITY_DRAFT] = {"The shape and its light, as fast as can be.",
        .samples = 1, .antialiasing = ANTIALIASING_NONE, .shadow_steps = 32,
        .occlusion_samples = 3, .volume_steps = 12, .volume_shadow_steps = 3},
    [QUALITY_INTERACTIVE] = {"For pictures that move.",
        .samples = 1, .antialiasing = ANTIALIASING_EDGES, .shadow_steps = 64,
        .occlusion_samples = 5, .ray_depth = 2, .rays = 3,
        .min_throughput = 0.04, .transmission_depth = 2,
        .volume_steps = 24, .volume_shadow_steps = 4},
    [QUALITY_STILL] = {"For pictures that rest.",
        .antialiasing = ANTIALIASING_ADAPTIVE, .lens_samples = 16, .shadow_steps = 96,
        .occlusion_samples = 5, .ray_depth = 4, .rays = 12,
        .min_throughput = 0.01, .transmission_depth = 4,
        .volume_steps = 48, .volume_shadow_steps = 6},
    [QUALITY_FINAL] = {"For pictures that are kept.",
        .samples = 4, .antialiasing = ANTIALIASING_ADAPTIVE, .lens_samples = 64,
        .shadow_steps = 128, .occlusion_samples = 8, .ray_depth = 8, .rays = 24,
        .min_throughput = 0.004, .transmission_depth = 8, .volume_steps = 72,
        .volume_shadow_steps = 8},
};
/* clang-format on */

const struct quality *quality_row(enum quality_level level)
{
    return &levels[level];
}

/* Every second one is on. */
const char *const switch_words[] = {"off", "on", "false", "true", NULL};

int switch_find(const char *word)
{
    int i = 0;

    while (switch_words[i] && strcmp(switch_words[i], word) != 0) {
        i++;
    }
    return switch_words[i] ? i % 2 : -1;
}

int quality_find(const char *name)
{
    for (int i = 0; i < QUALITY_COUNT; i++) {
        if (strcmp(quality_names[i], name) == 0) {
            return i;
        }
    }
    return -1;
}

/* clang-format off */
const struct record_type picture_type = {"picture", "What is asked of a picture.",
    (const struct param[]){
    {"width", PARAM_INT, .def = {PICTURE_WIDTH}, .min = 1, .max = LIMIT_IMAGE_SIDE,
     .doc = "Pixels of the whole picture; absent: 1280."},
    {"height", PARAM_INT, .def = {PICTURE_HEIGHT}, .min = 1, .max = LIMIT_IMAGE_SIDE,
     .doc = "Pixels of the whole picture; absent: 720."},
    {"region", PARAM_VEC4, .min = 0, .max = LIMIT_IMAGE_SIDE,
     .doc = "x, y, width, height: the pixels of the picture that are wanted; absent: all."},
    {"aov", PARAM_TEXT,
     .doc = "Outputs, with commas between them; several come as a ZIP; absent: color."},
    {"level", PARAM_ENUM, .choices = quality_names,
     .doc = "Quality level; absent: the scene's."},
    {"samples", PARAM_INT, .min = 1, .max = 4,
     .doc = "Samples for each pixel along one axis; absent: the level's or the scene's."},
    {"transparent", PARAM_BOOL,
     .doc = "Whether the background is left out; absent: as the scene says."},
    {"quality", PARAM_INT, .def = {90}, .min = 1, .max = 100,
     .doc = "Quality of a JPEG; absent: 90."},
    {.name = NULL}}};
/* clang-format on */

/* clang-format off */
const struct record_type section_type = {"section",
    "A plane that cuts the scene: what is on its positive side is left out.",
    (const struct param[]){
    {"normal", PARAM_VEC3, .def = {0, 1, 0}, .direction = true,
     .doc = "Direction of the positive side, of any length; absent: 0, 1, 0."},
    {"offset", PARAM_FLOAT, UNIT_LENGTH,
     .doc = "Where the plane is: so far from the origin along the normal; absent: 0."},
    {.name = NULL}}};
/* clang-format on */

static const struct stage_row stages[FRAME_STAGES] = {
    [FRAME_QUEUE] = {"queue", "Waiting for other pictures."},
    [FRAME_ENVIRONMENT] = {"environment", "Light of the environment, when it is new."},
    [FRAME_MARCH] = {"march", "Rays from the camera to their surfaces."},
    [FRAME_MATERIAL] = {"material", "What the surfaces are made of."},
    [FRAME_SHADOW] = {"shadow", "Shadows and occlusion."},
    [FRAME_SHADE] = {"shade", "Light on surfaces, fog, background; where the engine "
                              "draws, all of drawing."},
    [FRAME_RAYS] = {"rays", "Reflected and refracted rays, and light through glass."},
    [FRAME_VOLUME] = {"volume", "Smoke and clouds."},
    [FRAME_RESOLVE] = {"resolve", "Samples to pixels, tone mapping."},
    [FRAME_READ] = {"read", "Pixels to the processor."},
    [FRAME_ENCODE] = {"encode", "Pixels to a file."},
};

const struct stage_row *stage_row(enum frame_stage stage)
{
    return &stages[stage];
}

void stage_member(enum frame_stage stage, char out[STAGE_MEMBER_BYTES])
{
    snprintf(out, STAGE_MEMBER_BYTES, "%s_us", stages[stage].name);
}
