/* SPDX-License-Identifier: MIT */
/* fieldcast render: one scene into one picture, by the same road as the server's pictures. */
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "drawing.h"
#include "files.h"

/* What --format says, else the extension of the output. */
static bool choose_format(const struct options *options, enum image_format *out, struct error *err)
{
    const char *name = option_text(options, OPTION_FORMAT);
    const char *output = option_text(options, OPTION_OUTPUT);
    if (!output) {
        return error_set(err, ERROR_INVALID, "--output", "is needed: the picture to write");
    }
    if (!name) {
        const char *slash = strrchr(output, '/');
        name = strrchr(slash ? slash : output, '.');
        name = name ? name + 1 : "";
    }
    int format = image_format_find(name);
    if (format < 0) {
        return error_set(err, ERROR_INVALID, "--output",
                         "%s has no known extension; --format png, jpg or npy says what to write",
                         output);
    }
    *out = (enum image_format)format;
    return true;
}

/* Sets the camera's `name` where the user gave the option. */
static bool set_camera(struct record *camera, const char *name, const struct options *options,
                       enum option option, struct error *err)
{
    const double *value = option_vector(options, option);
    if (!value) {
        return true;
    }
    char place[32];
    snprintf(place, sizeof place, "--%s", option_row(option)->name);
    int index = record_type_find(camera->type, name);
    bool vector = option_row(option)->type == OPTION_VECTOR;
    cJSON *json = vector ? cJSON_CreateDoubleArray(value, 3) : cJSON_CreateNumber(*value);
    bool ok = record_set(camera, index, json, place, err);
    cJSON_Delete(json);
    return ok;
}

static bool read_camera(struct record *camera, const struct options *options, struct error *err)
{
    return set_camera(camera, "position", options, OPTION_POSITION, err) &&
           set_camera(camera, "target", options, OPTION_TARGET, err) &&
           set_camera(camera, "fov", options, OPTION_FOV, err);
}

static bool write_image(const struct image *image, const struct options *options,
                        enum image_format format, struct error *err)
{
    struct encode_params params = {.format = format,
                                   .quality = option_int(options, OPTION_QUALITY)};
    uint8_t *bytes = NULL;
    size_t length = 0;
    if (!image_encode(image, &params, &bytes, &length, err)) {
        return false;
    }
    bool ok = file_replace(option_text(options, OPTION_OUTPUT), bytes, length, err);
    free(bytes);
    return ok;
}

/* Takes `scene`. */
static bool draw(struct scene *scene, const struct options *options, enum image_format format,
                 struct error *err)
{
    struct record camera = {0};
    struct renderer *renderer = NULL;
    struct resident *resident = NULL;
    struct image image = {0};
    struct renderer_params params;
    struct job_desc desc = {.width = option_int(options, OPTION_WIDTH),
                            .height = option_int(options, OPTION_HEIGHT),
                            .camera = &camera,
                            .aov = (enum aov)option_int(options, OPTION_AOV),
                            .samples = option_int(options, OPTION_SAMPLES),
                            .exact = true,
                            .as_floats = format == IMAGE_NPY};
    record_copy(&camera, &scene->camera);
    bool ok = read_camera(&camera, options, err);
    if (ok) {
        drawing_params(options, &params);
        renderer = renderer_create(&params, err);
    }
    if (renderer) {
        resident = resident_create(renderer, scene, 1);
        scene = NULL;
        ok = renderer_render(resident, &desc, &image, err) &&
             write_image(&image, options, format, err);
    }
    ok = ok && renderer;
    image_finish(&image);
    resident_destroy(resident);
    renderer_destroy(renderer);
    scene_destroy(scene);
    record_finish(&camera);
    return ok;
}

int command_render(const struct options *options)
{
    struct error err = {0};
    enum image_format format = IMAGE_PNG;
    int status = EXIT_USAGE;
    if (choose_format(options, &format, &err)) {
        status = EXIT_FAILED;
        struct scene *scene = scene_open(options->operands[0], &err);
        if (scene && draw(scene, options, format, &err)) {
            return EXIT_OK;
        }
    }
    fputs("fieldcast: ", stderr);
    error_print(&err, stderr);
    return status;
}
