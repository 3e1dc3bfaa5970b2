/* SPDX-License-Identifier: MIT */
/* The engine and the device draw the same picture of small examples; and the engine's pictures are
 * the same bytes for every width of vectors. */
#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/engine/engine.h"
#include "server/cli/local_render.h"
#include "server/embedded.h"
#include "tests/support/drawing.h"
#include "tests/support/json_text.h"
#include "tests/support/progress.h"

enum {
    WIDTH = 64,
    HEIGHT = 36,
    STEPS = 2,      /* of 255, by which a pixel may differ; */
    PER_MILLE = 10, /* more of them are edges, where one ray meets another surface */
    FRACTAL_PER_MILLE = 60,
    SCENE_BYTES = 10000,
    SMALL = 53,         /* examples, of */
    SMALL_BYTES = 6000, /* of a document; drivers compile larger ones for long */
};

/* How the engine goes about it. */
struct way {
    int lanes, threads, tile_side; /* 0: as usual */
    bool pauses;                   /* as soon as it may */
};

static const struct way usual = {0};
static atomic_int pauses; /* that were wanted */

static bool is_wanted(void *data)
{
    (void)data;
    pauses++;
    return true;
}

static struct renderer *open_renderer(enum render_stage stage, struct way way)
{
    struct error err = {0};
    const struct renderer_params params = {
        .device = {.index = -1, .cache_dir = getenv("FIELDCAST_CACHE")},
        .stage = stage,
        .lanes = way.lanes,
        .threads = way.threads,
        .tile_side = way.tile_side,
        .is_wanted = way.pauses ? is_wanted : NULL};
    struct renderer *renderer = renderer_create(&params, &err);

    if (!renderer) {
        fail_msg("%s", err.message);
    }
    return renderer;
}

static struct resident *open_resident(struct renderer *renderer, const struct embedded *example)
{
    struct error err = {0};
    struct scene *scene = scene_parse((const char *)example->bytes, example->length, &err);

    assert_non_null(scene);
    local_render_give_example_file(renderer, scene);
    return resident_create(renderer, scene, 1);
}

static struct image draw_part(struct renderer *renderer, const struct embedded *example,
                              int samples, int part)
{
    struct error err = {0};
    struct image image;
    struct resident *resident = open_resident(renderer, example);
    struct job_desc desc = drawing_desc(WIDTH / part, HEIGHT / part);

    desc.samples = samples;
    assert_true(renderer_render(resident, &desc, &image, &err));
    resident_destroy(resident);
    return image;
}

static struct image draw(struct renderer *renderer, const struct embedded *example, int samples)
{
    return draw_part(renderer, example, samples, 1);
}

/* Pixels that differ. */
static int difference(const struct image *a, const struct image *b)
{
    const uint8_t *p = a->pixels, *q = b->pixels;
    int count = 0;

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        int most = 0;
        for (int c = 0; c < 4; c++) {
            const int apart = abs(p[4 * i + c] - q[4 * i + c]);
            most = apart > most ? apart : most;
        }
        count += most > STEPS;
    }
    return count;
}

static int bound_of(const struct embedded *example)
{
    const bool fractal = strcmp(example->path, "fractals") == 0;

    return WIDTH * HEIGHT * (fractal ? FRACTAL_PER_MILLE : PER_MILLE) / 1000;
}

/* Others are held against pictures that the device drew: golden/test_reference_pictures. */
static bool is_small(const struct embedded *example)
{
    return example->length <= SMALL_BYTES && !strstr((const char *)example->bytes, "\"volumes\"");
}

static void small_examples_are_the_same_by_both(void **state)
{
    struct image *device = calloc(examples_count, sizeof *device);
    size_t small = 0;
    struct renderer *renderer = open_renderer(RENDER_COMPUTE, usual);

    (void)state;
    assert_non_null(device);
    for (size_t i = 0; i < examples_count; i++) {
        if (is_small(&examples_table[i])) {
            progress("%s by the device", examples_table[i].path);
            device[i] = draw(renderer, &examples_table[i], 1);
            small++;
        }
    }
    assert_int_equal(small, SMALL);
    renderer_destroy(renderer);
    renderer = open_renderer(RENDER_ENGINE, usual);
    for (size_t i = 0; i < examples_count; i++) {
        if (!device[i].pixels) {
            continue;
        }
        struct image image = draw(renderer, &examples_table[i], 1);
        const int count = difference(&image, &device[i]);

        progress("%s by the engine: %d pixels differ", examples_table[i].path, count);
        if (count > bound_of(&examples_table[i])) {
            fail_msg("%s: %d pixels differ", examples_table[i].path, count);
        }
        image_finish(&image);
        image_finish(&device[i]);
    }
    renderer_destroy(renderer);
    free(device);
}

