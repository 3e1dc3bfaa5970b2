/* SPDX-License-Identifier: MIT */
/* Request heads, access, and what waits to be written. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "protocol/limits.h"
#include "protocol/memory.h"
#include "server/net/access.h"
#include "server/net/http_head.h"
#include "server/net/presence.h"
#include "server/net/send_queue.h"

/* --- heads --- */

static int status_of(const char *text)
{
    struct http_head *head = memory_alloc(1, sizeof *head);
    struct http_head_fault fault = {0};
    const int status = http_head_read(text, strlen(text), head, &fault) ? 200 : fault.status;

    free(head);
    return status;
}

static void finds_the_end(void **state)
{
    const char text[] = "GET / HTTP/1.1\r\nHost: x\r\n\r\nbody";
    const long end = (long)strlen(text) - 4;

    (void)state;
    for (size_t seen = 0; seen <= (size_t)end - 1; seen++) {
        assert_int_equal(http_head_end(text, seen, 0), 0);
        assert_int_equal(http_head_end(text, sizeof text - 1, seen), end);
    }
    assert_int_equal(http_head_end("GET /\n", 6, 0), -1);
    assert_int_equal(http_head_end("GET /\r", 6, 0), 0);
    assert_int_equal(http_head_end("GET /\rx", 7, 6), -1);
    assert_int_equal(http_head_end("G\0T", 3, 0), -1);
}

static void refuses_what_two_could_read_differently(void **state)
{
    (void)state;
    assert_int_equal(status_of("GET / HTTP/1.1\r\nHost: x\r\n\r\n"), 200);
    assert_int_equal(status_of("GET / HTTP/1.1\r\nHost: x\r\nHost: x\r\n\r\n"), 400);
    assert_int_equal(status_of("GET / HTTP/1.1\r\nHost : x\r\n\r\n"), 400);
    assert_int_equal(status_of("GET / HTTP/1.1\r\nHost: x\r\n y\r\n\r\n"), 400);
    assert_int_equal(
        status_of("GET / HTTP/1.1\r\nHost: x\r\nContent-Length: 1\r\nTransfer-Encoding: "
                  "chunked\r\n\r\n"),
        400);
    assert_int_equal(status_of("GET / HTTP/3.0\r\nHost: x\r\n\r\n"), 505);
}

/* Values of one list header are joined; so many that they would not fit are refused. */
static void joins_lists_within_bounds(void **state)
{
    struct http_head *head = memory_alloc(1, sizeof *head);
    struct http_head_fault fault = {0};
    char text[LIMIT_HEAD_BYTES];
    size_t used = (size_t)sprintf(text, "GET / HTTP/1.1\r\nHost: x\r\nConnection: a\r\n"
                                        "Connection: Upgrade\r\n\r\n");

    (void)state;
    assert_true(http_head_read(text, used, head, &fault));
    assert_string_equal(head->field[HEAD_CONNECTION], "a, Upgrade");
    assert_true(http_head_list_has(head->field[HEAD_CONNECTION], "upgrade"));
    assert_false(http_head_list_has(head->field[HEAD_CONNECTION], "up"));
    used -= 2;
    while (used + 40 < sizeof text) {
        used += (size_t)sprintf(text + used, "Upgrade: websocket\r\n");
    }
    used += (size_t)sprintf(text + used, "\r\n");
    assert_false(http_head_read(text, used, head, &fault));
    assert_int_equal(fault.status, 431);
    free(head);
}

/* --- access --- */

static int verdict(const struct access *access, const char *host, const char *origin,
                   const char *authorization, const char *protocols)
{
    struct access_request request = {
        .host = host, .origin = origin, .authorization = authorization, .protocols = protocols};

    return access_check(access, &request, false, NULL);
}

