/* SPDX-License-Identifier: MIT */
/* Users' code in C and as the GLSL that is written from it: every function of the table, the texts
 * of tests/code, and random ones agree, at points all over. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/limits.h"
#include "renderer/code/builtins.h"
#include "tests/support/code_batch.h"
#include "tests/support/code_blocks.h"
#include "tests/support/random_code.h"

enum { TEXT_MAX = 8192 };

static const struct param no_params[] = {{.name = NULL}};
static const double numbers[4 * LIMIT_DECLARED] = {0.5, 3, 1,  2,  4,    5,   6,   7,
                                                   8,   9, 10, 11, 0.25, 0.5, 0.75};
static struct code_gpu gpu;

static int setup(void **state)
{
    struct error err = {0};
    (void)state;

    if (!code_gpu_init(&gpu, &err)) {
        print_error("%s\n", err.message);
        return -1;
    }
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    code_gpu_finish(&gpu);
    return 0;
}

static void run_if_full(struct code_batch *batch)
{
    if (batch->count == CODE_BATCH_MAX) {
        code_batch_run(batch, 0);
    }
}

/* --- every function of the table --- */

static const char *const vectors[] = {"", "float", "vec2", "vec3", "vec4"};

/* An argument of so many components, different for each place: what a GPU makes of `mod(x, x)` is 0
 * or x, as its quotients are rounded. */
static void write_argument(FILE *out, const char *type, int rows, int place)
{
    static const char *const parts[] = {"p.x",
                                        "p.y",
                                        "p.z * 0.5 + 0.25",
                                        "p.x * 0.75 - p.z",
                                        "p.x + 0.6 * p.y",
                                        "p.z - 0.3 * p.y",
                                        "p.y * 0.9 - p.x"};

    enum { PARTS = sizeof parts / sizeof parts[0] };

    fprintf(out, "%s(", type);
    for (int i = 0; i < rows; i++) {
        fprintf(out, "%s%s", i > 0 ? ", " : "", parts[(i + place) % PARTS]);
    }
    fputc(')', out);
}

static void write_matrix(FILE *out, int size, int place)
{
    fprintf(out, "mat%d(", size);
    for (int i = 0; i < size; i++) {
        fprintf(out, "%s", i > 0 ? ", " : "");
        write_argument(out, vectors[size], size, i + place);
    }
    fprintf(out, ") + mat%d(4.0)", size);
}

/* One number of all that the result holds. */
static void write_sum(FILE *out, int rows, int columns)
{
    fprintf(out, "float s = 0.0;\n");
    for (int c = 0; c < columns; c++) {
        for (int r = 0; r < rows; r++) {
            char index[40] = "";
            if (columns > 1) {
                snprintf(index, sizeof index, "[%d][%d]", c, r);
            } else if (rows > 1) {
                snprintf(index, sizeof index, "[%d]", r);
            }
            fprintf(out, "s += float(v%s) * %.2f;\n", index, 1 + 0.25 * (c * rows + r));
        }
    }
    fprintf(out, "return s; }\n");
}

struct shape {
    const char *base; /* "float", "int", "uint", "bool" */
    int rows;
};

static const char *vector_type(struct shape shape)
{
    static const char *const types[][5] = {{"", "float", "vec2", "vec3", "vec4"},
                                           {"", "int", "ivec2", "ivec3", "ivec4"},
                                           {"", "uint", "uvec2", "uvec3", "uvec4"},
                                           {"", "bool", "bvec2", "bvec3", "bvec4"}};
    const int base = shape.base[0] == 'f'   ? 0
                     : shape.base[0] == 'i' ? 1
                     : shape.base[0] == 'u' ? 2
                                            : 3;

    return types[base][shape.rows];
}

