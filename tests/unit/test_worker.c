/* SPDX-License-Identifier: MIT */
/* The render process over its socket: pictures, edits, order, cancelling, refusals, its end. Each
 * test starts one by running this program again with --worker. */
#include <fcntl.h>
#include <poll.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "protocol/memory.h"
#include "protocol/messages.h"
#include "renderer/worker/worker.h"
#include "tests/support/json_text.h"
#include "tests/support/picture.h"
#include "tests/support/text_file.h"

#define EXAMPLE "protocol/examples/first-steps.json"
#define HEAVY_EXAMPLE "protocol/examples/snail.json"

static int fd = -1, pulse_fd = -1;
static pid_t child;
static struct packet_reader reader, pulse_reader;
static struct packet packet; /* the last received */

/* --- the other end --- */

static int start(void **state)
{
    int ends[2], pulse_ends[2];

    (void)state;
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pulse_ends), 0);
    child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        const int high = fcntl(pulse_ends[1], F_DUPFD, 10);

        dup2(ends[1], WORKER_FD);
        dup2(high, WORKER_PULSE_FD);
        close(high);
        execl("/proc/self/exe", "test_worker", "--worker", (char *)NULL);
        _exit(127);
    }
    close(ends[1]);
    close(pulse_ends[1]);
    fd = ends[0];
    pulse_fd = pulse_ends[0];
    return 0;
}

