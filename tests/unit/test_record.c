/* SPDX-License-Identifier: MIT */
/* Records: every type of value is read, checked, set, printed and described. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/declared_params.h"
#include "protocol/json.h"
#include "protocol/limits.h"
#include "protocol/nodes.h"
#include "tests/support/json_text.h"
#include "tests/support/random_document.h"

static const char *const shapes[] = {"round", "square", NULL};

static const double corners[] = {0, 0, 1, 0, 0, 1};

static const struct param params[] = {
    {"size", PARAM_FLOAT, UNIT_LENGTH, .def = {1}, .max = 10, .above_min = true, .doc = "S."},
    {"count", PARAM_INT, .def = {3}, .min = -1, .max = 5, .doc = "C."},
    {"open", PARAM_BOOL, .doc = "O."},
    {"place", PARAM_VEC3, .doc = "P."},
    {"axes", PARAM_BVEC3, .doc = "A."},
    {"copies", PARAM_IVEC3, .doc = "C."},
    {"tint", PARAM_COLOR, .def = {1, 1, 1}, .doc = "T."},
    {"shape", PARAM_ENUM, .choices = shapes, .def = {1}, .doc = "S."},
    {"title", PARAM_TEXT, .doc = "T."},
    {"material", PARAM_MATERIAL, .doc = "M."},
    {"scale", PARAM_VEC3, .def = {1, 1, 1}, .nonzero = true, .uniform = true, .doc = "S."},
    {"normal", PARAM_VEC3, .def = {0, 1, 0}, .direction = true, .doc = "N."},
    {"extent", PARAM_VEC2, .def = {1, 2}, .doc = "E."},
    {"constant", PARAM_VEC4, .doc = "C."},
    {"outline", PARAM_POINTS, .def = {3}, .def_points = corners, .min = 3, .max = LIMIT_POINTS,
     .doc = "O."},
    {"code", PARAM_CODE, .doc = "C."},
    {"model", PARAM_MODEL, .doc = "M."},
    {"function", PARAM_FUNCTION, .doc = "F."},
    {"rows", PARAM_ROWS, .doc = "R."},
    {"surface", PARAM_SURFACE, .doc = "S."},
    {"cell", PARAM_IVEC2, .min = -4, .max = 4, .doc = "C."},
    {"corner", PARAM_IVEC4, .doc = "C."},
    {.name = NULL},
};
static const struct record_type type = {"thing", "A thing.", params};

static struct record record;

static int set_up(void **state)
{
    (void)state;
    record_init(&record, &type);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    record_finish(&record);
    return 0;
}

static bool read_text(const char *text, struct error *err)
{
    cJSON *json = json_text_parse(text, err);

    assert_non_null(json);
    const bool ok = record_read(&record, json, "/thing", err);
    cJSON_Delete(json);
    return ok;
}

static void assert_reads(const char *text, const char *expected)
{
    struct error err = {0};
    cJSON *json = cJSON_CreateObject();

    tear_down(NULL);
    set_up(NULL);
    if (!read_text(text, &err)) {
        fail_msg("%s: %s: %s", text, err.place, err.message);
    }
    record_print(&record, json);
    char *printed = json_print(json, false);
    json_text_assert_equal(printed, expected);
    free(printed);
    cJSON_Delete(json);
}

static void assert_refuses(const char *text, const char *place, const char *message)
{
    struct error err = {0};

    assert_false(read_text(text, &err));
    assert_int_equal(err.kind, ERROR_INVALID);
    assert_string_equal(err.place, place);
    assert_string_equal(err.message, message);
}

static void reads_and_prints(void **state)
{
    (void)state;
    assert_reads("{}", "{}");
    assert_reads("{'size':10}", "{'size':10}");
    assert_reads("{'size':1}", "{'size':1}"); /* set, though it is the default */
    assert_reads("{'count':-1,'open':true}", "{'count':-1,'open':true}");
    assert_reads("{'place':[1,-0,1e6],'axes':[true,false,true],'copies':[1,-2,0]}",
                 "{'place':[1,0,1000000],'axes':[true,false,true],'copies':[1,-2,0]}");
    assert_reads("{'cell':[-4,4],'corner':[1,2,-3,4]}", "{'cell':[-4,4],'corner':[1,2,-3,4]}");
    assert_reads("{'shape':'round','tint':[0,0.5,2]}",
                 "{'tint':[0,0.5,2],'shape':'round'}"); /* in the order of the table */
    assert_reads("{'title':'','material':''}", "{'title':'','material':''}");
    assert_reads("{'scale':2}", "{'scale':[2,2,2]}");
    assert_reads("{'scale':[1,-2,3]}", "{'scale':[1,-2,3]}");
    assert_reads("{'extent':[3,-0],'constant':[1,2,3,4]}", "{'extent':[3,0],'constant':[1,2,3,4]}");
    assert_reads("{'outline':[[0,-0],[1,0],[1,1],[0,1]]}", "{'outline':[[0,0],[1,0],[1,1],[0,1]]}");
    assert_reads("{'code':'a\\n\\tb','model':'pawn','function':''}",
                 "{'code':'a\\n\\tb','model':'pawn','function':''}");
}

