/* SPDX-License-Identifier: MIT */
/* A request and its answer as handlers see them: no sockets, no HTTP library. */
#ifndef SERVER_REQUEST_H
#define SERVER_REQUEST_H

#include <cjson/cJSON.h>
#include <netinet/in.h>
#include <stdbool.h>
#include <stddef.h>

#include "protocol/error.h"
#include "protocol/limits.h"

struct hub;
struct shared_buffer;

enum { REQUEST_CAPTURES = 2, REQUEST_QUERIES = 24, RESPONSE_HEADERS = 12 };

struct request_pair {
    char *name, *value;
};

struct request {
    struct hub *hub;
    const char *method;
    char client[INET6_ADDRSTRLEN];              /* the client's address */
    char *path;                                 /* percent-decoded, starts with '/' */
    struct request_pair query[REQUEST_QUERIES]; /* percent-decoded */
    size_t query_count;
    char capture[REQUEST_CAPTURES][LIMIT_ID_BYTES + 1]; /* matches of {} in the route */
    char *body;                                         /* with a NUL behind it */
    size_t body_length;
    const char *(*header)(const struct request *request, const char *name);
};

struct response {
    int status;
    const char *type; /* Content-Type */
    void *body;
    size_t length;
    bool borrowed;                /* the body is static and not freed */
    struct shared_buffer *shared; /* instead of a body; of its bytes `length` are sent */
    struct {
        const char *name;
        char value[256];
    } headers[RESPONSE_HEADERS];
    size_t header_count;
};

/* Splits and decodes "/path?a=b". False and `err` when it is malformed. */
bool request_parse_target(struct request *request, const char *target, struct error *err);
void request_finish(struct request *request);
/* Both return NULL where it is absent. Lines of one header are joined by ", ". */
const char *request_header(const struct request *request, const char *name);
const char *request_query(const struct request *request, const char *name);
/* False and `err` where the request has a query that is not in `names`, which end with NULL. */
bool request_check_query(const struct request *request, const char *const *names,
                         struct error *err);
/* Whether If-None-Match has `tag` (with its quotes): the client has what it stands for. */
bool request_knows_tag(const struct request *request, const char *tag);
/* False and `err` where If-Match does not have the tag of what is to be changed, or If-None-Match
 * has it. NULL: there is nothing yet. */
bool request_check_match(const struct request *request, const char *tag, struct error *err);

/* Whether Accept-Encoding asks for gzip. Without that header nothing does. */
bool request_wants_gzip(const struct request *request);

/* Answers the request once; any thread. Takes the body of `response`, or its reference. The request
 * must not be used afterwards. */
void request_reply(struct request *request, const struct response *response);
void request_reply_error(struct request *request, const struct error *err);
/* Takes `json`. */
void request_reply_json(struct request *request, int status, cJSON *json);
/* `gone` is called under the hub's lock when the client leaves before the answer, unless its
 * connection has ended by now. Such requests have to be answered under the hub's lock. */
void request_on_gone(struct request *request, void (*gone)(void *data), void *data);
/* For a handler that finds much to do which its route did not tell: if true, it returns without an
 * answer and is called again, from its beginning, as a heavy task. False: it is one, or none. */
bool request_becomes_heavy(struct request *request);

void response_add(struct response *response, const char *name, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* application/problem+json (RFC 9457). */
struct response response_problem(int status, const char *code, const char *place,
                                 const char *detail);
struct response response_error(const struct error *err);
struct response response_json(int status, cJSON *json);                  /* takes `json` */
struct response response_text(int status, const char *type, char *text); /* takes `text` */
const char *response_title(int status);

#endif
