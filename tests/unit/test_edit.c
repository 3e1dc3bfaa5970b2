/* SPDX-License-Identifier: MIT */
/* Edits: all or none, exact inverses, canonical forms, refusals. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/limits.h"
#include "tests/support/edits.h"
#include "tests/support/json_text.h"

static const char base[] = "{'format':'fieldcast/1','materials':{'snow':{'shader':'phong'},"
                           "'coal':{'shader':'phong'},'wood':{'shader':'phong'}},"
                           "'lights':[{'id':'sun','type':'directional','intensity':3},"
                           "{'id':'lamp','type':'point'}],"
                           "'root':{'id':'root','type':'union','children':["
                           "{'id':'body','type':'sphere','material':'snow','params':{'radius':1}},"
                           "{'id':'neck','type':'group','children':["
                           "{'id':'head','type':'sphere'},{'id':'hat','type':'cone'}]},"
                           "{'id':'stick','type':'capsule'}]}}";

static struct scene *scene;
static struct error err;

static int set_up(void **state)
{
    (void)state;
    scene = json_text_scene(base, &err);
    return scene ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    scene_destroy(scene);
    return 0;
}

static void set_values(void **state)
{
    (void)state;
    edits_assert(scene, "[{'op':'set','at':'/nodes/body/params/radius','value':1.2}]", NULL,
                 "[{'op':'set','at':'/nodes/body/params/radius','value':1}]");
    edits_assert(scene, "[{'op':'set','at':'/nodes/head/params/radius','value':0.5}]", NULL,
                 "[{'op':'set','at':'/nodes/head/params/radius','value':null}]");
    edits_assert(scene, "[{'op':'set','at':'/nodes/body/params/radius','value':null}]", NULL,
                 "[{'op':'set','at':'/nodes/body/params/radius','value':1}]");
    edits_assert(scene, "[{'op':'set','at':'/name','value':'Winter'}]", NULL,
                 "[{'op':'set','at':'/name','value':null}]");
    edits_assert(scene, "[{'op':'set','at':'/nodes/body/transform/scale','value':2}]",
                 "[{'op':'set','at':'/nodes/body/transform/scale','value':[2,2,2]}]", NULL);
    edits_assert(scene,
                 "[{'op':'set','at':'/nodes/body/material','value':'coal'},"
                 "{'op':'set','at':'/nodes/body/visible','value':false},"
                 "{'op':'set','at':'/nodes/body/name','value':'B'}]",
                 NULL, NULL);
    edits_assert(scene,
                 "[{'op':'set','at':'/camera/fov','value':30},"
                 "{'op':'set','at':'/environment/type','value':'solid'},"
                 "{'op':'set','at':'/render/samples','value':4},"
                 "{'op':'set','at':'/lights/sun/shadow','value':'hard'},"
                 "{'op':'set','at':'/materials/snow/properties/shininess','value':8}]",
                 NULL, NULL);
}

static void set_whole_records(void **state)
{
    (void)state;
    edits_assert(scene,
                 "[{'op':'set','at':'/camera','value':{'fov':30}},"
                 "{'op':'set','at':'/camera','value':{'up':[0,0,1]}}]",
                 NULL,
                 "[{'op':'set','at':'/camera','value':{'fov':30}},"
                 "{'op':'set','at':'/camera','value':{}}]");
    edits_assert(scene, "[{'op':'set','at':'/nodes/hat/transform','value':{'scale':3}}]",
                 "[{'op':'set','at':'/nodes/hat/transform','value':{'scale':[3,3,3]}}]", NULL);
    edits_assert(scene, "[{'op':'set','at':'/render','value':null}]",
                 "[{'op':'set','at':'/render','value':{}}]", NULL);
}

static void types_keep_what_fits(void **state)
{
    (void)state;
    edits_assert(scene, "[{'op':'set','at':'/nodes/body/type','value':'cylinder'}]", NULL,
                 "[{'op':'set','at':'/nodes/body/type','value':'sphere'}]");
    edits_assert(scene, "[{'op':'set','at':'/nodes/body/type','value':'box'}]", NULL,
                 "[{'op':'set','at':'/nodes/body/type','value':'sphere'},"
                 "{'op':'set','at':'/nodes/body/params/radius','value':1}]");
    edits_assert(scene, "[{'op':'set','at':'/lights/sun/type','value':'point'}]", NULL, NULL);
    edits_assert(scene, "[{'op':'set','at':'/materials/snow/shader','value':'phong'}]", NULL, NULL);
    cJSON *ops = edits_parse("[{'op':'set','at':'/nodes/body/type','value':'torus'}]");
    assert_true(edit_apply(scene, ops, NULL, NULL, &err));
    assert_float_equal(record_number(&scene_find(scene, "body")->params, "radius"), 1, 0);
    cJSON_Delete(ops);
}

static void nodes_come_and_go(void **state)
{
    (void)state;
    edits_assert(scene,
                 "[{'op':'insert','into':'/nodes/neck','before':'hat',"
                 "'value':{'type':'box'}}]",
                 "[{'op':'insert','into':'/nodes/neck','before':'hat',"
                 "'value':{'id':'box-1','type':'box'}}]",
                 "[{'op':'remove','at':'/nodes/box-1'}]");
    edits_assert(scene, "[{'op':'remove','at':'/nodes/neck'}]", NULL,
                 "[{'op':'insert','into':'/nodes/root','before':'stick',"
                 "'value':{'id':'neck','type':'group','children':["
                 "{'id':'head','type':'sphere'},{'id':'hat','type':'cone'}]}}]");
    edits_assert(scene,
                 "[{'op':'move','at':'/nodes/stick','into':'/nodes/neck',"
                 "'before':'head'}]",
                 NULL,
                 "[{'op':'move','at':'/nodes/stick','into':'/nodes/root',"
                 "'before':null}]");
    edits_assert(scene,
                 "[{'op':'move','at':'/nodes/body','into':'/nodes/root',"
                 "'before':'stick'},"
                 "{'op':'move','at':'/nodes/stick','into':'/nodes/root',"
                 "'before':'neck'}]",
                 NULL, NULL);
}

static void resources_come_and_go(void **state)
{
    (void)state;
    edits_assert(scene,
                 "[{'op':'insert','into':'/materials','before':'coal',"
                 "'name':'ice','value':{'shader':'phong'}},"
                 "{'op':'set','at':'/nodes/hat/material','value':'ice'}]",
                 NULL,
                 "[{'op':'set','at':'/nodes/hat/material','value':null},"
                 "{'op':'remove','at':'/materials/ice'}]");
    edits_assert(scene, "[{'op':'remove','at':'/materials/coal'}]", NULL,
                 "[{'op':'insert','into':'/materials','before':'wood',"
                 "'name':'coal','value':{'shader':'phong'}}]");
    edits_assert(scene,
                 "[{'op':'insert','into':'/lights','before':'sun',"
                 "'value':{'type':'point','range':3}}]",
                 "[{'op':'insert','into':'/lights','before':'sun',"
                 "'value':{'id':'point-1','type':'point','range':3}}]",
                 NULL);
    edits_assert(scene, "[{'op':'remove','at':'/lights/sun'}]", NULL, NULL);
    edits_assert(scene, "[{'op':'move','at':'/materials/wood','before':'snow'}]",
                 "[{'op':'move','at':'/materials/wood','into':'/materials',"
                 "'before':'snow'}]",
                 NULL);
    edits_assert(scene, "[{'op':'move','at':'/lights/sun','into':'/lights','before':null}]", NULL,
                 NULL);
}

static void all_or_none(void **state)
{
    (void)state;
    char *before = scene_print(scene, false);
    cJSON *ops = edits_parse("[{'op':'remove','at':'/nodes/neck'},"
                             "{'op':'set','at':'/nodes/body/type','value':'box'},"
                             "{'op':'remove','at':'/materials/coal'},"
                             "{'op':'set','at':'/nodes/hat/params/height','value':2}]");
    cJSON *applied = NULL, *inverse = NULL;

    assert_false(edit_apply(scene, ops, &applied, &inverse, &err));
    assert_int_equal(err.kind, ERROR_NOT_FOUND);
    assert_string_equal(err.place, "/nodes/hat/params/height");
    assert_null(applied);
    assert_null(inverse);
    char *after = scene_print(scene, false);
    assert_string_equal(after, before);
    assert_int_equal(scene->node_count, 6);
    free(before);
    free(after);
    cJSON_Delete(ops);
}

static void some_leaves_out_what_is_gone(void **state)
{
    (void)state;
    cJSON *ops = edits_parse("[{'op':'set','at':'/nodes/nobody/params/radius','value':1},"
                             "{'op':'insert','into':'/nodes/root','before':'nobody',"
                             "'value':{'type':'box'}}]");
    cJSON *applied;

    assert_true(edit_apply_some(scene, ops, &applied, NULL, &err));
    edits_assert_prints(applied, "[{'op':'insert','into':'/nodes/root','before':null,"
                                 "'value':{'id':'box-1','type':'box'}}]");
    cJSON_DeleteItemFromArray(ops, 1);
    assert_false(edit_apply_some(scene, ops, &applied, NULL, &err));
    assert_int_equal(err.kind, ERROR_NOT_FOUND);
    cJSON_Delete(ops);
}

static void ids_are_not_used_again(void **state)
{
    (void)state;
    cJSON *ops = edits_parse("[{'op':'insert','into':'/nodes/root','value':{'type':'box'}},"
                             "{'op':'remove','at':'/nodes/box-1'},"
                             "{'op':'insert','into':'/nodes/root','value':{'type':'box'}}]");

    assert_true(edit_apply(scene, ops, NULL, NULL, &err));
    assert_null(scene_find(scene, "box-1"));
    assert_non_null(scene_find(scene, "box-2"));
    cJSON_Delete(ops);
}

static void insert_chain(const char *into, int levels, bool ok)
{
    cJSON *ops = cJSON_CreateArray(), *op = cJSON_CreateObject(), *value = cJSON_CreateObject();

    cJSON_AddStringToObject(value, "type", "group");
    for (int i = 1; i < levels; i++) {
        cJSON *outer = cJSON_CreateObject();
        cJSON_AddStringToObject(outer, "type", "group");
        cJSON_AddItemToArray(cJSON_AddArrayToObject(outer, "children"), value);
        value = outer;
    }
    cJSON_AddStringToObject(op, "op", "insert");
    cJSON_AddStringToObject(op, "into", into);
    cJSON_AddItemToObject(op, "value", value);
    cJSON_AddItemToArray(ops, op);
    assert_int_equal(edit_apply(scene, ops, NULL, NULL, &err), ok);
    cJSON_Delete(ops);
}

static void depth_holds_in_edits(void **state)
{
    (void)state;
    insert_chain("/nodes/root", LIMIT_NODE_DEPTH, false);
    assert_int_equal(err.kind, ERROR_LIMIT);
    assert_string_equal(err.place, "/nodes/root");
    assert_string_equal(err.message, "65 levels of nodes are above the maximum 64");
    insert_chain("/nodes/root", LIMIT_NODE_DEPTH - 1, true);
    cJSON *ops = edits_parse("[{'op':'move','at':'/nodes/group-1','into':'/nodes/neck'}]");
    assert_false(edit_apply(scene, ops, NULL, NULL, &err));
    assert_int_equal(err.kind, ERROR_LIMIT);
    cJSON_Delete(ops);
}

static cJSON *many_inserts(int count, const char *into)
{
    cJSON *ops = cJSON_CreateArray();

    for (int i = 0; i < count; i++) {
        cJSON *op = cJSON_CreateObject();
        cJSON_AddStringToObject(op, "op", "insert");
        cJSON_AddStringToObject(op, "into", into);
        cJSON *value = cJSON_AddObjectToObject(op, "value");
        cJSON_AddStringToObject(value, "type", strcmp(into, "/lights") ? "sphere" : "point");
        cJSON_AddItemToArray(ops, op);
    }
    return ops;
}

static void counts_hold_in_edits(void **state)
{
    (void)state;
    cJSON *ops = many_inserts(LIMIT_OPERATIONS, "/nodes/head");

    assert_true(edit_check(ops, &err));
    assert_true(edit_apply(scene, ops, NULL, NULL, &err));
    assert_false(edit_apply(scene, ops, NULL, NULL, &err));
    assert_string_equal(err.place, "/nodes/head");
    assert_string_equal(err.message, "10001 children are above the maximum 10000");
    cJSON_AddItemToArray(ops, cJSON_CreateObject());
    assert_false(edit_check(ops, &err));
    assert_string_equal(err.message, "10001 operations are above the maximum 10000");
    cJSON_Delete(ops);

    ops = many_inserts(LIMIT_LIGHTS - 1, "/lights");
    assert_false(edit_apply(scene, ops, NULL, NULL, &err));
    assert_string_equal(err.message, "17 lights are above the maximum 16");
    assert_int_equal(scene->lights.count, 2);
    cJSON_Delete(ops);
}

static size_t weight_of(const char *text, size_t most)
{
    cJSON *ops = edits_parse(text);
    const size_t weight = edit_weight(scene, ops, most);

    cJSON_Delete(ops);
    return weight;
}

static void weight_of_one_operation(void **state)
{
    (void)state;
    assert_int_equal(weight_of("[{'op':'set','at':'/nodes/body/params/radius','value':2}]", 99), 2);
    assert_int_equal(weight_of("[{'op':'remove','at':'/nodes/neck'}]", 99), 1 + 3);
    assert_int_equal(weight_of("[{'op':'insert','into':'/nodes/root','value':{'type':'group',"
                               "'children':[{'type':'sphere'},{'type':'box'}]}}]",
                               99),
                     1 + 2 + 1 + 2 * 2);
    edits_apply(scene, "[{'op':'insert','into':'/primitives','name':'ball','value':{'code':"
                       "'float sdf(vec3 p) { return length(p) - 1.0; }'}},"
                       "{'op':'insert','into':'/models','name':'pair','value':"
                       "{'type':'union','children':[{'type':'sphere'},{'type':'box'}]}}]");
    assert_int_equal(weight_of("[{'op':'set','at':'/primitives/ball/params','value':[]}]", 99),
                     2 + scene->node_count);
    assert_int_equal(weight_of("[{'op':'remove','at':'/models/pair'}]", 99), 1 + 3);
    assert_int_equal(weight_of("[{'op':'set','at':'/nodes/body/params/model','value':'pair'}]", 99),
                     2 + scene->node_count);
}

/* Long texts take as long as many values. */
static void weight_counts_texts_by_their_length(void **state)
{
    char ops[2000];

    (void)state;
    snprintf(ops, sizeof ops, "[{'op':'set','at':'/name','value':'%01000d'}]", 0);
    assert_in_range(weight_of(ops, 99), 2 + 3, 2 + 4);
}

