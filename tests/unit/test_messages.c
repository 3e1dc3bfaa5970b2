/* SPDX-License-Identifier: MIT */
/* Client messages are checked by their table; frame headers have the bytes of the README. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/limits.h"
#include "protocol/messages.h"
#include "tests/support/json_text.h"

static bool accepted[MESSAGE_COUNT];

static bool read_text(const char *text, struct message *out, struct error *err)
{
    char *json = json_text(text);
    const bool ok = message_read(json, strlen(json), out, err);

    free(json);
    return ok;
}

static struct message read_valid(const char *text)
{
    struct error err = {0};
    struct message message;

    if (!read_text(text, &message, &err)) {
        fail_msg("%s: %s: %s", text, err.place, err.message);
    }
    return message;
}

static void assert_accepted(const char *text, enum message_kind kind)
{
    struct message message = read_valid(text);

    assert_int_equal(message.kind, kind);
    accepted[kind] = true;
    assert_string_equal(json_member_text(message.json, "type", ""), message_name(kind));
    message_finish(&message);
    message_finish(&message); /* twice is fine */
}

static void assert_refused(const char *text, enum error_kind kind, const char *place,
                           const char *fragment)
{
    struct error err = {0};
    struct message message;

    assert_false(read_text(text, &message, &err));
    if (err.kind != kind || strcmp(err.place, place) != 0 || !strstr(err.message, fragment)) {
        fail_msg("%s: got %s, %s: %s", text, error_kind_name(err.kind), err.place, err.message);
    }
}

static void valid_messages_are_accepted(void **state)
{
    (void)state;
    assert_accepted("{'type':'hello','client':'abcd-EF_12'}", MESSAGE_HELLO);
    assert_accepted("{'client':'12345678','name':'Anna','revision':9007199254740991,'epoch':'e1',"
                    "'type':'hello'}",
                    MESSAGE_HELLO);
    assert_accepted("{'type':'hello','client':'12345678',"
                    "'key':'0123456789abcdef0123456789abcdef'}",
                    MESSAGE_HELLO);
    assert_accepted("{'type':'view','seq':0,'width':1,'height':4096}", MESSAGE_VIEW);
    assert_accepted("{'type':'view','seq':0,'width':1,'height':1,'isolate':[]}", MESSAGE_VIEW);
    assert_accepted("{'type':'view','seq':0,'width':1,'height':1,'isolate':['a','b']}",
                    MESSAGE_VIEW);
    assert_accepted("{'type':'view','seq':7,'width':640,'height':360,"
                    "'camera':{'position':[0,1,5],'fov':30},'aov':'depth','quality':'sharp',"
                    "'visible':false}",
                    MESSAGE_VIEW);
    assert_accepted("{'type':'view','seq':0,'width':1,'height':1,"
                    "'section':{'normal':[1,0,-1],'offset':0.5}}",
                    MESSAGE_VIEW);
    assert_accepted("{'type':'edit','edit':1,'ops':[{'op':'remove','at':'/nodes/a'}],'group':'g',"
                    "'label':'Remove a'}",
                    MESSAGE_EDIT);
    assert_accepted("{'type':'undo','edit':2}", MESSAGE_UNDO);
    assert_accepted("{'type':'redo','edit':3}", MESSAGE_REDO);
    assert_accepted("{'type':'pick','pick':1,'x':0,'y':10.5,'seq':4}", MESSAGE_PICK);
    assert_accepted("{'type':'pick','pick':1,'x':0,'y':10.5,'through':true}", MESSAGE_PICK);
    assert_accepted("{'type':'bounds','bounds':1}", MESSAGE_BOUNDS);
    assert_accepted("{'type':'bounds','bounds':1,'nodes':['a','b']}", MESSAGE_BOUNDS);
    assert_accepted("{'type':'ack','frame':1}", MESSAGE_ACK);
    assert_accepted("{'type':'retry','place':'/nodes/a'}", MESSAGE_RETRY);
    assert_accepted("{'type':'thumbnails'}", MESSAGE_THUMBNAILS);
    assert_accepted("{'type':'thumbnails','nodes':['a','b'],'large':['a'],'materials':['m'],"
                    "'width':192}",
                    MESSAGE_THUMBNAILS);
    assert_accepted("{'type':'ack_thumbnails','number':1}", MESSAGE_ACK_THUMBNAILS);
    for (enum message_kind kind = 0; kind < MESSAGE_COUNT; kind++) {
        if (!accepted[kind]) {
            fail_msg("nothing above says %s", message_name(kind));
        }
    }
}

