/* SPDX-License-Identifier: MIT */
/* Rays of the engine against the equations' own values in double precision: where a ray through the
 * clip meets the solid first. Of each function f both solids are drawn, f <= 0 and f >= 0, so each
 * ray begins outside of one of them and has to find the first root. The reference takes samples
 * along the ray; where |f| is least between them it looks for a root of even order.
 *
 * And the bound of the distance, which is asked beside rays, against points of the surfaces.
 *
 * EQUATION_POINTS=10000: at so many places, with ten points of the surface for each.
 * EQUATION_ROWS=256: the whole picture, not a row of it; EQUATION_FIELD=barth: this
 * field alone; EQUATION_STAGE=compute: by shaders. */
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "protocol/equation.h"
#include "protocol/memory.h"
#include "renderer/code/equation_value.h"
#include "renderer/field/field_quality.h"
#include "tests/support/compiled.h"
#include "tests/support/drawing.h"
#include "tests/support/eye.h"
#include "tests/support/random_scene.h"
#include "tests/support/text_file.h"

enum { SIDE = 256, ROWS = 1, SAMPLES = 384, REFINEMENTS = 60, THREADS = 2, TEXT = 8192 };

#define DEPTH 0.01 /* of the clip's half side: more is wrong */
#define ROOT 1e-16 /* of the next samples' values: so little is 0 where f only touches it */
#define LOW 0.0005 /* parts of the rays that may be wrong */
#define HIGH 0.003 /* the same of polynomials of degree 9 to 18, sums of hundreds of terms */

static const double letter_values[] = {1, 1, 1, 1};

/* `text` NULL: in tests/support/equations. */
static const struct equation_field {
    const char *name, *text;
    double half; /* of the clip, a box */
    double wrong;
    bool square; /* its rays are told as unresolved */
    int row;     /* of the picture, the first; 0: those in its middle */
} fields[] = {
    {"gyroid", "sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)", 4, LOW, false, 0},
    {"blobs",
     "0.32 - exp(-(x-1.1)^2-y^2-z^2) - exp(-(x+1.1)^2-y^2-z^2) - exp(-x^2-(y-1.4)^2-z^2)"
     " - exp(-x^2-y^2-(z-1.3)^2)",
     4, LOW, false, 0},
    {"helicoid", "x*sin(3*z) - y*cos(3*z)", 1.5, LOW, false, 0},
    {"barth", "t := phi; 4*(t^2*x^2-y^2)*(t^2*y^2-z^2)*(t^2*z^2-x^2) - (1+2*t)*(x^2+y^2+z^2-1)^2",
     1.6, LOW, false, 0},
    {"kummer",
     "m := 1.3; n := (3*m-1)/(3-m); p := (1-z-sqrt(2)*x)*(1-z+sqrt(2)*x);"
     "q := (1+z+sqrt(2)*y)*(1+z-sqrt(2)*y); (x^2+y^2+z^2-m)^2 - n*p*q",
     1.7, LOW, false, 0},
    {"heart", "(x^2+9/4*z^2+y^2-1)^3 - x^2*y^3 - 9/80*z^2*y^3", 1.4, LOW, false, 0},
    {"double sphere", "(x^2+y^2+z^2-1)^2", 1.4, LOW, true, 0},
    {"whitney", "x^2 - y^2*z", 1.5, LOW, false, 0},
    {"clebsch",
     "81*(x^3+y^3+z^3) - 189*(x^2*y+x^2*z+y^2*x+y^2*z+z^2*x+z^2*y) + 54*x*y*z"
     " + 126*(x*y+x*z+y*z) - 9*(x^2+y^2+z^2) - 9*(x+y+z) + 1",
     1.5, LOW, false, 0},
    {"chmutov", "cheb(8,x) + cheb(8,y) + cheb(8,z)", 1.1, LOW, false, 0},
    {"octahedra", "abs(abs(x)+abs(y)+abs(z)-0.9) - 0.15", 1.3, LOW, false, 0},
    {"triangle", NULL, 2, HIGH, false, 0},
    {"klein", NULL, 3.2, HIGH, false, 0},
    {"henneberg", NULL, 3, HIGH, false, 0},
    {"eighteen", NULL, 1.5, HIGH, false, 163},
};
enum { FIELDS = sizeof fields / sizeof fields[0] };

static const struct equation_field *field_named(const char *name)
{
    const struct equation_field *field = fields;

    while (strcmp(field->name, name) != 0) {
        field++;
    }
    return field;
}