/* -0 equals 0 but has other bytes, which hashes would see. */
static void zero_has_one_form(void **state)
{
    (void)state;
    assert_true(read_text("{'place':[1,-0.0,-0]}", NULL));
    assert_false(signbit(record_vector(&record, "place")[1]));
    assert_false(signbit(record_vector(&record, "place")[2]));
}

static void refuses_with_place_value_and_limit(void **state)
{
    (void)state;
    assert_refuses("{'size':11}", "/thing/size", "11 is above the maximum 10");
    assert_refuses("{'size':0}", "/thing/size", "0 is not above the minimum 0");
    assert_refuses("{'size':-1}", "/thing/size", "-1 is below the minimum 0");
    assert_refuses("{'size':'1'}", "/thing/size", "expected a number");
    assert_refuses("{'size':null}", "/thing/size", "null is not a value: leave the member out");
    assert_refuses("{'count':1.5}", "/thing/count", "1.5 is not a whole number");
    assert_refuses("{'count':6}", "/thing/count", "6 is above the maximum 5");
    assert_refuses("{'open':1}", "/thing/open", "expected true or false");
    assert_refuses("{'place':[0,1000001,0]}", "/thing/place",
                   "1000001 (y) is above the maximum 1000000");
    assert_refuses("{'place':[0,1]}", "/thing/place", "expected three numbers");
    assert_refuses("{'place':[0,1,2,3]}", "/thing/place", "expected three numbers, not more");
    assert_refuses("{'place':5}", "/thing/place", "expected three numbers");
    assert_refuses("{'place':[0,true,2]}", "/thing/place", "expected a number (y)");
    assert_refuses("{'axes':[true,1,true]}", "/thing/axes", "expected true or false (y)");
    assert_refuses("{'copies':[1,2,0.5]}", "/thing/copies", "0.5 (z) is not a whole number");
    assert_refuses("{'tint':[0,-0.1,0]}", "/thing/tint", "-0.1 (green) is below the minimum 0");
    assert_refuses("{'shape':'sqare'}", "/thing/shape",
                   "\"sqare\" is none of \"round\", \"square\"; did you mean \"square\"?");
    assert_refuses("{'shape':1}", "/thing/shape", "expected a text");
    assert_refuses("{'title':'a\\nb'}", "/thing/title", "control character 10 is not allowed");
    assert_refuses("{'material':'a b'}", "/thing/material",
                   "\"a b\" is not a name: expected 1 to 64 of A-Z a-z 0-9 _ . -");
    assert_refuses("{'scale':0}", "/thing/scale", "0 (x) is not allowed here");
    assert_refuses("{'scale':[1,0,1]}", "/thing/scale", "0 (y) is not allowed here");
    assert_refuses("{'scale':'big'}", "/thing/scale", "expected three numbers or one");
    assert_refuses("{'normal':[0,0,-0]}", "/thing/normal", "0, 0, 0 has no direction");
    assert_refuses("{'extent':[1]}", "/thing/extent", "expected two numbers");
    assert_refuses("{'extent':[1,2,3]}", "/thing/extent", "expected two numbers, not more");
    assert_refuses("{'extent':1}", "/thing/extent", "expected two numbers");
    assert_refuses("{'constant':[1,2,3]}", "/thing/constant", "expected four numbers");
    assert_refuses("{'constant':[1,2,3,2e6]}", "/thing/constant",
                   "2000000 (w) is above the maximum 1000000");
    assert_refuses("{'outline':{}}", "/thing/outline", "expected a list of points");
    assert_refuses("{'outline':[[0,0],[1,1]]}", "/thing/outline",
                   "2 points are below the minimum 3");
    assert_refuses("{'outline':[[0,0],[1,1],[0]]}", "/thing/outline/2", "expected two numbers");
    assert_refuses("{'outline':[[0,0],[1,-2e6],[0,1]]}", "/thing/outline/1",
                   "-2000000 (y) is below the minimum -1000000");
    assert_refuses("{'code':'a\\rb'}", "/thing/code", "control character 13 is not allowed");
    assert_refuses("{'code':1}", "/thing/code", "expected a text");
    assert_refuses("{'model':'a/b'}", "/thing/model",
                   "\"a/b\" is not a name: expected 1 to 64 of A-Z a-z 0-9 _ . -");
    assert_refuses("{'function':false}", "/thing/function", "expected a text");
    assert_refuses("{'sise':1}", "/thing/sise",
                   "thing has no member \"sise\"; did you mean \"size\"?");
    assert_refuses("{'whatever':1}", "/thing/whatever", "thing has no member \"whatever\"");
    assert_refuses("[]", "/thing", "expected an object");
}

