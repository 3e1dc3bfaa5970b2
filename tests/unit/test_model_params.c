/* SPDX-License-Identifier: MIT */
/* Parameters of models: read, printed, set by instances, refused, and kept while what they set is
 * edited. */
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
#include "tests/support/random_scene.h"

#define HEAD                                                                                       \
    "{'format':'fieldcast/1','primitives':{'rod':{'params':[{'name':'wide','type':'float'}]}},"
#define TREE                                                                                       \
    "{'id':'top','type':'union','children':["                                                      \
    "{'id':'body','type':'box','params':{'size':[1,2,3]},'transform':{'scale':2}},"                \
    "{'id':'rod','type':'field','params':{'primitive':'rod','wide':0.5}},"                         \
    "{'id':'face','type':'plane'}]}"
#define ROWS                                                                                       \
    "[{'name':'high','type':'float','sets':'/nodes/body/params/size.y','range':[0.5,4]},"          \
    "{'name':'size','type':'float','sets':'/nodes/body/transform/scale','range':[1,2]},"           \
    "{'name':'wide','type':'float','sets':'/nodes/rod/params/wide','doc':'Across.'}]"
#define ROOT                                                                                       \
    "'root':{'id':'root','type':'union','children':["                                              \
    "{'id':'a','type':'model','params':{'model':'pawn','high':3}},"                                \
    "{'id':'b','type':'model','params':{'model':'pawn'}},{'id':'c','type':'model'}]}}"

/* 'pair' names 'pawn', which comes behind it. */
static const char rich[] =
    HEAD "'models':{'pair':{'params':[{'name':'both','type':'float',"
         "'sets':'/nodes/first/params/high','range':[1,2]}],'root':{'id':'first','type':'model',"
         "'params':{'model':'pawn','wide':0.7}}},"
         "'pawn':{'params':" ROWS ",'root':" TREE "}}," ROOT;

static struct scene *scene;

static int set_up(void **state)
{
    (void)state;
    scene = json_text_scene(rich, NULL);
    return scene ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    scene_destroy(scene);
    return 0;
}

static void assert_number(const char *id, const char *param, double expected)
{
    assert_float_equal(record_number(&scene_find(scene, id)->params, param), expected, 0);
}

static void documents_keep_them(void **state)
{
    (void)state;
    char *text = scene_print(scene, false);
    struct scene *copy = scene_copy(scene);
    char *again = scene_print(copy, false);

    assert_number("a", "high", 3);
    assert_number("first", "wide", 0.7);
    assert_string_equal(text, again);
    char *part = json_text("'models':{'pair':{'params':[{'name':'both','type':'float',"
                           "'sets':'/nodes/first/params/high','range':[1,2]}],"
                           "'root':{'id':'first'");
    assert_non_null(strstr(text, part));
    free(part);
    scene_destroy(copy);
    free(text);
    free(again);
}

static void targets(void **state)
{
    (void)state;
    const struct resource *pawn = resource_find(&scene->models, "pawn");
    const struct model_target high = model_target_of(scene, pawn, pawn->declared->first_declared);
    const struct model_target size =
        model_target_of(scene, pawn, pawn->declared->first_declared + 1);
    const struct param row = {.type = PARAM_FLOAT};
    const struct value three = {.number = {3}};
    struct value out = {.number = {1, 1, 1}};

    assert_ptr_equal(high.node, scene_find(scene, "body"));
    assert_int_equal(high.component, 1);
    assert_false(high.of_transform);
    model_target_put(&high, &row, &three, &out);
    assert_true(out.set && out.number[0] == 1 && out.number[1] == 3 && out.number[2] == 1);
    assert_true(size.of_transform);
    assert_int_equal(size.component, -1);
    model_target_put(&size, &row, &three, &out);
    assert_true(out.number[0] == 3 && out.number[1] == 3 && out.number[2] == 3);
}

