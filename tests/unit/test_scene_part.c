/* SPDX-License-Identifier: MIT */
/* Parts of a scene as documents of their own: what they hold, and that parts that look the same
 * have the same text. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "protocol/scene.h"
#include "tests/support/json_text.h"

static const char DOCUMENT[] =
    "{'format':'fieldcast/1','camera':{'fov':30},'lights':[{'type':'directional'}],"
    "'primitives':{'rod':{'lipschitz':1,'code':'float sdf(vec3 p) { return length(p) - 1.0; }'}},"
    "'shaders':{'stripes':{'code':'vec3 shade(FragmentProperties q) { return vec3(1.0); }'}},"
    "'materials':{'snow':{'shader':'phong'},'coal':{'shader':'phong'},"
    "'striped':{'shader':'stripes'}},"
    "'models':{'pawn':{'id':'pawn-root','type':'field','params':{'primitive':'rod'}},"
    "'rook':{'id':'rook-root','type':'box'}},"
    "'root':{'id':'root','type':'union','material':'snow','children':["
    "{'id':'a','type':'sphere','name':'A','visible':false,'transform':{'translation':[1,2,3],"
    "'rotation':[1,0,0]}},"
    "{'id':'b','type':'sphere','transform':{'rotation':[1,0,0]}},"
    "{'id':'c','type':'group','material':'coal','children':[{'id':'d','type':'model',"
    "'params':{'model':'pawn'}},{'id':'e','type':'sphere','material':'striped',"
    "'visible':false},{'id':'f','type':'sphere','transform':{'translation':[9,0,0]}}]}]}}";

static struct scene *scene;

static char *text_of(const char *id, size_t most)
{
    cJSON *json = scene_part_of_node(scene, scene_find(scene, id), most);
    char *text = json ? json_print(json, false) : NULL;

    cJSON_Delete(json);
    return text;
}

static void assert_part(const char *id, const char *expected)
{
    char *text = text_of(id, 10);

    json_text_assert_equal(text, expected);
    free(text);
}

static void a_part_holds_what_it_uses_and_nothing_else(void **state)
{
    (void)state;
    assert_part("a", "{'format':'fieldcast/1','materials':{'snow':{'shader':'phong'}},"
                     "'root':{'type':'sphere','transform':{'rotation':[1,0,0]},"
                     "'material':'snow'}}");
    assert_part("c", "{'format':'fieldcast/1','primitives':{'rod':{'code':"
                     "'float sdf(vec3 p) { return length(p) - 1.0; }','lipschitz':1}},"
                     "'shaders':{'stripes':{'code':"
                     "'vec3 shade(FragmentProperties q) { return vec3(1.0); }'}},"
                     "'materials':{'coal':{'shader':'phong'},'striped':{'shader':'stripes'}},"
                     "'models':{'pawn':{'type':'field','params':{'primitive':'rod'}}},"
                     "'root':{'type':'group','material':'coal','children':["
                     "{'type':'model','params':{'model':'pawn'}},"
                     "{'type':'sphere','material':'striped','visible':false},"
                     "{'type':'sphere','transform':{'translation':[9,0,0]}}]}}");
    assert_part("f", "{'format':'fieldcast/1','materials':{'coal':{'shader':'phong'}},"
                     "'root':{'type':'sphere','material':'coal'}}");
}

static void parts_that_look_the_same_have_the_same_text(void **state)
{
    char *a = text_of("a", 1), *b = text_of("b", 1), *e = text_of("e", 1);

    (void)state;
    assert_string_equal(a, b);
    assert_string_not_equal(a, e);
    free(a);
    free(b);
    free(e);
}

static void models_count_among_the_nodes(void **state)
{
    char *text = text_of("c", 5);

    (void)state;
    assert_null(text_of("c", 4));
    assert_non_null(text);
    free(text);
}

static void parts_are_documents(void **state)
{
    struct error err = {0};

    (void)state;
    for (const struct node *node = scene->root; node; node = node_next(node, scene->root)) {
        cJSON *json = scene_part_of_node(scene, node, 10);
        struct scene *part = scene_read(json, &err);

        assert_non_null(part);
        scene_destroy(part);
        cJSON_Delete(json);
    }
}

static void a_material_is_shown_by_a_sphere(void **state)
{
    cJSON *json = scene_part_of_material(scene, resource_find(&scene->materials, "striped"));
    char *text = json_print(json, false);

    (void)state;
    json_text_assert_equal(text, "{'format':'fieldcast/1','shaders':{'stripes':{'code':"
                                 "'vec3 shade(FragmentProperties q) { return vec3(1.0); }'}},"
                                 "'materials':{'striped':{'shader':'stripes'}},"
                                 "'root':{'type':'sphere','material':'striped'}}");
    free(text);
    cJSON_Delete(json);
}

/* What their parameters set is found by its id. */
static void models_with_parameters_keep_ids(void **state)
{
    (void)state;
    static const char model[] = "'models':{'egg':{'params':[{'name':'size','type':'float',"
                                "'sets':'/nodes/yolk/params/radius','range':[0.1,1]}],"
                                "'root':{'id':'white','type':'group',%s'children':["
                                "{'id':'yolk','type':'sphere'}]}}},";
    static const char instance[] = "'type':'model','params':{'model':'egg','size':0.7}}}";
    char named[400], plain[400], text[700];
    struct error err = {0};

    snprintf(named, sizeof named, model, "'name':'White',");
    snprintf(plain, sizeof plain, model, "");
    snprintf(text, sizeof text, "{'format':'fieldcast/1',%s'root':{'id':'e',%s", named, instance);
    struct scene *whole = json_text_valid_scene(text);
    cJSON *json = scene_part_of_node(whole, scene_find(whole, "e"), 10);
    char *printed = json_print(json, false);
    snprintf(text, sizeof text, "{'format':'fieldcast/1',%s'root':{%s", plain, instance);
    json_text_assert_equal(printed, text);
    struct scene *part = scene_read(json, &err);
    assert_non_null(part);
    scene_destroy(part);
    free(printed);
    cJSON_Delete(json);
    scene_destroy(whole);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_part_holds_what_it_uses_and_nothing_else),
        cmocka_unit_test(parts_that_look_the_same_have_the_same_text),
        cmocka_unit_test(models_count_among_the_nodes),
        cmocka_unit_test(parts_are_documents),
        cmocka_unit_test(models_with_parameters_keep_ids),
        cmocka_unit_test(a_material_is_shown_by_a_sphere),
    };

    scene = json_text_valid_scene(DOCUMENT);
    const int failed = cmocka_run_group_tests_name("scene parts", tests, NULL, NULL);
    scene_destroy(scene);
    return failed;
}
