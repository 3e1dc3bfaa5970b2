/* SPDX-License-Identifier: MIT */
/* Users' code in use: declared parameters, shaders, what drivers get, what is found wrong while it
 * runs. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/code/code.h"
#include "renderer/code/types.h"
#include "tests/support/text_file.h"

static const struct param no_params[] = {{.name = NULL}};

static struct code *compile(const char *text, enum code_use use, const struct param *params)
{
    struct error err = {0};
    struct code *code = code_compile(&(struct code_source){use, text, params, false}, &err);

    if (!code) {
        fail_msg("%d:%d: %s\n%s", err.line, err.column, err.message, text);
    }
    return code;
}

/* --- what is around the code --- */

static const struct param every_type[] = {
    {.name = "f", .type = PARAM_FLOAT},
    {.name = "i", .type = PARAM_INT},
    {.name = "b", .type = PARAM_BOOL},
    {.name = "v2", .type = PARAM_VEC2},
    {.name = "v3", .type = PARAM_VEC3},
    {.name = "v4", .type = PARAM_VEC4},
    {.name = "c", .type = PARAM_COLOR},
    {.name = "i2", .type = PARAM_IVEC2},
    {.name = "i3", .type = PARAM_IVEC3},
    {.name = "i4", .type = PARAM_IVEC4},
    {.name = NULL},
};
static const double every_number[24] = {0.5,  3,   1,    2, 4,  5,  6,  7,  8,  9,  10, 11,
                                        0.25, 0.5, 0.75, 7, -3, 20, 21, 22, 30, 31, 32, 33};

static double run_with_params(const char *text)
{
    struct code *code = compile(text, CODE_DISTANCE, every_type);
    const double d = code_distance(code, (double[3]){0, 0, 0}, every_number, NULL);

    code_destroy(code);
    return d;
}

static void parameters_are_variables(void **state)
{
    (void)state;
    assert_float_equal(run_with_params("float sdf(vec3 p) { return b ? f + i : 0.0; }"), 3.5, 0);
    assert_float_equal(run_with_params("float sdf(vec3 p) { return dot(v2, v4.zw) + v3.z; }"),
                       2 * 10 + 4 * 11 + 7, 0);
    assert_float_equal(run_with_params("int i; float3 c; const int K = 2; float4 v4;\n"
                                       "float sdf(vec3 p) { return c.y + v4[K] + i / 2; }"),
                       0.5 + 10 + 1, 0);
    assert_float_equal(run_with_params("float g() { return f; }\n"
                                       "float sdf(vec3 p) { float f = 2.0; return f * g(); }"),
                       1, 0);
    /* Whole numbers divide as such, and come from the nearest. */
    assert_float_equal(run_with_params("int2 i2; ivec3 i3;\nfloat sdf(vec3 p) {\n"
                                       "int2 half_of = i2 / 2; return half_of.x + half_of.y; }"),
                       3 - 1, 0);
    assert_float_equal(run_with_params("float sdf(vec3 p) { return i3[2] % 5 + (i4.wz / 4).x; }"),
                       2 + 8, 0);
    /* All of them in a row. */
    assert_float_equal(run_with_params("float sdf(vec3 p, Primitive3D q) { float s = 0.0;\n"
                                       "for (int k = 0; k < 24; k++) s += q.data[k]; return s; }"),
                       0.5 + 3 + 1 + 2 + 4 + 5 + 6 + 7 + 8 + 9 + 10 + 11 + 1.5 + 4 + 63 + 126, 0);
}

