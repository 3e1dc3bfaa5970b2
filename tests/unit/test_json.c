/* SPDX-License-Identifier: MIT */
/* Strict JSON: what is refused and where, what is printed and how. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "protocol/limits.h"
#include "protocol/utf8.h"
#include "tests/support/random_scene.h"

static void assert_printed(const char *text, const char *expected)
{
    struct error err = {0};
    cJSON *json = json_parse(text, strlen(text), &err);

    if (!json) {
        fail_msg("%s: %s: %s", text, err.place, err.message);
    }
    char *printed = json_print(json, false);
    assert_string_equal(printed, expected);
    free(printed);
    cJSON_Delete(json);
}

static void assert_bytes_refused(const char *text, size_t length, enum error_kind kind,
                                 const char *place, const char *fragment)
{
    struct error err = {0};
    cJSON *json = json_parse(text, length, &err);

    if (json) {
        fail_msg("accepted: %s", text);
    }
    if (err.kind != kind || strcmp(err.place, place) != 0 || !strstr(err.message, fragment)) {
        fail_msg("%.80s: got %s, %s: %s", text, error_kind_name(err.kind), err.place, err.message);
    }
}

static void assert_refused(const char *text, const char *place, const char *fragment)
{
    assert_bytes_refused(text, strlen(text), ERROR_SYNTAX, place, fragment);
}

static void accepts_json(void **state)
{
    (void)state;
    assert_printed("null", "null");
    assert_printed(" \t\r\n[ ] ", "[]");
    assert_printed("{}", "{}");
    assert_printed("[true,false,null,\"\",0,-0,-0.0e-0]", "[true,false,null,\"\",0,0,0]");
    assert_printed("{\"b\":1,\"a\":{\"b\":[{}]}}", "{\"b\":1,\"a\":{\"b\":[{}]}}");
    assert_printed("[1e3, 1E+3, 1.5e-3, 0.1, 1e-400]", "[1000,1000,0.0015,0.1,0]");
    assert_printed("\"\\\"\\\\\\/\\b\\f\\n\\r\\t\\u001f\\u007f\"",
                   "\"\\\"\\\\/\\b\\f\\n\\r\\t\\u001f\x7f\"");
    assert_printed("\"\\u00e9\\u20AC\\uD83D\\udc27\"", "\"\xc3\xa9\xe2\x82\xac\xf0\x9f\x90\xa7\"");
    assert_printed("\"\xef\xbf\xbf\xf4\x8f\xbf\xbf\"", "\"\xef\xbf\xbf\xf4\x8f\xbf\xbf\"");
    assert_printed("{\"a\":1,\"A\":2,\"\":3}", "{\"a\":1,\"A\":2,\"\":3}");
}

static void refuses_what_is_not_json(void **state)
{
    (void)state;
    assert_refused("", "line 1, column 1", "the text ends, expected a value");
    assert_refused("  ", "line 1, column 3", "expected a value");
    assert_refused("\xef\xbb\xbf{}", "line 1, column 1", "expected a value, not byte 0xef");
    assert_refused("{} x", "line 1, column 4", "expected nothing more, not 'x'");
    assert_refused("[1,]", "line 1, column 4", "expected a value");
    assert_refused("[1 2]", "line 1, column 4", "expected ',' or ']'");
    assert_refused("[1", "line 1, column 3", "expected ',' or ']'");
    assert_refused("{\"a\":1,}", "line 1, column 8", "expected a member's name");
    assert_refused("{\"a\" 1}", "line 1, column 6", "expected ':'");
    assert_refused("{a:1}", "line 1, column 2", "expected a member's name, not 'a'");
    assert_refused("{\"a\":1 \"b\":2}", "line 1, column 8", "expected ',' or '}'");
    assert_refused("'a'", "line 1, column 1", "expected a value, not '''");
    assert_refused("[NaN]", "line 1, column 2", "expected a value");
    assert_refused("[Infinity]", "line 1, column 2", "expected a value");
    assert_refused("nul", "line 1, column 1", "expected a value");
    assert_refused("True", "line 1, column 1", "expected a value");
    assert_refused("[1] // done", "line 1, column 5", "expected nothing more");
    assert_refused("{\"a\":\n  [1,\n   oops]}", "line 3, column 4", "expected a value, not 'o'");
    assert_bytes_refused("[1]\0", 4, ERROR_SYNTAX, "line 1, column 4", "not byte 0x00");
    assert_bytes_refused("\"a\0b\"", 5, ERROR_SYNTAX, "line 1, column 3", "control character");
}

static void refuses_odd_numbers(void **state)
{
    (void)state;
    assert_refused("01", "line 1, column 1", "starts with 0");
    assert_refused("-01", "line 1, column 1", "starts with 0");
    assert_refused("+1", "line 1, column 1", "expected a value");
    assert_refused(".5", "line 1, column 1", "expected a value");
    assert_refused("1.", "line 1, column 3", "expected a digit");
    assert_refused("1.e3", "line 1, column 3", "expected a digit");
    assert_refused("1e", "line 1, column 3", "expected a digit");
    assert_refused("-", "line 1, column 2", "expected a digit");
    assert_refused("-x", "line 1, column 2", "expected a digit");
    assert_refused("0x10", "line 1, column 2", "expected nothing more");
    assert_bytes_refused("[1e400]", 7, ERROR_LIMIT, "line 1, column 2",
                         "1e400 is beyond the greatest magnitude 9007199254740991");
    assert_bytes_refused("-1e16", 5, ERROR_LIMIT, "line 1, column 1", "-1e16 is beyond");
    assert_printed("9007199254740991", "9007199254740991");
}

static void refuses_odd_strings(void **state)
{
    (void)state;
    assert_refused("\"a", "line 1, column 1", "does not end");
    assert_refused("\"a\\", "line 1, column 3", "unknown escape");
    assert_refused("\"a\nb\"", "line 1, column 3", "control character");
    assert_refused("\"\\x41\"", "line 1, column 2", "unknown escape");
    assert_refused("\"\\u12g4\"", "line 1, column 2", "four hexadecimal digits");
    assert_refused("\"\\u12", "line 1, column 2", "four hexadecimal digits");
    assert_refused("\"\\u0000\"", "line 1, column 2", "\\u0000");
    assert_refused("\"\\ud800\"", "line 1, column 2", "surrogate");
    assert_refused("\"\\ud800x\"", "line 1, column 2", "surrogate");
    assert_refused("\"\\ud800\\u0041\"", "line 1, column 2", "surrogate");
    assert_refused("\"\\udc00\\ud800\"", "line 1, column 2", "surrogate");
}

static void refuses_what_is_not_utf8(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "\x80",             /* continuation alone */
        "\xc3",             /* cut */
        "\xc0\xaf",         /* overlong */
        "\xe0\x80\xaf",     /* overlong */
        "\xed\xa0\x80",     /* surrogate */
        "\xf0\x80\x80\xaf", /* overlong */
        "\xf4\x90\x80\x80", /* above U+10FFFF */
        "\xf8\x88\x80\x80",
        "\xff",
    };

    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char text[16];
        snprintf(text, sizeof text, "\"\xc3\xa9%s\"", bad[i]);
        assert_refused(text, "line 1, column 3", "not UTF-8");
        snprintf(text, sizeof text, "{\"%s\":1}", bad[i]);
        assert_refused(text, "line 1, column 3", "not UTF-8");
    }
}

