/* SPDX-License-Identifier: MIT */
/* Users' code that is refused: why and where, every limit from both sides, and texts that are
 * hostile or damaged. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/limits.h"
#include "renderer/code/code.h"
#include "tests/support/code_blocks.h"
#include "tests/support/random_code.h"

static const struct param no_params[] = {{.name = NULL}};

/* --- what is refused --- */

static bool refuses(const struct code_block *block)
{
    struct error err = {0};
    const char *head = block->head;
    const bool shade = strncmp(head, "shade ", 6) == 0, limit = strncmp(head, "limit ", 6) == 0;
    char *words;

    head += shade || limit ? 6 : 0;
    const int line = (int)strtol(head, &words, 10), column = (int)strtol(words + 1, &words, 10);
    struct code_source source = {shade ? CODE_SHADE : CODE_DISTANCE, block->text, no_params, false};
    struct code *code = code_compile(&source, &err);
    const bool right = !code && err.line == line && err.column == column &&
                       strstr(err.message, words + 1) &&
                       err.kind == (limit ? ERROR_LIMIT : ERROR_COMPILE) && err.place[0] == '\0';
    if (!right) {
        print_error("tests/code/refused.glsl:%d: %s at %d:%d: %s\n", block->line,
                    code ? "not refused" : error_kind_name(err.kind), err.line, err.column,
                    err.message);
    }
    code_destroy(code);
    assert_null(code_compile(&source, NULL)); /* nobody need listen */
    return right;
}

static void refused_code_says_why_and_where(void **state)
{
    (void)state;
    struct code_blocks blocks = code_blocks_read("tests/code/refused.glsl");

    assert_int_equal(blocks.count, 196);
    size_t right = 0;
    for (size_t i = 0; i < blocks.count; i++) {
        right += refuses(&blocks.rows[i]);
    }
    assert_int_equal(right, blocks.count);
    code_blocks_finish(&blocks);
}

/* --- limits --- */

/* `before`, `part` so many times, `after`. */
static char *repeated(const char *before, const char *part, size_t count, const char *after)
{
    const size_t length = strlen(before) + count * strlen(part) + strlen(after);
    char *text = malloc(length + 1), *at = text;

    assert_non_null(text);
    at = stpcpy(at, before);
    for (size_t i = 0; i < count; i++) {
        at = stpcpy(at, part);
    }
    strcpy(at, after);
    return text;
}

static void assert_limit(const char *text, bool passes, const char *words)
{
    struct error err = {0};
    struct code_source source = {CODE_DISTANCE, text, no_params, false};
    struct code *code = code_compile(&source, &err);

    if (passes && !code) {
        fail_msg("%d:%d: %s\n%.200s", err.line, err.column, err.message, text);
    }
    if (!passes && (code || err.kind != ERROR_LIMIT || !strstr(err.message, words))) {
        fail_msg("%s: %d:%d: %s\n%.200s", words, err.line, err.column, err.message, text);
    }
    code_destroy(code);
}

/* Around the middle, `inside` of the parts pass and one more does not. */
static void assert_parts(const char *before, const char *open, const char *middle,
                         const char *close, const char *after, size_t inside, const char *words)
{
    for (size_t more = 0; more < 2; more++) {
        char *head = repeated(before, open, inside + more, middle);
        char *text = repeated(head, close, inside + more, after);
        assert_limit(text, more == 0, words);
        free(head);
        free(text);
    }
}

static void bytes_are_limited(void **state)
{
    static const char code[] = "float sdf(vec3 p) { return 1.0; }//";
    (void)state;
    const size_t room = LIMIT_CODE_BYTES - (sizeof code - 1);

    assert_parts(code, "", "", "x", "", room, "code of 16385 bytes, above the maximum 16384");
    /* What Mesa's compiler dies of. */
    char *text = repeated("float sdf(vec3 p) { return p.x", "+1", 20000, "; }");
    assert_limit(text, false, "above the maximum 16384 (code_bytes)");
    free(text);
}

