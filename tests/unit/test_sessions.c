/* SPDX-License-Identifier: MIT */
/* Live sessions without connections: what happens to a scene, its authors and its questions while
 * others read the document, leave, or come again. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "protocol/json.h"
#include "protocol/memory.h"
#include "server/live/hub_rooms.h"
#include "server/live/room.h"
#include "server/live/scene_error.h"
#include "server/live/session.h"
#include "server/live/session_life.h"
#include "server/live/session_messages.h"
#include "tests/support/json_text.h"
#include "tests/support/silent_hub.h"

static pthread_cond_t woken = PTHREAD_COND_INITIALIZER; /* with the hub's lock */

/* --- scenes --- */

/* The document of a new scene is `text`, with ' instead of ". */
static struct room *make_scene(struct hub *hub, const char *id, const char *text)
{
    struct error err = {0};
    struct scene *scene = json_text_scene(text, &err);

    assert_non_null(scene);
    struct room *room =
        hub_lock_new_room(hub, id, scene, scene_print(scene, false), NULL, NULL, &err);
    assert_non_null(room);
    hub_unlock(hub);
    return room;
}

static void delete_scene(struct hub *hub, const char *id)
{
    struct room *room = hub_lock_room_to_change(hub, id, NULL);

    assert_non_null(room);
    hub_delete_room(hub, room, NULL, NULL);
    hub_unlock(hub);
}

/* --- a client --- */

static void on_wake(void *connection)
{
    (void)connection;
    pthread_cond_broadcast(&woken);
}

static void begin_to_say(struct session *session, const char *scene, const char *text)
{
    if (!session_receive(session, scene, text, strlen(text))) {
        session_receive_apart(session, scene, memory_text(text), strlen(text));
    }
}

static void wait_for_work(struct session *session)
{
    hub_lock(session->hub);
    while (session->working) {
        hub_wait(session->hub, &woken);
    }
    hub_unlock(session->hub);
}

/* A message with ' instead of ". */
static void say(struct session *session, const char *scene, const char *text)
{
    struct error err = {0};
    cJSON *message = json_text_parse(text, &err);
    char *printed = json_print(message, false);

    begin_to_say(session, scene, printed);
    wait_for_work(session);
    free(printed);
    cJSON_Delete(message);
}

static struct session *open_session(struct hub *hub)
{
    hub_lock(hub);
    struct session *session = session_create(hub, on_wake, NULL);
    hub_unlock(hub);
    return session;
}

static struct session *enter(struct hub *hub, const char *scene, const char *client)
{
    struct session *session = open_session(hub);
    char hello[200];

    snprintf(hello, sizeof hello, "{'type':'hello','client':'%s'}", client);
    say(session, scene, hello);
    return session;
}

static void leave(struct session *session)
{
    struct hub *hub = session->hub;

    hub_lock(hub);
    session_leave(session);
    hub_unlock(hub);
}

/* The next text that waits for the client. NULL: there is none. Under the lock. */
static cJSON *next_message(struct session *session)
{
    static uint8_t part[SEND_QUEUE_PART_BYTES + FRAME_HEADER_BYTES];
    struct send_queue_piece piece = {0};
    char *text = NULL;
    size_t length = 0;
    int code;
    FILE *out = open_memstream(&text, &length);

    while (!piece.last && session_next(session, part, &piece, &code)) {
        fwrite(part, 1, piece.length, out);
    }
    fclose(out);
    cJSON *message = piece.last ? cJSON_ParseWithLength(text, length) : NULL;
    assert_true(message || !piece.last);
    free(text);
    return message;
}

/* Reads what is said until a message of this type comes; the caller deletes it. */
static cJSON *await(struct session *session, const char *type)
{
    cJSON *message;

    hub_lock(session->hub);
    while (!(message = next_message(session)) ||
           strcmp(json_member_text(message, "type", ""), type) != 0) {
        if (!message) {
            hub_wait(session->hub, &woken);
        }
        cJSON_Delete(message);
    }
    hub_unlock(session->hub);
    return message;
}