static void edits_without_code_are_known(void **state)
{
    struct message message;

    (void)state;
    message = read_valid("{'type':'edit','edit':1,'ops':[{'op':'set','at':'/name','value':'x'},"
                         "{'op':'set','at':'/shaders/s/code','value':''}]}");
    assert_true(message.plain);
    message_finish(&message);
    message = read_valid("{'type':'edit','edit':1,'ops':[{'op':'set','at':'/name','value':'x'},"
                         "{'op':'set','at':'/shaders/s/code','value':'x'}]}");
    assert_false(message.plain);
    message_finish(&message);
    message = read_valid("{'type':'undo','edit':2}");
    assert_false(message.plain); /* nobody has looked */
    message_finish(&message);
}

static void invalid_messages_are_refused(void **state)
{
    (void)state;
    assert_refused("", ERROR_SYNTAX, "line 1, column 1", "expected a value");
    assert_refused("[]", ERROR_SYNTAX, "/type", "expected an object");
    assert_refused("{}", ERROR_SYNTAX, "/type", "expected an object with a text \"type\"");
    assert_refused("{'type':'helo'}", ERROR_SYNTAX, "/type",
                   "unknown message \"helo\"; did you mean \"hello\"?");
    assert_refused("{'type':'hello'}", ERROR_SYNTAX, "", "\"hello\" lacks the member \"client\"");
    assert_refused("{'type':'hello','client':'short'}", ERROR_INVALID, "/client",
                   "expected 8 to 64");
    assert_refused("{'type':'hello','client':'has.a.dot.'}", ERROR_INVALID, "/client",
                   "expected 8 to 64");
    assert_refused("{'type':'hello','client':12345678}", ERROR_INVALID, "/client",
                   "expected 8 to 64");
    assert_refused("{'type':'hello','client':'12345678','key':''}", ERROR_INVALID, "/key",
                   "expected 32 of 0-9 a-f");
    assert_refused("{'type':'hello','client':'12345678','key':'0123456789ABCDEF0123456789ABCDEF'}",
                   ERROR_INVALID, "/key", "expected 32 of 0-9 a-f");
    assert_refused("{'type':'hello','client':'12345678','revision':-1}", ERROR_INVALID, "/revision",
                   "-1 is below the minimum 0");
    assert_refused("{'type':'hello','client':'12345678','color':1}", ERROR_SYNTAX, "/color",
                   "has no member \"color\"");
    assert_refused("{'type':'view','seq':1,'width':0,'height':10}", ERROR_INVALID, "/width",
                   "0 is below the minimum 1");
    assert_refused("{'type':'view','seq':1,'width':10,'height':4097}", ERROR_INVALID, "/height",
                   "4097 is above the maximum 4096");
    assert_refused("{'type':'view','seq':1,'width':10.5,'height':10}", ERROR_INVALID, "/width",
                   "10.5 is not a whole number");
    assert_refused("{'type':'view','seq':1,'width':9,'height':9,'aov':'normals'}", ERROR_INVALID,
                   "/aov", "did you mean \"normal\"?");
    assert_refused("{'type':'view','seq':1,'width':9,'height':9,'aov':'position'}", ERROR_INVALID,
                   "/aov", "");
    assert_refused("{'type':'view','seq':1,'width':9,'height':9,'camera':{'fov':0}}", ERROR_INVALID,
                   "/camera/fov", "0 is below the minimum 1");
    assert_refused("{'type':'view','seq':1,'width':9,'height':9,'section':{'normal':[0,0,0]}}",
                   ERROR_INVALID, "/section/normal", "0, 0, 0 has no direction");
    assert_refused("{'type':'view','seq':1,'width':9,'height':9,'section':{'offset':'x'}}",
                   ERROR_INVALID, "/section/offset", "");
    assert_refused("{'type':'view','seq':1,'width':9,'height':9,'visible':1}", ERROR_INVALID,
                   "/visible", "expected true or false");
    assert_refused("{'type':'view','seq':1,'width':9,'height':9,'isolate':'a'}", ERROR_SYNTAX,
                   "/isolate", "expected a list of ids");
    assert_refused("{'type':'view','seq':1,'width':9,'height':9,'isolate':['a',1]}", ERROR_INVALID,
                   "/isolate/1", "expected the id of a node");
    assert_refused("{'type':'thumbnails','nodes':['a','no id']}", ERROR_INVALID, "/nodes/1",
                   "expected the id of a node");
    assert_refused("{'type':'thumbnails','width':193}", ERROR_INVALID, "/width", "192");
    assert_refused("{'type':'edit','edit':0,'ops':[]}", ERROR_INVALID, "/edit",
                   "0 is below the minimum 1");
    assert_refused("{'type':'edit','edit':1,'ops':[]}", ERROR_SYNTAX, "",
                   "expected an array of operations");
    assert_refused("{'type':'edit','edit':1,'ops':[{'op':'delete'}]}", ERROR_SYNTAX, "/0/op",
                   "unknown operation \"delete\"");
    assert_refused("{'type':'undo'}", ERROR_SYNTAX, "", "lacks the member \"edit\"");
    assert_refused("{'type':'pick','pick':1,'x':0}", ERROR_SYNTAX, "", "member \"y\"");
    assert_refused("{'type':'ack','frame':4294967296}", ERROR_INVALID, "/frame",
                   "4294967296 is above the maximum 4294967295");
}

