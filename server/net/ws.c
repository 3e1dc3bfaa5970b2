/* SPDX-License-Identifier: MIT */
/* Of libwebsockets 4.1.6 only what is safe is used: one protocol, no extensions, no HTTP/2, no
 * header of the client's (it gets a handshake of ours), and no lws_write() while an earlier one is
 * still under way. lws_cancel_service() is the one function that other threads may call. */
#include "ws.h"

#include <libwebsockets.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "protocol/memory.h"
#include "protocol/utf8.h"
#include "send_queue.h"
#include "server/clock.h"
#include "server/doorbell.h"
#include "server/log.h"
#include "server/metrics.h"
#include "workload.h"

enum {
    HELLO_SECONDS = 7, /* not the ping's time: both at once garble the close code */
    PING_SECONDS = 5,
    PIECES_PER_TURN = 16,
    CLOSE_SECONDS = 3,     /* for the other side to answer a close */
    APART_SECONDS = 2,     /* between signs that a connection which is not read lives */
    REST_TOLD_US = 250000, /* a shorter one is not worth a word */
    CLOSE_UNSUPPORTED = 1003,
    CLOSE_NOT_TEXT = 1007,
};

/* One connection. Made by ws_adopt, then the service thread's. */
struct link {
    struct ws *ws;
    struct link *next;
    int fd; /* until it is adopted */
    char handshake[512];
    char scene[LIMIT_ID_BYTES + 1];
    struct lws *wsi;
    struct session *session; /* between ESTABLISHED and CLOSED */
    atomic_bool dirty;
    int close_code; /* > 0: to be said next, whatever else waits */
    bool silent;    /* one side has said its close: nothing is written any more */
    char *text;     /* the message being collected */
    size_t length, capacity;
    struct utf8_stream utf8; /* of that message */
    struct workload workload;
    bool resting; /* nothing is read until the timer */
    bool apart;   /* nor until a task is done with a message */
};

struct ws {
    struct ws_app app;
    struct lws_context *context;
    struct lws_vhost *vhost;
    pthread_t thread;
    struct doorbell bell;
    bool running;
    atomic_bool stopping, draining, kicked;
    atomic_int count;
    pthread_mutex_t lock; /* guards `adopted`, and `context` from threads that ring */
    struct link *adopted;
    /* The service thread's. */
    struct link *links, *adopting;
    uint8_t scratch[LWS_PRE + FRAME_HEADER_BYTES + SEND_QUEUE_PART_BYTES];
};

static const lws_retry_bo_t idle_policy = {.secs_since_valid_ping = PING_SECONDS,
                                           .secs_since_valid_hangup = LIMIT_LIVE_SILENCE};

static void link_destroy(struct link *link)
{
    atomic_fetch_sub(&link->ws->count, 1);
    free(link->text);
    free(link);
}

/* Late, perhaps: whoever rings has let go of the hub's lock. */
static void ring(void *data)
{
    struct ws *ws = data;

    pthread_mutex_lock(&ws->lock);
    if (ws->context) {
        lws_cancel_service(ws->context);
    }
    pthread_mutex_unlock(&ws->lock);
}

/* Any thread, mostly under the hub's lock. */
static void kick(struct ws *ws)
{
    if (!atomic_exchange(&ws->kicked, true)) {
        doorbell_ring(&ws->bell);
    }
}

static void wake(void *connection)
{
    struct link *link = connection;

    atomic_store(&link->dirty, true);
    kick(link->ws);
}

/* --- adopting --- */

void ws_adopt(struct ws *ws, int fd, const struct http_head *head, const char *scene)
{
    struct link *link = memory_alloc(1, sizeof *link);

    link->ws = ws;
    link->fd = fd;
    snprintf(link->scene, sizeof link->scene, "%s", scene);
    snprintf(link->handshake, sizeof link->handshake,
             "GET / HTTP/1.1\r\nHost: x\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
             "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: %s\r\n"
             "Sec-WebSocket-Protocol: " WS_SUBPROTOCOL "\r\n\r\n",
             head->field[HEAD_WS_KEY]);
    atomic_fetch_add(&ws->count, 1);
    pthread_mutex_lock(&ws->lock);
    link->next = ws->adopted;
    ws->adopted = link;
    pthread_mutex_unlock(&ws->lock);
    kick(ws);
}