/* --- what waits for a session --- */

static const char *const ball = "{'format':'fieldcast/1','root':{'id':'ball','type':'sphere'}}";

/* Until it has more than may wait. */
static void overflow(struct session *session)
{
    struct shared_buffer *text = shared_buffer_take(memory_alloc(1, 1000000), 1000000);

    hub_lock(session->hub);
    while (!session->close_code) {
        session_send(session, text);
    }
    assert_true(session->close_now);
    hub_unlock(session->hub);
    shared_buffer_unref(text);
}

/* The questions of a session that reads too slowly rest while its scene is deleted. */
static void questions_go_with_the_room(void **state)
{
    struct hub *hub = silent_hub_open();

    (void)state;
    make_scene(hub, "deleted", ball);
    make_scene(hub, "stays", ball);
    struct session *slow = enter(hub, "deleted", "the-slow-one");
    struct session *other = enter(hub, "stays", "the-other-one");
    hub_lock(hub);
    slow->picks_rest_us = INT64_MAX;
    hub_unlock(hub);
    say(slow, "deleted", "{'type':'bounds','bounds':1,'nodes':['ball']}");
    overflow(slow);
    delete_scene(hub, "deleted");
    hub_lock(hub);
    assert_null(slow->room);
    slow->picks_rest_us = 0;
    hub_unlock(hub);
    say(other, "stays", "{'type':'bounds','bounds':2,'nodes':['ball']}");
    cJSON_Delete(await(other, "bounded"));
    leave(slow);
    leave(other);
    silent_hub_close(hub);
}

/* --- authors --- */

/* So many changes that they are applied without the lock. */
static char *heavy_edit(const char *last_place)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    fputs("{\"type\":\"edit\",\"edit\":1,\"ops\":[", out);
    for (int i = 1; i < LIMIT_OPERATIONS; i++) {
        fprintf(out, "{\"op\":\"set\",\"at\":\"/nodes/ball/params/radius\",\"value\":%d},", i);
    }
    fprintf(out, "{\"op\":\"set\",\"at\":\"%s\",\"value\":\"last\"}]}", last_place);
    fclose(out);
    return text;
}

/* Holds the room of an edit that is being applied. False: it was over before. */
static bool hold_meanwhile(struct hub *hub, struct room *room, const bool *working)
{
    bool held = false, over = false;

    while (!held && !over) {
        hub_lock(hub);
        held = room->holds > 0;
        over = !*working;
        if (held) {
            room_hold(room);
        }
        hub_unlock(hub);
        usleep(100);
    }
    return held;
}

static void release(struct room *room)
{
    hub_lock(room->hub);
    room_release(room);
    hub_unlock(room->hub);
}

/* The same client comes with another connection, which ends the first one, and leaves. */
static void come_and_leave(struct hub *hub, const char *scene, const char *client, const char *key)
{
    struct session *session = open_session(hub);
    char hello[200];

    snprintf(hello, sizeof hello, "{'type':'hello','client':'%s','key':'%s'}", client, key);
    say(session, scene, hello);
    cJSON_Delete(await(session, "document"));
    leave(session);
}

/* False: the edit was applied before anybody could come. */
static bool leave_while_it_edits(struct hub *hub, struct room *room, const char *client,
                                 const char *edit)
{
    struct session *session = enter(hub, room->id, client);
    cJSON *welcome = await(session, "welcome");

    begin_to_say(session, room->id, edit);
    const bool held = hold_meanwhile(hub, room, &session->working);
    if (held) {
        come_and_leave(hub, room->id, client, json_member_text(welcome, "key", ""));
        release(room);
    }
    wait_for_work(session);
    leave(session);
    cJSON_Delete(welcome);
    return held;
}