static int rows = ROWS, first_row;
static struct renderer *renderer;
static enum render_stage stage;

/* --- scenes --- */

static void read_text(const struct equation_field *field, char out[TEXT])
{
    char path[80];

    if (field->text) {
        snprintf(out, TEXT, "%s", field->text);
        return;
    }
    snprintf(path, sizeof path, "tests/support/equations/%s.txt", field->name);
    char *text = text_file_read(path, NULL);
    for (char *c = text; *c; c++) {
        *c = *c == '\n' ? ' ' : *c;
    }
    snprintf(out, TEXT, "%s", text);
    free(text);
}

/* The clip fills the picture. */
static struct scene *scene_of(const struct equation_field *field, const char *text,
                              const char *relation)
{
    static char json[TEXT + 1024];
    const double h = field->half;

    snprintf(json, sizeof json,
             "{'format':'fieldcast/1','camera':{'position':[%.9g,%.9g,%.9g],'target':[0,0,0],"
             "'fov':30},'root':{'type':'implicit','params':{'equation':'%s %s 0',"
             "'size':[%.9g,%.9g,%.9g]}}}",
             2.9 * h, 2.3 * h, 3.7 * h, text, relation, 2 * h, 2 * h, 2 * h);
    return drawing_parse(json);
}

/* --- the reference --- */

struct line {
    const struct equation *equation;
    double origin[3], way[3];
};

static double value_at(const struct line *line, double t)
{
    double p[3];

    for (int i = 0; i < 3; i++) {
        p[i] = line->origin[i] + t * line->way[i];
    }
    return equation_value(line->equation, p, letter_values);
}

/* The way through the box; false: past it. */
static bool span_of(const struct line *line, double half, double out[2])
{
    out[0] = 0;
    out[1] = INFINITY;
    for (int i = 0; i < 3; i++) {
        const double a = (-half - line->origin[i]) / line->way[i];
        const double b = (half - line->origin[i]) / line->way[i];
        out[0] = fmax(out[0], fmin(a, b));
        out[1] = fmin(out[1], fmax(a, b));
    }
    return out[0] < out[1];
}

/* Where the sign changes between t and u. */
static double bisect(const struct line *line, double t, double u, bool below)
{
    for (int i = 0; i < REFINEMENTS; i++) {
        const double middle = 0.5 * (t + u);
        const bool on = (value_at(line, middle) < 0) == below;
        t = on ? middle : t;
        u = on ? u : middle;
    }
    return u;
}

/* Where |f| is least between t and u, by golden sections, or where its sign changes. */
static double least(const struct line *line, double t, double u)
{
    for (int i = 0; i < REFINEMENTS; i++) {
        const double a = u - 0.618033988749895 * (u - t), b = t + 0.618033988749895 * (u - t);
        const bool left = fabs(value_at(line, a)) < fabs(value_at(line, b));
        t = left ? t : a;
        u = left ? b : u;
    }
    return 0.5 * (t + u);
}

struct found {
    bool below;         /* the ray begins where f < 0 */
    double enter, root; /* INFINITY: never */
};

static struct found find(const struct line *line, const double span[2])
{
    const double step = (span[1] - span[0]) / SAMPLES;
    double before = 0, here = value_at(line, span[0]);
    struct found found = {.below = here < 0, .enter = span[0], .root = INFINITY};

    for (int i = 1; i <= SAMPLES && isinf(found.root); i++) {
        const double t = span[0] + i * step, next = value_at(line, t);
        if ((next < 0) != found.below) {
            found.root = bisect(line, t - step, t, found.below);
        } else if (fabs(here) <= fabs(before) && fabs(here) <= fabs(next)) {
            const double at = least(line, t - 2 * step, t), f = value_at(line, at);
            if ((f < 0) != found.below) {
                found.root = bisect(line, t - 2 * step, at, found.below);
            } else if (fabs(f) <= ROOT * fmin(fabs(before), fabs(next))) {
                found.root = at;
            }
        }
        before = here;
        here = next;
    }
    return found;
}

struct reference {
    const struct equation *equation;
    struct eye eye;
    double half;
    struct found *found; /* of each pixel */
    atomic_int row;      /* the next to be taken */
};