/* Places hold floats; whole numbers are some times them, and booleans their signs. */
static void write_typed(FILE *out, struct shape shape, int place)
{
    if (shape.base[0] == 'b') {
        if (shape.rows == 1) {
            fprintf(out, "%s > 0.0", place % 2 == 0 ? "p.x" : "p.y");
            return;
        }
        fprintf(out, "greaterThan(");
        write_argument(out, vectors[shape.rows], shape.rows, place);
        fprintf(out, ", %s(0.1))", vectors[shape.rows]);
    } else if (shape.base[0] == 'f') {
        write_argument(out, vectors[shape.rows], shape.rows, place);
    } else {
        fprintf(out, "%s(3.0 * abs(", vector_type(shape));
        write_argument(out, vectors[shape.rows], shape.rows, place);
        fprintf(out, "))%s", shape.base[0] == 'i' ? " - 2" : "");
    }
}

/* `in` are the arguments; a row of 0 marks their end. */
static void add_call(struct code_batch *batch, const struct builtin *row, const struct shape *in,
                     struct shape result)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    fprintf(out, "float sdf(vec3 p) { %s v = %s(", vector_type(result), row->name);
    for (int i = 0; i < row->arguments; i++) {
        fprintf(out, "%s", i > 0 ? ", " : "");
        write_typed(out, in[i], i);
    }
    fprintf(out, ");\n");
    write_sum(out, result.rows, 1);
    fclose(out);
    code_batch_add(batch, text, CODE_DISTANCE, no_params);
    free(text);
    run_if_full(batch);
}

static void add_same(struct code_batch *batch, const struct builtin *row, const char *base,
                     int rows, struct shape result)
{
    const struct shape one = {base, rows}, in[] = {one, one, one};

    add_call(batch, row, in, result);
}

static void add_matrices(struct code_batch *batch, const struct builtin *row, int size)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    const bool number = row->family == FAMILY_DETERMINANT, vector = row->family == FAMILY_OUTER;

    fputs("float sdf(vec3 p) { ", out);
    if (number) {
        fputs("float", out);
    } else {
        fprintf(out, "mat%d", size);
    }
    fprintf(out, " v = %s(", row->name);
    for (int i = 0; i < row->arguments; i++) {
        fprintf(out, "%s", i > 0 ? ", " : "");
        if (vector) {
            write_argument(out, vectors[size], size, i);
        } else {
            write_matrix(out, size, i);
        }
    }
    fprintf(out, ");\n");
    write_sum(out, number ? 1 : size, number ? 1 : size);
    fclose(out);
    code_batch_add(batch, text, CODE_DISTANCE, no_params);
    free(text);
    run_if_full(batch);
}

static void add_products(struct code_batch *batch, const struct builtin *row, int size)
{
    static const char *const arguments[] = {"(m, v)", "(v, m)", "(m, m + m)[1]", "(2.0, v)"};

    for (size_t i = 0; i < sizeof arguments / sizeof arguments[0]; i++) {
        char *text = NULL;
        size_t length;
        FILE *out = open_memstream(&text, &length);
        fprintf(out, "float sdf(vec3 p) { mat%d m = ", size);
        write_matrix(out, size, 0);
        fprintf(out, "; vec%d v = ", size);
        write_argument(out, vectors[size], size, 1);
        fprintf(out, "; v = %s%s;\n", row->name, arguments[i]);
        write_sum(out, size, 1);
        fclose(out);
        code_batch_add(batch, text, CODE_DISTANCE, no_params);
        free(text);
        run_if_full(batch);
    }
}

/* Rows of vectors of several components. */
static void add_vectors(struct code_batch *batch, const struct builtin *row, int rows)
{
    const struct shape b = {"bool", rows};

    switch (row->family) {
    case FAMILY_EQUAL:
        add_same(batch, row, "bool", rows, b);
        /* fall through */
    case FAMILY_COMPARE:
        add_same(batch, row, "float", rows, b);
        add_same(batch, row, "int", rows, b);
        add_same(batch, row, "uint", rows, b);
        break;
    case FAMILY_LOGIC:
        add_same(batch, row, "bool", rows, b);
        break;
    case FAMILY_COUNT:
        add_same(batch, row, "bool", rows, (struct shape){"bool", 1});
        break;
    case FAMILY_MATRIX:
    case FAMILY_DETERMINANT:
    case FAMILY_OUTER:
        add_matrices(batch, row, rows);
        break;
    case FAMILY_PRODUCT:
        add_products(batch, row, rows);
        break;
    default:
        break;
    }
}

