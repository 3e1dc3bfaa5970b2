/* SPDX-License-Identifier: MIT */
/* Users' code in C and as the GLSL that is written from it: every function of the table, the texts
 * of tests/code, and random ones agree, at points all over. */
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
#include "renderer/code/builtins.h"
#include "tests/support/code_blocks.h"
#include "tests/support/code_gpu.h"
#include "tests/support/random_scene.h"

enum { JOBS_MAX = 40, TEXT_MAX = 8192 };
#define SIZE 2.5       /* half side of the cube of points */
#define TOLERANCE 2e-4 /* of floats, relative to what is greater than 1 */
#define NEARBY 2e-6    /* where a value jumps, that of a point so near will do */

static const struct param no_params[] = {{.name = NULL}};
static struct code_gpu gpu;

/* Codes that run in one program. */
struct batch {
    struct code_gpu_job jobs[JOBS_MAX];
    char *texts[JOBS_MAX];
    size_t count;
};

static float points[CODE_GPU_POINTS][4];
static float answers[JOBS_MAX * CODE_GPU_POINTS][4];
static const double numbers[4 * LIMIT_DECLARED] = {0.5, 3, 1,  2,  4,    5,   6,   7,
                                                   8,   9, 10, 11, 0.25, 0.5, 0.75};

static void add(struct batch *batch, const char *text, enum code_use use,
                const struct param *params)
{
    struct error err = {0};
    struct code *code = code_compile(&(struct code_source){use, text, params}, &err);
    if (!code) {
        fail_msg("%d:%d: %s\n%s", err.line, err.column, err.message, text);
    }
    assert_true(batch->count < JOBS_MAX);
    batch->texts[batch->count] = strdup(text);
    batch->jobs[batch->count++] = (struct code_gpu_job){code, use, params};
}

static void run_in_c(const struct code_gpu_job *job, const double p[3], double out[4])
{
    if (job->use == CODE_SHADE) {
        const struct code_shading at = code_gpu_shading(p);
        code_shade(job->code, &at, numbers, out, NULL);
    } else {
        out[0] = out[1] = out[2] = out[3] = code_distance(job->code, p, numbers, NULL);
    }
}

/* Whether the values lie among those of the point and of those around it. */
static bool agrees(const struct code_gpu_job *job, const float point[3], const float got[4])
{
    double low[4], high[4];
    for (int corner = -1; corner < 8; corner++) {
        double p[3], value[4];
        for (int i = 0; i < 3; i++) {
            p[i] = point[i] + (corner < 0 ? 0 : (corner >> i & 1) ? NEARBY : -NEARBY);
        }
        run_in_c(job, p, value);
        bool all = true;
        for (int i = 0; i < 4; i++) {
            low[i] = corner < 0 ? value[i] : fmin(low[i], value[i]);
            high[i] = corner < 0 ? value[i] : fmax(high[i], value[i]);
            double room = TOLERANCE * fmax(1, fmax(fabs(low[i]), fabs(high[i])));
            all = all && got[i] >= low[i] - room && got[i] <= high[i] + room;
        }
        if (all) {
            return true;
        }
    }
    return false;
}

static void print_difference(const struct batch *batch, size_t job, size_t point)
{
    const double p[3] = {points[point][0], points[point][1], points[point][2]};
    const float *got = answers[job * CODE_GPU_POINTS + point];
    double want[4];
    run_in_c(&batch->jobs[job], p, want);
    fprintf(stderr, /* print_error would cut it */
            "%s\nat (%.9g, %.9g, %.9g): GLSL %.9g %.9g %.9g, C %.9g %.9g %.9g\n", batch->texts[job],
            p[0], p[1], p[2], got[0], got[1], got[2], want[0], want[1], want[2]);
}

static bool is_wrong(const struct batch *batch, size_t job, size_t allowed)
{
    size_t wrong = 0, last = 0;
    for (size_t i = 0; i < CODE_GPU_POINTS; i++) {
        if (!agrees(&batch->jobs[job], points[i], answers[job * CODE_GPU_POINTS + i])) {
            wrong++;
            last = i;
        }
    }
    if (wrong > allowed) {
        print_difference(batch, job, last);
        fprintf(stderr, "%zu points of %d\n", wrong, CODE_GPU_POINTS);
    }
    return wrong > allowed;
}

