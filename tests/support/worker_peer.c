/* SPDX-License-Identifier: MIT */
#include "worker_peer.h"

#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "renderer/worker/worker.h"
#include "tests/support/json_text.h"
#include "tests/support/text_file.h"

struct worker_peer peer = {.fd = -1, .pulse_fd = -1};
static struct packet_reader peer_reader, pulse_reader;

int peer_start(void **state)
{
    int ends[2], pulse_ends[2];

    (void)state;
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pulse_ends), 0);
    peer.child = fork();
    assert_true(peer.child >= 0);
    if (peer.child == 0) {
        const int high = fcntl(pulse_ends[1], F_DUPFD, 10);

        dup2(ends[1], WORKER_FD);
        dup2(high, WORKER_PULSE_FD);
        close(high);
        execl("/proc/self/exe", "worker", "--worker", (char *)NULL);
        _exit(127);
    }
    close(ends[1]);
    close(pulse_ends[1]);
    peer.fd = ends[0];
    peer.pulse_fd = pulse_ends[0];
    return 0;
}

int peer_end(void)
{
    int status;

    close(peer.fd);
    close(peer.pulse_fd);
    assert_int_equal(waitpid(peer.child, &status, 0), peer.child);
    packet_finish(&peer.packet);
    packet_reader_finish(&peer_reader);
    packet_reader_finish(&pulse_reader);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

int peer_stop(void **state)
{
    (void)state;
    return peer_end() == 0 ? 0 : -1;
}

void peer_send_bytes(const void *bytes, size_t length)
{
    assert_int_equal(send(peer.fd, bytes, length, MSG_NOSIGNAL), length);
}

void peer_send_packet(int socket, const struct packet *sent)
{
    size_t length;
    uint8_t *bytes = packet_pack(PACKET_TO_WORKER, sent, &length);

    assert_int_equal(send(socket, bytes, length, MSG_NOSIGNAL), length);
    free(bytes);
}

void peer_send_text(enum packet_to_worker kind, const char *members)
{
    const uint32_t head[3] = {kind, (uint32_t)strlen(members), 0};

    peer_send_bytes(head, sizeof head);
    peer_send_bytes(members, head[1]);
}

int peer_receive(void)
{
    uint8_t bytes[65536];
    int got;

    packet_finish(&peer.packet);
    while ((got = packet_reader_next(&peer_reader, PACKET_TO_FRONT, &peer.packet)) == 0) {
        const ssize_t count = recv(peer.fd, bytes, sizeof bytes, 0);
        if (count <= 0) {
            return TO_FRONT_COUNT;
        }
        packet_reader_add(&peer_reader, bytes, (size_t)count);
    }
    assert_int_equal(got, 1);
    return peer.packet.kind;
}

void peer_expect(enum packet_to_front kind)
{
    int got;

    while ((got = peer_receive()) != (int)kind) {
        if (got == TO_FRONT_COUNT) {
            fail_msg("no packet %d came", (int)kind);
        }
    }
}

void peer_ping(int value)
{
    uint8_t bytes[4096];

    peer_send_packet(peer.pulse_fd, &(struct packet){.kind = TO_WORKER_PING, .ping = {value}});
    packet_finish(&peer.packet);
    while (packet_reader_next(&pulse_reader, PACKET_TO_FRONT, &peer.packet) == 0) {
        const ssize_t count = recv(peer.pulse_fd, bytes, sizeof bytes, 0);
        assert_true(count > 0);
        packet_reader_add(&pulse_reader, bytes, (size_t)count);
    }
    assert_int_equal(peer.packet.kind, TO_FRONT_PONG);
    assert_int_equal(peer.packet.pong.ping, value);
}

void peer_send_document(const char *name, uint64_t revision, const char *text)
{
    peer_send_packet(peer.fd, &(struct packet){.kind = TO_WORKER_SCENE,
                                               .scene = {.scene = name, .revision = revision},
                                               .payload = (uint8_t *)text,
                                               .payload_length = strlen(text)});
}

void peer_send_example(const char *name, uint64_t revision, const char *path)
{
    size_t length;
    char *document = text_file_read(path, &length);

    peer_send_document(name, revision, document);
    free(document);
}

void peer_send_scene(const char *name, uint64_t revision)
{
    peer_send_example(name, revision, PEER_EXAMPLE);
}

void peer_send_edit_of(const char *scene, uint64_t revision, const char *ops)
{
    cJSON *json = json_text_parse(ops, NULL);

    assert_non_null(json);
    peer_send_packet(peer.fd,
                     &(struct packet){.kind = TO_WORKER_EDIT, .edit = {scene, revision, json}});
    cJSON_Delete(json);
}

void peer_send_edit(uint64_t revision, const char *ops)
{
    peer_send_edit_of("s", revision, ops);
}

void peer_send_cancel(uint32_t job)
{
    peer_send_packet(peer.fd, &(struct packet){.kind = TO_WORKER_CANCEL, .job = {job}});
}

void peer_send_request(const char *scene, int job, int priority, const char *members)
{
    char line[768];

    snprintf(line, sizeof line,
             "{'render.job':%d,'render.scene':'%s','render.priority':%d,'render.patience':1,"
             "'render.request':{%s}}",
             job, scene, priority, members);
    json_text_quote(line);
    peer_send_text(TO_WORKER_RENDER, line);
}

void peer_send_render_of(const char *scene, int job, int priority, int width, int height,
                         const char *more)
{
    char members[512];

    snprintf(members, sizeof members, "'width':%d,'height':%d,'samples':1%s", width, height, more);
    peer_send_request(scene, job, priority, members);
}

void peer_send_render(int job, int priority, int width, int height, const char *more)
{
    peer_send_render_of("s", job, priority, width, height, more);
}

void peer_send_long_render(int job, int priority)
{
    peer_send_render(job, priority, 8000, 6000, "");
}

void peer_check_broken(const char *scene, uint64_t revision, enum error_kind kind)
{
    peer_expect(TO_FRONT_BROKEN);
    assert_string_equal(peer.packet.state.scene, scene);
    assert_int_equal(peer.packet.state.revision, revision);
    assert_int_equal(peer.packet.state.error.kind, kind);
}

bool peer_is_worker(int argc, char **argv)
{
    return argc > 1 && strcmp(argv[1], "--worker") == 0;
}

int peer_run_worker(void)
{
    return worker_run(WORKER_FD, &(struct worker_params){.renderer = {.device = {.index = -1}},
                                                         .pulse_fd = WORKER_PULSE_FD});
}
