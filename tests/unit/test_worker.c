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
#include "renderer/worker.h"
#include "tests/support/picture.h"
#include "tests/support/text_file.h"

#define EXAMPLE "protocol/examples/first-steps.json"

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

static void send_json(cJSON *json)
{
    size_t length;
    uint8_t *bytes = packet_pack(json, NULL, 0, &length);

    send_bytes(bytes, length);
    free(bytes);
    cJSON_Delete(json);
}

static void send_text(const char *text)
{
    cJSON *json = cJSON_Parse(text);

    assert_non_null(json);
    send_json(json);
}

/* The next packet; its type. */
static const char *receive(void)
{
    uint8_t bytes[65536];
    int got;

    packet_finish(&packet);
    while ((got = packet_reader_next(&reader, &packet)) == 0) {
        const ssize_t count = recv(fd, bytes, sizeof bytes, 0);
        if (count <= 0) {
            return "the end";
        }
        packet_reader_add(&reader, bytes, (size_t)count);
    }
    assert_int_equal(got, 1);
    return json_member_text(packet.json, "type", "");
}

/* Skips packets until one of this type; fails at the end of the stream. */
static void expect(const char *type)
{
    const char *got;

    while (strcmp(got = receive(), type) != 0) {
        if (strcmp(got, "the end") == 0) {
            fail_msg("no %s came", type);
        }
    }
}

/* Asks for the worker's pulse; the answer is the packet. */
static void ping(int value)
{
    char line[64];
    uint8_t bytes[4096];
    size_t length;

    snprintf(line, sizeof line, "{\"type\":\"ping\",\"ping\":%d}", value);
    cJSON *json = cJSON_Parse(line);
    uint8_t *packed = packet_pack(json, NULL, 0, &length);
    assert_int_equal(send(pulse_fd, packed, length, MSG_NOSIGNAL), length);
    free(packed);
    cJSON_Delete(json);
    packet_finish(&packet);
    while (packet_reader_next(&pulse_reader, &packet) == 0) {
        const ssize_t count = recv(pulse_fd, bytes, sizeof bytes, 0);
        assert_true(count > 0);
        packet_reader_add(&pulse_reader, bytes, (size_t)count);
    }
    assert_string_equal(json_member_text(packet.json, "type", ""), "pong");
    assert_int_equal(json_member_number(packet.json, "ping", -1), value);
}

static double number(const char *name)
{
    return json_member_number(packet.json, name, -1);
}

static const char *text(const char *name)
{
    return json_member_text(packet.json, name, "");
}

static void send_scene(const char *name, int revision)
{
    size_t length;
    char *document = text_file_read(EXAMPLE, &length);
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "type", "scene");
    cJSON_AddStringToObject(json, "scene", name);
    cJSON_AddNumberToObject(json, "revision", revision);
    cJSON_AddItemToObject(json, "document", cJSON_Parse(document));
    send_json(json);
    free(document);
}

static void send_render_of(const char *scene, int job, int priority, int width, int height,
                           const char *more)
{
    char line[512];

    snprintf(line, sizeof line,
             "{\"type\":\"render\",\"job\":%d,\"scene\":\"%s\",\"priority\":%d,\"width\":%d,"
             "\"height\":%d,\"samples\":1,\"format\":\"png\",\"fast\":true%s}",
             job, scene, priority, width, height, more);
    send_text(line);
}

static void send_render(int job, int priority, int width, int height, const char *more)
{
    send_render_of("s", job, priority, width, height, more);
}

/* --- tests --- */

