/* SPDX-License-Identifier: MIT */
/* Shapes: what is inside is what the words say, and the distance is that of the nearest point of
 * the other side. Inside and outside are told by an oracle; points of the surface are found by
 * halving the way between two sides, and the nearest by looking around. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/sdf/sdf.h"
#include "tests/support/inside_oracle.h"
#include "tests/support/random_scene.h"

#define TOLERANCE 1e-3
#define REACH 2.0 /* of shapes without an end; most others lie in a cube of this half side */

enum { SETS = 25, POINTS = 20, CLOUD_MAX = 1500, PAIRS = 700, NEAREST = 4, LOOKS = 150 };

struct shape {
    const struct node_type *type;
    const struct sdf *sdf;
    bool (*inside)(const double p[3], const double *n);
    double raw[SDF_NUMBERS_MAX], ready[SDF_NUMBERS_MAX]; /* as written, and for the function */
    struct bounds box;
};

/* --- parameters --- */

/* Gives one length of the node the value of another, or a much greater one, or none. */
static void make_odd(struct random *random, const struct node_type *type, double *n)
{
    double *lengths[SDF_PARAMS_MAX];
    bool may_be_zero[SDF_PARAMS_MAX];
    size_t count = 0;

    for (const struct param *param = type->record.params; param->name; param++) {
        const int components = param_components(param->type);
        for (int i = 0; i < components && param->unit == UNIT_LENGTH; i++) {
            may_be_zero[count] = !param->above_min;
            lengths[count++] = n + i;
        }
        n += components;
    }
    if (count == 0) {
        return;
    }
    const size_t which = random_below(random, count);
    const double other = fabs(*lengths[random_below(random, count)]);
    switch (random_below(random, 3)) {
    case 0:
        *lengths[which] = other > 0 ? other : *lengths[which];
        break;
    case 1:
        *lengths[which] *= 4;
        break;
    default:
        *lengths[which] = may_be_zero[which] ? 0 : *lengths[which] / 4;
    }
}

/* Of a quadrilateral that is bent the distances inside are bounds, says its row. */
static bool is_bent(const struct node_type *type, const double *n)
{
    double off = 0;

    for (int i = 0; i < 3; i++) {
        off += fabs(n[i] + n[6 + i] - n[3 + i] - n[9 + i]);
    }
    return strcmp(type->record.name, "quad") == 0 && off > 1e-9;
}

static void unbend(double *n)
{
    for (int i = 0; i < 3; i++) {
        n[9 + i] = n[i] + n[6 + i] - n[3 + i];
    }
}

static struct shape random_shape(struct random *random, const struct node_type *type)
{
    const struct random_limits limits = {.plain = true};
    const struct inside_oracle *oracle = inside_oracle_find(type->record.name);
    struct shape shape = {.type = type, .sdf = sdf_find(type)};

    if (!oracle) {
        fail_msg("no test knows what is inside of a %s", type->record.name);
        return shape;
    }
    shape.inside = oracle->inside;
    struct scene *scene = random_scene(random, type, &limits);
    sdf_numbers(type->record.params, scene->root->params.values, shape.raw);
    scene_destroy(scene);
    if (random_below(random, 2)) {
        make_odd(random, type, shape.raw);
    }
    if (random_below(random, 2) && is_bent(type, shape.raw)) {
        unbend(shape.raw);
    }
    memcpy(shape.ready, shape.raw, sizeof shape.raw);
    if (shape.sdf->prepare) {
        shape.sdf->prepare(shape.ready);
    }
    shape.box = shape.sdf->box(shape.ready);
    return shape;
}

static double distance(const struct shape *shape, const double p[3])
{
    return shape->sdf->shape(p, shape->ready);
}

static bool inside(const struct shape *shape, const double p[3])
{
    return shape->inside(p, shape->raw);
}

static void fail_at(const struct shape *shape, const char *what, const double p[3], double d,
                    double other)
{
    fprintf(stderr, "%s:", shape->type->record.name);
    for (int i = 0; i < 12; i++) {
        fprintf(stderr, " %.17g", shape->raw[i]);
    }
    fail_msg("%s at %.17g %.17g %.17g: %.9g %s (%.9g)", shape->type->record.name, p[0], p[1], p[2],
             d, what, other);
}

/* --- points --- */

static void along(const double p[3], const double direction[3], double t, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = p[i] + t * direction[i];
    }
}

