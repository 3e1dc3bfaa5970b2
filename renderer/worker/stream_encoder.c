/* SPDX-License-Identifier: MIT */
#include "stream_encoder.h"

#include <stdlib.h>

#include "protocol/memory.h"

struct stream_encoder {
    const struct stream_class *class;
    void *state;
    bool asked; /* for a key */
};

struct stream_encoder *stream_encoder_open(const struct stream_class *class, void *about)
{
    struct stream_encoder *stream = memory_alloc(1, sizeof *stream);

    *stream = (struct stream_encoder){.class = class, .state = class->open(about), .asked = true};
    return stream;
}

void stream_encoder_ask_key(struct stream_encoder *stream)
{
    stream->asked = true;
}

bool stream_encoder_begin(struct stream_encoder *stream, const struct image shapes[AOV_COUNT],
                          const struct encode_params *params, FILE *out, struct error *err)
{
    return stream->class->begin(stream->state, shapes, params, stream->asked, out, err);
}

bool stream_encoder_add(struct stream_encoder *stream, enum aov aov, const struct image *rows,
                        struct error *err)
{
    return stream->class->add(stream->state, aov, rows, err);
}

bool stream_encoder_end(struct stream_encoder *stream, struct stream_packet *out, struct error *err)
{
    const bool ok = stream->class->end(stream->state, out, err);

    stream->asked = stream->asked && !ok;
    return ok;
}

void stream_encoder_close(struct stream_encoder *stream)
{
    if (stream) {
        stream->class->close(stream->state);
        free(stream);
    }
}

/* --- files --- */

struct pictures {
    struct picture_file *file; /* NULL: none is begun */
};

static void drop(struct pictures *pictures)
{
    picture_file_destroy(pictures->file);
    pictures->file = NULL;
}

static void *open_pictures(void *about)
{
    (void)about;
    return memory_alloc(1, sizeof(struct pictures));
}

static bool begin_picture(void *state, const struct image shapes[AOV_COUNT],
                          const struct encode_params *params, bool key, FILE *out,
                          struct error *err)
{
    struct pictures *pictures = state;

    (void)key; /* each is one */
    drop(pictures);
    pictures->file = picture_file_create(shapes, params, out, err);
    return pictures->file;
}

static bool add_rows(void *state, enum aov aov, const struct image *rows, struct error *err)
{
    struct pictures *pictures = state;

    return picture_file_add(pictures->file, aov, rows, err);
}

static bool end_picture(void *state, struct stream_packet *out, struct error *err)
{
    struct pictures *pictures = state;
    const bool ok = picture_file_end(pictures->file, err);

    *out = (struct stream_packet){.codec = picture_file_codec(pictures->file), .key = true};
    drop(pictures);
    return ok;
}

static void close_pictures(void *state)
{
    drop(state);
    free(state);
}

const struct stream_class picture_stream = {open_pictures, begin_picture, add_rows, end_picture,
                                            close_pictures};
