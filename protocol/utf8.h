/* SPDX-License-Identifier: MIT */
/* What is UTF-8 and what only looks like it. */
#ifndef PROTOCOL_UTF8_H
#define PROTOCOL_UTF8_H

#include <stdbool.h>
#include <stddef.h>

/* Bytes of the sequence at `text`, of which `left` > 0 bytes are there; 0: not UTF-8. */
size_t utf8_sequence(const char *text, size_t left);

/* Where a text that comes in pieces stands. All 0 at its beginning. */
struct utf8_stream {
    unsigned char left;      /* bytes of the sequence that has begun; 0: the text may end here */
    unsigned char low, high; /* the range of the next of them */
};
/* False: it is not UTF-8, whatever follows. */
bool utf8_feed(struct utf8_stream *stream, const char *bytes, size_t length);

/* Writes the sequence of a character that is no surrogate; how many bytes. */
size_t utf8_put(char out[4], unsigned long code);

#endif