static int end(void)
{
    int status;

    close(fd);
    close(pulse_fd);
    assert_int_equal(waitpid(child, &status, 0), child);
    packet_finish(&packet);
    packet_reader_finish(&reader);
    packet_reader_finish(&pulse_reader);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

static int stop(void **state)
{
    (void)state;
    return end() == 0 ? 0 : -1;
}

static void send_bytes(const void *bytes, size_t length)
{
    assert_int_equal(send(fd, bytes, length, MSG_NOSIGNAL), length);
}

static void send_packet(int socket, const struct packet *sent)
{
    size_t length;
    uint8_t *bytes = packet_pack(PACKET_TO_WORKER, sent, &length);

    assert_int_equal(send(socket, bytes, length, MSG_NOSIGNAL), length);
    free(bytes);
}

/* A packet whose members may be anything. */
static void send_text(enum packet_to_worker kind, const char *members)
{
    const uint32_t head[3] = {kind, (uint32_t)strlen(members), 0};

    send_bytes(head, sizeof head);
    send_bytes(members, head[1]);
}

/* The next packet; its kind, TO_FRONT_COUNT at the end of the stream. */
static int receive(void)
{
    uint8_t bytes[65536];
    int got;

    packet_finish(&packet);
    while ((got = packet_reader_next(&reader, PACKET_TO_FRONT, &packet)) == 0) {
        const ssize_t count = recv(fd, bytes, sizeof bytes, 0);
        if (count <= 0) {
            return TO_FRONT_COUNT;
        }
        packet_reader_add(&reader, bytes, (size_t)count);
    }
    assert_int_equal(got, 1);
    return packet.kind;
}

/* Skips packets until one of this kind; fails at the end of the stream. */
static void expect(enum packet_to_front kind)
{
    int got;

    while ((got = receive()) != (int)kind) {
        if (got == TO_FRONT_COUNT) {
            fail_msg("no packet %d came", (int)kind);
        }
    }
}

/* Asks for the worker's pulse; the answer is the packet. */
static void ping(int value)
{
    uint8_t bytes[4096];

    send_packet(pulse_fd, &(struct packet){.kind = TO_WORKER_PING, .ping = {value}});
    packet_finish(&packet);
    while (packet_reader_next(&pulse_reader, PACKET_TO_FRONT, &packet) == 0) {
        const ssize_t count = recv(pulse_fd, bytes, sizeof bytes, 0);
        assert_true(count > 0);
        packet_reader_add(&pulse_reader, bytes, (size_t)count);
    }
    assert_int_equal(packet.kind, TO_FRONT_PONG);
    assert_int_equal(packet.pong.ping, value);
}

static void send_document(const char *name, uint64_t revision, const char *text)
{
    send_packet(fd, &(struct packet){.kind = TO_WORKER_SCENE,
                                     .scene = {.scene = name, .revision = revision},
                                     .payload = (uint8_t *)text,
                                     .payload_length = strlen(text)});
}

static void send_example(const char *name, uint64_t revision, const char *path)
{
    size_t length;
    char *document = text_file_read(path, &length);

    send_document(name, revision, document);
    free(document);
}

static void send_scene(const char *name, uint64_t revision)
{
    send_example(name, revision, EXAMPLE);
}

static void send_edit_of(const char *scene, uint64_t revision, const char *ops)
{
    cJSON *json = json_text_parse(ops, NULL);

    assert_non_null(json);
    send_packet(fd, &(struct packet){.kind = TO_WORKER_EDIT, .edit = {scene, revision, json}});
    cJSON_Delete(json);
}

static void send_edit(uint64_t revision, const char *ops)
{
    send_edit_of("s", revision, ops);
}

static void send_cancel(uint32_t job)
{
    send_packet(fd, &(struct packet){.kind = TO_WORKER_CANCEL, .job = {job}});
}

/* `members`: of the request. */
static void send_request(const char *scene, int job, int priority, const char *members)
{
    char line[768];

    snprintf(line, sizeof line,
             "{'render.job':%d,'render.scene':'%s','render.priority':%d,'render.patience':1,"
             "'render.request':{%s}}",
             job, scene, priority, members);
    json_text_quote(line);
    send_text(TO_WORKER_RENDER, line);
}

static void send_render_of(const char *scene, int job, int priority, int width, int height,
                           const char *more)
{
    char members[512];

    snprintf(members, sizeof members, "'width':%d,'height':%d,'samples':1%s", width, height, more);
    send_request(scene, job, priority, members);
}

static void send_render(int job, int priority, int width, int height, const char *more)
{
    send_render_of("s", job, priority, width, height, more);
}

/* One that is not drawn before the test goes on, however busy the machine is. */
static void send_long_render(int job, int priority)
{
    send_render(job, priority, 8000, 6000, "");
}

/* --- tests --- */

static void worker_says_what_it_draws_with(void **state)
{
    (void)state;
    expect(TO_FRONT_READY);
    assert_true(strlen(packet.ready.name) > 0);
    assert_true(strlen(packet.ready.device) > 0);
    assert_int_equal(packet.ready.stage, packet.ready.software ? RENDER_ENGINE : RENDER_COMPUTE);
}

/* The same document, drawn in this process. */
static void draw_here(const char *ops, struct picture *out)
{
    const struct renderer_params params = {.device = {.index = -1}};
    struct renderer *renderer = renderer_create(&params, NULL);
    const struct job_desc desc = {
        .width = 80, .height = 60, .level = -1, .samples = 1, .transparent = -1, .exact = true};
    size_t length, bytes_length;
    char *document = text_file_read(EXAMPLE, &length);
    struct scene *scene = scene_parse(document, length, NULL);
    struct resident *resident = resident_create(renderer, scene, 1);
    cJSON *json = json_text_parse(ops, NULL);
    struct image image;
    uint8_t *bytes;

    assert_true(resident_edit(resident, json, 2, NULL));
    assert_true(renderer_render(resident, &desc, &image, NULL));
    assert_true(image_encode(&image, &(struct encode_params){.format = CODEC_PNG}, &bytes,
                             &bytes_length, NULL));
    assert_true(picture_read_memory(out, bytes, bytes_length));
    free(bytes);
    image_finish(&image);
    resident_destroy(resident);
    renderer_destroy(renderer);
    cJSON_Delete(json);
    free(document);
}

static void render_and_edit(void **state)
{
    static const char ops[] = "[{'op':'set','at':'/nodes/ball/params/radius','value':0.9}]";
    struct picture first, second, here;

    (void)state;
    send_scene("s", 1);
    send_render(1, 0, 80, 60, ",'delivery':{'exact':true}");
    expect(TO_FRONT_FRAME);
    assert_int_equal(packet.frame.job, 1);
    assert_int_equal(packet.frame.revision, 1);
    assert_true(packet.frame.newest);
    assert_int_equal(packet.frame.width, 80);
    assert_int_equal(packet.frame.codec, CODEC_PNG);
    assert_true(packet.frame.times.us[FRAME_SHADE] > 0 && packet.frame.times.us[FRAME_ENCODE] > 0);
    assert_true(picture_read_memory(&first, packet.payload, packet.payload_length));

    send_edit(2, ops);
    send_render(2, 0, 80, 60, "");
    expect(TO_FRONT_FRAME);
    assert_int_equal(packet.frame.revision, 2);
    assert_true(picture_read_memory(&second, packet.payload, packet.payload_length));
    assert_false(picture_compare(&first, &second, NULL).greatest == 0);

    draw_here(ops, &here);
    assert_int_equal(picture_compare(&second, &here, NULL).greatest, 0);
    assert_true(picture_compare(&second, &here, NULL).same);
    picture_finish(&first);
    picture_finish(&second);
    picture_finish(&here);
}

static void structural_edit(void **state)
{
    (void)state;
    send_scene("s", 1);
    expect(TO_FRONT_SHOWN);
    assert_int_equal(packet.state.revision, 1);
    send_edit(2, "[{'op':'insert','into':'/nodes/root','before':null,'value':{'type':'torus'}}]");
    send_render(1, 0, 40, 30, "");
    send_render(2, 0, 40, 30, ",'delivery':{'exact':true}");
    /* In whatever order they come: the compiler may be faster than the first picture. */
    for (bool shown = false, drawn = false; !shown || !drawn;) {
        const int kind = receive();

        assert_int_not_equal(kind, TO_FRONT_COUNT);
        if (kind == TO_FRONT_SHOWN) {
            assert_int_equal(packet.state.revision, 2);
            shown = true;
        } else if (kind == TO_FRONT_FRAME && packet.frame.job == 2) {
            assert_int_equal(packet.frame.revision, 2);
            drawn = true;
        } else if (kind == TO_FRONT_FRAME) {
            assert_int_equal(packet.frame.newest, packet.frame.revision == 2);
        }
    }
}

static void priority_comes_first(void **state)
{
    (void)state;
    send_scene("s", 1);
    expect(TO_FRONT_SHOWN);
    send_long_render(1, 3);
    send_render(2, 0, 40, 30, "");
    expect(TO_FRONT_FRAME);
    assert_int_equal(packet.frame.job, 2);
    send_cancel(1);
}

/* A large picture of one scene, as urgent as can be, and small ones of another beside it. */
static void scenes_take_turns(void **state)
{
    enum { SMALL = 8, LARGE = 100 };

    (void)state;
    send_scene("s", 1);
    expect(TO_FRONT_SHOWN);
    send_scene("t", 1);
    expect(TO_FRONT_SHOWN);
    send_long_render(LARGE, 0);
    for (int job = 1; job <= SMALL; job++) {
        send_render_of("t", job, job % 4, 40, 30, "");
        expect(TO_FRONT_FRAME);
        assert_int_equal(packet.frame.job, job);
    }
    send_cancel(LARGE);
}

/* What takes no time is no turn: beginning, handing over rows, ending. The picture is as small as
 * the smallest tile, so that it has one, however slow the machine is. */
static void one_tile_takes_one_turn(void **state)
{
    enum { SMALL = 8, LARGE = 100 };

    (void)state;
    send_scene("s", 1);
    expect(TO_FRONT_SHOWN);
    send_scene("t", 1);
    expect(TO_FRONT_SHOWN);
    send_long_render(LARGE, 0);
    for (int job = 1; job <= SMALL; job++) {
        int turns = 0;

        send_render_of("t", job, 0, 8, 6, "");
        while (receive() != TO_FRONT_FRAME) {
            assert_int_not_equal(packet.kind, TO_FRONT_COUNT);
            turns += packet.kind == TO_FRONT_DRAWING && packet.suspect.job == (uint32_t)job;
        }
        assert_int_equal(packet.frame.job, job);
        assert_int_equal(turns, 1);
    }
    send_cancel(LARGE);
}

static void cancelled_requests_end(void **state)
{
    (void)state;
    send_scene("s", 1);
    expect(TO_FRONT_SHOWN);
    send_long_render(1, 0);
    send_long_render(2, 0);
    send_render(3, 1, 40, 30, "");
    send_cancel(1);
    send_cancel(2);
    send_cancel(77);
    expect(TO_FRONT_FRAME);
    assert_int_equal(packet.frame.job, 3);
    do {
        ping(9);
    } while (!packet.pong.idle);
    assert_int_equal(packet.pong.counters.pictures, 1);
    assert_true(packet.pong.resident_bytes > 0);
}

/* The number behind a word of its status, as hexadecimal digits. */
static unsigned long status_of(pid_t process, const char *word)
{
    char path[64], line[256];
    unsigned long value = ~0ul;

    snprintf(path, sizeof path, "/proc/%d/status", (int)process);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        if (strncmp(line, word, strlen(word)) == 0) {
            value = strtoul(line + strlen(word), NULL, 16);
        }
    }
    fclose(file);
    return value;
}

