/* SPDX-License-Identifier: MIT */
/* What changes a distance or the space: inside is what the catalogue says, fields are bounds and no
 * steeper than the distance, factors are no greater than they must be, and a scaled modifier is the
 * same one, scaled. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "renderer/field/field.h"
#include "renderer/sdf/noise.h"
#include "tests/support/compiled.h"
#include "tests/support/random_scene.h"

#define PI 3.141592653589793

static void random_point(struct random *random, double size, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = random_between(random, -size, size);
    }
}

/* --- scenes --- */

static struct scene *scene_of(const char *root)
{
    struct error err = {0};
    char *text;
    if (asprintf(&text,
                 "{\"format\":\"fieldcast/1\",\"materials\":{\"m0\":{\"shader\":\"phong\"},\"m1\":{"
                 "\"shader\":\"phong\"},\"m2\":{\"shader\":\"phong\"}},\"root\":%s}",
                 root) < 0) {
        abort();
    }
    struct scene *scene = scene_parse(text, strlen(text), &err);
    if (!scene) {
        fail_msg("%s: %s\n%s", err.place, err.message, text);
    }
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

static double distance_at(const char *root, double x, double y, double z)
{
    const double p[3] = {x, y, z};
    struct field *field = field_of(root);
    double d = field_distance(field, p);
    field_unref(field);
    return d;
}

/* A modifier and its child, also alone. */
struct sample {
    const struct node_type *type;
    char *text; /* of the modifier */
    struct field *whole, *child;
    double n[SDF_NUMBERS_MAX]; /* parameters as written */
};

/* Ends where something is in space; `blend`: of two shapes, so distances are bounds. */
static char *random_child_text(struct random *random, const struct random_limits *limits, bool flat,
                               bool blend)
{
    char *text;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    enum node_kind kind = flat ? KIND_FLAT : KIND_SHAPE;
    if (!out) {
        abort();
    }
    fprintf(out, blend ? "{\"type\":\"smooth_union\",\"params\":{\"k\":0.3},\"children\":[" : "");
    random_node(random, out, random_type(random, kind, limits), limits);
    if (blend) {
        fprintf(out, ",");
        random_node(random, out, random_type(random, kind, limits), limits);
        fprintf(out, "]}");
    }
    fclose(out);
    return text;
}

static bool is_section(const struct node_type *type)
{
    return strcmp(type->record.name, "extrude") == 0 || strcmp(type->record.name, "revolve") == 0;
}

/* The modifier itself has no transform. */
static struct sample random_sample(struct random *random, const struct node_type *type, bool exact)
{
    const struct random_limits limits = {.bounded = true, .exact = exact, .inner = true};
    const struct random_limits plain = {.bounded = true, .plain = true};
    struct sample sample = {.type = type};
    bool flat = is_section(type) && random_below(random, 4);
    char *child = random_child_text(random, &limits, flat, !exact), *params;
    struct scene *scene = random_scene(random, type, &plain);
    cJSON *object = cJSON_CreateObject();
    record_print(&scene->root->params, object);
    params = json_print(object, false);
    sdf_numbers(type->record.params, scene->root->params.values, sample.n);
    if (asprintf(&sample.text, "{\"type\":\"%s\",\"params\":%s,\"children\":[%s]}",
                 type->record.name, params, child) < 0) {
        abort();
    }
    sample.whole = field_of(sample.text);
    sample.child = field_of(child);
    scene_destroy(scene);
    cJSON_Delete(object);
    free(params);
    free(child);
    return sample;
}

static void sample_finish(struct sample *sample)
{
    field_unref(sample->whole);
    field_unref(sample->child);
    free(sample->text);
}

static bool is_modifier(const struct node_type *type)
{
    return type->kind == KIND_DISTANCE || type->kind == KIND_DOMAIN;
}

/* --- what is inside, by the words of the catalogue --- */

static double at(const struct field *child, double x, double y, double z)
{
    const double p[3] = {x, y, z};
    return field_distance(child, p);
}

static double round_at(const struct field *child, const double p[3], const double *n)
{
    return field_distance(child, p) - n[0];
}

static double shell_at(const struct field *child, const double p[3], const double *n)
{
    return fabs(field_distance(child, p)) - n[0];
}

static double mirror_at(const struct field *child, const double p[3], const double *n)
{
    return at(child, n[0] != 0 ? fabs(p[0]) : p[0], n[1] != 0 ? fabs(p[1]) : p[1],
              n[2] != 0 ? fabs(p[2]) : p[2]);
}

static double middle_out(double x, double half)
{
    return x > half ? x - half : x < -half ? x + half : 0;
}

static double elongate_at(const struct field *child, const double p[3], const double *n)
{
    return at(child, middle_out(p[0], n[0]), middle_out(p[1], n[1]), middle_out(p[2], n[2]));
}

/* Rotations about an axis are right-handed: +Z to +X about +Y, +X to +Y about +Z. */
static double twist_at(const struct field *child, const double p[3], const double *n)
{
    double c = cos(-n[0] * p[1]), s = sin(-n[0] * p[1]);
    return at(child, c * p[0] + s * p[2], p[1], -s * p[0] + c * p[2]);
}

static double bend_at(const struct field *child, const double p[3], const double *n)
{
    double c = cos(-n[0] * p[0]), s = sin(-n[0] * p[0]);
    return at(child, c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]);
}

