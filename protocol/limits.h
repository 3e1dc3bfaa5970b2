/* SPDX-License-Identifier: MIT */
/* Every limit of fieldcast, in one table: C constants here, rows for the schema and the docs from
 * limits_table. */
#ifndef PROTOCOL_LIMITS_H
#define PROTOCOL_LIMITS_H

#include <stddef.h>

/* X(NAME, value, "unit", "what it bounds") */
#define LIMITS(X)                                                                                  \
    X(DOCUMENT_BYTES, 16777216, "bytes", "a scene document")                                       \
    X(MESSAGE_BYTES, 1048576, "bytes", "a WebSocket message from a client")                        \
    X(JSON_DEPTH, 160, "levels", "nesting of JSON")                                                \
    X(JSON_KEYS, 4096, "keys", "members of one JSON object")                                       \
    X(JSON_STRING_BYTES, 65536, "bytes", "one JSON string")                                        \
    X(JSON_NUMBER_BYTES, 32, "characters", "one JSON number")                                      \
    X(JSON_VALUES, 2000000, "values", "JSON values in one text")                                   \
    X(NODES, 100000, "nodes", "nodes of a scene")                                                  \
    X(NODE_DEPTH, 64, "levels", "nesting of nodes")                                                \
    X(CHILDREN, 10000, "nodes", "children of one node")                                            \
    X(LIGHTS, 16, "lights", "lights of a scene")                                                   \
    X(MATERIALS, 1024, "materials", "materials of a scene")                                        \
    X(ID_BYTES, 64, "characters", "an id or a resource name")                                      \
    X(NAME_BYTES, 200, "bytes", "a display name")                                                  \
    X(COORDINATE, 1000000, "scene units", "magnitude of any number in a document")                 \
    X(OPERATIONS, 10000, "operations", "operations of one edit")                                   \
    X(UNDO_GROUPS, 1000, "groups", "undo steps kept for one author")                               \
    X(IMAGE_SIDE, 16384, "pixels", "width or height of a picture")                                 \
    X(IMAGE_PIXELS, 33554432, "pixels", "width times height of a picture")                         \
    X(VIEW_SIDE, 4096, "pixels", "width or height of a live view")                                 \
    X(FRAMES_IN_FLIGHT, 2, "frames", "frames sent and not yet acknowledged, per client")           \
    X(SESSIONS, 256, "sessions", "live connections")                                               \
    X(IMAGE_QUEUE, 64, "requests", "pictures waiting to be rendered")                              \
    X(HEAD_BYTES, 16384, "bytes", "the head of an HTTP request")

enum {
#define X(name, value, unit, doc) LIMIT_##name = value,
    LIMITS(X)
#undef X
};

struct limit {
    const char *name; /* lower case, e.g. "document_bytes" */
    long value;
    const char *unit;
    const char *doc;
};

/* All rows; `*out_count` of them, static. */
const struct limit *limits_table(size_t *out_count);

#endif