static void parameters_are_not_assigned(void **state)
{
    static const struct {
        const char *text;
        int line, column;
        const char *words;
    } rows[] = {
        {"float sdf(vec3 p) { f = 1.0; return f; }", 1, 21, "which can only read it"},
        {"float sdf(vec3 p) {\n v3.x += 1.0; return f; }", 2, 2, "which can only read it"},
        {"float2 v3;\nfloat sdf(vec3 p) { return 1.0; }", 1, 8, "v3 is declared as vec3, not vec2"},
        {"float2 i2;\nfloat sdf(vec3 p) { return 1.0; }", 1, 8,
         "i2 is declared as ivec2, not vec2"},
        {"const float f = 2.0;", 1, 13, "f is a parameter, which has its value from outside"},
        {"const float k = f;", 1, 17, "its value must be constant"},
        {"float sdf(vec3 p) { float a[i]; return 1.0; }", 1, 29, "constant int"},
        {"float sdf(vec3 p) { for (int k = 0; k < i; k++) {} return 1.0; }", 1, 39,
         "the bound of the loop is not constant"},
        {"float sdf(vec3 p, Primitive3D q) { return q.data[24]; }", 1, 50, "outside of float[24]"},
        {"float sdf(vec3 p) { return v5.x; }", 1, 28, "did you mean \"v"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct error err = {0};
        struct code_source source = {CODE_DISTANCE, rows[i].text, every_type, false};
        assert_null(code_compile(&source, &err));
        if (err.line != rows[i].line || err.column != rows[i].column ||
            !strstr(err.message, rows[i].words)) {
            fail_msg("%d:%d: %s\n%s", err.line, err.column, err.message, rows[i].text);
        }
    }
}

static void shaders_see_the_point(void **state)
{
    const struct code_shading at = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}, 13};

    static const struct {
        const char *text;
        double rgba[4];
    } rows[] = {
        {"vec3 shade(FragmentProperties f) { return f.world_position; }", {1, 2, 3, 1}},
        {"vec3 shade(in FragmentProperties f) { return f.object_position; }", {4, 5, 6, 1}},
        {"float3 shade(FragmentProperties f) { return f.world_normal.zyx; }", {9, 8, 7, 1}},
        {"vec3 g(FragmentProperties q) { return q.ray_direction; }\n"
         "vec4 shade(FragmentProperties f) { return vec4(g(f).xy, f.ray_distance, 0.5); }",
         {10, 11, 13, 0.5}},
        {"vec3 shade() { return vec3(0.25); }", {0.25, 0.25, 0.25, 1}},
        {"vec4 shade() { return vec4(-1, 1e6, 2, 3); }", {0, 65504, 2, 1}},
        {"vec3 shade(FragmentProperties f) { return f.world_position / (f.ray_distance - 13.0); }",
         {1, 0, 1, 1}},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double rgba[4];
        struct code *code = compile(rows[i].text, CODE_SHADE, no_params);
        code_shade(code, &at, NULL, rgba, NULL);
        for (int k = 0; k < 4; k++) {
            assert_float_equal(rgba[k], rows[i].rgba[k], 0);
        }
        code_destroy(code);
    }
}

static void loops_are_counted(void **state)
{
    static const struct {
        const char *text;
        int trips;
    } rows[] = {
        {"float sdf(vec3 p) { return 1.0; }", 0},
        {"float sdf(vec3 p) { for (int i = 0; i < 8; i++) {} return 1.0; }", 8},
        {"float f() { for (int i = 0; i < 8; i++) {} return 1.0; }\n"
         "float sdf(vec3 p) { for (int i = 0; i < 3; i++) { f(); } return f() + 1.0; }",
         3 + 3 * 8 + 8},
        {"float sdf(vec3 p) { for (int i = 0; i < 3; i++) { for (int j = 0; j < 5; j++) {} }\n"
         "for (float t = 0.0; t < 1.0; t += 0.1) {} return 1.0; }",
         3 + 15 + 10}, /* ten times 0.1 are less than 1 in a double, but not in a float */
        {"float sdf(vec3 p) { float s = 0; for (int i = 0; i < 3; i++) { s += fbm(p, 2); }\n"
         "return s + noise(p); }",
         3 + 3 * 8},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct code *code = compile(rows[i].text, CODE_DISTANCE, no_params);
        if (code_trips(code) != rows[i].trips) {
            fail_msg("%d iterations, not %d: %s", code_trips(code), rows[i].trips, rows[i].text);
        }
        code_destroy(code);
    }
}

/* --- what drivers get --- */

static char *written(const char *text, const struct param *params)
{
    char *out_text = NULL;
    size_t length;
    struct code *code = compile(text, CODE_DISTANCE, params);
    FILE *out = open_memstream(&out_text, &length);

    code_write(code, "user_7", 33, out);
    fclose(out);
    code_destroy(code);
    return out_text;
}

