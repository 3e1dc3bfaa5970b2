/* SPDX-License-Identifier: MIT */
#include "serve.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "drain_limit.h"
#include "log.h"
#include "protocol/memory.h"
#include "renderer/slice.h"
#include "server/live/hub_life.h"
#include "server/live/hub_rooms.h"
#include "server/live/session_life.h"
#include "server/live/session_messages.h"
#include "server/net/acceptor.h"
#include "server/net/http.h"
#include "server/net/ws.h"
#include "server/rest/routes.h"

enum {
    WS_DRAIN_MS = 3000,
    HTTP_DRAIN_MS = 400,
    SILENCE_MS = 5000,
    BUSY_MS = 60000,
    WORKER_ARGUMENTS = 32,
};

struct server {
    const char *worker_argv[WORKER_ARGUMENTS]; /* used again at every restart */
    struct hub *hub;
    struct http *http;
    struct ws *ws;
    struct acceptor *acceptor;
};

/* --- between the acceptor and the two libraries --- */

/* "/v1/scenes/ID/live" with nothing else; the query is not looked at. */
static bool live_scene(const char *target, char out[LIMIT_ID_BYTES + 1])
{
    static const char before[] = "/v1/scenes/", after[] = "/live";
    const size_t length = strcspn(target, "?"), around = sizeof before + sizeof after - 2;

    if (length <= around || length > around + LIMIT_ID_BYTES ||
        strncmp(target, before, sizeof before - 1) != 0 ||
        strncmp(target + length - sizeof after + 1, after, sizeof after - 1) != 0) {
        return false;
    }
    snprintf(out, LIMIT_ID_BYTES + 1, "%.*s", (int)(length - around), target + sizeof before - 1);
    return hub_id_is_valid(out);
}

/* False: HTTP answers, and says why. */
static bool on_upgrade(void *data, int fd, const struct http_head *head)
{
    struct server *server = data;
    char scene[LIMIT_ID_BYTES + 1], skipped[LIMIT_HEAD_BYTES];
    struct access_request request = {
        .host = head->field[HEAD_HOST],
        .origin = head->field[HEAD_ORIGIN],
        .authorization = head->field[HEAD_AUTHORIZATION],
        .protocols = head->field[HEAD_WS_PROTOCOL],
    };

    if (!http_head_is_upgrade(head, WS_SUBPROTOCOL) || !live_scene(head->target, scene) ||
        access_check(&server->hub->access, &request, false, NULL) != 0 ||
        ws_count(server->ws) >= LIMIT_SESSIONS || atomic_load(&server->hub->draining) ||
        !hub_has_scene(server->hub, scene)) {
        return false;
    }
    if (recv(fd, skipped, head->length, MSG_DONTWAIT) != (ssize_t)head->length) {
        close(fd);
        return true;
    }
    ws_adopt(server->ws, fd, head, scene);
    return true;
}

static void on_http(void *data, int fd, const struct sockaddr *address, socklen_t length)
{
    http_adopt(((struct server *)data)->http, fd, address, length);
}

static int count_http(void *data)
{
    return http_count(((struct server *)data)->http);
}

static void check_gone(void *data)
{
    http_check_gone(((struct server *)data)->http);
}

/* --- start --- */

static void build_worker_argv(const struct serve_params *params, const char **argv)
{
    size_t count = 0;

    argv[count++] = "fieldcast";
    argv[count++] = "worker";
    argv[count++] = "--device";
    argv[count++] = device_kind_names[params->device];
    for (const char *const *more = params->worker_args;
         more && *more && count + 1 < WORKER_ARGUMENTS; more++) {
        argv[count++] = *more;
    }
    argv[count] = NULL;
}

static bool check_bind(const char *address, const char *token, struct error *err)
{
    return access_is_loopback(address) || token ||
           error_set(err, ERROR_FORBIDDEN, "--host",
                     "%s can be reached by others, and no token is set: anybody could read and "
                     "change every scene. Set one (--token-file FILE), or leave --host at "
                     "127.0.0.1",
                     address);
}