/* Also where the program was started with all privileges. */
static void worker_is_confined(void **state)
{
    static const char *const none[] = {"CapEff:", "CapPrm:", "CapInh:"};
    struct rlimit core;

    (void)state;
    expect(TO_FRONT_READY);
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        assert_int_equal(status_of(child, none[i]), 0);
    }
    assert_int_equal(status_of(child, "NoNewPrivs:"), 1);
    assert_int_equal(prlimit(child, RLIMIT_CORE, NULL, &core), 0);
    assert_int_equal(core.rlim_max, 0);
}

/* It tells how far the drawing thread has come, and when that has nothing to do. */
static void pulse_counts_steps(void **state)
{
    uint64_t steps;

    (void)state;
    send_scene("s", 1);
    expect(TO_FRONT_SHOWN);
    do {
        ping(1);
    } while (!packet.pong.idle);
    steps = packet.pong.steps;
    ping(2);
    assert_true(packet.pong.idle);
    assert_true(packet.pong.steps == steps);
    send_long_render(1, 3);
    do {
        ping(3);
    } while (packet.pong.counters.tiles == 0); /* in the middle of a picture */
    assert_false(packet.pong.idle);
    assert_true(packet.pong.steps > steps);
    assert_int_equal(packet.pong.counters.pictures, 0);
    send_cancel(1);
    send_render(2, 3, 40, 30, "");
    expect(TO_FRONT_FRAME);
    assert_int_equal(packet.frame.job, 2);
}