static void instances_set_them(void **state)
{
    (void)state;
    edits_assert(scene, "[{'op':'set','at':'/nodes/b/params/high','value':2.5}]", NULL,
                 "[{'op':'set','at':'/nodes/b/params/high','value':null}]");
    edits_assert(scene,
                 "[{'op':'set','at':'/nodes/c/params/model','value':'pawn'},"
                 "{'op':'set','at':'/nodes/c/params/wide','value':9}]",
                 NULL, NULL);
    edits_assert(scene, "[{'op':'set','at':'/nodes/a/params/model','value':'pair'}]", NULL,
                 "[{'op':'set','at':'/nodes/a/params/model','value':'pawn'},"
                 "{'op':'set','at':'/nodes/a/params/high','value':3}]");
    edits_assert_fails(scene, "[{'op':'set','at':'/nodes/a/params/high','value':5}]", ERROR_INVALID,
                       "/nodes/a/params/high", "5 is above the maximum 4");
    edits_assert_fails(scene, "[{'op':'set','at':'/nodes/a/params/hihg','value':1}]", ERROR_INVALID,
                       "/nodes/a/params/hihg",
                       "pawn has no member \"hihg\"; did you mean \"high\"?");
    edits_assert_fails(scene, "[{'op':'set','at':'/nodes/c/params/high','value':1}]", ERROR_INVALID,
                       "/nodes/c/params/high", "model has no member \"high\"");
}

static void rows_convert_instances(void **state)
{
    (void)state;
    edits_assert(scene,
                 "[{'op':'set','at':'/nodes/first/params/high','value':1.5},"
                 "{'op':'set','at':'/models/pair/params','value':null},"
                 "{'op':'set','at':'/models/pawn/params','value':[]}]",
                 NULL, NULL);
    edits_apply(scene, "[{'op':'set','at':'/models/pawn/params','value':["
                       "{'name':'high','type':'float','sets':'/nodes/body/params/size.y',"
                       "'range':[0.5,2]}]}]");
    assert_false(record_is_set(&scene_find(scene, "a")->params, "high"));
    edits_apply(scene, "[{'op':'insert','into':'/models','before':null,'name':'more','value':"
                       "{'params':[{'name':'r','type':'float','sets':'/nodes/o/params/radius',"
                       "'range':[1,2]}],'root':{'id':'o','type':'sphere'}}},"
                       "{'op':'insert','into':'/nodes/root','before':null,'value':"
                       "{'id':'x','type':'model','params':{'model':'more','r':2}}}]");
    assert_number("x", "r", 2);
    edits_apply(scene, "[{'op':'remove','at':'/nodes/x'},{'op':'remove','at':'/models/more'}]");
}

/* Rows of pawn, with another range of the first. */
#define NARROWED(range)                                                                            \
    "{'op':'set','at':'/models/pawn/params','value':["                                             \
    "{'name':'high','type':'float','sets':'/nodes/body/params/size.y','range':" range "}]}"

/* "both" of pair sets "high" of its instance of pawn. */
static void a_range_narrows(void **state)
{
    (void)state;
    const char *outer = "{'op':'set','at':'/models/pair/params','value':[{'name':'both',"
                        "'type':'float','sets':'/nodes/first/params/high','range':[1,1.5]}]}";
    char both[512];

    edits_apply(scene, "[{'op':'set','at':'/nodes/first/params/high','value':1.8},"
                       "{'op':'set','at':'/nodes/c/params/model','value':'pair'},"
                       "{'op':'set','at':'/nodes/c/params/both','value':1.7}]");
    edits_assert_fails(scene, "[" NARROWED("[0.5,1.5]") "]", ERROR_CONFLICT, "/models/pawn/params",
                       "the parameter \"both\" of /models/pair sets /nodes/first/params/high");
    assert_number("first", "high", 1.8);
    assert_number("c", "both", 1.7);
    snprintf(both, sizeof both, "[%s,%s]", outer, NARROWED("[0.5,1.5]"));
    edits_apply(scene, both);
    assert_false(record_is_set(&scene_find(scene, "a")->params, "high"));
    assert_false(record_is_set(&scene_find(scene, "first")->params, "high"));
    assert_false(record_is_set(&scene_find(scene, "c")->params, "both"));
}

/* A document, and where it is wrong. */
static void assert_refused(const char *rows, const char *place, const char *message)
{
    char text[2048];
    struct error err = {0};

    snprintf(text, sizeof text,
             HEAD "'models':{'pawn':{'params':[%s],'root':" TREE "}},"
                  "'root':{'type':'sphere'}}",
             rows);
    struct scene *wrong = json_text_scene(text, &err);
    assert_null(wrong);
    assert_string_equal(err.place, place);
    assert_string_equal(err.message, message);
}

