/* SPDX-License-Identifier: MIT */
/* The front's end of a render process: what a test says to it and hears of it. The process is this
 * program again, with --worker. Whatever fails, fails the test. */
#ifndef TESTS_SUPPORT_WORKER_PEER_H
#define TESTS_SUPPORT_WORKER_PEER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#include "renderer/worker/worker_protocol.h"

#define PEER_EXAMPLE "protocol/examples/first-steps.json"

struct worker_peer {
    int fd, pulse_fd;
    pid_t child;
    struct packet packet; /* the last received */
};
extern struct worker_peer peer;

/* For main(): a program with tests of a worker is one, if it is told so. */
bool peer_is_worker(int argc, char **argv);
int peer_run_worker(void);

/* Set-up and tear-down of a test; the second fails where the worker did not end well. */
int peer_start(void **state);
int peer_stop(void **state);
/* Closes the connection; answers how the worker ended: its status, or 1000 and a signal. */
int peer_end(void);

void peer_send_bytes(const void *bytes, size_t length);
void peer_send_packet(int socket, const struct packet *sent);
/* A packet whose members may be anything. */
void peer_send_text(enum packet_to_worker kind, const char *members);
void peer_send_document(const char *name, uint64_t revision, const char *text);
void peer_send_example(const char *name, uint64_t revision, const char *path);
/* PEER_EXAMPLE. */
void peer_send_scene(const char *name, uint64_t revision);
void peer_send_edit_of(const char *scene, uint64_t revision, const char *ops);
/* Of the scene `s`, as all that follow. */
void peer_send_edit(uint64_t revision, const char *ops);
void peer_send_cancel(uint32_t job);
/* `members`: of the request. */
void peer_send_request(const char *scene, int job, int priority, const char *members);
void peer_send_render_of(const char *scene, int job, int priority, int width, int height,
                         const char *more);
void peer_send_render(int job, int priority, int width, int height, const char *more);
/* One that is not drawn before the test goes on, however busy the machine is. */
void peer_send_long_render(int job, int priority);

/* The next packet; its kind, TO_FRONT_COUNT at the end of the stream. */
int peer_receive(void);
/* Skips packets until one of this kind; fails at the end of the stream. */
void peer_expect(enum packet_to_front kind);
/* Asks for the worker's pulse; the answer is the packet. */
void peer_ping(int value);
/* The next refusal of a document or an edit is this one. */
void peer_check_broken(const char *scene, uint64_t revision, enum error_kind kind);

#endif