static void an_author_stays_for_an_edit_that_is_applied(void **state)
{
    struct hub *hub = silent_hub_open();
    struct room *room = make_scene(hub, "edited", ball);
    char *edit = heavy_edit("/name"), *refused = heavy_edit("/nodes/ball/params/radius");
    char client[30] = "";

    (void)state;
    for (int i = 0; snprintf(client, sizeof client, "client-%d", i) > 0 &&
                    !leave_while_it_edits(hub, room, client, edit);
         i++) {
    }
    hub_lock(hub);
    const struct author *author = authors_find(&room->authors, client);
    assert_non_null(author);
    assert_int_equal(author->edit, 1);
    assert_int_equal(author->revision, room->revision);
    assert_null(author->session);
    const size_t authors = room->authors.count;
    hub_unlock(hub);
    while (!leave_while_it_edits(hub, room, "only-refused", refused)) {
    }
    hub_lock(hub);
    assert_int_equal(room->authors.count, authors);
    hub_unlock(hub);
    free(edit);
    free(refused);
    silent_hub_close(hub);
}

/* --- readers --- */

/* A union of very many balls, each with a name of so many characters. */
static char *large_document(int balls, int name)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    fputs("{'format':'fieldcast/1','root':{'id':'all','type':'union','children':[", out);
    for (int i = 0; i < balls; i++) {
        fprintf(out, "%s{'id':'ball-%d','type':'sphere','name':'%0*d'}", i ? "," : "", i, name, i);
    }
    fputs("]}}", out);
    fclose(out);
    return text;
}

struct light_edit {
    struct room *room;
    cJSON *ops;
    bool working;
};

static void *apply_light_edit(void *data)
{
    struct light_edit *edit = data;
    struct hub *hub = edit->room->hub;
    const struct room_change change = {.author = "rest"};
    struct error err = {0};
    uint64_t revision = 0;

    hub_lock(hub);
    assert_int_equal(room_edit(edit->room, &change, edit->ops, &revision, &err), ROOM_APPLIED);
    edit->working = false;
    hub_unlock(hub);
    return NULL;
}

/* Whoever reads the document does so for as long as it takes to copy it some times. */
static void read_for_long(const struct room *room)
{
    for (int i = 0; i < 5; i++) {
        struct scene *copy = scene_copy(room->scene);

        assert_string_equal(record_text(&copy->info, "name"), "");
        scene_destroy(copy);
    }
}

/* The first code makes the room keep a copy, for which it lets go of the lock. False: nobody came
 * in between. */
static bool read_while_the_first_code_comes(struct hub *hub, const char *id, const char *document)
{
    struct error err = {0};
    struct room *room = make_scene(hub, id, document);
    struct light_edit edit = {
        .room = room,
        .ops = json_text_parse("[{'op':'set','at':'/name','value':'new'},{'op':'insert',"
                               "'into':'/primitives','before':null,'name':'p','value':{"
                               "'code':'float sdf(vec3 p) { return length(p) - 1; }'}}]",
                               &err),
        .working = true};
    pthread_t thread;

    assert_non_null(edit.ops);
    assert_int_equal(pthread_create(&thread, NULL, apply_light_edit, &edit), 0);
    const bool held = hold_meanwhile(hub, room, &edit.working);
    if (held) {
        read_for_long(room);
        hub_lock(hub);
        assert_int_equal(room->revision, 1);
        room_release(room);
        hub_unlock(hub);
    }
    pthread_join(thread, NULL);
    assert_int_equal(room->revision, 2);
    cJSON_Delete(edit.ops);
    return held;
}

static void a_light_edit_waits_for_readers_of_the_state_it_kept(void **state)
{
    struct hub *hub = silent_hub_open();
    char *document = large_document(LIMIT_CHILDREN, 1);
    char id[20] = "";

    (void)state;
    for (int i = 0; snprintf(id, sizeof id, "large-%d", i) > 0 &&
                    !read_while_the_first_code_comes(hub, id, document);
         i++) {
    }
    free(document);
    silent_hub_close(hub);
}

