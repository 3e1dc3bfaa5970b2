/* SPDX-License-Identifier: MIT */
/* Pictures of a scene under numeric edits are those of the edited scene opened anew; pictures under
 * way keep what they began with; and edits allocate no more fields than are drawn at once. By the
 * device and by the engine. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/memory.h"
#include "renderer/renderer_internal.h"
#include "tests/support/drawing.h"
#include "tests/support/random_scene.h"

enum { WIDTH = 24, HEIGHT = 18, SHAPES = 60, EDITS = 16, UNDER_WAY = 2 };

static struct renderer *renderer;

/* More numbers than a row of the texture has. */
static char *write_document(void)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    fputs("{'format':'fieldcast/1','camera':{'position':[0,1,9],'target':[0,0,0]},"
          "'materials':{'red':{'shader':'phong'}},'environment':{'floor':true},"
          "'root':{'id':'root','type':'union','children':[",
          out);
    for (int i = 0; i < SHAPES; i++) {
        fprintf(out,
                "%s{'id':'ball-%d','type':'sphere','material':'red',"
                "'transform':{'translation':[%d,%d,0]},'params':{'radius':0.4}}",
                i ? "," : "", i, i % 10 - 5, i / 10 - 2);
    }
    fputs("]}}", out);
    assert_int_equal(fclose(out), 0);
    return text;
}

static cJSON *random_operation(struct random *random)
{
    static const char *const others[] = {"/materials/red/properties/shininess",
                                         "/environment/floor_height", "/camera/fov"};
    static const double means[] = {20, -2, 45};
    const size_t what = random_below(random, 8);
    char at[80];
    double value = random_between(random, 0.1, 0.6);

    snprintf(at, sizeof at, "/nodes/ball-%d/params/radius", (int)random_below(random, SHAPES));
    if (what < 3) {
        snprintf(at, sizeof at, "%s", others[what]);
        value = means[what] * random_between(random, 0.9, 1.1);
    }
    cJSON *op = cJSON_CreateObject();
    cJSON_AddStringToObject(op, "op", "set");
    cJSON_AddStringToObject(op, "at", at);
    cJSON_AddNumberToObject(op, "value", value);
    return op;
}

static void edit(struct random *random, struct resident *resident)
{
    struct error err = {0};
    cJSON *ops = cJSON_CreateArray();

    cJSON_AddItemToArray(ops, random_operation(random));
    if (!resident_edit(resident, ops, resident_revision(resident) + 1, &err)) {
        fail_msg("%s: %s", err.place, err.message);
    }
    cJSON_Delete(ops);
}

/* Others may be drawn while such a picture is under way, also within a tile. */
static struct job_desc one_sample(void)
{
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);

    desc.samples = 1;
    return desc;
}

static struct image draw(struct resident *resident)
{
    const struct job_desc desc = one_sample();
    struct error err = {0};
    struct image image;

    if (!renderer_render(resident, &desc, &image, &err)) {
        fail_msg("%s: %s", err.place, err.message);
    }
    return image;
}

static struct image draw_anew(const struct resident *resident)
{
    struct resident *fresh = resident_create(renderer, scene_copy(resident_scene(resident)), 1);
    struct image image = draw(fresh);

    resident_destroy(fresh);
    return image;
}

/* A picture that was begun, what it has to be, and what of it is there. */
struct begun {
    struct job *job;
    struct image want;
    uint8_t *pixels;
    size_t bytes;
};

/* False: it is done. */
static bool step(struct begun *begun)
{
    const enum job_state state = job_step(begun->job);

    assert_true(state != JOB_FAILED);
    if (state == JOB_ROWS) {
        struct image rows = job_take_rows(begun->job, AOV_COLOR);
        begun->pixels = memory_resize(begun->pixels, begun->bytes + rows.bytes, 1);
        memcpy(begun->pixels + begun->bytes, rows.pixels, rows.bytes);
        begun->bytes += rows.bytes;
        image_finish(&rows);
    }
    renderer_poll(renderer, state == JOB_WAITING ? 50 : 0);
    return state != JOB_DONE;
}

static void begin(struct begun *begun, struct resident *resident, bool going)
{
    const struct job_desc desc = one_sample();

    *begun = (struct begun){.want = draw_anew(resident), .job = job_create(resident, &desc, NULL)};
    assert_non_null(begun->job);
    assert_true(!going || step(begun));
}

static void end(struct begun *begun)
{
    if (begun->job) {
        while (step(begun)) {
        }
        job_destroy(begun->job);
        assert_int_equal(begun->bytes, begun->want.bytes);
        assert_memory_equal(begun->pixels, begun->want.pixels, begun->bytes);
        free(begun->pixels);
        image_finish(&begun->want);
        begun->job = NULL;
    }
}

static void edits_are_drawn(void **state)
{
    (void)state;
    struct random random = {71};
    struct begun begun[UNDER_WAY] = {{.job = NULL}};
    char *text = write_document();
    struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
    struct image first = draw(resident);
    const struct field *base = resident->newest->geometry.field;
    const uint64_t compiled = renderer_counters(renderer).compilations;

    for (int i = 0; i < EDITS; i++) {
        struct begun *one = &begun[i % UNDER_WAY];
        end(one);
        begin(one, resident, i % 3 > 0);
        for (size_t left = 1 + random_below(&random, 3); left > 0; left--) {
            edit(&random, resident);
            assert_ptr_equal(resident->newest->geometry.field->base
                                 ? resident->newest->geometry.field->base
                                 : resident->newest->geometry.field,
                             base);
        }
        struct image got = draw(resident), want = draw_anew(resident);
        assert_true(drawing_is_same(&got, &want));
        image_finish(&got);
        image_finish(&want);
    }
    for (int i = 0; i < UNDER_WAY; i++) {
        end(&begun[i]);
    }
    assert_int_equal(renderer_counters(renderer).compilations, compiled);
    image_finish(&first);
    resident_destroy(resident);
    free(text);
}

/* Two fields in turn, where nothing is under way. */
static void edits_allocate_no_fields(void **state)
{
    (void)state;
    struct random random = {72};
    const struct field *seen[EDITS];
    size_t count = 0;
    char *text = write_document();
    struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
    struct image first = draw(resident);

    for (int i = 0; i < EDITS; i++) {
        edit(&random, resident);
        size_t found = 0;
        while (found < count && seen[found] != resident->newest->geometry.field) {
            found++;
        }
        seen[found] = resident->newest->geometry.field;
        count += found == count;
    }
    assert_in_range(count, 1, 3);
    image_finish(&first);
    resident_destroy(resident);
    free(text);
}

static int open_renderer(enum render_stage stage)
{
    const struct renderer_params params = {
        .device = {.index = -1, .cache_dir = getenv("FIELDCAST_CACHE")}, .stage = stage};
    struct error err = {0};

    renderer = renderer_create(&params, &err);
    return renderer ? 0 : -1;
}

static int with_device(void **state)
{
    (void)state;
    return open_renderer(RENDER_COMPUTE);
}

static int with_engine(void **state)
{
    (void)state;
    return open_renderer(RENDER_ENGINE);
}

static int close_renderer(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edits_are_drawn),
        cmocka_unit_test(edits_allocate_no_fields),
    };
    const int failed = cmocka_run_group_tests_name("patched pictures by the device", tests,
                                                   with_device, close_renderer);

    return failed + cmocka_run_group_tests_name("patched pictures by the engine", tests,
                                                with_engine, close_renderer);
}