static double between(const double p[3], const double q[3])
{
    return sqrt(pow(p[0] - q[0], 2) + pow(p[1] - q[1], 2) + pow(p[2] - q[2], 2));
}

/* In the box, or not far from it. */
static void random_near(struct random *random, const struct shape *shape, double out[3])
{
    for (int i = 0; i < 3; i++) {
        const double low = fmax(shape->box.low[i], -REACH), high = fmin(shape->box.high[i], REACH);
        const double room = 0.1 * (high - low) + 0.05;
        out[i] = random_between(random, low - room, high + room);
    }
}

/* Moves `q`, which is not on p's side, to the surface on the way to p. */
static void to_surface(const struct shape *shape, const double p[3], double q[3])
{
    double near[3] = {p[0], p[1], p[2]};
    const bool in = inside(shape, p);

    for (int i = 0; i < 40 && between(near, q) > 1e-7; i++) {
        double middle[3];
        for (int j = 0; j < 3; j++) {
            middle[j] = (near[j] + q[j]) / 2;
        }
        memcpy(inside(shape, middle) == in ? near : q, middle, sizeof middle);
    }
}

/* Unit; false where the distance does not change around p. */
static bool gradient(const struct shape *shape, const double p[3], double out[3])
{
    const double h = 1e-6;
    double length = 0;

    for (int i = 0; i < 3; i++) {
        double ahead[3] = {p[0], p[1], p[2]}, behind[3] = {p[0], p[1], p[2]};
        ahead[i] += h;
        behind[i] -= h;
        out[i] = distance(shape, ahead) - distance(shape, behind);
        length += out[i] * out[i];
    }
    length = sqrt(length);
    for (int i = 0; i < 3 && length > 0; i++) {
        out[i] /= length;
    }
    return length > 0;
}

/* --- the surface --- */

struct cloud {
    double points[CLOUD_MAX][3];
    size_t count;
};

/* Between points of both sides, which find what the distances do not know of. */
static void add_pairs(struct random *random, const struct shape *shape, struct cloud *cloud)
{
    for (int i = 0; i < PAIRS; i++) {
        double p[3], q[3];
        random_near(random, shape, p);
        random_near(random, shape, q);
        if (inside(shape, p) != inside(shape, q)) {
            to_surface(shape, p, q);
            memcpy(cloud->points[cloud->count++], q, sizeof q);
        }
    }
}

/* From where the distances say that the surface is, which finds what is thin. */
static void add_feet(struct random *random, const struct shape *shape, struct cloud *cloud)
{
    for (int i = 0; i < PAIRS; i++) {
        double p[3], q[3], direction[3];
        random_near(random, shape, p);
        for (int step = 0; step < 6; step++) {
            const double d = distance(shape, p);
            if (fabs(d) < 1e-9 || !gradient(shape, p, direction)) {
                break;
            }
            along(p, direction, -d, p);
        }
        if (!gradient(shape, p, direction)) {
            continue;
        }
        along(p, direction, -1e-4, q);
        along(p, direction, 1e-4, p);
        if (inside(shape, p) != inside(shape, q)) {
            to_surface(shape, p, q);
            memcpy(cloud->points[cloud->count++], q, sizeof q);
        }
    }
}

/* Turns the way from p to `q`, which is not on its side, for as long as that gets shorter; returns
 * how long it is. */
static double look_around(struct random *random, const struct shape *shape, const double p[3],
                          const double q[3])
{
    double best[3] = {q[0], q[1], q[2]}, spread = 0.3;
    double nearest = between(p, best);
    const bool in = inside(shape, p);

    for (int i = 0; i < LOOKS && spread > 1e-4; i++) {
        double offset[3], turned[3], there[3], length = 0;
        random_direction(random, offset);
        for (int j = 0; j < 3; j++) {
            turned[j] = best[j] - p[j] + spread * nearest * offset[j];
            length += turned[j] * turned[j];
        }
        along(p, turned, nearest * (1 - 1e-4) / sqrt(fmax(length, 1e-30)), there);
        if (inside(shape, there) != in) {
            to_surface(shape, p, there);
            memcpy(best, there, sizeof best);
            nearest = between(p, best);
            spread *= 1.5;
        } else {
            spread *= 0.93;
        }
    }
    return nearest;
}