static void long_texts(void **state)
{
    (void)state;
    struct error err = {0};
    char text[300];

    memset(text, 'x', sizeof text);
    text[201] = '\0';
    cJSON *json = cJSON_CreateString(text);
    const int title = record_type_find(&type, "title");
    assert_false(record_set(&record, title, json, "/title", &err));
    assert_string_equal(err.message, "201 bytes are above the maximum 200");
    json->valuestring[200] = '\0';
    assert_true(record_set(&record, title, json, "/title", &err));
    assert_int_equal(strlen(record_text(&record, "title")), 200);
    cJSON_Delete(json);
}

#define SURFACE(members) "{'surface':{" members "}}"
#define PARTS "'x':'s*t','y':'s','z':'t^2',"

static void surfaces_are_read(void **state)
{
    (void)state;
    assert_reads(SURFACE(""), SURFACE(""));
    assert_reads(SURFACE("'t':[-0,2.5],'z':'t^2','s':[-1,1],'y':'s','x':''"),
                 SURFACE("'x':'','y':'s','z':'t^2','s':[-1,1],'t':[0,2.5]"));
    static const struct {
        const char *members, *place, *message;
    } bad[] = {
        {"'x':'s','y':'t','s':[0,1],'t':[0,1]", "/z", "is missing"},
        {"'s':[0,1],'t':[0,1]", "/x", "is missing"},
        {PARTS "'s':[0,1]", "",
         "the ranges of 1 letters; a surface has two parameters, of s, t, u, v"},
        {PARTS "'s':[0,1],'t':[0,1],'u':[0,1]", "",
         "the ranges of 3 letters; a surface has two parameters, of s, t, u, v"},
        {PARTS "'s':[0,1],'w':[0,1]", "/w", "there is no member \"w\" here"},
        {PARTS "'s':[0,1],'t':[1,1]", "/t", "the first number is not below the second"},
        {PARTS "'s':[2,1],'t':[0,1]", "/s", "the first number is not below the second"},
        {PARTS "'s':[0,1e7],'t':[0,1]", "/s", "10000000 (y) is above the maximum 1000000"},
        {PARTS "'s':0,'t':[0,1]", "/s", "expected two numbers"},
        {"'x':1,'y':'s','z':'t','s':[0,1],'t':[0,1]", "/x", "expected a text"},
        {"'x':'s\\r','y':'s','z':'t','s':[0,1],'t':[0,1]", "/x",
         "control character 13 is not allowed"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char text[200], place[64];
        snprintf(text, sizeof text, SURFACE("%s"), bad[i].members);
        snprintf(place, sizeof place, "/thing/surface%s", bad[i].place);
        assert_refuses(text, place, bad[i].message);
    }
    assert_refuses("{'surface':'s*t'}", "/thing/surface", "expected an object");
}

#define ROWS(row) "{'rows':[" row "]}"

static void declared_rows(void **state)
{
    (void)state;
    assert_reads(ROWS(""), ROWS(""));
    assert_reads(ROWS("{'type':'float','name':'a'}"), ROWS("{'name':'a','type':'float'}"));
    assert_reads(
        ROWS("{'doc':'D.','range':[-0,4],'default':1,'name':'_a1','type':'int'},{'name':'b',"
             "'type':'float3','default':[1,2,-0]}"),
        ROWS("{'name':'_a1','type':'int','default':1,'range':[0,4],'doc':'D.'},{'name':'b',"
             "'type':'vec3','default':[1,2,0]}"));
    assert_reads(ROWS("{'name':'a','type':'int2'},{'name':'b','type':'int3'},{'name':'c',"
                      "'type':'int4','range':[-1,2]}"),
                 ROWS("{'name':'a','type':'ivec2'},{'name':'b','type':'ivec3'},{'name':'c',"
                      "'type':'ivec4','range':[-1,2]}"));
    static const struct {
        const char *row, *place, *message;
    } bad[] = {
        {"{'name':'a','type':'ivec2','default':[1,0.5]}", "/default",
         "0.5 (y) is not a whole number"},
        {"{'name':'a','type':'ivec4','range':[0,2.5]}", "/range", "2.5 is not a whole number"},
        {"{'name':'a','type':'int4','default':[1,2,3]}", "/default", "expected four numbers"},
        {"1", "", "expected an object"},
        {"{'name':'a'}", "/type", "is missing"},
        {"{'type':'float'}", "/name", "is missing"},
        {"{'name':'a','type':'flot'}", "/type",
         "\"flot\" is no type of a parameter; did you mean \"float\"?"},
        {"{'name':'a','type':'bool','min':1}", "/min", "there is no member \"min\" here"},
        {"{'name':'a','type':'bool','default':1}", "/default", "expected true or false"},
        {"{'name':'a','type':'bool','range':[0,1]}", "/range", "a bool has no range"},
        {"{'name':'a','type':'color','range':[0,1]}", "/range", "a color has no range"},
        {"{'name':'a','type':'color','default':[0,0,-1]}", "/default",
         "-1 (blue) is below the minimum 0"},
        {"{'name':'a','type':'float','range':[1,1]}", "/range",
         "the first number is not below the second"},
        {"{'name':'a','type':'float','range':[1,2,3]}", "/range", "expected two numbers"},
        {"{'name':'a','type':'int','range':[0.5,2]}", "/range", "0.5 is not a whole number"},
        {"{'name':'a','type':'vec2','range':[0,2],'default':[1,3]}", "/default",
         "3 (y) is above the maximum 2"},
        {"{'name':'a','type':'float','doc':1}", "/doc", "expected a text"},
        {"{'name':'a','type':'float','default':1e7}", "/default",
         "10000000 is above the maximum 1000000"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char text[200], place[64];
        snprintf(text, sizeof text, ROWS("%s"), bad[i].row);
        snprintf(place, sizeof place, "/thing/rows/0%s", bad[i].place);
        assert_refuses(text, place, bad[i].message);
    }
    assert_refuses("{'rows':{}}", "/thing/rows", "expected a list of parameters");
    assert_refuses(ROWS("{'name':'a','type':'int'},{'name':'a','type':'bool'}"),
                   "/thing/rows/1/name", "\"a\" is declared twice");
}

static void names_of_declared_rows(void **state)
{
    (void)state;
    static const char *const good[] = {"a", "_", "_Color1", "A9_z", "glow"};
    static const char *const wrong[] = {"", "1a", "a b", "a-b", "a__b", "gl_x", "\xc3\xa9", "a."};
    struct error err = {0};
    char text[200];

    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        snprintf(text, sizeof text, ROWS("{'name':'%s','type':'int'}"), good[i]);
        assert_true(read_text(text, &err));
    }
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        snprintf(text, sizeof text, ROWS("{'name':'%s','type':'int'}"), wrong[i]);
        assert_false(read_text(text, &err));
        assert_string_equal(err.place, "/thing/rows/0/name");
    }
}