static void test_ready(void **state)
{
    const cJSON *info;

    (void)state;
    expect("ready");
    info = cJSON_GetObjectItemCaseSensitive(packet.json, "renderer");
    assert_true(strlen(json_member_text(info, "name", "")) > 0);
    assert_true(strlen(json_member_text(info, "device", "")) > 0);
    assert_true(cJSON_IsBool(cJSON_GetObjectItemCaseSensitive(info, "software")));
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
    cJSON *json = cJSON_Parse(ops);
    struct image image;
    uint8_t *bytes;

    assert_true(resident_edit(resident, json, 2, NULL));
    assert_true(renderer_render(resident, &desc, &image, NULL));
    assert_true(image_encode(&image, &(struct encode_params){.format = IMAGE_PNG}, &bytes,
                             &bytes_length, NULL));
    assert_true(picture_read_memory(out, bytes, bytes_length));
    free(bytes);
    image_finish(&image);
    resident_destroy(resident);
    renderer_destroy(renderer);
    cJSON_Delete(json);
    free(document);
}

static void test_render_and_edit(void **state)
{
    static const char ops[] =
        "[{\"op\":\"set\",\"at\":\"/nodes/ball/params/radius\",\"value\":0.9}]";
    struct picture first, second, here;
    char line[256];

    (void)state;
    send_scene("s", 1);
    send_render(1, 0, 80, 60, ",\"exact\":true");
    expect("frame");
    assert_int_equal(number("job"), 1);
    assert_int_equal(number("revision"), 1);
    assert_true(json_member_bool(packet.json, "newest", false));
    assert_int_equal(number("width"), 80);
    assert_string_equal(text("mime"), "image/png");
    assert_true(number("march_us") > 0 && number("encode_us") > 0 && number("queue_us") >= 0);
    assert_true(picture_read_memory(&first, packet.payload, packet.payload_length));

    snprintf(line, sizeof line, "{\"type\":\"edit\",\"scene\":\"s\",\"revision\":2,\"ops\":%s}",
             ops);
    send_text(line);
    send_render(2, 0, 80, 60, "");
    expect("frame");
    assert_int_equal(number("revision"), 2);
    assert_true(picture_read_memory(&second, packet.payload, packet.payload_length));
    assert_false(picture_compare(&first, &second, NULL).greatest == 0);

    draw_here(ops, &here);
    assert_int_equal(picture_compare(&second, &here, NULL).greatest, 0);
    assert_true(picture_compare(&second, &here, NULL).same);
    picture_finish(&first);
    picture_finish(&second);
    picture_finish(&here);
}

static void test_structural_edit(void **state)
{
    (void)state;
    send_scene("s", 1);
    expect("shown");
    assert_int_equal(number("revision"), 1);
    send_text("{\"type\":\"edit\",\"scene\":\"s\",\"revision\":2,\"ops\":[{\"op\":\"insert\","
              "\"into\":\"/nodes/root\",\"before\":null,\"value\":{\"type\":\"torus\"}}]}");
    send_render(1, 0, 40, 30, "");
    send_render(2, 0, 40, 30, ",\"exact\":true");
    /* In whatever order they come: the compiler may be faster than the first picture. */
    for (bool shown = false, drawn = false; !shown || !drawn;) {
        const char *type = receive();

        assert_string_not_equal(type, "the end");
        if (strcmp(type, "shown") == 0) {
            assert_int_equal(number("revision"), 2);
            shown = true;
        } else if (strcmp(type, "frame") == 0 && number("job") == 2) {
            assert_int_equal(number("revision"), 2);
            drawn = true;
        } else if (strcmp(type, "frame") == 0) {
            assert_int_equal(json_member_bool(packet.json, "newest", true),
                             number("revision") == 2);
        }
    }
}

static void test_priority(void **state)
{
    (void)state;
    send_scene("s", 1);
    expect("shown");
    send_render(1, 3, 1600, 1200, "");
    send_render(2, 0, 40, 30, "");
    expect("frame");
    assert_int_equal(number("job"), 2);
    expect("frame");
    assert_int_equal(number("job"), 1);
}

/* A large picture of one scene, as urgent as can be, and small ones of another beside it. */
static void test_scenes_take_turns(void **state)
{
    enum { SMALL = 8, LARGE = 100 };

    (void)state;
    send_scene("s", 1);
    expect("shown");
    send_scene("t", 1);
    expect("shown");
    send_render(LARGE, 0, 8000, 6000, "");
    for (int job = 1; job <= SMALL; job++) {
        send_render_of("t", job, job % 4, 40, 30, "");
        expect("frame");
        assert_int_equal(number("job"), job);
    }
    send_text("{\"type\":\"cancel\",\"job\":100}");
}

