/* SPDX-License-Identifier: MIT */
/* What combines distances: every kernel is its printed formula, shares are derivatives, nothing
 * gets steeper, and a scaled operation is the same one, scaled. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "renderer/field/field.h"
#include "tests/support/compiled.h"
#include "tests/support/json_text.h"
#include "tests/support/random_scene.h"

enum { OPERANDS_MAX = 8 };

static const struct sdf *row(const char *type)
{
    return sdf_find(node_type_find(type));
}

static const struct param *kernel_param(void)
{
    const struct record_type *record = &node_type_find("smooth_union")->record;

    return &record->params[record_type_find(record, "kernel")];
}

static size_t kernel_count(void)
{
    size_t count = 0;

    while (kernel_param()->choices[count]) {
        count++;
    }
    return count;
}

/* --- the formulas as they are printed, for moderate numbers --- */

static double step_of(double a, double b, double k)
{
    return fmax(k - fabs(a - b), 0) / k;
}

static double quadratic(double a, double b, double k)
{
    return fmin(a, b) - pow(step_of(a, b, k), 2) * k / 4;
}

static double cubic(double a, double b, double k)
{
    return fmin(a, b) - pow(step_of(a, b, k), 3) * k / 6;
}

static double quartic(double a, double b, double k)
{
    return fmin(a, b) - pow(step_of(a, b, k), 4) * k / 8;
}

/* min(a, b) - max(k - |a - b|, 0)^n / (2 n k^(n - 1)), of any order. */
static double polynomial(double a, double b, double k, int n)
{
    return fmin(a, b) - pow(fmax(k - fabs(a - b), 0), n) / (2 * n * pow(k, n - 1));
}

static double circular(double a, double b, double k)
{
    const double y = 1 - step_of(a, b, k);

    return fmin(a, b) - k * (1 - (y + sqrt(2 - y * y)) / 2);
}

static double exponential(double a, double b, double k)
{
    return -log2(exp2(-k * a) + exp2(-k * b)) / k;
}

static double root(double a, double b, double k)
{
    return (a + b - sqrt((a - b) * (a - b) + k)) / 2;
}

static double power_form(double a, double b, double k)
{
    const double x = pow(a, k), y = pow(b, k);

    return fmin(a, b) > 0 ? pow(x * y / (x + y), 1 / k) : fmin(a, b);
}

static const struct closed_form {
    const char *kernel;
    double (*blend)(double a, double b, double k); /* NULL: polynomial, which has an order */
    bool compact;
} closed_forms[] = {
    {"quadratic", quadratic, true},      {"cubic", cubic, true},     {"quartic", quartic, true},
    {"circular", circular, true},        {"root", root, false},      {"power", power_form, false},
    {"exponential", exponential, false}, {"polynomial", NULL, true},
};

static const struct closed_form *closed_form_of(size_t kernel)
{
    const char *name = kernel_param()->choices[kernel];

    for (size_t i = 0; i < sizeof closed_forms / sizeof closed_forms[0]; i++) {
        if (strcmp(closed_forms[i].kernel, name) == 0) {
            return &closed_forms[i];
        }
    }
    fail_msg("this test does not know the kernel %s", name);
    return NULL;
}

/* n = k, kernel, order. */
static double printed(double a, double b, const double n[3])
{
    const struct closed_form *form = closed_form_of((size_t)n[1]);

    return form->blend ? form->blend(a, b, n[0]) : polynomial(a, b, n[0], (int)n[2]);
}

static double smooth_union(double a, double b, const double n[3])
{
    double share;

    return row("smooth_union")->combine(a, b, n, &share);
}

static double random_order(struct random *random)
{
    return 2 + (double)random_below(random, 15);
}

