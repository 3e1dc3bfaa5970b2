/* SPDX-License-Identifier: MIT */
/* Pictures depend on document, camera, size and renderer, and on nothing else: not on tiles, not on
 * what was drawn before, not on later edits. Numbers compile nothing. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "protocol/memory.h"
#include "renderer/code/code.h"
#include "renderer/job_internal.h"
#include "renderer/pick.h"
#include "renderer/renderer_internal.h"
#include "tests/support/drawing.h"
#include "tests/support/json_text.h"

enum { WIDTH = 150, HEIGHT = 110, NUMERIC_EDITS = 1000, TOGGLES = 50 };

static const char document[] =
    "{'format':'fieldcast/1','camera':{'position':[1,1.2,4],'target':[0,0.3,0]},"
    "'lights':[{'id':'sun','type':'directional'},"
    "{'id':'lamp','type':'point','position':[2,2,2],'intensity':5}],"
    "'materials':{'red':{'shader':'phong','properties':{'diffuse':[0.8,0.1,0.1]}}},"
    "'root':{'id':'root','type':'union','children':["
    "{'id':'blend','type':'smooth_union','params':{'k':0.2},'children':["
    "{'id':'ball','type':'sphere','material':'red'},"
    "{'id':'cube','type':'box','transform':{'translation':[0.7,0.2,0]}}]},"
    "{'id':'floor','type':'plane','params':{'offset':-0.5}}]}}";

static struct renderer *renderer;

static struct resident *make_resident(const char *text)
{
    struct error err = {0};
    struct scene *scene = json_text_scene(text, &err);

    if (!scene) {
        fail_msg("%s: %s", err.place, err.message);
    }
    return resident_create(renderer, scene, 1);
}

static struct image draw(struct resident *resident, const struct job_desc *desc)
{
    struct error err = {0};
    struct image image = {0};

    if (!renderer_render(resident, desc, &image, &err)) {
        fail_msg("%s: %s", err.place, err.message);
    }
    return image;
}

static const struct job_desc usual = {
    .width = WIDTH, .height = HEIGHT, .level = QUALITY_STILL, .samples = 2, .exact = true};

static void edit(struct resident *resident, const char *ops)
{
    struct error err = {0};
    cJSON *json = json_text_parse(ops, NULL);

    assert_non_null(json);
    if (!resident_edit(resident, json, resident_revision(resident) + 1, &err)) {
        fail_msg("%s: %s: %s", ops, err.place, err.message);
    }
    cJSON_Delete(json);
}

static void assert_same(const struct image *a, const struct image *b)
{
    assert_int_equal(a->bytes, b->bytes);
    assert_memory_equal(a->pixels, b->pixels, a->bytes);
}

static bool is_same(const struct image *a, const struct image *b)
{
    return a->bytes == b->bytes && memcmp(a->pixels, b->pixels, a->bytes) == 0;
}

/* Bytes of which one is brighter than the other by more than rounding. */
static size_t count_far(const struct image *a, const struct image *b)
{
    const uint8_t *ours = a->pixels, *theirs = b->pixels;
    size_t count = 0;

    assert_int_equal(a->bytes, b->bytes);
    for (size_t i = 0; i < a->bytes; i++) {
        count += abs(ours[i] - theirs[i]) > 2;
    }
    return count;
}

static void use_tiles(int samples)
{
    draw_destroy(renderer->draw);
    renderer->draw = draw_create(&renderer->gl, renderer->info.software, samples);
}

/* Those that are pictures, or those that are arrays. */
static struct job_desc outputs_desc(bool as_floats)
{
    struct job_desc desc = usual;

    desc.as_floats = as_floats;
    for (int aov = 0; aov < AOV_COUNT; aov++) {
        desc.aovs[aov] = aov_row((enum aov)aov)->picture != as_floats;
    }
    return desc;
}

/* Each output by itself, as all are drawn together in these tiles. */
static void assert_tiles_give(const struct drawing *alone, int side)
{
    use_tiles(side);
    for (int as_floats = 0; as_floats < 2; as_floats++) {
        const struct job_desc desc = outputs_desc(as_floats);
        struct resident *resident = make_resident(document);
        struct drawing together = drawing_outputs(renderer, resident, &desc);
        for (int aov = 0; aov < AOV_COUNT; aov++) {
            if (desc.aovs[aov]) {
                assert_same(&together.of[aov], &alone->of[aov]);
            }
        }
        drawing_finish(&together);
        resident_destroy(resident);
    }
}

