/* SPDX-License-Identifier: MIT */
/* No field oversteps: rays marched by the whole distance meet the same surfaces as rays marched by
 * a quarter of it, and never land inside. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/support/compiled.h"
#include "tests/support/random_scene.h"

enum { WIDTH = 20, HEIGHT = 15, STEPS_MAX = 2000 };

#define REACH 14.0     /* rays end here */
#define TOLERANCE 1e-5 /* so near is on the surface */
#define ROOM 0.01      /* between two hits of the same surface: grazing rays are near it for long */
#define DEPTH 1e-4     /* so far below the surface is inside */

struct hit {
    double t; /* REACH: none */
    double d;
    bool lost; /* too many steps */
};

/* `parts`: into how many steps each distance is cut. */
static struct hit march(const struct field *field, const double origin[3],
                        const double direction[3], int parts)
{
    struct hit hit = {0};

    for (int step = 0; step < STEPS_MAX * parts; step++) {
        double p[3];
        for (int i = 0; i < 3; i++) {
            p[i] = origin[i] + hit.t * direction[i];
        }
        hit.d = field_distance(field, p);
        if (hit.d < TOLERANCE) {
            return hit;
        }
        hit.t += fmax(hit.d / parts, TOLERANCE);
        if (hit.t >= REACH) {
            return (struct hit){.t = REACH};
        }
    }
    return (struct hit){.lost = true};
}

/* How many rays there were, how many of them went wrong or nowhere, and the scene of the first that
 * went wrong. */
struct tally {
    size_t rays, wrong, lost;
    char *first;
};

/* Of a thousand rays at most one oversteps; of fifty at most one runs out of steps. */
static void tally_finish(struct tally *tally, const char *name, bool *ok)
{
    if (tally->wrong * 1000 > tally->rays || tally->lost * 50 > tally->rays) {
        *ok = false;
        fprintf(stderr, "%s: of %zu rays %zu overstep, %zu get lost\n%s\n", name, tally->rays,
                tally->wrong, tally->lost, tally->first ? tally->first : "");
    }
    free(tally->first);
    *tally = (struct tally){0};
}

static void check_ray(struct tally *tally, const struct scene *scene, const struct field *field,
                      const double origin[3], const double direction[3])
{
    struct hit whole = march(field, origin, direction, 1), quarter = {.lost = true};

    if (!whole.lost) {
        quarter = march(field, origin, direction, 4);
    }
    tally->rays++;
    tally->lost += quarter.lost;
    if (quarter.lost || (fabs(whole.t - quarter.t) <= ROOM && (whole.t == 0 || whole.d > -DEPTH))) {
        return;
    }
    tally->wrong++;
    if (!tally->first) {
        char *text = root_text(scene);
        if (asprintf(&tally->first,
                     "from %.9g %.9g %.9g along %.9g %.9g %.9g: %.6g (%.3g), not %.6g (%.3g)\n%s",
                     origin[0], origin[1], origin[2], direction[0], direction[1], direction[2],
                     whole.t, whole.d, quarter.t, quarter.d, text) < 0) {
            abort();
        }
        free(text);
    }
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = a[j] * b[k] - a[k] * b[j];
    }
}

/* A picture from somewhere around the scene. */
static void check_picture(struct random *random, struct tally *tally, const struct scene *scene,
                          int width, int height)
{
    struct field *field = compile_field(scene);
    double back[3], any[3], right[3], up[3], origin[3];

    random_direction(random, back);
    random_direction(random, any);
    cross(back, any, right);
    cross(back, right, up);
    for (int i = 0; i < 3; i++) {
        origin[i] = 6 * back[i];
    }
    for (int pixel = 0; pixel < width * height; pixel++) {
        const double x = (pixel % width + 0.5) / width - 0.5,
                     y = (pixel / width + 0.5) / height - 0.5;
        double direction[3], square = 0;
        for (int i = 0; i < 3; i++) {
            direction[i] = x * right[i] + y * up[i] - back[i];
            square += direction[i] * direction[i];
        }
        for (int i = 0; i < 3; i++) {
            direction[i] /= sqrt(square);
        }
        check_ray(tally, scene, field, origin, direction);
    }
    field_unref(field);
}

static void no_row_oversteps(void **state)
{
    (void)state;
    struct random random = {31};
    struct tally tally = {0};
    bool ok = true;

    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        if (type->kind == KIND_MODEL || type->kind == KIND_CODE) {
            continue;
        }
        for (int round = 0; round < 15; round++) {
            const struct random_limits limits = {.depth = 1, .bounded = true};
            struct scene *scene = random_scene(&random, type, &limits);
            check_picture(&random, &tally, scene, WIDTH / 2, HEIGHT / 2);
            scene_destroy(scene);
        }
        tally_finish(&tally, type->record.name, &ok);
    }
    assert_true(ok);
}

static void no_scene_oversteps(void **state)
{
    (void)state;
    struct random random = {32};
    struct tally tally = {0};
    bool ok = true;

    for (int i = 0; i < 100; i++) {
        const struct random_limits limits = {.depth = 1 + i % 4, .bounded = true};
        const enum node_kind kind = (enum node_kind)(KIND_COMBINE + i / 4 % 4);
        struct scene *scene = random_scene(&random, random_type(&random, kind, &limits), &limits);
        check_picture(&random, &tally, scene, WIDTH, HEIGHT);
        scene_destroy(scene);
    }
    tally_finish(&tally, "nested scenes", &ok);
    assert_true(ok);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_row_oversteps),
        cmocka_unit_test(no_scene_oversteps),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