/* Rows are defaults and ranges of the values given to them. */
static void definitions_give_defaults_and_ranges(void **state)
{
    (void)state;
    char *text = json_text(
        "[{'name':'a','type':'float','range':[2,3]},{'name':'b','type':'vec2','range':[-3,-2],"
        "'doc':'B.'},{'name':'c','type':'int','default':7},{'name':'d','type':'color'}]");
    struct error err = {0};
    struct declared_params *declared = declared_params_create("thing", &type, text);
    const struct param *rows = declared->type.params + declared->first_declared;

    assert_int_equal(declared->first_declared, record_type_count(&type));
    assert_string_equal(declared->type.name, "thing");
    assert_ptr_equal(declared->type.params[0].name, params[0].name);
    assert_true(rows[0].def[0] == 2 && rows[0].min == 2 && rows[0].max == 3);
    assert_true(rows[1].def[0] == -2 && rows[1].def[1] == -2);
    assert_string_equal(rows[1].doc, "B.");
    assert_true(rows[2].def[0] == 7 && rows[2].type == PARAM_INT);
    assert_true(rows[3].def[0] == 0 && rows[3].type == PARAM_COLOR);
    assert_null(rows[4].name);
    cJSON *json = json_parse(text, strlen(text), NULL);
    const struct record_type taken = {.name = "field", .params = rows + 2};
    assert_false(declared_params_check(json, DECLARED_OF_CODE, &taken, "/p", &err));
    assert_string_equal(err.place, "/p/2/name");
    assert_string_equal(err.message, "every field has a \"c\" already");
    cJSON_Delete(json);
    declared_params_destroy(declared);
    free(text);
    declared_params_destroy(NULL);
}