/* --- coming back --- */

/* An edit that brings `bytes` and more, and leaves the scene small. */
static char *long_edit(size_t bytes)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    fputc('[', out);
    for (size_t at = 0; at < bytes; at += 180) {
        fprintf(out, "%s{'op':'set','at':'/name','value':'%0150zu'}", at ? "," : "", at);
    }
    fputc(']', out);
    fclose(out);
    return text;
}

static enum room_outcome try_edit(struct room *room, const char *author, const char *text,
                                  struct error *err)
{
    const struct room_change change = {.author = author};
    cJSON *ops = json_text_parse(text, err);
    uint64_t revision = 0;

    hub_lock(room->hub);
    const enum room_outcome outcome = room_edit(room, &change, ops, &revision, err);
    hub_unlock(room->hub);
    cJSON_Delete(ops);
    return outcome;
}

static void edit_scene(struct room *room, const char *text)
{
    struct error err = {0};

    assert_int_equal(try_edit(room, "rest", text, &err), ROOM_APPLIED);
}

static struct session *come_back(struct hub *hub, const struct room *room, uint64_t revision)
{
    struct session *session = open_session(hub);
    char hello[200];

    snprintf(hello, sizeof hello,
             "{'type':'hello','client':'comes-back','revision':%d,'epoch':'%s'}", (int)revision,
             room->epoch);
    say(session, room->id, hello);
    hub_lock(hub);
    assert_int_equal(session->close_code, 0);
    hub_unlock(hub);
    return session;
}

static void assert_next(struct session *session, const char *type, uint64_t revision)
{
    hub_lock(session->hub);
    cJSON *message = next_message(session);
    hub_unlock(session->hub);
    assert_string_equal(json_member_text(message, "type", ""), type);
    assert_int_equal(json_member_number(message, "revision", 0), revision);
    cJSON_Delete(message);
}

/* The log has 3 MB of edits, and a client may miss all of them. */
static void who_missed_much_gets_the_document(void **state)
{
    struct hub *hub = silent_hub_open();
    struct room *room = make_scene(hub, "missed", ball);
    char *edit = long_edit(500000);

    (void)state;
    for (int i = 0; i < 6; i++) {
        edit_scene(room, edit);
    }
    assert_int_equal(room->log_from, 1);
    struct session *session = come_back(hub, room, 1);
    assert_next(session, "welcome", 7);
    assert_next(session, "document", 7);
    leave(session);
    session = come_back(hub, room, 5);
    assert_next(session, "welcome", 7);
    assert_next(session, "changed", 6);
    assert_next(session, "changed", 7);
    leave(session);
    free(edit);
    silent_hub_close(hub);
}

/* The document is longer than what may wait, and something is said about the scene behind it. */
static void a_long_document_and_notices_are_an_answer_to_hello(void **state)
{
    struct hub *hub = silent_hub_open();
    char *document = large_document(LIMIT_CHILDREN, 200);
    struct room *room = make_scene(hub, "long", document);
    const struct error err = {.kind = ERROR_COMPILE, .place = "/nodes/all", .message = "is wrong"};

    (void)state;
    hub_lock(hub);
    scene_error_set(room, &err, 1);
    hub_unlock(hub);
    struct session *session = come_back(hub, room, 0);
    assert_next(session, "welcome", 1);
    hub_lock(hub);
    assert_true(room->text->length > SEND_QUEUE_TEXT_BYTES);
    hub_unlock(hub);
    assert_next(session, "document", 1);
    assert_next(session, "notice", 0);
    leave(session);
    free(document);
    silent_hub_close(hub);
}

/* They are freed without the lock, so the room may not leave them in its history. */
static void steps_that_are_gone_leave_the_room(void **state)
{
    struct hub *hub = silent_hub_open();
    struct room *room = make_scene(hub, "steps", ball);
    size_t bytes;

    (void)state;
    for (int i = 0; i < LIMIT_UNDO_GROUPS + 3; i++) {
        edit_scene(room, "[{'op':'set','at':'/name','value':'next'}]");
        hub_lock(hub);
        assert_null(history_take_dropped(room->history, &bytes));
        hub_unlock(hub);
    }
    silent_hub_close(hub);
}