static double offset_at(const struct field *child, const double p[3], const double *n)
{
    return at(child, p[0] + n[0] * sin(n[3] * p[1]), p[1] + n[1] * sin(n[4] * p[2]),
              p[2] + n[2] * sin(n[5] * p[0]));
}

static double displace_at(const struct field *child, const double p[3], const double *n)
{
    double waves = sin(n[1] * p[0]) * sin(n[2] * p[1]) * sin(n[3] * p[2]);
    return field_distance(child, p) + n[0] * waves;
}

static double noise_at(const struct field *child, const double p[3], const double *n)
{
    const double q[3] = {n[1] * p[0], n[1] * p[1], n[1] * p[2]};
    double noise = noise_octaves(q, (int)n[2], (uint32_t)n[3]), sum = 0;
    for (int i = 0; i < (int)n[2]; i++) {
        sum += pow(2, -i);
    }
    return field_distance(child, p) + n[0] * noise / sum;
}

static double extrude_at(const struct field *child, const double p[3], const double *n)
{
    double r = fmin(n[1], n[0] / 2), side = at(child, p[0], p[1], 0) + r;
    double cap = fabs(p[2]) - n[0] / 2 + r;
    return side > 0 && cap > 0 ? sqrt(side * side + cap * cap) - r : fmax(side, cap) - r;
}

static double revolve_at(const struct field *child, const double p[3], const double *n)
{
    return at(child, sqrt(p[0] * p[0] + p[2] * p[2]) - n[0], p[1], 0);
}

static double polar_at(const struct field *child, const double p[3], const double *n)
{
    double least = INFINITY;
    for (int i = 0; i < (int)n[0]; i++) {
        double c = cos(2 * PI * i / n[0]), s = sin(2 * PI * i / n[0]);
        least = fmin(least, at(child, c * p[0] + s * p[2] - n[1], p[1], c * p[2] - s * p[0]));
    }
    return least;
}

static double repeat_at(const struct field *child, const double p[3], const double *n)
{
    int count[3];
    double least = INFINITY;
    for (int i = 0; i < 3; i++) {
        count[i] = n[3 + i] > 0 ? (int)n[3 + i] : 1;
    }
    for (int i = 0; i < count[0] * count[1] * count[2]; i++) {
        const int k[3] = {i % count[0], i / count[0] % count[1], i / count[0] / count[1]};
        double q[3];
        for (int j = 0; j < 3; j++) {
            q[j] = p[j] - n[j] * (k[j] - (count[j] - 1) / 2.0);
        }
        least = fmin(least, field_distance(child, q));
    }
    return least;
}

/* Below 0 inside. */
typedef double meaning(const struct field *child, const double p[3], const double *n);

