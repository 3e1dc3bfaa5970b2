/* SPDX-License-Identifier: MIT */
/* A plane cuts a scene: depth, normal and node are where geometry says they are, whoever draws, and
 * what is picked there is what is seen. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/limits.h"
#include "renderer/draw/camera.h"
#include "renderer/pick.h"
#include "tests/support/drawing.h"
#include "tests/support/json_text.h"

enum {
    WIDTH = 64,
    HEIGHT = 36,
    STEPS = 2,      /* of 255, by which a pixel may differ; */
    PER_MILLE = 10, /* more of them are edges, where one ray meets another surface */
};

static const char ball[] =
    "{'format':'fieldcast/1','camera':{'position':[1.5,2,3.5],'target':[0,0,0],'fov':40},"
    "'root':{'id':'ball','type':'sphere','params':{'radius':1}}}";
/* Above the floor, which the plane y = -0.999 leaves alone. */
static const char ball_on_floor[] =
    "{'format':'fieldcast/1','camera':{'position':[0,2,5],'target':[0,-0.5,0]},"
    "'environment':{'floor':true,'floor_height':-1},"
    "'lights':[{'type':'directional','direction':[-0.3,-1,-0.2]}],"
    "'volumes':[{'type':'box','position':[0,-0.5,0],'size':[4,0.9,4],'density':0.3}],"
    "'root':{'id':'ball','type':'sphere','params':{'radius':0.8}}}";

static const struct {
    enum render_stage stage;
    const char *name;
} roads[] = {{RENDER_ENGINE, "engine"}, {RENDER_COMPUTE, "compute"}, {RENDER_FRAGMENT, "fragment"}};
enum { ROADS = sizeof roads / sizeof roads[0] };

static struct renderer *renderer;

static struct record section_of(const char *text)
{
    struct record section;
    struct error err = {0};
    cJSON *json = json_text_parse(text, &err);

    record_init(&section, &section_type);
    assert_non_null(json);
    assert_true(record_read(&section, json, "", &err));
    cJSON_Delete(json);
    return section;
}

static struct resident *reside(struct scene *scene, int road)
{
    renderer_use_stage(renderer, roads[road].stage);
    return resident_create(renderer, scene, 1);
}

/* Numbers, as `section` cuts; NULL: all. */
static struct drawing measure(struct resident *resident, const struct record *section,
                              bool as_floats)
{
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);

    desc.as_floats = as_floats;
    desc.section = section;
    desc.samples = 1;
    for (int i = 0; i < AOV_COUNT; i++) {
        desc.aovs[i] = aov_row((enum aov)i)->picture || as_floats;
    }
    return drawing_outputs(renderer, resident, &desc);
}

/* --- a ball cut in two --- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void along(const double origin[3], const double direction[3], double t, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = origin[i] + t * direction[i];
    }
}

struct found {
    double t; /* infinite: nothing */
    double normal[3];
    bool cut;  /* on the plane */
    bool edge; /* so near to one that the next pixel may be another */
};

/* Where a ray from the side that is cut off meets the rest of the unit ball at the origin. */
static struct found look(const double origin[3], const double direction[3], const double plane[3],
                         double offset)
{
    static const double margin = 0.02;
    const double b = dot(origin, direction), in_root = b * b - dot(origin, origin) + 1;
    const double to_plane = (offset - dot(origin, plane)) / dot(direction, plane);
    struct found found = {.t = INFINITY, .edge = fabs(in_root) < margin};
    double p[3];

    assert_true(dot(origin, plane) > offset);
    along(origin, direction, to_plane, p);
    const double rim = dot(p, p) - 1;
    found.edge = found.edge || fabs(rim) < margin;
    if (to_plane > 0 && rim < 0) {
        found.t = to_plane;
        found.cut = true;
        memcpy(found.normal, plane, sizeof found.normal);
    } else if (to_plane > 0 && in_root > 0 && -b - sqrt(in_root) > to_plane) {
        found.t = -b - sqrt(in_root);
        along(origin, direction, found.t, found.normal);
    }
    return found;
}

struct half {
    struct drawing drawing;
    struct pick_field *field;
    struct record section;
    double plane[3], offset;
    int cut, round, edges; /* pixels */
};

static void check_pick(const struct half *half, int x, int y, const struct found *want,
                       const char *node)
{
    const struct pick_result hit = pick_at(half->field, &(struct pick_question){
                                                            .section = &half->section,
                                                            .width = WIDTH,
                                                            .height = HEIGHT,
                                                            .x = x + 0.5,
                                                            .y = y + 0.5,
                                                        });

    assert_string_equal(hit.node, node);
    assert_int_equal(hit.hit, want->t < INFINITY);
    if (hit.hit) {
        assert_true(fabs(hit.distance - want->t) < 2e-3);
        assert_true(dot(hit.normal, want->normal) > (want->cut ? 1 - 1e-9 : 0.9999));
    }
}