static void test_cancel(void **state)
{
    (void)state;
    send_scene("s", 1);
    expect("shown");
    send_render(1, 0, 1600, 1200, "");
    send_render(2, 0, 1600, 1200, "");
    send_render(3, 1, 40, 30, "");
    send_text("{\"type\":\"cancel\",\"job\":1}");
    send_text("{\"type\":\"cancel\",\"job\":2}");
    send_text("{\"type\":\"cancel\",\"job\":77}");
    expect("frame");
    assert_int_equal(number("job"), 3);
    do {
        ping(9);
    } while (!json_member_bool(packet.json, "idle", false));
    assert_int_equal(number("pictures"), 1);
    assert_true(number("resident_bytes") > 0);
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
static void test_confined(void **state)
{
    static const char *const none[] = {"CapEff:", "CapPrm:", "CapInh:"};
    struct rlimit core;

    (void)state;
    expect("ready");
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        assert_int_equal(status_of(child, none[i]), 0);
    }
    assert_int_equal(status_of(child, "NoNewPrivs:"), 1);
    assert_int_equal(prlimit(child, RLIMIT_CORE, NULL, &core), 0);
    assert_int_equal(core.rlim_max, 0);
}

/* It tells how far the drawing thread has come, and when that has nothing to do. */
static void test_pulse(void **state)
{
    double steps;

    (void)state;
    send_scene("s", 1);
    expect("shown");
    do {
        ping(1);
    } while (!json_member_bool(packet.json, "idle", false));
    steps = number("steps");
    ping(2);
    assert_true(json_member_bool(packet.json, "idle", false));
    assert_true(number("steps") == steps);
    send_render(1, 3, 1600, 1200, "");
    do {
        ping(3);
    } while (number("tiles") == 0); /* in the middle of a picture */
    assert_false(json_member_bool(packet.json, "idle", true));
    assert_true(number("steps") > steps);
    assert_int_equal(number("pictures"), 0);
    expect("frame");
}

/* Nobody has to listen to it, and whoever talks nonsense there gets no answer. */
static void test_pulse_gone(void **state)
{
    static const uint8_t nonsense[8] = {255, 255, 255, 255, 255, 255, 255, 255};

    (void)state;
    expect("ready");
    assert_int_equal(send(pulse_fd, nonsense, sizeof nonsense, MSG_NOSIGNAL), sizeof nonsense);
    send_scene("s", 1);
    send_render(1, 0, 40, 30, "");
    expect("frame");
}

static void test_dropped_scene(void **state)
{
    (void)state;
    send_scene("s", 1);
    expect("shown");
    send_render(1, 0, 400, 300, "");
    send_text("{\"type\":\"drop\",\"scene\":\"s\"}");
    send_render(2, 0, 40, 30, "");
    expect("failed");
    assert_int_equal(number("job"), 2);
    assert_string_equal(text("code"), "not_found");
    expect("frame");
    assert_int_equal(number("job"), 1);
}

static void test_outputs(void **state)
{
    (void)state;
    send_scene("s", 1);
    send_render(1, 0, 40, 30, ",\"format\":\"npy\",\"aov\":\"id\"");
    send_text("{\"type\":\"render\",\"job\":2,\"scene\":\"s\",\"width\":40,\"height\":30,"
              "\"format\":\"npy\",\"aov\":\"id\"}");
    send_text("{\"type\":\"render\",\"job\":3,\"scene\":\"s\",\"width\":40,\"height\":30,"
              "\"format\":\"jpg\",\"quality\":50,\"chroma_halved\":true,"
              "\"camera\":{\"position\":[0,9,0.1],\"fov\":20}}");
    do {
        expect("frame");
        if (number("job") == 2) {
            assert_string_equal(text("mime"), "application/x-npy");
            assert_int_equal(packet.payload_length, 128 + 40 * 30 * 4);
        }
        if (number("job") == 3) {
            assert_string_equal(text("mime"), "image/jpeg");
            assert_memory_equal(packet.payload, "\xff\xd8\xff", 3);
        }
    } while (number("job") != 3);
}

