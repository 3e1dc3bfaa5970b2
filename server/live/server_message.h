/* SPDX-License-Identifier: MIT */
/* The server's messages on a live connection, as bytes. The wire form is in protocol/README.md.
 * Pure. Callers unref the results. */
#ifndef SERVER_MESSAGE_H
#define SERVER_MESSAGE_H

#include <cjson/cJSON.h>

#include "protocol/error.h"
#include "server/net/send_queue.h"

/* The text of a message; takes `message`. */
struct shared_buffer *message_print(cJSON *message);
/* An object with its `type` already in. */
cJSON *message_begin(const char *type);
/* {type, revision, document}. The document stays text, because it is large. */
struct shared_buffer *message_document(uint64_t revision, const char *document, size_t bytes);
/* `author`'s operations; `edit` 0 is left out. */
struct shared_buffer *message_changed(uint64_t revision, const char *author, const char *ops,
                                      int64_t edit);
/* `skipped`: operations that an undo or redo left out; NULL: none. */
struct shared_buffer *message_applied(int64_t edit, uint64_t revision, bool durable, size_t undo,
                                      size_t redo, const cJSON *skipped);
struct shared_buffer *message_rejected(int64_t edit, const struct error *err, const cJSON *skipped);
struct shared_buffer *message_notice(const char *level, const char *code, const char *place,
                                     const char *text);
/* A notice about an error, with line and column where it is in a text. */
struct shared_buffer *message_fault(const char *level, const char *code, const struct error *err);
/* A notice that the scene is suspended, with the kind of `why` as its reason. */
struct shared_buffer *message_left_out(const struct error *why);
/* `retry_ms` < 0: do not come back. */
struct shared_buffer *message_bye(const char *reason, int retry_ms);

#endif