/* Rows of three components. */
static void add_three(struct code_batch *batch, const struct builtin *row)
{
    const struct shape one = {"float", 1}, octaves[] = {{"float", 3}, {"int", 1}};

    switch (row->family) {
    case FAMILY_CROSS:
        add_same(batch, row, "float", 3, octaves[0]);
        break;
    case FAMILY_PLACE:
        add_same(batch, row, "float", 3, one);
        break;
    case FAMILY_OCTAVES:
        add_call(batch, row, octaves, one);
        break;
    default:
        break;
    }
}

/* A jet whose least numbers are below its greatest ones; a dual; ends of powers; a number. */
static void write_jet_argument(FILE *out, int size, int place)
{
    if (size == BUILTIN_JET) {
        fprintf(out, "mat3(p%s - abs(p.yzx), p%s + abs(p.yxx), vec3(p.%c - 0.3, p.%c + 0.4, 0.0))",
                place == 0 ? "" : ".zxy", place == 0 ? "" : ".zxy", "xy"[place], "xy"[place]);
    } else {
        write_argument(out, vectors[size], size, place);
    }
}

static void add_jet(struct code_batch *batch, const struct builtin *row)
{
    const bool jet = row->sizes[0] == BUILTIN_JET;
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    fprintf(out, "float sdf(vec3 p) { %s v = %s(", jet ? "mat3" : vectors[row->sizes[0]],
            row->name);
    for (int i = 0; i < row->arguments; i++) {
        fprintf(out, "%s", i > 0 ? ", " : "");
        write_jet_argument(out, row->sizes[1 + i], i);
    }
    fprintf(out, ");\n");
    write_sum(out, jet ? 3 : row->sizes[0], jet ? 3 : 1);
    fclose(out);
    code_batch_add(batch, text, CODE_DISTANCE, no_params);
    free(text);
    run_if_full(batch);
}

/* All shapes and bases that the row takes. */
static void add_row(struct code_batch *batch, const struct builtin *row, int rows)
{
    const struct shape f = {"float", rows}, one = {"float", 1}, b = {"bool", rows};
    const struct shape select[] = {f, f, b}, refract[] = {f, f, one}, wide[] = {one, f, f};

    switch (row->family) {
    case FAMILY_NUMBER:
        add_same(batch, row, "uint", rows, (struct shape){"uint", rows});
        /* fall through */
    case FAMILY_SIGNED:
        add_same(batch, row, "int", rows, (struct shape){"int", rows});
        /* fall through */
    case FAMILY_FLOAT:
        add_same(batch, row, "float", rows, f);
        if (row->arguments > 1 && rows > 1) {
            add_call(batch, row, wide, f); /* a number for a vector */
        }
        break;
    case FAMILY_SHAPE:
        add_same(batch, row, "float", rows, f);
        break;
    case FAMILY_SELECT:
        add_call(batch, row, select, f);
        break;
    case FAMILY_TEST:
        add_same(batch, row, "float", rows, b);
        break;
    case FAMILY_SCALAR:
        add_same(batch, row, "float", rows, one);
        break;
    case FAMILY_REFRACT:
        add_call(batch, row, refract, f);
        break;
    default:
        if (rows > 1) {
            add_vectors(batch, row, rows);
        }
        if (rows == 3) {
            add_three(batch, row);
        }
    }
}

static void every_function_agrees(void **state)
{
    struct code_batch batch = {.gpu = &gpu, .numbers = numbers};
    (void)state;

    for (const struct builtin *row = builtin_table; row->name; row++) {
        for (int rows = 1; rows <= 4; rows++) {
            add_row(&batch, row, rows);
        }
    }
    code_batch_run(&batch, 0);
}

