/* SPDX-License-Identifier: MIT */
/* The acceptor has looked at the first head of each connection; later ones are looked at here, as
 * far as libmicrohttpd shows them. A request that waits for a commit or a picture is suspended. */
#include "http.h"

#include <arpa/inet.h>
#include <microhttpd.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/epoll.h>
#include <unistd.h>

#include "answers.h"
#include "body.h"
#include "presence.h"
#include "protocol/memory.h"
#include "request.h"
#include "request_checks.h"
#include "route.h"
#include "safety.h"
#include "server/clock.h"
#include "server/log.h"
#include "server/metrics.h"
#include "server/tasks.h"
#include "shared_buffer.h"

enum { BODY_PATIENCE = 3 }; /* times the limit that are read before the connection is cut */

/* A header; the value is without the white space behind it. */
struct header {
    struct header *next;
    const char *value; /* in `name`, behind it */
    char name[];
};

/* One request and its reply. Lives from the request line to libmicrohttpd's completed callback, and
 * where that comes first, until it is replied and not handled any more. */
struct exchange {
    struct request request; /* first: handlers know only this */
    struct http *http;
    struct MHD_Connection *connection;
    const struct route *route;
    char *target;
    char method[24];        /* cut off where it is none of ours */
    struct header *headers; /* copies, in their order */
    bool begun, counted;    /* admitted; among http->pending */
    bool handled;           /* was given to its handler */
    bool heavy, again;      /* as a heavy task; the handler wants to be one */
    struct body body;
    size_t body_bytes; /* seen, kept or not */
    int64_t deadline;
    struct MHD_Response *response; /* under http->lock until replied */
    int status;
    bool replied;   /* under http->lock, as the next three */
    bool handling;  /* a thread of the tasks has it */
    bool suspended; /* until it is replied and not handled any more */
    bool completed; /* `connection` is gone */
    void (*gone)(void *data);
    void *gone_data;
    struct presence presence; /* while there is a `gone` */
    int64_t started_us;
};

struct http {
    struct http_app app;
    struct MHD_Daemon *daemon;
    int gone_epoll;
    atomic_int connections, pending;
    struct bodies bodies;
    struct answers answers;
    pthread_mutex_t lock; /* the states; taken after the hub's lock */
};

/* --- replies --- */

static const char content_policy[] =
    "default-src 'self'; img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; "
    "worker-src 'self' blob:; connect-src 'self'; object-src 'none'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

static void add_cors(struct MHD_Response *out, const struct exchange *exchange)
{
    const char *origin = request_header(&exchange->request, "Origin");

    if (!origin) {
        return;
    }
    /* Refused origins got a 403 before; one's own page needs none of this. */
    MHD_add_response_header(out, "Access-Control-Allow-Origin", origin);
    MHD_add_response_header(out, "Access-Control-Expose-Headers",
                            "ETag, Location, Fieldcast-Revision, Fieldcast-Size, "
                            "Fieldcast-Renderer");
    MHD_add_response_header(out, "Vary", "Origin");
}

/* Takes `answer`, which has the body. */
static struct MHD_Response *build_response(const struct exchange *exchange,
                                           const struct response *response, struct answer *answer)
{
    struct MHD_Response *out = MHD_create_response_from_buffer_with_free_callback_cls(
        response->length, response->shared ? response->shared->bytes : response->body,
        answer_destroy, answer);
    bool cache = false;

    if (!out) {
        abort();
    }
    if (response->type) {
        MHD_add_response_header(out, "Content-Type", response->type);
    }
    for (size_t i = 0; i < response->header_count; i++) {
        cache |= strcmp(response->headers[i].name, "Cache-Control") == 0;
        MHD_add_response_header(out, response->headers[i].name, response->headers[i].value);
    }
    if (!cache) {
        MHD_add_response_header(out, "Cache-Control", "no-cache");
    }
#define ADD(name, value) MHD_add_response_header(out, name, value);
    SAFETY_HEADERS(ADD)
#undef ADD
    if (response->type && strncmp(response->type, "text/html", 9) == 0) {
        MHD_add_response_header(out, "Content-Security-Policy", content_policy);
        MHD_add_response_header(out, "Cross-Origin-Opener-Policy", "same-origin");
    }
    if (response->status != 403) {
        add_cors(out, exchange);
    }
    return out;
}

/* Under the lock. */
static void unwatch(struct exchange *exchange)
{
    if (exchange->gone) {
        presence_unwatch(exchange->http->gone_epoll, &exchange->presence);
        exchange->gone = NULL;
    }
}

