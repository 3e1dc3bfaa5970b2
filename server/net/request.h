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

enum { REQUEST_CAPTURES = 2, REQUEST_QUERIES = 24, RESPONSE_HEADERS = 12 };

struct request_pair {
    char *name, *value;
};

struct request {
    struct hub *hub;
    const char *method;
    char client[INET6_ADDRSTRLEN];              /* the address that it came from */
    char *path;                                 /* percent-decoded, starts with '/' */
    struct request_pair query[REQUEST_QUERIES]; /* percent-decoded */
    size_t query_count;
    char capture[REQUEST_CAPTURES][LIMIT_ID_BYTES + 1]; /* what {} of the route matched */
    char *body;                                         /* ends with NUL besides */
    size_t body_length;
    const char *(*header)(const struct request *request, const char *name);
};

struct response {
    int status;
    const char *type; /* Content-Type */
    void *body;
    size_t length;
    bool borrowed; /* the body is not freed */
    struct {
        const char *name;
        char value[256];
    } headers[RESPONSE_HEADERS];
    size_t header_count;
};

/* Splits and decodes "/path?a=b"; false and `err` when it is malformed. */
bool request_parse_target(struct request *request, const char *target, struct error *err);
void request_finish(struct request *request);
/* NULL: absent. */
const char *request_header(const struct request *request, const char *name);
const char *request_query(const struct request *request, const char *name);
/* Refuses queries that are not among `names` (NULL at the end). */
bool request_check_query(const struct request *request, const char *const *names,
                         struct error *err);
/* Whether an If-Match or If-None-Match list names `tag` (with its quotes). */
bool request_tag_listed(const char *list, const char *tag);

/* Answers, from any thread, once; takes the body of `response`. The request may be gone when this
 * returns. */
void request_reply(struct request *request, const struct response *response);
void request_reply_error(struct request *request, const struct error *err);
/* `json` is taken. */
void request_reply_json(struct request *request, int status, cJSON *json);
/* `gone` is called under the hub's lock when the client leaves before the answer. Only for requests
 * that are answered under the hub's lock. */
void request_on_gone(struct request *request, void (*gone)(void *data), void *data);

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