/* What the whole says, its pieces say too: all pairs of bytes behind and in front of others. */
static void utf8_in_pieces(void **state)
{
    static const char *const around[][2] = {
        {"", ""}, {"a", "b"}, {"\xc3\xa9", "\x80"}, {"\xe0", "\xbf"}, {"\xf4", "\x80\x80"}};
    size_t texts = 0;

    (void)state;
    for (size_t i = 0; i < sizeof around / sizeof around[0] * 65536; i++) {
        const char *const *const ends = around[i / 65536];
        const size_t before = strlen(ends[0]), length = before + 2 + strlen(ends[1]);
        char text[8] = "";
        struct utf8_stream stream = {0};
        size_t whole = 0, count = 1;
        bool fed = true;

        snprintf(text, sizeof text, "%s??%s", ends[0], ends[1]);
        text[before] = (char)(i & 255);
        text[before + 1] = (char)(i >> 8 & 255);
        while (whole < length && (count = utf8_sequence(text + whole, length - whole)) > 0) {
            whole += count;
        }
        for (size_t at = 0; at < length && fed; at++) {
            fed = utf8_feed(&stream, text + at, 1);
        }
        assert_int_equal(fed && stream.left == 0, whole == length);
        texts += whole == length;
    }
    assert_true(texts > 4 * 128 * 128 / 2);
}