/* What a render with these members comes back as. */
static void check_frame(const char *more, const char *mime, int width, int height)
{
    send_render(1, 0, 40, 30, more);
    expect("frame");
    assert_string_equal(text("mime"), mime);
    assert_int_equal(number("width"), width);
    assert_int_equal(number("height"), height);
}

static void test_what_is_asked(void **state)
{
    enum { COLOR_TYPE = 25, RGB = 2, RGB_ALPHA = 6 }; /* in the IHDR of a PNG */

    (void)state;
    send_scene("s", 1);
    check_frame(",\"aov\":\"color,depth\"", "application/zip", 40, 30);
    assert_memory_equal(packet.payload, "PK\3\4", 4);
    check_frame(",\"zipped\":true", "application/zip", 40, 30);
    check_frame(",\"region\":[30,7,10,2]", "image/png", 10, 2);
    check_frame(",\"level\":\"draft\",\"transparent\":true", "image/png", 40, 30);
    assert_int_equal(packet.payload[COLOR_TYPE], RGB_ALPHA);
    check_frame(",\"transparent\":false", "image/png", 40, 30);
    assert_int_equal(packet.payload[COLOR_TYPE], RGB);
    for (int i = 0; i < FRAME_STAGES; i++) {
        char name[STAGE_MEMBER_BYTES];

        stage_member((enum frame_stage)i, name);
        assert_true(number(name) >= 0);
    }
}

static void check_failed(const char *more, const char *code, const char *place)
{
    char line[512];

    snprintf(line, sizeof line,
             "{\"type\":\"render\",\"job\":5,\"width\":40,\"height\":30,\"scene\":\"s\"%s}", more);
    send_text(line);
    expect("failed");
    assert_int_equal(number("job"), 5);
    assert_string_equal(text("code"), code);
    assert_string_equal(text("place"), place);
    assert_true(strlen(text("message")) > 0);
}

static void test_refusals(void **state)
{
    (void)state;
    check_failed("", "not_found", "scene");
    send_scene("s", 1);
    expect("shown");
    check_failed(",\"aov\":\"smell\"", "invalid", "aov");
    check_failed(",\"format\":\"gif\"", "invalid", "format");
    check_failed(",\"aov\":\"position\"", "invalid", "aov");
    check_failed(",\"format\":\"jpg\",\"transparent\":true", "invalid", "format");
    check_failed(",\"level\":\"best\"", "invalid", "level");
    check_failed(",\"region\":[39,0,2,2]", "limit", "region");
    check_failed(",\"region\":[1,2]", "invalid", "region");
    check_failed(",\"samples\":9", "limit", "samples");
    check_failed(",\"samples\":-1", "limit", "samples");
    check_failed(",\"format\":\"jpg\",\"quality\":400", "limit", "quality");
    check_failed(",\"camera\":{\"fov\":500}", "invalid", "/camera/fov");
    send_text("{\"type\":\"render\",\"job\":5,\"scene\":\"s\",\"width\":1e300,\"height\":2}");
    expect("failed");
    send_text("{\"type\":\"dance\"}");
    expect("failed");
    assert_string_equal(text("code"), "invalid");
    send_text(
        "{\"type\":\"scene\",\"scene\":\"t\",\"revision\":4,\"document\":{\"format\":\"x\"}}");
    expect("broken");
    assert_string_equal(text("scene"), "t");
    assert_int_equal(number("revision"), 4);
    send_text("{\"type\":\"edit\",\"scene\":\"s\",\"revision\":2,\"ops\":[{\"op\":\"remove\","
              "\"at\":\"/nodes/nobody\"}]}");
    expect("broken");
    assert_string_equal(text("code"), "not_found");
    send_render(6, 0, 40, 30, "");
    expect("frame");
    assert_int_equal(number("revision"), 1);
}