/* Nobody has to listen to it, and whoever talks nonsense there gets no answer. */
static void pulse_gone(void **state)
{
    static const uint32_t nonsense[3] = {UINT32_MAX, UINT32_MAX, UINT32_MAX};

    (void)state;
    expect(TO_FRONT_READY);
    assert_int_equal(send(pulse_fd, nonsense, sizeof nonsense, MSG_NOSIGNAL), sizeof nonsense);
    send_scene("s", 1);
    send_render(1, 0, 40, 30, "");
    expect(TO_FRONT_FRAME);
}

static void dropped_scene(void **state)
{
    (void)state;
    send_scene("s", 1);
    expect(TO_FRONT_SHOWN);
    send_render(1, 0, 400, 300, "");
    send_packet(fd, &(struct packet){.kind = TO_WORKER_DROP, .state = {.scene = "s"}});
    send_render(2, 0, 40, 30, "");
    expect(TO_FRONT_FAILED);
    assert_int_equal(packet.failed.job, 2);
    assert_int_equal(packet.failed.error.kind, ERROR_NOT_FOUND);
    expect(TO_FRONT_FRAME);
    assert_int_equal(packet.frame.job, 1);
}

/* A ball among hidden ones: reading it takes much longer than drawing it. Or among `seen` ones.
 * Caller frees. */
static char *large_document(bool seen)
{
    enum { GROUPS = 300, NODES = 100 };
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    fprintf(out, "{'format':'fieldcast/1','root':{'id':'root','type':'union',"
                 "'children':[{'id':'ball','type':'sphere'}");
    for (int i = 0; i < GROUPS; i++) {
        fprintf(out, ",{'id':'g%d','type':'group','children':[", i);
        for (int k = 0; k < NODES; k++) {
            fprintf(out, "%s{'id':'n%d-%d','type':'sphere','visible':%s}", k ? "," : "", i, k,
                    seen ? "true" : "false");
        }
        fprintf(out, "]}");
    }
    fprintf(out, "]}}");
    assert_int_equal(fclose(out), 0);
    json_text_quote(text);
    return text;
}

/* The next answer about a picture or a scene is this picture. */
static void expect_frame(uint32_t job, uint64_t revision)
{
    int kind = receive();

    while (kind != TO_FRONT_FRAME && kind != TO_FRONT_FAILED && kind != TO_FRONT_BROKEN &&
           kind != TO_FRONT_COUNT) {
        kind = receive();
    }
    assert_int_equal(kind, TO_FRONT_FRAME);
    assert_int_equal(packet.frame.job, job);
    assert_int_equal(packet.frame.revision, revision);
    assert_true(packet.frame.newest);
}

/* Others are drawn while large documents are read. */
static void large_documents(void **state)
{
    static const char *const large[] = {"a", "b", "c", "d"};

    enum { LARGE = sizeof large / sizeof large[0] };
    char *document = large_document(false);
    int shown = 0;

    (void)state;
    send_scene("t", 1);
    expect(TO_FRONT_SHOWN);
    for (int i = 0; i < LARGE; i++) {
        send_document(large[i], 1, document);
    }
    send_render_of("t", 1, 0, 40, 30, "");
    for (int kind; (kind = receive()) != TO_FRONT_FRAME;) {
        assert_int_not_equal(kind, TO_FRONT_COUNT);
        shown += kind == TO_FRONT_SHOWN;
    }
    assert_int_equal(packet.frame.job, 1);
    assert_true(shown < LARGE);
    for (int i = 0; i < LARGE; i++) {
        send_render_of(large[i], 2, 0, 40, 30, "");
        expect_frame(2, 1);
    }
    free(document);
}

#define INSERT                                                                                     \
    "[{'op':'insert','into':'/nodes/root','before':null,'value':{'id':'ring','type':'torus'}}]"
#define THICKEN "[{'op':'set','at':'/nodes/ring/params/tube','value':0.4}]"

/* The same while the fields of large scenes are compiled after edits of more than numbers. */
static void large_edits(void **state)
{
    static const char *const large[] = {"a", "b", "c", "d"};

    enum { LARGE = sizeof large / sizeof large[0] };
    char *document = large_document(true);
    int shown = 0;

    (void)state;
    send_scene("t", 1);
    for (int i = 0; i < LARGE; i++) {
        send_document(large[i], 1, document);
    }
    for (int i = 0; i < LARGE + 1; i++) {
        expect(TO_FRONT_SHOWN);
    }
    for (int i = 0; i < LARGE; i++) {
        send_edit_of(large[i], 2, INSERT);
    }
    send_render_of("t", 1, 0, 40, 30, "");
    for (int kind; (kind = receive()) != TO_FRONT_FRAME;) {
        assert_int_not_equal(kind, TO_FRONT_COUNT);
        shown += kind == TO_FRONT_SHOWN;
    }
    assert_int_equal(packet.frame.job, 1);
    assert_true(shown < LARGE);
    free(document);
}