/* So many that far from them the engine looks at a part of the field alone. */
static struct embedded many_shapes(char *text, size_t room)
{
    enum { SHAPES = 64 };
    size_t at = (size_t)snprintf(text, room, "%s",
                                 "{'format':'fieldcast/1','root':"
                                 "{'type':'union','children':[");
    for (unsigned i = 0; i < SHAPES; i++) {
        const unsigned place[] = {i * 37 % 64, i * 23 % 64, i * 11 % 64};
        at += (size_t)snprintf(text + at, room - at,
                               "%s{'type':'%s','transform':{'translation':"
                               "[%g,%g,%g],'scale':[0.2,0.2,0.2]}}",
                               i > 0 ? "," : "", i % 2 ? "sphere" : "box", 0.05 * place[0] - 1.6,
                               0.03 * place[1] - 1, 0.05 * place[2] - 1.6);
    }
    at += (size_t)snprintf(text + at, room - at, "]}}");
    assert_true(at < room);
    json_text_quote(text);
    return (struct embedded){.path = "many", .bytes = (const unsigned char *)text, .length = at};
}

static void many_shapes_are_the_same_by_both(void **state)
{
    static char text[SCENE_BYTES];
    const struct embedded many = many_shapes(text, sizeof text);
    struct image images[2];

    (void)state;
    for (int i = 0; i < 2; i++) {
        struct renderer *renderer = open_renderer(i == 0 ? RENDER_COMPUTE : RENDER_ENGINE, usual);
        images[i] = draw(renderer, &many, 1);
        renderer_destroy(renderer);
    }
    assert_in_range(difference(&images[0], &images[1]), 0, bound_of(&many));
    image_finish(&images[0]);
    image_finish(&images[1]);
}

static const struct embedded *example(const char *name)
{
    const struct embedded *found = examples_find(name);

    assert_non_null(found);
    return found;
}

/* So that the comparison is one: pictures of two scenes differ, and of the same scene with another
 * number of samples at its edges. */
static void other_pictures_are_noticed(void **state)
{
    struct renderer *renderer = open_renderer(RENDER_ENGINE, usual);
    struct image a = draw(renderer, example("csg"), 1), b = draw(renderer, example("blend"), 1);
    struct image more = draw(renderer, example("csg"), 2);

    (void)state;
    assert_true(difference(&a, &b) > WIDTH * HEIGHT / 10);
    assert_true(difference(&a, &more) > WIDTH * HEIGHT * PER_MILLE / 1000);
    image_finish(&a);
    image_finish(&b);
    image_finish(&more);
    renderer_destroy(renderer);
}

/* Equations among balls, near and far; in a twist by nothing no operand is left out. */
static struct embedded equations_among_balls(bool whole, char *text, size_t room)
{
    enum { BALLS = 24 };
    static const char implicit[] =
        "{'type':'implicit','params':{'equation':'x^2+y^2-3*z^2<0.1','clip':'ball','radius':1.1}},"
        "{'type':'implicit','params':{'equation':'x^3-y*z=0','mode':'sheet','size':[1,1,1]},"
        "'transform':{'translation':[1.7,0.4,-1]}}";
    size_t at = (size_t)snprintf(text, room,
                                 "{'format':'fieldcast/1','root':{'type':'%s','params':{%s},"
                                 "'children':[{'type':'union','children':[%s",
                                 whole ? "twist" : "union", whole ? "'rate':0" : "", implicit);
    for (unsigned i = 0; i < BALLS; i++) {
        at += (size_t)snprintf(text + at, room - at,
                               ",{'type':'sphere','transform':{'translation':"
                               "[%g,%g,%g],'scale':[0.3,0.3,0.3]}}",
                               0.15 * (i * 7 % BALLS) - 1.8, 0.1 * (i * 5 % BALLS) - 1.2,
                               0.15 * (i * 11 % BALLS) - 1.8);
    }
    at += (size_t)snprintf(text + at, room - at, "]}]}}");
    assert_true(at < room);
    json_text_quote(text);
    return (struct embedded){.path = "balls", .bytes = (const unsigned char *)text, .length = at};
}

