/* SPDX-License-Identifier: MIT */
/* What is under a place of a picture. That it agrees with pictures is in test_renderer.c. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "protocol/picture.h"
#include "renderer/pick.h"
#include "tests/support/json_text.h"

static const char ball[] = "{'format':'fieldcast/1','camera':{'position':[0,1,5],'target':[0,0,0]},"
                           "'root':{'id':'ball','type':'sphere','params':{'radius':1}}}";
static const char ball_on_floor[] =
    "{'format':'fieldcast/1','camera':{'position':[0,1,5],'target':[0,0,0]},"
    "'environment':{'floor':true,'floor_height':-1},"
    "'root':{'id':'ball','type':'sphere','params':{'radius':1}}}";

static struct pick_field *make_isolated(const char *text, const char *id)
{
    struct error err = {0};
    struct scene *scene = json_text_scene(text, &err);

    assert_non_null(scene);
    struct pick_field *field = pick_field_create(scene, &id, id != NULL, &err);
    assert_non_null(field);
    scene_destroy(scene);
    return field;
}

static struct pick_field *make_field(const char *text)
{
    return make_isolated(text, NULL);
}

static struct pick_result look(const struct pick_field *field, double x, double y)
{
    return pick_at(field, &(struct pick_question){.width = 640, .height = 360, .x = x, .y = y});
}

static void picks_hit_a_ball(void **state)
{
    struct pick_field *field = make_field(ball);
    const struct pick_result hit = look(field, 320, 180), miss = look(field, 5, 5);

    (void)state;
    assert_true(hit.hit);
    assert_string_equal(hit.node, "ball");
    assert_true(fabs(hit.distance - (sqrt(26) - 1)) < 1e-3);
    assert_true(fabs(hit.normal[1] - 1 / sqrt(26)) < 1e-3);
    assert_true(fabs(hit.position[2] - 5 / sqrt(26)) < 1e-3);
    assert_false(miss.hit);
    assert_string_equal(miss.node, "");
    pick_field_unref(field);
}

/* A click finds what is seen. */
static void picks_find_what_is_isolated(void **state)
{
    static const char nested[] =
        "{'format':'fieldcast/1','camera':{'position':[0,0,5],'target':[0,0,0]},"
        "'root':{'id':'ball','type':'sphere','params':{'radius':1},'children':["
        "{'id':'kernel','type':'sphere','params':{'radius':0.5}}]}}";
    struct pick_field *all = make_field(nested), *one = make_isolated(nested, "kernel");

    (void)state;
    assert_string_equal(look(all, 320, 180).node, "ball");
    assert_string_equal(look(one, 320, 180).node, "kernel");
    assert_true(fabs(look(one, 320, 180).distance - 4.5) < 1e-3);
    pick_field_unref(all);
    pick_field_unref(one);
}

static struct pick_result look_through(const struct pick_field *field, double x, double y)
{
    return pick_at(field, &(struct pick_question){
                              .width = 640, .height = 360, .x = x, .y = y, .through = true});
}

static void assert_through(const struct pick_result *result, const char *expected)
{
    char all[256] = "";

    for (int i = 0; i < result->through_count; i++) {
        strncat(all, result->through[i], sizeof all - strlen(all) - 1);
        strncat(all, " ", sizeof all - strlen(all) - 1);
    }
    assert_string_equal(all, expected);
}

/* A cut is hit where it is seen, its normal is the plane's, and what it took away is not behind it
 * either. */
static void picks_find_what_is_cut(void **state)
{
    static const char nested[] =
        "{'format':'fieldcast/1','camera':{'position':[0,0,5],'target':[0,0,0]},"
        "'root':{'type':'union','children':["
        "{'id':'front','type':'sphere','params':{'radius':0.4},"
        "'transform':{'translation':[0,0,2]}},"
        "{'type':'difference','children':[{'id':'shell','type':'sphere','params':{'radius':1}},"
        "{'id':'tool','type':'sphere','params':{'radius':0.8}}]}]}}";
    struct pick_field *field = make_field(nested);
    struct pick_question asked = {.width = 640, .height = 360, .x = 320, .y = 180, .through = true};
    struct record section;
    struct error err = {0};

    (void)state;
    record_init(&section, &section_type);
    cJSON *json = json_text_parse("{'normal':[0,3,4],'offset':0.3}", &err);
    assert_true(record_read(&section, json, "", &err));
    assert_string_equal(pick_at(field, &asked).node, "front");
    asked.section = &section;
    struct pick_result hit = pick_at(field, &asked);
    assert_string_equal(hit.node, "tool"); /* inside of the shell, on its far side */
    assert_true(fabs(hit.position[2] + 0.8) < 1e-3);
    assert_through(&hit, "tool shell ");
    asked.y = 106; /* through the wall, which the plane cuts */
    hit = pick_at(field, &asked);
    assert_true(hit.hit);
    assert_string_equal(hit.node, "shell");
    assert_true(fabs(0.6 * hit.position[1] + 0.8 * hit.position[2] - 0.3) < 1e-3);
    assert_true(hit.normal[0] == 0 && fabs(hit.normal[1] - 0.6) < 1e-9 &&
                fabs(hit.normal[2] - 0.8) < 1e-9);
    cJSON_Delete(json);
    record_finish(&section);
    pick_field_unref(field);
}