/* Compares all of them and empties the batch. Of each, so many points may be wrong. */
static void run(struct batch *batch, size_t allowed)
{
    struct error err = {0};
    float floats[4 * LIMIT_DECLARED];
    size_t wrong = 0;
    for (size_t i = 0; i < sizeof floats / sizeof floats[0]; i++) {
        floats[i] = (float)numbers[i];
    }
    if (batch->count > 0 && !code_gpu_run(&gpu, batch->jobs, batch->count,
                                          (const float(*)[4])points, floats, answers, &err)) {
        fail_msg("%s", err.message);
    }
    for (size_t i = 0; i < batch->count; i++) {
        wrong += is_wrong(batch, i, allowed);
    }
    for (size_t i = 0; i < batch->count; i++) {
        code_destroy((struct code *)batch->jobs[i].code);
        free(batch->texts[i]);
    }
    batch->count = 0;
    assert_int_equal(wrong, 0);
}

static void run_if_full(struct batch *batch)
{
    if (batch->count == JOBS_MAX) {
        run(batch, 0);
    }
}

static int setup(void **state)
{
    struct random random = {.state = 99};
    struct error err = {0};
    (void)state;
    for (size_t i = 0; i < CODE_GPU_POINTS; i++) {
        for (int j = 0; j < 3; j++) {
            points[i][j] = (float)random_between(&random, -SIZE, SIZE);
        }
    }
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

/* --- every function of the table --- */

static const char *const vectors[] = {"", "float", "vec2", "vec3", "vec4"};

/* An argument of so many components, different for each place. */
static void write_argument(FILE *out, const char *type, int rows, int place)
{
    static const char *const parts[] = {"p.x", "p.y", "p.z * 0.5 + 0.25", "p.x * 0.75 - p.z"};
    fprintf(out, "%s(", type);
    for (int i = 0; i < rows; i++) {
        fprintf(out, "%s%s", i > 0 ? ", " : "", parts[(i + place) % 4]);
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
    int base = shape.base[0] == 'f' ? 0 : shape.base[0] == 'i' ? 1 : shape.base[0] == 'u' ? 2 : 3;
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
static void add_call(struct batch *batch, const struct builtin *row, const struct shape *in,
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
    add(batch, text, CODE_DISTANCE, no_params);
    free(text);
    run_if_full(batch);
}

static void add_same(struct batch *batch, const struct builtin *row, const char *base, int rows,
                     struct shape result)
{
    const struct shape one = {base, rows}, in[] = {one, one, one};
    add_call(batch, row, in, result);
}

static void add_matrices(struct batch *batch, const struct builtin *row, int size)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    bool number = row->family == FAMILY_DETERMINANT, vector = row->family == FAMILY_OUTER;
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
    add(batch, text, CODE_DISTANCE, no_params);
    free(text);
    run_if_full(batch);
}

static void add_products(struct batch *batch, const struct builtin *row, int size)
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
        add(batch, text, CODE_DISTANCE, no_params);
        free(text);
        run_if_full(batch);
    }
}

/* All shapes and bases that the row takes. */
static void add_row(struct batch *batch, const struct builtin *row, int rows)
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
    case FAMILY_EQUAL:
        if (rows > 1) {
            add_same(batch, row, "bool", rows, b);
        }
        /* fall through */
    case FAMILY_COMPARE:
        if (rows > 1) {
            add_same(batch, row, "float", rows, b);
            add_same(batch, row, "int", rows, b);
            add_same(batch, row, "uint", rows, b);
        }
        break;
    case FAMILY_LOGIC:
    case FAMILY_COUNT:
        if (rows > 1) {
            add_same(batch, row, "bool", rows,
                     row->family == FAMILY_LOGIC ? b : (struct shape){"bool", 1});
        }
        break;
    case FAMILY_SCALAR:
        add_same(batch, row, "float", rows, one);
        break;
    case FAMILY_REFRACT:
        add_call(batch, row, refract, f);
        break;
    case FAMILY_CROSS:
        if (rows == 3) {
            add_same(batch, row, "float", rows, f);
        }
        break;
    case FAMILY_MATRIX:
    case FAMILY_DETERMINANT:
    case FAMILY_OUTER:
        if (rows > 1) {
            add_matrices(batch, row, rows);
        }
        break;
    case FAMILY_PRODUCT:
        if (rows > 1) {
            add_products(batch, row, rows);
        }
        break;
    }
}

static void every_function_agrees(void **state)
{
    struct batch batch = {.count = 0};
    (void)state;
    for (const struct builtin *row = builtin_table; row->name; row++) {
        for (int rows = 1; rows <= 4; rows++) {
            add_row(&batch, row, rows);
        }
    }
    run(&batch, 0);
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
    struct batch batch = {.count = 0};
    (void)state;
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        char text[TEXT_MAX];
        snprintf(text, sizeof text, "float sdf(vec3 p) { return %s; }", values[i]);
        add(&batch, text, CODE_DISTANCE, no_params);
        run_if_full(&batch);
    }
    run(&batch, 0);
}

/* --- whole texts --- */