/* No less than the distance of the nearest point on the other side; INFINITY: none is known. */
static double nearest_of(struct random *random, const struct shape *shape,
                         const struct cloud *cloud, const double p[3])
{
    size_t order[NEAREST];
    double distances[NEAREST], nearest = INFINITY;
    size_t count = 0;

    for (size_t i = 0; i < cloud->count; i++) {
        const double d = between(p, cloud->points[i]);
        if (count == NEAREST && d >= distances[count - 1]) {
            continue;
        }
        size_t at = count < NEAREST ? count++ : count - 1;
        for (; at > 0 && d < distances[at - 1]; at--) {
            distances[at] = distances[at - 1];
            order[at] = order[at - 1];
        }
        distances[at] = d;
        order[at] = i;
    }
    const bool in = inside(shape, p);
    for (size_t i = 0; i < count; i++) {
        double q[3];
        along(p, (const double[3]){0, 0, 0}, 0, q);
        for (int j = 0; j < 3; j++) {
            /* A point of the surface is on one side or the other. */
            q[j] += (cloud->points[order[i]][j] - p[j]) * (1 + 1e-4);
        }
        const double there =
            inside(shape, q) != in ? look_around(random, shape, p, q) : distances[i];
        nearest = fmin(nearest, there);
    }
    return nearest;
}

/* Is a point of the other side so near to q? */
static bool other_side_near(struct random *random, const struct shape *shape, const double q[3],
                            bool in, int looks)
{
    for (int i = 0; i < looks; i++) {
        double direction[3], there[3];
        random_direction(random, direction);
        along(q, direction, TOLERANCE * (i % 4 + 1) / 4, there);
        if (inside(shape, there) != in) {
            return true;
        }
    }
    return false;
}

/* Follows the distance to where the nearest point should be, also from beside p, where the
 * gradient is better known; edges may be as sharp as needles. */
static bool is_reached(struct random *random, const struct shape *shape, const double p[3])
{
    const bool in = inside(shape, p);

    for (int i = 0; i < 12; i++) {
        double q[3], direction[3];
        random_direction(random, direction);
        along(p, direction, i % 4 * 2e-5, q);
        if (gradient(shape, q, direction)) {
            along(q, direction, -distance(shape, q), q);
            if (other_side_near(random, shape, q, in, i < 8 ? 200 : 20000)) {
                return true;
            }
        }
    }
    return false;
}

/* --- */

static void check_point(struct random *random, const struct shape *shape, const struct cloud *cloud,
                        const double p[3])
{
    const double d = distance(shape, p);

    if (fabs(d) > 1e-7 && inside(shape, p) != (d < 0)) {
        fail_at(shape, "has the wrong sign", p, d, 0);
    }
    const double nearest = nearest_of(random, shape, cloud, p);
    if (fabs(d) > nearest + TOLERANCE) {
        fail_at(shape, "overstates", p, d, nearest);
    }
    const bool bound = shape->type->exactness == BOUND ||
                       (d < 0 && is_bent(shape->type, shape->raw)) ||
                       inside_oracle_hollow(shape->type->record.name, shape->raw);
    if (!bound && fabs(d) < nearest - TOLERANCE && !is_reached(random, shape, p)) {
        fail_at(shape, "understates", p, d, nearest);
    }
    struct bounds box = bounds_grow(shape->box, fmax(d, 0) + 1e-9);
    for (int j = 0; j < 3; j++) {
        if (!(p[j] >= box.low[j] && p[j] <= box.high[j])) {
            fail_at(shape, "is outside of the box", p, d, 0);
        }
    }
}

static void check_row(struct random *random, const struct node_type *type)
{
    static struct cloud cloud;
    size_t known = 0;

    for (int set = 0; set < SETS; set++) {
        struct shape shape = random_shape(random, type);
        cloud.count = 0;
        add_pairs(random, &shape, &cloud);
        add_feet(random, &shape, &cloud);
        known += cloud.count >= 100;
        for (int k = 0; k < POINTS; k++) {
            double p[3];
            random_near(random, &shape, p);
            for (int j = 0; j < 3 && k % 4 == 0; j++) {
                p[j] = random_between(random, -REACH, REACH);
            }
            check_point(random, &shape, &cloud, p);
        }
    }
    if (known < SETS / 5) {
        fail_msg("%s: the surfaces of only %zu were found", type->record.name, known);
    }
}

static void distances_are_those_of_the_words(void **state)
{
    (void)state;
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        if (type->kind == KIND_SHAPE) {
            struct random random = {(uint64_t)type->number}; /* new rows change no other's */
            check_row(&random, type);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_those_of_the_words),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
