/* SPDX-License-Identifier: MIT */
/* Users' code: what the texts of tests/code give, why others are refused and where, and every limit
 * from both sides. */
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
#include "tests/support/random_scene.h"

static const struct param no_params[] = {{.name = NULL}};

static struct code *compile(const char *text, enum code_use use, const struct param *params)
{
    struct error err = {0};
    struct code *code = code_compile(&(struct code_source){use, text, params}, &err);
    if (!code) {
        fail_msg("%d:%d: %s\n%s", err.line, err.column, err.message, text);
    }
    return code;
}

/* --- values --- */

static double clamped(double v, double low, double high)
{
    return fmin(fmax(v, low), high);
}

static double fraction(double v)
{
    return v - floor(v);
}

static double length3(double x, double y, double z)
{
    return sqrt(x * x + y * y + z * z);
}

static double box(double x, double y, double z)
{
    double q[3] = {fabs(x) - 1, fabs(y) - 0.5, fabs(z) - 0.25};
    return length3(fmax(q[0], 0), fmax(q[1], 0), fmax(q[2], 0)) +
           fmin(fmax(q[0], fmax(q[1], q[2])), 0);
}

static double index_of_vector(double x, double y, double z)
{
    const double p[3] = {x, y, z};
    int i = fabs(x) < 1 ? 0 : fabs(x) < 2 ? 1 : 2;
    return 3 + p[2] * (i >= 0);
}

static double break_and_continue(double x)
{
    double sum = 0;
    for (int i = 0; i < 9 && i <= x + 4.5; i++) {
        sum += i == 2 ? 0 : i;
    }
    return sum;
}

static double int_division_of_vectors(double x, double y)
{
    int a[2] = {(int)(x * 10) / 2 % 3, (int)(y * 10) / 2 % 3};
    return a[0] + a[1] * 10 + (int)(fabs(y) * 10) / 3 * 100;
}

static double int_bits(double x)
{
    int a = (int)(x * 100);
    return ((a & 15) | 32) + (a ^ 5) + ~a + (int)((unsigned)a << 2) + (a >> 1);
}

static double hash(double x)
{
    uint32_t h = (uint32_t)(int32_t)floor(x * 8) * 747796405u + 2891336453u;
    h = ((h >> ((h >> 28) + 4u)) ^ h) * 277803737u;
    return (double)(((h >> 22) ^ h) & 0xffffu) / 65536;
}

static double smoothstep_backwards(double x)
{
    double t = clamped(1 - x, 0, 1);
    return t * t * (3 - 2 * t) + 1;
}

static double smooth_union(double a, double b, double k)
{
    double h = clamped(0.5 + 0.5 * (b - a) / k, 0, 1);
    return b * (1 - h) + a * h - k * h * (1 - h);
}

static double octaves(double x, double y, double z)
{
    double sum = 0, weight = 1;
    for (int i = 1; i <= 5; i++, weight /= 2) {
        sum += weight * sin(x * i + y) * cos(z * i);
    }
    return sum;
}

