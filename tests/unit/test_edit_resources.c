/* SPDX-License-Identifier: MIT */
/* Edits of primitives, shaders and models, and of what uses them. */
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

static const char rich[] = "{'format':'fieldcast/1','primitives':{'rod':{'params':["
                           "{'name':'radius','type':'float','range':[0,9]},"
                           "{'name':'h','type':'vec2'}],'code':'one'},"
                           "'egg':{'params':[{'name':'h','type':'float'}]},'free':{}},"
                           "'shaders':{'marble':{'properties':[{'name':'tint','type':'color'},"
                           "{'name':'diffuse','type':'vec3'}]},'spare':{}},"
                           "'materials':{'veined':{'shader':'marble','properties':{'tint':[0,0,1],"
                           "'diffuse':[0.5,0.5,0.5]}}},"
                           "'models':{'pawn':{'id':'p','type':'union'},"
                           "'pair':{'id':'q','type':'union','children':["
                           "{'id':'q1','type':'model','params':{'model':'pawn'}}]},"
                           "'lone':{'id':'l','type':'box'}},"
                           "'root':{'id':'root','type':'union','children':["
                           "{'id':'f','type':'field','params':{'primitive':'rod','lipschitz':2,"
                           "'radius':0.7,'h':[1,2]}},"
                           "{'id':'g','type':'field','params':{'code':'two'}},"
                           "{'id':'i','type':'model','params':{'model':'pair'}},"
                           "{'id':'j','type':'model'}]}}";

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

static void values_of_resources(void **state)
{
    (void)state;
    edits_assert(scene,
                 "[{'op':'set','at':'/primitives/rod/code','value':'three\\n'},"
                 "{'op':'set','at':'/primitives/rod/lipschitz','value':3},"
                 "{'op':'set','at':'/primitives/rod/size','value':[1,2,3]},"
                 "{'op':'set','at':'/primitives/rod/doc','value':'D.'},"
                 "{'op':'set','at':'/shaders/marble/code','value':'four'},"
                 "{'op':'set','at':'/shaders/marble/lighting','value':'unlit'},"
                 "{'op':'set','at':'/shaders/marble/doc','value':'D.'},"
                 "{'op':'set','at':'/materials/veined/properties/tint',"
                 "'value':[1,0,0]},"
                 "{'op':'set','at':'/nodes/f/params/radius','value':3},"
                 "{'op':'set','at':'/nodes/g/params/code','value':''},"
                 "{'op':'set','at':'/nodes/q1/transform/scale','value':[2,2,2]}]",
                 NULL, NULL);
    edits_assert_fails(scene, "[{'op':'set','at':'/nodes/f/params/radius','value':10}]",
                       ERROR_INVALID, "/nodes/f/params/radius", "10 is above the maximum 9");
    edits_assert_fails(scene, "[{'op':'set','at':'/nodes/f/params/radios','value':1}]",
                       ERROR_INVALID, "/nodes/f/params/radios",
                       "rod has no member \"radios\"; did you mean \"radius\"?");
    edits_assert_fails(scene, "[{'op':'set','at':'/models/pawn/type','value':'box'}]",
                       ERROR_INVALID, "/models/pawn/type", "model has no member \"type\"");
    edits_assert_fails(scene, "[{'op':'set','at':'/primitives/rod','value':{}}]", ERROR_NOT_FOUND,
                       "/primitives/rod", "there is nothing to set at this place");
}