/* The engine runs these in test_implicit. */
static void functions_of_equations_agree(void **state)
{
    struct code_batch batch = {.gpu = &gpu, .numbers = numbers, .ours = true};
    (void)state;

    for (const struct builtin *row = builtin_table; row->name; row++) {
        if (row->family == FAMILY_JET) {
            add_jet(&batch, row);
        }
    }
    assert_true(batch.count > 0);
    code_batch_run(&batch, 0);
}

/* Where GLSL has no value, or several. */
static void the_ends_of_domains_agree(void **state)
{
    static const char *const values[] = {
        "sqrt(p.x)",
        "inversesqrt(p.x * 0.0) * 1e-15",
        "log(p.x)",
        "log2(p.x)",
        "log10(p.x)",
        "log(p.x * 0.0)",
        "asin(p.x)",
        "acos(p.x)",
        "acosh(p.x)",
        "atanh(p.x)",
        "pow(p.x, p.y)",
        "pow(p.x * 0.0, abs(p.y) + 0.5)",
        "pow(p.x * 0.0, 0.0)",
        "atan(p.x * 0.0, p.y * 0.0)",
        "atan(0.0, p.x)",
        "mod(p.x, p.y * 0.0)",
        "fmod(p.x, p.y * 0.0)",
        "smoothstep(p.x, p.x, p.y)",
        "smoothstep(1.0, -1.0, p.x)",
        "clamp(p.x, 1.0, -1.0)",
        "normalize(p * 0.0).x",
        "normalize(p * 1e-16).x",
        "inverse(mat2(p.x, p.x, p.x, p.x))[0][0]",
        "exp(abs(p.x) * 100.0 + 100.0)",
        "1.0 / (p.x * 0.0)",
        "(p.x * 0.0) / (p.y * 0.0)",
        "(mat2(p.x, p.y, p.z, 1.0) / (mat2(p.y) * 0.0))[0][1] * 1e-30",
        "(mat3(p.x) / mat3(p.y))[2][0]",
        "float(int(p.x * 1e10))",
        "float(uint(p.x * 1e10))",
        "float(7 / int(p.x))",
        "float(7 % int(p.x))",
        "float(7u / uint(abs(p.x)))",
        "float(-2147483647 - 1 + int(p.x * 0.01)) / float(int(p.y))",
        "float((-2147483647 - 1 + int(p.x * 0.01)) / (int(p.y) - 1))",
        "float(int(p.x * 9.0) << int(p.y * 40.0)) * 1e-6",
        "float(-1000 >> int(p.y * 40.0))",
        "float(4000000000u >> int(p.y * 40.0)) * 1e-6",
        "round(p.x * 4.0 + 0.5)",
        "float(int(p.x * 1e5) * int(p.y * 1e5))",
    };
    struct code_batch batch = {.gpu = &gpu, .numbers = numbers};
    (void)state;

    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        char text[TEXT_MAX];
        snprintf(text, sizeof text, "float sdf(vec3 p) { return %s; }", values[i]);
        code_batch_add(&batch, text, CODE_DISTANCE, no_params);
        run_if_full(&batch);
    }
    code_batch_run(&batch, 0);
}

/* --- whole texts --- */

static void accepted_code_agrees(void **state)
{
    (void)state;
    struct code_batch batch = {.gpu = &gpu, .numbers = numbers};
    struct code_blocks blocks = code_blocks_read("tests/code/accepted.glsl");

    for (size_t i = 0; i < blocks.count; i++) {
        code_batch_add(&batch, blocks.rows[i].text, CODE_DISTANCE, no_params);
        run_if_full(&batch);
    }
    code_batch_run(&batch, 0);
    code_blocks_finish(&blocks);
}

