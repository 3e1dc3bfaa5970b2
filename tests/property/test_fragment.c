/* SPDX-License-Identifier: MIT */
/* Fragment shaders draw what the engine draws, of a scene that has everything: each output, as a
 * picture and as numbers; rounds and rays; and users' code. A context of OpenGL 3.3, in a process
 * of its own, draws the same bytes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "tests/support/drawing.h"

enum {
    WIDTH = 64,
    HEIGHT = 36,
    STEPS = 1,     /* of 255, by which a pixel may differ; */
    PER_MILLE = 5, /* more of them are edges, where one ray meets another surface */
};
static const double PART = 0.002; /* the same of a number */

/* Of a distance and of a colour, beside repetition. */
#define CODE                                                                                       \
    "{'format':'fieldcast/1','camera':{'position':[0,1,4],'target':[0,0,0]},"                      \
    "'shaders':{'rings':{'code':'vec3 shade(FragmentProperties f) {"                               \
    " return vec3(step(0.0, sin(20.0 * f.object_position.y)), 0.4, 0.2); }'}},"                    \
    "'materials':{'own':{'shader':'rings'}},'root':{'type':'union','children':["                   \
    "{'type':'field','material':'own','params':{"                                                  \
    "'code':'float sdf(vec3 p) { return max(length(p) - 0.8, p.y - 0.4); }'}},"                    \
    "{'type':'repeat','params':{'spacing':[1,1,1],'count':[3,0,2]},"                               \
    "'transform':{'translation':[0,-1.2,0]},'children':[{'type':'box'}]}]}}"

static struct renderer *renderer;

static struct drawing draw(struct scene *scene, enum render_stage stage, bool as_floats,
                           uint64_t *out_rays)
{
    const uint64_t before = renderer_counters(renderer).rays;
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);

    renderer_use_stage(renderer, stage);
    struct resident *resident = resident_create(renderer, scene, 1);
    desc.as_floats = as_floats;
    for (int i = 0; i < AOV_COUNT; i++) {
        desc.aovs[i] = aov_row((enum aov)i)->picture || as_floats;
    }
    struct drawing drawing = drawing_outputs(renderer, resident, &desc);
    *out_rays = renderer_counters(renderer).rays - before;
    resident_destroy(resident);
    return drawing;
}

static bool is_far(double a, double b)
{
    return a != b && !(fabs(a - b) <= PART * fmax(1, fmax(fabs(a), fabs(b))));
}

/* Of so many bytes or numbers. */
static size_t count_different(const struct image *a, const struct image *b, bool as_floats,
                              bool is_id, size_t *out_count)
{
    const uint8_t *bytes[] = {a->pixels, b->pixels};
    const float *floats[] = {a->pixels, b->pixels};
    const uint32_t *words[] = {a->pixels, b->pixels};
    size_t different = 0;

    assert_int_equal(a->bytes, b->bytes);
    *out_count = as_floats ? a->bytes / sizeof(float) : a->bytes;
    for (size_t i = 0; i < *out_count; i++) {
        different += is_id && as_floats ? words[0][i] != words[1][i]
                     : as_floats        ? is_far(floats[0][i], floats[1][i])
                                        : abs(bytes[0][i] - bytes[1][i]) > STEPS;
    }
    return different;
}

static void compare(const struct drawing *a, const struct drawing *b, bool as_floats)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        size_t count;
        if (a->of[i].bytes == 0) {
            continue;
        }
        const size_t different =
            count_different(&a->of[i], &b->of[i], as_floats, i == AOV_ID, &count);
        if (different > count * PER_MILLE / 1000) {
            fail_msg("%s%s: %zu of %zu differ", aov_name((enum aov)i), as_floats ? " raw" : "",
                     different, count);
        }
    }
}

static void outputs_are_the_engine_s(void **state)
{
    (void)state;
    for (int as_floats = 0; as_floats < 2; as_floats++) {
        uint64_t rays[2];
        struct drawing engine =
            draw(drawing_read(DRAWING_RICH), RENDER_ENGINE, as_floats, &rays[0]);
        struct drawing own = draw(drawing_read(DRAWING_RICH), RENDER_FRAGMENT, as_floats, &rays[1]);

        compare(&own, &engine, as_floats);
        /* Tiles that took long are begun again, and counted again. */
        assert_in_range(rays[1], 1 + rays[0] / 4, 4 * rays[0]);
        drawing_finish(&engine);
        drawing_finish(&own);
    }
}

static void users_code_is_the_engine_s(void **state)
{
    uint64_t rays;
    struct drawing engine = draw(drawing_parse(CODE), RENDER_ENGINE, false, &rays);
    struct drawing own = draw(drawing_parse(CODE), RENDER_FRAGMENT, false, &rays);

    (void)state;
    compare(&own, &engine, false);
    drawing_finish(&engine);
    drawing_finish(&own);
}

