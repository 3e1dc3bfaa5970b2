/* SPDX-License-Identifier: MIT */
/* Guides: which node each pixel of a picture shows, and how far it is, small enough to go with
 * pictures of a stream. Made of the outputs `id` and `depth` as raw values. The bytes are listed in
 * protocol/README.md, Guides. */
#ifndef RENDERER_GUIDE_H
#define RENDERER_GUIDE_H

#include "stream_encoder.h"

/* About a struct field (job_field), of which it holds a reference. */
extern const struct stream_class guide_stream;

#endif