static void what_is_left_out_beside_equations_is_not_missed(void **state)
{
    static char text[SCENE_BYTES];
    struct renderer *renderer = open_renderer(RENDER_ENGINE, usual);
    struct image images[2];

    (void)state;
    for (int whole = 0; whole < 2; whole++) {
        const struct embedded scene = equations_among_balls(whole, text, sizeof text);
        images[whole] = draw(renderer, &scene, 1);
    }
    assert_in_range(difference(&images[0], &images[1]), 0, WIDTH * HEIGHT * PER_MILLE / 1000);
    image_finish(&images[0]);
    image_finish(&images[1]);
    renderer_destroy(renderer);
}

/* Every width, numbers of threads, sides of tiles, without and with pauses. */
static size_t list_ways(struct way *out)
{
    static const struct way others[] = {{.threads = 1},
                                        {.threads = 2},
                                        {.threads = 5},
                                        {.threads = 5, .tile_side = 16},
                                        {.threads = 2, .tile_side = 24},
                                        {.threads = 2, .pauses = true}};
    size_t count = 0;

    for (size_t i = 0; engine_lanes(i) > 0; i++) {
        out[count++] = (struct way){.lanes = engine_lanes(i)};
    }
    assert_true(count > 0);
    memcpy(out + count, others, sizeof others);
    return count + sizeof others / sizeof others[0];
}

/* Small, because the narrowest is checked by the sanitizers. */
static void all_ways_give_the_same_bytes(void **state)
{
    static char text[SCENE_BYTES];
    const struct embedded many = many_shapes(text, sizeof text);
    const struct embedded *const scenes[] = {example("csg"),
                                             example("snowman"),
                                             example("mirrors"),
                                             example("twist"),
                                             example("repeat-polar"),
                                             example("coloured-glass"),
                                             &many};

    enum { SCENES = sizeof scenes / sizeof scenes[0], SMALLER = 2, WAYS_MAX = 16 };
    enum { PAUSES = 12 }; /* of a picture, at least, which has four parts: also within these */
    struct image first[SCENES];
    struct way ways[WAYS_MAX];
    const size_t count = list_ways(ways);

    (void)state;
    for (size_t k = 0; k < count; k++) {
        struct renderer *renderer = open_renderer(RENDER_ENGINE, ways[k]);
        for (size_t i = 0; i < SCENES; i++) {
            struct image image = draw_part(renderer, scenes[i], 2, SMALLER);
            if (k == 0) {
                first[i] = image;
                continue;
            }
            assert_int_equal(image.bytes, first[i].bytes);
            assert_memory_equal(image.pixels, first[i].pixels, image.bytes);
            image_finish(&image);
        }
        assert_in_range(pauses, ways[k].pauses ? SCENES * PAUSES : 0, ways[k].pauses ? INT_MAX : 0);
        pauses = 0;
        renderer_destroy(renderer);
    }
    for (size_t i = 0; i < SCENES; i++) {
        image_finish(&first[i]);
    }
}

/* From the side, or from where the document's camera is. */
static struct image draw_view(struct resident *resident, bool from_side)
{
    struct error err = {0};
    struct image image;
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    struct record camera;
    cJSON *json = json_text_parse("{'position':[4,2,3],'target':[0,0.5,0]}", NULL);

    record_init(&camera, &camera_type);
    assert_true(record_read(&camera, json, "camera", &err));
    desc.camera = from_side ? &camera : NULL;
    assert_true(renderer_render(resident, &desc, &image, &err));
    record_finish(&camera);
    cJSON_Delete(json);
    return image;
}

/* Cubes that other views left, with other footprints, and that were used often. */
static void earlier_views_do_not_show(void **state)
{
    static const char *const names[] = {"csg", "snowman", "coloured-glass", "snail"};

    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        struct renderer *renderer = open_renderer(RENDER_ENGINE, usual);
        struct resident *resident = open_resident(renderer, example(names[i]));
        struct image first = draw_view(resident, false);
        for (int k = 0; k < 3; k++) {
            struct image aside = draw_view(resident, true), again = draw_view(resident, false);
            assert_true(difference(&aside, &first) > WIDTH * HEIGHT / 10);
            assert_memory_equal(again.pixels, first.pixels, first.bytes);
            image_finish(&aside);
            image_finish(&again);
        }
        image_finish(&first);
        resident_destroy(resident);
        renderer_destroy(renderer);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_examples_are_the_same_by_both),
        cmocka_unit_test(many_shapes_are_the_same_by_both),
        cmocka_unit_test(other_pictures_are_noticed),
        cmocka_unit_test(what_is_left_out_beside_equations_is_not_missed),
        cmocka_unit_test(all_ways_give_the_same_bytes),
        cmocka_unit_test(earlier_views_do_not_show),
    };

    return cmocka_run_group_tests_name("engine", tests, NULL, NULL);
}