static void check_broken(const char *scene, uint64_t revision, enum error_kind kind)
{
    expect(TO_FRONT_BROKEN);
    assert_string_equal(packet.state.scene, scene);
    assert_int_equal(packet.state.revision, revision);
    assert_int_equal(packet.state.error.kind, kind);
}

static void check_same(const struct picture *a, bool same)
{
    struct picture b;

    assert_true(picture_read_memory(&b, packet.payload, packet.payload_length));
    assert_int_equal(picture_compare(a, &b, NULL).greatest == 0, same);
    picture_finish(&b);
}

/* Edits that wait are applied together; the picture is that of one after the other. */
static void large_edits_in_order(void **state)
{
    char *document = large_document(false);
    struct picture before, after;

    (void)state;
    send_document("s", 1, document);
    send_edit(2, INSERT);
    send_render(1, 0, 40, 30, "");
    expect_frame(1, 2);
    assert_true(picture_read_memory(&before, packet.payload, packet.payload_length));
    send_edit(3, THICKEN);
    send_render(2, 0, 40, 30, "");
    expect_frame(2, 3);
    assert_true(picture_read_memory(&after, packet.payload, packet.payload_length));
    check_same(&before, false);

    send_document("s", 4, document);
    send_edit(5, INSERT);
    send_edit(6, THICKEN);
    send_edit(7, "[{'op':'insert','into':'/nodes/g0','before':null,'value':{'id':'no','type':"
                 "'box','visible':false}}]");
    send_render(3, 0, 40, 30, "");
    send_edit(8, "[{'op':'remove','at':'/nodes/no'},{'op':'set','at':'/nodes/ring/params/tube',"
                 "'value':null}]");
    send_render(4, 0, 40, 30, "");
    expect_frame(3, 7);
    check_same(&after, true);
    expect_frame(4, 8);
    check_same(&before, true);
    send_edit(9, "[{'op':'remove','at':'/nodes/nobody'}]");
    check_broken("s", 9, ERROR_NOT_FOUND);
    picture_finish(&before);
    picture_finish(&after);
    free(document);
}

/* Whatever is said of a scene is done after its document was read, in the order of saying. */
static void packets_keep_their_order(void **state)
{
    char *document = large_document(false);

    (void)state;
    send_document("s", 1, document);
    send_edit(2, "[{'op':'set','at':'/nodes/ball/params/radius','value':0.9}]");
    send_render(1, 0, 40, 30, "");
    expect_frame(1, 2);

    /* A small document of the scene waits for the large one too. */
    send_document("s", 3, document);
    send_scene("s", 4);
    send_render(2, 0, 40, 30, "");
    expect_frame(2, 4);

    send_document("s", 5, document);
    send_render(3, 0, 40, 30, "");
    send_cancel(3);
    send_packet(fd, &(struct packet){.kind = TO_WORKER_DROP, .state = {.scene = "s"}});
    send_render(4, 0, 40, 30, "");
    expect(TO_FRONT_FAILED);
    assert_int_equal(packet.failed.job, 4);
    assert_int_equal(packet.failed.error.kind, ERROR_NOT_FOUND);
    do {
        ping(1);
    } while (!packet.pong.idle);
    assert_int_equal(packet.pong.counters.pictures, 2);
    free(document);
}

/* The end comes while one is read, another waits, and packets wait for both. */
static void stop_while_reading(void **state)
{
    char *document = large_document(false);

    (void)state;
    send_document("s", 1, document);
    send_document("t", 1, document);
    send_render_of("s", 1, 0, 40, 30, "");
    send_render_of("t", 2, 0, 40, 30, "");
    send_text(TO_WORKER_STOP, "{}");
    free(document);
}

static void outputs_are_drawn(void **state)
{
    (void)state;
    send_scene("s", 1);
    send_render(1, 0, 40, 30, ",'format':'npy','aov':'id'");
    send_request("s", 2, 0, "'width':40,'height':30,'format':'npy','aov':'id'");
    send_request("s", 3, 0,
                 "'width':40,'height':30,'format':'jpg','quality':50,"
                 "'delivery':{'chroma_halved':true},'camera':{'position':[0,9,0.1],'fov':20}");
    do {
        expect(TO_FRONT_FRAME);
        if (packet.frame.job == 2) {
            assert_int_equal(packet.frame.codec, CODEC_NPY);
            assert_int_equal(packet.payload_length, 128 + 40 * 30 * 4);
        }
        if (packet.frame.job == 3) {
            assert_int_equal(packet.frame.codec, CODEC_JPEG);
            assert_memory_equal(packet.payload, "\xff\xd8\xff", 3);
        }
    } while (packet.frame.job != 3);
}

/* What a render with these members comes back as. */
static void check_frame(const char *more, enum codec codec, int width, int height)
{
    send_render(1, 0, 40, 30, more);
    expect(TO_FRONT_FRAME);
    assert_int_equal(packet.frame.codec, codec);
    assert_int_equal(packet.frame.width, width);
    assert_int_equal(packet.frame.height, height);
}