static void records_and_lists_are_read(void **state)
{
    (void)state;
    struct message view = read_valid("{'type':'view','seq':7,'width':64,'height':36,"
                                     "'camera':{'fov':30},'isolate':['b','a'],"
                                     "'section':{'offset':0.5}}");
    struct message plain = read_valid("{'type':'view','seq':8,'width':64,'height':36}");
    struct message shown = read_valid("{'type':'thumbnails','nodes':['a','b'],'large':['c'],"
                                      "'materials':['m','n','o']}");

    assert_float_equal(record_number(&view.view.camera, "fov"), 30, 0);
    assert_false(record_is_set(&view.view.camera, "position"));
    assert_float_equal(record_number(&view.view.section, "offset"), 0.5, 0);
    assert_int_equal(view.view.isolate.count, 2);
    assert_string_equal(view.view.isolate.ids[0], "a");
    assert_true(record_is_empty(&plain.view.camera) && record_is_empty(&plain.view.section));
    assert_int_equal(plain.view.isolate.count, 0);
    assert_int_equal(shown.nodes.count, 2);
    assert_int_equal(shown.large.count, 1);
    assert_string_equal(shown.materials.ids[2], "o");
    message_finish(&view);
    message_finish(&plain);
    message_finish(&shown);
}

static void refuses_large_messages(void **state)
{
    (void)state;
    struct error err = {0};
    struct message message;
    char *text = malloc(LIMIT_MESSAGE_BYTES + 1);

    assert_non_null(text);
    memset(text, ' ', LIMIT_MESSAGE_BYTES + 1);
    assert_false(message_read(text, LIMIT_MESSAGE_BYTES + 1, &message, &err));
    assert_int_equal(err.kind, ERROR_TOO_LARGE);
    assert_string_equal(err.message, "1048577 bytes are above the maximum 1048576");
    free(text);
}

static void members_have_fallbacks(void **state)
{
    (void)state;
    cJSON *json = json_text_parse("{'n':2,'t':'x','b':true}", NULL);

    assert_float_equal(json_member_number(json, "n", 5), 2, 0);
    assert_float_equal(json_member_number(json, "t", 5), 5, 0);
    assert_string_equal(json_member_text(json, "t", "y"), "x");
    assert_string_equal(json_member_text(json, "none", "y"), "y");
    assert_true(json_member_bool(json, "b", false));
    assert_true(json_member_bool(json, "n", true));
    cJSON_Delete(json);
}

static const uint8_t frame_bytes[FRAME_HEADER_BYTES] = {
    'F',  'C',  'F',  '1',  3,    2,    54,   11,   /* version, codec, flags, stages */
    4,    3,    2,    1,    8,    7,    6,    5,    /* number, payload bytes */
    0x16, 0x15, 0x14, 0x13, 0x12, 0x11, 0x10, 0x09, /* revision */
    0x24, 0x23, 0x22, 0x21, 0x80, 2,    0x68, 1,    0,  5, 0xd0, 2, /* seq, sides */
    2,    3,    5,    9,                                            /* round, chain */
    1,    0,    0,    0,    2,    0,    0,    0,    3,  0, 0,    0, /* stages in their order */
    4,    0,    0,    0,    5,    0,    0,    0,    6,  0, 0,    0, 7,    0,    0,    0,
    8,    0,    0,    0,    9,    0,    0,    0,    10, 0, 0,    0, 0xff, 0xff, 0xff, 0xff,
};

