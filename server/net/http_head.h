/* SPDX-License-Identifier: MIT */
/* The head of an HTTP/1 request, read strictly (RFC 9112): whatever two parsers could understand
 * differently is refused. Pure: no sockets. */
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

/* The values that matter, as copies that end with NUL; NULL where the field is absent. Fields
 * which may be lists and come twice are joined by ", "; the others are refused when they do. */
struct http_head {
    char *method, *target;
    int minor;     /* HTTP/1.minor */
    size_t length; /* bytes that were read */
    char *field[HEAD_FIELD_COUNT];
    char text[2 * LIMIT_HEAD_BYTES + 64]; /* backs all of the above */
    size_t used;
};

/* A refusal: HTTP status and what is wrong. */
struct http_head_fault {
    int status;
    const char *message;
};

/* Looks for the end of a head in `length` bytes of which the first `seen` have been looked at.
 * Bytes of the head including the empty line; 0: more are needed; -1: a byte that no head holds. */
long http_head_end(const char *bytes, size_t length, size_t seen);
/* Reads `length` bytes that http_head_end delimited. */
bool http_head_read(const char *bytes, size_t length, struct http_head *out,
                    struct http_head_fault *fault);
/* The same rule for one field of a request that somebody else parsed: duplicates excepted. `value`
 * is what stands behind the colon, with the white space behind it. */
bool http_head_field_check(const char *name, size_t name_length, const char *value,
                           size_t value_length, struct http_head_fault *fault);
/* Rules between fields: one length at most, a transfer coding that is known, a Host. */
bool http_head_framing_check(const char *host, const char *content_length,
                             const char *transfer_encoding, int minor,
                             struct http_head_fault *fault);

/* True when the comma-separated `list` (may be NULL) holds `token`, case ignored. */
bool http_head_list_has(const char *list, const char *token);
/* A WebSocket handshake after RFC 6455 that offers the subprotocol. */
bool http_head_is_upgrade(const struct http_head *head, const char *subprotocol);

#endif