/* clang-format off */
/* X(name in tests/code/accepted.glsl, value at x, y, z) */
#define VALUES(X) \
    X(sphere, length3(x, y, z) - 0.5) \
    X(box, box(x, y, z)) \
    X(whole_numbers_convert, 2 * x + 1) \
    X(number_forms, x + 0.5 + 1 + 0.1 + 25 + 1 + 16 + 8 + 2 + 1) \
    X(comments, x + 1) \
    X(precedence, x + y * z - x / 4 - 1) \
    X(left_to_right, x - y - z) \
    X(unary_minus, x - y * z) \
    X(swizzle_read, z + y * y + z) \
    X(swizzle_write, x - y + z) \
    X(swizzle_swap, y - x * z + 2 * z * x) \
    X(swizzle_overlaps, z * x + y * x + x * y + x) \
    X(swizzle_of_swizzle, 7 + x) \
    X(swizzle_of_number, x + 1 + y) \
    X(shared_source, x * x + x * y + x * z) \
    X(constructors, 1 + z + 2 + x * x) \
    X(conversions, trunc(x * 3) + 4) \
    X(vector_conversions, 2 * trunc(x * 2) + 10 * trunc(y * 2) + trunc(z * 2)) \
    X(conversions_keep_inside, 0 * (x + y + z)) \
    X(one_for_all, 1.5 * (x + y + z) + 0.75) \
    X(matrix_times_vector, x + 3 * y - (2 * x + 4 * y)) \
    X(vector_times_matrix, x + 2 * y - (3 * x + 4 * y)) \
    X(matrix_in_place, cos(0.5) * x - sin(0.5) * z) \
    X(matrix_times_matrix, 2 * x + 4 + x + 3) \
    X(matrix_with_numbers, 2 * x + 0.5 - 3 * x + 1 + 10 * (2 * y + 1)) \
    X(matrix_of_matrix, x + 1 + y) \
    X(matrix_columns, y + 2) \
    X(rows_of_hlsl, 4 * x + 5 * y + 6 * z + (x + 4 * y + 7 * z) + 6) \
    X(product_of_hlsl, 6 + 2 * x + 3 * (5 * x + 6 * y) + 4 * (7 * x + x * y)) \
    X(spellings_of_hlsl, fraction(0.75 * x + 0.25) + clamped(0.75 * y + 0.25, 0, 1) + 0.5 - 1.5 + \
                             atan2(1, 1) + 2 * (0.75 * z + 0.25) + 1) \
    X(cast_of_c, y + 5) \
    X(static_const, x + 3) \
    X(initial_list, y + 4 + z) \
    X(declared_lists, x) \
    X(zero_at_first, x) \
    X(zero_again, 3 * x) \
    X(array_in_and_out, 4 * x + 2) \
    X(array_index_kept, trunc(x * 100) < 1 ? 1 : trunc(x * 100) < 2 ? 2 : 4) \
    X(array_of_vectors, 7 + (x > 0 ? 6 : y + 1) * 5) \
    X(index_of_vector, index_of_vector(x, y, z)) \
    X(index_of_matrix, (x > 0 ? 2 : y) + 2) \
    X(index_of_value, 2 * y + z + 1 + y) \
    X(index_that_assigns, 21 + x) \
    X(choice, x > 0 ? y : z > 0 ? 1 : -1) \
    X(choice_of_vectors, (x < y ? x : z) + (x < y ? 1 : 2.5)) \
    X(logic, (x > 0 && y > 0) + 2 * (x > 0 || y > 0) + 4 * ((x > 0) != (y > 0)) + 8 * !(x > 0)) \
    X(logic_stops, x > 0 ? 31 : 21) \
    X(comparison, (x <= y) + 2 * (x >= y) + 4 * (x == z) + 8 * (x != y) + 16) \
    X(comparison_of_vectors, (x < 0 || y < 0 || z < 0) + 2 * (x < 0 && y < 0 && z < 0) + 4 * !(y < 0)) \
    X(selection, y > 0 ? x : y) \
    X(if_else, x > 0 ? y : y > 0 ? z : 1) \
    X(early_return, x > 0 ? x : y) \
    X(return_in_both, x > 0 ? x : y) \
    X(loop, 5 * x) \
    X(loop_down, x * (((4 * 0.5 + 3) * 0.5 + 2) * 0.5 + 1)) \
    X(loop_of_floats, 2.5 * y) \
    X(loop_steps, 4 * z) \
    X(loop_of_uint, 12 + x) \
    X(loop_until, 9 * x) \
    X(loop_never, x) \
    X(loop_in_loop, 18 * x) \
    X(break_and_continue, break_and_continue(x)) \
    X(return_in_loop, x < 0 ? 0 : floor(x) + 1) \
    X(increments, 7 + 30 + x + y - 1) \
    X(assignments_have_values, 5 * x) \
    X(comma, 2 + 2 * x) \
    X(int_division, trunc(trunc(x * 10) / 3) + fmod(trunc(x * 10), 3) * 100 - 3) \
    X(int_division_of_vectors, int_division_of_vectors(x, y)) \
    X(int_division_by_zero, 7 + y) \
    X(int_division_of_the_least, -2147483648.0 + y) \
    X(int_bits, int_bits(x)) \
    X(int_wraps, -2147483648.0 + 4294967295.0) \
    X(shift_kept, 2 - 4 + 2 + 2 + 2) \
    X(hash, hash(x)) \
    X(outside_of_domains, -M_PI / 2) \
    X(pow_of_negative, pow(fabs(x) + 0.5, 2) + 1) \
    X(mod_of_zero, y + z + 0.5) \
    X(smoothstep_backwards, smoothstep_backwards(x)) \
    X(constants, 4 * x + 4) \
    X(constant_in_function, 2 * x) \
    X(global_constants, 3.5 * x + x + 3 * y) \
    X(functions, fmin(length3(x, y, z) - 0.5, length3(x - 1, y, z) - 0.25)) \
    X(overloads, 3 * x + 7 + 1 - z) \
    X(out_and_inout, 2 * z - 20 * y + 100 * z) \
    X(out_to_array, x > 0 ? 120 : 12) \
    X(out_is_zero_at_first, x) \
    X(parameters_are_copies, 2 * x + 2 * (2 * x) * x + x) \
    X(array_parameter, 2 * x + 1 + y + z) \
    X(declared_first, 2 * x + 2) \
    X(hides_ours, 5 + (x - 2 * floor(x / 2)) + 3 * y) \
    X(hidden_names, x) \
    X(names_of_drivers, 2 * sin(x) + 5) \
    X(precision_words, x) \
    X(attributes, 2 * x + 1) \
    X(any_name, hypot(hypot(x, z) - 1, y) - 0.25) \
    X(sdf_comes_first, x) \
    X(takes_primitive, x) \
    X(smooth_union, smooth_union(y, length3(x, y, z) - 1, 0.5)) \
    X(octaves, octaves(x, y, z))