/* What is removed together with a new group was moved there. */
static void weight_counts_what_is_moved(void **state)
{
    (void)state;
    assert_int_equal(weight_of("[{'op':'insert','into':'/nodes/root','value':{'id':'bin',"
                               "'type':'group'}},"
                               "{'op':'move','at':'/nodes/neck','into':'/nodes/bin'},"
                               "{'op':'remove','at':'/nodes/bin'}]",
                               99),
                     3 + 3 + 3);
}

#define BRING(id, into, type)                                                                      \
    "{'op':'insert','into':'" into "','value':{'id':'" id "','type':'group','children':["          \
    "{'type':'" type "'}]}}"
#define MOVE(id, into) "{'op':'move','at':'/nodes/" id "','into':'/nodes/" into "'}"

/* An instance that comes into a model is followed through all models. */
static void weight_counts_instances_in_models(void **state)
{
    (void)state;
    edits_apply(scene, "[{'op':'insert','into':'/models','name':'pair','value':"
                       "{'id':'pair-root','type':'union','children':[{'type':'sphere'}]}},"
                       "{'op':'insert','into':'/models','name':'one','value':{'type':'box'}},"
                       "{'op':'insert','into':'/nodes/root','value':"
                       "{'id':'it','type':'model','params':{'model':'one'}}}]");
    const size_t all = scene->node_count;
    const struct {
        const char *ops;
        size_t own; /* without what is followed */
        size_t times;
    } rows[] = {
        {"[" BRING("g", "/nodes/pair-root", "sphere") "]", 7, 0},
        {"[" BRING("g", "/nodes/root", "model") "]", 7, 0},
        {"[" BRING("g", "/nodes/pair-root", "model") "]", 7, 1},
        {"[{'op':'insert','into':'/models','name':'m','value':{'type':'model'}}]", 3, 1},
        {"[" MOVE("it", "root") "]", 2, 0},
        {"[" MOVE("it", "pair-root") "]", 2, 1},
        {"[" MOVE("neck", "pair-root") "]", 4, 0},
        {"[" MOVE("it", "neck") "," MOVE("neck", "pair-root") "]", 6, 1},
        {"[" BRING("g", "/nodes/pair-root", "sphere") "," MOVE("it", "g") "]", 9, 1},
        {"[" BRING("g", "/nodes/root", "model") "," MOVE("g", "pair-root") "]", 8, 1},
        {"[{'op':'set','at':'/nodes/body/params/model','value':'one'}," MOVE("body",
                                                                             "pair-root") "]",
         4, 2},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const size_t weight = weight_of(rows[i].ops, 999);
        if (weight != rows[i].own + rows[i].times * all) {
            fail_msg("row %zu: %zu instead of %zu and %zu times %zu", i, weight, rows[i].own,
                     rows[i].times, all);
        }
    }
}

