/* SPDX-License-Identifier: MIT */
/* Streams that go on from one order to the next, by name: those that were used last, as many as
 * LIMIT_DELTAS_BYTES holds. Whoever takes one has it alone. */
#ifndef RENDERER_KEPT_STREAMS_H
#define RENDERER_KEPT_STREAMS_H

#include "stream_encoder.h"

struct kept_stream {
    struct stream_encoder *encoder;
    uint32_t order; /* whose picture was its last one; 0: it has none */
    char *name;
    size_t bytes; /* about what it holds */
    struct kept_stream *next;
};

/* The newest first. Zeroed: none. */
struct kept_streams {
    struct kept_stream *first;
};
void kept_streams_finish(struct kept_streams *streams);
/* Opens it where it is not kept; the class is one about nothing. */
struct kept_stream *kept_streams_take(struct kept_streams *streams, const char *name,
                                      const struct stream_class *class);
/* A picture of this size is begun. Where it is given up, what was held before it still is. */
void kept_stream_begin(struct kept_stream *stream, int width, int height);
/* That of the order is the last one now. */
void kept_stream_end(struct kept_stream *stream, uint32_t order, int width, int height);
/* One of that name that came back before is closed, and so are the oldest. NULL: nothing. */
void kept_streams_give_back(struct kept_streams *streams, struct kept_stream *stream);

#endif