static void exchange_destroy(struct exchange *exchange)
{
    if (exchange->response) {
        MHD_destroy_response(exchange->response);
    }
    body_finish(&exchange->body);
    request_finish(&exchange->request);
    while (exchange->headers) {
        struct header *next = exchange->headers->next;

        free(exchange->headers);
        exchange->headers = next;
    }
    free(exchange->target);
    free(exchange);
}

/* Who still has it replies or returns: under the lock. */
static bool is_in_hands(const struct exchange *exchange)
{
    return exchange->handling || (exchange->handled && !exchange->replied);
}

/* After a reply, or the return of a handler, which may use the request until then. Unlocks. The
 * library may complete a request at any time in which its connection is not suspended. */
static void settle(struct exchange *exchange)
{
    struct http *http = exchange->http;
    const bool over = exchange->completed && !is_in_hands(exchange);

    if (exchange->replied && exchange->suspended && !exchange->handling && !exchange->completed) {
        MHD_resume_connection(exchange->connection);
    }
    pthread_mutex_unlock(&http->lock);
    if (over) {
        exchange_destroy(exchange);
    }
}

/* Frees the body. */
static struct response refuse_answer(struct http *http, const struct response *response)
{
    char detail[160];

    metric_add(http->app.metrics, METRIC_ANSWERS_OVER_LIMIT, 1);
    snprintf(
        detail, sizeof detail,
        "answers that clients have not read hold too much; the limit is %d bytes, and %d bytes "
        "for one client",
        LIMIT_ANSWERS_BYTES, LIMIT_ANSWERS_SHARE_BYTES);
    shared_buffer_unref(response->shared);
    free(response->body);
    return response_problem(503, "unavailable", "", detail);
}

void request_reply(struct request *request, const struct response *response)
{
    struct exchange *exchange = (struct exchange *)request;
    struct http *http = exchange->http;
    struct answer *answer = answers_add(&http->answers, request->client, response);
    struct response refusal;

    if (!answer) {
        refusal = refuse_answer(http, response);
        response = &refusal;
        answer = answers_add(&http->answers, request->client, response);
    }
    struct MHD_Response *built = build_response(exchange, response, answer);

    pthread_mutex_lock(&http->lock);
    exchange->response = built;
    exchange->status = response->status;
    exchange->replied = true;
    unwatch(exchange);
    settle(exchange);
}

void request_on_gone(struct request *request, void (*gone)(void *data), void *data)
{
    struct exchange *exchange = (struct exchange *)request;

    pthread_mutex_lock(&exchange->http->lock);
    if (!exchange->replied && !exchange->completed) {
        const union MHD_ConnectionInfo *info =
            MHD_get_connection_info(exchange->connection, MHD_CONNECTION_INFO_CONNECTION_FD);

        exchange->presence.fd = info->connect_fd;
        if (presence_watch(exchange->http->gone_epoll, &exchange->presence, exchange)) {
            exchange->gone = gone;
            exchange->gone_data = data;
        }
    }
    pthread_mutex_unlock(&exchange->http->lock);
}

int http_gone_fd(const struct http *http)
{
    return http->gone_epoll;
}

/* The hub's lock keeps what is behind `gone` alive: such requests are answered under it only. */
void http_check_gone(struct http *http)
{
    struct epoll_event events[16];

    struct {
        void (*call)(void *data);
        void *data;
    } gone[16];
    int count = 0;

    http->app.lock(http->app.hub);
    pthread_mutex_lock(&http->lock);
    const int found = epoll_wait(http->gone_epoll, events, 16, 0);
    for (int i = 0; i < found; i++) {
        struct exchange *exchange = events[i].data.ptr;

        if (exchange->gone &&
            presence_has_left(http->gone_epoll, &exchange->presence, events[i].events, exchange)) {
            gone[count].call = exchange->gone;
            gone[count++].data = exchange->gone_data;
        }
    }
    pthread_mutex_unlock(&http->lock);
    for (int i = 0; i < count; i++) {
        gone[i].call(gone[i].data);
    }
    http->app.unlock(http->app.hub);
}

/* --- libmicrohttpd's callbacks --- */

/* The link to the header; at the end: there is none. */
static struct header **find_link(struct exchange *exchange, const char *name)
{
    struct header **at = &exchange->headers;

    while (*at && strcasecmp((*at)->name, name) != 0) {
        at = &(*at)->next;
    }
    return at;
}

/* White space around a value is no part of it (RFC 9110, 5.5). The library cuts it off in front.
 * Lines of one name are one list (5.3). */