static void test_stop(void **state)
{
    (void)state;
    assert_int_equal(start(NULL), 0);
    expect("ready");
    send_scene("s", 1);
    send_render(1, 0, 1600, 1200, "");
    send_text("{\"type\":\"stop\"}");
    while (strcmp(receive(), "the end") != 0) {
    }
    assert_int_equal(end(), 0);
}

/* The front is gone in the middle of a picture. */
static void test_front_gone(void **state)
{
    (void)state;
    assert_int_equal(start(NULL), 0);
    expect("ready");
    send_scene("s", 1);
    send_render(1, 0, 1600, 1200, "");
    assert_int_equal(end(), 0);
}

static void check_broken_stream(const void *bytes, size_t length)
{
    assert_int_equal(start(NULL), 0);
    expect("ready");
    send_bytes(bytes, length);
    expect("failed");
    assert_string_equal(text("code"), "syntax");
    assert_string_equal(receive(), "the end");
    assert_int_equal(end(), 1);
}

static void test_malformed_packets(void **state)
{
    static const uint32_t huge[2] = {UINT32_MAX, 0};
    static const char garbage[] = "\x05\0\0\0\0\0\0\0{\"a\":";
    static const char list[] = "\x02\0\0\0\0\0\0\0[]";

    (void)state;
    check_broken_stream(huge, sizeof huge);
    check_broken_stream(garbage, sizeof garbage - 1);
    check_broken_stream(list, sizeof list - 1);
}

/* Packets come whole out of any pieces. */
static void test_packets(void **state)
{
    static const char payload[] = "some bytes";
    struct packet_reader pieces = {0};
    struct packet out;
    cJSON *json = cJSON_Parse("{\"a\":1}");
    size_t length;
    uint8_t *bytes = packet_pack(json, payload, sizeof payload, &length);

    (void)state;
    for (int round = 0; round < 3; round++) {
        for (size_t i = 0; i < length; i++) {
            assert_int_equal(packet_reader_next(&pieces, &out), 0);
            packet_reader_add(&pieces, bytes + i, 1);
        }
        assert_int_equal(packet_reader_next(&pieces, &out), 1);
        assert_int_equal(json_member_number(out.json, "a", 0), 1);
        assert_int_equal(out.payload_length, sizeof payload);
        assert_memory_equal(out.payload, payload, sizeof payload);
        packet_finish(&out);
    }
    packet_reader_finish(&pieces);
    free(bytes);
    cJSON_Delete(json);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_packets),
        cmocka_unit_test_setup_teardown(test_ready, start, stop),
        cmocka_unit_test_setup_teardown(test_confined, start, stop),
        cmocka_unit_test_setup_teardown(test_render_and_edit, start, stop),
        cmocka_unit_test_setup_teardown(test_structural_edit, start, stop),
        cmocka_unit_test_setup_teardown(test_priority, start, stop),
        cmocka_unit_test_setup_teardown(test_scenes_take_turns, start, stop),
        cmocka_unit_test_setup_teardown(test_cancel, start, stop),
        cmocka_unit_test_setup_teardown(test_pulse, start, stop),
        cmocka_unit_test_setup_teardown(test_pulse_gone, start, stop),
        cmocka_unit_test_setup_teardown(test_dropped_scene, start, stop),
        cmocka_unit_test_setup_teardown(test_outputs, start, stop),
        cmocka_unit_test_setup_teardown(test_what_is_asked, start, stop),
        cmocka_unit_test_setup_teardown(test_refusals, start, stop),
        cmocka_unit_test(test_stop),
        cmocka_unit_test(test_front_gone),
        cmocka_unit_test(test_malformed_packets),
    };

    if (argc > 1 && strcmp(argv[1], "--worker") == 0) {
        return worker_run(WORKER_FD, &(struct worker_params){.renderer = {.device = {.index = -1}},
                                                             .pulse_fd = WORKER_PULSE_FD});
    }
    return cmocka_run_group_tests_name("worker", tests, NULL, NULL);
}