static void picks_hit_the_floor(void **state)
{
    struct pick_field *field = make_field(ball_on_floor);
    const struct pick_result hit = look(field, 320, 350);

    (void)state;
    assert_true(hit.hit);
    assert_string_equal(hit.node, "");
    assert_true(fabs(hit.position[1] + 1) < 1e-3);
    pick_field_unref(field);
}

/* The tool of a cut, what it cuts, and what is behind; the floor is no node. */
static void picks_list_what_lies_behind(void **state)
{
    static const char bitten[] =
        "{'format':'fieldcast/1','camera':{'position':[0,0.2,6],'target':[0,0,0]},"
        "'environment':{'floor':true,'floor_height':-2},"
        "'root':{'id':'all','type':'union','children':["
        "{'id':'apple','type':'difference','children':["
        "{'id':'flesh','type':'sphere','params':{'radius':1}},"
        "{'id':'bite','type':'sphere','params':{'radius':0.5},"
        "'transform':{'translation':[0,0,1]}}]},"
        "{'id':'wall','type':'box','params':{'size':[1,1,0.1]},"
        "'transform':{'translation':[0,0,-3]}}]}}";
    struct pick_field *field = make_field(bitten);
    const struct pick_result hit = look_through(field, 320, 180),
                             floor = look_through(field, 320, 355),
                             miss = look_through(field, 5, 5), plain = look(field, 320, 180);

    (void)state;
    assert_through(&hit, "bite flesh wall ");
    assert_string_equal(hit.node, plain.node);
    assert_true(floor.hit);
    assert_through(&floor, "");
    assert_false(miss.hit);
    assert_through(&miss, "");
    assert_through(&plain, "");
    pick_field_unref(field);
}

/* Every node is left once for the one behind it: the first ones of them are told. */
static void a_pick_lists_so_many_nodes(void **state)
{
    char text[8192];
    int used = snprintf(text, sizeof text,
                        "{'format':'fieldcast/1',"
                        "'camera':{'position':[0,0,5],'target':[0,0,0]},"
                        "'root':{'id':'all','type':'union','children':[");

    (void)state;
    for (int i = 0; i < LIMIT_PICK_THROUGH + 3; i++) {
        used += snprintf(text + used, sizeof text - (size_t)used,
                         "%s{'id':'wall-%d','type':'box','params':{'size':[1,1,0.1]},"
                         "'transform':{'translation':[0,0,%d]}}",
                         i ? "," : "", i, -i);
    }
    snprintf(text + used, sizeof text - (size_t)used, "]}}");
    struct pick_field *field = make_field(text);
    const struct pick_result hit = look_through(field, 320, 180);

    assert_int_equal(hit.through_count, LIMIT_PICK_THROUGH);
    for (int i = 0; i < LIMIT_PICK_THROUGH; i++) {
        char id[24];

        snprintf(id, sizeof id, "wall-%d", i);
        assert_string_equal(hit.through[i], id);
    }
    pick_field_unref(field);
}

static void any_camera_can_pick(void **state)
{
    struct pick_field *field = make_field(ball);
    struct record camera;
    struct pick_question question = {
        .camera = &camera, .width = 100, .height = 100, .x = 50, .y = 50};

    (void)state;
    record_init(&camera, &camera_type);
    cJSON *json = json_text_parse("{'position':[0,0,9],'target':[0,0,0]}", NULL);
    assert_true(record_read(&camera, json, "/camera", NULL));
    cJSON_Delete(json);
    assert_true(fabs(pick_at(field, &question).distance - 8) < 1e-3);
    record_finish(&camera);
    pick_field_unref(field);
}