/* --- long scenes --- */

/* As many equations as one client may send at once. With the ids that they get, the edit is longer
 * than that. */
static char *insert_equations(const char *into, size_t *out_count)
{
    enum { ITEM = LIMIT_EQUATION_BYTES + 93 };
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    *out_count = 0;
    for (; ftell(out) + ITEM + 2 < LIMIT_DOCUMENT_BYTES; ++*out_count) {
        fprintf(out,
                "%c{'op':'insert','into':'/nodes/%s','before':null,'value':{'type':'implicit',"
                "'params':{'equation':'x = %0*zu'}}}",
                *out_count ? ',' : '[', into, LIMIT_EQUATION_BYTES - 4, *out_count);
    }
    fputc(']', out);
    fclose(out);
    assert_true(length + 16 * *out_count > LIMIT_DOCUMENT_BYTES);
    return text;
}

/* The scene is as it was. */
static void assert_no_space(const struct room *room, uint64_t revision, enum room_outcome outcome,
                            const struct error *err)
{
    assert_int_equal(outcome, ROOM_REFUSED);
    assert_int_equal(err->kind, ERROR_LIMIT);
    assert_non_null(
        strstr(err->message, " bytes of the scene are above the maximum 67108864 (scene_bytes)"));
    assert_int_equal(room->revision, revision);
}

static void assert_no_space_for(struct room *room, const char *text)
{
    struct error err = {0};
    const uint64_t revision = room->revision;

    assert_no_space(room, revision, try_edit(room, "rest", text, &err), &err);
}

static enum room_outcome take_back(struct room *room, const char *author, bool redo,
                                   struct error *err)
{
    const struct room_change change = {.author = author};
    cJSON *skipped;
    uint64_t revision = 0;

    hub_lock(room->hub);
    const enum room_outcome outcome = room_undo(room, &change, redo, &revision, &skipped, err);
    hub_unlock(room->hub);
    assert_null(skipped);
    return outcome;
}

/* Whole edits of almost 16 MiB. */
static void fill(struct room *room, const char *into, int times)
{
    size_t count;
    char *edit = insert_equations(into, &count);

    for (int i = 0; i < times; i++) {
        edit_scene(room, edit);
    }
    free(edit);
}

/* As a server that did not know the limit would. */
static void fill_above_the_limit(struct room *room)
{
    struct error err = {0};
    size_t count;
    char *edit = insert_equations("all", &count);
    cJSON *ops = json_text_parse(edit, &err);

    hub_lock(room->hub);
    assert_true(edit_apply(room->scene, ops, NULL, NULL, &err));
    room->bytes += strlen(edit);
    hub_unlock(room->hub);
    cJSON_Delete(ops);
    free(edit);
}

enum { FILLS = 4 }; /* whole edits that a scene has space for */

#define EMPTY                                                                                      \
    "{'format':'fieldcast/1','root':{'id':'top','type':'union','children':["                       \
    "{'id':'all','type':'union'}]}}"

static void edits_do_not_grow_a_scene_without_end(void **state)
{
    struct hub *hub = silent_hub_open();
    struct room *room = make_scene(hub, "full", EMPTY);
    size_t count;
    char *edit = insert_equations("all", &count);

    (void)state;
    fill(room, "all", FILLS);
    assert_no_space_for(room, edit);
    assert_int_equal(room->scene->node_count, 2 + FILLS * count);
    edit_scene(room, "[{'op':'set','at':'/name','value':'Full'}]");
    fill_above_the_limit(room);
    assert_no_space_for(room, "[{'op':'set','at':'/name','value':'Too full'}]");
    edit_scene(room, "[{'op':'set','at':'/name','value':'Fuel'}]");
    silent_hub_close(hub);

    hub = silent_hub_open();
    room = hub_lock_room(hub, "full", NULL);
    assert_non_null(room);
    hub_unlock(hub);
    assert_int_equal(room->scene->node_count, 2 + (FILLS + 1) * count);
    assert_no_space_for(room, edit);
    edit_scene(room, "[{'op':'remove','at':'/nodes/all'}]");
    edit_scene(room, "[{'op':'insert','into':'/nodes/top','value':{'id':'all','type':'union'}}]");
    edit_scene(room, edit);
    free(edit);
    silent_hub_close(hub);
}