static void depth_is_limited(void **state)
{
    (void)state;
    const char *words = "nesting above the maximum 64 (code_depth)";
    const char *head = "float sdf(vec3 p) { return ", *tail = "; }"; /* one level already */

    assert_parts(head, "(", "1.0", ")", tail, 63, words);
    assert_parts(head, "sin(", "1.0", ")", tail, 63, words);
    assert_parts(head, "vec2(", "1.0", ").x", tail, 63, words);
    assert_parts(head, "- ", "1.0", "", tail, 63, words);
    assert_parts(head, "p[int(", "0", ")]", tail, 31, words);
    assert_parts(head, "true ? 1.0 : ", "1.0", "", tail, 63, words);
    assert_parts("float sdf(vec3 p) ", "{", "return 1.0;", "}", "", 64, words);
    assert_parts("float sdf(vec3 p) {", "if (p.x > 1.0) ", ";", "", "return 1.0; }", 63, words);
    assert_parts("float sdf(vec3 p) {", "if (p.x > 1.0) ; else ", ";", "", "return 1.0; }", 63,
                 words);
    assert_parts("float sdf(vec3 p) {", "for (int i = 0; i < 1; i++) ", ";", "", "return 1.0; }",
                 63, words);
}

static void assignments_in_a_row_are_limited(void **state)
{
    (void)state;
    for (int last = 63; last <= 64; last++) {
        char *text = NULL;
        size_t length;
        FILE *out = open_memstream(&text, &length);
        fprintf(out, "float sdf(vec3 p) { float a0");
        for (int i = 1; i < last; i++) {
            fprintf(out, ", a%d", i);
        }
        fprintf(out, "; ");
        for (int i = 0; i < last; i++) {
            fprintf(out, "a%d = ", i);
        }
        fprintf(out, "1.0; return a0; }");
        fclose(out);
        assert_limit(text, last == 63, "nesting above the maximum 64 (code_depth)");
        free(text);
    }
}

static void rows_of_operators_are_limited(void **state)
{
    (void)state;
    const char *words = "operations in a row above the maximum 256";
    const char *head = "float sdf(vec3 p) { return p.x", *tail = "; }";

    assert_parts(head, " + 1", "", "", tail, 254, words); /* p, its member, and one more */
    assert_parts(head, ".x", "", "", tail, 254, words);
    assert_parts("float sdf(vec3 p) { p.x", ", 1", "", "", "; return 1.0; }", 254, words);
}

static void calls_are_limited(void **state)
{
    (void)state;
    for (int last = 64; last <= 65; last++) {
        char *text = NULL;
        size_t length;
        FILE *out = open_memstream(&text, &length);
        fprintf(out, "float f0(float a) { return a; }\n");
        for (int i = 1; i < last; i++) {
            fprintf(out, "float f%d(float a) { return f%d(a); }\n", i, i - 1);
        }
        fprintf(out, "float sdf(vec3 p) { return f%d(p.x); }", last - 2);
        fclose(out);
        assert_limit(text, last == 64, "calls inside calls above the maximum 64 (code_depth)");
        free(text);
    }
    /* The other way round, declared first. */
    for (int last = 64; last <= 65; last++) {
        char *text = NULL;
        size_t length;
        FILE *out = open_memstream(&text, &length);
        for (int i = 1; i < last; i++) {
            fprintf(out, "float f%d(float);", i);
        }
        for (int i = 1; i < last - 1; i++) {
            fprintf(out, "float f%d(float a) { return f%d(a); }\n", i, i + 1);
        }
        fprintf(out, "float f%d(float a) { return a; } float sdf(vec3 p) { return f1(p.x); }",
                last - 1);
        fclose(out);
        assert_limit(text, last == 64, "calls inside calls above the maximum 64 (code_depth)");
        free(text);
    }
}