static void adopt_waiting(struct ws *ws)
{
    pthread_mutex_lock(&ws->lock);
    struct link *link = ws->adopted;
    ws->adopted = NULL;
    pthread_mutex_unlock(&ws->lock);
    while (link) {
        struct link *next = link->next;
        const int fd = link->fd;

        link->next = NULL;
        ws->adopting = link;
        if (!lws_adopt_socket_vhost_readbuf(ws->vhost, fd, link->handshake,
                                            strlen(link->handshake))) {
            log_debug("ws", "a connection ended during its handshake");
        }
        /* NULL is answered both for "never made" and for "made and gone": on_made tells. */
        if (ws->adopting) {
            link_destroy(ws->adopting);
            ws->adopting = NULL;
        }
        link = next;
    }
}

static void on_made(struct ws *ws, struct lws *wsi)
{
    struct link *link = ws->adopting;

    if (!link) {
        return;
    }
    ws->adopting = NULL;
    link->wsi = wsi;
    link->next = ws->links;
    ws->links = link;
    lws_set_opaque_user_data(wsi, link);
}

static void on_gone(struct ws *ws, struct link *link)
{
    struct link **place = &ws->links;

    while (*place && *place != link) {
        place = &(*place)->next;
    }
    if (*place) {
        *place = link->next;
        link_destroy(link);
    }
}

/* --- reading --- */

static void on_established(struct link *link)
{
    const struct ws_app *app = &link->ws->app;

    app->lock(app->hub);
    link->session = app->open(app->hub, wake, link);
    app->unlock(app->hub);
    lws_set_timer_usecs(link->wsi, (lws_usec_t)HELLO_SECONDS * LWS_USEC_PER_SEC);
}

static void on_closed(struct link *link)
{
    const struct ws_app *app = &link->ws->app;

    app->lock(app->hub);
    if (link->session) {
        app->leave(link->session);
    }
    link->session = NULL;
    app->unlock(app->hub);
}

static int close_with(struct link *link, int code)
{
    link->close_code = code;
    lws_callback_on_writable(link->wsi);
    return 0;
}

static void keep_bytes(struct link *link, const char *bytes, size_t length)
{
    if (length == 0) {
        return; /* an empty message may have no memory yet */
    }
    if (link->length + length > link->capacity) {
        link->capacity = (link->length + length) * 2;
        link->text = memory_resize(link->text, link->capacity, 1);
    }
    memcpy(link->text + link->length, bytes, length);
    link->length += length;
}

/* Who has worked much is not read for as long. */
static void rest(struct link *link, int64_t rest_us)
{
    const struct ws_app *app = &link->ws->app;

    link->resting = true;
    lws_rx_flow_control(link->wsi, 0);
    lws_set_timer_usecs(link->wsi, (lws_usec_t)rest_us);
    metric_add(app->metrics, METRIC_RESTS, 1);
    if (rest_us >= REST_TOLD_US) {
        app->lock(app->hub);
        app->tell_rest(link->session, (int)(rest_us / 1000));
        app->unlock(app->hub);
    }
}

static void charge(struct link *link, int64_t worked_us)
{
    const int64_t rest_us = workload_charge(&link->workload, clock_us(), worked_us);

    if (rest_us > 0) {
        rest(link, rest_us);
    }
}

/* Nothing more is read until a task is done with the message. */
static void give_away(struct link *link)
{
    link->apart = true;
    lws_rx_flow_control(link->wsi, 0);
    lws_set_timer_usecs(link->wsi, (lws_usec_t)APART_SECONDS * LWS_USEC_PER_SEC);
    link->ws->app.receive_apart(link->session, link->scene, link->text, link->length);
    link->text = NULL;
    link->capacity = 0;
}

static void take_back(struct link *link)
{
    const struct ws_app *app = &link->ws->app;
    int64_t worked_us = 0;

    app->lock(app->hub);
    const bool done = app->is_done(link->session, &worked_us);
    app->unlock(app->hub);
    if (done) {
        link->apart = false;
        lws_rx_flow_control(link->wsi, 1);
        charge(link, worked_us);
    }
}

static void hand_on(struct link *link)
{
    if (link->session) {
        const int64_t before = clock_thread_us();

        if (link->ws->app.receive(link->session, link->scene, link->text ? link->text : "",
                                  link->length)) {
            charge(link, clock_thread_us() - before);
        } else {
            give_away(link);
        }
    }
    link->length = 0;
    if (link->capacity > 65536) { /* one large message shall not cost for ever */
        free(link->text);
        link->text = NULL;
        link->capacity = 0;
    }
}

