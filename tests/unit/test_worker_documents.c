/* SPDX-License-Identifier: MIT */
/* Large documents in the render process: others are drawn while it reads and edits them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/json_text.h"
#include "tests/support/picture.h"
#include "tests/support/worker_peer.h"

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
    int kind = peer_receive();

    while (kind != TO_FRONT_FRAME && kind != TO_FRONT_FAILED && kind != TO_FRONT_BROKEN &&
           kind != TO_FRONT_COUNT) {
        kind = peer_receive();
    }
    assert_int_equal(kind, TO_FRONT_FRAME);
    assert_int_equal(peer.packet.frame.job, job);
    assert_int_equal(peer.packet.frame.revision, revision);
    assert_true(peer.packet.frame.newest);
}

/* How many scenes were shown until the next picture, which is this one. */
static int shown_before_frame(uint32_t job)
{
    int shown = 0;

    for (int kind; (kind = peer_receive()) != TO_FRONT_FRAME;) {
        assert_int_not_equal(kind, TO_FRONT_COUNT);
        shown += kind == TO_FRONT_SHOWN;
    }
    assert_int_equal(peer.packet.frame.job, job);
    return shown;
}

/* Others are drawn while large documents are read. */
static void large_documents(void **state)
{
    static const char *const large[] = {"a", "b", "c", "d"};

    enum { LARGE = sizeof large / sizeof large[0] };
    char *document = large_document(false);

    (void)state;
    peer_send_scene("t", 1);
    peer_expect(TO_FRONT_SHOWN);
    for (int i = 0; i < LARGE; i++) {
        peer_send_document(large[i], 1, document);
    }
    peer_send_render_of("t", 1, 0, 40, 30, "");
    assert_true(shown_before_frame(1) < LARGE);
    for (int i = 0; i < LARGE; i++) {
        peer_send_render_of(large[i], 2, 0, 40, 30, "");
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

    (void)state;
    peer_send_scene("t", 1);
    for (int i = 0; i < LARGE; i++) {
        peer_send_document(large[i], 1, document);
    }
    for (int i = 0; i < LARGE + 1; i++) {
        peer_expect(TO_FRONT_SHOWN);
    }
    for (int i = 0; i < LARGE; i++) {
        peer_send_edit_of(large[i], 2, INSERT);
    }
    peer_send_render_of("t", 1, 0, 40, 30, "");
    assert_true(shown_before_frame(1) < LARGE);
    free(document);
}

static void check_same(const struct picture *a, bool same)
{
    struct picture b;

    assert_true(picture_read_memory(&b, peer.packet.payload, peer.packet.payload_length));
    assert_int_equal(picture_compare(a, &b, NULL).greatest == 0, same);
    picture_finish(&b);
}

/* Edits that wait are applied together; the picture is that of one after the other. */
static void large_edits_in_order(void **state)
{
    char *document = large_document(false);
    struct picture before, after;

    (void)state;
    peer_send_document("s", 1, document);
    peer_send_edit(2, INSERT);
    peer_send_render(1, 0, 40, 30, "");
    expect_frame(1, 2);
    assert_true(picture_read_memory(&before, peer.packet.payload, peer.packet.payload_length));
    peer_send_edit(3, THICKEN);
    peer_send_render(2, 0, 40, 30, "");
    expect_frame(2, 3);
    assert_true(picture_read_memory(&after, peer.packet.payload, peer.packet.payload_length));
    check_same(&before, false);

    peer_send_document("s", 4, document);
    peer_send_edit(5, INSERT);
    peer_send_edit(6, THICKEN);
    peer_send_edit(7, "[{'op':'insert','into':'/nodes/g0','before':null,'value':{'id':'no','type':"
                      "'box','visible':false}}]");
    peer_send_render(3, 0, 40, 30, "");
    peer_send_edit(8,
                   "[{'op':'remove','at':'/nodes/no'},{'op':'set','at':'/nodes/ring/params/tube',"
                   "'value':null}]");
    peer_send_render(4, 0, 40, 30, "");
    expect_frame(3, 7);
    check_same(&after, true);
    expect_frame(4, 8);
    check_same(&before, true);
    peer_send_edit(9, "[{'op':'remove','at':'/nodes/nobody'}]");
    peer_check_broken("s", 9, ERROR_NOT_FOUND);
    picture_finish(&before);
    picture_finish(&after);
    free(document);
}

/* Whatever is said of a scene is done after its document was read, in the order of saying. */
static void packets_keep_their_order(void **state)
{
    char *document = large_document(false);

    (void)state;
    peer_send_document("s", 1, document);
    peer_send_edit(2, "[{'op':'set','at':'/nodes/ball/params/radius','value':0.9}]");
    peer_send_render(1, 0, 40, 30, "");
    expect_frame(1, 2);

    /* A small document of the scene waits for the large one too. */
    peer_send_document("s", 3, document);
    peer_send_scene("s", 4);
    peer_send_render(2, 0, 40, 30, "");
    expect_frame(2, 4);

    peer_send_document("s", 5, document);
    peer_send_render(3, 0, 40, 30, "");
    peer_send_cancel(3);
    peer_send_packet(peer.fd, &(struct packet){.kind = TO_WORKER_DROP, .state = {.scene = "s"}});
    peer_send_render(4, 0, 40, 30, "");
    peer_expect(TO_FRONT_FAILED);
    assert_int_equal(peer.packet.failed.job, 4);
    assert_int_equal(peer.packet.failed.error.kind, ERROR_NOT_FOUND);
    do {
        peer_ping(1);
    } while (!peer.packet.pong.idle);
    assert_int_equal(peer.packet.pong.counters.pictures, 2);
    free(document);
}

/* Of a colour, so that no two are the same. */
static void send_panorama(const char *id, uint8_t red)
{
    uint8_t bytes[128];
    const int head =
        snprintf((char *)bytes, sizeof bytes, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n");
    const uint8_t pixels[] = {red, 90, 90, 128, red, 90, 90, 128};

    memcpy(bytes + head, pixels, sizeof pixels);
    peer_send_packet(peer.fd, &(struct packet){.kind = TO_WORKER_ASSET,
                                               .asset = {id},
                                               .payload = bytes,
                                               .payload_length = (size_t)head + sizeof pixels});
}

/* One that names this file. Caller frees. */
static char *surrounded_document(const char *id)
{
    enum { HIDDEN = 400 }; /* so many nodes make it a large one */

    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    fprintf(out,
            "{'format':'fieldcast/1','environment':{'type':'image','image':'%s'},"
            "'root':{'id':'root','type':'union','children':[{'id':'ball','type':'sphere'}",
            id);
    for (int i = 0; i < HIDDEN; i++) {
        fprintf(out, ",{'id':'n%d','type':'sphere','visible':false}", i);
    }
    fprintf(out, "]}}");
    assert_int_equal(fclose(out), 0);
    json_text_quote(text);
    return text;
}

/* A file comes before the document that names it, and many come before the first one is read. */
static void files_wait_for_documents(void **state)
{
    enum { SCENES = 9 };

    char *large = large_document(false);

    (void)state;
    peer_send_document("large", 1, large);
    for (int i = 0; i < SCENES; i++) {
        char name[16], id[ASSET_ID_CHARACTERS + 1];

        snprintf(name, sizeof name, "s%d", i);
        snprintf(id, sizeof id, "%064x", i + 1);
        send_panorama(id, (uint8_t)(20 * i));
        char *text = surrounded_document(id);
        peer_send_document(name, 1, text);
        free(text);
    }
    for (int shown = 0; shown < SCENES + 1;) {
        const int kind = peer_receive();

        assert_int_not_equal(kind, TO_FRONT_WARNED);
        assert_int_not_equal(kind, TO_FRONT_BROKEN);
        assert_int_not_equal(kind, TO_FRONT_COUNT);
        shown += kind == TO_FRONT_SHOWN;
    }
    free(large);
}

/* The end comes while one is read, another waits, and packets wait for both. */
static void stop_while_reading(void **state)
{
    char *document = large_document(false);

    (void)state;
    peer_send_document("s", 1, document);
    peer_send_document("t", 1, document);
    peer_send_render_of("s", 1, 0, 40, 30, "");
    peer_send_render_of("t", 2, 0, 40, 30, "");
    peer_send_text(TO_WORKER_STOP, "{}");
    free(document);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(large_documents, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(large_edits, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(large_edits_in_order, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(packets_keep_their_order, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(files_wait_for_documents, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(stop_while_reading, peer_start, peer_stop),
    };

    if (peer_is_worker(argc, argv)) {
        return peer_run_worker();
    }
    return cmocka_run_group_tests_name("worker documents", tests, NULL, NULL);
}
