/* SPDX-License-Identifier: MIT */
/* An encoder of a sequence of pictures; image/encode.h encodes single ones. A packet may hold the
 * difference from the picture before. An encoder that keeps no earlier picture is a stream of key
 * packets alone.
 *
 * A picture is passed in rows, so that its size needs no memory. Uses no GL. One thread at a
 * time. */
#ifndef RENDERER_STREAM_ENCODER_H
#define RENDERER_STREAM_ENCODER_H

#include "renderer/image/image.h"

/* Describes the bytes of a picture. */
struct stream_packet {
    enum codec codec;
    bool key;           /* it decodes alone; else with all since the last key */
    size_t whole_bytes; /* of these, the last ones: the file of the whole picture; 0: none */
};

/* `open` gets what its pictures are about, as the class has it, and holds it until `close`; the
 * owner of the stream calls both. `begin` takes a picture of these outputs, the last one's rows all
 * in or given up, and writes it to `out`; with `key` it may use no earlier one. A picture that is
 * given up, or fails, is as if it had never been begun. Each fails as image/encode.h has it. */
struct stream_class {
    void *(*open)(void *about);
    bool (*begin)(void *state, const struct image shapes[AOV_COUNT],
                  const struct encode_params *params, bool key, FILE *out, struct error *err);
    bool (*add)(void *state, enum aov aov, const struct image *rows, struct error *err);
    bool (*end)(void *state, struct stream_packet *out, struct error *err);
    void (*close)(void *state);
};
/* The files of image.h, one a picture; about nothing. */
extern const struct stream_class picture_stream;

struct stream_encoder;

struct stream_encoder *stream_encoder_open(const struct stream_class *class, void *about);
/* The next picture shall be a key, as the first one is. */
void stream_encoder_ask_key(struct stream_encoder *stream);
/* `out` stays the caller's. What was begun before and not ended is given up. */
bool stream_encoder_begin(struct stream_encoder *stream, const struct image shapes[AOV_COUNT],
                          const struct encode_params *params, FILE *out, struct error *err);
bool stream_encoder_add(struct stream_encoder *stream, enum aov aov, const struct image *rows,
                        struct error *err);
/* When all rows of all outputs were added. */
bool stream_encoder_end(struct stream_encoder *stream, struct stream_packet *out,
                        struct error *err);
void stream_encoder_close(struct stream_encoder *stream); /* NULL: nothing */

#endif
