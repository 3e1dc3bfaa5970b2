/* SPDX-License-Identifier: MIT */
#include "codec.h"

#include <string.h>

static const struct {
    const char *name, *mime;
    bool raw;
} rows[CODEC_COUNT] = {
    [CODEC_JPEG] = {"jpg", .mime = "image/jpeg"},
    [CODEC_PNG] = {"png", .mime = "image/png"},
    [CODEC_NPY] = {"npy", "application/x-npy", true},
    [CODEC_HDR] = {"hdr", "image/vnd.radiance", true},
    [CODEC_GUIDE] = {"guide", .mime = "application/octet-stream"},
    [CODEC_ZIP] = {"zip", .mime = "application/zip"},
};

const char *codec_choice(size_t index)
{
    return index + CODEC_JPEG < CODEC_GUIDE ? rows[index + CODEC_JPEG].name : NULL;
}

enum codec codec_find(const char *word)
{
    for (enum codec codec = CODEC_JPEG; codec < CODEC_GUIDE; codec++) {
        if (strcmp(rows[codec].name, word) == 0) {
            return codec;
        }
    }
    return strcmp(word, "jpeg") == 0 ? CODEC_JPEG : 0;
}

const char *codec_name(enum codec codec)
{
    return rows[codec].name;
}

const char *codec_mime(enum codec codec)
{
    return rows[codec].mime;
}

bool codec_is_raw(enum codec codec)
{
    return rows[codec].raw;
}
