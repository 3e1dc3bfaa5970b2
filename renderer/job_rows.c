/* SPDX-License-Identifier: MIT */
/* The rows of a picture as they leave it. */
#include <math.h>
#include <stdlib.h>

#include "job_internal.h"
#include "protocol/memory.h"

static bool is_gray(const struct output_format *format)
{
    return format->aov == AOV_DEPTH && !format->floats;
}

static struct image shape_of(const struct job *job, enum aov aov, int height)
{
    const struct output_format *format = job->formats[aov];
    struct image image = {.width = job->region.width, .height = height, .channels = 1};
    size_t pixel_bytes = 2;

    if (!format) {
        return (struct image){0};
    }
    if (is_gray(format)) {
        image.format = PIXEL_GRAY16;
    } else {
        const bool bytes = format->read_type == GL_UNSIGNED_BYTE;

        image.format = bytes                           ? PIXEL_RGBA8
                       : format->read_type == GL_FLOAT ? PIXEL_FLOAT
                                                       : PIXEL_UINT32;
        image.channels = !bytes                                         ? format->read_bytes / 4
                         : aov == AOV_COLOR && job->request.transparent ? 4
                                                                        : 3;
        pixel_bytes = (size_t)format->read_bytes;
    }
    image.bytes = (size_t)image.width * (size_t)height * pixel_bytes;
    return image;
}

struct image job_image_info(const struct job *job, enum aov aov)
{
    return shape_of(job, aov, job->region.height);
}

/* Distances to 16 bits: 0 at the eye, 65535 at twice the distance of the camera's target, beyond,
 * and where nothing is. */
static void *depth_to_gray(const float *from, size_t count, double far)
{
    uint16_t *to = memory_alloc(count, sizeof *to);

    for (size_t i = 0; i < count; i++) {
        const double x = from[i] / far;
        to[i] = x < 1 ? (uint16_t)lround(x * 65535) : 65535;
    }
    return to;
}

struct image job_take_rows(struct job *job, enum aov aov)
{
    struct image image = shape_of(job, aov, job->rows_height);

    image.pixels = job->rows[aov];
    job->rows[aov] = NULL;
    if (job->formats[aov] && is_gray(job->formats[aov])) {
        void *raw = image.pixels;

        image.pixels = depth_to_gray(raw, image.bytes / 2, job->depth_far);
        free(raw);
    }
    return image;
}
