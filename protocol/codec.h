/* SPDX-License-Identifier: MIT */
/* Encodings of a picture: those of requests, answers and frames. */
#ifndef PROTOCOL_CODEC_H
#define PROTOCOL_CODEC_H

#include <stdbool.h>
#include <stddef.h>

/* The numbers are those of a frame's header. */
enum codec {
    CODEC_JPEG = 1,
    CODEC_PNG = 2,
    CODEC_NPY,
    CODEC_HDR,   /* linear light, of the output color alone */
    CODEC_GUIDE, /* which node each pixel shows, how far: README.md, Guides; in frames alone */
    CODEC_ZIP,   /* several of them, or one that shall be in a ZIP */
    CODEC_COUNT
};

/* Those before CODEC_GUIDE: the formats that a request may name. */
#define CODEC_CHOICES "png, jpg, npy or hdr"
const char *codec_choice(size_t index); /* their names; NULL: no more */
/* One of them, by its name or as "jpeg"; 0: none. */
enum codec codec_find(const char *word);
const char *codec_name(enum codec codec); /* as a file's extension */
const char *codec_mime(enum codec codec);
bool codec_is_raw(enum codec codec); /* it holds numbers, no colours of a screen */

#endif
