/* SPDX-License-Identifier: MIT */
/* fieldcast render: one scene into one picture, by the same road as the server's pictures. */
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "files.h"
#include "local_render.h"

enum { PATIENCE_MS = 50 };

/* What --format says, else the extension of the output. */
static bool choose_format(const struct options *options, struct render_request *out,
                          struct error *err)
{
    static const struct {
        const char *extension;
        enum codec inside;
    } archives[] = {{"zip", CODEC_PNG}, {"npz", CODEC_NPY}};
    const char *name = option_text(options, OPTION_FORMAT);
    const char *output = option_text(options, OPTION_OUTPUT);
    if (!output) {
        return error_set(err, ERROR_INVALID, "--output", "is needed: the picture to write");
    }
    const char *slash = strrchr(output, '/'), *dot = strrchr(slash ? slash : output, '.');
    const char *extension = dot ? dot + 1 : "";
    bool zipped = false;
    out->codec = codec_find(name ? name : extension);
    for (size_t i = 0; i < sizeof archives / sizeof *archives; i++) {
        if (strcmp(archives[i].extension, extension) == 0) {
            zipped = true;
            out->codec = name ? out->codec : archives[i].inside;
        }
    }
    if (!out->codec) {
        return error_set(err, ERROR_INVALID, "--output",
                         "%s has no known extension; --format " CODEC_CHOICES " says what to write",
                         output);
    }
    const int outputs = option_int(options, OPTION_AOV);
    if ((outputs & (outputs - 1)) && dot && !zipped) {
        return error_set(err, ERROR_INVALID, "--output",
                         "%s holds one picture; several go into a .zip or .npz", output);
    }
    record_put(&out->delivery, "zipped", zipped);
    return true;
}

/* Each member has an option called `prefix` and its name, which the user may have given. */
static bool read_members(const struct options *options, const struct record_type *type,
                         const char *prefix, struct render_request *out, struct error *err)
{
    bool ok = true;

    for (const struct param *param = type->params; ok && param->name; param++) {
        char name[64];
        snprintf(name, sizeof name, "%s%s", prefix, param->name);
        const enum option option = option_find(name);
        const char *text = option == OPTION_COUNT ? NULL : option_text(options, option);
        ok = !text || render_request_set_text(out, REQUEST_OPTION, name, text, err);
    }
    return ok;
}

static bool read_request(const struct options *options, struct render_request *out,
                         struct error *err)
{
    record_put(&out->delivery, "exact", true);
    return choose_format(options, out, err) && read_members(options, &picture_type, "", out, err) &&
           read_members(options, &camera_type, "camera-", out, err) &&
           read_members(options, &section_type, "section-", out, err) &&
           render_request_check(out, REQUEST_OPTION, err);
}

static bool add_rows(struct job *job, struct picture_file *file, struct error *err)
{
    bool ok = true;

    for (int i = 0; i < AOV_COUNT; i++) {
        if (job_image_info(job, (enum aov)i).width > 0) {
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
                          const struct render_request *request, const char *path, struct error *err)
{
    const struct encode_params params = encode_params_of(request);
    struct image shapes[AOV_COUNT];
    struct file_writer writer;

    for (int i = 0; i < AOV_COUNT; i++) {
        shapes[i] = job_image_info(job, (enum aov)i);
    }
    if (!file_writer_open(&writer, path, err)) {
        return false;
    }
    struct picture_file *file = picture_file_create(shapes, &params, writer.file, err);
    const bool ok = file && draw_rows(renderer, job, file, err);
    picture_file_destroy(file);
    return file_writer_close(&writer, ok, err);
}

/* Takes `scene`. */
static bool draw(struct scene *scene, const struct options *options, struct render_request *request,
                 struct error *err)
{
    struct resident *resident = NULL;
    struct job *job = NULL;
    struct renderer_params device;

    local_render_params(options, &device);
    struct renderer *renderer = renderer_create(&device, err);
    render_request_see_from(request, &scene->camera);
    if (renderer && local_render_give_files(renderer, scene, options, err)) {
        const struct job_desc desc = job_desc_of(request);
        resident = resident_create(renderer, scene, 1);
        scene = NULL;
        job = job_create(resident, &desc, err);
    }
    bool ok =
        job && write_picture(renderer, job, request, option_text(options, OPTION_OUTPUT), err);
    const struct warning warning = ok ? resident_warning(resident) : (struct warning){0};
    if (warning.error.kind != ERROR_NONE) {
        fputs("fieldcast: warning: ", stderr);
        error_print(&warning.error, stderr);
    }
    job_destroy(job);
    resident_destroy(resident);
    renderer_destroy(renderer);
    scene_destroy(scene);
    return ok;
}

int command_render(const struct options *options)
{
    struct error err = {0};
    struct render_request request;
    int status = EXIT_USAGE;

    render_request_init(&request);
    if (read_request(options, &request, &err)) {
        struct scene *scene = scene_open(options->operands[0], &err);
        status = scene && draw(scene, options, &request, &err) ? EXIT_OK : EXIT_FAILED;
    }
    render_request_finish(&request);
    if (status != EXIT_OK) {
        fputs("fieldcast: ", stderr);
        error_print(&err, stderr);
    }
    return status;
}