static void kernels_are_their_printed_formulas(void **state)
{
    (void)state;
    struct random random = {31};

    assert_int_equal(kernel_count(), sizeof closed_forms / sizeof closed_forms[0]);
    for (size_t kernel = 0; kernel < kernel_count(); kernel++) {
        for (int i = 0; i < 2000; i++) {
            const double a = random_between(&random, -3, 3), k = random_between(&random, 0.05, 3);
            double b = a + random_between(&random, -1, 1) * (i % 2 ? 4 : 0.5), share;
            double n[3] = {k, (double)kernel, random_order(&random)};
            const double low = printed(a, b, n), high = -printed(-a, -b, n),
                         cut = -printed(-a, b, n);
            assert_true(fabs(smooth_union(a, b, n) - low) < 1e-9);
            assert_true(smooth_union(a, b, n) == smooth_union(b, a, n));
            assert_true(fabs(row("smooth_intersection")->combine(a, b, n, &share) - high) < 1e-9);
            assert_true(fabs(row("smooth_difference")->combine(a, b, n, &share) - cut) < 1e-9);
        }
    }
}

static double kernel_index(const char *name)
{
    size_t kernel = 0;

    while (strcmp(kernel_param()->choices[kernel], name) != 0) {
        kernel++;
    }
    return (double)kernel;
}

static void orders_with_names_are_polynomials(void **state)
{
    (void)state;
    static const char *const names[] = {"quadratic", "cubic", "quartic"};
    struct random random = {38};

    for (int i = 0; i < 3000; i++) {
        const double a = random_between(&random, -1, 1), b = random_between(&random, -1, 1);
        const double named[3] = {0.7, kernel_index(names[i % 3]), 9};
        const double order[3] = {0.7, kernel_index("polynomial"), 2 + i % 3};
        double share, other;
        const double d = row("smooth_union")->combine(a, b, named, &share);
        assert_true(fabs(d - row("smooth_union")->combine(a, b, order, &other)) < 1e-12);
        assert_true(fabs(share - other) < 1e-12);
    }
}

static void compact_kernels_reach_as_far_as_k(void **state)
{
    (void)state;
    struct random random = {32};

    for (size_t kernel = 0; kernel < kernel_count(); kernel++) {
        for (int i = 0; i < 1000 && closed_form_of(kernel)->compact; i++) {
            const double n[3] = {random_between(&random, 0.01, 2), (double)kernel,
                                 random_order(&random)};
            const double a = random_between(&random, -3, 3), k = n[0];
            const double sign = i % 2 ? 1 : -1, beyond = k * random_between(&random, 1, 3);
            /* Nearer to k a high order has less left than doubles have digits. */
            double within =
                k * random_between(&random, 0, closed_form_of(kernel)->blend ? 0.95 : 0.8);
            assert_true(smooth_union(a, a + sign * beyond, n) == fmin(a, a + sign * beyond));
            assert_true(smooth_union(a, a + sign * within, n) < fmin(a, a + sign * within));
        }
    }
}

static void far_operands_do_no_harm(void **state)
{
    (void)state;
    static const double far[] = {1e9, -1e9, 1e20, -1e20, 1e-30, 0, -1e-30};
    static const double ks[] = {1e-7, 1e-3, 1, 1e3, 1e6};

    for (size_t kernel = 0; kernel < kernel_count(); kernel++) {
        for (size_t i = 0; i < 7 * 7 * 5; i++) {
            double a = far[i % 7], b = far[i / 7 % 7], share;
            const double n[3] = {ks[i / 49], (double)kernel, 2 + (double)(i % 15)};
            const double d = row("smooth_union")->combine(a, b, n, &share);
            assert_true(isfinite(d) && d <= fmin(a, b) && share >= 0 && share <= 1);
            /* Where one is far nearer, nothing is left of the other. */
            if (fabs(a - b) > 1e8 && n[0] > 1e-3 && fmax(a, b) > 0) {
                assert_true(fabs(d - fmin(a, b)) <= 1e-3 + 1e-9 * fabs(d));
                assert_true(b < a ? share > 0.999 : share < 1e-3);
            }
        }
    }
}

/* --- every operation --- */