static void check_pixel(struct half *half, const struct camera *camera, int x, int y)
{
    const int i = y * WIDTH + x;
    const float depth = ((const float *)half->drawing.of[AOV_DEPTH].pixels)[i];
    const float *n = (const float *)half->drawing.of[AOV_NORMAL].pixels + 3 * (size_t)i;
    const uint32_t id = ((const uint32_t *)half->drawing.of[AOV_ID].pixels)[i];
    double origin[3], direction[3];

    camera_ray(camera, WIDTH, HEIGHT, x + 0.5, y + 0.5, origin, direction);
    const struct found want = look(origin, direction, half->plane, half->offset);
    if (want.edge) {
        half->edges++;
        return;
    }
    half->cut += want.cut;
    half->round += !want.cut && want.t < INFINITY;
    assert_int_equal(id != 0, want.t < INFINITY);
    if (id == 0) {
        assert_true(isinf(depth));
    } else {
        const double normal[] = {n[0], n[1], n[2]};
        if (!(fabs(depth - want.t) < 1e-4 * want.t) || !(dot(normal, want.normal) > 0.9999)) {
            fail_msg("%d, %d: %g is not %g, or %g, %g, %g not %g, %g, %g", x, y, depth, want.t,
                     n[0], n[1], n[2], want.normal[0], want.normal[1], want.normal[2]);
        }
    }
    check_pick(half, x, y, &want, id ? "ball" : "");
}

/* The length of the normal does not matter. */
static void a_ball_is_cut_in_two(void **state)
{
    struct error err = {0};
    struct scene *scene = json_text_scene(ball, &err);
    const struct camera camera = camera_from_record(&scene->camera, WIDTH, HEIGHT);
    struct half half = {.section = section_of("{'normal':[20,10,20],'offset':0.25}"),
                        .plane = {2.0 / 3, 1.0 / 3, 2.0 / 3},
                        .offset = 0.25,
                        .field = pick_field_create(scene, NULL, 0, &err)};

    (void)state;
    for (int road = 0; road < ROADS; road++) {
        struct resident *resident = reside(drawing_parse(ball), road);
        half.drawing = measure(resident, &half.section, true);
        half.cut = half.round = half.edges = 0;
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            check_pixel(&half, &camera, i % WIDTH, i / WIDTH);
        }
        assert_in_range(half.cut, 200, WIDTH * HEIGHT);
        assert_in_range(half.round, 10, WIDTH * HEIGHT);
        assert_in_range(half.edges, 0, 200);
        drawing_finish(&half.drawing);
        resident_destroy(resident);
    }
    record_finish(&half.section);
    pick_field_unref(half.field);
    scene_destroy(scene);
}

/* --- the rest of the light --- */

/* What is cut off is as if it were not there: neither shadow nor occlusion of it is left, nor what
 * it does to smoke. */
static void what_is_cut_off_throws_no_shadow(void **state)
{
    struct record section = section_of("{'offset':-0.999}");

    (void)state;
    for (int road = 0; road < ROADS; road++) {
        struct scene *scene = drawing_parse(ball_on_floor);
        struct resident *resident = reside(scene, road);
        struct drawing all = measure(resident, NULL, true);
        struct drawing cut = measure(resident, &section, true);
        struct error err = {0};
        cJSON *hide =
            json_text_parse("[{'op':'set','at':'/nodes/ball/visible','value':false}]", &err);
        assert_true(resident_edit(resident, hide, 2, &err));
        struct drawing without = measure(resident, NULL, true);
        int shadows = 0;

        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const float *s[] = {all.of[AOV_SHADOW].pixels, cut.of[AOV_SHADOW].pixels};
            const float *color[] = {cut.of[AOV_COLOR].pixels, without.of[AOV_COLOR].pixels};
            shadows += s[0][3 * i] < 0.5f;
            assert_true(s[1][3 * i] == 1);
            for (int c = 0; c < 3; c++) {
                assert_true(fabsf(color[0][4 * i + c] - color[1][4 * i + c]) < 5e-3f);
            }
        }
        assert_in_range(shadows, 50, WIDTH * HEIGHT);
        drawing_finish(&all);
        drawing_finish(&cut);
        drawing_finish(&without);
        cJSON_Delete(hide);
        resident_destroy(resident);
    }
    record_finish(&section);
}

/* --- everything --- */

/* Of bytes. */
static size_t count_different(const struct image *a, const struct image *b)
{
    const uint8_t *p = a->pixels, *q = b->pixels;
    size_t different = 0;

    assert_int_equal(a->bytes, b->bytes);
    for (size_t i = 0; i < a->bytes; i++) {
        different += abs(p[i] - q[i]) > STEPS;
    }
    return different;
}