static void *find_rows(void *data)
{
    struct reference *r = data;

    for (int row; (row = atomic_fetch_add(&r->row, 1)) < rows;) {
        for (int x = 0; x < SIDE; x++) {
            struct line line = {.equation = r->equation};
            struct found *found = &r->found[row * SIDE + x];
            double span[2];
            eye_ray(&r->eye, SIDE, SIDE, x, first_row + row, line.origin, line.way);
            *found = span_of(&line, r->half, span)
                         ? find(&line, span)
                         : (struct found){.enter = INFINITY, .root = INFINITY};
        }
    }
    return NULL;
}

/* The caller frees the result. */
static struct found *find_all(const struct equation_field *field, const char *text)
{
    struct equation_errors errors;
    struct equation *equation = equation_read(text, equation_letters, &errors);
    struct scene *scene = scene_of(field, text, "=");
    pthread_t threads[THREADS];

    assert_non_null(equation);
    struct reference r = {.equation = equation,
                          .eye = eye_of(&scene->camera),
                          .half = field->half,
                          .found = memory_alloc((size_t)rows * SIDE, sizeof *r.found)};
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, find_rows, &r), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
    }
    scene_destroy(scene);
    free(equation);
    return r.found;
}

/* --- rays --- */

struct tally {
    int rays, hits, missed, extra, off;
    double worst[2]; /* depths of the one that is off the most */
};

/* Of one solid, `below`: f <= 0. */
static void judge(struct tally *tally, const struct equation_field *field, const char *text,
                  const struct found *found, bool below)
{
    struct scene *scene = scene_of(field, text, below ? "<=" : ">=");
    struct resident *resident = resident_create(renderer, scene, 1);
    struct job_desc desc = drawing_desc(SIDE, SIDE);

    desc.region = (struct job_region){0, first_row, SIDE, rows};
    desc.as_floats = true;
    struct image image = drawing_of(resident, &desc, AOV_DEPTH);
    const float *depths = image.pixels;
    for (int i = 0; i < rows * SIDE; i++) {
        const double meant = found[i].below == below ? found[i].enter : found[i].root;
        const double depth = depths[i];
        tally->rays += below && found[i].enter < INFINITY;
        tally->hits += meant < INFINITY && found[i].below != below;
        tally->missed += meant < INFINITY && !(depth < INFINITY);
        tally->extra += !(meant < INFINITY) && depth < INFINITY;
        if (meant < INFINITY && depth < INFINITY) {
            tally->off += fabs(depth - meant) > DEPTH * field->half;
            if (fabs(depth - meant) > fabs(tally->worst[0] - tally->worst[1])) {
                tally->worst[0] = meant;
                tally->worst[1] = depth;
            }
        }
    }
    image_finish(&image);
    resident_destroy(resident);
}

static void rays_end_at_the_first_root(void **state)
{
    const struct equation_field *field = *state;
    struct tally tally = {0};
    char text[TEXT];

    first_row = field->row > 0 && rows == ROWS ? field->row : (SIDE - rows) / 2;
    read_text(field, text);
    struct found *found = find_all(field, text);
    judge(&tally, field, text, found, true);
    judge(&tally, field, text, found, false);
    free(found);
    const int wrong = tally.missed + tally.extra + tally.off;
    print_message("# %-13s %6d rays, %6d roots, wrong %.3f %%: %d missed, %d extra, %d off (%g, "
                  "not %g)\n",
                  field->name, tally.rays, tally.hits, 100.0 * wrong / tally.rays, tally.missed,
                  tally.extra, tally.off, tally.worst[1], tally.worst[0]);
    assert_true(tally.hits > tally.rays / 20);
    assert_true(wrong <= fmax(1, field->wrong * tally.rays));
}

/* --- bounds --- */

enum { PLACES = 100 };

static void random_place(struct random *random, double half, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = (float)random_between(random, -half, half);
    }
}

/* Between two places of the clip; false: there is none. */
static bool surface_point(struct random *random, const struct equation *equation, double half,
                          bool square, double out[3])
{
    struct line line = {.equation = equation};
    double to[3];

    random_place(random, half, line.origin);
    random_place(random, half, to);
    for (int i = 0; i < 3; i++) {
        line.way[i] = to[i] - line.origin[i];
    }
    const bool below = value_at(&line, 0) < 0;
    const double t = square ? find(&line, (const double[]){0, 1}).root : bisect(&line, 0, 1, below);
    for (int i = 0; i < 3; i++) {
        out[i] = line.origin[i] + t * line.way[i];
    }
    return t < INFINITY && (square || (value_at(&line, 1) < 0) != below);
}

struct place {
    double at[3];
};