/* As many as allowed, and one more. */
static void limits_of_values(void **state)
{
    (void)state;
    struct error err = {0};
    static char code[LIMIT_CODE_BYTES + 2];

    memset(code, ' ', LIMIT_CODE_BYTES + 1);
    cJSON *text = cJSON_CreateString(code), *points = cJSON_CreateArray();
    cJSON *rows = cJSON_CreateArray();
    int index = record_type_find(&type, "code");
    assert_false(record_set(&record, index, text, "/code", &err));
    assert_int_equal(err.kind, ERROR_LIMIT);
    assert_string_equal(err.message, "16385 bytes are above the maximum 16384 (code_bytes)");
    text->valuestring[LIMIT_CODE_BYTES] = '\0';
    assert_true(record_set(&record, index, text, "/code", &err));
    index = record_type_find(&type, "outline");
    for (int i = 0; i <= LIMIT_POINTS; i++) {
        assert_int_equal(record_set(&record, index, points, "/outline", &err), i >= 3);
        cJSON_AddItemToArray(points, cJSON_CreateIntArray((const int[]){i, i * i}, 2));
    }
    assert_int_equal(record.values[index].number[0], LIMIT_POINTS);
    assert_false(record_set(&record, index, points, "/outline", &err));
    assert_int_equal(err.kind, ERROR_LIMIT);
    assert_string_equal(err.message, "65 points are above the maximum 64");
    index = record_type_find(&type, "rows");
    for (int i = 0; i <= LIMIT_DECLARED; i++) {
        char name[16];
        assert_true(record_set(&record, index, rows, "/rows", &err));
        snprintf(name, sizeof name, "p%d", i);
        cJSON *row = cJSON_CreateObject();
        cJSON_AddStringToObject(row, "name", name);
        cJSON_AddStringToObject(row, "type", "float");
        cJSON_AddItemToArray(rows, row);
    }
    assert_false(record_set(&record, index, rows, "/rows", &err));
    assert_int_equal(err.kind, ERROR_LIMIT);
    assert_string_equal(err.message, "17 parameters are above the maximum 16");
    cJSON_Delete(text);
    cJSON_Delete(points);
    cJSON_Delete(rows);
}

static void null_restores_and_failure_keeps(void **state)
{
    (void)state;
    struct error err = {0};
    cJSON *two = cJSON_CreateNumber(2), *much = cJSON_CreateNumber(99), *null = cJSON_CreateNull();

    assert_true(record_set(&record, 0, two, "", &err));
    assert_false(record_set(&record, 0, much, "", &err));
    assert_float_equal(record_number(&record, "size"), 2, 0);
    assert_true(record_set(&record, 0, null, "", &err));
    assert_float_equal(record_number(&record, "size"), 1, 0);
    assert_null(record_get(&record, 0));
    cJSON_Delete(two);
    cJSON_Delete(much);
    cJSON_Delete(null);
}

static void copies_share_nothing(void **state)
{
    (void)state;
    struct record copy;

    assert_true(read_text("{'title':'one','place':[1,2,3]}", NULL));
    record_copy(&copy, &record);
    assert_true(read_text("{'title':'two','place':[4,5,6]}", NULL));
    assert_string_equal(record_text(&copy, "title"), "one");
    assert_float_equal(record_vector(&copy, "place")[2], 3, 0);
    record_finish(&copy);
    record_finish(&copy); /* twice is fine */
    assert_true(read_text("{'outline':[[1,2],[3,4],[5,6]]}", NULL));
    record_copy(&copy, &record);
    const int outline = record_type_find(&type, "outline");
    assert_true(param_value_equal(&copy.values[outline], &record.values[outline]));
    assert_true(read_text("{'outline':[[1,2],[3,4],[5,7]]}", NULL));
    assert_false(param_value_equal(&copy.values[outline], &record.values[outline]));
    assert_float_equal(copy.values[outline].points[5], 6, 0);
    record_finish(&copy);
}