static enum MHD_Result add_header(void *data, enum MHD_ValueKind kind, const char *name,
                                  const char *value)
{
    struct header **at = find_link(data, name), *before = *at;
    const char *joined = before ? before->value : "", *between = before ? ", " : "";
    const size_t name_bytes = strlen(name) + 1;
    int length = value ? (int)strlen(value) : 0;

    (void)kind;
    while (length && (value[length - 1] == ' ' || value[length - 1] == '\t')) {
        length--;
    }
    const size_t value_bytes = strlen(joined) + strlen(between) + (size_t)length + 1;
    struct header *header = memory_alloc(1, sizeof *header + name_bytes + value_bytes);
    memcpy(header->name, name, name_bytes);
    header->value = header->name + name_bytes;
    snprintf(header->name + name_bytes, value_bytes, "%s%s%.*s", joined, between, length,
             value ? value : "");
    header->next = before ? before->next : NULL;
    *at = header;
    free(before);
    return MHD_YES;
}

static const char *find_header(const struct request *request, const char *name)
{
    const struct header *header = *find_link((struct exchange *)request, name);

    return header ? header->value : NULL;
}

/* "": not known. */
static void read_address(struct MHD_Connection *connection, char out[INET6_ADDRSTRLEN])
{
    const union MHD_ConnectionInfo *info =
        MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CLIENT_ADDRESS);
    const struct sockaddr *address = info ? info->client_addr : NULL;

    if (address && address->sa_family == AF_INET) {
        inet_ntop(AF_INET, &((const struct sockaddr_in *)address)->sin_addr, out, INET6_ADDRSTRLEN);
    } else if (address && address->sa_family == AF_INET6) {
        inet_ntop(AF_INET6, &((const struct sockaddr_in6 *)address)->sin6_addr, out,
                  INET6_ADDRSTRLEN);
    }
}

static void *on_target(void *data, const char *target, struct MHD_Connection *connection)
{
    struct http *http = data;
    struct exchange *exchange = memory_alloc(1, sizeof *exchange);

    exchange->http = http;
    exchange->connection = connection;
    exchange->target = target ? memory_text(target) : NULL;
    exchange->body.bodies = &http->bodies;
    exchange->request.hub = http->app.hub;
    exchange->request.header = find_header;
    read_address(connection, exchange->request.client);
    exchange->started_us = clock_us();
    return exchange;
}

static enum MHD_Result queue_reply(struct exchange *exchange)
{
    struct metrics *metrics = exchange->http->app.metrics;
    enum MHD_Result result =
        MHD_queue_response(exchange->connection, (unsigned)exchange->status, exchange->response);

    metric_add(metrics, METRIC_HTTP_REQUESTS, 1);
    metric_add(metrics, METRIC_HTTP_ERRORS, exchange->status >= 400);
    log_debug("http", "%s %s %d %lld us", exchange->request.method,
              exchange->request.path ? exchange->request.path : "?", exchange->status,
              (long long)(clock_us() - exchange->started_us));
    return result;
}

static enum MHD_Result answer_now(struct exchange *exchange, const struct response *response)
{
    request_reply(&exchange->request, response);
    return queue_reply(exchange);
}

static size_t body_limit(const struct exchange *exchange)
{
    return request_checks_body_limit(exchange->route);
}

static void refuse_memory(struct exchange *exchange)
{
    char detail[120];

    metric_add(exchange->http->app.metrics, METRIC_BODIES_OVER_LIMIT, 1);
    snprintf(detail, sizeof detail,
             "bodies of requests hold %zu bytes already; the limit is %d bytes",
             atomic_load(&exchange->http->bodies.held), LIMIT_BODIES_BYTES);
    struct response response = response_problem(503, "unavailable", "", detail);
    request_reply(&exchange->request, &response);
}

/* The library takes no reply in the middle of a body. So what is too much is read away for a while
 * and then refused, and what is too slow is cut off. */
static enum MHD_Result receive_body(struct exchange *exchange, const char *bytes, size_t *length)
{
    exchange->body_bytes += *length;
    if (clock_ms() > exchange->deadline ||
        exchange->body_bytes > BODY_PATIENCE * body_limit(exchange)) {
        return MHD_NO;
    }
    if (exchange->body_bytes <= body_limit(exchange) && !exchange->response &&
        !body_add(&exchange->body, &exchange->request, bytes, *length)) {
        refuse_memory(exchange);
    }
    *length = 0;
    return MHD_YES;
}

static enum MHD_Result refuse_body(struct exchange *exchange)
{
    char detail[100];