/* The caller frees the result. */
static struct place *surface_points(struct random *random, const struct equation_field *field,
                                    const char *text, size_t count)
{
    struct equation_errors errors;
    struct equation *equation = equation_read(text, equation_letters, &errors);
    struct place *points = memory_alloc(count, sizeof *points);

    for (size_t found = 0; found < count;) {
        found += surface_point(random, equation, field->half, field->square, points[found].at);
    }
    free(equation);
    return points;
}

static double nearest(const struct place *points, size_t count, const double p[3])
{
    double square = INFINITY;

    for (size_t i = 0; i < count; i++) {
        const double x = points[i].at[0] - p[0], y = points[i].at[1] - p[1],
                     z = points[i].at[2] - p[2];
        square = fmin(square, x * x + y * y + z * z);
    }
    return sqrt(square);
}

static void bounds_are_below_the_distance(void **state)
{
    const char *asked = getenv("EQUATION_POINTS");
    const size_t places = asked ? (size_t)atoi(asked) : PLACES;
    struct random random = {.state = 7};
    char text[TEXT];
    (void)state;

    for (int i = 0; i < FIELDS; i++) {
        read_text(&fields[i], text);
        struct scene *scene = scene_of(&fields[i], text, "=");
        struct place *points = surface_points(&random, &fields[i], text, 10 * places);
        const clock_t begin = clock();
        struct field *field = compile_field(scene);
        const double ms = 1e3 * (double)(clock() - begin) / CLOCKS_PER_SEC;
        double kept = 0;
        for (size_t k = 0; k < places; k++) {
            double p[3];
            random_place(&random, fields[i].half, p);
            const double d = fabs(field_distance(field, p));
            const double distance = nearest(points, 10 * places, p);
            if (d > distance + 1e-3) {
                fail_msg("%s at (%.9g, %.9g, %.9g): %g, but a point of the surface at %g",
                         fields[i].name, p[0], p[1], p[2], d, distance);
            }
            kept += d / distance / (double)places;
        }
        print_message("# %-13s %.2f of the distance is kept; compiled in %.2f ms\n", fields[i].name,
                      kept, ms);
        free(points);
        field_unref(field);
        scene_destroy(scene);
    }
}

/* llvmpipe ends a shader after 65,535 rounds of its loops, so many rounds leave few steps. */
static void loops_leave_steps_enough(void **state)
{
    enum { ROUNDS = 65000, STEPS = 150 };
    char text[TEXT];
    (void)state;

    for (int i = 0; i < FIELDS; i++) {
        read_text(&fields[i], text);
        struct scene *scene = scene_of(&fields[i], text, "=");
        struct field *field = compile_field(scene);
        if (ROUNDS / (1 + field->loop_trips) < STEPS) {
            fail_msg("%s: %u rounds of loops at each step", fields[i].name, field->loop_trips);
        }
        field_unref(field);
        scene_destroy(scene);
    }
}

/* With the steps that are left, rays by shaders come as far as those of the engine. */
static void shaders_end_at_the_first_root(void **state)
{
    const struct equation_field *field = field_named("eighteen");
    (void)state;

    renderer_use_stage(renderer, RENDER_COMPUTE);
    rays_end_at_the_first_root((void *[]){(void *)field});
    renderer_use_stage(renderer, stage);
}

/* --- what a picture costs --- */

enum { TURNS_LEAST = 3, TURNS_MOST = 20, COST_WIDTH = 640, COST_HEIGHT = 360 };

/* Of what a mandelbulb costs, in which arithmetic alone counts, in half of the width and height.
 * Where that takes 0.24 s of the processor, `asked` is 60, 36 and 60 ms of two. A busy machine
 * shares its caches, which the pictures here feel and the mandelbulb does not: what fails is twice
 * as much. */
static const struct cost {
    const char *field;
    double asked;
} costs[] = {{"gyroid", 0.5}, {"barth", 0.3}, {"triangle", 0.5}};
enum { COSTS = sizeof costs / sizeof costs[0] };

/* Seconds of the processor for the first picture of a scene, which is destroyed. */
static double seconds_of(struct scene *scene, int width, int height)
{
    struct job_desc desc = drawing_desc(width, height);

    desc.level = QUALITY_DRAFT;
    desc.as_floats = true;
    const clock_t begin = clock();
    struct resident *resident = resident_create(renderer, scene, 1);
    struct image image = drawing_of(resident, &desc, AOV_DEPTH);
    const clock_t end = clock();
    image_finish(&image);
    resident_destroy(resident);
    return (double)(end - begin) / CLOCKS_PER_SEC;
}

