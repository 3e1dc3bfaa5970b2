/* SPDX-License-Identifier: MIT */
/* Pictures of tests: files, comparison within a tolerance, differences made visible. */
#ifndef TESTS_SUPPORT_PICTURE_H
#define TESTS_SUPPORT_PICTURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* 8 bits, RGBA, rows from the top. Owned by its holder. */
struct picture {
    int width, height;
    uint8_t *pixels;
};

void picture_finish(struct picture *picture);
bool picture_read(struct picture *out, const char *path);
bool picture_read_memory(struct picture *out, const void *bytes, size_t length);
bool picture_write(const struct picture *picture, const char *path);

/* Two pictures are the same when at most one pixel in `PICTURE_PIXELS` differs by more than
 * PICTURE_STEPS of 255 in a channel, and the channels by less than PICTURE_MEAN on average. That
 * lets pass what another version of a driver rounds otherwise, at edges above all, and nothing that
 * an eye finds. */
enum { PICTURE_STEPS = 8, PICTURE_PIXELS = 200 };
#define PICTURE_MEAN 0.5

struct picture_difference {
    bool same;
    bool size;                /* the sizes differ, and nothing else is known */
    int pixels, of, greatest; /* pixels that differ, of so many */
    double mean;
};
/* `*out_shown` (may be NULL) becomes the difference, eight times as strong, on black. */
struct picture_difference picture_compare(const struct picture *a, const struct picture *b,
                                          struct picture *out_shown);

#endif
