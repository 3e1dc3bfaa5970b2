/* SPDX-License-Identifier: MIT */
/* Documents: read strictly, printed so that they read back the same, limits of the tree. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "protocol/limits.h"
#include "protocol/memory.h"
#include "protocol/scene.h"
#include "tests/support/json_text.h"
#include "tests/support/random_edit.h"

enum { DOCUMENTS = 300, DAMAGED = 1500, EACH = 5 }; /* damaged from one */

static struct error err;

static void assert_prints(const char *text, const char *expected)
{
    struct scene *scene = json_text_valid_scene(text);
    char *printed = scene_print(scene, false);

    json_text_assert_equal(printed, expected);
    free(printed);
    scene_destroy(scene);
}

static void assert_refused(const char *text, enum error_kind kind, const char *place)
{
    assert_null(json_text_scene(text, &err));
    assert_int_equal(err.kind, kind);
    assert_string_equal(err.place, place);
}

#define DOC(members) "{'format':'fieldcast/1'," members "}"
#define ROOT(members) DOC("'root':{'id':'root','type':'union'" members "}")

static void prints_what_is_set(void **state)
{
    (void)state;
    assert_prints(ROOT(""), ROOT(""));
    assert_prints(DOC("'shaders':{},'models':{},'primitives':{},'camera':{},'lights':[],"
                      "'materials':{},'environment':{},'render':{},'root':{'type':'union',"
                      "'children':[],'params':{},'transform':{}}"),
                  DOC("'root':{'id':'union-1','type':'union'}"));
    assert_prints(DOC("'root':{'children':[{'params':{'tube':0.1,'radius':2},'visible':false,"
                      "'name':'Ring','type':'torus','id':'a','transform':{'scale':2,"
                      "'translation':[0,1,0]}}],'type':'union'},'render':{'samples':1},'name':'N'"),
                  DOC("'name':'N','render':{'samples':1},'root':{'id':'union-1','type':'union',"
                      "'children':[{'id':'a','type':'torus','name':'Ring','visible':false,"
                      "'transform':{'translation':[0,1,0],'scale':[2,2,2]},'params':{'radius':2,"
                      "'tube':0.1}}]}"));
}

static void missing_ids_avoid_given_ones(void **state)
{
    (void)state;
    assert_prints(ROOT(",'children':[{'type':'box'},{'type':'box'},{'id':'box-1','type':'sphere',"
                       "'children':[{'type':'box'}]}]"),
                  ROOT(",'children':[{'id':'box-2','type':'box'},{'id':'box-3','type':'box'},"
                       "{'id':'box-1','type':'sphere','children':[{'id':'box-4','type':'box'}]}]"));
    assert_prints(DOC("'lights':[{'type':'point'},{'id':'point-2','type':'point'},"
                      "{'type':'point'}],'root':{'id':'r','type':'box'}"),
                  DOC("'lights':[{'id':'point-1','type':'point'},{'id':'point-2','type':'point'},"
                      "{'id':'point-3','type':'point'}],'root':{'id':'r','type':'box'}"));
}

static void places_name_what_is_wrong(void **state)
{
    (void)state;
    assert_refused(ROOT(",'children':[{'type':'box'},{'type':'sphere',"
                        "'children':[{'type':'sphere','params':{'radius':-1}}]}]"),
                   ERROR_INVALID, "/nodes/root/children/1/children/0/params/radius");
    assert_refused(ROOT(",'children':[{'id':'body','type':'sphere','children':[{'type':'sphere',"
                        "'colour':1}]}]"),
                   ERROR_INVALID, "/nodes/body/children/0/colour");
    assert_refused(ROOT(",'children':[{'type':'box','id':'root'}]"), ERROR_CONFLICT, "/nodes/root");
    assert_refused(ROOT(",'children':[{'type':'box','id':'b','material':'gold'}]"), ERROR_INVALID,
                   "/nodes/b/material");
    assert_string_equal(err.message, "there is no material \"gold\"");
    assert_refused(DOC("'root':{'type':'sphre'}"), ERROR_INVALID, "/root/type");
    assert_string_equal(err.message, "unknown type \"sphre\"; did you mean \"sphere\"?");
    assert_refused(DOC("'lights':[{'type':'point'},{'type':'point','size':0}]"), ERROR_INVALID,
                   "/lights/1/size");
    assert_refused(DOC("'lights':[{'id':'a','type':'point'},{'id':'a','type':'point'}]"),
                   ERROR_CONFLICT, "/lights/a");
    assert_refused(DOC("'materials':{'m':{'shader':'phong','properties':{'x':1}}}"), ERROR_INVALID,
                   "/materials/m/properties/x");
    assert_refused(DOC("'materials':{'a b':{'shader':'phong'}}"), ERROR_INVALID, "/materials/a b");
    assert_refused(DOC("'name':1"), ERROR_INVALID, "/name");
    assert_refused(DOC("'shaders':[]"), ERROR_INVALID, "/shaders");
    assert_string_equal(err.message, "expected an object of shaders");
    assert_refused(DOC("'lights':{}"), ERROR_INVALID, "/lights");
    assert_string_equal(err.message, "expected an array of lights");
    assert_refused("{'format':'fieldcast/2'}", ERROR_INVALID, "/format");
    assert_refused("{}", ERROR_INVALID, "/format");
    assert_refused("[]", ERROR_INVALID, "");
    assert_refused("{'format':'fieldcast/1'}", ERROR_INVALID, "/root");
    assert_refused("{'format'", ERROR_SYNTAX, "line 1, column 10");
}