static void size_is_limited(void **state)
{
    (void)state;
    const char *words = "operations, with every call written out, above the maximum 4096";

    /* A statement, the assignment twice for what it computes, the cost of one vec3: 7. The return
     * is a statement more. */
    const char *add = "p += p;";
    assert_parts("float sdf(vec3 p) {", add, "", "", "return p.x; }", 4095 / 7, words);
    /* What a compiler needs minutes for: functions that call each other twice. */
    for (int last = 8; last <= 13; last += 5) {
        char *text = NULL;
        size_t length;
        FILE *out = open_memstream(&text, &length);
        fprintf(out, "float f0(float x) { return x * x; }\n");
        for (int i = 1; i <= last; i++) {
            fprintf(out, "float f%d(float x) { return f%d(x) + f%d(x); }\n", i, i - 1, i - 1);
        }
        fprintf(out, "float sdf(vec3 p) { return f%d(p.x); }", last);
        fclose(out);
        assert_limit(text, last == 8, words);
        free(text);
    }
}

/* 512 numbers of them, wherever they stand. */
static void bytes_of_arrays_are_limited(void **state)
{
    (void)state;
    const char *words = "bytes of arrays, with every call written out, above the maximum 2048 "
                        "(code_array_bytes)";

    assert_parts("float sdf(vec3 p) {", "{mat4 a[8];}", "", "", "return p.x; }", 4, words);
    assert_parts("float f(float x) { float a[64]; return x; }\n"
                 "float sdf(vec3 p) { float a = p.x;",
                 "a += f(a);", "", "", "return a; }", 8, words);
    assert_limit("float sdf(vec3 p) { for (int i = 0; i < 9; i++) { float a[64]; } return p.x; }",
                 true, words);
}

/* Little to write and little to run, and minutes of a driver's compiler. */
static void compile_bombs_are_refused(void **state)
{
    (void)state;
    const char *words = "operations, with every call written out, above the maximum 4096";
    const char *head = "float sdf(vec3 p) { float a = p.x;", *tail = "return a; }";

    /* A statement, an assignment, and 52 for the sine. */
    assert_parts(head, "a=sin(a);", "", "", tail, (4096 - 2) / 54, words);
    const char *const parts[] = {"a = pow(a, 0.5);",         "a = fbm(p + a, 8);",
                                 "a = noise(p + a);",        "a = atan(a, p.y);",
                                 "p = normalize(p.zxy);",    "a = float(int(a) / int(p.x));",
                                 "if (a < p.x) return p.y;", "for (int i = 0; i < 2; i++) {}"};
    static const size_t most[] = {110, 12, 22, 60, 180, 10, 80, 90};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        char *text = repeated(head, parts[i], most[i], tail);
        assert_limit(text, false, words);
        free(text);
    }
    assert_limit("float sdf(vec3 p) { mat4 m[64]; m[int(p.x)][int(p.y)][int(p.z)] = 1.0;\n"
                 "return p.x; }",
                 false, "bytes of arrays");
    assert_limit("float sdf(vec3 p) { mat4 m[8]; m[int(p.x)][int(p.y)][int(p.z)] = 1.0;\n"
                 "return p.x; }",
                 false, words);
    assert_limit("float sdf(vec3 p) { vec4 m[32]; m[int(p.x)][int(p.y)] = 1.0; return p.x; }",
                 false, words);
    assert_limit("float sdf(vec3 p) { mat3 m = mat3(1.0); m[int(p.x)][int(p.y)] = p.z;\n"
                 "return m[int(p.z)][int(p.x)]; }",
                 true, words);
    /* What is indexed by numbers that are known is not spread. */
    assert_limit("float sdf(vec3 p) { mat4 m[8]; m[7][1][2] = p.x; return m[7][1][2]; }", true,
                 words);
}