static const struct {
    const char *type;
    meaning *at;
} meanings[] = {
    {"round", round_at},         {"shell", shell_at},       {"mirror", mirror_at},
    {"elongate", elongate_at},   {"twist", twist_at},       {"bend", bend_at},
    {"offset_space", offset_at}, {"displace", displace_at}, {"displace_noise", noise_at},
    {"extrude", extrude_at},     {"revolve", revolve_at},   {"repeat", repeat_at},
    {"repeat_polar", polar_at},
};

static meaning *meaning_of(const struct node_type *type)
{
    for (size_t i = 0; i < sizeof meanings / sizeof meanings[0]; i++) {
        if (strcmp(meanings[i].type, type->record.name) == 0) {
            return meanings[i].at;
        }
    }
    fail_msg("this test does not know what is inside a %s", type->record.name);
    return NULL;
}

/* Very many copies, or copies without end, have tests of their own. */
static bool is_told_by_words(const struct sample *sample)
{
    bool repeat = strcmp(sample->type->record.name, "repeat") == 0;
    return !repeat || (sample->n[3] >= 0 && sample->n[4] >= 0 && sample->n[5] >= 0 &&
                       sample->whole->loop_trips < SDF_REPEAT_CELLS_MAX - 25);
}

/* The sign is that of the words, and the ball with the distance as its radius holds no point of
 * the other side. */
static void check_bound(struct random *random, const struct sample *sample)
{
    meaning *inside = meaning_of(sample->type);
    for (int k = 0; k < 20; k++) {
        double p[3], direction[3], q[3];
        random_point(random, 2, p);
        double d = field_distance(sample->whole, p);
        bool in = inside(sample->child, p, sample->n) < 0;
        if (fabs(d) > 1e-5 && in != (d < 0)) {
            fail_msg("%g has the wrong sign at %g %g %g\n%s", d, p[0], p[1], p[2], sample->text);
        }
        for (int j = 0; j < 20 && fabs(d) > 1e-5; j++) {
            random_direction(random, direction);
            for (int i = 0; i < 3; i++) {
                q[i] = p[i] + direction[i] * (fabs(d) - 1e-5) * (j % 2 ? 1 : 0.8);
            }
            if ((inside(sample->child, q, sample->n) < 0) != in) {
                fail_msg("%g oversteps at %g %g %g\n%s", d, p[0], p[1], p[2], sample->text);
            }
        }
    }
}

/* No point is farther from the box than the stretch allows for its distance. */
static void check_box(struct random *random, const struct sample *sample, double size)
{
    const struct bounds *box = &sample->whole->bounds;
    for (int k = 0; k < 300; k++) {
        double p[3], square = 0;
        random_point(random, size, p);
        double d = field_distance(sample->whole, p);
        for (int i = 0; i < 3; i++) {
            double out = fmax(fmax(box->low[i] - p[i], p[i] - box->high[i]), 0);
            square += out * out;
        }
        if (!(sqrt(square) <= fmax(d, 0) * box->stretch + 1e-5)) {
            fail_msg("%g at %g %g %g is outside\n%s", d, p[0], p[1], p[2], sample->text);
        }
    }
}

static void fields_and_boxes_are_bounds_of_what_the_words_say(void **state)
{
    (void)state;
    struct random random = {41};
    size_t rows = 0;
    for (size_t i = 0; i < node_type_count(); i++) {
        int checked = 0;
        if (!is_modifier(node_type_at(i))) {
            continue;
        }
        rows++;
        for (int round = 0; round < 150; round++) {
            struct sample sample = random_sample(&random, node_type_at(i), round % 2);
            check_box(&random, &sample, round % 3 ? 2.5 : 6);
            if (is_told_by_words(&sample)) {
                check_bound(&random, &sample);
                checked++;
            }
            sample_finish(&sample);
        }
        assert_true(checked > 30);
    }
    assert_int_equal(rows, sizeof meanings / sizeof meanings[0]);
}

/* --- steepness --- */

