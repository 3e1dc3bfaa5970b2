/* SPDX-License-Identifier: MIT */
/* How large the pictures of a stream are: moving ones shrink until one takes the time that the view
 * prefers. Every function is called under the hub's lock. */
#ifndef SERVER_STREAM_SIZE_H
#define SERVER_STREAM_SIZE_H

#include "stream_state.h"

struct session;

/* The view isolates other nodes than before: that takes another time, and all of it is drawn. */
void stream_size_isolate(struct stream *stream);
/* The size of moving pictures from now on. */
void stream_size_choose(struct session *session, const struct stream_view *view);
/* Whether a picture between moving and still ones is worth while. */
bool stream_size_has_larger(const struct session *session, const struct stream_view *view);
/* The side of the next picture of a stage, as a part of the view's. */
double stream_size_scale(const struct session *session, const struct stream_view *view,
                         enum stream_stage stage);
/* A moving picture has come, of which that part of its pixels was drawn. Waiting for others'
 * pictures counts: who shares the machine gets smaller pictures, not fewer. */
void stream_size_learn(struct session *session, double drawn_part);

#endif