/* So that the comparison is one. */
static void other_pictures_are_noticed(void **state)
{
    uint64_t rays;
    struct drawing rich = draw(drawing_read(DRAWING_RICH), RENDER_ENGINE, false, &rays);
    struct drawing code = draw(drawing_parse(CODE), RENDER_ENGINE, false, &rays);

    (void)state;
    for (int i = 0; i < AOV_COUNT; i++) {
        size_t count;
        if (rich.of[i].bytes > 0) {
            assert_true(count_different(&rich.of[i], &code.of[i], false, false, &count) >
                        count * PER_MILLE / 1000);
        }
    }
    drawing_finish(&rich);
    drawing_finish(&code);
}

/* Rows as they come; a picture in rounds comes again and again. */
static struct image draw_last(struct resident *resident, const struct job_desc *desc)
{
    struct image image = {0};
    struct job *job = job_create(resident, desc, NULL);

    assert_non_null(job);
    for (enum job_state now; (now = job_step(job)) != JOB_DONE;) {
        assert_int_not_equal(now, JOB_FAILED);
        renderer_poll(renderer, now == JOB_WAITING ? 100 : 0);
        if (now == JOB_ROWS) {
            struct image rows = job_take_rows(job, AOV_COLOR);
            image.pixels = realloc(image.pixels, image.bytes + rows.bytes);
            memcpy((uint8_t *)image.pixels + image.bytes, rows.pixels, rows.bytes);
            image.bytes += rows.bytes;
            image_finish(&rows);
        }
        if (now == JOB_ROUND) {
            image_finish(&image);
        }
    }
    job_destroy(job);
    return image;
}

static void rounds_end_with_the_same_picture(void **state)
{
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);

    (void)state;
    renderer_use_stage(renderer, RENDER_FRAGMENT);
    struct resident *resident = drawing_resident(renderer, DRAWING_RICH);
    desc.samples = 3;
    struct image plain = draw_last(resident, &desc);
    desc.in_rounds = true;
    struct image last = draw_last(resident, &desc);
    assert_true(drawing_is_same(&plain, &last));
    image_finish(&plain);
    image_finish(&last);
    resident_destroy(resident);
}

/* --- OpenGL 3.3 --- */

enum { SHOWN_BYTES = 2 << 20 };

static struct shown {
    bool compute; /* the device has compute shaders */
    size_t length;
    uint8_t bytes[SHOWN_BYTES];
} * older; /* by OpenGL 3.3 */

static void show(struct shown *shown, const struct image *image)
{
    assert_in_range(shown->length + image->bytes, 0, SHOWN_BYTES);
    memcpy(shown->bytes + shown->length, image->pixels, image->bytes);
    shown->length += image->bytes;
}

static void show_all(struct shown *shown)
{
    struct job_desc rounds = drawing_desc(WIDTH, HEIGHT);
    uint64_t rays;

    shown->compute = renderer_info(renderer)->compute;
    for (int i = 0; i < 2; i++) {
        struct scene *scene = i == 0 ? drawing_read(DRAWING_RICH) : drawing_parse(CODE);
        struct drawing drawing = draw(scene, RENDER_FRAGMENT, i == 0, &rays);
        for (int aov = 0; aov < AOV_COUNT; aov++) {
            show(shown, &drawing.of[aov]);
        }
        drawing_finish(&drawing);
    }
    rounds.samples = 3;
    rounds.in_rounds = true;
    struct resident *resident = drawing_resident(renderer, DRAWING_RICH);
    struct image last = draw_last(resident, &rounds);
    show(shown, &last);
    image_finish(&last);
    resident_destroy(resident);
}

/* Functions above 3.3 are NULL there (gl.h), so a call of one ends the process. */
static void opengl_3_3_draws_the_same(void **state)
{
    struct shown *newer = calloc(1, sizeof *newer);

    (void)state;
    assert_true(older->length > 0);
    if (older->compute) { /* no driver of Mesa */
        free(newer);
        skip();
    }
    show_all(newer);
    assert_true(newer->compute);
    assert_int_equal(newer->length, older->length);
    assert_memory_equal(newer->bytes, older->bytes, newer->length);
    free(newer);
}

/* Mesa reads its overrides once in a process. */
static bool draw_by_older(void)
{
    int status = 0;

    older = mmap(NULL, sizeof *older, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    assert_true(older != MAP_FAILED);
    const pid_t child = fork();
    if (child == 0) {
        setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
        setenv("MESA_GLSL_VERSION_OVERRIDE", "330", 1);
        renderer = drawing_renderer(0);
        show_all(older);
        renderer_destroy(renderer);
        _exit(0);
    }
    return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

static int start(void **state)
{
    (void)state;
    if (!draw_by_older()) {
        return -1;
    }
    renderer = drawing_renderer(0);
    return 0;
}

static int end(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    munmap(older, sizeof *older);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(outputs_are_the_engine_s),
        cmocka_unit_test(users_code_is_the_engine_s),
        cmocka_unit_test(other_pictures_are_noticed),
        cmocka_unit_test(rounds_end_with_the_same_picture),
        cmocka_unit_test(opengl_3_3_draws_the_same),
    };

    return cmocka_run_group_tests_name("fragment", tests, start, end);
}