/* Anywhere, and where one cell, side or piece becomes another. */
static void random_seam(struct random *random, const struct sample *sample, double out[3])
{
    random_point(random, 2.5, out);
    int axis = (int)random_below(random, 3);
    switch (random_below(random, 4)) {
    case 0:
        out[axis] = 0;
        break;
    case 1: /* faces of what is elongated or extruded; cell walls */
        out[axis] = sample->n[axis] * (random_below(random, 2) ? 0.5 : -1);
        break;
    case 2: { /* between copies around the axis */
        double angle =
            PI / fmax(round(sample->n[0]), 1) * (double)(1 + 2 * random_below(random, 9));
        double r = hypot(out[0], out[2]);
        out[0] = r * cos(angle);
        out[2] = r * sin(angle);
        break;
    }
    default:
        break;
    }
}

static double check_steepness(struct random *random, const struct sample *sample)
{
    double p[3], q[3], direction[3], worst = 0;
    random_seam(random, sample, p);
    double d = field_distance(sample->whole, p);
    for (int k = 0; k < 4; k++) {
        double step = pow(10, random_between(random, -3, 0.4)); /* numbers are those of floats */
        random_direction(random, direction);
        if (k == 0) {
            field_normal(sample->whole, p, 1e-5, direction);
        }
        for (int i = 0; i < 3; i++) {
            q[i] = p[i] + step * direction[i];
        }
        worst = fmax(worst, fabs(field_distance(sample->whole, q) - d) / step);
    }
    if (!(worst <= 1 + 1e-3)) {
        fail_msg("%g at %.17g %.17g %.17g\n%s", worst, p[0], p[1], p[2], sample->text);
    }
    return worst;
}

/* Children are blends; copies of those may jump (never above the distance), so theirs are exact. */
static void no_modifier_makes_a_field_steeper(void **state)
{
    (void)state;
    struct random random = {42};
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        bool copies = strncmp(type->record.name, "repeat", 6) == 0;
        for (int round = 0; round < 60 && is_modifier(type); round++) {
            struct sample sample = random_sample(&random, type, copies);
            for (int k = 0; k < 60; k++) {
                check_steepness(&random, &sample);
            }
            sample_finish(&sample);
        }
    }
}

/* Somewhere near the point the field is nearly as steep as the distance. */
static void assert_tight(const char *root, double x, double y, double z)
{
    struct random random = {43};
    struct field *field = field_of(root);
    double worst = 0;
    for (int k = 0; k < 40000; k++) {
        double normal[3], p[3] = {x, y, z}, q[3];
        for (int i = 0; i < 3; i++) {
            p[i] += random_between(&random, -0.2, 0.2);
        }
        field_normal(field, p, 1e-5, normal);
        for (int i = 0; i < 3; i++) {
            q[i] = p[i] + 1e-4 * normal[i];
        }
        worst = fmax(worst, fabs(field_distance(field, q) - field_distance(field, p)) / 1e-4);
    }
    field_unref(field);
    if (worst < 0.95) {
        fail_msg("only %g\n%s", worst, root);
    }
}

#define DOT(x, y, z)                                                                               \
    "\"children\":[{\"type\":\"sphere\",\"params\":{\"radius\":0.01},\"transform\":{"              \
    "\"translation\":[" #x "," #y "," #z "]}}]}"
#define FLOOR "\"children\":[{\"type\":\"plane\"}]}"

static void factors_are_no_greater_than_they_must_be(void **state)
{
    (void)state;
    assert_tight("{\"type\":\"twist\",\"params\":{\"rate\":1.5}," DOT(1, 0, 0), 0.75, 0, 0);
    assert_tight("{\"type\":\"bend\",\"params\":{\"rate\":1.5}," DOT(0, 1, 0), 0, 0.75, 0);
    assert_tight("{\"type\":\"offset_space\",\"params\":{\"amplitude\":0.2,\"frequency\":8},"
                 "\"children\":[{\"type\":\"plane\",\"params\":{\"normal\":[1,1,1]}}]}",
                 0, 0, 0);
    assert_tight("{\"type\":\"offset_space\",\"params\":{\"amplitude\":[0,0.2,0],"
                 "\"frequency\":8},\"children\":[{\"type\":\"plane\",\"params\":{"
                 "\"normal\":[0,1,0.48]}}]}",
                 0, 0, 0);
    assert_tight(
        "{\"type\":\"displace\",\"params\":{\"amplitude\":0.1,\"frequency\":[5,9,5]}," FLOOR,
        PI / 10, 0, PI / 10);
    /* From some way on a displaced field is the plain one less the amplitude. */
    const char *noisy = "{\"type\":\"displace_noise\",\"params\":{\"amplitude\":0.25}," FLOOR;
    const char *wavy = "{\"type\":\"displace\",\"params\":{\"amplitude\":0.25}," FLOOR;
    assert_true(fabs(distance_at(noisy, 1, 9, 1) - 8.75) < 1e-6);
    assert_true(fabs(distance_at(wavy, 1, 9, 1) - 8.75) < 1e-6);
    assert_true(distance_at(noisy, 1, 0.3, 1) > 0.05 - 1e-6);
}