/* clang-format on */

#define X(name, value)                                                                             \
    static double value_##name(double x, double y, double z)                                       \
    {                                                                                              \
        (void)x, (void)y, (void)z;                                                                 \
        return value;                                                                              \
    }
VALUES(X)
#undef X

static const struct {
    const char *name;
    double (*value)(double x, double y, double z);
} values[] = {
#define X(name, value) {#name, value_##name},
    VALUES(X)
#undef X
};
enum { VALUE_COUNT = sizeof values / sizeof values[0] };

static const double points[][3] = {{0.3, -0.7, 1.1},   {-1.3, 0.45, -0.2}, {1.9, 1.2, 0.6},
                                   {-0.1, -1.6, -2.3}, {2.4, 0.05, 2.4},   {0.9, 0.9, -0.9}};
enum { POINTS = sizeof points / sizeof points[0] };

static void assert_value(const char *name, const double p[3], double got, double want)
{
    if (!(fabs(got - want) <= 1e-9 * fmax(1, fabs(want)))) {
        fail_msg("%s at (%g, %g, %g): %.12g, not %.12g", name, p[0], p[1], p[2], got, want);
    }
}

static void accepted_code_gives_its_values(void **state)
{
    (void)state;
    struct code_blocks blocks = code_blocks_read("tests/code/accepted.glsl");
    assert_int_equal(blocks.count, VALUE_COUNT);
    for (size_t i = 0; i < blocks.count; i++) {
        assert_string_equal(blocks.rows[i].head, values[i].name);
        struct code *code = compile(blocks.rows[i].text, CODE_DISTANCE, no_params);
        for (int k = 0; k < POINTS; k++) {
            struct code_fault fault;
            const double *p = points[k];
            double want = values[i].value(p[0], p[1], p[2]);
            if (fabs(want) < 1e9) {
                assert_value(values[i].name, p, code_distance(code, p, NULL, NULL), want);
                assert_value(values[i].name, p, code_distance(code, p, NULL, &fault), want);
            }
        }
        code_destroy(code);
    }
    code_blocks_finish(&blocks);
}

/* The thesis' prism: apothem h.x, half height h.y. */
static double hex_prism(const double p[3], double apothem, double half)
{
    double x = fabs(p[0]), y = fabs(p[1]), z = fabs(p[2]);
    double along = 2 * fmin(-0.8660254 * x + 0.5 * y, 0);
    x += along * 0.8660254;
    y -= along * 0.5;
    double side = x - clamped(x, -0.57735 * apothem, 0.57735 * apothem);
    double d = hypot(side, y - apothem) * ((y > apothem) - (y < apothem)), e = z - half;
    return fmin(fmax(d, e), 0) + hypot(fmax(d, 0), fmax(e, 0));
}