/* Some drivers do without, so that a comparison of values would not show it. */
static void written_text_is_guarded(void **state)
{
    static const struct {
        const char *text, *has;
    } rows[] = {
        {"int n = int(p.x); return float(8 << n);", "(8 << (user_7_v1 & 31))"},
        {"int n = int(p.x); return float(8u >> n);", "(8u >> (user_7_v1 & 31))"},
        {"int n = int(p.x); return float(8 / n);", "code_div(8, user_7_v1)"},
        {"int n = int(p.x); n %= n; return float(n);",
         "(user_7_v1 = code_rem(user_7_v1, user_7_v1))"},
        {"int n = int(p.x); return p[n];", "user_7_v0[clamp(user_7_v1, 0, 2)]"},
        {"uint n = uint(p.x); float a[4]; return a[n];", "user_7_v2[clamp(user_7_v1, 0u, 3u)]"},
        {"return p.x / p.y;", "(user_7_v0.x / code_nonzero(user_7_v0.y))"},
        {"return p.x / 2;", "(user_7_v0.x / 2.0)"},
        {"return atan(p.x, p.y);", "code_atan(user_7_v0.x, user_7_v0.y)"},
        {"return clamp(p.x, 1, p.y);", "min(max(user_7_v0.x, 1.0), user_7_v0.y)"},
        {"float a; vec2 b[2]; return a;", "vec2[2] user_7_v2 = vec2[2](vec2(0.0, 0.0), vec2(0.0"},
        {"vec3 a; return a.x;", "vec3 user_7_v1 = vec3(0.0, 0.0, 0.0);"},
        {"for (int i = 4; i > 0; i -= 2) p.x += 1.0; return p.x;",
         "for (int user_7_n1 = zero; user_7_n1 < 2; user_7_n1++) {"},
        {"float texture = 1e-10; return -texture;", "user_7_v1 = 1e-10;"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, "float sdf(vec3 p) { %s }", rows[i].text);
        char *glsl = written(text, no_params);
        if (!strstr(glsl, rows[i].has)) {
            fail_msg("%s is not in\n%s", rows[i].has, glsl);
        }
        assert_null(strstr(glsl, "sdf"));
        free(glsl);
    }
}

static void written_text_names_lines(void **state)
{
    (void)state;
    char *glsl = written("const float K[2] = float[2](1.0, 2.0);\n\n"
                         "float g(float a)\n{\n  return K[int(a)] + f; }\n"
                         "float unused(float a) { return a; }\n"
                         "float sdf(vec3 p) {\n  p += 1.0;\n  p.x = v3.y;\n\n  return g(p.x); }",
                         every_type);

    assert_string_equal(
        glsl, "float user_7_d4 = float(0);\nvec3 user_7_d8 = vec3(0);\n"
              "#line 1 33\nconst float[2] user_7_v0 = float[2](1.0, 2.0);\n"
              "#line 3 33\nfloat user_7_f0(float user_7_v1) {\n{\n"
              "return (user_7_v0[clamp(int(code_int(user_7_v1)), 0, 1)] + user_7_d4);\n}\n}\n"
              "#line 7 33\nfloat user_7_f2(vec3 user_7_v3) {\n{\n"
              "#line 8 33\n(user_7_v3 += 1.0);\n(user_7_v3.x = user_7_d8.y);\n"
              "#line 11 33\nreturn user_7_f0(user_7_v3.x);\n}\n}\n"
              "float user_7(vec3 p, float a4, float a5, float a6, vec2 a7, vec3 a8, vec4 a9,"
              " vec3 a10, vec2 a11, vec3 a12, vec4 a13)\n"
              "{\nuser_7_d4 = a4;\nuser_7_d8 = a8;\nreturn code_distance(user_7_f2(p));\n}\n");
    free(glsl);
}

/* --- faults --- */