static void tiles_do_not_show(void **state)
{
    static const int sides[] = {32, 96, 128, 512};
    struct resident *resident = make_resident(document);
    struct drawing alone = {0};

    (void)state;
    for (int aov = 0; aov < AOV_COUNT; aov++) {
        struct job_desc desc = usual;
        desc.as_floats = !aov_row((enum aov)aov)->picture;
        alone.of[aov] = drawing_of(resident, &desc, (enum aov)aov);
        assert_true(alone.of[aov].bytes > 0);
    }
    for (size_t i = 0; i < sizeof sides / sizeof sides[0]; i++) {
        assert_tiles_give(&alone, sides[i]);
    }
    use_tiles(0);
    drawing_finish(&alone);
    resident_destroy(resident);
}

static void edits_and_back(void **state)
{
    struct resident *resident = make_resident(document);
    struct image before = draw(resident, &usual), between, after;

    (void)state;
    edit(resident, "[{'op':'set','at':'/nodes/ball/params/radius','value':0.8},"
                   "{'op':'insert','into':'/nodes/root','before':null,"
                   "'value':{'id':'ring','type':'torus'}}]");
    between = draw(resident, &usual);
    assert_false(is_same(&before, &between));
    edit(resident, "[{'op':'remove','at':'/nodes/ring'},"
                   "{'op':'set','at':'/nodes/ball/params/radius','value':null}]");
    after = draw(resident, &usual);
    assert_same(&before, &after);
    image_finish(&before);
    image_finish(&between);
    image_finish(&after);
    resident_destroy(resident);
}

static void apply(struct resident *resident, const char *ops)
{
    cJSON *json = json_text_parse(ops, NULL);

    assert_true(resident_apply(resident, json, resident_revision(resident) + 1, NULL));
    cJSON_Delete(json);
}

/* After one of more than numbers, edits change nothing that is drawn until all are opened. */
static void edits_wait_for_each_other(void **state)
{
    struct resident *resident = make_resident(document), *other = make_resident(document);
    struct image before = draw(resident, &usual), stale, together, one_by_one;

    (void)state;
    apply(resident, "[{'op':'set','at':'/nodes/cube/params/size','value':[1,1,1]}]");
    assert_false(resident_is_stale(resident));
    apply(resident, "[{'op':'set','at':'/nodes/cube/params/size','value':null}]");
    apply(resident, "[{'op':'set','at':'/nodes/cube/type','value':'cylinder'}]");
    apply(resident, "[{'op':'set','at':'/nodes/ball/params/radius','value':0.8}]");
    assert_true(resident_is_stale(resident));
    assert_int_equal(resident_revision(resident), 5);
    assert_int_equal(resident_shown_revision(resident), 3);
    stale = draw(resident, &usual);
    assert_same(&before, &stale);
    resident_renew(resident);
    assert_false(resident_is_stale(resident));
    together = draw(resident, &usual);

    edit(other, "[{'op':'set','at':'/nodes/cube/type','value':'cylinder'}]");
    edit(other, "[{'op':'set','at':'/nodes/ball/params/radius','value':0.8}]");
    one_by_one = draw(other, &usual);
    assert_same(&together, &one_by_one);
    image_finish(&before);
    image_finish(&stale);
    image_finish(&together);
    image_finish(&one_by_one);
    resident_destroy(resident);
    resident_destroy(other);
}

static void numbers_compile_nothing(void **state)
{
    const struct job_desc small = {.width = 16, .height = 16, .samples = 1, .exact = true};
    struct resident *resident = make_resident(document);
    struct image image = draw(resident, &small);
    const uint64_t compilations = renderer_counters(renderer).compilations;

    (void)state;
    for (int i = 0; i < NUMERIC_EDITS; i++) {
        char ops[256];
        snprintf(ops, sizeof ops,
                 "[{'op':'set','at':'/nodes/ball/params/radius','value':%.4f},"
                 "{'op':'set','at':'/nodes/cube/transform/rotation','value':[0,%.4f,0]},"
                 "{'op':'set','at':'/camera/fov','value':%.4f}]",
                 0.3 + 0.0005 * i, 0.001 * i, 40 + 0.01 * i);
        edit(resident, ops);
        assert_int_equal(resident_shown_revision(resident), resident_revision(resident));
        if (i % 100 == 0) {
            struct image next = draw(resident, &small);
            assert_false(is_same(&image, &next));
            image_finish(&image);
            image = next;
        }
    }
    assert_int_equal(renderer_counters(renderer).compilations, compilations);
    image_finish(&image);
    resident_destroy(resident);
}