static void refuses_duplicate_members(void **state)
{
    (void)state;
    assert_refused("{\"a\":1,\"b\":2,\"a\":3}", "line 1, column 14", "duplicate member \"a\"");
    assert_refused("{\"a\":1,\"\\u0061\":3}", "line 1, column 8", "duplicate member \"a\"");
    assert_refused("{\"\":1,\"\":3}", "line 1, column 7", "duplicate member \"\"");
    assert_refused("[{\"x\":{\"k\":[{}],\"k\":0}}]", "line 1, column 17", "duplicate member \"k\"");
    assert_refused("{\"\\ud83d\\udc27\":1,\"\xf0\x9f\x90\xa7\":2}", "line 1, column 19",
                   "duplicate");
    assert_printed("[{\"a\":{\"a\":{\"a\":1}}},{\"a\":2}]",
                   "[{\"a\":{\"a\":{\"a\":1}}},{\"a\":2}]");
}

static char *repeated(const char *head, const char *part, size_t count, const char *tail)
{
    const size_t size = strlen(head) + count * strlen(part) + strlen(tail) + 1;
    char *text = malloc(size), *at = text;

    assert_non_null(text);
    at += sprintf(at, "%s", head);
    for (size_t i = 0; i < count; i++) {
        at += sprintf(at, "%s", part);
    }
    sprintf(at, "%s", tail);
    return text;
}

static void assert_limit(char *text, bool ok, const char *fragment)
{
    struct error err = {0};
    cJSON *json = json_parse(text, strlen(text), &err);

    assert_int_equal(json != NULL, ok);
    if (!ok) {
        assert_int_equal(err.kind, ERROR_LIMIT);
        assert_non_null(strstr(err.message, fragment));
    }
    cJSON_Delete(json);
    free(text);
}

static char *object_with(size_t keys)
{
    char *text = malloc(keys * 16 + 16), *at = text;

    assert_non_null(text);
    *at++ = '{';
    for (size_t i = 0; i < keys; i++) {
        at += sprintf(at, "%s\"k%zu\":0", i ? "," : "", i * 7919 % keys);
    }
    strcpy(at, "}");
    return text;
}

static void limits_hold(void **state)
{
    (void)state;
    char tail[LIMIT_JSON_DEPTH + 2];

    memset(tail, ']', sizeof tail);
    tail[LIMIT_JSON_DEPTH] = '\0';
    assert_limit(repeated("", "[", LIMIT_JSON_DEPTH, tail), true, "");
    assert_limit(repeated("", "[", LIMIT_JSON_DEPTH + 1, tail), false,
                 "levels of nesting above the maximum 160");
    assert_limit(repeated("\"", "x", LIMIT_JSON_STRING_BYTES, "\""), true, "");
    assert_limit(repeated("\"", "x", LIMIT_JSON_STRING_BYTES + 1, "\""), false,
                 "bytes of a string above the maximum 65536");
    assert_limit(repeated("0.", "1", LIMIT_JSON_NUMBER_BYTES - 2, ""), true, "");
    assert_limit(repeated("0.", "1", LIMIT_JSON_NUMBER_BYTES - 1, ""), false,
                 "characters of a number above the maximum 32");
    assert_limit(repeated("[", "0,", LIMIT_JSON_VALUES - 2, "0]"), true, "");
    assert_limit(repeated("[", "0,", LIMIT_JSON_VALUES - 1, "0]"), false,
                 "values above the maximum 2000000");
    assert_limit(object_with(LIMIT_JSON_KEYS), true, "");
    assert_limit(object_with(LIMIT_JSON_KEYS + 1), false,
                 "members of an object above the maximum 4096");
    char *large = repeated("", " ", LIMIT_DOCUMENT_BYTES, "1");
    assert_bytes_refused(large, strlen(large), ERROR_TOO_LARGE, "",
                         "16777217 bytes are above the maximum 16777216");
    free(large);
}

