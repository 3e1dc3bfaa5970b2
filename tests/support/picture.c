/* SPDX-License-Identifier: MIT */
/* PNG by libpng's simplified interface; comparison. */
#include "picture.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

void picture_finish(struct picture *picture)
{
    free(picture->pixels);
    *picture = (struct picture){0};
}

static bool finish_read(png_image *image, struct picture *out)
{
    struct picture picture = {(int)image->width, (int)image->height, NULL};

    image->format = PNG_FORMAT_RGBA;
    picture.pixels = memory_alloc(PNG_IMAGE_SIZE(*image), 1);
    if (!png_image_finish_read(image, NULL, picture.pixels, 0, NULL)) {
        picture_finish(&picture);
        return false;
    }
    *out = picture;
    return true;
}

bool picture_read(struct picture *out, const char *path)
{
    png_image image = {.version = PNG_IMAGE_VERSION};

    return png_image_begin_read_from_file(&image, path) && finish_read(&image, out);
}

bool picture_read_memory(struct picture *out, const void *bytes, size_t length)
{
    png_image image = {.version = PNG_IMAGE_VERSION};

    return png_image_begin_read_from_memory(&image, bytes, length) && finish_read(&image, out);
}

bool picture_write(const struct picture *picture, const char *path)
{
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = (png_uint_32)picture->width,
                       .height = (png_uint_32)picture->height,
                       .format = PNG_FORMAT_RGBA};

    return png_image_write_to_file(&image, path, 0, picture->pixels, 0, NULL) != 0;
}

static int pixel_difference(const uint8_t *a, const uint8_t *b, uint8_t *shown, long *sum)
{
    int greatest = 0;

    for (int c = 0; c < 4; c++) {
        const int d = abs(a[c] - b[c]);
        greatest = d > greatest ? d : greatest;
        *sum += d;
        if (shown) {
            shown[c] = c == 3 ? 255 : (uint8_t)(8 * d < 255 ? 8 * d : 255);
        }
    }
    return greatest;
}

struct picture_difference picture_compare(const struct picture *a, const struct picture *b,
                                          struct picture *out_shown)
{
    const size_t count = (size_t)a->width * (size_t)a->height;
    struct picture_difference result = {.of = (int)count};
    struct picture shown = {a->width, a->height, NULL};
    long sum = 0;

    if (a->width != b->width || a->height != b->height) {
        return (struct picture_difference){.size = true};
    }
    shown.pixels = memory_alloc(count, 4);
    for (size_t i = 0; i < count; i++) {
        const int d =
            pixel_difference(a->pixels + 4 * i, b->pixels + 4 * i, shown.pixels + 4 * i, &sum);
        result.greatest = d > result.greatest ? d : result.greatest;
        result.pixels += d > PICTURE_STEPS;
    }
    result.mean = (double)sum / (double)(4 * count);
    result.same = (long)result.pixels * PICTURE_PIXELS <= (long)count && result.mean < PICTURE_MEAN;
    if (out_shown) {
        *out_shown = shown;
    } else {
        picture_finish(&shown);
    }
    return result;
}