static void accepted_code_agrees(void **state)
{
    (void)state;
    struct batch batch = {.count = 0};
    struct code_blocks blocks = code_blocks_read("tests/code/accepted.glsl");
    for (size_t i = 0; i < blocks.count; i++) {
        add(&batch, blocks.rows[i].text, CODE_DISTANCE, no_params);
        run_if_full(&batch);
    }
    run(&batch, 0);
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
    struct batch batch = {.count = 0};
    struct code_blocks blocks = code_blocks_read("tests/code/thesis.glsl");
    add(&batch, blocks.rows[0].text, CODE_DISTANCE, size);
    add(&batch, blocks.rows[1].text, CODE_SHADE, blend);
    run(&batch, 0);
    code_blocks_finish(&blocks);
}

static void parameters_and_shaders_agree(void **state)
{
    static const struct param types[] = {
        {.name = "f", .type = PARAM_FLOAT}, {.name = "i", .type = PARAM_INT},
        {.name = "b", .type = PARAM_BOOL},  {.name = "v2", .type = PARAM_VEC2},
        {.name = "v3", .type = PARAM_VEC3}, {.name = "v4", .type = PARAM_VEC4},
        {.name = "c", .type = PARAM_COLOR}, {.name = NULL},
    };
    static const char *const distances[] = {
        "float g() { return f + float(i / 2); } float sdf(vec3 p) { return b ? g() + v2.y : p.x; }",
        "float sdf(vec3 p) { return dot(v3, p) + v4.w - c.z; }",
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
    struct batch batch = {.count = 0};
    (void)state;
    for (size_t i = 0; i < sizeof distances / sizeof distances[0]; i++) {
        add(&batch, distances[i], CODE_DISTANCE, types);
    }
    for (size_t i = 0; i < sizeof shaders / sizeof shaders[0]; i++) {
        add(&batch, shaders[i], CODE_SHADE, types);
    }
    run(&batch, 0);
}

/* --- random code --- */

struct maker {
    struct random *random;
    FILE *out;
    int depth;
};

static const char *pick(struct maker *maker, const char *const *from, size_t count)
{
    return from[random_below(maker->random, count)];
}
#define PICK(maker, from) pick(maker, from, sizeof(from) / sizeof(from)[0])

static void make_value(struct maker *maker, int rows);

/* What is left over when it may go no deeper. */
static void make_leaf(struct maker *maker, int rows)
{
    static const char *const ones[] = {"p.x", "p.y", "a", "b.x", "c[1]", "0.5", "float(n)", "e[n]"};
    static const char *const twos[] = {"p.xy", "p.zx", "b", "c.yz", "vec2(0.5, a)", "m[0].xy"};
    static const char *const threes[] = {"p",          "c",    "p.zxy", "vec3(a)",
                                         "vec3(b, 1)", "m[1]", "m[n]"};
    fputs(rows == 1   ? PICK(maker, ones)
          : rows == 2 ? PICK(maker, twos)
                      : PICK(maker, threes),
          maker->out);
}

static void make_call(struct maker *maker, int rows)
{
    static const struct {
        const char *before;
        int arguments;
    } calls[] = {{"normalize(", 1}, {"sin(", 1},       {"cos(", 1},        {"abs(", 1},
                 {"atan(", 1},      {"sqrt(", 1},      {"min(", 2},        {"max(", 2},
                 {"mix(", 3},       {"clamp(", 3},     {"smoothstep(", 3}, {"tanh(", 1},
                 {"fract(", 1},     {"exp2(-abs(", 1}, {"step(", 2},       {"saturate(", 1}};
    enum { CALLS = sizeof calls / sizeof calls[0] };
    bool jumps = rows == 1; /* normalize() of a number is its sign */
    size_t which = jumps + random_below(maker->random, CALLS - jumps);
    fputs(calls[which].before, maker->out);
    for (int i = 0; i < calls[which].arguments; i++) {
        fputs(i > 0 ? ", " : "", maker->out);
        make_value(maker, rows);
    }
    fputs(strstr(calls[which].before, "(-abs") ? "))" : ")", maker->out);
}

static void make_condition(struct maker *maker)
{
    static const char *const ops[] = {" < ", " > ", " <= ", " >= "};
    static const char *const joins[] = {" && ", " || ", " ^^ "};
    fputc('(', maker->out);
    make_value(maker, 1);
    fputs(PICK(maker, ops), maker->out);
    make_value(maker, 1);
    if (random_below(maker->random, 4) == 0) {
        fputs(PICK(maker, joins), maker->out);
        make_condition(maker);
    }
    fputc(')', maker->out);
}

static void make_joined(struct maker *maker, int rows)
{
    static const char *const ops[] = {" + ", " - ", " * "};
    fputc('(', maker->out);
    make_value(maker, rows);
    fputs(PICK(maker, ops), maker->out);
    make_value(maker, random_below(maker->random, 3) == 0 ? 1 : rows);
    fputc(')', maker->out);
}

static void make_part(struct maker *maker, int rows)
{
    static const char *const parts[][3] = {
        {".z", ".x", ".y"}, {".xy", ".zy", ".xx"}, {".yzx", ".xxz", ".zyx"}};
    fputc('(', maker->out);
    make_value(maker, 3);
    fprintf(maker->out, ")%s", PICK(maker, parts[rows - 1]));
}

static void make_value(struct maker *maker, int rows)
{
    if (maker->depth <= 0 || random_below(maker->random, 5) == 0) {
        make_leaf(maker, rows);
        return;
    }
    maker->depth--;
    switch (random_below(maker->random, 6)) {
    case 0:
    case 1:
        make_call(maker, rows);
        break;
    case 2:
        fputc('(', maker->out);
        make_condition(maker);
        fputs(" ? ", maker->out);
        make_value(maker, rows);
        fputs(" : ", maker->out);
        make_value(maker, rows);
        fputc(')', maker->out);
        break;
    case 3:
        make_part(maker, rows);
        break;
    default:
        make_joined(maker, rows);
    }
    maker->depth++;
}

static void make_statement(struct maker *maker)
{
    static const struct {
        const char *place;
        int rows;
    } places[] = {{"a = ", 1},        {"b = ", 2},       {"c = ", 3},    {"a += 0.5 * ", 1},
                  {"b.yx = ", 2},     {"c.zx -= ", 2},   {"c[n] = ", 1}, {"m[n] = ", 3},
                  {"e[1 + n] = ", 1}, {"m[2].zy = ", 2}, {"p *= ", 1}};
    switch (random_below(maker->random, 6)) {
    case 0:
        fputs("if ", maker->out);
        make_condition(maker);
        fputs(" { ", maker->out);
        break;
    case 1:
        fprintf(maker->out, "for (int i = 0; i < %zu; i++) { if ",
                1 + random_below(maker->random, 4));
        make_condition(maker);
        fprintf(maker->out, " %s;\n", random_below(maker->random, 2) == 0 ? "break" : "continue");
        break;
    case 2:
        fputs("{ n = (n + int(a * 8.0)) % 3; n = abs(n); ", maker->out);
        break;
    case 3:
        fputs("{ change(b.x, c); ", maker->out);
        break;
    default:
        fputs("{ ", maker->out);
    }
    size_t which = random_below(maker->random, sizeof places / sizeof places[0]);
    fputs(places[which].place, maker->out);
    make_value(maker, places[which].rows);
    fputs("; a = clamp(a, -4.0, 4.0); b = clamp(b, -4.0, 4.0); c = clamp(c, -4.0, 4.0);\n"
          "p = clamp(p, -4.0, 4.0); }\n",
          maker->out);
}

static char *make_code(struct random *random)
{
    char *text = NULL;
    size_t length;
    struct maker maker = {random, open_memstream(&text, &length), 3};
    fputs("void change(inout float x, out vec3 y) { y += vec3(x); x = fract(x * 0.5); }\n"
          "float sdf(vec3 p) {\nfloat a = p.y; vec2 b = p.xz; vec3 c = p * 0.5;\n"
          "mat3 m = mat3(p, c, p.yzx); float e[4] = float[4](0.5, p.x, 1.0, p.z); int n = 1;\n",
          maker.out);
    for (size_t i = 2 + random_below(random, 5); i > 0; i--) {
        make_statement(&maker);
    }
    fputs("return a + dot(b, vec2(0.5)) + dot(c, p) * 0.25 + e[n] + m[1][n]; }\n", maker.out);
    fclose(maker.out);
    return text;
}

/* Comparisons of what is nearly equal, and so on, may turn out otherwise in floats. */
static void random_code_agrees(void **state)
{
    enum { BATCHES = 4, ALLOWED = CODE_GPU_POINTS / 50 };
    struct random random = {.state = 4711};
    struct batch batch = {.count = 0};
    (void)state;
    for (int i = 0; i < BATCHES; i++) {
        while (batch.count < JOBS_MAX) {
            char *text = make_code(&random);
            add(&batch, text, CODE_DISTANCE, no_params);
            free(text);
        }
        run(&batch, ALLOWED);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_function_agrees),
        cmocka_unit_test(the_ends_of_domains_agree),
        cmocka_unit_test(accepted_code_agrees),
        cmocka_unit_test(listings_of_the_thesis_agree),
        cmocka_unit_test(parameters_and_shaders_agree),
        cmocka_unit_test(random_code_agrees),
    };
    return cmocka_run_group_tests_name("code in GLSL", tests, setup, teardown);
}