static void what_is_asked(void **state)
{
    enum { COLOR_TYPE = 25, RGB = 2, RGB_ALPHA = 6 }; /* in the IHDR of a PNG */

    (void)state;
    send_scene("s", 1);
    check_frame(",'aov':'color,depth'", CODEC_ZIP, 40, 30);
    assert_memory_equal(packet.payload, "PK\3\4", 4);
    check_frame(",'delivery':{'zipped':true}", CODEC_ZIP, 40, 30);
    check_frame(",'region':[30,7,10,2]", CODEC_PNG, 10, 2);
    check_frame(",'level':'draft','transparent':true", CODEC_PNG, 40, 30);
    assert_int_equal(packet.payload[COLOR_TYPE], RGB_ALPHA);
    check_frame(",'transparent':false", CODEC_PNG, 40, 30);
    assert_int_equal(packet.payload[COLOR_TYPE], RGB);
}

/* Of a stream that goes on from the picture of an order. */
static void check_streamed(int job, const char *stream, int base, bool key, const char *more)
{
    char members[256];

    snprintf(members, sizeof members, ",'quality':80,'delivery':{'stream':'%s','base':%d,%s}",
             stream, base, more);
    send_render(job, 0, 80, 60, members);
    expect(TO_FRONT_FRAME);
    assert_int_equal(packet.frame.job, job);
    assert_int_equal(packet.frame.key, key);
}

/* The front names the order whose picture its client has: it may be none of the last one. */
static void streams_go_on_from_what_the_client_has(void **state)
{
    (void)state;
    send_scene("s", 1);
    check_streamed(1, "a", 0, true, "'exact':true");
    check_streamed(2, "a", 1, false, "'exact':true");
    assert_int_equal(packet.payload_length, 2);
    check_streamed(3, "a", 2, false, "'whole':true");
    assert_int_equal(packet.payload_length, 2 + packet.frame.whole_bytes);
    assert_memory_equal(packet.payload + 3, "PNG", 3);
    check_streamed(4, "b", 3, true, "'exact':true");
    check_streamed(5, "a", 2, true, "'exact':true"); /* 3 got lost on its way */
    check_streamed(6, "a", 5, false, "'exact':true");
    check_streamed(7, "a", 0, true, "'exact':true"); /* none is wanted */
    check_streamed(8, "a", 7, false, "'exact':true");
    /* One that is given up is none that somebody could lack. */
    send_example("heavy", 1, HEAVY_EXAMPLE);
    send_request("heavy", 9, 0,
                 "'width':2000,'height':2000,'samples':4,'delivery':{'stream':'a','base':8}");
    do {
        expect(TO_FRONT_DRAWING);
    } while (packet.suspect.job != 9);
    send_cancel(9);
    do {
        ping(9);
    } while (!packet.pong.idle);
    check_streamed(10, "a", 8, false, "'exact':true");
    assert_true(packet.frame.whole_bytes == 0);
}

static void check_failed(const char *more, enum error_kind kind, const char *place)
{
    char members[512];

    snprintf(members, sizeof members, "'width':40,'height':30%s", more);
    send_request("s", 5, 0, members);
    expect(TO_FRONT_FAILED);
    assert_int_equal(packet.failed.job, 5);
    assert_int_equal(packet.failed.error.kind, kind);
    assert_string_equal(packet.failed.error.place, place);
    assert_true(strlen(packet.failed.error.message) > 0);
}

static void impossible_requests_are_refused(void **state)
{
    (void)state;
    check_failed("", ERROR_NOT_FOUND, "scene");
    send_scene("s", 1);
    expect(TO_FRONT_SHOWN);
    check_failed(",'aov':'smell'", ERROR_INVALID, "/aov");
    check_failed(",'format':'gif'", ERROR_INVALID, "/format");
    check_failed(",'aov':'position'", ERROR_INVALID, "aov");
    check_failed(",'format':'jpg','transparent':true", ERROR_INVALID, "format");
    check_failed(",'level':'best'", ERROR_INVALID, "/level");
    check_failed(",'region':[39,0,2,2]", ERROR_LIMIT, "region");
    check_failed(",'region':[1,2]", ERROR_INVALID, "/region");
    check_failed(",'samples':9", ERROR_INVALID, "/samples");
    check_failed(",'format':'jpg','quality':400", ERROR_INVALID, "/quality");
    check_failed(",'camera':{'fov':500}", ERROR_INVALID, "/camera/fov");
    check_failed(",'isolate':[7]", ERROR_INVALID, "/isolate/0");
    check_failed(",'delivery':{'by':'air'}", ERROR_INVALID, "/delivery/by");
    send_document("t", 4, "{}");
    check_broken("t", 4, ERROR_INVALID);
    send_document("t", 5, "{");
    check_broken("t", 5, ERROR_SYNTAX);
    send_edit(2, "[{'op':'remove','at':'/nodes/nobody'}]");
    check_broken("s", 2, ERROR_NOT_FOUND);
    send_render(6, 0, 40, 30, "");
    expect(TO_FRONT_FRAME);
    assert_int_equal(packet.frame.revision, 1);
}