/* Values go over by name; what does not fit is lost, and comes back. */
static void rows_convert_their_users(void **state)
{
    (void)state;
    edits_assert(scene,
                 "[{'op':'set','at':'/primitives/rod/params','value':["
                 "{'name':'h','type':'float2'},{'name':'radius','type':'float',"
                 "'default':0.1,'range':[0,0.5]},{'name':'n','type':'int'}]}]",
                 "[{'op':'set','at':'/primitives/rod/params','value':["
                 "{'name':'h','type':'vec2'},{'name':'radius','type':'float',"
                 "'default':0.1,'range':[0,0.5]},{'name':'n','type':'int'}]}]",
                 "[{'op':'set','at':'/primitives/rod/params','value':["
                 "{'name':'radius','type':'float','range':[0,9]},"
                 "{'name':'h','type':'vec2'}]},"
                 "{'op':'set','at':'/nodes/f/params/radius','value':0.7}]");
    edits_assert(scene, "[{'op':'set','at':'/shaders/marble/properties','value':null}]", NULL,
                 "[{'op':'set','at':'/shaders/marble/properties','value':["
                 "{'name':'tint','type':'color'},{'name':'diffuse','type':'vec3'}]},"
                 "{'op':'set','at':'/materials/veined/properties/tint','value':[0,0,1]},"
                 "{'op':'set','at':'/materials/veined/properties/diffuse',"
                 "'value':[0.5,0.5,0.5]}]");
    edits_apply(scene, "[{'op':'set','at':'/primitives/rod/params','value':["
                       "{'name':'radius','type':'float'},"
                       "{'name':'h','type':'vec3','default':[7,8,9]}]}]");
    assert_number("f", "radius", 0.7);
    assert_number("f", "h", 7);
    assert_number("f", "lipschitz", 2);
    edits_assert_fails(scene,
                       "[{'op':'set','at':'/primitives/rod/params','value':["
                       "{'name':'code','type':'float'}]}]",
                       ERROR_INVALID, "/primitives/rod/params/0/name",
                       "every field has a \"code\" already");
    edits_apply(scene, "[{'op':'set','at':'/shaders/spare/properties','value':["
                       "{'name':'code','type':'float'}]}]");
}

static void other_primitives(void **state)
{
    (void)state;
    edits_assert(scene, "[{'op':'set','at':'/nodes/f/params/primitive','value':'egg'}]", NULL,
                 "[{'op':'set','at':'/nodes/f/params/primitive','value':'rod'},"
                 "{'op':'set','at':'/nodes/f/params/radius','value':0.7},"
                 "{'op':'set','at':'/nodes/f/params/h','value':[1,2]}]");
    edits_assert(scene,
                 "[{'op':'set','at':'/nodes/g/params/primitive','value':'rod'},"
                 "{'op':'set','at':'/nodes/g/params/radius','value':2},"
                 "{'op':'set','at':'/nodes/f/params/primitive','value':null}]",
                 NULL, NULL);
    /* radius is what a sphere has too, but not the step on the way back, a field alone */
    edits_assert(scene, "[{'op':'set','at':'/nodes/f/type','value':'sphere'}]", NULL,
                 "[{'op':'set','at':'/nodes/f/type','value':'field'},"
                 "{'op':'set','at':'/nodes/f/params/primitive','value':'rod'},"
                 "{'op':'set','at':'/nodes/f/params/lipschitz','value':2},"
                 "{'op':'set','at':'/nodes/f/params/radius','value':0.7},"
                 "{'op':'set','at':'/nodes/f/params/h','value':[1,2]}]");
    edits_assert(scene, "[{'op':'set','at':'/nodes/f/type','value':'field'}]", NULL,
                 "[{'op':'set','at':'/nodes/f/type','value':'field'}]");
    edits_apply(scene, "[{'op':'set','at':'/nodes/f/type','value':'field'}]");
    assert_number("f", "radius", 0.7);
    edits_apply(scene, "[{'op':'set','at':'/nodes/f/type','value':'sphere'},"
                       "{'op':'remove','at':'/primitives/rod'}]");
    assert_number("f", "radius", 0.7);
    edits_assert_fails(scene, "[{'op':'set','at':'/nodes/g/params/primitive','value':'rod'}]",
                       ERROR_INVALID, "/nodes/g/params/primitive", "there is no primitive \"rod\"");
}

static void other_shaders(void **state)
{
    (void)state;
    edits_assert(scene, "[{'op':'set','at':'/materials/veined/shader','value':'phong'}]", NULL,
                 "[{'op':'set','at':'/materials/veined/shader','value':'marble'},"
                 "{'op':'set','at':'/materials/veined/properties/tint',"
                 "'value':[0,0,1]}]");
    edits_apply(scene, "[{'op':'set','at':'/materials/veined/shader','value':'spare'},"
                       "{'op':'remove','at':'/shaders/marble'}]");
    assert_int_equal(resource_find(&scene->shaders, "spare")->users, 1);
    edits_assert_fails(scene, "[{'op':'remove','at':'/shaders/spare'}]", ERROR_CONFLICT,
                       "/shaders/spare", "is used by 1 material");
    edits_assert_fails(scene, "[{'op':'set','at':'/materials/veined/shader','value':'spore'}]",
                       ERROR_INVALID, "/materials/veined/shader",
                       "unknown shader \"spore\"; did you mean \"spare\"?");
}

