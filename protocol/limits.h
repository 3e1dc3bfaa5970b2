/* SPDX-License-Identifier: MIT */
/* Every limit of fieldcast, in one table: C constants here, rows for the schema and the docs from
 * limits_table. */
#ifndef PROTOCOL_LIMITS_H
#define PROTOCOL_LIMITS_H

#include <stddef.h>

/* X(NAME, "name", value, "unit", "what it bounds") */
#define LIMITS(X)                                                                                  \
    X(DOCUMENT_BYTES, "document_bytes", 16777216, "bytes", "a scene document")                     \
    X(SCENE_BYTES, "scene_bytes", 67108864, "bytes", "a scene that edits have grown, as JSON")     \
    X(MESSAGE_BYTES, "message_bytes", 1048576, "bytes", "a WebSocket message from a client")       \
    X(JSON_DEPTH, "json_depth", 160, "levels", "nesting of JSON")                                  \
    X(JSON_KEYS, "json_keys", 4096, "keys", "members of one JSON object")                          \
    X(JSON_STRING_BYTES, "json_string_bytes", 65536, "bytes", "one JSON string")                   \
    X(JSON_NUMBER_BYTES, "json_number_bytes", 32, "characters", "one JSON number")                 \
    X(JSON_VALUES, "json_values", 2000000, "values", "JSON values in one text")                    \
    X(NODES, "nodes", 100000, "nodes", "nodes of a scene")                                         \
    X(COMPILED_SHAPES, "compiled_shapes", 512, "shapes",                                           \
      "visible shapes that shaders are compiled for; an interpreter draws scenes of more")         \
    X(INTERPRETED_SHAPES, "interpreted_shapes", 10000, "shapes",                                   \
      "visible shapes that shaders read as data; the engine draws scenes of more")                 \
    X(NODE_DEPTH, "node_depth", 64, "levels", "nesting of nodes")                                  \
    X(CHILDREN, "children", 10000, "nodes", "children of one node")                                \
    X(LIGHTS, "lights", 16, "lights", "lights of a scene")                                         \
    X(VOLUMES, "volumes", 8, "volumes", "volumes of a scene")                                      \
    X(ASSETS, "assets", 1024, "files", "uploaded files kept")                                      \
    X(ASSETS_BYTES, "assets_bytes", 1073741824, "bytes", "uploaded files kept, together")          \
    X(ASSET_BYTES, "asset_bytes", 33554432, "bytes", "one uploaded file")                          \
    X(ASSET_SIDE, "asset_side", 8192, "pixels", "width or height of an uploaded picture")          \
    X(ASSET_PIXELS, "asset_pixels", 33554432, "pixels",                                            \
      "width times height of an uploaded picture")                                                 \
    X(PANORAMA_WIDTH, "panorama_width", 4096, "pixels",                                            \
      "width of an environment's picture; larger files are averaged to it")                        \
    X(PANORAMA_BYTES, "panorama_bytes", 268435456, "bytes",                                        \
      "pictures of environments kept ready that no scene uses now")                                \
    X(CUBES_BYTES, "cubes_bytes", 1073741824, "bytes",                                             \
      "cubes of space and last pictures that the engine keeps; at most an eighth of the memory "   \
      "there is, and a quarter of what the render process may take")                               \
    X(READ_MS, "read_ms", 10000, "milliseconds", "reading the picture of an environment")          \
    X(OPEN_MS, "open_ms", 60000, "milliseconds",                                                   \
      "reading a document, or compiling a field, in the render process")                           \
    X(MATERIALS, "materials", 1024, "materials", "materials of a scene")                           \
    X(PRIMITIVES, "primitives", 256, "primitives", "distance functions of a scene")                \
    X(SHADERS, "shaders", 256, "shaders", "shaders of a scene")                                    \
    X(MODELS, "models", 1024, "models", "models of a scene")                                       \
    X(DECLARED, "declared", 16, "parameters",                                                      \
      "parameters that a primitive, shader or model declares")                                     \
    X(POINTS, "points", 64, "points", "points of a polygon")                                       \
    X(CODE_BYTES, "code_bytes", 16384, "bytes", "code of a primitive, shader or node")             \
    X(CODE_DEPTH, "code_depth", 64, "levels", "nesting of code, and of its calls")                 \
    X(CODE_SIZE, "code_size", 4096, "operations", "code, with every call written out")             \
    X(COMPILED_CODE, "compiled_code", 16384, "operations",                                         \
      "code in shaders, once for each visible shape and each shader; the engine draws more")       \
    X(CODE_TRIPS, "code_trips", 256, "iterations", "all loops of one call of code")                \
    X(CODE_WORK, "code_work", 65536, "operations", "one call of code, with its loops run through") \
    X(CODE_ARRAY, "code_array", 64, "elements", "one array in code")                               \
    X(CODE_ARRAY_BYTES, "code_array_bytes", 2048, "bytes",                                         \
      "all arrays in code, with every call written out")                                           \
    X(EQUATION_BYTES, "equation_bytes", 16384, "bytes", "an equation")                             \
    X(EQUATION_NODES, "equation_nodes", 2048, "operations", "different ones of an equation")       \
    X(EQUATION_OPERATIONS, "equation_operations", 256, "operations",                               \
      "the same of an equation that is no polynomial of polynomial_degree")                        \
    X(POLYNOMIAL_DEGREE, "polynomial_degree", 18, "factors",                                       \
      "an equation that is drawn by its coefficients, at most 1,330")                              \
    X(SURFACE_ROWS, "surface_rows", 655360, "vectors of four numbers",                             \
      "patches of all parametric surfaces, each with its tree and grid")                           \
    X(EQUATION_WEIGHT, "equation_weight", 16384, "operations",                                     \
      "an equation with all definitions written out")                                              \
    X(EQUATION_DEPTH, "equation_depth", 64, "levels", "nesting of an equation")                    \
    X(EQUATION_EXPONENT, "equation_exponent", 64, "factors", "a whole exponent")                   \
    X(PARAMETRIC_DEGREE, "parametric_degree", 64, "factors",                                       \
      "a polynomial in the parameters of a surface, or made of an equation")                       \
    X(IMPLICIT_DEGREE, "implicit_degree", 18, "factors",                                           \
      "the equation that is found for a parametric surface")                                       \
    X(COEFFICIENT_BITS, "coefficient_bits", 4096, "bits", "a coefficient of such polynomials")     \
    X(QUESTION_BYTES, "question_bytes", 262144, "bytes", "a request for one of these, or a basis") \
    X(ALGEBRA_SECONDS, "algebra_seconds", 30, "seconds", "finding or proving an equation")         \
    X(ALGEBRA_BYTES, "algebra_bytes", 1073741824, "bytes", "memory of the same")                   \
    X(GROEBNER_LETTERS, "groebner_letters", 10, "letters", "the ring of an ideal")                 \
    X(GROEBNER_GENERATORS, "groebner_generators", 64, "polynomials", "an ideal")                   \
    X(ALGEBRA_KEPT, "algebra_kept", 16, "questions", "those of the algebra that may be read")      \
    X(ALGEBRA_SHARE, "algebra_share", 4, "questions", "the same, of one client")                   \
    X(EQUATION_DEFINITIONS, "equation_definitions", 32, "definitions", "those of an equation")     \
    X(TYPESET_NODES, "typeset_nodes", 400, "operations",                                           \
      "each line of an equation that is typeset, before an ellipsis")                              \
    X(JUDGED_EQUATIONS, "judged_equations", 16, "equations", "an answer about how they are drawn") \
    X(COMPILE_MS, "compile_ms", 60000, "milliseconds", "compiling a scene")                        \
    X(COMPILE_CODE_MS, "compile_code_ms", 2000, "milliseconds",                                    \
      "the same with code in it, at least")                                                        \
    X(COMPILE_FACTOR, "compile_factor", 2, "times",                                                \
      "the same, of what so many shapes take without code on this machine")                        \
    X(COMPILE_STILL_MS, "compile_still_ms", 30000, "milliseconds",                                 \
      "a compiler that neither uses a processor nor waits for one")                                \
    X(RETRY_FACTOR, "retry_factor", 5, "times", "time for what is tried again")                    \
    X(RETRY_TIMES, "retry_times", 125, "times", "the same, after several retries")                 \
    X(TILE_MS, "tile_ms", 10000, "milliseconds", "drawing the smallest part of a picture")         \
    X(LIBRARY_ENTRIES, "library_entries", 1024, "entries", "the library")                          \
    X(LIBRARY_BYTES, "library_bytes", 4194304, "bytes", "documents of the library, together")      \
    X(LIBRARY_NODES, "library_nodes", 4096, "nodes", "an entry of the library")                    \
    X(ID_BYTES, "id_bytes", 64, "characters", "an id or a resource name")                          \
    X(NAME_BYTES, "name_bytes", 200, "bytes", "a display name")                                    \
    X(COORDINATE, "coordinate", 1000000, "scene units", "magnitude of any number in a document")   \
    X(OPERATIONS, "operations", 10000, "operations", "operations of one edit")                     \
    X(POSTER_BYTES, "poster_bytes", 1048576, "bytes", "the last picture that is kept of a scene")  \
    X(EDIT_JUMP, "edit_jump", 1000, "numbers", "from an edit of a client to its next")             \
    X(UNDO_GROUPS, "undo_groups", 1000, "groups", "undo steps kept for one author")                \
    X(UNDO_BYTES, "undo_bytes", 67108864, "bytes", "the same, in memory; a scene has four times")  \
    X(IMAGE_SIDE, "image_side", 16384, "pixels", "width or height of a picture")                   \
    X(IMAGE_PIXELS, "image_pixels", 268435456, "pixels", "width times height of a picture")        \
    X(IMAGE_BYTES, "image_bytes", 268435456, "bytes", "one finished picture, as it is sent")       \
    X(VIEW_SIDE, "view_side", 4096, "pixels", "width or height of a live view")                    \
    X(PICK_WORK, "pick_work", 50000000, "operations",                                              \
      "the ray of a pick: instructions of the field, operations of code in it")                    \
    X(PICK_THROUGH, "pick_through", 32, "nodes", "nodes that a pick lists")                        \
    X(ISOLATED, "isolated", 256, "nodes", "nodes that a view isolates")                            \
    X(GUIDE_PIXELS, "guide_pixels", 1048576, "pixels", "a guide; that of a larger view is scaled") \
    X(DELTA_PIXELS, "delta_pixels", 4194304, "pixels",                                             \
      "a live picture of which changed squares alone may be sent")                                 \
    X(DELTAS_BYTES, "deltas_bytes", 134217728, "bytes",                                            \
      "last pictures of live views, kept for that")                                                \
    X(THUMBNAILS, "thumbnails", 256, "ids", "one list of thumbnails that a client asks for")       \
    X(THUMBNAIL_WIDTH, "thumbnail_width", 192, "pixels", "width of a small thumbnail")             \
    X(THUMBNAIL_NODES, "thumbnail_nodes", 4096, "nodes",                                           \
      "a node with all below it and in its models, where it has a thumbnail")                      \
    X(THUMBNAIL_CACHE_BYTES, "thumbnail_cache_bytes", 16777216, "bytes", "thumbnails kept")        \
    X(FRAMES_IN_FLIGHT, "frames_in_flight", 2, "frames",                                           \
      "frames sent and not yet acknowledged, per client")                                          \
    X(SESSIONS, "sessions", 256, "sessions", "live connections")                                   \
    X(IMAGE_QUEUE, "image_queue", 64, "requests", "pictures waiting to be rendered")               \
    X(IMAGE_SHARE, "image_share", 16, "requests", "the same, of one client")                       \
    X(DOCUMENT_QUEUE, "document_queue", 64, "requests", "large documents waiting to be read")      \
    X(DOCUMENT_SHARE, "document_share", 16, "requests", "the same, of one client")                 \
    X(IMAGE_CACHE_BYTES, "image_cache_bytes", 67108864, "bytes", "finished pictures kept")         \
    X(HEAD_BYTES, "head_bytes", 16384, "bytes", "the head of an HTTP request")                     \
    X(BODIES_BYTES, "bodies_bytes", 268435456, "bytes",                                            \
      "bodies of requests that are being received, together")                                      \
    X(ANSWERS_BYTES, "answers_bytes", 536870912, "bytes",                                          \
      "answers that their clients have not read yet, together")                                    \
    X(ANSWERS_SHARE_BYTES, "answers_share_bytes", 134217728, "bytes",                              \
      "the same of one client, where it is more than one answer")                                  \
    X(LIVE_SILENCE, "live_silence", 14, "seconds", "a live connection that answers no ping")

enum {
#define X(NAME, name, value, unit, doc) LIMIT_##NAME = value,
    LIMITS(X)
#undef X
};

struct limit {
    const char *name; /* e.g. "document_bytes" */
    long value;
    const char *unit;
    const char *doc;
};

/* All rows; `*out_count` of them, static. */
const struct limit *limits_table(size_t *out_count);

#endif