/* --- scale --- */

static void modifiers_scale(void **state)
{
    (void)state;
    struct random random = {44};
    for (size_t i = 0; i < node_type_count(); i++) {
        for (int round = 0; round < 60 && is_modifier(node_type_at(i)); round++) {
            struct sample sample = random_sample(&random, node_type_at(i), true);
            double scale = pow(2, random_between(&random, -4, 4));
            char *text;
            if (asprintf(&text,
                         "{\"type\":\"group\",\"transform\":{\"scale\":%.17g},\"children\":[%s]}",
                         scale, sample.text) < 0) {
                abort();
            }
            struct field *scaled = field_of(text);
            for (int k = 0; k < 30; k++) {
                double p[3], q[3];
                random_point(&random, k % 2 ? 0.4 : 3, p);
                for (int j = 0; j < 3; j++) {
                    q[j] = p[j] * scale;
                }
                double want = field_distance(sample.whole, p);
                double got = field_distance(scaled, q) / scale;
                if (!(fabs(got - want) < 1e-5)) {
                    fail_msg("scaled by %g: %g instead of %g\n%s", scale, got, want, sample.text);
                }
            }
            field_unref(scaled);
            free(text);
            sample_finish(&sample);
        }
    }
}

/* --- copies around an axis --- */

static void polar_repetition_is_copies(void **state)
{
    (void)state;
    struct random random = {45};
    const struct node_type *type = node_type_find("repeat_polar");
    uint32_t few = 0;
    for (int round = 0; round < 300; round++) {
        struct sample sample = random_sample(&random, type, true);
        few += sample.whole->loop_trips < sample.n[0];
        for (int k = 0; k < 60; k++) {
            double p[3];
            random_point(&random, 3, p);
            double want = polar_at(sample.child, p, sample.n);
            double got = field_distance(sample.whole, p);
            if (!(fabs(got - want) < 1e-5)) {
                fail_msg("%g instead of %g at %g %g %g\n%s", got, want, p[0], p[1], p[2],
                         sample.text);
            }
        }
        sample_finish(&sample);
    }
    assert_true(few > 50); /* not all copies were looked at */
}

static struct sample polar_sample(int count, const char *child)
{
    struct sample sample = {.type = node_type_find("repeat_polar"), .n = {count, 0}};
    if (asprintf(&sample.text,
                 "{\"type\":\"repeat_polar\",\"params\":{\"count\":%d,\"radius\":0},"
                 "\"children\":[%s]}",
                 count, child) < 0) {
        abort();
    }
    sample.whole = field_of(sample.text);
    sample.child = field_of(child);
    return sample;
}

#define BOX(x, y, z, more) "{\"type\":\"box\",\"params\":{\"size\":[" #x "," #y "," #z "]}" more "}"
#define AT(x, y, z) ",\"transform\":{\"translation\":[" #x "," #y "," #z "]}"