static void stop_ends_a_render(void **state)
{
    (void)state;
    assert_int_equal(start(NULL), 0);
    expect(TO_FRONT_READY);
    send_scene("s", 1);
    send_long_render(1, 0);
    send_text(TO_WORKER_STOP, "{}");
    while (receive() != TO_FRONT_COUNT) {
    }
    assert_int_equal(end(), 0);
}

/* The front is gone in the middle of a picture. */
static void front_gone(void **state)
{
    (void)state;
    assert_int_equal(start(NULL), 0);
    expect(TO_FRONT_READY);
    send_scene("s", 1);
    send_long_render(1, 0);
    assert_int_equal(end(), 0);
}

static void check_broken_stream(const void *bytes, size_t length)
{
    assert_int_equal(start(NULL), 0);
    expect(TO_FRONT_READY);
    send_bytes(bytes, length);
    expect(TO_FRONT_FAILED);
    assert_int_equal(packet.failed.error.kind, ERROR_SYNTAX);
    assert_int_equal(receive(), TO_FRONT_COUNT);
    assert_int_equal(end(), 1);
}

static void malformed_packets(void **state)
{
    static const uint32_t huge[3] = {TO_WORKER_STOP, UINT32_MAX, 0};
    static const char garbage[] = "\x08\0\0\0\x05\0\0\0\0\0\0\0{\"a\":";
    static const char list[] = "\x08\0\0\0\x02\0\0\0\0\0\0\0[]";
    static const char unknown[] = "\x63\0\0\0\x02\0\0\0\0\0\0\0{}";
    static const char payload[] = "\x08\0\0\0\x02\0\0\0\1\0\0\0{}x"; /* that `stop` never has */

    (void)state;
    check_broken_stream(huge, sizeof huge);
    check_broken_stream(garbage, sizeof garbage - 1);
    check_broken_stream(list, sizeof list - 1);
    check_broken_stream(unknown, sizeof unknown - 1);
    check_broken_stream(payload, sizeof payload - 1);
}

/* Packets come whole out of any pieces. */
static void packets_come_whole_out_of_pieces(void **state)
{
    static uint8_t payload[] = "some bytes";
    const struct packet sent = {.kind = TO_WORKER_ASSET,
                                .asset = {"a file"},
                                .payload = payload,
                                .payload_length = sizeof payload};
    struct packet_reader pieces = {0};
    struct packet out;
    size_t length;
    uint8_t *bytes = packet_pack(PACKET_TO_WORKER, &sent, &length);

    (void)state;
    for (int round = 0; round < 3; round++) {
        for (size_t i = 0; i < length; i++) {
            assert_int_equal(packet_reader_next(&pieces, PACKET_TO_WORKER, &out), 0);
            packet_reader_add(&pieces, bytes + i, 1);
        }
        assert_int_equal(packet_reader_next(&pieces, PACKET_TO_WORKER, &out), 1);
        assert_int_equal(out.kind, TO_WORKER_ASSET);
        assert_string_equal(out.asset.asset, "a file");
        assert_int_equal(out.payload_length, sizeof payload);
        assert_memory_equal(out.payload, payload, sizeof payload);
        packet_finish(&out);
    }
    packet_reader_finish(&pieces);
    free(bytes);
}

/* What a packet says when it has been bytes. */
static struct packet there(enum packet_way way, const struct packet *sent)
{
    struct packet_reader whole = {0};
    struct packet out = {0};
    size_t length;
    uint8_t *bytes = packet_pack(way, sent, &length);

    packet_reader_add(&whole, bytes, length);
    assert_int_equal(packet_reader_next(&whole, way, &out), 1);
    assert_int_equal(out.kind, sent->kind);
    free(bytes);
    packet_reader_finish(&whole);
    return out;
}

static void members_to_worker(void **state)
{
    const struct packet_judge judge = {0xfedcba9876543210, "a", ERROR_CRASHED, 7, 8, 9};
    struct render_request request;
    struct packet got;

    (void)state;
    got = there(PACKET_TO_WORKER, &(struct packet){.kind = TO_WORKER_JUDGE, .judge = judge});
    assert_true(got.judge.structure_hash == judge.structure_hash);
    assert_string_equal(got.judge.asset, "a");
    assert_int_equal(got.judge.refused, ERROR_CRASHED);
    assert_int_equal(got.judge.measured_ms, 7);
    assert_int_equal(got.judge.limit_ms, 8);
    assert_int_equal(got.judge.times, 9);
    packet_finish(&got);
    render_request_init(&request);
    record_put(&request.camera, "fov", 20);
    assert_true(render_request_check(&request, REQUEST_JSON, NULL));
    got = there(PACKET_TO_WORKER, &(struct packet){.kind = TO_WORKER_RENDER,
                                                   .render = {.job = 7,
                                                              .scene = "s",
                                                              .account = "a",
                                                              .priority = 3,
                                                              .patience = 2,
                                                              .careful = true,
                                                              .request = &request}});
    assert_int_equal(got.render.job, 7);
    assert_string_equal(got.render.account, "a");
    assert_int_equal(got.render.priority, 3);
    assert_int_equal(got.render.patience, 2);
    assert_true(got.render.careful);
    assert_true(render_request_equal(got.render.request, &request));
    packet_finish(&got);
    render_request_finish(&request);
}