static void primitives_and_models_come_and_go(void **state)
{
    (void)state;
    edits_assert(scene,
                 "[{'op':'insert','into':'/primitives','before':'egg',"
                 "'name':'cup','value':{'params':[{'name':'h','type':'int'}]}},"
                 "{'op':'insert','into':'/nodes/root','before':null,'value':{"
                 "'id':'c','type':'field','params':{'primitive':'cup','h':3}}}]",
                 NULL,
                 "[{'op':'remove','at':'/nodes/c'},"
                 "{'op':'remove','at':'/primitives/cup'}]");
    edits_assert(scene,
                 "[{'op':'insert','into':'/models','before':null,'name':'trio',"
                 "'value':{'type':'union','children':[{'type':'model',"
                 "'params':{'model':'pair'}}]}},"
                 "{'op':'set','at':'/nodes/j/params/model','value':'trio'}]",
                 "[{'op':'insert','into':'/models','before':null,'name':'trio',"
                 "'value':{'id':'union-1','type':'union','children':[{"
                 "'id':'model-1','type':'model','params':{'model':'pair'}}]}},"
                 "{'op':'set','at':'/nodes/j/params/model','value':'trio'}]",
                 "[{'op':'set','at':'/nodes/j/params/model','value':null},"
                 "{'op':'remove','at':'/models/trio'}]");
    edits_assert(scene,
                 "[{'op':'remove','at':'/nodes/i'},"
                 "{'op':'remove','at':'/models/pair'},"
                 "{'op':'remove','at':'/models/pawn'}]",
                 NULL, NULL);
    edits_assert(scene,
                 "[{'op':'move','at':'/models/lone','into':'/models',"
                 "'before':'pawn'},{'op':'move','at':'/shaders/marble',"
                 "'into':'/shaders','before':null}]",
                 NULL, NULL);
    edits_assert(scene,
                 "[{'op':'insert','into':'/nodes/p','before':null,'value':{"
                 "'id':'knob','type':'sphere'}},{'op':'move','at':'/nodes/g',"
                 "'into':'/nodes/knob','before':null}]",
                 NULL, NULL);
}

static void what_is_used_stays(void **state)
{
    (void)state;
    edits_assert_fails(scene, "[{'op':'remove','at':'/primitives/rod'}]", ERROR_CONFLICT,
                       "/primitives/rod", "is used by 1 node");
    edits_assert_fails(scene, "[{'op':'remove','at':'/models/pawn'}]", ERROR_CONFLICT,
                       "/models/pawn", "is used by 1 node");
    edits_assert_fails(scene, "[{'op':'remove','at':'/nodes/p'}]", ERROR_CONFLICT, "/nodes/p",
                       "the root of a model cannot be removed");
    edits_assert_fails(scene, "[{'op':'move','at':'/nodes/p','into':'/nodes/root'}]",
                       ERROR_CONFLICT, "/nodes/p", "the root of a model cannot be moved");
    edits_assert_fails(scene, "[{'op':'insert','into':'/shaders','name':'phong','value':{}}]",
                       ERROR_CONFLICT, "/shaders/phong", "\"phong\" is a built-in shader");
    edits_assert_fails(scene,
                       "[{'op':'insert','into':'/models','name':'pawn','value':{"
                       "'type':'box'}}]",
                       ERROR_CONFLICT, "/models/pawn", "the name \"pawn\" is in use");
    edits_assert_fails(scene, "[{'op':'insert','into':'/primitives','value':{}}]", ERROR_INVALID,
                       "/primitives", "the name of the primitive is missing");
    edits_assert_fails(scene,
                       "[{'op':'insert','into':'/nodes/p','value':{'id':'n',"
                       "'type':'model','params':{'model':'prawn'}}}]",
                       ERROR_INVALID, "/nodes/n/params/model",
                       "there is no model \"prawn\"; did you mean \"pawn\"?");
}