static int on_receive(struct link *link, const char *bytes, size_t length)
{
    struct lws *wsi = link->wsi;

    lws_validity_confirmed(wsi);
    if (link->close_code || link->silent) {
        return 0;
    }
    if (lws_frame_is_binary(wsi)) {
        return close_with(link, CLOSE_UNSUPPORTED);
    }
    if (link->length + length + lws_remaining_packet_payload(wsi) > LIMIT_MESSAGE_BYTES) {
        return close_with(link, CLOSE_TOO_BIG);
    }
    const bool more = lws_remaining_packet_payload(wsi) || !lws_is_final_fragment(wsi);
    if (!utf8_feed(&link->utf8, bytes, length) || (!more && link->utf8.left > 0)) {
        return close_with(link, CLOSE_NOT_TEXT);
    }
    keep_bytes(link, bytes, length);
    if (!more) {
        hand_on(link);
    }
    return 0;
}

static void on_timer(struct link *link)
{
    const struct ws_app *app = &link->ws->app;

    if (link->apart) {
        lws_validity_confirmed(link->wsi);
        lws_set_timer_usecs(link->wsi, (lws_usec_t)APART_SECONDS * LWS_USEC_PER_SEC);
        return;
    }
    if (link->resting) {
        link->resting = false;
        lws_rx_flow_control(link->wsi, 1);
    }
    app->lock(app->hub);
    if (link->session && !app->said_hello(link->session)) {
        app->close(link->session, CLOSE_POLICY, "protocol", -1);
    }
    app->unlock(app->hub);
}

/* --- writing --- */

static enum lws_write_protocol write_mode(const struct send_queue_piece *piece)
{
    const int mode = !piece->first                    ? LWS_WRITE_CONTINUATION
                     : piece->kind == SEND_QUEUE_TEXT ? LWS_WRITE_TEXT
                                                      : LWS_WRITE_BINARY;

    return (enum lws_write_protocol)(mode | (piece->last ? 0 : LWS_WRITE_NO_FIN));
}

/* The library would close the socket at once, and what is unread in it then makes a reset, after
 * which the other side may never read what it was told. So the close is written here, when nothing
 * of the library's is under way, and what the other side still says is dropped until it answers. */
static int write_close(struct link *link, int code)
{
    const uint8_t frame[] = {0x88, 2, (uint8_t)(code >> 8), (uint8_t)code}; /* RFC 6455, 5.5.1 */

    link->silent = true;
    lws_set_timeout(link->wsi, PENDING_TIMEOUT_USER_REASON_BASE, CLOSE_SECONDS);
    return send(lws_get_socket_fd(link->wsi), frame, sizeof frame, MSG_DONTWAIT | MSG_NOSIGNAL) ==
                   sizeof frame
               ? 0
               : -1;
}

/* The library answers the first close by itself; an answer ends the connection. */
static int on_peer_close(struct link *link)
{
    const bool answered = link->silent;

    link->silent = true;
    return answered ? -1 : 0;
}

/* 1: written, 0: nothing to write, -1: close. */
static int write_piece(struct link *link)
{
    struct ws *ws = link->ws;
    struct send_queue_piece piece;
    int code = 0;

    ws->app.lock(ws->app.hub);
    const bool more = ws->app.next(link->session, ws->scratch + LWS_PRE, &piece, &code);
    ws->app.unlock(ws->app.hub);
    if (!more) {
        return code ? write_close(link, code) : 0;
    }
    return lws_write(link->wsi, ws->scratch + LWS_PRE, piece.length, write_mode(&piece)) < 0 ? -1
                                                                                             : 1;
}

static int on_writeable(struct link *link)
{
    if (link->silent) {
        return 0;
    }
    if (link->close_code) {
        return write_close(link, link->close_code);
    }
    for (int i = 0; i < PIECES_PER_TURN && link->session; i++) {
        const int result = write_piece(link);

        if (result <= 0) {
            return result;
        }
        if (lws_send_pipe_choked(link->wsi)) {
            break;
        }
    }
    lws_callback_on_writable(link->wsi);
    return 0;
}

static void on_kicked(struct ws *ws)
{
    const bool draining = atomic_load(&ws->draining);

    atomic_store(&ws->kicked, false);
    adopt_waiting(ws);
    for (struct link *link = ws->links; link; link = link->next) {
        if (draining && link->session) {
            ws->app.lock(ws->app.hub);
            ws->app.close(link->session, CLOSE_GOING_AWAY, "shutting_down", 1000);
            ws->app.unlock(ws->app.hub);
        }
        if (atomic_exchange(&link->dirty, false) && link->session) {
            if (link->apart) {
                take_back(link);
            }
            lws_callback_on_writable(link->wsi);
        }
    }
}