/* Repeats in repeats: more cells for one point than could be looked at in a lifetime. */
static void work_is_bounded(void **state)
{
    enum { LEVELS = 8 };
    char text[4096];
    size_t length = 0;

    (void)state;
    length += (size_t)snprintf(text, sizeof text,
                               "{'format':'fieldcast/1','camera':{'position':[0,1,5],"
                               "'target':[0,0,0]},'root':");
    for (int i = 0; i < LEVELS; i++) {
        length += (size_t)snprintf(text + length, sizeof text - length,
                                   "{'type':'repeat','params':{'count':[9,9,9]},"
                                   "'children':[");
    }
    length += (size_t)snprintf(text + length, sizeof text - length,
                               "{'id':'ball','type':'sphere','params':{'radius':2}}");
    for (int i = 0; i < LEVELS; i++) {
        length += (size_t)snprintf(text + length, sizeof text - length, "]}");
    }
    snprintf(text + length, sizeof text - length, "}");
    struct pick_field *field = make_field(text);
    assert_false(look(field, 320, 180).hit);
    pick_field_unref(field);
}

/* A shape of a box of half edges 0.5, 1 and 1.5 about (2, 0, 0), and one without an end. */
#define BOX                                                                                        \
    "{'id':'box','type':'box','params':{'size':[1,2,3]},'transform':{'translation':[2,0,0]}}"
#define BALL "{'id':'ball','type':'sphere','params':{'radius':0.1}}"
#define PLANE(id) "{'id':'" id "','type':'plane'}"
#define SCENE(root) "{'format':'fieldcast/1','root':" root "}"
#define JOIN(type, ...) "{'id':'" type "','type':'" type "','children':[" __VA_ARGS__ "]}"

static bool bounds_of(const char *text, double low[3], double high[3])
{
    struct error err = {0};
    struct scene *scene = json_text_scene(text, &err);

    assert_non_null(scene);
    const bool known = pick_bounds(scene, NULL, 0, low, high);
    scene_destroy(scene);
    return known;
}

static void bounds_leave_out_what_has_no_end(void **state)
{
    static const char *const texts[] = {
        SCENE(BOX),
        SCENE(JOIN("union", BOX "," PLANE("p"))),
        SCENE(JOIN("group", PLANE("p") "," JOIN("union", PLANE("q") "," BOX))),
        SCENE(JOIN("round", JOIN("difference", JOIN("union", BOX "," PLANE("p")) "," PLANE("q")))),
        SCENE(JOIN("union", BOX "," JOIN("repeat", PLANE("p")))),
        SCENE(JOIN("union", BOX "," JOIN("intersection", PLANE("p") "," PLANE("q")))),
    };

    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        const double rounded = i == 3 ? 0.05 : 0;
        double low[3], high[3];
        assert_true(bounds_of(texts[i], low, high));
        for (int axis = 0; axis < 3; axis++) {
            const double middle = axis == 0 ? 2 : 0, half = 0.5 * (axis + 1) + rounded;
            assert_float_equal(low[axis], middle - half, 1e-9);
            assert_float_equal(high[axis], middle + half, 1e-9);
        }
    }
}

/* What a plane bounds has an end, though the plane has none: the ball alone is smaller. */
static void bounds_hold_what_is_bounded(void **state)
{
    double low[3], high[3];

    (void)state;
    assert_true(bounds_of(SCENE(JOIN("intersection", JOIN("union", PLANE("p") "," BALL) "," BOX)),
                          low, high));
    assert_float_equal(high[0], 2.5, 1e-9);
    assert_float_equal(low[2], -1.5, 1e-9);
    assert_false(bounds_of(SCENE(PLANE("p")), low, high));
    assert_false(bounds_of(SCENE(JOIN("union", PLANE("p"))), low, high));
}

static void *ask_often(void *data)
{
    struct pick_field *field = data;

    for (int i = 0; i < 1000; i++) {
        struct pick_field *own = pick_field_ref(field);
        const bool hit = look(own, 320, 180).hit;

        pick_field_unref(own);
        if (!hit) {
            return data;
        }
    }
    pick_field_unref(field);
    return NULL;
}

/* The last reference may go in any thread. */
static void last_reference_may_go_in_any_thread(void **state)
{
    enum { THREADS = 4 };
    pthread_t threads[THREADS];
    struct pick_field *field = make_field(ball);

    (void)state;
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, ask_often, pick_field_ref(field)), 0);
    }
    pick_field_unref(field);
    for (int i = 0; i < THREADS; i++) {
        void *failed;

        pthread_join(threads[i], &failed);
        assert_null(failed);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(picks_hit_a_ball),
        cmocka_unit_test(picks_find_what_is_isolated),
        cmocka_unit_test(picks_find_what_is_cut),
        cmocka_unit_test(picks_hit_the_floor),
        cmocka_unit_test(a_pick_lists_so_many_nodes),
        cmocka_unit_test(picks_list_what_lies_behind),
        cmocka_unit_test(any_camera_can_pick),
        cmocka_unit_test(work_is_bounded),
        cmocka_unit_test(bounds_leave_out_what_has_no_end),
        cmocka_unit_test(bounds_hold_what_is_bounded),
        cmocka_unit_test(last_reference_may_go_in_any_thread),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