/* By each operation that could close one. */
static void no_circles(void **state)
{
    (void)state;
    static const char circle[] = "models in a circle: /models/pawn -> /models/pair -> /models/pawn";

    edits_assert_fails(scene,
                       "[{'op':'insert','into':'/nodes/p','value':{'type':'group',"
                       "'children':[{'type':'model','params':{'model':'pair'}}]}}]",
                       ERROR_CONFLICT, "/nodes/p", circle);
    edits_assert_fails(scene, "[{'op':'move','at':'/nodes/i','into':'/nodes/p'}]", ERROR_CONFLICT,
                       "/nodes/i", circle);
    edits_assert_fails(scene,
                       "[{'op':'move','at':'/nodes/j','into':'/nodes/p'},"
                       "{'op':'set','at':'/nodes/j/params/model','value':'pair'}]",
                       ERROR_CONFLICT, "/nodes/j/params/model", circle);
    edits_assert_fails(scene,
                       "[{'op':'insert','into':'/models','name':'self','value':{"
                       "'type':'model','params':{'model':'self'}}}]",
                       ERROR_CONFLICT, "/models",
                       "models in a circle: /models/self -> /models/self");
    /* what would close one is fine once the other half is gone */
    edits_apply(scene, "[{'op':'set','at':'/nodes/q1/params/model','value':null},"
                       "{'op':'move','at':'/nodes/i','into':'/nodes/p'}]");
    edits_assert_fails(scene, "[{'op':'set','at':'/nodes/q1/params/model','value':'pawn'}]",
                       ERROR_CONFLICT, "/nodes/q1/params/model", circle);
}

/* The tree that it should have left is as high among the models as before. */
static void a_refused_move_between_models_leaves_no_circle(void **state)
{
    (void)state;
    edits_apply(scene, "[{'op':'move','at':'/models/lone','before':'pawn'},"
                       "{'op':'insert','into':'/nodes/l','value':{'id':'n','type':'model',"
                       "'params':{'model':'pair'}}}]");
    edits_assert_fails(scene, "[{'op':'move','at':'/nodes/n','into':'/nodes/p'}]", ERROR_CONFLICT,
                       "/nodes/n",
                       "models in a circle: /models/pawn -> /models/pair -> /models/pawn");
    edits_assert_fails(scene,
                       "[{'op':'insert','into':'/nodes/q','value':{'type':'model',"
                       "'params':{'model':'lone'}}}]",
                       ERROR_CONFLICT, "/nodes/q",
                       "models in a circle: /models/lone -> /models/pair -> /models/lone");
}

/* As many as allowed, and one more. */
static void counts_hold_in_edits(void **state)
{
    (void)state;
    static const struct {
        const char *list, *value;
        size_t limit, there;
    } lists[] = {{"primitives", "{}", LIMIT_PRIMITIVES, 3},
                 {"shaders", "{}", LIMIT_SHADERS, 2},
                 {"models", "{'type':'box'}", LIMIT_MODELS, 3}};
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++) {
        char text[200], place[40], message[80];
        for (size_t n = lists[i].there; n <= lists[i].limit; n++) {
            snprintf(text, sizeof text, "[{'op':'insert','into':'/%s','name':'n%zu','value':%s}]",
                     lists[i].list, n, lists[i].value);
            if (n < lists[i].limit) {
                edits_apply(scene, text);
            }
        }
        snprintf(place, sizeof place, "/%s", lists[i].list);
        snprintf(message, sizeof message, "%zu %s are above the maximum %zu", lists[i].limit + 1,
                 lists[i].list, lists[i].limit);
        edits_assert_fails(scene, text, ERROR_LIMIT, place, message);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(values_of_resources, set_up, tear_down),
        cmocka_unit_test_setup_teardown(rows_convert_their_users, set_up, tear_down),
        cmocka_unit_test_setup_teardown(other_primitives, set_up, tear_down),
        cmocka_unit_test_setup_teardown(other_shaders, set_up, tear_down),
        cmocka_unit_test_setup_teardown(primitives_and_models_come_and_go, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_is_used_stays, set_up, tear_down),
        cmocka_unit_test_setup_teardown(no_circles, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_refused_move_between_models_leaves_no_circle, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(counts_hold_in_edits, set_up, tear_down),
    };

    return cmocka_run_group_tests_name("edit_resources", tests, NULL, NULL);
}