static int callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in,
                    size_t length)
{
    struct ws *ws = lws_context_user(lws_get_context(wsi));
    struct link *link =
        reason == LWS_CALLBACK_EVENT_WAIT_CANCELLED ? NULL : lws_get_opaque_user_data(wsi);

    (void)user;
    switch (reason) {
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
        on_kicked(ws);
        return 0; /* anything else would close the wake-up pipe */
    case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED:
        on_made(ws, wsi);
        return 0;
    case LWS_CALLBACK_WSI_DESTROY:
        if (link) {
            lws_set_opaque_user_data(wsi, NULL);
            on_gone(ws, link);
        }
        return 0;
    default:
        break;
    }
    if (!link) {
        return 0;
    }
    switch (reason) {
    case LWS_CALLBACK_ESTABLISHED:
        on_established(link);
        return 0;
    case LWS_CALLBACK_CLOSED:
        on_closed(link);
        return 0;
    case LWS_CALLBACK_RECEIVE:
        return on_receive(link, in, length);
    case LWS_CALLBACK_SERVER_WRITEABLE:
        return on_writeable(link);
    case LWS_CALLBACK_WS_PEER_INITIATED_CLOSE:
        return on_peer_close(link);
    case LWS_CALLBACK_TIMER:
        on_timer(link);
        return 0;
    default:
        return 0;
    }
}

static const struct lws_protocols protocols[] = {
    {.name = WS_SUBPROTOCOL,
     .callback = callback,
     .rx_buffer_size = 4096,
     .tx_packet_size = 262144}, /* the default of 4096 costs a factor of five */
    {.name = NULL},
};

/* --- life --- */

static void *run(void *data)
{
    struct ws *ws = data;

    while (!atomic_load(&ws->stopping)) {
        if (lws_service(ws->context, 0) < 0) {
            log_error("ws", "the service loop failed");
            break;
        }
    }
    return NULL;
}

static void on_log(int level, const char *line)
{
    (void)level;
    if (!strstr(line, "calling service")) { /* every adoption says this as an error */
        log_debug("ws", "%s", line);
    }
}

struct ws *ws_create(const struct ws_app *app, struct error *err)
{
    struct ws *ws = memory_alloc(1, sizeof *ws);
    struct lws_context_creation_info info = {
        .port = CONTEXT_PORT_NO_LISTEN_SERVER,
        .vhost_name = "fieldcast",
        .protocols = protocols,
        .alpn = "http/1.1",
        .gid = (gid_t)-1,
        .uid = (uid_t)-1,
        .options = LWS_SERVER_OPTION_SKIP_SERVER_CANONICAL_NAME,
        .fd_limit_per_thread = LIMIT_SESSIONS + 64,
        .retry_and_idle_policy = &idle_policy,
        .user = ws,
    };

    ws->app = *app;
    ws->bell = (struct doorbell){ring, ws};
    pthread_mutex_init(&ws->lock, NULL);
    lws_set_log_level(LLL_ERR | LLL_WARN, on_log);
    ws->context = lws_create_context(&info);
    ws->vhost = ws->context ? lws_get_vhost_by_name(ws->context, "fieldcast") : NULL;
    if (!ws->vhost || pthread_create(&ws->thread, NULL, run, ws) != 0) {
        error_set(err, ERROR_INTERNAL, "ws", "libwebsockets cannot be started");
        ws_destroy(ws);
        return NULL;
    }
    ws->running = true;
    return ws;
}

int ws_count(const struct ws *ws)
{
    return atomic_load(&((struct ws *)ws)->count);
}

void ws_drain(struct ws *ws, int wait_ms)
{
    const int64_t end = clock_ms() + wait_ms;

    atomic_store(&ws->draining, true);
    do {
        atomic_store(&ws->kicked, true);
        lws_cancel_service(ws->context);
        usleep(10000);
    } while (ws_count(ws) > 0 && clock_ms() < end);
}

static struct lws_context *take_context(struct ws *ws)
{
    pthread_mutex_lock(&ws->lock);
    struct lws_context *context = ws->context;
    ws->context = NULL;
    pthread_mutex_unlock(&ws->lock);
    return context;
}

void ws_stop(struct ws *ws)
{
    if (!ws) {
        return;
    }
    atomic_store(&ws->stopping, true);
    if (ws->running) {
        lws_cancel_service(ws->context);
        pthread_join(ws->thread, NULL);
        ws->running = false;
    }
    struct lws_context *context = take_context(ws);
    if (context) {
        lws_context_destroy(context);
    }
}

void ws_destroy(struct ws *ws)
{
    if (!ws) {
        return;
    }
    ws_stop(ws);
    while (ws->adopted) {
        struct link *link = ws->adopted;

        ws->adopted = link->next;
        close(link->fd);
        link_destroy(link);
    }
    pthread_mutex_destroy(&ws->lock);
    free(ws);
}