static void types_are_described(void **state)
{
    (void)state;
    static const char *const expected[] = {
        [0] = "{'name':'size','type':'float','unit':'length','default':1,'min':0,'max':10,"
              "'above_min':true,'doc':'S.'}",
        [4] = "{'name':'axes','type':'bvec3','default':[false,false,false],'doc':'A.'}",
        [6] = "{'name':'tint','type':'color','default':[1,1,1],'min':0,'max':1000000,'doc':'T.'}",
        [7] = "{'name':'shape','type':'enum','default':'square','choices':['round','square'],"
              "'doc':'S.'}",
        [9] = "{'name':'material','type':'material','default':'','doc':'M.'}",
        [10] = "{'name':'scale','type':'vec3','default':[1,1,1],'nonzero':true,'uniform':true,"
               "'doc':'S.'}",
        [11] = "{'name':'normal','type':'vec3','default':[0,1,0],'direction':true,'doc':'N.'}",
        [14] = "{'name':'outline','type':'points','default':[[0,0],[1,0],[0,1]],'min':3,'max':64,"
               "'doc':'O.'}",
        [18] = "{'name':'rows','type':'rows','default':[],'doc':'R.'}",
    };

    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        if (expected[i]) {
            cJSON *row = param_describe(&params[i]);
            char *text = json_print(row, false);
            json_text_assert_equal(text, expected[i]);
            free(text);
            cJSON_Delete(row);
        }
    }
}

/* What record_get gives, record_set takes, for every row of the real tables too. */
static void values_survive(void **state)
{
    (void)state;
    struct random random = {11};

    for (int round = 0; round < 2000; round++) {
        const struct record_type *table =
            round % 3 == 0 ? &type
                           : &node_type_at(random_below(&random, node_type_count()))->record;
        struct record first, second;
        record_init(&first, table);
        record_init(&second, table);
        for (int i = 0; table->params[i].name; i++) {
            struct error err = {0};
            cJSON *json = random_value(&random, &table->params[i], NULL);
            assert_true(record_set(&first, i, json, "", &err));
            cJSON *given = record_get(&first, i);
            assert_true(record_set(&second, i, given, "", &err));
            assert_true(param_value_equal(&first.values[i], &second.values[i]));
            cJSON_Delete(json);
            cJSON_Delete(given);
        }
        record_finish(&first);
        record_finish(&second);
    }
}

static void names_are_checked(void **state)
{
    (void)state;
    char name[80];

    memset(name, 'a', sizeof name);
    name[64] = '\0';
    assert_true(record_name_valid(name));
    name[64] = 'a';
    name[65] = '\0';
    assert_false(record_name_valid(name));
    assert_true(record_name_valid("A-z_0.9"));
    assert_false(record_name_valid(""));
    assert_false(record_name_valid("a/b"));
    assert_false(record_name_valid("\xc3\xa9"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(reads_and_prints, set_up, tear_down),
        cmocka_unit_test_setup_teardown(zero_has_one_form, set_up, tear_down),
        cmocka_unit_test_setup_teardown(refuses_with_place_value_and_limit, set_up, tear_down),
        cmocka_unit_test_setup_teardown(long_texts, set_up, tear_down),
        cmocka_unit_test_setup_teardown(surfaces_are_read, set_up, tear_down),
        cmocka_unit_test_setup_teardown(declared_rows, set_up, tear_down),
        cmocka_unit_test_setup_teardown(names_of_declared_rows, set_up, tear_down),
        cmocka_unit_test_setup_teardown(definitions_give_defaults_and_ranges, set_up, tear_down),
        cmocka_unit_test_setup_teardown(limits_of_values, set_up, tear_down),
        cmocka_unit_test_setup_teardown(null_restores_and_failure_keeps, set_up, tear_down),
        cmocka_unit_test_setup_teardown(copies_share_nothing, set_up, tear_down),
        cmocka_unit_test(types_are_described),
        cmocka_unit_test(values_survive),
        cmocka_unit_test(names_are_checked),
    };

    return cmocka_run_group_tests_name("record", tests, NULL, NULL);
}
