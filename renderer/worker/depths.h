/* SPDX-License-Identifier: MIT */
/* Pictures with the depths of their blocks: how near each block of pixels is, few bytes behind the
 * bytes of the picture, so that a client can move what it shows while the next picture is on its
 * way. Of the outputs `color`, and `depth` as raw values. The bytes are listed in
 * protocol/README.md, Depths. */
#ifndef RENDERER_DEPTHS_H
#define RENDERER_DEPTHS_H

#include "stream_encoder.h"

/* About nothing. Behind files, and behind pictures of delta.h. */
extern const struct stream_class depths_stream, depths_delta_stream;

#endif