static size_t kernels_of(const struct node_type *type)
{
    return record_type_find(&type->record, "kernel") >= 0 ? kernel_count() : 1;
}

/* Numbers of a row with the kernel, where it has one. */
static void random_numbers_of(struct random *random, const struct node_type *type, size_t kernel,
                              double n[3])
{
    const bool power = kernels_of(type) > 1 && closed_form_of(kernel)->blend == power_form;

    n[0] = type->record.params[0].name ? random_between(random, 0.05, 1) : 0;
    n[0] = power ? 1 + 3 * n[0] : n[0];
    n[1] = (double)kernel;
    n[2] = random_order(random);
}

typedef void check(struct random *random, const struct node_type *type, const double n[3]);

static void for_each_operation(struct random *random, int rounds, check *run)
{
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        for (size_t kernel = 0; type->kind == KIND_COMBINE && kernel < kernels_of(type); kernel++) {
            for (int round = 0; round < rounds; round++) {
                double n[3];
                random_numbers_of(random, type, kernel, n);
                run(random, type, n);
            }
        }
    }
}

static double combine(const struct node_type *type, double a, double b, const double *n)
{
    double share;

    return sdf_find(type)->combine(a, b, n, &share);
}

/* As near as is asked for here: min, max and the power kernel at 0 have edges. */
static bool is_edge(double a, double b)
{
    return fmin(fabs(a - b), fmin(fabs(a + b), fmin(fabs(a), fabs(b)))) < 1e-3;
}

static void check_share(struct random *random, const struct node_type *type, const double n[3])
{
    const double h = 1e-5;
    double a = random_between(random, -1, 1), b = random_between(random, -1, 1), share;

    if (is_edge(a, b)) {
        return;
    }
    sdf_find(type)->combine(a, b, n, &share);
    const double by_a = fabs(combine(type, a + h, b, n) - combine(type, a - h, b, n)) / (2 * h);
    const double by_b = fabs(combine(type, a, b + h, n) - combine(type, a, b - h, n)) / (2 * h);
    if (!(fabs(by_b / (by_a + by_b) - share) < 1e-4)) {
        fail_msg("%s, kernel %g, k %g: share %g at %g %g instead of %g", type->record.name, n[1],
                 n[0], share, a, b, by_b / (by_a + by_b));
    }
}

static void shares_are_derivatives(void **state)
{
    (void)state;
    struct random random = {33};

    for_each_operation(&random, 3000, check_share);
}

/* Where both operands change by at most so much, so does the result: near, far, over every edge. */
static void check_steepness(struct random *random, const struct node_type *type, const double n[3])
{
    const double a = random_between(random, -1, 1), step = pow(10, random_between(random, -4, 0.5));
    const double b = random_below(random, 2) ? a + random_between(random, -0.1, 0.1)
                                             : random_between(random, -1, 1);
    const double there = combine(type, a + random_between(random, -step, step),
                                 b + random_between(random, -step, step), n);

    if (!(fabs(there - combine(type, a, b, n)) <= step * (1 + 1e-9) + 1e-12)) {
        fail_msg("%s, kernel %g, k %g: too steep at %g %g", type->record.name, n[1], n[0], a, b);
    }
}

static void nothing_gets_steeper(void **state)
{
    (void)state;
    struct random random = {34};

    for_each_operation(&random, 20000, check_steepness);
}

static double fold(const struct node_type *type, const double *operands, size_t count,
                   const double *n)
{
    double d = operands[0];

    for (size_t i = 1; i < count; i++) {
        d = combine(type, d, operands[i], n);
    }
    return d;
}

/* How far below its operands a fold comes, and how small a part of them: as far as the row says,
 * which equal operands need. */