/* What the adapters to the two libraries know of who is behind them. */
static bool start_net(struct server *server, struct error *err)
{
    struct hub *hub = server->hub;
    const struct http_app http = {
        .routes = &routes,
        .access = &hub->access,
        .metrics = &hub->metrics,
        .tasks = hub->tasks,
        .draining = &hub->draining,
        .hub = hub,
        .lock = hub_lock,
        .unlock = hub_unlock,
        .scene_is_heavy = hub_scene_is_heavy,
    };
    const struct ws_app ws = {
        .hub = hub,
        .metrics = &hub->metrics,
        .lock = hub_lock,
        .unlock = hub_unlock,
        .open = session_create,
        .leave = session_leave,
        .receive = session_receive,
        .receive_apart = session_receive_apart,
        .is_done = session_is_done,
        .tell_rest = session_tell_rest,
        .said_hello = session_said_hello,
        .next = session_next,
        .close = session_close,
    };

    hub->ws = server->ws = ws_create(&ws, err);
    server->http = server->ws ? http_create(&http, err) : NULL;
    return server->http != NULL;
}

static bool start(struct server *server, const struct serve_params *params, const char *address,
                  struct error *err)
{
    struct hub_params hub = {
        .access = {.loopback = access_is_loopback(address),
                   .token = params->token,
                   .allowed_origins = params->allowed_origins,
                   .allowed_hosts = params->allowed_hosts},
        .data_dir = params->data_dir,
        .web_dir = params->web_dir,
        .worker_argv = server->worker_argv,
        .code_refused = params->code_refused,
        .worker_silence_ms = params->worker_silence_ms ? params->worker_silence_ms : SILENCE_MS,
        .worker_busy_ms = params->worker_busy_ms ? params->worker_busy_ms : BUSY_MS,
    };

    build_worker_argv(params, server->worker_argv);
    slice_short(); /* the threads of connections */
    if (!check_bind(address, params->token, err) || !(server->hub = hub_create(&hub, err)) ||
        !start_net(server, err)) {
        return false;
    }
    struct acceptor_events events = {
        .data = server,
        .upgrade = on_upgrade,
        .http = on_http,
        .http_count = count_http,
        .http_limit = HTTP_CONNECTIONS,
        .watch_fd = http_gone_fd(server->http),
        .watch = check_gone,
    };
    server->acceptor = acceptor_create(address, params->port, &events, &server->hub->metrics, err);
    return server->acceptor != NULL;
}

/* --- end --- */

static void drain(struct server *server)
{
    drain_limit();
    acceptor_stop(server->acceptor);
    hub_drain(server->hub);
    ws_drain(server->ws, WS_DRAIN_MS);
    http_drain(server->http, HTTP_DRAIN_MS);
}

static void stop(struct server *server)
{
    acceptor_destroy(server->acceptor);
    http_destroy(server->http);
    hub_stop(server->hub);
    ws_stop(server->ws);
    hub_destroy(server->hub);
    ws_destroy(server->ws);
}

static void block_signals(sigset_t *set)
{
    sigemptyset(set);
    sigaddset(set, SIGTERM);
    sigaddset(set, SIGINT);
    pthread_sigmask(SIG_BLOCK, set, NULL);
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN); /* a full quota is a failed commit */
}

/* posix_spawn puts sockets at WORKER_FD and WORKER_PULSE_FD; nothing of ours may be there. */
static void reserve_descriptors(void)
{
    int fd;

    do {
        fd = open("/dev/null", O_RDWR | O_CLOEXEC);
    } while (fd >= 0 && fd <= WORKER_PULSE_FD);
    if (fd > WORKER_PULSE_FD) {
        close(fd);
    }
}

static void announce(const char *address, int port)
{
    const bool v6 = strchr(address, ':') != NULL;

    printf("fieldcast: listening on http://%s%s%s:%d/\n", v6 ? "[" : "", address, v6 ? "]" : "",
           port);
    fflush(stdout);
}

int serve(const struct serve_params *params)
{
    const char *address = params->bind ? params->bind : "127.0.0.1";
    struct server server = {0};
    struct error err = {0};
    sigset_t signals;
    int signal_number = 0;

    if (params->log_level && !log_set_level(params->log_level)) {
        fprintf(stderr, "fieldcast: %s is no log level\n", params->log_level);
        return 1;
    }
    reserve_descriptors();
    block_signals(&signals);
    if (!start(&server, params, address, &err)) {
        fputs("fieldcast: ", stderr);
        error_print(&err, stderr);
        fputc('\n', stderr);
        stop(&server);
        return 1;
    }
    announce(address, acceptor_port(server.acceptor));
    sigwait(&signals, &signal_number);
    log_info("serve", "%s: draining", strsignal(signal_number));
    const bool failed = atomic_load(&server.hub->hopeless);
    drain(&server);
    stop(&server);
    log_info("serve", "ended");
    return failed ? 1 : 0;
}