/* Shows or hides a node, which is drawn at once. */
static void show(struct resident *resident, const char *id, bool visible)
{
    char ops[128];

    snprintf(ops, sizeof ops, "[{'op':'set','at':'/nodes/%s/visible','value':%s}]", id,
             visible ? "true" : "false");
    edit(resident, ops);
    assert_int_equal(resident_shown_revision(resident), resident_revision(resident));
}

/* The document as somebody else opens it, with a node hidden or gone. */
static struct image draw_edited(const char *ops)
{
    struct resident *resident = make_resident(document);
    struct image image;

    edit(resident, ops);
    image = draw(resident, &usual);
    resident_destroy(resident);
    return image;
}

static void hiding_compiles_nothing(void **state)
{
    static const char *const ids[] = {"ball", "cube", "blend", "floor", "root"};
    struct resident *resident = make_resident(document);
    struct image all = draw(resident, &usual), image;
    const uint64_t compilations = renderer_counters(renderer).compilations;

    (void)state;
    for (int i = 0; i < TOGGLES; i++) {
        const char *id = ids[i % (int)(sizeof ids / sizeof ids[0])];
        show(resident, id, false);
        image = draw(resident, &usual);
        assert_false(is_same(&image, &all));
        image_finish(&image);
        show(resident, id, true);
    }
    image = draw(resident, &usual);
    assert_same(&image, &all);
    image_finish(&image);
    assert_int_equal(renderer_counters(renderer).compilations, compilations);
    image_finish(&all);
    resident_destroy(resident);
}

/* Not a pixel tells a hidden node from none. */
static void hidden_is_gone(void **state)
{
    static const char *const ids[] = {"ball", "cube", "blend", "floor"};

    (void)state;
    for (size_t i = 0; i < sizeof ids / sizeof ids[0]; i++) {
        struct resident *resident = make_resident(document);
        struct image hidden, gone;
        char remove[64];

        snprintf(remove, sizeof remove, "[{'op':'remove','at':'/nodes/%s'}]", ids[i]);
        hidden = draw(resident, &usual);
        image_finish(&hidden);
        show(resident, ids[i], false);
        hidden = draw(resident, &usual);
        gone = draw_edited(remove);
        assert_same(&hidden, &gone);
        image_finish(&hidden);
        image_finish(&gone);
        resident_destroy(resident);
    }
}

static struct job_desc isolating(const char *const *ids, size_t count)
{
    struct job_desc desc = usual;

    desc.isolated = ids;
    desc.isolated_count = count;
    return desc;
}

/* A picture's own: others, and the scene, show nothing of it. */
static void isolation_compiles_nothing(void **state)
{
    static const char *const cube[] = {"cube"};
    static const char *const both[] = {"ball", "cube"};
    const struct job_desc one = isolating(cube, 1), two = isolating(both, 2);
    struct resident *resident = make_resident(document);
    struct image all = draw(resident, &usual), image, alone, pair;
    const uint64_t compilations = renderer_counters(renderer).compilations;

    (void)state;
    alone = draw(resident, &one);
    pair = draw(resident, &two);
    assert_false(is_same(&alone, &all));
    assert_false(is_same(&alone, &pair));
    image = draw(resident, &usual);
    assert_same(&image, &all);
    image_finish(&image);
    assert_int_equal(resident_revision(resident), 1);
    show(resident, "floor", false);
    image = draw(resident, &usual);
    assert_same(&image, &pair);
    image_finish(&image);
    show(resident, "ball", false);
    image = draw(resident, &usual);
    assert_same(&image, &alone);
    assert_int_equal(renderer_counters(renderer).compilations, compilations);
    image_finish(&image);
    image_finish(&all);
    image_finish(&alone);
    image_finish(&pair);
    resident_destroy(resident);
}