static void keeps_strangers_out(void **state)
{
    const char *const friends[] = {"https://friend.example", NULL};
    struct access open = {.loopback = true, .allowed_origins = friends};
    struct access guarded = {.token = "secret", .allowed_origins = friends};

    (void)state;
    assert_int_equal(verdict(&open, "localhost:80", NULL, NULL, NULL), 0);
    assert_int_equal(verdict(&open, "127.0.0.2", NULL, NULL, NULL), 0);
    assert_int_equal(verdict(&open, "127.evil.example", NULL, NULL, NULL), 403);
    assert_int_equal(verdict(&open, "evil.example", NULL, NULL, NULL), 403);
    assert_int_equal(verdict(&open, "[::1]", NULL, NULL, NULL), 0);
    assert_int_equal(verdict(&open, "[::1]:80", NULL, NULL, NULL), 0);
    assert_int_equal(verdict(&open, "[::1].evil.example", NULL, NULL, NULL), 403);
    assert_int_equal(verdict(&open, "[::1", NULL, NULL, NULL), 403);
    assert_int_equal(verdict(&open, "localhost:80.evil.example", NULL, NULL, NULL), 403);
    assert_int_equal(verdict(&open, "localhost", "http://localhost", NULL, NULL), 0);
    assert_int_equal(verdict(&open, "localhost", "http://localhost:1", NULL, NULL), 403);
    assert_int_equal(verdict(&open, "localhost", "https://friend.example", NULL, NULL), 0);
    assert_int_equal(verdict(&open, "localhost", "null", NULL, NULL), 403);
    assert_int_equal(verdict(&guarded, "any", NULL, NULL, NULL), 401);
    assert_int_equal(verdict(&guarded, "any", NULL, "Bearer secret", NULL), 0);
    assert_int_equal(verdict(&guarded, "any", NULL, "Bearer secretsecret", NULL), 401);
    assert_int_equal(verdict(&guarded, "any", NULL, "Bearer ", NULL), 401);
    assert_int_equal(verdict(&guarded, "any", NULL, NULL, "v1, fieldcast.token.secret"), 0);
    assert_int_equal(verdict(&guarded, "any", NULL, NULL, "fieldcast.token.sec"), 401);
    assert_int_equal(verdict(&guarded, "any", "https://evil.example", "Bearer secret", NULL), 403);
}

/* --- send queue --- */

static struct shared_buffer *letters(char letter, size_t length)
{
    char *bytes = memory_alloc(length, 1);
    struct shared_buffer *buffer;

    memset(bytes, letter, length);
    buffer = shared_buffer_create(bytes, length);
    free(bytes);
    return buffer;
}

static void add_text(struct send_queue *queue, char letter, size_t length, bool fits)
{
    struct shared_buffer *buffer = letters(letter, length);

    assert_int_equal(send_queue_text(queue, buffer), fits);
    shared_buffer_unref(buffer);
}

static uint32_t add_frame(struct send_queue *queue, uint32_t number, uint8_t flags, size_t length)
{
    struct shared_buffer *buffer = letters('f', length);
    struct frame_header header = {
        .number = number, .flags = flags, .payload_bytes = (uint32_t)length};
    const uint32_t given_up = send_queue_frame(queue, &header, buffer);

    shared_buffer_unref(buffer);
    return given_up;
}

static uint8_t scratch[FRAME_HEADER_BYTES + SEND_QUEUE_PART_BYTES];

static void texts_go_between_the_parts_of_a_frame(void **state)
{
    struct send_queue queue;
    struct send_queue_piece piece;

    (void)state;
    send_queue_init(&queue);
    add_frame(&queue, 1, FRAME_KEY, 2 * SEND_QUEUE_PART_BYTES + 10);
    assert_true(send_queue_next(&queue, scratch, &piece));
    assert_memory_equal(scratch, "FCF1", 4);
    assert_int_equal(piece.frame_done, 0);
    add_text(&queue, 't', SEND_QUEUE_PART_BYTES + 1, true);
    assert_true(send_queue_next(&queue, scratch, &piece));
    assert_true(piece.kind == SEND_QUEUE_TEXT && piece.first && !piece.last);
    assert_true(send_queue_next(&queue, scratch, &piece));
    assert_true(piece.kind == SEND_QUEUE_TEXT && !piece.first && piece.last && piece.length == 1);
    assert_true(send_queue_next(&queue, scratch, &piece));
    assert_memory_equal(scratch, "FCFP", 4);
    assert_true(send_queue_next(&queue, scratch, &piece));
    assert_int_equal(piece.frame_done, 1);
    assert_int_equal(piece.length, FRAME_PART_HEADER_BYTES + 10);
    assert_true(send_queue_is_empty(&queue));
    send_queue_finish(&queue);
}