static void compare(const struct drawing *a, const struct drawing *b, const char *name)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        const size_t different = a->of[i].bytes > 0 ? count_different(&a->of[i], &b->of[i]) : 0;
        if (different * 1000 > a->of[i].bytes * PER_MILLE) {
            fail_msg("%s, %s: %zu of %zu differ", name, aov_name((enum aov)i), different,
                     a->of[i].bytes);
        }
    }
}

/* Mirrors and glass are cut too. */
static void all_roads_cut_alike(void **state)
{
    struct record section = section_of("{'normal':[0.2,0.3,1],'offset':0.1}");
    struct drawing engine = {0};

    (void)state;
    for (int road = 0; road < ROADS; road++) {
        struct resident *resident = reside(drawing_read(DRAWING_RICH), road);
        struct drawing all = measure(resident, NULL, false);
        struct drawing cut = measure(resident, &section, false);

        assert_true(count_different(&all.of[AOV_COLOR], &cut.of[AOV_COLOR]) * 10 >
                    all.of[AOV_COLOR].bytes);
        if (road == 0) {
            engine = cut;
        } else {
            compare(&cut, &engine, roads[road].name);
            drawing_finish(&cut);
        }
        drawing_finish(&all);
        resident_destroy(resident);
    }
    drawing_finish(&engine);
    record_finish(&section);
}

/* So many that the engine looks at parts of the field alone. Twisted by nothing, they are one part:
 * then nothing of it is left out. */
static struct scene *many_balls(bool whole)
{
    enum { BALLS = 64 };
    char text[10000];
    size_t at = (size_t)snprintf(text, sizeof text,
                                 "{'format':'fieldcast/1','root':{'type':'%s','params':{%s},"
                                 "'children':[{'type':'union','children':[",
                                 whole ? "twist" : "union", whole ? "'rate':0" : "");

    for (unsigned i = 0; i < BALLS; i++) {
        at += (size_t)snprintf(text + at, sizeof text - at,
                               "%s{'type':'%s','transform':{'translation':"
                               "[%g,%g,%g],'scale':[0.2,0.2,0.2]}}",
                               i > 0 ? "," : "", i % 2 ? "sphere" : "box",
                               0.05 * (i * 37 % BALLS) - 1.6, 0.03 * (i * 23 % BALLS) - 1,
                               0.05 * (i * 11 % BALLS) - 1.6);
    }
    at += (size_t)snprintf(text + at, sizeof text - at, "]}]}}");
    assert_true(at < sizeof text);
    return drawing_parse(text);
}

static void parts_of_a_field_are_cut_as_the_whole(void **state)
{
    struct record section = section_of("{'normal':[0.3,0.2,1],'offset':0.05}");
    struct drawing drawings[2];

    (void)state;
    for (int whole = 0; whole < 2; whole++) {
        struct resident *resident = reside(many_balls(whole), 0);
        drawings[whole] = measure(resident, &section, false);
        resident_destroy(resident);
    }
    /* Rays of a part take other steps. */
    memset(&drawings[0].of[AOV_STEPS].bytes, 0, sizeof drawings[0].of[AOV_STEPS].bytes);
    compare(&drawings[0], &drawings[1], "parts");
    drawing_finish(&drawings[0]);
    drawing_finish(&drawings[1]);
    record_finish(&section);
}

/* A picture's own: the next one is whole. */
static void a_section_compiles_nothing(void **state)
{
    struct record section = section_of("{'normal':[1,0,0]}"), other = section_of("{'offset':0.3}");
    const struct record *const cuts[] = {&section, &other, NULL};

    (void)state;
    for (int road = 0; road < ROADS; road++) {
        struct resident *resident = reside(drawing_parse(ball), road);
        struct drawing before = measure(resident, NULL, false), now;
        const uint64_t compilations = renderer_counters(renderer).compilations;

        for (int i = 0; i < 3; i++) {
            now = measure(resident, cuts[i], false);
            assert_int_equal(drawing_is_same(&now.of[AOV_COLOR], &before.of[AOV_COLOR]), !cuts[i]);
            drawing_finish(&now);
        }
        assert_int_equal(renderer_counters(renderer).compilations, compilations);
        drawing_finish(&before);
        resident_destroy(resident);
    }
    record_finish(&section);
    record_finish(&other);
}

static int start(void **state)
{
    (void)state;
    renderer = drawing_renderer(0);
    return 0;
}

static int end(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_is_cut_in_two),
        cmocka_unit_test(what_is_cut_off_throws_no_shadow),
        cmocka_unit_test(all_roads_cut_alike),
        cmocka_unit_test(parts_of_a_field_are_cut_as_the_whole),
        cmocka_unit_test(a_section_compiles_nothing),
    };

    return cmocka_run_group_tests_name("section", tests, start, end);
}
