/* SPDX-License-Identifier: MIT */
/* Users' code: what the texts of tests/code give. */
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
    struct code *code = code_compile(&(struct code_source){use, text, params, false}, &err);

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
    const int i = fabs(x) < 1 ? 0 : fabs(x) < 2 ? 1 : 2;

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
    const int a = (int)(x * 100);

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
    const double t = clamped(1 - x, 0, 1);

    return t * t * (3 - 2 * t) + 1;
}

static double smooth_union(double a, double b, double k)
{
    const double h = clamped(0.5 + 0.5 * (b - a) / k, 0, 1);

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
    X(large_whole_numbers, fabs(x) > 0.4) \
    X(large_angles, 0 * (x + y + z) + 2) \
    X(stripes_have_one_line_at_a_half, 0 * (x + y + z) + 2) \
    X(one_for_all, 1.5 * (x + y + z) + 0.75) \
    X(matrix_times_vector, x + 3 * y - (2 * x + 4 * y)) \
    X(vector_times_matrix, x + 2 * y - (3 * x + 4 * y)) \
    X(matrix_in_place, cos(0.5) * x - sin(0.5) * z) \
    X(matrix_times_matrix, 2 * x + 4 + x + 3) \
    X(matrix_with_numbers, 2 * x + 0.5 - 3 * x + 1 + 10 * (2 * y + 1)) \
    X(matrix_of_matrix, x + 1 + y) \
    X(matrix_of_whole_numbers, trunc(3 * x) + (x > 0)) \
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
    X(octaves, octaves(x, y, z)) \
    X(cells, fmod(fabs(floor(x) + floor(y) + floor(z)), 2) + 2 * (fraction(x) >= 0.5) + 4) \
    X(noise_between_chances, 0) \
    X(octaves_of_noise, 0) \
    X(three_weights, 1 + pow(y / x, 4) + 2 + 1)
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
            const double want = values[i].value(p[0], p[1], p[2]);
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
    const double along = 2 * fmin(-0.8660254 * x + 0.5 * y, 0);

    x += along * 0.8660254;
    y -= along * 0.5;
    const double side = x - clamped(x, -0.57735 * apothem, 0.57735 * apothem);
    const double d = hypot(side, y - apothem) * ((y > apothem) - (y < apothem)), e = z - half;
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accepted_code_gives_its_values),
        cmocka_unit_test(listings_of_the_thesis_run),
    };

    return cmocka_run_group_tests_name("code", tests, NULL, NULL);
}