/* More copies than are looked at, around the axis and beside it: a bound, not much too small. */
static void very_many_copies_are_a_bound(void **state)
{
    (void)state;
    struct random random = {46};
    for (int beside = 0; beside < 2; beside++) {
        struct sample sample = polar_sample(1000, beside ? BOX(0.5, 1, 4, AT(0.75, 0, 0))
                                                         : BOX(3, 0.2, 0.01, AT(0.5, 0, 0)));
        assert_in_range(sample.whole->loop_trips, SDF_REPEAT_CELLS_MAX - 1, SDF_REPEAT_CELLS_MAX);
        for (int k = 0; k < 300; k++) {
            double p[3];
            random_point(&random, k % 2 ? 3 : 0.5, p);
            p[1] *= k % 4 < 2 ? 0.03 : 1; /* between the copies */
            double want = polar_at(sample.child, p, sample.n);
            double got = field_distance(sample.whole, p);
            assert_true(want < 0 ? got < 0 : got <= want + 1e-6);
            assert_true(got > want - 0.06 * hypot(p[0], p[2]) - 0.03 * fabs(want));
            check_steepness(&random, &sample);
        }
        for (int k = 0; k < 30; k++) {
            check_box(&random, &sample, 3);
        }
        sample_finish(&sample);
    }
}

/* Seen from the axis the middle of a box's angle is not the direction of its middle. */
static void copies_beside_the_axis(void **state)
{
    (void)state;
    struct random random = {50};
    struct sample sample = polar_sample(5, BOX(0.4, 0.3, 2, AT(0.3, 0, 1.02)));
    assert_int_equal(sample.whole->loop_trips, 3);
    for (int k = 0; k < 3000; k++) {
        double p[3];
        random_point(&random, k % 2 ? 3 : 0.5, p);
        double want = polar_at(sample.child, p, sample.n), got = field_distance(sample.whole, p);
        assert_true(fabs(got - want) < 1e-5);
    }
    sample_finish(&sample);
}

static void loops_are_counted(void **state)
{
    (void)state;
    static const struct {
        const char *root;
        uint32_t trips;
    } cases[] = {
        {"{\"type\":\"repeat_polar\",\"params\":{\"count\":12,\"radius\":2}," DOT(0, 0, 0), 2},
        {"{\"type\":\"repeat_polar\",\"params\":{\"count\":12,\"radius\":0}," DOT(0, 0, 0), 12},
        {"{\"type\":\"displace_noise\",\"params\":{\"octaves\":3}," DOT(0, 0, 0), 3},
        {"{\"type\":\"repeat_polar\",\"params\":{\"count\":5,\"radius\":0},\"children\":[{\"type\":"
         "\"displace_noise\",\"params\":{\"octaves\":7}," DOT(0, 0, 0) "]}",
         5 * (1 + 7)},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct field *field = field_of(cases[i].root);
        assert_int_equal(field->loop_trips, cases[i].trips);
        field_unref(field);
    }
}

/* --- sections --- */

static void assert_same(const char *a, const char *b)
{
    struct random random = {47};
    struct field *fields[2] = {field_of(a), field_of(b)};
    for (int k = 0; k < 1000; k++) {
        double p[3];
        random_point(&random, 2, p);
        double d = field_distance(fields[0], p), want = field_distance(fields[1], p);
        if (!(fabs(d - want) < 1e-6)) {
            fail_msg("%g instead of %g\n%s", d, want, a);
        }
    }
    field_unref(fields[0]);
    field_unref(fields[1]);
}

static void sections_make_known_shapes(void **state)
{
    (void)state;
    assert_same("{\"type\":\"revolve\",\"params\":{\"offset\":0.7},\"children\":[{\"type\":"
                "\"circle\",\"params\":{\"radius\":0.2}}]}",
                "{\"type\":\"torus\",\"params\":{\"radius\":0.7,\"tube\":0.2}}");
    assert_same("{\"type\":\"revolve\",\"children\":[{\"type\":\"rectangle\",\"params\":{\"size\":"
                "[1.4,0.6]}}]}",
                "{\"type\":\"cylinder\",\"params\":{\"radius\":0.7,\"height\":0.6}}");
    assert_same("{\"type\":\"extrude\",\"params\":{\"height\":0.8},\"children\":[{\"type\":"
                "\"rectangle\",\"params\":{\"size\":[1.4,0.6]}}]}",
                "{\"type\":\"box\",\"params\":{\"size\":[1.4,0.6,0.8]}}");
    assert_same("{\"type\":\"extrude\",\"params\":{\"height\":0.8},\"children\":[{\"type\":"
                "\"circle\",\"params\":{\"radius\":0.6}}]}",
                "{\"type\":\"cylinder\",\"params\":{\"radius\":0.6,\"height\":0.8},\"transform\":{"
                "\"rotation\":[1.5707963267948966,0,0]}}");
    assert_same("{\"type\":\"extrude\",\"params\":{\"height\":0.8,\"rounding\":0.2},\"children\":[{"
                "\"type\":\"circle\",\"params\":{\"radius\":0.6}}]}",
                "{\"type\":\"round_cylinder\",\"params\":{\"radius\":0.6,\"height\":0.8,"
                "\"rounding\":0.2},\"transform\":{\"rotation\":[1.5707963267948966,0,0]}}");
    assert_same("{\"type\":\"elongate\",\"params\":{\"size\":[0.3,0.4,0.5]},\"children\":[{"
                "\"type\":\"box\",\"params\":{\"size\":[0.2,0.2,0.2]}}]}",
                "{\"type\":\"box\",\"params\":{\"size\":[0.8,1,1.2]}}");
    assert_same("{\"type\":\"elongate\",\"params\":{\"size\":[0,0.4,0]},\"children\":[{"
                "\"type\":\"sphere\",\"params\":{\"radius\":0.5}}]}",
                "{\"type\":\"capsule\",\"params\":{\"a\":[0,-0.4,0],\"b\":[0,0.4,0],"
                "\"radius\":0.5}}");
}