/* A document with every kind of resource, in the order in which it is printed. */
#define PRIMITIVE                                                                                  \
    "'rod':{'params':[{'name':'r','type':'float','default':0.5,'range':[0,9]},{'name':'h',"        \
    "'type':'vec2','doc':'H.'}],'code':'float sdf(vec3 p)\\n{...}','lipschitz':2,'size':[1,2,3],"  \
    "'doc':'A rod.'}"
#define SHADER                                                                                     \
    "'marble':{'properties':[{'name':'tint','type':'color','default':[1,1,1]},{'name':'blend',"    \
    "'type':'float'}],'code':'vec3 shade()','lighting':'unlit'}"
#define MODELS                                                                                     \
    "'king':{'id':'k','type':'union','children':[{'id':'k1','type':'model',"                       \
    "'params':{'model':'pawn'}}]},'pawn':{'id':'p','type':'sphere','material':'m'}"
#define EVERYTHING                                                                                 \
    DOC("'lights':[{'id':'sun','type':'directional'}],'primitives':{" PRIMITIVE                    \
        "},'shaders':{" SHADER                                                                     \
        "},'materials':{'m':{'shader':'marble','properties':{'blend':0.2}},"                       \
        "'n':{'shader':'phong'}},'models':{" MODELS "},'root':{'id':'root','type':'union',"        \
        "'children':[{'id':'f','type':'field','params':{'primitive':'rod','r':0.7}},"              \
        "{'id':'g','type':'field','params':{'code':'float sdf(vec3 p)'}},"                         \
        "{'id':'i','type':'model','material':'n','params':{'model':'king'}}]}")

static void resources_of_every_kind(void **state)
{
    (void)state;
    assert_prints(EVERYTHING, EVERYTHING);
    struct scene *read = json_text_valid_scene(EVERYTHING), *copy = scene_copy(read);
    scene_destroy(read); /* a copy shares nothing */
    const struct node *field = scene_find(copy, "f");
    const struct resource *rod = resource_find(&copy->primitives, "rod");
    const struct resource *marble = resource_find(&copy->shaders, "marble");
    const struct resource *veined = resource_find(&copy->materials, "m");
    const struct resource *king = resource_find(&copy->models, "king");
    const struct resource *pawn = resource_find(&copy->models, "pawn");
    assert_ptr_equal(node_primitive(copy, field), rod);
    assert_ptr_equal(field->params.type, &rod->declared->type);
    assert_int_equal(rod->declared->first_declared, record_type_count(&field->type->record));
    assert_float_equal(record_number(&field->params, "r"), 0.7, 0);
    assert_float_equal(record_vector(&field->params, "h")[1], 0, 0);
    assert_null(node_primitive(copy, scene_find(copy, "g")));
    assert_ptr_equal(scene_find(copy, "g")->params.type, &field->type->record);
    assert_ptr_equal(veined->shader, marble);
    assert_ptr_equal(veined->record.type, &marble->declared->type);
    assert_null(resource_find(&copy->materials, "n")->shader);
    assert_ptr_equal(node_model(copy, scene_find(copy, "i")), king);
    assert_ptr_equal(node_model(copy, scene_find(copy, "k1")), pawn);
    assert_ptr_equal(node_owner(scene_find(copy, "k1")), king);
    assert_ptr_equal(king->root, scene_find(copy, "k"));
    assert_null(scene_find(copy, "k")->parent);
    assert_null(node_owner(field));
    assert_int_equal(copy->node_count, 7);
    assert_int_equal(rod->users, 1);
    assert_int_equal(marble->users, 1);
    assert_int_equal(veined->users, 1);
    assert_int_equal(king->users, 1);
    assert_int_equal(pawn->users, 1);
    scene_destroy(copy);
}