static void listings_of_the_thesis_agree(void **state)
{
    static const struct param size[] = {{.name = "h", .type = PARAM_VEC2}, {.name = NULL}};
    static const struct param blend[] = {{.name = "_Color1", .type = PARAM_COLOR},
                                         {.name = "_Color2", .type = PARAM_COLOR},
                                         {.name = "_Blend", .type = PARAM_FLOAT},
                                         {.name = NULL}};
    (void)state;
    struct code_batch batch = {.gpu = &gpu, .numbers = numbers};
    struct code_blocks blocks = code_blocks_read("tests/code/thesis.glsl");

    code_batch_add(&batch, blocks.rows[0].text, CODE_DISTANCE, size);
    code_batch_add(&batch, blocks.rows[1].text, CODE_SHADE, blend);
    code_batch_run(&batch, 0);
    code_blocks_finish(&blocks);
}

static void parameters_and_shaders_agree(void **state)
{
    static const struct param types[] = {
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
    static const char *const distances[] = {
        "float g() { return f + float(i / 2); } float sdf(vec3 p) { return b ? g() + v2.y : p.x; }",
        "float sdf(vec3 p) { return dot(v3, p) + v4.w - c.z; }",
        "int2 i2; float sdf(vec3 p) { int2 h = i2 / 2; return float(h.x * 10 + h.y) + p.x; }",
        "float sdf(vec3 p) { return vec3(i3 % 3).z + float(i4[int(p.x) & 3]) + p.y; }",
        "float sdf(vec3 p, Primitive3D q) { float s = 0.0; for (int k = 0; k < 15; k++)\n"
        "s += q.data[k] * p[k % 3]; return s + q.data[int(p.x * 10.0)]; }",
    };
    static const char *const shaders[] = {
        "vec3 shade(FragmentProperties f) { return f.world_position + vec3(2.5); }",
        "vec4 g(FragmentProperties q, float x) { return vec4(q.object_position, x) + 1.5; }\n"
        "vec4 shade(FragmentProperties s) { return g(s, dot(s.world_normal, s.ray_direction)); }",
        "vec3 shade() { return c * f + vec3(v4.x, i, b ? 1 : 0); }",
        "vec3 shade(FragmentProperties s) { return vec3(s.ray_distance - 9.0, 0.5, 1e9); }",
        "vec3 shade(FragmentProperties s) { return s.world_position / (s.ray_distance * 0.0); }",
    };
    struct code_batch batch = {.gpu = &gpu, .numbers = numbers};
    (void)state;

    for (size_t i = 0; i < sizeof distances / sizeof distances[0]; i++) {
        code_batch_add(&batch, distances[i], CODE_DISTANCE, types);
    }
    for (size_t i = 0; i < sizeof shaders / sizeof shaders[0]; i++) {
        code_batch_add(&batch, shaders[i], CODE_SHADE, types);
    }
    code_batch_run(&batch, 0);
}

static void surfaces_agree(void **state)
{
    static const struct param types[] = {{.name = "tint", .type = PARAM_COLOR}, {.name = NULL}};
    static const char *const shaders[] = {
        "Surface shade(FragmentProperties f) { Surface s; return s; }",
        "Surface shade() { return Surface(); }",
        "Surface shade() { return Surface(tint); }",
        "Surface shade() { Surface s = Surface(0.5); s.color.yz = vec2(0.25, 1); return s; }",
        "Surface shade(FragmentProperties f) { Surface s;\n"
        "s.metallic = f.world_position.x; s.roughness += f.world_position.y;\n"
        "s.reflectivity = 0.5 * f.world_position.z; s.transmission = 1.0 - s.metallic;\n"
        "s.ior = 1.0 + f.world_position.x * f.world_position.x; s.emission[1] = f.ray_distance;\n"
        "s.absorption = abs(f.world_position) * 9.0; s.absorption.x++; return s; }",
        "void wet(inout Surface s, float part) { s.roughness *= part; s.color *= 1.0 - part; }\n"
        "Surface two(Surface a, Surface b, float x) { return x > 0.0 ? a : b; }\n"
        "Surface shade(FragmentProperties f) { const Surface plain = Surface(vec3(0.3));\n"
        "Surface s = plain, t; t.ior = 2.0; wet(s, 0.25);\n"
        "return two(s, t, f.world_position.x); }",
        "void make(out Surface s) { s.emission = vec3(1, 2, 3); }\n"
        "Surface shade() { Surface s = Surface(tint); s.ior = 3.0; make(s); Surface t = s;\n"
        "t.color = s.emission * Surface().ior; return t; }",
        "Surface shade(FragmentProperties f) { Surface s; for (int i = 0; i < 3; i++) {\n"
        "s.color[i] = fract(f.world_position[i]); s.emission[i] += float(i); } return s; }",
        "Surface shade() { Surface s; s.color = vec3(-1, 1e6, 2); s.ior = 9.0; s.metallic = 7.0;\n"
        "s.absorption = vec3(1e6); s.emission = vec3(-1); s.transmission = -3.0; return s; }",
        "Surface shade(FragmentProperties f) { Surface s; s.ior = f.world_position.x / 0.0001 *\n"
        "1e9; return s; }",
    };
    struct code_batch batch = {.gpu = &gpu, .numbers = numbers};
    (void)state;

    for (size_t i = 0; i < sizeof shaders / sizeof shaders[0]; i++) {
        code_batch_add(&batch, shaders[i], CODE_SHADE, types);
    }
    code_batch_run(&batch, 0);
}

/* Comparisons of what is nearly equal, and so on, may turn out otherwise in floats. */
static void random_code_agrees(void **state)
{
    enum { BATCHES = 4, ALLOWED = CODE_GPU_POINTS / 50 };
    struct random random = {.state = 4711};
    struct code_batch batch = {.gpu = &gpu, .numbers = numbers};
    (void)state;
    for (int i = 0; i < BATCHES; i++) {
        while (batch.count < CODE_BATCH_MAX) {
            char *text = random_code_make(&random);
            code_batch_add(&batch, text, CODE_DISTANCE, no_params);
            free(text);
        }
        code_batch_run(&batch, ALLOWED);
    }
}

/* What is accepted, no driver refuses. Values are not compared, as some are beyond what floats
 * hold. */
static void changed_code_compiles(void **state)
{
    enum { TRIES = 6000 };
    struct random random = {.state = 12};
    struct code_batch batch = {.gpu = &gpu, .numbers = numbers};
    struct code_blocks blocks = code_blocks_read("tests/code/accepted.glsl");
    size_t accepted = 0;
    (void)state;
    for (int i = 0; i < TRIES; i++) {
        const char *before = blocks.rows[random_below(&random, blocks.count)].text;
        char text[TEXT_MAX];
        snprintf(text, sizeof text, "%s", before);
        random_code_swap(&random, text, sizeof text);
        struct code_source source = {CODE_DISTANCE, text, no_params, false};
        struct code *code = code_compile(&source, NULL);
        if (code && strcmp(text, before) != 0) {
            code_batch_add(&batch, text, CODE_DISTANCE, no_params);
            accepted++;
        }
        code_destroy(code);
        if (batch.count == CODE_BATCH_MAX) {
            code_batch_run(&batch, CODE_GPU_POINTS);
        }
    }
    code_batch_run(&batch, CODE_GPU_POINTS);
    assert_true(accepted > 200);
    code_blocks_finish(&blocks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_function_agrees),
        cmocka_unit_test(functions_of_equations_agree),
        cmocka_unit_test(the_ends_of_domains_agree),
        cmocka_unit_test(accepted_code_agrees),
        cmocka_unit_test(listings_of_the_thesis_agree),
        cmocka_unit_test(parameters_and_shaders_agree),
        cmocka_unit_test(surfaces_agree),
        cmocka_unit_test(random_code_agrees),
        cmocka_unit_test(changed_code_compiles),
    };

    return cmocka_run_group_tests_name("code in GLSL", tests, setup, teardown);
}