static void trips_are_limited(void **state)
{
    (void)state;
    const char *words = "iterations of loops above the maximum 256 (code_trips)";

    assert_limit("float sdf(vec3 p) { for (int i = 0; i < 256; i++) {} return 1.0; }", true, words);
    assert_limit("float sdf(vec3 p) { for (int i = 0; i < 257; i++) {} return 1.0; }", false,
                 words);
    assert_limit(
        "float sdf(vec3 p) { for (int i = 0; i < 16; i++) for (int j = 0; j < 15; j++) {}\n"
        "return 1.0; }",
        true, words);
    assert_limit(
        "float sdf(vec3 p) { for (int i = 0; i < 16; i++) for (int j = 0; j < 15; j++) {}\n"
        "for (int i = 0; i < 1; i++) {} return 1.0; }",
        false, words);
    const char *head = "float f(vec3 p) { for (int i = 0; i < 64; i++) {} return 1.0; }\n"
                       "float sdf(vec3 p) { return 1.0";
    assert_parts(head, " + f(p)", "", "", "; }", 4, words);
}

static void work_is_limited(void **state)
{
    (void)state;
    const char *words = "with its loops run through, above the maximum 65536 (code_work)";

    /* 255 times 256 operations: the pass itself, 36 statements of 7, and three of one. */
    const char *head = "float sdf(vec3 p) { for (int i = 0; i < 255; i++) {";
    assert_parts(head, "p += p;", "1;1;1;", "", "} return p.x; }", 36, words);
    assert_parts("float f(vec3 p) { for (int i = 0; i < 16; i++) {", "p += p;", "", "",
                 "} return p.x; } float sdf(vec3 p) { float s = 0.0;\n"
                 "for (int i = 0; i < 15; i++) s += f(p); return s; }",
                 38, words);
}

static void arrays_and_parameters_are_limited(void **state)
{
    (void)state;
    assert_limit("float sdf(vec3 p) { float a[64]; return a[int(p.x)]; }", true, "");
    assert_limit("float sdf(vec3 p) { float a[65]; return a[int(p.x)]; }", false, "code_array");
    assert_parts("float sdf(vec3 p) { float a[] = {1.0", ", 1.0", "", "", "}; return a[1]; }", 63,
                 "elements of an array above the maximum 64 (code_array)");
    assert_parts("float f(int i", ", float", "", "",
                 ") { return 1.0; } float sdf(vec3 p) { return 1.0; }", 15,
                 "parameters of a function above the maximum 16");
}

/* --- hostile texts --- */

/* Whatever it is, it is refused with a place inside of it, or it runs. */
static void try_text(const char *text)
{
    static const double at_point[3] = {0.5, -1.5, 2.5};
    struct error err = {0};
    struct code_source source = {CODE_DISTANCE, text, no_params, false};
    struct code *code = code_compile(&source, &err);

    if (!code) {
        assert_true(err.line >= 1 && err.column >= 1 && err.message[0] != '\0');
        return;
    }
    struct code_fault fault;
    const double d = code_distance(code, at_point, NULL, NULL);
    assert_true(isfinite(d));
    code_distance(code, at_point, NULL, &fault);
    char *written = NULL;
    size_t length;
    FILE *out = open_memstream(&written, &length);
    code_write(code, "user_0", 1, out);
    fclose(out);
    assert_true(length > 0 && !strstr(written, "__"));
    free(written);
    code_destroy(code);
}

static void damaged_code_is_refused_or_runs(void **state)
{
    enum { ROUNDS = 60, SIZE = 4096 };
    (void)state;
    struct random random = {.state = 20261121};
    struct code_blocks blocks = code_blocks_read("tests/code/accepted.glsl");
    char text[SIZE];
    for (size_t i = 0; i < blocks.count; i++) {
        for (int round = 0; round < ROUNDS; round++) {
            snprintf(text, sizeof text, "%s", blocks.rows[i].text);
            for (size_t k = 1 + random_below(&random, 4); k > 0; k--) {
                random_code_damage(&random, text, sizeof text);
            }
            try_text(text);
        }
    }
    code_blocks_finish(&blocks);
}

