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

#include "protocol/json.h"
#include "protocol/nodes.h"
#include "tests/support/random_edit.h"

static const char *const shapes[] = {"round", "square", NULL};

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
    cJSON *json = json_parse(text, strlen(text), err);
    assert_non_null(json);
    bool ok = record_read(&record, json, "/thing", err);
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
    assert_string_equal(printed, expected);
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

static void test_reads_and_prints(void **state)
{
    (void)state;
    assert_reads("{}", "{}");
    assert_reads("{\"size\":10}", "{\"size\":10}");
    assert_reads("{\"size\":1}", "{\"size\":1}"); /* set, though it is the default */
    assert_reads("{\"count\":-1,\"open\":true}", "{\"count\":-1,\"open\":true}");
    assert_reads("{\"place\":[1,-0,1e6],\"axes\":[true,false,true],\"copies\":[1,-2,0]}",
                 "{\"place\":[1,0,1000000],\"axes\":[true,false,true],\"copies\":[1,-2,0]}");
    assert_reads("{\"shape\":\"round\",\"tint\":[0,0.5,2]}",
                 "{\"tint\":[0,0.5,2],\"shape\":\"round\"}"); /* in the order of the table */
    assert_reads("{\"title\":\"\",\"material\":\"\"}", "{\"title\":\"\",\"material\":\"\"}");
    assert_reads("{\"scale\":2}", "{\"scale\":[2,2,2]}");
    assert_reads("{\"scale\":[1,-2,3]}", "{\"scale\":[1,-2,3]}");
}

/* -0 equals 0 but has other bytes, which hashes would see. */
static void test_zero_has_one_form(void **state)
{
    (void)state;
    assert_true(read_text("{\"place\":[1,-0.0,-0]}", NULL));
    assert_false(signbit(record_vector(&record, "place")[1]));
    assert_false(signbit(record_vector(&record, "place")[2]));
}

static void test_refuses_with_place_value_and_limit(void **state)
{
    (void)state;
    assert_refuses("{\"size\":11}", "/thing/size", "11 is above the maximum 10");
    assert_refuses("{\"size\":0}", "/thing/size", "0 is not above the minimum 0");
    assert_refuses("{\"size\":-1}", "/thing/size", "-1 is below the minimum 0");
    assert_refuses("{\"size\":\"1\"}", "/thing/size", "expected a number");
    assert_refuses("{\"size\":null}", "/thing/size", "null is not a value: leave the member out");
    assert_refuses("{\"count\":1.5}", "/thing/count", "1.5 is not a whole number");
    assert_refuses("{\"count\":6}", "/thing/count", "6 is above the maximum 5");
    assert_refuses("{\"open\":1}", "/thing/open", "expected true or false");
    assert_refuses("{\"place\":[0,1000001,0]}", "/thing/place",
                   "1000001 (y) is above the maximum 1000000");
    assert_refuses("{\"place\":[0,1]}", "/thing/place", "expected three numbers");
    assert_refuses("{\"place\":[0,1,2,3]}", "/thing/place", "expected three numbers, not more");
    assert_refuses("{\"place\":5}", "/thing/place", "expected three numbers");
    assert_refuses("{\"place\":[0,true,2]}", "/thing/place", "expected a number (y)");
    assert_refuses("{\"axes\":[true,1,true]}", "/thing/axes", "expected true or false (y)");
    assert_refuses("{\"copies\":[1,2,0.5]}", "/thing/copies", "0.5 (z) is not a whole number");
    assert_refuses("{\"tint\":[0,-0.1,0]}", "/thing/tint", "-0.1 (green) is below the minimum 0");
    assert_refuses("{\"shape\":\"sqare\"}", "/thing/shape",
                   "\"sqare\" is none of \"round\", \"square\"; did you mean \"square\"?");
    assert_refuses("{\"shape\":1}", "/thing/shape", "expected a text");
    assert_refuses("{\"title\":\"a\\nb\"}", "/thing/title", "control character 10 is not allowed");
    assert_refuses("{\"material\":\"a b\"}", "/thing/material",
                   "\"a b\" is not a name: expected 1 to 64 of A-Z a-z 0-9 _ . -");
    assert_refuses("{\"scale\":0}", "/thing/scale", "0 (x) is not allowed here");
    assert_refuses("{\"scale\":[1,0,1]}", "/thing/scale", "0 (y) is not allowed here");
    assert_refuses("{\"scale\":\"big\"}", "/thing/scale", "expected three numbers or one");
    assert_refuses("{\"normal\":[0,0,-0]}", "/thing/normal", "0, 0, 0 has no direction");
    assert_refuses("{\"sise\":1}", "/thing/sise",
                   "thing has no member \"sise\"; did you mean \"size\"?");
    assert_refuses("{\"whatever\":1}", "/thing/whatever", "thing has no member \"whatever\"");
    assert_refuses("[]", "/thing", "expected an object");
}