static void wrong_rows(void **state)
{
    (void)state;
    static const struct {
        const char *row, *member, *message;
    } rows[] = {
        {"'type':'float'", "sets",
         "is missing, expected a place such as \"/nodes/ID/params/radius\""},
        {"'type':'float','sets':7", "sets", "expected a text"},
        {"'type':'float','sets':'/nodes/body/params/size.y','default':1", "default",
         "what a model's tree has is the default"},
        {"'type':'float','sets':'/body/params/size.y'", "sets",
         "\"/body/params/size.y\" is not a place such as \"/nodes/ID/params/radius\""},
        {"'type':'float','sets':'/nodes/body/params/size.yy'", "sets",
         "\"/nodes/body/params/size.yy\" is not a place such as \"/nodes/ID/params/radius\""},
        {"'type':'float','sets':'/nodes/bode/params/size.y'", "sets",
         "the model has no node \"bode\""},
        {"'type':'float','sets':'/nodes/body/params/siz'", "sets",
         "the node has no number \"params/siz\""},
        {"'type':'float','sets':'/nodes/body/params/size'", "sets",
         "a float cannot set /nodes/body/params/size, which is a vec3"},
        {"'type':'int','sets':'/nodes/body/params/size.y'", "sets",
         "a int cannot set /nodes/body/params/size.y, which is a vec3"},
        {"'type':'float','sets':'/nodes/rod/params/primitive'", "sets",
         "a float cannot set /nodes/rod/params/primitive, which is a function"},
        {"'type':'float','sets':'/nodes/body/params/size.y'", "range",
         "leaves that of /nodes/body/params/size.y: above 0, to 1000000"},
        {"'type':'float','sets':'/nodes/body/transform/scale','range':[-1,1]", "range",
         "leaves that of /nodes/body/transform/scale: -1000000 to 1000000, without 0"},
        {"'type':'vec3','sets':'/nodes/face/params/normal'", "range",
         "leaves that of /nodes/face/params/normal: -1000000 to 1000000, without 0"},
    };
    char row[512], place[64];

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        snprintf(row, sizeof row, "{'name':'n',%s}", rows[i].row);
        snprintf(place, sizeof place, "/models/pawn/params/0/%s", rows[i].member);
        assert_refused(row, place, rows[i].message);
    }
    assert_refused("{'name':'n','type':'float','sets':'/nodes/rod/params/wide'},"
                   "{'name':'m','type':'float','sets':'/nodes/rod/params/wide'}",
                   "/models/pawn/params/1/sets", "another parameter sets /nodes/rod/params/wide");
    edits_assert_fails(scene,
                       "[{'op':'set','at':'/primitives/rod/params','value':"
                       "[{'name':'wide','type':'float','sets':'/nodes/a'}]}]",
                       ERROR_INVALID, "/primitives/rod/params/0/sets",
                       "only a parameter of a model sets something");
    edits_assert_fails(scene,
                       "[{'op':'set','at':'/models/pawn/params','value':"
                       "[{'name':'x','type':'vec3','sets':'/nodes/root/transform/translation'}]}]",
                       ERROR_INVALID, "/models/pawn/params/0/sets",
                       "the model has no node \"root\"");
}

#define USED(name, sets) "the parameter \"" name "\" of /models/pawn sets " sets

static void what_is_set_stays(void **state)
{
    (void)state;
    edits_assert_fails(scene, "[{'op':'remove','at':'/nodes/body'}]", ERROR_CONFLICT, "/nodes/body",
                       USED("high", "/nodes/body/params/size.y"));
    edits_assert_fails(scene, "[{'op':'move','at':'/nodes/rod','into':'/nodes/root'}]",
                       ERROR_CONFLICT, "/nodes/rod", USED("wide", "/nodes/rod/params/wide"));
    edits_assert_fails(scene, "[{'op':'set','at':'/nodes/body/type','value':'sphere'}]",
                       ERROR_CONFLICT, "/nodes/body/type",
                       USED("high", "/nodes/body/params/size.y"));
    edits_assert_fails(scene, "[{'op':'set','at':'/nodes/rod/params/primitive','value':null}]",
                       ERROR_CONFLICT, "/nodes/rod/params/primitive",
                       USED("wide", "/nodes/rod/params/wide"));
    edits_assert_fails(scene, "[{'op':'set','at':'/primitives/rod/params','value':[]}]",
                       ERROR_CONFLICT, "/primitives/rod/params",
                       USED("wide", "/nodes/rod/params/wide"));
    edits_assert_fails(scene, "[{'op':'set','at':'/models/pawn/params','value':[]}]",
                       ERROR_CONFLICT, "/models/pawn/params",
                       "the parameter \"both\" of /models/pair sets /nodes/first/params/high");
    edits_assert(scene,
                 "[{'op':'set','at':'/nodes/body/type','value':'round_box'},"
                 "{'op':'set','at':'/nodes/body/type','value':'box'}]",
                 NULL, NULL);
    edits_assert(scene,
                 "[{'op':'remove','at':'/nodes/face'},"
                 "{'op':'set','at':'/models/pawn/params','value':["
                 "{'name':'high','type':'float','sets':'/nodes/body/params/size.y',"
                 "'range':[0.5,4]}]},{'op':'remove','at':'/nodes/rod'}]",
                 NULL, NULL);
}