static void weight_stops_at_most(void **state)
{
    (void)state;
    cJSON *ops = many_inserts(LIMIT_OPERATIONS, "/nodes/head");

    assert_in_range(edit_weight(scene, ops, 500), 501, 510);
    cJSON_Delete(ops);
    assert_int_equal(edit_weight(scene, NULL, 500), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(set_values, set_up, tear_down),
        cmocka_unit_test_setup_teardown(set_whole_records, set_up, tear_down),
        cmocka_unit_test_setup_teardown(types_keep_what_fits, set_up, tear_down),
        cmocka_unit_test_setup_teardown(nodes_come_and_go, set_up, tear_down),
        cmocka_unit_test_setup_teardown(resources_come_and_go, set_up, tear_down),
        cmocka_unit_test_setup_teardown(all_or_none, set_up, tear_down),
        cmocka_unit_test_setup_teardown(some_leaves_out_what_is_gone, set_up, tear_down),
        cmocka_unit_test_setup_teardown(ids_are_not_used_again, set_up, tear_down),
        cmocka_unit_test_setup_teardown(depth_holds_in_edits, set_up, tear_down),
        cmocka_unit_test_setup_teardown(counts_hold_in_edits, set_up, tear_down),
        cmocka_unit_test_setup_teardown(weight_of_one_operation, set_up, tear_down),
        cmocka_unit_test_setup_teardown(weight_counts_texts_by_their_length, set_up, tear_down),
        cmocka_unit_test_setup_teardown(weight_counts_what_is_moved, set_up, tear_down),
        cmocka_unit_test_setup_teardown(weight_counts_instances_in_models, set_up, tear_down),
        cmocka_unit_test_setup_teardown(weight_stops_at_most, set_up, tear_down),
    };

    return cmocka_run_group_tests_name("edit", tests, NULL, NULL);
}
