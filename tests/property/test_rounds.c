/* SPDX-License-Identifier: MIT */
/* Pictures in rounds of ever more samples: each round is a whole picture and nearer to the last,
 * which is the picture that comes without rounds, byte by byte. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/draw/draw.h"
#include "tests/support/drawing.h"

enum { WIDTH = 72, HEIGHT = 41, ROUNDS_MAX = 4 };

struct rounds {
    struct image of[ROUNDS_MAX];
    int count;
};

/* Moves the rows that are there behind those of the round. */
static void add_rows(struct job *job, struct image *image)
{
    struct image rows = job_take_rows(job, AOV_COLOR);

    image->pixels = realloc(image->pixels, image->bytes + rows.bytes);
    memcpy((uint8_t *)image->pixels + image->bytes, rows.pixels, rows.bytes);
    image->bytes += rows.bytes;
    image_finish(&rows);
}

static struct rounds rounds_of(struct renderer *renderer, struct resident *resident,
                               const struct job_desc *desc)
{
    struct job *job = job_create(resident, desc, NULL);
    struct rounds rounds = {.count = 1};

    assert_non_null(job);
    for (enum job_state state; (state = job_step(job)) != JOB_DONE;) {
        assert_int_not_equal(state, JOB_FAILED);
        renderer_poll(renderer, state == JOB_WAITING ? 100 : 0);
        if (state == JOB_ROWS) {
            add_rows(job, &rounds.of[rounds.count - 1]);
        }
        if (state == JOB_ROUND) {
            assert_in_range(++rounds.count, 1, ROUNDS_MAX);
        }
    }
    job_destroy(job);
    return rounds;
}

static double difference(const struct image *a, const struct image *b)
{
    const uint8_t *x = a->pixels, *y = b->pixels;
    double sum = 0;

    assert_int_equal(a->bytes, b->bytes);
    for (size_t i = 0; i < a->bytes; i++) {
        sum += (double)(x[i] - y[i]) * (x[i] - y[i]);
    }
    return sum / (double)a->bytes;
}

static void check_by(enum render_stage stage, const char *path, int tile_side,
                     enum quality_level level, int samples, int count)
{
    struct renderer *renderer = drawing_renderer(tile_side);

    renderer_use_stage(renderer, stage);
    struct resident *resident = drawing_resident(renderer, path);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);

    desc.level = level;
    desc.samples = samples;
    struct image plain = drawing_of(resident, &desc, AOV_COLOR);
    desc.in_rounds = true;
    struct rounds rounds = rounds_of(renderer, resident, &desc);
    struct image *last = &rounds.of[rounds.count - 1];
    assert_int_equal(rounds.count, count);
    if (!drawing_is_same(last, &plain)) {
        fail_msg("%s in tiles of %d: another picture in rounds", path, tile_side);
    }
    double before = 1e9;
    for (int i = 0; i < rounds.count - 1; i++) {
        const double off = difference(&rounds.of[i], last);
        assert_true(off > 0 && off < before);
        before = off;
    }
    for (int i = 0; i < rounds.count; i++) {
        image_finish(&rounds.of[i]);
    }
    image_finish(&plain);
    resident_destroy(resident);
    renderer_destroy(renderer);
}

static void check(const char *path, int tile_side, enum quality_level level, int samples, int count)
{
    check_by(RENDER_AUTO, path, tile_side, level, samples, count);
}

static void edges_get_better(void **state)
{
    (void)state;
    check_by(RENDER_COMPUTE, DRAWING_RICH, 32, QUALITY_STILL, 3, 2);
    check(DRAWING_RICH, 32, QUALITY_STILL, 4, 2);
    check(DRAWING_RICH, 256, QUALITY_STILL, 4, 2);
}

static void all_pixels_get_better(void **state)
{
    (void)state;
    check("tests/golden/antialiasing/full/scene.json", 64, QUALITY_STILL, 3, 2);
    check("tests/golden/camera/lens/scene.json", 256, QUALITY_STILL, 0, 2);
    check("tests/golden/camera/lens/scene.json", 256, QUALITY_FINAL, 0, 3);
}

static void few_samples_are_one_round(void **state)
{
    (void)state;
    check(DRAWING_RICH, 256, QUALITY_STILL, 2, 1);
    check(DRAWING_RICH, 256, QUALITY_INTERACTIVE, 0, 1);
}

/* The textures that all jobs share are drawn into by another one meanwhile. */
static void other_pictures_may_come_between(void **state)
{
    struct renderer *renderer = drawing_renderer(0);
    struct resident *resident = drawing_resident(renderer, DRAWING_RICH);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    struct rounds rounds = {.count = 1};

    (void)state;
    desc.samples = 4;
    struct image plain = drawing_of(resident, &desc, AOV_COLOR);
    desc.in_rounds = true;
    struct job *job = job_create(resident, &desc, NULL);
    for (enum job_state now; (now = job_step(job)) != JOB_DONE;) {
        if (now == JOB_ROWS) {
            add_rows(job, &rounds.of[rounds.count - 1]);
        }
        if (now == JOB_ROUND) {
            struct job_desc other = drawing_desc(WIDTH / 2, HEIGHT);
            struct image between = drawing_of(resident, &other, AOV_COLOR);
            image_finish(&between);
            rounds.count++;
        }
    }
    assert_int_equal(rounds.count, 2);
    assert_true(drawing_is_same(&rounds.of[1], &plain));
    job_destroy(job);
    image_finish(&rounds.of[0]);
    image_finish(&rounds.of[1]);
    image_finish(&plain);
    resident_destroy(resident);
    renderer_destroy(renderer);
}

static struct job *begin_large(struct renderer *renderer, struct resident *resident,
                               int *out_rounds)
{
    struct job_desc desc = drawing_desc(2048, DRAW_ROUNDS_PIXELS / 2048);

    desc.samples = 4;
    desc.in_rounds = true;
    struct job *job = job_create(resident, &desc, NULL);
    while (job_step(job) == JOB_WAITING || job_is_within_tile(job)) {
        renderer_poll(renderer, 0);
    }
    *out_rounds = job_rounds(job).count;
    return job;
}

/* Each keeps memory until it is done. */
static void few_large_pictures_have_rounds_at_once(void **state)
{
    enum { MOST = DRAW_ROUNDS_TOGETHER / DRAW_ROUNDS_PIXELS };
    struct renderer *renderer = drawing_renderer(32);
    struct job *jobs[MOST + 1];
    int rounds;

    (void)state;
    for (int k = 0; k < 2; k++) {
        renderer_use_stage(renderer, k == 0 ? RENDER_FRAGMENT : RENDER_ENGINE);
        struct resident *resident =
            drawing_resident(renderer, "tests/golden/nodes/sphere/scene.json");
        for (int i = 0; i <= MOST; i++) {
            jobs[i] = begin_large(renderer, resident, &rounds);
            assert_int_equal(rounds, i < MOST ? 2 : 1);
        }
        job_destroy(jobs[0]);
        jobs[0] = begin_large(renderer, resident, &rounds);
        assert_int_equal(rounds, 2);
        for (int i = 0; i <= MOST; i++) {
            job_destroy(jobs[i]);
        }
        resident_destroy(resident);
    }
    renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_get_better),
        cmocka_unit_test(all_pixels_get_better),
        cmocka_unit_test(few_samples_are_one_round),
        cmocka_unit_test(other_pictures_may_come_between),
        cmocka_unit_test(few_large_pictures_have_rounds_at_once),
    };

    return cmocka_run_group_tests_name("rounds", tests, NULL, NULL);
}