/* What is named may stand anywhere in the document. */
static void order_of_members_does_not_matter(void **state)
{
    (void)state;
    cJSON *json = json_text_parse(EVERYTHING, &err), *backwards = cJSON_CreateObject();

    while (json->child) {
        cJSON *last = cJSON_DetachItemViaPointer(json, json->child->prev);
        cJSON_AddItemToObject(backwards, last->string, last);
    }
    char *text = json_print(backwards, false);
    assert_prints(text, EVERYTHING);
    free(text);
    cJSON_Delete(json);
    cJSON_Delete(backwards);
}

static void ids_are_shared_by_all_trees(void **state)
{
    (void)state;
    assert_prints(DOC("'models':{'a':{'type':'box'},'b':{'type':'box'}},'root':{'type':'union',"
                      "'children':[{'type':'box'},{'id':'box-1','type':'box'}]}"),
                  DOC("'models':{'a':{'id':'box-2','type':'box'},'b':{'id':'box-3',"
                      "'type':'box'}},'root':{'id':'union-1','type':'union',"
                      "'children':[{'id':'box-4','type':'box'},{'id':'box-1','type':'box'}]}"));
    assert_refused(DOC("'models':{'a':{'id':'x','type':'box'}},'root':{'id':'x','type':'box'}"),
                   ERROR_CONFLICT, "/nodes/x");
}

#define MODEL(name, names)                                                                         \
    "'" name "':{'id':'" name "','type':'model','params':{'model':'" names "'}}"

static void models_in_a_circle(void **state)
{
    (void)state;
    static const char root[] = ",'root':{'type':'union'}";
    char text[400];

    snprintf(text, sizeof text, DOC("'models':{" MODEL("a", "a") "}%s"), root);
    assert_refused(text, ERROR_CONFLICT, "/models");
    assert_string_equal(err.message, "models in a circle: /models/a -> /models/a");
    snprintf(text, sizeof text,
             DOC("'models':{" MODEL("d", "a") "," MODEL("a", "b") "," MODEL("b", "c") "," MODEL(
                 "c", "a") "}%s"),
             root);
    assert_refused(text, ERROR_CONFLICT, "/models");
    assert_string_equal(err.message,
                        "models in a circle: /models/a -> /models/b -> /models/c -> /models/a");
    snprintf(text, sizeof text,
             DOC("'models':{" MODEL("a", "b") "," MODEL("b", "c") "," MODEL("c", "") "}%s"), root);
    scene_destroy(json_text_valid_scene(text));
}

/* `levels` groups, one in the other. */
static char *nested(size_t levels)
{
    static const char head[] = "{'format':'fieldcast/1','root':";
    char *text = malloc(levels * 40 + 100), *at = text;

    assert_non_null(text);
    at += sprintf(at, "%s", head);
    for (size_t i = 1; i < levels; i++) {
        at += sprintf(at, "{'type':'group','children':[");
    }
    at += sprintf(at, "{'type':'group'}");
    for (size_t i = 1; i < levels; i++) {
        at += sprintf(at, "]}");
    }
    strcpy(at, "}");
    return text;
}

/* `parents` groups with `children` spheres each. */
static char *wide(size_t parents, size_t children)
{
    char *text = malloc(parents * (children * 20 + 60) + 100), *at = text;

    assert_non_null(text);
    at += sprintf(at, "{'format':'fieldcast/1','root':{'type':'union','children':[");
    for (size_t i = 0; i < parents; i++) {
        at += sprintf(at, "%s{'type':'group','children':[", i ? "," : "");
        for (size_t j = 0; j < children; j++) {
            at += sprintf(at, "%s{'type':'sphere'}", j ? "," : "");
        }
        at += sprintf(at, "]}");
    }
    strcpy(at, "]}}");
    return text;
}

static void assert_limit(char *text, size_t nodes, const char *message)
{
    struct scene *scene = json_text_scene(text, &err);

    free(text);
    if (message) {
        assert_null(scene);
        assert_int_equal(err.kind, ERROR_LIMIT);
        assert_string_equal(err.message, message);
    } else {
        assert_non_null(scene);
        assert_int_equal(scene->node_count, nodes);
        scene_destroy(scene);
    }
}

