/* SPDX-License-Identifier: MIT */
#include "kept_streams.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/limits.h"
#include "protocol/memory.h"

enum {
    PIXEL_BYTES = 4,
    LEAST_BYTES = 65536, /* of one without a picture: so there are not too many of them */
};

static void close_stream(struct kept_stream *stream)
{
    stream_encoder_close(stream->encoder);
    free(stream->name);
    free(stream);
}

/* Takes it out; NULL: there is none of that name. */
static struct kept_stream *remove_named(struct kept_streams *streams, const char *name)
{
    struct kept_stream **at = &streams->first;

    while (*at && strcmp((*at)->name, name) != 0) {
        at = &(*at)->next;
    }
    struct kept_stream *found = *at;
    if (found) {
        *at = found->next;
    }
    return found;
}

void kept_streams_finish(struct kept_streams *streams)
{
    while (streams->first) {
        struct kept_stream *first = streams->first;

        streams->first = first->next;
        close_stream(first);
    }
}

struct kept_stream *kept_streams_take(struct kept_streams *streams, const char *name,
                                      const struct stream_class *class)
{
    struct kept_stream *stream = remove_named(streams, name);

    if (!stream) {
        stream = memory_alloc(1, sizeof *stream);
        stream->encoder = stream_encoder_open(class, NULL);
        stream->name = memory_text(name);
    }
    return stream;
}

/* Nothing is kept of a larger picture, which no other is a difference from (delta.h). */
static size_t bytes_of(int width, int height)
{
    const size_t pixels = (size_t)width * (size_t)height;

    return LEAST_BYTES + (pixels <= LIMIT_DELTA_PIXELS ? PIXEL_BYTES * pixels : 0);
}

void kept_stream_begin(struct kept_stream *stream, int width, int height)
{
    const size_t bytes = bytes_of(width, height);

    stream->bytes = bytes > stream->bytes ? bytes : stream->bytes;
}

void kept_stream_end(struct kept_stream *stream, uint32_t order, int width, int height)
{
    stream->order = order;
    stream->bytes = bytes_of(width, height);
}

void kept_streams_give_back(struct kept_streams *streams, struct kept_stream *stream)
{
    size_t bytes = 0;

    if (!stream) {
        return;
    }
    struct kept_stream *other = remove_named(streams, stream->name);
    if (other) {
        close_stream(other);
    }
    stream->next = streams->first;
    streams->first = stream;
    for (struct kept_stream **at = &streams->first; *at;) {
        bytes += (*at)->bytes;
        if (bytes <= LIMIT_DELTAS_BYTES) {
            at = &(*at)->next;
            continue;
        }
        struct kept_stream *gone = *at;
        *at = gone->next;
        close_stream(gone);
    }
}