/* What edits and ids that are filled in make of a text is read again, however long it is. */
static void what_was_printed_has_no_limit_of_length(void **state)
{
    char *bytes = repeated("[", " ", LIMIT_DOCUMENT_BYTES, "1]");
    char *values = repeated("[", "0,", LIMIT_JSON_VALUES, "0]");
    char *wrong = repeated("[", " ", LIMIT_DOCUMENT_BYTES, "01]");
    cJSON *json = json_parse_printed(bytes, strlen(bytes), NULL);

    (void)state;
    assert_int_equal(cJSON_GetArraySize(json), 1);
    cJSON_Delete(json);
    json = json_parse_printed(values, strlen(values), NULL);
    assert_int_equal(cJSON_GetArraySize(json), LIMIT_JSON_VALUES + 1);
    cJSON_Delete(json);
    assert_null(json_parse_printed(wrong, strlen(wrong), NULL));
    free(bytes);
    free(values);
    free(wrong);
}

static void numbers_are_short(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *text;
    } cases[] = {
        {0, "0"},
        {-0.0, "0"},
        {1, "1"},
        {-1.5, "-1.5"},
        {0.1, "0.1"},
        {0.1 + 0.2, "0.30000000000000004"},
        {1.0 / 3, "0.3333333333333333"},
        {100, "100"},
        {123456789, "123456789"},
        {9007199254740991, "9007199254740991"},
        {1e20, "100000000000000000000"},
        {123456789012345680000.0, "123456789012345680000"},
        {1e21, "1e+21"},
        {1.5e-6, "0.0000015"},
        {1e-6, "0.000001"},
        {1e-7, "1e-7"},
        {-1.25e-9, "-1.25e-9"},
        {5e-324, "5e-324"},
        {1.7976931348623157e308, "1.7976931348623157e+308"},
        {NAN, "null"},
        {INFINITY, "null"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[32];
        json_number(cases[i].value, text);
        assert_string_equal(text, cases[i].text);
    }
}

static void numbers_read_back(void **state)
{
    (void)state;
    struct random random = {7};

    for (int i = 0; i < 20000; i++) {
        double value;
        uint64_t bits = (uint64_t)random_between(&random, 0, 4294967296.0) << 32 |
                        (uint64_t)random_between(&random, 0, 4294967296.0);
        memcpy(&value, &bits, sizeof value);
        if (i % 2) {
            value = random_between(&random, -1e6, 1e6);
        }
        if (isfinite(value)) {
            char text[32], shorter[40];
            json_number(value, text);
            assert_true(strtod(text, NULL) == value);
            int digits = 0; /* of those that end after the point, so that none is a filler */
            for (const char *c = strchr(text, '.') ? text : ""; *c && *c != 'e'; c++) {
                digits += *c >= (digits ? '0' : '1') && *c <= '9';
            }
            if (digits > 1) {
                snprintf(shorter, sizeof shorter, "%.*e", digits - 2, value);
                assert_true(strtod(shorter, NULL) != value);
            }
        }
    }
}

