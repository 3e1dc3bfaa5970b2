/* SPDX-License-Identifier: MIT */
/* fieldcast render: one scene into one picture, by the same road as the server's pictures. */
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "drawing.h"
#include "files.h"

enum { PATIENCE_MS = 50 };

/* What --format says, else the extension of the output. */
static bool choose_format(const struct options *options, struct encode_params *out,
                          struct error *err)
{
    static const struct {
        const char *extension;
        enum image_format inside;
    } archives[] = {{"zip", IMAGE_PNG}, {"npz", IMAGE_NPY}};
    const char *name = option_text(options, OPTION_FORMAT);
    const char *output = option_text(options, OPTION_OUTPUT);
    if (!output) {
        return error_set(err, ERROR_INVALID, "--output", "is needed: the picture to write");
    }
    const char *slash = strrchr(output, '/'), *dot = strrchr(slash ? slash : output, '.');
    const char *extension = dot ? dot + 1 : "";
    int format = image_format_find(name ? name : extension);
    *out = (struct encode_params){.quality = option_int(options, OPTION_QUALITY)};
    for (size_t i = 0; i < sizeof archives / sizeof *archives; i++) {
        if (strcmp(archives[i].extension, extension) == 0) {
            out->zipped = true;
            format = name ? format : (int)archives[i].inside;
        }
    }
    if (format < 0) {
        return error_set(err, ERROR_INVALID, "--output",
                         "%s has no known extension; --format png, jpg or npy says what to write",
                         output);
    }
    int outputs = option_int(options, OPTION_AOV);
    if ((outputs & (outputs - 1)) && dot && !out->zipped) {
        return error_set(err, ERROR_INVALID, "--output",
                         "%s holds one picture; several go into a .zip or .npz", output);
    }
    out->format = (enum image_format)format;
    return true;
}

static cJSON *option_json(const struct options *options, enum option option)
{
    const double *value = option_vector(options, option);
    switch (option_row(option)->type) {
    case OPTION_CHOICE:
        return cJSON_CreateString(option_text(options, option));
    case OPTION_VECTOR:
        return cJSON_CreateDoubleArray(value, 3);
    default:
        return cJSON_CreateNumber(*value);
    }
}

/* Sets the member that the option is named after, where the user gave it. */
static bool set_camera(struct record *camera, const struct options *options, enum option option,
                       struct error *err)
{
    static const char prefix[] = "camera-";
    const char *name = option_row(option)->name;
    char place[32];
    if (!option_vector(options, option)) {
        return true;
    }
    snprintf(place, sizeof place, "--%s", name);
    cJSON *json = option_json(options, option);
    int index = record_type_find(camera->type, name + sizeof prefix - 1);
    bool ok = record_set(camera, index, json, place, err);
    cJSON_Delete(json);
    return ok;
}

static bool read_camera(struct record *camera, const struct options *options, struct error *err)
{
    bool ok = true;
    for (int i = OPTION_CAMERA_TYPE; i <= OPTION_CAMERA_FOCUS; i++) {
        ok = ok && set_camera(camera, options, (enum option)i, err);
    }
    return ok;
}

/* -1 where the option was not given. */
static int choice_or_none(const struct options *options, enum option option)
{
    return option_text(options, option) ? option_int(options, option) : -1;
}

static int switch_or_none(const struct options *options, enum option option)
{
    const char *word = option_text(options, option);
    return word ? switch_find(word) : -1;
}

static void read_desc(const struct options *options, const struct record *camera,
                      enum image_format format, struct job_desc *out)
{
    const double *region = option_vector(options, OPTION_REGION);
    *out = (struct job_desc){.width = option_int(options, OPTION_WIDTH),
                             .height = option_int(options, OPTION_HEIGHT),
                             .camera = camera,
                             .level = choice_or_none(options, OPTION_LEVEL),
                             .samples = option_int(options, OPTION_SAMPLES),
                             .transparent = switch_or_none(options, OPTION_TRANSPARENT),
                             .exact = true,
                             .as_floats = format == IMAGE_NPY};
    for (int i = 0; i < AOV_COUNT; i++) {
        out->aovs[i] = option_int(options, OPTION_AOV) >> i & 1;
    }
    if (region) {
        out->region =
            (struct job_region){(int)region[0], (int)region[1], (int)region[2], (int)region[3]};
    }
}

static bool add_rows(struct job *job, struct picture_file *file, struct error *err)
{
    bool ok = true;
    for (int i = 0; i < AOV_COUNT; i++) {
        if (job_image_shape(job, (enum aov)i).width > 0) {
            struct image rows = job_take_rows(job, (enum aov)i);
            ok = ok && picture_file_add(file, (enum aov)i, &rows, err);
            image_finish(&rows);
        }
    }
    return ok;
}

static bool draw_rows(struct renderer *renderer, struct job *job, struct picture_file *file,
                      struct error *err)
{
    enum job_state state;
    while ((state = job_step(job)) != JOB_DONE) {
        if (state == JOB_FAILED) {
            *err = *job_error(job);
            return false;
        }
        if (state == JOB_ROWS && !add_rows(job, file, err)) {
            return false;
        }
        renderer_poll(renderer, state == JOB_WAITING ? PATIENCE_MS : 0);
    }
    return picture_file_end(file, err);
}

/* The picture goes to the file as it is drawn, however large it is. */
static bool write_picture(struct renderer *renderer, struct job *job,
                          const struct encode_params *params, const char *path, struct error *err)
{
    struct image shapes[AOV_COUNT];
    struct file_writer writer;
    for (int i = 0; i < AOV_COUNT; i++) {
        shapes[i] = job_image_shape(job, (enum aov)i);
    }
    if (!file_writer_open(&writer, path, err)) {
        return false;
    }
    struct picture_file *file = picture_file_create(shapes, params, writer.file, err);
    bool ok = file && draw_rows(renderer, job, file, err);
    picture_file_destroy(file);
    return file_writer_close(&writer, ok, err);
}

/* Takes `scene`. */
static bool draw(struct scene *scene, const struct options *options,
                 const struct encode_params *params, struct error *err)
{
    struct record camera = {0};
    struct renderer *renderer = NULL;
    struct resident *resident = NULL;
    struct job *job = NULL;
    struct renderer_params device;
    struct job_desc desc;
    record_copy(&camera, &scene->camera);
    if (read_camera(&camera, options, err)) {
        drawing_params(options, &device);
        renderer = renderer_create(&device, err);
    }
    if (renderer && drawing_give_files(renderer, scene, options, err)) {
        resident = resident_create(renderer, scene, 1);
        scene = NULL;
        read_desc(options, &camera, params->format, &desc);
        job = job_create(resident, &desc, err);
    }
    bool ok = job && write_picture(renderer, job, params, option_text(options, OPTION_OUTPUT), err);
    if (ok && resident_warning(resident)->kind != ERROR_NONE) {
        fputs("fieldcast: warning: ", stderr);
        error_print(resident_warning(resident), stderr);
    }
    job_destroy(job);
    resident_destroy(resident);
    renderer_destroy(renderer);
    scene_destroy(scene);
    record_finish(&camera);
    return ok;
}

int command_render(const struct options *options)
{
    struct error err = {0};
    struct encode_params params;
    int status = EXIT_USAGE;
    if (choose_format(options, &params, &err)) {
        status = EXIT_FAILED;
        struct scene *scene = scene_open(options->operands[0], &err);
        if (scene && draw(scene, options, &params, &err)) {
            return EXIT_OK;
        }
    }
    fputs("fieldcast: ", stderr);
    error_print(&err, stderr);
    return status;
}