/* A node whose primitive or model declares what a parameter sets. */
static const char declaring[] =
    "{'format':'fieldcast/1','primitives':{"
    "'rod':{'params':[{'name':'radius','type':'float','range':[0,10]}]},"
    "'bare':{}},'models':{"
    "'inner':{'params':[{'name':'radius','type':'float','sets':'/nodes/core/params/radius',"
    "'range':[0.1,9]}],'root':{'id':'core','type':'sphere'}},"
    "'outer':{'params':[{'name':'r','type':'float','sets':'/nodes/body/params/radius',"
    "'range':[0.1,5]},{'name':'s','type':'float','sets':'/nodes/shell/params/radius',"
    "'range':[0.1,5]}],'root':{'id':'top','type':'union','children':["
    "{'id':'body','type':'field','params':{'primitive':'rod','radius':0.3}},"
    "{'id':'shell','type':'model','params':{'model':'inner','radius':0.7}}]}}},"
    "'root':{'id':'root','type':'union','children':["
    "{'id':'a','type':'model','params':{'model':'outer','r':2}}]}}";

static int set_up_declaring(void **state)
{
    (void)state;
    scene = json_text_scene(declaring, NULL);
    return scene ? 0 : -1;
}

#define SET(place, value) "{'op':'set','at':'/nodes/" place "','value':" value "}"
#define BODY_BACK                                                                                  \
    SET("body/type", "'field'")                                                                    \
    "," SET("body/params/primitive", "'rod'") "," SET("body/params/radius", "0.3")
#define SHELL_BACK                                                                                 \
    SET("shell/type", "'model'")                                                                   \
    "," SET("shell/params/model", "'inner'") "," SET("shell/params/radius", "0.7")

static void types_that_name_come_back(void **state)
{
    (void)state;
    edits_assert(scene, "[" SET("body/type", "'sphere'") "]", NULL, "[" BODY_BACK "]");
    edits_assert(scene, "[" SET("shell/type", "'sphere'") "]", NULL, "[" SHELL_BACK "]");
    edits_assert_fails(scene,
                       "[" SET("body/type", "'sphere'") "," SET(
                           "shell/type", "'sphere'") ","
                                                     "{'op':'remove','at':'/nodes/nope'}]",
                       ERROR_NOT_FOUND, "/nodes/nope", "there is no node \"nope\"");
    edits_assert(scene,
                 "[" SET("body/type", "'sphere'") "," BODY_BACK "," SET(
                     "shell/type", "'sphere'") "," SHELL_BACK "," SET("body/type", "'sphere'") "]",
                 NULL, NULL);
}

static void types_with_names_that_do_not_serve(void **state)
{
    (void)state;
    edits_apply(scene, "[" SET("body/type", "'sphere'") "," SET("shell/type", "'sphere'") "]");
    static const struct {
        const char *node, *type, *naming;
    } rows[] = {
        {"body", "field", SET("body/params/primitive", "'bare'")},
        {"body", "field", SET("body/params/primitive", "'none'")},
        {"body", "field", SET("body/params/primitive", "null")},
        {"body", "field", SET("body/params/code", "'rod'")},
        {"body", "field", SET("shell/params/primitive", "'rod'")},
        {"shell", "model", SET("shell/params/model", "'outer'")},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char edit[512], place[64], message[128];
        const bool shell = strcmp(rows[i].node, "shell") == 0;
        snprintf(edit, sizeof edit, "[{'op':'set','at':'/nodes/%s/type','value':'%s'},%s]",
                 rows[i].node, rows[i].type, rows[i].naming);
        snprintf(place, sizeof place, "/nodes/%s/type", rows[i].node);
        snprintf(message, sizeof message,
                 "the parameter \"%s\" of /models/outer sets /nodes/%s/params/radius",
                 shell ? "s" : "r", rows[i].node);
        edits_assert_fails(scene, edit, ERROR_CONFLICT, place, message);
    }
}