static void check_lowered(struct random *random, const struct node_type *type, const double n[3])
{
    const struct sdf *sdf = sdf_find(type);
    double operands[OPERANDS_MAX] = {0}, least = INFINITY;
    const size_t count = 2 + random_below(random, OPERANDS_MAX - 1);
    const bool equal = random_below(random, 2);

    for (size_t i = 0; i < count; i++) {
        operands[i] = i && equal ? operands[0] : random_between(random, -0.2, 1);
        least = fmin(least, operands[i]);
    }
    const double d = fold(type, operands, count, n);
    const double lowered = sdf->lowered ? sdf->lowered(n, count) : 0;
    const double stretched = sdf->stretched ? sdf->stretched(n, count) : 1;
    if (sdf->rule != SDF_ANY || sdf->operands > 0) {
        return; /* the box of one operand is enough */
    }
    assert_true(least <= fmax(d, 0) * stretched * (1 + 1e-9) + lowered + 1e-12);
    if (equal && sdf->lowered && least > 0) {
        assert_true(fabs(d - (least / stretched - lowered)) < 1e-9);
    }
}

static void blends_are_lowered_as_far_as_they_say(void **state)
{
    (void)state;
    struct random random = {35};

    for_each_operation(&random, 2000, check_lowered);
    /* Very many children of one blend. */
    const double n[3] = {0.1, 0, 0};
    assert_true(row("smooth_union")->lowered(n, 10000) <= 0.1);
}

/* --- in scenes --- */

static struct scene *scene_of(const char *root)
{
    char *text;

    if (asprintf(&text, "{'format':'fieldcast/1','root':%s}", root) < 0) {
        abort();
    }
    struct scene *scene = json_text_valid_scene(text);
    free(text);
    return scene;
}

static struct field *field_of(const char *root)
{
    struct scene *scene = scene_of(root);
    struct field *field = compile_field(scene);

    scene_destroy(scene);
    return field;
}

/* Three balls and their distances. */
#define BALLS                                                                                      \
    "'children':[{'type':'sphere','params':{'radius':0.7}},"                                       \
    "{'type':'sphere','params':{'radius':0.5},'transform':{'translation':[0.6,0,0]}},"             \
    "{'type':'sphere','params':{'radius':0.6},'transform':{'translation':[0,0.5,0]}}]"

static void balls(const double p[3], double out[3])
{
    out[0] = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 0.7;
    out[1] = sqrt((p[0] - 0.6) * (p[0] - 0.6) + p[1] * p[1] + p[2] * p[2]) - 0.5;
    out[2] = sqrt(p[0] * p[0] + (p[1] - 0.5) * (p[1] - 0.5) + p[2] * p[2]) - 0.6;
}

static char *operation_text(const struct node_type *type, const double n[3], const char *more)
{
    const struct param *params = type->record.params;
    char *text, numbers[96] = "";

    if (params[0].name) {
        snprintf(numbers, sizeof numbers, "'%s':%.9g", params[0].name, n[0]);
    }
    if (kernels_of(type) > 1) {
        snprintf(numbers + strlen(numbers), sizeof numbers - strlen(numbers),
                 ",'kernel':'%s','order':%g", kernel_param()->choices[(size_t)n[1]], n[2]);
    }
    if (asprintf(&text, "{'type':'%s','params':{%s}%s," BALLS "}", type->record.name, numbers,
                 more) < 0) {
        abort();
    }
    return text;
}

static void check_in_scenes(struct random *random, const struct node_type *type, const double n[3])
{
    char more[96];
    const double scale = pow(2, random_between(random, -4, 4));

    snprintf(more, sizeof more, ",'transform':{'scale':%.17g}", scale);
    char *plain = operation_text(type, n, ""), *scaled = operation_text(type, n, more);
    struct field *a = field_of(plain), *b = field_of(scaled);
    const size_t operands = sdf_find(type)->operands;
    for (int k = 0; k < 20; k++) {
        double p[3], q[3], distances[3];
        for (int j = 0; j < 3; j++) {
            p[j] = random_between(random, -1.5, 1.5);
            q[j] = p[j] * scale;
        }
        balls(p, distances);
        const double want = fold(type, distances, operands ? operands : 3, n);
        const double got = field_distance(a, p), there = field_distance(b, q) / scale;
        if (!(fabs(got - want) < 1e-5 && fabs(there - want) < 1e-5)) {
            fail_msg("%s: %g, scaled by %g %g instead of %g", plain, got, scale, there, want);
        }
    }
    field_unref(a);
    field_unref(b);
    free(plain);
    free(scaled);
}