static void faults_name_the_place(void **state)
{
    static const struct {
        const char *text;
        int line, column;
        const char *words;
    } rows[] = {
        {"float sdf(vec3 p) { return p.x; }", 0, 0, ""},
        {"float sdf(vec3 p) {\n  float a = p.x / (p.y - p.y);\n  return a; }", 2, 17,
         "/ divides by 0"},
        {"float sdf(vec3 p) {\n  vec3 a = p.yyy - p.y;\n  return 1e9 + (a / a).x; }", 3, 19,
         "/ divides by 0"},
        {"float sdf(vec3 p) { float a = exp(p.x * 90.0);\n  return a - a; }", 1, 31,
         "exp gives an infinite number"},
        {"float sdf(vec3 p) { return exp(p.x * 1000.0); }", 1, 28, "exp gives an infinite"},
        {"float sdf(vec3 p) { float a = p.x;\nfor (int i = 0; i < 30; i++)\n a *= 1e3;\n"
         "return a; }",
         3, 4, "* gives an infinite number"},
        {"float f(float x) {\n return 1.0 / x; }\nfloat sdf(vec3 p) { return f(p.x) + f(0.0); }", 2,
         13, "/ divides by 0"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct code_fault fault;
        struct code *code = compile(rows[i].text, CODE_DISTANCE, no_params);
        const double d = code_distance(code, (double[3]){1, 2, 3}, NULL, &fault);
        assert_true(isfinite(d));
        assert_true(rows[i].line == 0 || d == 1e9);
        if (fault.line != rows[i].line || fault.column != rows[i].column ||
            !strstr(fault.message, rows[i].words)) {
            fail_msg("%d:%d: %s\n%s", fault.line, fault.column, fault.message, rows[i].text);
        }
        code_destroy(code);
    }
}

static void probe(const char *text, enum code_use use, double lipschitz, const char *words,
                  int line)
{
    const double low[3] = {-2, -1, -2}, high[3] = {2, 3, 2};
    struct error err = {0};
    struct code *code = compile(text, use, no_params);
    struct code_probe probe;
    bool fits = true;

    code_probe_begin(&probe, code, NULL, low, high, lipschitz);
    while (fits && probe.asked < probe.points) {
        fits = code_probe_ask(&probe, &err);
    }
    if (fits != (words == NULL) || (words && !strstr(err.message, words)) || err.line != line) {
        fail_msg("%d:%d: %s\n%s", err.line, err.column, err.message, text);
    }
    if (words) {
        assert_int_equal(err.kind, ERROR_COMPILE);
    }
    code_destroy(code);
}

static void probes_find_what_is_wrong(void **state)
{
    (void)state;
    probe("float sdf(vec3 p) { return length(p) - 0.5; }", CODE_DISTANCE, 1, NULL, 0);
    probe("float sdf(vec3 p) { return 2.0 * length(p); }", CODE_DISTANCE, 2, NULL, 0);
    probe("float sdf(vec3 p) { return 2.0 * length(p); }", CODE_DISTANCE, 1,
          "changes by up to 2 per unit of length, and declared are 1", 0);
    /* A jump. */
    probe("float sdf(vec3 p) { return p.x > 0.0 ? p.x : p.x + 1.0; }", CODE_DISTANCE, 1,
          "the distance changes by up to", 0);
    /* Steep along a diagonal only. */
    probe("float sdf(vec3 p) { return (p.x + p.y + p.z) * 0.6; }", CODE_DISTANCE, 1, "up to 1.04",
          0);
    /* Steep, but never for long. */
    probe("float sdf(vec3 p) { return length(p) + 0.01 * sin(p.x * 400.0); }", CODE_DISTANCE, 1,
          "up to 4.9", 0);
    /* Not a number in one corner of the box. */
    probe("float sdf(vec3 p) {\n  float a = 1.0;\n"
          "  if (p.x > 1.0 && p.y > 2.0)\n    a = (p.x - p.x) / (p.y - p.y);\n  return a; }",
          CODE_DISTANCE, 1, "/ divides by 0 at the point (", 4);
    probe("float sdf(vec3 p) {\n  float a = exp(200.0 + p.x);\n  return a - a; }", CODE_DISTANCE, 1,
          "exp gives an infinite number at the point (", 2);
    /* Infinite on the way, but not in the end; 0 / 0 in the middle alone; and far away. */
    probe("float sdf(vec3 p) { return 1.0 / (1.0 + exp(p.x * 1000.0)); }", CODE_DISTANCE, 1000,
          NULL, 0);
    probe("float sdf(vec3 p) { vec3 d = p / length(p - vec3(0, 1, 0)); return length(d); }",
          CODE_DISTANCE, 1000, NULL, 0);
    probe("float sdf(vec3 p) { return 1e10; }", CODE_DISTANCE, 1, NULL, 0);
    probe("vec3 shade(FragmentProperties f) { return f.world_normal * 9.0; }", CODE_SHADE, 0, NULL,
          0);
    probe("vec3 shade(FragmentProperties f) {\n return f.world_normal / dot(vec3(0), "
          "f.world_normal); }",
          CODE_SHADE, 0, "/ divides by 0", 2);
}

/* Every member, its default and its range, as the protocol's page tells them. */
static void members_of_surface_are_documented(void **state)
{
    (void)state;
    char *page = text_file_read("protocol/README.md", NULL);

    for (int i = 0; i < SURFACE_MEMBERS; i++) {
        const struct surface_member *member = &surface_members[i];
        char row[120];
        snprintf(row, sizeof row, "| `%s` | %s | %g | %g to %.6g |", member->name,
                 member->rows == 3 ? "vec3" : "float", surface_defaults[member->at], member->low,
                 member->high);
        if (!strstr(page, row)) {
            fail_msg("protocol/README.md has no row %s", row);
        }
    }
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parameters_are_variables),
        cmocka_unit_test(parameters_are_not_assigned),
        cmocka_unit_test(shaders_see_the_point),
        cmocka_unit_test(loops_are_counted),
        cmocka_unit_test(written_text_is_guarded),
        cmocka_unit_test(written_text_names_lines),
        cmocka_unit_test(faults_name_the_place),
        cmocka_unit_test(probes_find_what_is_wrong),
        cmocka_unit_test(members_of_surface_are_documented),
    };

    return cmocka_run_group_tests_name("code in use", tests, NULL, NULL);
}