/* Undo leaves out what no longer applies: nothing here. */
static void types_that_name_are_undone(void **state)
{
    (void)state;
    static const char *const edits[] = {"[" SET("body/type", "'sphere'") "]",
                                        "[" SET("shell/type", "'sphere'") "]"};
    char *before = scene_print(scene, false);

    for (size_t i = 0; i < sizeof edits / sizeof edits[0]; i++) {
        struct history *history = history_create();
        cJSON *ops = edits_parse(edits[i]), *inverse = NULL, *applied = NULL;
        assert_true(edit_apply(scene, ops, &applied, &inverse, NULL));
        history_record(history, &(struct history_entry){.kind = HISTORY_EDIT,
                                                        .author = "a",
                                                        .applied = applied,
                                                        .inverse = inverse});
        for (int turn = 0; turn < 3; turn++) {
            assert_true(history_undo(history, scene, "a", NULL, NULL));
            char *after = scene_print(scene, false);
            assert_string_equal(after, before);
            free(after);
            assert_true(history_redo(history, scene, "a", NULL, NULL));
        }
        assert_true(history_undo(history, scene, "a", NULL, NULL));
        cJSON_Delete(ops);
        cJSON_Delete(applied);
        history_destroy(history);
    }
    free(before);
}

/* Whatever edits of these do together, their inverse takes back; what is refused leaves nothing. */
static void mixed_edits_come_back(void **state)
{
    (void)state;
    static const char *const ops[] = {
        SET("body/type", "'sphere'"),
        SET("body/type", "'field'"),
        SET("body/type", "'model'"),
        SET("body/params/primitive", "'rod'"),
        SET("body/params/primitive", "'bare'"),
        SET("body/params/model", "'inner'"),
        SET("body/params/radius", "0.4"),
        SET("shell/type", "'field'"),
        SET("shell/type", "'model'"),
        SET("shell/params/model", "'inner'"),
        SET("shell/params/model", "'outer'"),
        SET("shell/params/primitive", "'rod'"),
        "{'op':'set','at':'/models/outer/params','value':[]}",
        "{'op':'set','at':'/primitives/rod/params','value':[]}",
        "{'op':'remove','at':'/nodes/nope'}",
    };
    struct random random = {1};
    int applied = 0;

    for (int i = 0; i < 4000; i++) {
        char text[1024] = "[", *before = scene_print(scene, false);
        const int count = 1 + (int)random_below(&random, 5);
        for (int k = 0; k < count; k++) {
            const size_t used = strlen(text),
                         which = random_below(&random, sizeof ops / sizeof *ops);
            snprintf(text + used, sizeof text - used, "%s%s", ops[which],
                     k + 1 < count ? "," : "]");
        }
        cJSON *edit = edits_parse(text), *inverse = NULL;
        if (edit_apply(scene, edit, NULL, &inverse, NULL)) {
            assert_true(edit_apply(scene, inverse, NULL, NULL, NULL));
            cJSON_Delete(inverse);
            applied++;
        }
        char *after = scene_print(scene, false);
        assert_string_equal(after, before);
        free(after);
        free(before);
        cJSON_Delete(edit);
    }
    assert_true(applied > 400);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(documents_keep_them, set_up, tear_down),
        cmocka_unit_test_setup_teardown(targets, set_up, tear_down),
        cmocka_unit_test_setup_teardown(instances_set_them, set_up, tear_down),
        cmocka_unit_test_setup_teardown(rows_convert_instances, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_range_narrows, set_up, tear_down),
        cmocka_unit_test_setup_teardown(wrong_rows, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_is_set_stays, set_up, tear_down),
        cmocka_unit_test_setup_teardown(types_that_name_come_back, set_up_declaring, tear_down),
        cmocka_unit_test_setup_teardown(types_with_names_that_do_not_serve, set_up_declaring,
                                        tear_down),
        cmocka_unit_test_setup_teardown(types_that_name_are_undone, set_up_declaring, tear_down),
        cmocka_unit_test_setup_teardown(mixed_edits_come_back, set_up_declaring, tear_down),
    };

    return cmocka_run_group_tests_name("parameters of models", tests, NULL, NULL);
}