static void test_long_texts(void **state)
{
    (void)state;
    struct error err = {0};
    char text[300];
    memset(text, 'x', sizeof text);
    text[201] = '\0';
    cJSON *json = cJSON_CreateString(text);
    int title = record_type_find(&type, "title");
    assert_false(record_set(&record, title, json, "/title", &err));
    assert_string_equal(err.message, "201 bytes is above the maximum 200");
    json->valuestring[200] = '\0';
    assert_true(record_set(&record, title, json, "/title", &err));
    assert_int_equal(strlen(record_text(&record, "title")), 200);
    cJSON_Delete(json);
}

static void test_null_restores_and_failure_keeps(void **state)
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

static void test_copies_share_nothing(void **state)
{
    (void)state;
    struct record copy;
    assert_true(read_text("{\"title\":\"one\",\"place\":[1,2,3]}", NULL));
    record_copy(&copy, &record);
    assert_true(read_text("{\"title\":\"two\",\"place\":[4,5,6]}", NULL));
    assert_string_equal(record_text(&copy, "title"), "one");
    assert_float_equal(record_vector(&copy, "place")[2], 3, 0);
    record_finish(&copy);
    record_finish(&copy); /* twice is fine */
}

static void test_describes(void **state)
{
    (void)state;
    static const char *const expected[] = {
        [0] = "{\"name\":\"size\",\"type\":\"float\",\"unit\":\"length\",\"default\":1,\"min\":0,"
              "\"max\":10,\"above_min\":true,\"doc\":\"S.\"}",
        [4] = "{\"name\":\"axes\",\"type\":\"bvec3\",\"default\":[false,false,false],"
              "\"doc\":\"A.\"}",
        [6] = "{\"name\":\"tint\",\"type\":\"color\",\"default\":[1,1,1],\"min\":0,"
              "\"max\":1000000,\"doc\":\"T.\"}",
        [7] = "{\"name\":\"shape\",\"type\":\"enum\",\"default\":\"square\","
              "\"choices\":[\"round\",\"square\"],\"doc\":\"S.\"}",
        [9] = "{\"name\":\"material\",\"type\":\"material\",\"default\":\"\",\"doc\":\"M.\"}",
        [10] = "{\"name\":\"scale\",\"type\":\"vec3\",\"default\":[1,1,1],\"nonzero\":true,"
               "\"uniform\":true,\"doc\":\"S.\"}",
        [11] = "{\"name\":\"normal\",\"type\":\"vec3\",\"default\":[0,1,0],\"direction\":true,"
               "\"doc\":\"N.\"}",
    };
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        if (expected[i]) {
            cJSON *row = param_describe(&params[i]);
            char *text = json_print(row, false);
            assert_string_equal(text, expected[i]);
            free(text);
            cJSON_Delete(row);
        }
    }
}

/* What record_get gives, record_set takes, for every row of the real tables too. */
static void test_values_survive(void **state)
{
    (void)state;
    struct random random = {11};
    const struct resource_list none = {0};
    for (int round = 0; round < 2000; round++) {
        const struct record_type *table =
            round % 3 == 0 ? &type
                           : &node_type_at(random_below(&random, node_type_count()))->record;
        struct record first, second;
        record_init(&first, table);
        record_init(&second, table);
        for (int i = 0; table->params[i].name; i++) {
            struct error err = {0};
            cJSON *json = random_value(&random, &table->params[i], &none);
            assert_true(record_set(&first, i, json, "", &err));
            cJSON *given = record_get(&first, i);
            assert_true(record_set(&second, i, given, "", &err));
            assert_memory_equal(first.values[i].number, second.values[i].number,
                                sizeof first.values[i].number);
            cJSON_Delete(json);
            cJSON_Delete(given);
        }
        record_finish(&first);
        record_finish(&second);
    }
}

static void test_names(void **state)
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
        cmocka_unit_test_setup_teardown(test_reads_and_prints, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_zero_has_one_form, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_refuses_with_place_value_and_limit, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_long_texts, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_null_restores_and_failure_keeps, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_copies_share_nothing, set_up, tear_down),
        cmocka_unit_test(test_describes),
        cmocka_unit_test(test_values_survive),
        cmocka_unit_test(test_names),
    };
    return cmocka_run_group_tests_name("record", tests, NULL, NULL);
}