/* More isolations than are kept, edits between them, and one that outlives a compilation. */
static void isolation_follows_edits(void **state)
{
    static const char *const ids[] = {"cube",     "nobody-1", "nobody-2", "nobody-3", "nobody-4",
                                      "nobody-5", "nobody-6", "nobody-7", "nobody-8"};
    struct resident *resident = make_resident(document);
    struct job_desc desc = isolating(ids, 1);
    struct image before = draw(resident, &desc), image;

    (void)state;
    for (size_t i = 1; i < sizeof ids / sizeof ids[0]; i++) {
        const struct job_desc other = isolating(ids + i, 1);
        image = draw(resident, &other);
        image_finish(&image);
    }
    edit(resident, "[{'op':'set','at':'/nodes/cube/params/size','value':[2,2,2]}]");
    image = draw(resident, &desc);
    assert_false(is_same(&image, &before));
    image_finish(&before);
    edit(resident, "[{'op':'insert','into':'/nodes/root','before':null,'value':"
                   "{'id':'more','type':'torus'}}]");
    desc.exact = false;
    before = draw(resident, &desc); /* the old program, and the same picture */
    assert_same(&image, &before);
    image_finish(&before);
    desc.exact = true;
    before = draw(resident, &desc);
    assert_same(&image, &before);
    image_finish(&before);
    image_finish(&image);
    resident_destroy(resident);
}

/* What is hidden from the start, or becomes so before it was ever drawn, is not compiled. */
static void what_was_never_drawn(void **state)
{
    static const char broken[] =
        "[{'op':'insert','into':'/nodes/root','before':null,'value':{'id':'bad',"
        "'type':'field','params':{'code':'float sdf(vec3 p) { return p.x / (p.x - p.x); "
        "}'}}}]";
    struct resident *resident = make_resident(document);
    struct image image = draw(resident, &usual);
    const uint64_t compilations = renderer_counters(renderer).compilations;

    (void)state;
    edit(resident, broken);
    show(resident, "bad", false); /* while it is tried out */
    assert_int_equal(resident_error(resident)->kind, ERROR_NONE);
    edit(resident, "[{'op':'set','at':'/nodes/bad/visible','value':true}]");
    while (renderer_is_trying(renderer)) {
        renderer_poll(renderer, 0);
    }
    assert_int_equal(resident_error(resident)->kind, ERROR_COMPILE);
    show(resident, "bad", false);
    assert_int_equal(resident_error(resident)->kind, ERROR_NONE);
    assert_int_equal(renderer_counters(renderer).compilations, compilations);
    image_finish(&image);
    resident_destroy(resident);
}

/* Puts the next rows of every output below those that are there. */
static void take_rows(struct job *job, struct image images[AOV_COUNT])
{
    for (int i = 0; i < AOV_COUNT; i++) {
        struct image rows;

        if (job_image_info(job, (enum aov)i).width == 0) {
            continue;
        }
        rows = job_take_rows(job, (enum aov)i);
        images[i].pixels = memory_resize(images[i].pixels, images[i].bytes + rows.bytes, 1);
        memcpy((uint8_t *)images[i].pixels + images[i].bytes, rows.pixels, rows.bytes);
        images[i].bytes += rows.bytes;
        images[i].height += rows.height;
        image_finish(&rows);
    }
}

static void finish_outputs(struct job *job, struct image images[AOV_COUNT])
{
    enum job_state state;

    while ((state = job_step(job)) != JOB_DONE) {
        if (state == JOB_FAILED) {
            fail_msg("%s", job_error(job)->message);
        }
        if (state == JOB_ROWS) {
            take_rows(job, images);
        }
        renderer_poll(renderer, state == JOB_WAITING ? 100 : 0);
    }
    job_destroy(job);
}

static struct image finish_job(struct job *job)
{
    struct image images[AOV_COUNT] = {0};

    finish_outputs(job, images);
    return images[AOV_COLOR];
}

/* What is drawn together is what is drawn alone, and the shapes told beforehand are right. */
static void outputs_are_drawn_together(void **state)
{
    struct resident *resident = make_resident(document);
    struct image images[AOV_COUNT] = {0};
    struct job_desc desc = usual;
    struct job *job;

    (void)state;
    use_tiles(32);
    desc.as_floats = true;
    memset(desc.aovs, true, sizeof desc.aovs);
    job = job_create(resident, &desc, NULL);
    assert_non_null(job);
    for (int i = 0; i < AOV_COUNT; i++) {
        const struct image shape = job_image_info(job, (enum aov)i);

        assert_int_equal(shape.channels, aov_row((enum aov)i)->channels);
        assert_int_equal(shape.format, aov_row((enum aov)i)->whole ? PIXEL_UINT32 : PIXEL_FLOAT);
        assert_int_equal(shape.bytes, WIDTH * HEIGHT * shape.channels * 4);
    }
    finish_outputs(job, images);
    for (int i = 0; i < AOV_COUNT; i++) {
        struct image alone;

        memset(desc.aovs, false, sizeof desc.aovs);
        desc.aovs[i] = true;
        alone = draw(resident, &desc);
        assert_int_equal(images[i].height, HEIGHT);
        assert_same(&images[i], &alone);
        image_finish(&alone);
        image_finish(&images[i]);
    }
    use_tiles(0);
    resident_destroy(resident);
}

