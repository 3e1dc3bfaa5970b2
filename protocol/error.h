/* SPDX-License-Identifier: MIT */
/* How every layer says what went wrong: a kind, a place, and a sentence. No logging, no exit. */
#ifndef PROTOCOL_ERROR_H
#define PROTOCOL_ERROR_H

#include <stdbool.h>
#include <stdio.h>

/* X(NAME, "wire-code", http-status): the one list of kinds of error. */
#define ERROR_KINDS(X)                                                                             \
    X(NONE, "none", 200)                                                                           \
    X(SYNTAX, "syntax", 400)             /* not JSON, not UTF-8, not the expected shape */         \
    X(INVALID, "invalid", 422)           /* well formed, but a value breaks a rule */              \
    X(LIMIT, "limit", 422)               /* a limit of limits.h is exceeded */                     \
    X(TOO_LARGE, "too_large", 413)       /* more bytes than accepted */                            \
    X(NOT_FOUND, "not_found", 404)       /* the thing addressed does not exist */                  \
    X(CONFLICT, "conflict", 409)         /* id in use, still referenced, cycle */                  \
    X(PRECONDITION, "precondition", 412) /* If-Match names another revision */                     \
    X(FORBIDDEN, "forbidden", 403)       /* not with these rights */                               \
    X(COMPILE, "compile", 422)           /* a shader does not compile */                           \
    X(TOO_SLOW, "too_slow", 503)         /* it took more time than it may: not before a retry */   \
    X(CRASHED, "crashed", 503)           /* it ended the render process: not before a retry */     \
    X(UNAVAILABLE, "unavailable", 503)   /* not now: worker restarting, queue full, draining */    \
    X(SHARE, "share", 429)               /* more than this client's share: after retry_ms */       \
    X(FULL, "full", 507)                 /* no room to keep more */                                \
    X(INTERNAL, "internal", 500)         /* our fault */

enum error_kind {
#define X(name, wire, status) ERROR_##name,
    ERROR_KINDS(X)
#undef X
};

enum { ERROR_PLACE_BYTES = 192 };

/* A caller-owned value; zero-initialise. `place` is a JSON path such as /nodes/body/params/radius,
 * a file name, or "". */
struct error {
    enum error_kind kind;
    char place[ERROR_PLACE_BYTES];
    char message[320];
    int line, column;          /* in the text at `place`, from 1; 0: not in a text */
    int measured_ms, limit_ms; /* ERROR_TOO_SLOW: time of the processors; else 0 */
    int retry_ms;              /* when to ask again; 0: not known */
    int position;              /* that it would have in the queue which is full; else 0 */
};

/* Fills `err` (which may be NULL) and returns false, so that `return error_set(...)` reads well.
 * What is not UTF-8 becomes '?', so that an error can always be sent. */
bool error_set(struct error *err, enum error_kind kind, const char *place, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The same, in a text. */
bool error_set_at(struct error *err, enum error_kind kind, const char *place, int line, int column,
                  const char *format, ...) __attribute__((format(printf, 6, 7)));

/* ERROR_TOO_SLOW: "WHAT over 2.1 s (limit 2 s)", as "compiling this code took". */
bool error_set_slow(struct error *err, const char *place, const char *what, int measured_ms,
                    int limit_ms);

/* "PLACE/MEMBER" in `out` of ERROR_PLACE_BYTES; where too long it keeps the end. Returns `out`. */
const char *error_place(char *out, const char *place, const char *member);

/* "place: message", "place:line:column: message", or the message alone. */
void error_print(const struct error *err, FILE *out);

const char *error_kind_name(enum error_kind kind);
int error_kind_status(enum error_kind kind);

#endif