static void an_undo_without_space_stays(void **state)
{
    struct hub *hub = silent_hub_open();
    struct room *room = make_scene(hub, "undo", EMPTY);
    struct error err = {0};

    (void)state;
    fill(room, "all", FILLS - 1);
    const size_t nodes = room->scene->node_count;
    assert_int_equal(try_edit(room, "anna", "[{'op':'remove','at':'/nodes/all'}]", &err),
                     ROOM_APPLIED);
    fill(room, "top", 2);
    const uint64_t revision = room->revision;
    assert_no_space(room, revision, take_back(room, "anna", false, &err), &err);
    assert_int_equal(take_back(room, "rest", false, &err), ROOM_APPLIED);
    assert_int_equal(take_back(room, "rest", false, &err), ROOM_APPLIED);
    assert_int_equal(take_back(room, "anna", false, &err), ROOM_APPLIED);
    assert_int_equal(room->scene->node_count, nodes);
    assert_int_equal(take_back(room, "rest", true, &err), ROOM_APPLIED);
    assert_no_space(room, revision + 4, take_back(room, "rest", true, &err), &err);
    assert_int_equal(take_back(room, "anna", true, &err), ROOM_APPLIED);
    assert_int_equal(take_back(room, "rest", true, &err), ROOM_APPLIED);
    silent_hub_close(hub);
}

static void assert_read(const char *id, uint64_t revision, size_t nodes)
{
    struct hub *hub = silent_hub_open();
    struct error err = {0};
    struct room *room = hub_lock_room(hub, id, &err);

    assert_string_equal(err.message, "");
    assert_int_equal(room->revision, revision);
    assert_int_equal(room->scene->node_count, nodes);
    hub_unlock(hub);
    silent_hub_close(hub);
}

/* What edits have made is read, however long it is: first from the log, then from the snapshot that
 * is stored at the end. */
static void what_grew_by_edits_is_read_again(void **state)
{
    struct hub *hub = silent_hub_open();
    struct room *room =
        make_scene(hub, "grows", "{'format':'fieldcast/1','root':{'id':'all','type':'union'}}");
    size_t count;
    char *edit = insert_equations("all", &count);

    (void)state;
    edit_scene(room, edit);
    edit_scene(room, edit);
    free(edit);
    hub_destroy(hub); /* without a snapshot */
    assert_read("grows", 3, 1 + 2 * count);
    assert_read("grows", 3, 1 + 2 * count);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(questions_go_with_the_room),
        cmocka_unit_test(an_author_stays_for_an_edit_that_is_applied),
        cmocka_unit_test(a_light_edit_waits_for_readers_of_the_state_it_kept),
        cmocka_unit_test(who_missed_much_gets_the_document),
        cmocka_unit_test(a_long_document_and_notices_are_an_answer_to_hello),
        cmocka_unit_test(steps_that_are_gone_leave_the_room),
        cmocka_unit_test(what_grew_by_edits_is_read_again),
        cmocka_unit_test(edits_do_not_grow_a_scene_without_end),
        cmocka_unit_test(an_undo_without_space_stays),
    };

    if (silent_hub_was_worker(argc, argv)) {
        return 0;
    }
    return cmocka_run_group_tests_name("sessions", tests, silent_hub_make_directory,
                                       silent_hub_remove_directory);
}
