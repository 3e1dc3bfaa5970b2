/* SPDX-License-Identifier: MIT */
/* The stream of pictures of a session: when a picture is drawn, and in which quality. The worker
 * draws one picture of a session at a time, always of the newest view. At most
 * LIMIT_FRAMES_IN_FLIGHT frames are on their way without an acknowledgement; before the first
 * acknowledgement it is one.
 *
 *   changed --> moving pictures, scaled so that each takes about 50 ms
 *
 *           --100 ms rest--> one larger, where full size takes long, then one still in full size,
 *                            then a guide for who wants it
 *
 *           --300 ms rest--> one lossless, shown after 4 and 16 samples too --> nothing
 *
 * Every function is called under the hub's lock. */
#ifndef SERVER_STREAM_H
#define SERVER_STREAM_H

#include "stream_state.h"

struct message;
struct session;

void stream_init(struct stream *stream);
void stream_finish(struct session *session);
/* Cancels the order. A new view or change starts the stream again. */
void stream_stop(struct session *session);
/* Sets the view of a `view` message. */
void stream_set_view(struct session *session, const struct message *message);
/* The view with this number, else the newest; NULL: there is none yet. */
const struct stream_view *stream_find_view(const struct stream *stream, uint32_t seq);
void stream_acknowledge(struct session *session, uint32_t number);
/* Call it when the document or the view has changed. */
void stream_changed(struct session *session);
/* Call it when the worker can draw a newer revision. */
void stream_shown(struct session *session);
/* Whether the client waits for a picture, or for a better one. */
bool stream_is_waiting(const struct stream *stream);
/* Orders a picture if one is due. Returns the time of the next call (clock_ms), or 0. */
int64_t stream_pump(struct session *session, int64_t now_ms);

#endif
