/* SPDX-License-Identifier: MIT */
/* Users' code: what the texts of tests/code give, with parameters and as shaders; what is found
 * wrong while it runs. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/code/code.h"
#include "tests/support/code_blocks.h"

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
    X(comparison_of_vectors, \
      (x < 0 || y < 0 || z < 0) + 2 * (x < 0 && y < 0 && z < 0) + 4 * !(y < 0)) \
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accepted_code_gives_its_values),
        cmocka_unit_test(listings_of_the_thesis_run),
        cmocka_unit_test(parameters_are_variables),
        cmocka_unit_test(parameters_are_not_assigned),
        cmocka_unit_test(shaders_see_the_point),
        cmocka_unit_test(loops_are_counted),
        cmocka_unit_test(faults_name_the_place),
        cmocka_unit_test(probes_find_what_is_wrong),
    };
    return cmocka_run_group_tests_name("code", tests, NULL, NULL);
}