static void pretty_print(void **state)
{
    (void)state;
    static const char text[] = "{\"name\":\"x\",\"empty\":{},\"list\":[],\"v\":[1,2.5,3],"
                               "\"deep\":{\"a\":{\"b\":[{\"c\":1}]}}}";
    static const char pretty[] = "{\n"
                                 "  \"name\": \"x\",\n"
                                 "  \"empty\": {},\n"
                                 "  \"list\": [],\n"
                                 "  \"v\": [1, 2.5, 3],\n"
                                 "  \"deep\": {\n"
                                 "    \"a\": {\n"
                                 "      \"b\": [\n"
                                 "        {\"c\": 1}\n"
                                 "      ]\n"
                                 "    }\n"
                                 "  }\n"
                                 "}\n";
    cJSON *json = json_parse(text, strlen(text), NULL);
    char *printed = json_print(json, true), *compact = json_print(json, false);

    assert_string_equal(printed, pretty);
    assert_string_equal(compact, text);
    cJSON_Delete(json);
    json = json_parse(printed, strlen(printed), NULL);
    free(compact);
    compact = json_print(json, false);
    assert_string_equal(compact, text);
    cJSON_Delete(json);
    free(printed);
    free(compact);
}

/* Bytes changed at random never crash; what is accepted prints and reads back. */
static void damaged_texts(void **state)
{
    (void)state;
    static const char text[] = "{\"a\":[1,-2.5e3,\"\\u00e9\\ud83d\\udc27 \xf0\x9f\x90\xa7\",true],"
                               "\"b\":{\"c\":null,\"d\":\"x\\n\"}}";
    struct random random = {3};
    int accepted = 0;

    for (int i = 0; i < 20000; i++) {
        char damaged[sizeof text];
        memcpy(damaged, text, sizeof text);
        for (size_t n = 1 + random_below(&random, 3); n > 0; n--) {
            damaged[random_below(&random, sizeof text - 1)] = (char)random_below(&random, 256);
        }
        const size_t length = sizeof text - 1 - (random_below(&random, 4) == 0);
        char *exact = malloc(length); /* so that reading beyond the end is seen */
        assert_non_null(exact);
        memcpy(exact, damaged, length);
        struct error err = {0};
        cJSON *json = json_parse(exact, length, &err);
        free(exact);
        if (json) {
            accepted++;
            char *printed = json_print(json, false);
            cJSON *again = json_parse(printed, strlen(printed), &err);
            assert_non_null(again);
            cJSON_Delete(again);
            free(printed);
        } else {
            assert_true(err.kind != ERROR_NONE && err.kind != ERROR_INTERNAL);
            assert_true(*err.message);
        }
        cJSON_Delete(json);
    }
    assert_true(accepted > 100);
}

static void errors_are_utf8(void **state)
{
    (void)state;
    struct error err = {0};
    char place[ERROR_PLACE_BYTES], name[400] = "";

    while (strlen(name) < 390) {
        strcat(name, "\xe2\x98\x83");
    }
    error_set(&err, ERROR_INVALID, name, "%s", name);
    const char *const texts[] = {err.place, err.message};
    for (int i = 0; i < 2; i++) {
        for (const char *c = texts[i]; *c;) {
            const size_t count = utf8_sequence(c, strlen(c));
            assert_true(count > 0);
            c += count;
        }
    }
    error_place(place, "/nodes/body/params", "radius");
    assert_string_equal(place, "/nodes/body/params/radius");
    memset(name, 'x', 300);
    error_place(place, name, "radius");
    assert_int_equal(strlen(place), ERROR_PLACE_BYTES - 1);
    assert_string_equal(place + strlen(place) - 7, "/radius");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accepts_json),
        cmocka_unit_test(refuses_what_is_not_json),
        cmocka_unit_test(refuses_odd_numbers),
        cmocka_unit_test(refuses_odd_strings),
        cmocka_unit_test(refuses_what_is_not_utf8),
        cmocka_unit_test(utf8_in_pieces),
        cmocka_unit_test(refuses_duplicate_members),
        cmocka_unit_test(limits_hold),
        cmocka_unit_test(what_was_printed_has_no_limit_of_length),
        cmocka_unit_test(numbers_are_short),
        cmocka_unit_test(numbers_read_back),
        cmocka_unit_test(pretty_print),
        cmocka_unit_test(damaged_texts),
        cmocka_unit_test(errors_are_utf8),
    };

    return cmocka_run_group_tests_name("json", tests, NULL, NULL);
}