static void limits_of_the_tree(void **state)
{
    (void)state;
    assert_limit(nested(LIMIT_NODE_DEPTH), LIMIT_NODE_DEPTH, NULL);
    assert_limit(nested(LIMIT_NODE_DEPTH + 1), 0, "65 levels of nodes are above the maximum 64");
    assert_limit(wide(1, LIMIT_CHILDREN), LIMIT_CHILDREN + 2, NULL);
    assert_limit(wide(1, LIMIT_CHILDREN + 1), 0, "more children than the maximum 10000");
    assert_limit(wide(11, 9089), 99991, NULL);
    assert_limit(wide(11, 9090), 0, "more nodes than the maximum 100000");
}

/* `count` of the list, each `value`. */
static char *listed(const char *list, size_t count, const char *value)
{
    const bool array = strcmp(list, "lights") == 0 || strcmp(list, "volumes") == 0;
    char *text = malloc(count * (strlen(value) + 20) + 200), *at = text;

    assert_non_null(text);
    at += sprintf(at, "{'format':'fieldcast/1','%s':%c", list, array ? '[' : '{');
    for (size_t i = 0; i < count; i++) {
        at += sprintf(at, i ? "," : "");
        at += array ? sprintf(at, "%s", value) : sprintf(at, "'n%zu':%s", i, value);
    }
    sprintf(at, "%c,'root':{'type':'union'}}", array ? ']' : '}');
    return text;
}

static void limits_of_lists(void **state)
{
    (void)state;
    static const struct {
        const char *list, *value;
        size_t limit, nodes; /* nodes of each */
    } lists[] = {
        {"lights", "{'type':'point'}", LIMIT_LIGHTS, 0},
        {"volumes", "{'type':'sphere'}", LIMIT_VOLUMES, 0},
        {"primitives", "{}", LIMIT_PRIMITIVES, 0},
        {"shaders", "{}", LIMIT_SHADERS, 0},
        {"materials", "{'shader':'phong'}", LIMIT_MATERIALS, 0},
        {"models", "{'type':'box'}", LIMIT_MODELS, 1},
    };
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++) {
        char message[80];
        snprintf(message, sizeof message, "more %s than the maximum %zu", lists[i].list,
                 lists[i].limit);
        assert_limit(listed(lists[i].list, lists[i].limit, lists[i].value),
                     1 + lists[i].limit * lists[i].nodes, NULL);
        assert_limit(listed(lists[i].list, lists[i].limit + 1, lists[i].value), 0, message);
    }
}

/* The tree of `document`, which is freed, as the only model beside a root with `children`. */
static char *beside(char *document, size_t children)
{
    static const char root[] = "'root':";
    char *tree = strstr(document, root) + strlen(root);
    char *text = malloc(strlen(tree) + children * 20 + 100), *at = text;

    assert_non_null(text);
    at += sprintf(at, "{'format':'fieldcast/1','root':{'type':'union','children':[");
    for (size_t i = 0; i < children; i++) {
        at += sprintf(at, "%s{'type':'sphere'}", i ? "," : "");
    }
    sprintf(at, "]},'models':{'m':%s}", tree);
    free(document);
    return text;
}

static void limits_hold_in_models(void **state)
{
    (void)state;
    assert_limit(beside(nested(LIMIT_NODE_DEPTH), 0), LIMIT_NODE_DEPTH + 1, NULL);
    assert_limit(beside(nested(LIMIT_NODE_DEPTH + 1), 0), 0,
                 "65 levels of nodes are above the maximum 64");
    assert_limit(beside(wide(11, 9089), 8), LIMIT_NODES, NULL);
    assert_limit(beside(wide(11, 9089), 9), 0, "100001 nodes are above the maximum 100000");
}

static void long_places_keep_their_end(void **state)
{
    (void)state;
    static const char tail[] = "/children/0/params/radius";
    char *text = nested(30), *last = strstr(text, "{'type':'group'}");
    char *bad = malloc(strlen(text) + 100);

    assert_non_null(bad);
    sprintf(bad, "%.*s{'type':'sphere','params':{'radius':-1}}%s", (int)(last - text), text,
            last + strlen("{'type':'group'}"));
    assert_null(json_text_scene(bad, &err));
    assert_int_equal(strncmp(err.place, "...", 3), 0);
    assert_string_equal(err.place + strlen(err.place) - strlen(tail), tail);
    free(bad);
    free(text);
}

struct walked {
    const char *ids[8];
    size_t count;
};

static void note(void *data, const struct node *node, size_t index)
{
    struct walked *walked = data;

    assert_int_equal(index, walked->count);
    walked->ids[walked->count++] = node->id;
}