static void pictures_are_not_torn(void **state)
{
    struct resident *resident = make_resident(document);
    struct image before, torn;
    struct job *job;

    (void)state;
    use_tiles(32);
    before = draw(resident, &usual);
    job = job_create(resident, &usual, NULL);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(job_step(job), JOB_RUNNING);
    }
    edit(resident, "[{'op':'set','at':'/nodes/ball/params/radius','value':1.5},"
                   "{'op':'remove','at':'/nodes/cube'}]");
    torn = finish_job(job);
    assert_same(&before, &torn);
    use_tiles(0);
    image_finish(&before);
    image_finish(&torn);
    resident_destroy(resident);
}

/* The engine draws a new structure, which may have users' code, until its program is compiled. */
static void check_while_compiling(const char *insert)
{
    struct job_desc any = usual;
    struct resident *resident = make_resident(document);
    struct image before = draw(resident, &usual), bridged, new;

    any.exact = false;
    edit(resident, insert);
    edit(resident, "[{'op':'set','at':'/nodes/bead/transform/translation','value':[0,0.8,0]}]");
    assert_int_equal(resident_shown_revision(resident), 1);
    struct job *exact = job_create(resident, &usual, NULL);
    struct job *inexact = job_create(resident, &any, NULL);
    assert_int_equal(job_revision(exact), 3);
    assert_int_equal(job_revision(inexact), 3);
    assert_true(job_step_possible(inexact));
    assert_int_not_equal(job_step(inexact), JOB_WAITING);
    bridged = finish_job(inexact);
    new = finish_job(exact);
    assert_true(count_far(&before, &bridged) > WIDTH * HEIGHT / 100);
    assert_true(count_far(&new, &bridged) < WIDTH * HEIGHT / 200);
    assert_int_equal(resident_shown_revision(resident), 3);
    image_finish(&before);
    image_finish(&bridged);
    image_finish(&new);
    resident_destroy(resident);
}

static void the_engine_draws_while_compiling(void **state)
{
    (void)state;
    check_while_compiling("[{'op':'insert','into':'/nodes/blend','before':null,'value':"
                          "{'id':'bead','type':'sphere'}}]");
    check_while_compiling("[{'op':'insert','into':'/nodes/blend','before':null,'value':"
                          "{'id':'bead','type':'field','params':{"
                          "'code':'float sdf(vec3 p) { return length(p) - 1.0; }'}}}]");
}

/* The first tile of the second row takes far too long, while the last one of the first row is still
 * on its way. */
static void rows_that_are_begun_again_leave_those_before(void **state)
{
    enum { FAR_TOO_LONG_US = 5000000 };

    struct resident *resident = make_resident(document);
    struct image before, again;

    (void)state;
    use_tiles(32);
    before = draw(resident, &usual);
    struct job *job = job_create(resident, &usual, NULL);
    while (job->row.y == 0) {
        assert_int_not_equal(job_step(job), JOB_ROWS);
    }
    assert_int_equal(job->row.x, 0);
    assert_true(job->row.pace.doublings > 0);
    job->sample = (struct watch){FAR_TOO_LONG_US, FAR_TOO_LONG_US};
    again = finish_job(job);
    assert_same(&before, &again);
    use_tiles(0);
    image_finish(&before);
    image_finish(&again);
    resident_destroy(resident);
}

static void cancelled_jobs_leave_no_trace(void **state)
{
    struct resident *resident = make_resident(document);
    struct image before = draw(resident, &usual), after;
    struct job *job;

    (void)state;
    use_tiles(32);
    for (int steps = 0; steps < 6; steps++) {
        job = job_create(resident, &usual, NULL);
        for (int i = 0; i < steps; i++) {
            job_step(job);
        }
        job_destroy(job);
    }
    after = draw(resident, &usual);
    assert_same(&before, &after);
    use_tiles(0);
    image_finish(&before);
    image_finish(&after);
    resident_destroy(resident);
}