static const struct frame_header frame = {
    .codec = CODEC_PNG,
    .flags = FRAME_STILL | FRAME_LOSSLESS | FRAME_DEPTHS | FRAME_DELTA,
    .number = 0x01020304,
    .payload_bytes = 0x05060708,
    .revision = 0x0910111213141516,
    .input = 0x21222324,
    .width = 640,
    .height = 360,
    .view_width = 1280,
    .view_height = 720,
    .round = 2,
    .rounds = 3,
    .chain = 5,
    .link = 9,
    .stage_us = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 0xffffffff},
};

static void frame_header_bytes(void **state)
{
    (void)state;
    uint8_t bytes[FRAME_HEADER_BYTES];
    struct frame_header back;

    memset(bytes, 0xaa, sizeof bytes);
    memset(&back, 0, sizeof back);
    frame_header_pack(&frame, bytes);
    assert_memory_equal(bytes, frame_bytes, sizeof bytes);
    assert_true(frame_header_unpack(bytes, sizeof bytes, &back));
    assert_int_equal(back.revision, frame.revision);
    assert_int_equal(back.view_height, frame.view_height);
    frame_header_pack(&back, bytes);
    assert_memory_equal(bytes, frame_bytes, sizeof bytes);
    assert_false(frame_header_unpack(bytes, sizeof bytes - 1, &back));
    bytes[4] = 1;
    assert_false(frame_header_unpack(bytes, sizeof bytes, &back));
    frame_part_pack(0x01020304, bytes);
    assert_memory_equal(bytes, "FCFP\4\3\2\1", FRAME_PART_HEADER_BYTES);
    assert_false(frame_header_unpack(bytes, sizeof bytes, &back));
}

static void thumbnail_bytes(void **state)
{
    static const uint8_t header_bytes[THUMBNAIL_HEADER_BYTES] = {'F', 'C', 'T', '1', 1, 2, 3, 0, 5,
                                                                 6,   0,   0,   0,   0, 0, 0, 7, 8};
    static const uint8_t row_bytes[THUMBNAIL_ROW_BYTES] = {1, 9, 96, 0, 64, 0, 0, 0, 1, 2, 3, 4};
    uint8_t header[THUMBNAIL_HEADER_BYTES], row[THUMBNAIL_ROW_BYTES];

    (void)state;
    thumbnail_header_pack(
        &(struct thumbnail_header){.count = 3, .number = 0x605, .revision = 0x807}, header);
    assert_memory_equal(header, header_bytes, sizeof header);
    thumbnail_row_pack(&(struct thumbnail_row){.kind = THUMBNAIL_MATERIAL,
                                               .id_bytes = 9,
                                               .width = 96,
                                               .height = thumbnail_height(96),
                                               .bytes = 0x04030201},
                       row);
    assert_memory_equal(row, row_bytes, sizeof row);
    assert_int_equal(thumbnail_height(256), 171);
}

static void describes_both_directions(void **state)
{
    (void)state;
    cJSON *both = messages_describe();
    const cJSON *client = cJSON_GetObjectItem(both, "client");

    assert_int_equal(cJSON_GetArraySize(client), MESSAGE_COUNT);
    for (int i = 0; i < MESSAGE_COUNT; i++) {
        assert_string_equal(json_member_text(cJSON_GetArrayItem(client, i), "type", ""),
                            message_name((enum message_kind)i));
    }
    const cJSON *list = cJSON_GetObjectItem(both, "server"), *row, *member;
    assert_string_equal(json_member_text(cJSON_GetArrayItem(list, 0), "type", ""), "welcome");
    cJSON_ArrayForEach(row, list)
    {
        assert_true(*json_member_text(row, "type", ""));
        cJSON_ArrayForEach(member, cJSON_GetObjectItem(row, "members"))
        {
            assert_true(*json_member_text(member, "name", ""));
            assert_true(*json_member_text(member, "type", ""));
            assert_true(*json_member_text(member, "doc", ""));
            assert_true(cJSON_IsBool(cJSON_GetObjectItem(member, "required")));
        }
    }
    cJSON_Delete(both);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(valid_messages_are_accepted),
        cmocka_unit_test(edits_without_code_are_known),
        cmocka_unit_test(invalid_messages_are_refused),
        cmocka_unit_test(records_and_lists_are_read),
        cmocka_unit_test(refuses_large_messages),
        cmocka_unit_test(members_have_fallbacks),
        cmocka_unit_test(frame_header_bytes),
        cmocka_unit_test(thumbnail_bytes),
        cmocka_unit_test(describes_both_directions),
    };

    return cmocka_run_group_tests_name("messages", tests, NULL, NULL);
}