static void tree_questions(void **state)
{
    (void)state;
    struct scene *scene = json_text_valid_scene(
        DOC("'materials':{'a':{'shader':'phong'},'b':{'shader':'phong'}},'root':{'id':'r',"
            "'type':'union','children':[{'id':'x','type':'group','material':'a',"
            "'children':[{'id':'y','type':'box'},{'id':'z','type':'box','material':'b',"
            "'visible':false}]},{'id':'w','type':'box'}]}"));
    struct walked walked = {.count = 0};

    scene_walk(scene, note, &walked);
    assert_int_equal(walked.count, 5);
    assert_string_equal(walked.ids[2], "y");
    assert_string_equal(walked.ids[4], "w");
    assert_int_equal(node_position(scene_find(scene, "z")), 1);
    assert_int_equal(node_position(scene->root), 0);
    assert_string_equal(node_material(scene, scene_find(scene, "y"))->name, "a");
    assert_string_equal(node_material(scene, scene_find(scene, "z"))->name, "b");
    assert_null(node_material(scene, scene_find(scene, "w")));
    assert_null(scene_find(scene, "nobody"));
    assert_ptr_equal(resource_find(&scene->materials, "b"), scene->materials.items[1]);
    assert_null(resource_find(&scene->lights, "b"));
    scene_destroy(scene);
}

static void empty_scene(void **state)
{
    (void)state;
    struct scene *scene = scene_create_empty();
    char *text = scene_print(scene, false);

    json_text_assert_equal(text, ROOT(""));
    free(text);
    scene_destroy(scene);
    scene_destroy(NULL);
}

/* print(parse(print(s))) is print(s) byte for byte, pretty or not, copied or not. */
static void random_documents_round_trip(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= DOCUMENTS; seed++) {
        struct random random = {seed};
        struct scene *scene = random_document(&random, 1 + random_below(&random, 40));
        char *text = scene_print(scene, false), *pretty = scene_print(scene, true);
        struct scene *from_text = json_text_valid_scene(text),
                     *from_pretty = json_text_valid_scene(pretty);
        struct scene *copy = scene_copy(scene);
        scene_destroy(scene);
        struct scene *const same[] = {from_text, from_pretty, copy};
        for (size_t i = 0; i < sizeof same / sizeof same[0]; i++) {
            char *again = scene_print(same[i], false);
            assert_string_equal(again, text);
            free(again);
            again = scene_print(same[i], true);
            assert_string_equal(again, pretty);
            free(again);
            scene_destroy(same[i]);
        }
        free(text);
        free(pretty);
    }
}

/* What is accepted in spite of damage prints and reads back; the rest says why. */
static bool reads_damaged(struct random *random, const char *whole)
{
    char *text = memory_text(whole);
    const size_t length = strlen(text);

    random_damage(random, text, length);
    err = (struct error){0};
    struct scene *scene = scene_parse(text, length, &err);
    free(text);
    if (!scene) {
        assert_true(err.kind != ERROR_NONE && err.kind != ERROR_INTERNAL && *err.message);
        return false;
    }
    text = scene_print(scene, false);
    struct scene *again = json_text_valid_scene(text);
    char *same = scene_print(again, false);
    assert_string_equal(text, same);
    free(text);
    free(same);
    scene_destroy(again);
    scene_destroy(scene);
    return true;
}

static void damaged_documents(void **state)
{
    (void)state;
    struct random random = {9};
    int accepted = 0;

    for (int i = 0; i < DAMAGED / EACH; i++) {
        struct scene *scene = random_document(&random, 1 + random_below(&random, 6));
        char *text = scene_print(scene, false);
        scene_destroy(scene);
        for (int k = 0; k < EACH; k++) {
            accepted += reads_damaged(&random, text);
        }
        free(text);
    }
    assert_true(accepted > DAMAGED / 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(prints_what_is_set),
        cmocka_unit_test(missing_ids_avoid_given_ones),
        cmocka_unit_test(places_name_what_is_wrong),
        cmocka_unit_test(resources_of_every_kind),
        cmocka_unit_test(order_of_members_does_not_matter),
        cmocka_unit_test(ids_are_shared_by_all_trees),
        cmocka_unit_test(models_in_a_circle),
        cmocka_unit_test(limits_of_the_tree),
        cmocka_unit_test(limits_of_lists),
        cmocka_unit_test(limits_hold_in_models),
        cmocka_unit_test(long_places_keep_their_end),
        cmocka_unit_test(tree_questions),
        cmocka_unit_test(empty_scene),
        cmocka_unit_test(random_documents_round_trip),
        cmocka_unit_test(damaged_documents),
    };

    return cmocka_run_group_tests_name("scene", tests, NULL, NULL);
}