static void odd_sizes_are_drawn(void **state)
{
    static const int sizes[][2] = {{1, 1}, {1, 300}, {LIMIT_IMAGE_SIDE, 1}, {257, 3}};

    static const struct {
        struct job_desc desc;
        const char *place;
    } bad[] = {
        {{.width = 0, .height = 5}, "width"},
        {{.width = 5, .height = LIMIT_IMAGE_SIDE + 1}, "height"},
        {{.width = 5, .height = 5, .samples = 5}, "samples"},
        {{.width = 5, .height = 5, .region = {3, 0, 3, 2}}, "region"},
        {{.width = 5, .height = 5, .region = {0, -1, 3, 2}}, "region"},
        {{.width = 5, .height = 5, .region = {0, 0, 3, 0}}, "region"},
    };
    struct resident *resident = make_resident(document);

    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const struct job_desc desc = {
            .width = sizes[i][0], .height = sizes[i][1], .samples = 1, .exact = true};
        struct image image = draw(resident, &desc);
        assert_int_equal(image.bytes, (size_t)desc.width * (size_t)desc.height * 4);
        image_finish(&image);
    }
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct error err = {0};
        assert_null(job_create(resident, &bad[i].desc, &err));
        assert_int_equal(err.kind, ERROR_LIMIT);
        assert_string_equal(err.place, bad[i].place);
    }
    resident_destroy(resident);
}

/* Raw depths and ids against the evaluator in C that picking uses. */
static void picking_agrees(void **state)
{
    struct resident *resident = make_resident(document);
    struct job_desc desc = {.width = 64, .height = 48, .exact = true, .as_floats = true};
    struct image depth, id;
    struct pick_field *field = pick_field_create(resident_scene(resident), NULL, 0, NULL);
    int different = 0;

    (void)state;
    desc.aovs[AOV_DEPTH] = true;
    depth = draw(resident, &desc);
    desc.aovs[AOV_DEPTH] = false;
    desc.aovs[AOV_ID] = true;
    id = draw(resident, &desc);
    assert_int_equal(depth.format, PIXEL_FLOAT);
    assert_int_equal(id.format, PIXEL_UINT32);
    for (int i = 0; i < 64 * 48; i += 7) {
        const struct pick_question question = {
            .width = 64, .height = 48, .x = i % 64 + 0.5, .y = i / 64 + 0.5};
        const struct pick_result pick = pick_at(field, &question);
        const float d = ((float *)depth.pixels)[i];
        const uint32_t number = ((uint32_t *)id.pixels)[i];
        const char *node = number ? field_leaf_id(resident->drawable->geometry.field, number) : "";
        different += pick.hit != (number > 0) || strcmp(node, pick.node) != 0 ||
                     (pick.hit ? fabs(d - pick.distance) > 0.03 * d : d != INFINITY);
    }
    /* At silhouettes a hair's breadth decides. */
    assert_in_range(different, 0, 8);
    image_finish(&depth);
    image_finish(&id);
    pick_field_unref(field);
    resident_destroy(resident);
}

static void programs_are_cached(void **state)
{
    struct resident *first = make_resident(document), *second;
    struct image a = draw(first, &usual), b;
    const struct renderer_counters before = renderer_counters(renderer);

    (void)state;
    second = make_resident(document);
    assert_int_equal(resident_shown_revision(second), 1);
    b = draw(second, &usual);
    assert_int_equal(renderer_counters(renderer).compilations, before.compilations);
    assert_int_equal(renderer_counters(renderer).cache_hits, before.cache_hits + 1);
    assert_same(&a, &b);
    image_finish(&a);
    image_finish(&b);
    resident_destroy(first);
    resident_destroy(second);
}

/* Else the side of a slow picture's only tile is halved in vain, again and again. */
static void tiles_are_no_larger_than_the_picture(void **state)
{
    const struct job_desc desc = {.width = 12, .height = 8, .samples = 1, .exact = true};
    struct resident *resident = make_resident(document);
    struct job *job = job_create(resident, &desc, NULL);

    (void)state;
    while (job_step(job) == JOB_WAITING) {
        renderer_poll(renderer, 100);
    }
    assert_in_range(job->row.side, 12, 16);
    assert_int_equal(job->row.pace.doublings, 1);
    job_destroy(job);
    resident_destroy(resident);
}

/* Loops within loops, more steps than llvmpipe's budget: the picture is drawn with fewer steps, and
 * the log says so. */