static void listings_of_the_thesis_run(void **state)
{
    (void)state;
    static const struct param size[] = {{.name = "h", .type = PARAM_VEC2}, {.name = NULL}};
    static const struct param blend[] = {{.name = "_Color1", .type = PARAM_COLOR},
                                         {.name = "_Color2", .type = PARAM_COLOR},
                                         {.name = "_Blend", .type = PARAM_FLOAT},
                                         {.name = NULL}};
    const double h[2] = {0.5, 0.75}, colors[7] = {0.5, 0.1, 0.5, 0.2, 0.7, 0.6, 0.25};
    const struct code_shading at = {.ray_distance = 1};
    double rgba[4];
    struct code_blocks blocks = code_blocks_read("tests/code/thesis.glsl");
    struct code *prism = compile(blocks.rows[0].text, CODE_DISTANCE, size);
    struct code *shader = compile(blocks.rows[1].text, CODE_SHADE, blend);
    for (int i = 0; i < POINTS; i++) {
        assert_value("hex_prism", points[i], code_distance(prism, points[i], h, NULL),
                     hex_prism(points[i], 0.5, 0.75));
    }
    code_shade(shader, &at, colors, rgba, NULL);
    for (int i = 0; i < 3; i++) {
        assert_float_equal(rgba[i], 0.75 * colors[i] + 0.25 * colors[3 + i], 1e-12);
    }
    assert_float_equal(rgba[3], 1, 0);
    code_destroy(prism);
    code_destroy(shader);
    code_blocks_finish(&blocks);
}

/* --- what is around the code --- */

static const struct param every_type[] = {
    {.name = "f", .type = PARAM_FLOAT}, {.name = "i", .type = PARAM_INT},
    {.name = "b", .type = PARAM_BOOL},  {.name = "v2", .type = PARAM_VEC2},
    {.name = "v3", .type = PARAM_VEC3}, {.name = "v4", .type = PARAM_VEC4},
    {.name = "c", .type = PARAM_COLOR}, {.name = NULL},
};
static const double every_number[15] = {0.5, 3, 1, 2, 4, 5, 6, 7, 8, 9, 10, 11, 0.25, 0.5, 0.75};