    snprintf(detail, sizeof detail, "the body of %zu bytes is above the maximum %zu",
             exchange->body_bytes, body_limit(exchange));
    struct response response = response_problem(413, "too_large", "", detail);
    return answer_now(exchange, &response);
}

bool request_becomes_heavy(struct request *request)
{
    struct exchange *exchange = (struct exchange *)request;

    exchange->again = exchange->handling && !exchange->heavy;
    return exchange->again;
}

static void run_handler(void *data, bool dropped);

static bool add_task(struct exchange *exchange, bool heavy, struct error *err)
{
    const bool named = exchange->route->scene == SCENE_NAMED;

    exchange->heavy = heavy;
    exchange->again = false;
    return tasks_add(exchange->http->app.tasks,
                     &(struct task_order){.scene = named ? exchange->request.capture[0] : "",
                                          .account = exchange->request.client,
                                          .heavy = heavy,
                                          .bounded = true,
                                          .run = run_handler,
                                          .data = exchange},
                     err);
}

/* On a thread of the tasks. */
static void run_handler(void *data, bool dropped)
{
    struct exchange *exchange = data;
    struct http *http = exchange->http;
    struct error err = {0};

    if (dropped) {
        struct response response =
            response_problem(503, "unavailable", "", "the server is shutting down");
        request_reply(&exchange->request, &response);
    } else {
        exchange->route->handle(&exchange->request);
        if (exchange->again) {
            if (add_task(exchange, true, &err)) {
                return; /* another thread may have it by now */
            }
            request_reply_error(&exchange->request, &err);
        }
    }
    pthread_mutex_lock(&http->lock);
    exchange->handling = false;
    settle(exchange);
}

static bool is_heavy(const struct exchange *exchange)
{
    const struct http_app *app = &exchange->http->app;
    const enum route_scene scene = exchange->route->scene;

    return exchange->request.body_length > TASK_LIGHT_BYTES || scene == SCENE_ALL ||
           scene == SCENE_JUDGED ||
           (scene == SCENE_NAMED && app->scene_is_heavy(app->hub, exchange->request.capture[0]));
}

static void hand_over(struct exchange *exchange)
{
    struct error err = {0};

    exchange->handling = true;
    if (!add_task(exchange, is_heavy(exchange), &err)) {
        exchange->handling = false;
        request_reply_error(&exchange->request, &err);
    }
}

static void handle(struct exchange *exchange)
{
    exchange->handled = exchange->counted = true;
    atomic_fetch_add(&exchange->http->pending, 1);
    if (exchange->route->scene == SCENE_NONE) {
        exchange->route->handle(&exchange->request);
    } else {
        hand_over(exchange);
    }
}

/* Whether the reply can be queued. A connection that was suspended does what it would have done
 * next: behind its first call that is to read, where an end of input closes it, with or without
 * a reply. So it is suspended at the next call, behind which it asks for the reply. */
static bool is_ready(struct exchange *exchange, bool may_suspend)
{
    struct http *http = exchange->http;

    pthread_mutex_lock(&http->lock);
    const bool ready = exchange->replied && !exchange->handling;
    if (!ready && may_suspend) {
        exchange->suspended = true;
        MHD_suspend_connection(exchange->connection);
    }
    pthread_mutex_unlock(&http->lock);
    return ready;
}

/* The head is there. A refusal waits until the body has been read away: closing before would reset
 * the connection and might destroy the reply. Who asks with Expect is told at once. */
static enum MHD_Result begin(struct exchange *exchange, const char *version)
{
    struct response response = {0};

    if (!request_checks_framing(&exchange->request, exchange->connection, version, &response)) {
        return answer_now(exchange, &response);
    }
    if (request_checks_pass(&exchange->http->app, &exchange->request, exchange->target,
                            &exchange->route, &response)) {
        const uint64_t announced = request_checks_announced_bytes(&exchange->request);

        exchange->body.most = announced ? (size_t)announced : body_limit(exchange);
        return MHD_YES;
    }
    if (request_checks_has_body(&exchange->request) &&
        !request_header(&exchange->request, "Expect") &&
        request_checks_announced_bytes(&exchange->request) <=
            BODY_PATIENCE * body_limit(exchange)) {
        request_reply(&exchange->request, &response);
        return MHD_YES;
    }
    return answer_now(exchange, &response);
}