/* --- noise --- */

static void noise_keeps_its_bounds(void **state)
{
    (void)state;
    struct random random = {48};
    double steepest = 0, greatest = 0, sum = 0;
    for (int k = 0; k < 200000; k++) {
        double p[3], q[3], direction[3];
        random_point(&random, 30, p);
        random_direction(&random, direction);
        for (int i = 0; i < 3; i++) {
            q[i] = p[i] + 1e-4 * direction[i];
        }
        double value = noise_value(p, 7);
        steepest = fmax(steepest, fabs(noise_value(q, 7) - value) / 1e-4);
        greatest = fmax(greatest, fabs(value));
        sum += value;
        double all = noise_octaves(p, 5, 7), slope = fabs(noise_octaves(q, 5, 7) - all) / 1e-4;
        assert_true(fabs(all) <= noise_greatest(5) && slope <= noise_slope(5));
    }
    assert_true(steepest <= noise_slope(1) && steepest > 0.7 * noise_slope(1));
    assert_true(greatest <= noise_greatest(1) && greatest > 0.9);
    assert_true(fabs(sum / 200000) < 0.02);
    assert_true(noise_greatest(1) == 1 && noise_greatest(3) == 1.75);
}

static void noise_is_what_its_whole_points_say(void **state)
{
    (void)state;
    struct random random = {49};
    int same = 0;
    for (int k = 0; k < 1000; k++) {
        uint32_t at[3], seed = (uint32_t)random_below(&random, 1000000);
        double p[3], far[3];
        for (int i = 0; i < 3; i++) {
            at[i] = (uint32_t)random_below(&random, 65536);
            p[i] = at[i];
            far[i] = p[i] + random_between(&random, 0, 1) - 3 * 65536.0;
        }
        double number = noise_lattice(at[0], at[1], at[2], seed);
        assert_true(noise_value(p, seed) == number && number == (float)number);
        same += number == noise_lattice(at[0], at[1], at[2], seed + 1);
        const double near[3] = {far[0] + 65536, far[1] + 2 * 65536.0, far[2]};
        assert_true(fabs(noise_value(far, seed) - noise_value(near, seed)) < 1e-6); /* repeats */
    }
    assert_true(same < 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_and_boxes_are_bounds_of_what_the_words_say),
        cmocka_unit_test(no_modifier_makes_a_field_steeper),
        cmocka_unit_test(factors_are_no_greater_than_they_must_be),
        cmocka_unit_test(modifiers_scale),
        cmocka_unit_test(polar_repetition_is_copies),
        cmocka_unit_test(copies_beside_the_axis),
        cmocka_unit_test(very_many_copies_are_a_bound),
        cmocka_unit_test(loops_are_counted),
        cmocka_unit_test(sections_make_known_shapes),
        cmocka_unit_test(noise_keeps_its_bounds),
        cmocka_unit_test(noise_is_what_its_whole_points_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
