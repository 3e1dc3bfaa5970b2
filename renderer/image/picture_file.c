/* SPDX-License-Identifier: MIT */
/* The outputs of one picture on their way into one file. */
#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "encode.h"
#include "protocol/memory.h"

struct picture_file {
    struct encode_params params;
    FILE *out; /* the caller's */
    bool zipped;
    struct image_encoder encoders[AOV_COUNT];
    FILE *parts[AOV_COUNT]; /* what the encoders write to; of a ZIP temporary files */
};

/* What is raw needs no encoder to know how long it will be. */
static bool check_raw(const struct image shapes[AOV_COUNT], const struct encode_params *params,
                      struct error *err)
{
    uint64_t bytes = 0;

    for (int i = 0; i < AOV_COUNT; i++) {
        bytes += shapes[i].bytes;
    }
    return params->format != CODEC_NPY || params->limit_bytes == 0 ||
           bytes <= params->limit_bytes ||
           error_set(err, ERROR_LIMIT, "", "%" PRIu64 " bytes of values are above the maximum %zu",
                     bytes, params->limit_bytes);
}

static bool check_length(const struct picture_file *file, struct error *err)
{
    size_t bytes = 0;

    if (file->params.limit_bytes == 0) {
        return true;
    }
    for (int i = 0; i < AOV_COUNT; i++) {
        bytes += file->parts[i] ? (size_t)ftello(file->parts[i]) : 0;
    }
    return bytes <= file->params.limit_bytes ||
           error_set(err, ERROR_LIMIT, "", "the finished picture is above the maximum %zu bytes",
                     file->params.limit_bytes);
}

/* What has a limit goes into memory: the render process may write no other files. */
static FILE *open_temporary(const struct encode_params *params)
{
    const int fd = params->limit_bytes > 0 ? memfd_create("picture", MFD_CLOEXEC) : -1;

    return params->limit_bytes > 0 ? (fd < 0 ? NULL : fdopen(fd, "w+")) : tmpfile();
}

static bool open_part(struct picture_file *file, int aov, const struct image *shape,
                      struct error *err)
{
    file->parts[aov] = file->zipped ? open_temporary(&file->params) : file->out;
    if (!file->parts[aov]) {
        return error_set(err, ERROR_UNAVAILABLE, "", "no temporary file: %s", strerror(errno));
    }
    return image_encoder_begin(&file->encoders[aov], shape, &file->params, file->parts[aov], err);
}

struct picture_file *picture_file_create(const struct image shapes[AOV_COUNT],
                                         const struct encode_params *params, FILE *out,
                                         struct error *err)
{
    struct picture_file *file;
    int outputs = 0;

    if (!check_raw(shapes, params, err)) {
        return NULL;
    }
    for (int i = 0; i < AOV_COUNT; i++) {
        outputs += shapes[i].width > 0;
    }
    file = memory_alloc(1, sizeof *file);
    file->params = *params;
    file->out = out;
    file->zipped = params->zipped || outputs > 1;
    for (int i = 0; i < AOV_COUNT; i++) {
        if (shapes[i].width > 0 && !open_part(file, i, &shapes[i], err)) {
            picture_file_destroy(file);
            return NULL;
        }
    }
    return file;
}

enum codec picture_file_codec(const struct picture_file *file)
{
    return file->zipped ? CODEC_ZIP : file->params.format;
}

bool picture_file_add(struct picture_file *file, enum aov aov, const struct image *rows,
                      struct error *err)
{
    return image_encoder_add(&file->encoders[aov], rows, err) && check_length(file, err);
}

bool picture_file_end(struct picture_file *file, struct error *err)
{
    struct zip_part parts[AOV_COUNT];
    size_t count = 0;

    for (int i = 0; i < AOV_COUNT; i++) {
        if (!file->parts[i]) {
            continue;
        }
        if (!image_encoder_end(&file->encoders[i], err)) {
            return false;
        }
        snprintf(parts[count].name, sizeof parts[count].name, "%s.%s", aov_name((enum aov)i),
                 codec_name(file->params.format));
        parts[count++].file = file->parts[i];
    }
    return check_length(file, err) && (!file->zipped || zip_write(parts, count, file->out, err)) &&
           encode_flush(file->out, err);
}

void picture_file_destroy(struct picture_file *file)
{
    if (!file) {
        return;
    }
    for (int i = 0; i < AOV_COUNT; i++) {
        image_encoder_finish(&file->encoders[i]);
        if (file->zipped && file->parts[i]) {
            fclose(file->parts[i]);
        }
    }
    free(file);
}