static void the_newest_frame_wins(void **state)
{
    struct send_queue queue;
    struct send_queue_piece piece;

    (void)state;
    send_queue_init(&queue);
    assert_int_equal(add_frame(&queue, 1, FRAME_KEY, 10), 0);
    assert_int_equal(add_frame(&queue, 2, FRAME_KEY, 2 * SEND_QUEUE_PART_BYTES), 1);
    assert_true(send_queue_next(&queue, scratch, &piece));
    /* A moving one that is begun is finished, and only the one behind it can be replaced. */
    assert_int_equal(add_frame(&queue, 3, FRAME_KEY, 10), 0);
    assert_int_equal(add_frame(&queue, 4, FRAME_KEY, 10), 3);
    assert_true(send_queue_next(&queue, scratch, &piece));
    assert_int_equal(piece.frame_done, 2);
    assert_true(send_queue_next(&queue, scratch, &piece));
    assert_int_equal(piece.frame_done, 4);
    /* A still one is given up even when it is begun. */
    add_frame(&queue, 5, FRAME_KEY | FRAME_STILL, 3 * SEND_QUEUE_PART_BYTES);
    assert_true(send_queue_next(&queue, scratch, &piece));
    assert_int_equal(add_frame(&queue, 6, FRAME_KEY, 10), 5);
    assert_true(send_queue_next(&queue, scratch, &piece));
    assert_int_equal(piece.frame_done, 6);
    assert_true(send_queue_is_empty(&queue));
    send_queue_finish(&queue);
}

static void what_waits_is_bounded(void **state)
{
    struct send_queue queue;

    (void)state;
    send_queue_init(&queue);
    add_text(&queue, 'd', 10 * SEND_QUEUE_TEXT_BYTES, true); /* a first message may be large */
    add_text(&queue, 'c', SEND_QUEUE_TEXT_BYTES, true);
    add_text(&queue, 'c', 1, true);
    add_text(&queue, 'c', 1, false);
    send_queue_finish(&queue);
}

static void an_answer_to_hello_does_not_count(void **state)
{
    struct shared_buffer *document = letters('d', 2 * SEND_QUEUE_TEXT_BYTES);
    struct send_queue queue;
    struct send_queue_piece piece;

    (void)state;
    send_queue_init(&queue);
    add_text(&queue, 'n', 1, true);
    send_queue_greeting(&queue, document);
    send_queue_greeting(&queue, document);
    add_text(&queue, 'c', SEND_QUEUE_TEXT_BYTES + 1, true);
    add_text(&queue, 'c', 1, false);
    while (!send_queue_is_empty(&queue)) {
        assert_true(send_queue_next(&queue, scratch, &piece));
    }
    assert_int_equal(queue.text_bytes, 0);
    send_queue_finish(&queue);
    shared_buffer_unref(document);
}

/* --- presence --- */

static unsigned silence_of(int fd)
{
    unsigned ms = 0;
    socklen_t length = sizeof ms;

    assert_int_equal(getsockopt(fd, IPPROTO_TCP, TCP_USER_TIMEOUT, &ms, &length), 0);
    return ms;
}

/* A dead line with data that was not acknowledged is found as soon as one without. An answer may be
 * read as slowly as its client likes. */
static void waits_for_acknowledgement_only_before_the_answer(void **state)
{
    const struct presence presence = {.fd = socket(AF_INET, SOCK_STREAM, 0)};
    const int epoll = epoll_create1(0);

    (void)state;
    assert_int_equal(silence_of(presence.fd), 0);
    assert_true(presence_watch(epoll, &presence, NULL));
    assert_int_equal(silence_of(presence.fd), 1000 * LIMIT_LIVE_SILENCE);
    presence_unwatch(epoll, &presence);
    assert_int_equal(silence_of(presence.fd), 0);
    close(epoll);
    close(presence.fd);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_the_end),
        cmocka_unit_test(refuses_what_two_could_read_differently),
        cmocka_unit_test(joins_lists_within_bounds),
        cmocka_unit_test(keeps_strangers_out),
        cmocka_unit_test(texts_go_between_the_parts_of_a_frame),
        cmocka_unit_test(the_newest_frame_wins),
        cmocka_unit_test(what_waits_is_bounded),
        cmocka_unit_test(an_answer_to_hello_does_not_count),
        cmocka_unit_test(waits_for_acknowledgement_only_before_the_answer),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