static double run_with_params(const char *text)
{
    struct code *code = compile(text, CODE_DISTANCE, every_type);
    double d = code_distance(code, (double[3]){0, 0, 0}, every_number, NULL);
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
    /* All of them in a row. */
    assert_float_equal(run_with_params("float sdf(vec3 p, Primitive3D q) { float s = 0.0;\n"
                                       "for (int k = 0; k < 15; k++) s += q.data[k]; return s; }"),
                       0.5 + 3 + 1 + 2 + 4 + 5 + 6 + 7 + 8 + 9 + 10 + 11 + 1.5, 0);
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
        {"const float f = 2.0;", 1, 13, "f is a parameter, which has its value from outside"},
        {"const float k = f;", 1, 17, "its value must be constant"},
        {"float sdf(vec3 p) { float a[i]; return 1.0; }", 1, 29, "constant int"},
        {"float sdf(vec3 p) { for (int k = 0; k < i; k++) {} return 1.0; }", 1, 39,
         "the bound of the loop is not constant"},
        {"float sdf(vec3 p, Primitive3D q) { return q.data[15]; }", 1, 50, "outside of float[15]"},
        {"float sdf(vec3 p) { return v5.x; }", 1, 28, "did you mean \"v"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct error err = {0};
        struct code_source source = {CODE_DISTANCE, rows[i].text, every_type};
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

/* --- what is refused --- */

static bool refuses(const struct code_block *block)
{
    struct error err = {0};
    const char *head = block->head;
    bool shade = strncmp(head, "shade ", 6) == 0, limit = strncmp(head, "limit ", 6) == 0;
    char *words;
    head += shade || limit ? 6 : 0;
    int line = (int)strtol(head, &words, 10), column = (int)strtol(words + 1, &words, 10);
    struct code_source source = {shade ? CODE_SHADE : CODE_DISTANCE, block->text, no_params};
    struct code *code = code_compile(&source, &err);
    bool right = !code && err.line == line && err.column == column &&
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
    assert_true(blocks.count >= 150);
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
    size_t length = strlen(before) + count * strlen(part) + strlen(after);
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
    struct code_source source = {CODE_DISTANCE, text, no_params};
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
    size_t room = LIMIT_CODE_BYTES - (sizeof code - 1);
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
    assert_parts("float sdf(vec3 p) {", "{mat4 a[64];}", "", "", "return p.x; }", 3, words);
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
        double d = code_distance(code, (double[3]){1, 2, 3}, NULL, &fault);
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
    bool fits = code_probe(code, NULL, low, high, lipschitz, &err);
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

/* --- hostile texts --- */

/* Whatever it is, it is refused with a place inside of it, or it runs. */
static void try_text(const char *text)
{
    static const double at_point[3] = {0.5, -1.5, 2.5};
    struct error err = {0};
    struct code_source source = {CODE_DISTANCE, text, no_params};
    struct code *code = code_compile(&source, &err);
    if (!code) {
        assert_true(err.line >= 1 && err.column >= 1 && err.message[0] != '\0');
        return;
    }
    struct code_fault fault;
    double d = code_distance(code, at_point, NULL, NULL);
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

/* One change: a token taken out, doubled, or taken from elsewhere; or a byte. */
static void damage(struct random *random, char *text, size_t size)
{
    static const char bytes[] = "(){}[];,.+-*/%&|^~!?:=<>#\\\"'09aex_ \n\x80\xff";
    size_t length = strlen(text);
    size_t from = random_below(random, length), to = random_below(random, length);
    size_t count = 1 + random_below(random, 12);
    char part[16];
    count = count < length - from ? count : length - from;
    memcpy(part, text + from, count);
    switch (random_below(random, 4)) {
    case 0:
        memmove(text + from, text + from + count, length - from - count + 1);
        break;
    case 1:
        if (length + count < size) {
            memmove(text + to + count, text + to, length - to + 1);
            memcpy(text + to, part, count);
        }
        break;
    case 2:
        text[to] = bytes[random_below(random, sizeof bytes - 1)];
        break;
    default:
        count = count < length - to ? count : length - to;
        memmove(text + to, part, count);
    }
    if (*text == '\0') {
        strcpy(text, "x");
    }
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
                damage(&random, text, sizeof text);
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
            size_t count = (LIMIT_CODE_BYTES - strlen(heads[h])) / strlen(parts[i]);
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
    struct code *code = compile(text, CODE_DISTANCE, no_params);
    assert_float_equal(code_distance(code, (double[3]){1, 0, 0}, NULL, NULL), pow(1.001, 10), 1e-9);
    code_destroy(code);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accepted_code_gives_its_values),
        cmocka_unit_test(listings_of_the_thesis_run),
        cmocka_unit_test(parameters_are_variables),
        cmocka_unit_test(parameters_are_not_assigned),
        cmocka_unit_test(shaders_see_the_point),
        cmocka_unit_test(loops_are_counted),
        cmocka_unit_test(refused_code_says_why_and_where),
        cmocka_unit_test(bytes_are_limited),
        cmocka_unit_test(depth_is_limited),
        cmocka_unit_test(assignments_in_a_row_are_limited),
        cmocka_unit_test(rows_of_operators_are_limited),
        cmocka_unit_test(calls_are_limited),
        cmocka_unit_test(size_is_limited),
        cmocka_unit_test(trips_are_limited),
        cmocka_unit_test(work_is_limited),
        cmocka_unit_test(arrays_and_parameters_are_limited),
        cmocka_unit_test(faults_name_the_place),
        cmocka_unit_test(probes_find_what_is_wrong),
        cmocka_unit_test(damaged_code_is_refused_or_runs),
        cmocka_unit_test(tokens_in_any_order_are_refused_or_run),
        cmocka_unit_test(long_texts_are_read_quickly),
        cmocka_unit_test(many_names_are_read_quickly),
    };
    return cmocka_run_group_tests_name("code", tests, NULL, NULL);
}