static struct scene *scene_with(const char *root)
{
    char json[256];

    snprintf(json, sizeof json,
             "{'format':'fieldcast/1','camera':{'position':[2.9,2.3,3.7],'target':[0,0,0],"
             "'fov':30},'root':{%s}}",
             root);
    return drawing_parse(json);
}

/* The least that was seen; of a busy machine it takes some turns to see it. */
struct seen_costs {
    double empty, unit, each[COSTS];
};

static void measure_costs(struct seen_costs *seen)
{
    char text[TEXT];

    seen->empty = fmin(seen->empty, seconds_of(scene_with("'type':'sphere','visible':false"),
                                               COST_WIDTH, COST_HEIGHT));
    seen->unit = fmin(
        seen->unit, seconds_of(scene_with("'type':'mandelbulb'"), COST_WIDTH / 2, COST_HEIGHT / 2));
    for (int i = 0; i < COSTS; i++) {
        const struct equation_field *field = field_named(costs[i].field);
        read_text(field, text);
        seen->each[i] =
            fmin(seen->each[i], seconds_of(scene_of(field, text, "<="), COST_WIDTH, COST_HEIGHT));
    }
}

/* Beyond a picture of nothing. */
static double part_of(const struct seen_costs *seen, int i)
{
    return (seen->each[i] - seen->empty) / (seen->unit - seen->empty / 4);
}

static bool cost_too_much(const struct seen_costs *seen)
{
    bool much = false;

    for (int i = 0; i < COSTS; i++) {
        much = much || !(part_of(seen, i) < 2 * costs[i].asked);
    }
    return much;
}

static void pictures_cost_little(void **state)
{
    struct seen_costs seen = {INFINITY, INFINITY, {INFINITY, INFINITY, INFINITY}};
    (void)state;

    for (int turn = 0; turn < TURNS_LEAST || (turn < TURNS_MOST && cost_too_much(&seen)); turn++) {
        measure_costs(&seen);
    }
    for (int i = 0; i < COSTS; i++) {
        print_message("# %-13s %.0f ms, %.2f of a mandelbulb (%.2f asked)\n", costs[i].field,
                      1e3 * (seen.each[i] - seen.empty), part_of(&seen, i), costs[i].asked);
    }
    assert_false(cost_too_much(&seen));
}

/* --- what is unresolved --- */

static void keep(void *data, const struct equation_quality *quality)
{
    *(struct equation_quality *)data = *quality;
}

static void unresolved_rays_are_told(void **state)
{
    char text[TEXT];
    (void)state;

    for (int i = 0; i < FIELDS; i++) {
        struct equation_quality quality = {0};
        read_text(&fields[i], text);
        struct scene *scene = scene_of(&fields[i], text, "=");
        field_qualities(scene, NULL, keep, &quality);
        scene_destroy(scene);
        /* Of 400 a few may pass near a line where the sign does not change. */
        const double share = quality.rays ? (double)quality.unresolved / quality.rays : -1;
        if (fields[i].square ? share < 0.1 : share < 0 || share > 0.02) {
            fail_msg("%s: %d of %d rays unresolved", fields[i].name, quality.unresolved,
                     quality.rays);
        }
    }
}

static int start(void **state)
{
    (void)state;
    const char *asked = getenv("EQUATION_STAGE");

    renderer = drawing_renderer(0);
    stage = asked && strcmp(asked, "compute") == 0 ? RENDER_COMPUTE : RENDER_ENGINE;
    renderer_use_stage(renderer, stage);
    return 0;
}

static int stop(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

int main(void)
{
    static struct CMUnitTest tests[FIELDS + 5];
    const char *asked = getenv("EQUATION_ROWS"), *only = getenv("EQUATION_FIELD");
    size_t n = 0;

    rows = asked ? atoi(asked) : ROWS;
    for (int i = 0; i < FIELDS; i++) {
        tests[n++] = (struct CMUnitTest){fields[i].name, rays_end_at_the_first_root, NULL, NULL,
                                         (void *)&fields[i]};
    }
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(bounds_are_below_the_distance);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(loops_leave_steps_enough);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(shaders_end_at_the_first_root);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(pictures_cost_little);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(unresolved_rays_are_told);
    if (only) {
        cmocka_set_test_filter(only);
    }
    return _cmocka_run_group_tests("rays of equations", tests, n, start, stop);
}
