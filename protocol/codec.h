/* SPDX-License-Identifier: MIT */
/* What the bytes of a picture are: what may be asked for, and what an answer and a frame say. */
#ifndef PROTOCOL_CODEC_H
#define PROTOCOL_CODEC_H

/* The numbers are those of a frame's header. */
enum codec {
    CODEC_JPEG = 1,
    CODEC_PNG = 2,
    CODEC_NPY,
    CODEC_ZIP, /* several of them, or one that shall be in a ZIP */
    CODEC_COUNT
};

/* One that a picture may be asked in: "jpg" "jpeg" "png" "npy"; 0: none. */
enum codec codec_find(const char *word);
const char *codec_name(enum codec codec); /* as a file's extension */
const char *codec_mime(enum codec codec);

#endif