static void loop_budget(void **state)
{
    static const char text[] = "{'format':'fieldcast/1','render':{'max_steps':1024},"
                               "'root':{'id':'root','type':'repeat','params':{'spacing':[1,1,1],"
                               "'count':[3,3,3]},'children':[{'id':'inner','type':'repeat',"
                               "'params':{'spacing':[0.3,0.3,0.3],'count':[3,3,3]},'children':["
                               "{'id':'ball','type':'sphere','params':{'radius':0.2}}]}]}}";
    struct resident *resident = make_resident(text);
    const struct snapshot *newest = resident->newest;
    struct render_settings settings;

    (void)state;
    assert_non_null(newest);
    struct frame_uniforms block = newest->frame;
    render_settings_make(&settings, &block, &newest->render,
                         &(struct settings_request){.level = -1}, &newest->extent);
    assert_int_equal(newest->fewer_steps, renderer->info.software);
    if (renderer->info.software) {
        const long each = 1 + (long)newest->geometry.field->loop_trips;
        assert_in_range((long)block.max_steps * each, 65535 / 2, 65535);
    } else {
        assert_int_equal(block.max_steps, 1024);
    }
    resident_destroy(resident);
}

/* One insert of so many spheres; caller frees. */
static char *spheres_text(int count)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    fprintf(out, "[{'op':'insert','into':'/nodes/root','before':null,'value':"
                 "{'id':'many','type':'union','transform':{'translation':[0,1,0]},"
                 "'children':[");
    for (int i = 0; i < count; i++) {
        fprintf(out, "%s{'type':'sphere'}", i ? "," : "");
    }
    fprintf(out, "]}}]");
    assert_int_equal(fclose(out), 0);
    return text;
}

/* The document has three shapes. More than a compiler takes are drawn without one. */
static void shapes_beyond_compilers(void **state)
{
    struct resident *resident = make_resident(document);
    struct image before = draw(resident, &usual), many, again;
    char *text = spheres_text(LIMIT_COMPILED_SHAPES - 2);
    const uint64_t compilations = renderer_counters(renderer).compilations;

    (void)state;
    edit(resident, text);
    assert_int_equal(resident_error(resident)->kind, ERROR_NONE);
    many = draw(resident, &usual);
    assert_int_equal(renderer_counters(renderer).compilations, compilations);
    assert_false(is_same(&before, &many));
    edit(resident, "[{'op':'remove','at':'/nodes/many'}]");
    assert_int_equal(resident_error(resident)->kind, ERROR_NONE);
    again = draw(resident, &usual);
    assert_same(&before, &again);
    image_finish(&before);
    image_finish(&many);
    image_finish(&again);
    free(text);
    resident_destroy(resident);
}

/* Balls whose distance is this code. */
static struct scene *shapes_with_code(const char *code, int count)
{
    char *text = NULL;
    size_t length;
    struct error err = {0};
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    fprintf(out,
            "{'format':'fieldcast/1','primitives':{'p':{'code':'%s'}},"
            "'root':{'type':'union','children':[",
            code);
    for (int i = 0; i < count; i++) {
        fprintf(out, "%s{'type':'field','params':{'primitive':'p'}}", i ? "," : "");
    }
    fprintf(out, "]}}");
    assert_int_equal(fclose(out), 0);
    struct scene *scene = json_text_scene(text, &err);
    assert_non_null(scene);
    free(text);
    return scene;
}

/* Compilers write it out for each shape. */
static void code_beyond_compilers(void **state)
{
    static const struct param nothing[] = {{.name = NULL}};
    const char *code = "float sdf(vec3 p) { return length(p) - 0.5 + 0.01 * sin(cos(p.x)); }";
    struct code *alone =
        code_compile(&(struct code_source){CODE_DISTANCE, code, nothing, false}, NULL);
    const int most = LIMIT_COMPILED_CODE / code_size(alone);

    for (int more = 0; more < 2; more++) {
        struct scene *scene = shapes_with_code(code, most + more);
        struct field *field = field_compile(scene, NULL);
        assert_int_equal(field_can_be_compiled(field), more == 0);
        field_unref(field);
        scene_destroy(scene);
    }

    (void)state;
    assert_true(most > 20);
    code_destroy(alone);
}

