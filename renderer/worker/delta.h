/* SPDX-License-Identifier: MIT */
/* Streams in which a picture may be the difference from the one before: the squares of pixels that
 * are not what they were, one after another as a picture of their own in the same format and
 * quality. Squares are compared bit for bit before they are encoded. One that is equal was sent
 * from equal pixels at this quality, so no square is ever spoilt by being sent again. The bytes are
 * listed in protocol/README.md, Deltas.
 *
 * A picture is a key where the one before had another size, format or quality, where more than half
 * of its squares are new, and where it is none of one opaque output of 8 bits of LIMIT_DELTA_PIXELS
 * at most: then its rows are encoded as they come. */
#ifndef RENDERER_DELTA_H
#define RENDERER_DELTA_H

#include "stream_encoder.h"

enum { DELTA_SIDE = 16 }; /* pixels of a square: whole blocks of a JPEG */

/* About nothing. */
extern const struct stream_class delta_stream;

#endif