static enum MHD_Result on_access(void *data, struct MHD_Connection *connection, const char *url,
                                 const char *method, const char *version, const char *upload,
                                 size_t *upload_size, void **connection_data)
{
    struct exchange *exchange = *connection_data;

    (void)data;
    (void)connection;
    (void)url;
    if (!exchange->begun) {
        exchange->begun = true;
        snprintf(exchange->method, sizeof exchange->method, "%s", method);
        exchange->request.method = exchange->method;
        MHD_get_connection_values(connection, MHD_HEADER_KIND, add_header, exchange);
        exchange->presence.reads_interim = strcmp(version, MHD_HTTP_VERSION_1_1) == 0;
        exchange->deadline = clock_ms() + HTTP_BODY_MS;
        return begin(exchange, version);
    }
    if (*upload_size > 0) {
        return receive_body(exchange, upload, upload_size);
    }
    if (is_ready(exchange, exchange->handled)) {
        return queue_reply(exchange);
    }
    if (exchange->handled) {
        return MHD_YES;
    }
    if (exchange->body_bytes > body_limit(exchange)) {
        return refuse_body(exchange);
    }
    handle(exchange);
    return is_ready(exchange, false) ? queue_reply(exchange) : MHD_YES;
}

static void on_completed(void *data, struct MHD_Connection *connection, void **connection_data,
                         enum MHD_RequestTerminationCode code)
{
    struct exchange *exchange = *connection_data;

    (void)data;
    (void)connection;
    (void)code;
    if (!exchange) {
        return;
    }
    if (exchange->counted) {
        atomic_fetch_sub(&exchange->http->pending, 1);
    }
    *connection_data = NULL;
    pthread_mutex_lock(&exchange->http->lock);
    unwatch(exchange);
    exchange->completed = true;
    settle(exchange);
}

static void on_connection(void *data, struct MHD_Connection *connection, void **socket_data,
                          enum MHD_ConnectionNotificationCode code)
{
    struct http *http = data;

    (void)connection;
    (void)socket_data;
    if (code == MHD_CONNECTION_NOTIFY_CLOSED) {
        atomic_fetch_sub(&http->connections, 1);
    }
}

__attribute__((format(printf, 2, 0))) static void on_log(void *data, const char *format,
                                                         va_list arguments)
{
    char line[400];

    (void)data;
    vsnprintf(line, sizeof line, format, arguments);
    log_debug("http", "%s", line);
}

/* --- life --- */

struct http *http_create(const struct http_app *app, struct error *err)
{
    struct http *http = memory_alloc(1, sizeof *http);

    http->app = *app;
    pthread_mutex_init(&http->lock, NULL);
    answers_init(&http->answers);
    http->gone_epoll = epoll_create1(EPOLL_CLOEXEC);
    http->daemon = MHD_start_daemon(
        MHD_USE_NO_LISTEN_SOCKET | MHD_USE_INTERNAL_POLLING_THREAD | MHD_USE_EPOLL | MHD_USE_ITC |
            MHD_ALLOW_SUSPEND_RESUME | MHD_USE_ERROR_LOG,
        0, NULL, NULL, on_access, http, MHD_OPTION_EXTERNAL_LOGGER, on_log, NULL,
        MHD_OPTION_URI_LOG_CALLBACK, on_target, http, MHD_OPTION_NOTIFY_COMPLETED, on_completed,
        http, MHD_OPTION_NOTIFY_CONNECTION, on_connection, http, MHD_OPTION_CONNECTION_LIMIT,
        (unsigned)HTTP_CONNECTIONS + 64, MHD_OPTION_CONNECTION_TIMEOUT, (unsigned)HTTP_IDLE_SECONDS,
        MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_END);
    if (!http->daemon || http->gone_epoll < 0) {
        error_set(err, ERROR_INTERNAL, "http", "libmicrohttpd cannot be started");
        http_destroy(http);
        return NULL;
    }
    return http;
}

void http_adopt(struct http *http, int fd, const struct sockaddr *address, socklen_t length)
{
    atomic_fetch_add(&http->connections, 1);
    if (MHD_add_connection(http->daemon, fd, address, length) != MHD_YES) {
        atomic_fetch_sub(&http->connections, 1); /* it has closed the socket */
    }
}

int http_count(const struct http *http)
{
    return atomic_load(&((struct http *)http)->connections);
}

void http_drain(struct http *http, int wait_ms)
{
    const int64_t end = clock_ms() + wait_ms;

    while (atomic_load(&http->pending) > 0 && clock_ms() < end) {
        usleep(5000);
    }
}

void http_destroy(struct http *http)
{
    if (!http) {
        return;
    }
    if (http->daemon) {
        MHD_stop_daemon(http->daemon);
    }
    if (http->gone_epoll >= 0) {
        close(http->gone_epoll);
    }
    answers_finish(&http->answers);
    pthread_mutex_destroy(&http->lock);
    free(http);
}