/* The engine's pictures start no thread that compiles; a program that is asked for later does. */
static void compilers_wait_for_programs(void **state)
{
    static const struct job_desc small = {.width = 16, .height = 12, .samples = 1};
    static const char ball[] = "{'format':'fieldcast/1','root':{'type':'sphere'}}";
    struct resident *by_engine = make_resident(ball), *by_program;
    struct image a = draw(by_engine, &small), b;

    (void)state;
    assert_int_equal(program_cache_cpu_us(renderer->programs), 0);
    renderer_use_stage(renderer, RENDER_COMPUTE);
    by_program = make_resident(ball);
    b = draw(by_program, &small);
    assert_true(program_cache_cpu_us(renderer->programs) > 0);
    renderer_use_stage(renderer, RENDER_ENGINE);
    image_finish(&a);
    image_finish(&b);
    resident_destroy(by_engine);
    resident_destroy(by_program);
}

static void gpu_asked_for(void **state)
{
    struct renderer_params params = {.device = {DEVICE_GPU, .index = -1}};
    struct device_report rows[8];
    struct error err = {0};
    struct renderer *gpu = renderer_create(&params, &err);
    const size_t count = renderer_devices(&params.device, rows, 8);

    (void)state;
    if (gpu) {
        assert_false(renderer_info(gpu)->software);
        renderer_destroy(gpu);
    } else {
        assert_int_equal(err.kind, ERROR_UNAVAILABLE);
        assert_non_null(strstr(err.message, "a GPU was asked for"));
        for (size_t i = 0; i < count; i++) {
            assert_false(rows[i].chosen);
        }
    }
    egl_bind(&renderer->egl, renderer->egl.draw, NULL);
}

static int set_up(void **state, enum render_stage stage)
{
    const struct renderer_params params = {.device = {.index = -1}, .stage = stage};
    struct error err = {0};

    (void)state;
    renderer = renderer_create(&params, &err);
    if (!renderer) {
        print_message("%s\n", err.message);
        return -1;
    }
    return 0;
}

static int set_up_device(void **state)
{
    return set_up(state, RENDER_COMPUTE);
}

static int set_up_fragment(void **state)
{
    return set_up(state, RENDER_FRAGMENT);
}

static int set_up_engine(void **state)
{
    return set_up(state, RENDER_ENGINE);
}

static int tear_down(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

int main(void)
{
    const struct CMUnitTest common[] = {
        cmocka_unit_test(tiles_do_not_show),
        cmocka_unit_test(edits_and_back),
        cmocka_unit_test(edits_wait_for_each_other),
        cmocka_unit_test(numbers_compile_nothing),
        cmocka_unit_test(hiding_compiles_nothing),
        cmocka_unit_test(hidden_is_gone),
        cmocka_unit_test(isolation_compiles_nothing),
        cmocka_unit_test(isolation_follows_edits),
        cmocka_unit_test(what_was_never_drawn),
        cmocka_unit_test(outputs_are_drawn_together),
        cmocka_unit_test(pictures_are_not_torn),
        cmocka_unit_test(rows_that_are_begun_again_leave_those_before),
        cmocka_unit_test(cancelled_jobs_leave_no_trace),
        cmocka_unit_test(odd_sizes_are_drawn),
        cmocka_unit_test(tiles_are_no_larger_than_the_picture),
        cmocka_unit_test(picking_agrees),
        cmocka_unit_test(shapes_beyond_compilers),
        cmocka_unit_test(code_beyond_compilers),
        cmocka_unit_test(gpu_asked_for),
    };

    /* What only programs do. */
    const struct CMUnitTest programs[] = {
        cmocka_unit_test(the_engine_draws_while_compiling),
        cmocka_unit_test(programs_are_cached),
        cmocka_unit_test(loop_budget),
    };
    /* With a program for a whole sample, which is compiled for long: what depends on targets. */
    const struct CMUnitTest samples[] = {
        cmocka_unit_test(tiles_do_not_show),
        cmocka_unit_test(numbers_compile_nothing),
        cmocka_unit_test(outputs_are_drawn_together),
        cmocka_unit_test(pictures_are_not_torn),
    };
    const struct CMUnitTest engine[] = {cmocka_unit_test(compilers_wait_for_programs)};

    return cmocka_run_group_tests_name("device", common, set_up_device, tear_down) +
           cmocka_run_group_tests_name("programs", programs, set_up_device, tear_down) +
           cmocka_run_group_tests_name("fragment", samples, set_up_fragment, tear_down) +
           cmocka_run_group_tests_name("engine", common, set_up_engine, tear_down) +
           cmocka_run_group_tests_name("engine alone", engine, set_up_engine, tear_down);
}
