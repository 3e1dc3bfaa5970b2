/* SPDX-License-Identifier: MIT */
/* The head of an HTTP/1 request, read strictly (RFC 9112). Any head that two parsers may understand
 * differently is refused. Pure. */
#ifndef SERVER_HTTP_HEAD_H
#define SERVER_HTTP_HEAD_H

#include <stdbool.h>
#include <stddef.h>

#include "protocol/limits.h"

enum http_head_field {
    HEAD_HOST,
    HEAD_ORIGIN,
    HEAD_AUTHORIZATION,
    HEAD_CONTENT_LENGTH,
    HEAD_TRANSFER_ENCODING,
    HEAD_CONNECTION,
    HEAD_UPGRADE,
    HEAD_WS_VERSION,
    HEAD_WS_KEY,
    HEAD_WS_PROTOCOL,
    HEAD_FIELD_COUNT
};

/* Copies of the values that the server needs, with NUL; NULL where a field is absent. A repeated
 * field that may be a list is joined by ", ". Any other repeated field is refused. */
struct http_head {
    char *method, *target;
    int minor;     /* HTTP/1.minor */
    size_t length; /* bytes that were read */
    char *field[HEAD_FIELD_COUNT];
    char text[2 * LIMIT_HEAD_BYTES + 64]; /* storage of all values */
    size_t used;
};

/* A refusal: HTTP status and what is wrong. */
struct http_head_fault {
    int status;
    const char *message;
};

/* Searches `length` bytes for the end of a head; the first `seen` were searched before. Returns the
 * length of the head with its empty line. 0: more bytes are needed. -1: a byte is not allowed in a
 * head. */
long http_head_end(const char *bytes, size_t length, size_t seen);
/* Reads a head of `length` bytes, as http_head_end returned it. */
bool http_head_read(const char *bytes, size_t length, struct http_head *out,
                    struct http_head_fault *fault);
/* The same rules, except for duplicates, for one field that another parser has read. `value` is the
 * text behind the colon, with trailing white space. */
bool http_head_field_check(const char *name, size_t name_length, const char *value,
                           size_t value_length, struct http_head_fault *fault);
/* Rules between fields: at most one length, a known transfer coding, a Host. */
bool http_head_framing_check(const char *host, const char *content_length,
                             const char *transfer_encoding, int minor,
                             struct http_head_fault *fault);

/* True when the comma-separated `list` (may be NULL) holds `token`, case ignored. */
bool http_head_list_has(const char *list, const char *token);
/* A WebSocket handshake after RFC 6455 that offers the subprotocol. */
bool http_head_is_upgrade(const struct http_head *head, const char *subprotocol);

#endif