static void operations_fold_their_children_and_scale(void **state)
{
    (void)state;
    struct random random = {36};

    for_each_operation(&random, 20, check_in_scenes);
}

static double distance_at(const char *root, double x, double y, double z)
{
    const double p[3] = {x, y, z};
    struct field *field = field_of(root);
    const double d = field_distance(field, p);

    field_unref(field);
    return d;
}

static void exclusive_is_an_odd_number_of_children(void **state)
{
    (void)state;
    struct random random = {37};
    struct field *field = field_of("{'type':'exclusive'," BALLS "}");
    int seen[4] = {0};

    for (int i = 0; i < 10000; i++) {
        double p[3], d[3];
        for (int j = 0; j < 3; j++) {
            p[j] = random_between(&random, -1, 1);
        }
        balls(p, d);
        const int in = (d[0] < 0) + (d[1] < 0) + (d[2] < 0);
        const double nearest = fmin(fabs(d[0]), fmin(fabs(d[1]), fabs(d[2])));
        seen[in]++;
        assert_true((field_distance(field, p) < 0) == (in % 2 == 1));
        assert_true(fabs(fabs(field_distance(field, p)) - nearest) < 1e-6); /* its own surface */
    }
    assert_true(seen[0] > 20 && seen[1] > 20 && seen[2] > 20 && seen[3] > 20);
    field_unref(field);
}

static void a_power_is_at_least_one(void **state)
{
    (void)state;
    double small[3] = {0.1, kernel_index("power"), 0}, one[3] = {1, small[1], 0};

    row("smooth_union")->scale(small, 7);
    row("smooth_union")->scale(one, 0.1);
    assert_true(small[0] == 1 && one[0] == 1);
}

#define BALL(radius) "{'type':'sphere','params':{'radius':" #radius "}}"
#define NOTHING "{'type':'group'}"

static void morph_goes_from_the_first_to_the_second(void **state)
{
    (void)state;
#define MORPH(t, children)                                                                         \
    distance_at("{'type':'morph','params':{'t':" #t "},'children':[" children "]}", 3, 0, 0)
#define THREE BALL(1) "," BALL(2) "," BALL(9)
    assert_true(fabs(MORPH(0, THREE) - 2) < 1e-6);
    assert_true(fabs(MORPH(0.25, THREE) - 1.75) < 1e-6);
    assert_true(fabs(MORPH(1, THREE) - 1) < 1e-6);
    /* Where one is empty there is the other alone; the third never counts. */
    assert_true(fabs(MORPH(0.25, NOTHING "," BALL(2) "," BALL(9)) - 1) < 1e-6);
    assert_true(fabs(MORPH(0.25, BALL(1) "," NOTHING "," BALL(9)) - 2) < 1e-6);
    assert_true(fabs(MORPH(0.25, BALL(1)) - 2) < 1e-6);
    assert_true(MORPH(0.25, NOTHING "," NOTHING "," BALL(9)) == 1e9);
#undef THREE
#undef MORPH
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_are_their_printed_formulas),
        cmocka_unit_test(orders_with_names_are_polynomials),
        cmocka_unit_test(compact_kernels_reach_as_far_as_k),
        cmocka_unit_test(far_operands_do_no_harm),
        cmocka_unit_test(shares_are_derivatives),
        cmocka_unit_test(nothing_gets_steeper),
        cmocka_unit_test(blends_are_lowered_as_far_as_they_say),
        cmocka_unit_test(operations_fold_their_children_and_scale),
        cmocka_unit_test(a_power_is_at_least_one),
        cmocka_unit_test(exclusive_is_an_odd_number_of_children),
        cmocka_unit_test(morph_goes_from_the_first_to_the_second),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