static void tokens_in_any_order_are_refused_or_run(void **state)
{
    static const char *const words[] = {
        "float", "vec3", "int",   "p",      "a",     "sdf", "(",   ")",     "{",      "}",
        "[",     "]",    ";",     ",",      ".x",    ".xy", "=",   "+=",    "+",      "-",
        "*",     "/",    "++",    "?",      ":",     "<",   "&&",  "1",     "2.5",    "0",
        "for",   "if",   "else",  "return", "const", "in",  "out", "sin",   "length", "true",
        "void",  "mat3", "break", "!",      "~",     "<<",  "%",   "ivec2", "uint",   "bool"};

    enum { WORDS = sizeof words / sizeof words[0], ROUNDS = 4000 };
    struct random random = {.state = 7};
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        char *text = NULL;
        size_t length;
        FILE *out = open_memstream(&text, &length);
        fputs("float sdf(vec3 p) { float a = 1.0; ", out);
        for (size_t k = 1 + random_below(&random, 30); k > 0; k--) {
            fprintf(out, "%s ", words[random_below(&random, WORDS)]);
        }
        fputs("; return a; }", out);
        fclose(out);
        try_text(text);
        free(text);
    }
}

/* The greatest texts of every kind take no long time, and no deep stack. */
static void long_texts_are_read_quickly(void **state)
{
    static const char *const parts[] = {
        "(",
        "[",
        "{",
        "-",
        "+1",
        "a.",
        ";",
        "p=",
        "if(",
        "if(true)",
        "else",
        "1?",
        ",1",
        "f(",
        "float a;",
        "float f();",
        "int f(int a){return a;}",
        "//\n",
        "/*",
        "/",
        "sin(",
        "vec3(",
        "const",
        "a b ",
        "1.",
        "1e",
        "0x",
        "in ",
        "{;}",
        "for(",
        "for(int i=0;i<1;i++)",
        "x,",
        "float[",
        "(float)",
        "!",
        "p.x+",
        "a[",
        "mat4 m;",
        "\n",
        "é",
        "\xff",
    };
    static const char *const heads[] = {"", "float sdf(vec3 p) { ", "float sdf(vec3 p) { return ",
                                        "float sdf(vec3 p) { float a = ", "float a = "};
    (void)state;

    for (size_t h = 0; h < sizeof heads / sizeof heads[0]; h++) {
        for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
            const size_t count = (LIMIT_CODE_BYTES - strlen(heads[h])) / strlen(parts[i]);
            char *text = repeated(heads[h], parts[i], count, "");
            try_text(text);
            free(text);
        }
    }
}

static void many_names_are_read_quickly(void **state)
{
    (void)state;
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    fprintf(out, "float sdf(vec3 p) { float a0 = p.x;");
    for (int i = 1; i < 600; i++) {
        fprintf(out, "float a%d = a%d * 1.001;", i, i / 2);
    }
    fprintf(out, "return a599; }");
    fclose(out);
    assert_true(length <= LIMIT_CODE_BYTES);
    struct code_source source = {CODE_DISTANCE, text, no_params, false};
    struct code *code = code_compile(&source, NULL);
    assert_non_null(code);
    assert_float_equal(code_distance(code, (double[3]){1, 0, 0}, NULL, NULL), pow(1.001, 10), 1e-9);
    code_destroy(code);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refused_code_says_why_and_where),
        cmocka_unit_test(bytes_are_limited),
        cmocka_unit_test(depth_is_limited),
        cmocka_unit_test(assignments_in_a_row_are_limited),
        cmocka_unit_test(rows_of_operators_are_limited),
        cmocka_unit_test(calls_are_limited),
        cmocka_unit_test(size_is_limited),
        cmocka_unit_test(bytes_of_arrays_are_limited),
        cmocka_unit_test(compile_bombs_are_refused),
        cmocka_unit_test(trips_are_limited),
        cmocka_unit_test(work_is_limited),
        cmocka_unit_test(arrays_and_parameters_are_limited),
        cmocka_unit_test(damaged_code_is_refused_or_runs),
        cmocka_unit_test(tokens_in_any_order_are_refused_or_run),
        cmocka_unit_test(long_texts_are_read_quickly),
        cmocka_unit_test(many_names_are_read_quickly),
    };

    return cmocka_run_group_tests_name("refused code", tests, NULL, NULL);
}
