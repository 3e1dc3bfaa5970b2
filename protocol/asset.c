/* SPDX-License-Identifier: MIT */
/* PNG: ISO/IEC 15948. Radiance: filefmts.pdf of the Radiance distribution. */
#include "asset.h"

#include <stdlib.h>
#include <string.h>

#include "limits.h"

static const uint8_t png_magic[16] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n',
                                      0,    0,   0,   13,  'I',  'H',  'D',  'R'};

enum { LINE_BYTES = 256, LINES_MAX = 256 }; /* of a Radiance head */

static long big_endian(const uint8_t *bytes)
{
    return (long)bytes[0] << 24 | bytes[1] << 16 | bytes[2] << 8 | bytes[3];
}

/* The next line without its end. */
static bool next_line(const uint8_t *bytes, size_t length, size_t *at, char out[LINE_BYTES])
{
    const uint8_t *line = bytes + *at, *end = memchr(line, '\n', length - *at);
    const size_t count = end ? (size_t)(end - line) : LINE_BYTES;

    if (count >= LINE_BYTES || memchr(line, '\0', count)) {
        return false;
    }
    memcpy(out, line, count);
    out[count] = '\0';
    *at += count + 1;
    return true;
}

/* "-Y 512 +X 1024": rows downwards, columns to the right. */
static bool read_size(const char *line, long *out_width, long *out_height)
{
    char *end;

    if (strncmp(line, "-Y ", 3) != 0) {
        return false;
    }
    *out_height = strtol(line + 3, &end, 10);
    if (strncmp(end, " +X ", 4) != 0) {
        return false;
    }
    *out_width = strtol(end + 4, &end, 10);
    return *end == '\0';
}

/* Lines up to an empty one, and the size. */
static bool read_radiance(const uint8_t *bytes, size_t length, size_t *out_head, long *out_width,
                          long *out_height, struct error *err)
{
    char line[LINE_BYTES] = "?";
    size_t at = 0;
    bool rgbe = false;

    for (int i = 0; *line && i < LINES_MAX; i++) {
        if (!next_line(bytes, length, &at, line)) {
            return error_set(err, ERROR_INVALID, "", "the head of the Radiance file has no end");
        }
        rgbe = rgbe || strcmp(line, "FORMAT=32-bit_rle_rgbe") == 0;
    }
    if (*line || !rgbe) {
        return error_set(err, ERROR_INVALID, "", "the Radiance file is not FORMAT=32-bit_rle_rgbe");
    }
    if (!next_line(bytes, length, &at, line) || !read_size(line, out_width, out_height)) {
        return error_set(err, ERROR_INVALID, "",
                         "the size of the Radiance file is not written as -Y ROWS +X COLUMNS");
    }
    *out_head = at;
    return true;
}

static bool check_size(long width, long height, struct error *err)
{
    if (width < 1 || height < 1) {
        return error_set(err, ERROR_INVALID, "", "the picture is %ld x %ld pixels", width, height);
    }
    if (width > LIMIT_ASSET_SIDE || height > LIMIT_ASSET_SIDE) {
        return error_set(err, ERROR_LIMIT, "", "the picture's %ld x %ld pixels are above %d a side",
                         width, height, LIMIT_ASSET_SIDE);
    }
    return width * height <= LIMIT_ASSET_PIXELS ||
           error_set(err, ERROR_LIMIT, "", "the picture's %ld pixels are above the maximum %d",
                     width * height, LIMIT_ASSET_PIXELS);
}

bool asset_inspect(const uint8_t *bytes, size_t length, struct asset_info *out, struct error *err)
{
    struct asset_info info = {0};
    long width = 0, height = 0;

    if (length > LIMIT_ASSET_BYTES) {
        return error_set(err, ERROR_TOO_LARGE, "", "%zu bytes are above the maximum %d", length,
                         LIMIT_ASSET_BYTES);
    }
    if (length >= 24 && memcmp(bytes, png_magic, sizeof png_magic) == 0) {
        info.type = "image/png";
        width = big_endian(bytes + 16);
        height = big_endian(bytes + 20);
    } else if (length >= 2 && memcmp(bytes, "#?", 2) == 0) {
        info.type = "image/vnd.radiance";
        if (!read_radiance(bytes, length, &info.head, &width, &height, err)) {
            return false;
        }
    } else {
        return error_set(err, ERROR_INVALID, "", "the file is neither PNG nor Radiance HDR");
    }
    if (!check_size(width, height, err)) {
        return false;
    }
    info.width = (int)width;
    info.height = (int)height;
    *out = info;
    return true;
}