static void members_to_front(void **state)
{
    struct packet sent = {.kind = TO_FRONT_FRAME,
                          .frame = {.job = 7, .revision = 1e15, .more = true, .whole_bytes = 9}};
    struct packet got;

    (void)state;
    sent.frame.rounds = (struct picture_rounds){4, 16};
    sent.frame.codec = CODEC_ZIP;
    for (int i = 0; i < FRAME_STAGES; i++) {
        sent.frame.times.us[i] = (uint32_t)i + 1;
    }
    got = there(PACKET_TO_FRONT, &sent);
    assert_memory_equal(&got.frame, &sent.frame, sizeof got.frame);
    packet_finish(&got);
    sent = (struct packet){.kind = TO_FRONT_WARNED,
                           .state = {.scene = "s", .revision = 5, .warning = WARNING_ASSET}};
    error_set_at(&sent.state.error, ERROR_TOO_SLOW, "/here", 3, 4, "text");
    sent.state.error.measured_ms = 11;
    sent.state.error.limit_ms = 12;
    got = there(PACKET_TO_FRONT, &sent);
    assert_int_equal(got.state.warning, WARNING_ASSET);
    assert_memory_equal(&got.state.error, &sent.state.error, sizeof got.state.error);
    packet_finish(&got);
    sent = (struct packet){.kind = TO_FRONT_SLOW,
                           .suspect = {.scene = "s",
                                       .revision = 5,
                                       .structure_hash = 0xfedcba9876543210,
                                       .asset = "a",
                                       .still = true,
                                       .measured_ms = 1,
                                       .limit_ms = 2}};
    got = there(PACKET_TO_FRONT, &sent);
    assert_true(got.suspect.structure_hash == sent.suspect.structure_hash && got.suspect.still);
    assert_string_equal(got.suspect.asset, "a");
    assert_int_equal(got.suspect.limit_ms, 2);
    packet_finish(&got);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(packets_come_whole_out_of_pieces),
        cmocka_unit_test(members_to_worker),
        cmocka_unit_test(members_to_front),
        cmocka_unit_test_setup_teardown(worker_says_what_it_draws_with, start, stop),
        cmocka_unit_test_setup_teardown(worker_is_confined, start, stop),
        cmocka_unit_test_setup_teardown(render_and_edit, start, stop),
        cmocka_unit_test_setup_teardown(structural_edit, start, stop),
        cmocka_unit_test_setup_teardown(priority_comes_first, start, stop),
        cmocka_unit_test_setup_teardown(scenes_take_turns, start, stop),
        cmocka_unit_test_setup_teardown(one_tile_takes_one_turn, start, stop),
        cmocka_unit_test_setup_teardown(cancelled_requests_end, start, stop),
        cmocka_unit_test_setup_teardown(pulse_counts_steps, start, stop),
        cmocka_unit_test_setup_teardown(pulse_gone, start, stop),
        cmocka_unit_test_setup_teardown(dropped_scene, start, stop),
        cmocka_unit_test_setup_teardown(large_documents, start, stop),
        cmocka_unit_test_setup_teardown(large_edits, start, stop),
        cmocka_unit_test_setup_teardown(large_edits_in_order, start, stop),
        cmocka_unit_test_setup_teardown(packets_keep_their_order, start, stop),
        cmocka_unit_test_setup_teardown(stop_while_reading, start, stop),
        cmocka_unit_test_setup_teardown(outputs_are_drawn, start, stop),
        cmocka_unit_test_setup_teardown(what_is_asked, start, stop),
        cmocka_unit_test_setup_teardown(streams_go_on_from_what_the_client_has, start, stop),
        cmocka_unit_test_setup_teardown(impossible_requests_are_refused, start, stop),
        cmocka_unit_test(stop_ends_a_render),
        cmocka_unit_test(front_gone),
        cmocka_unit_test(malformed_packets),
    };

    if (argc > 1 && strcmp(argv[1], "--worker") == 0) {
        return worker_run(WORKER_FD, &(struct worker_params){.renderer = {.device = {.index = -1}},
                                                             .pulse_fd = WORKER_PULSE_FD});
    }
    return cmocka_run_group_tests_name("worker", tests, NULL, NULL);
}
