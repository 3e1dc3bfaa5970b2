/* SPDX-License-Identifier: MIT */
/* A program that the driver refuses: the engine draws the scene, with its pixels, and the log says
 * so. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/renderer_internal.h"
#include "tests/support/drawing.h"
#include "tests/support/json_text.h"

static const char document[] =
    "{'format':'fieldcast/1','lights':[{'id':'sun','type':'directional'}],"
    "'root':{'id':'root','type':'union','children':["
    "{'id':'a','type':'sphere','params':{'radius':0.4}},"
    "{'id':'b','type':'torus'}]}}";
static const struct job_desc usual = {
    .width = 96, .height = 64, .level = -1, .transparent = -1, .exact = true};

static PFNGLGETPROGRAMIVPROC get_program;
static int refusals;

static void APIENTRY refuse_links(GLuint program, GLenum name, GLint *out)
{
    get_program(program, name, out);
    if (name == GL_LINK_STATUS) {
        *out = GL_FALSE;
    }
}

static void on_log(void *data, const char *line)
{
    (void)data;
    refusals += strstr(line, "refuses a program") != NULL;
}

static struct renderer *make_renderer(enum render_stage stage)
{
    const struct renderer_params params = {
        .device = {.index = -1, .cache_dir = NULL}, .stage = stage, .log = on_log};
    struct error err = {0};
    struct renderer *renderer = renderer_create(&params, &err);

    if (!renderer) {
        fail_msg("%s", err.message);
    }
    return renderer;
}

static void edit(struct resident *resident)
{
    struct error err = {0};
    cJSON *ops = json_text_parse("[{'op':'set','at':'/nodes/a/params/radius','value':0.6}]", NULL);

    if (!resident_edit(resident, ops, resident_revision(resident) + 1, &err)) {
        fail_msg("%s: %s", err.place, err.message);
    }
    cJSON_Delete(ops);
}

static void assert_same_picture(struct resident *refused, struct resident *wanted)
{
    struct image ours = drawing_of(refused, &usual, AOV_COLOR);
    struct image theirs = drawing_of(wanted, &usual, AOV_COLOR);

    assert_int_equal(ours.bytes, theirs.bytes);
    assert_memory_equal(ours.pixels, theirs.pixels, ours.bytes);
    assert_int_equal(resident_error(refused)->kind, ERROR_NONE);
    assert_int_equal(resident_shown_revision(refused), resident_revision(refused));
    image_finish(&ours);
    image_finish(&theirs);
}

/* Also after an edit of numbers, and with a program that was refused before the scene came. */
static void assert_drawn_by_the_engine(enum render_stage stage)
{
    struct renderer *device = make_renderer(stage), *engine = make_renderer(RENDER_ENGINE);

    get_program = device->gl.GetProgramiv;
    device->gl.GetProgramiv = refuse_links;
    refusals = 0;
    struct resident *refused = resident_create(device, drawing_parse(document), 1);
    struct resident *wanted = resident_create(engine, drawing_parse(document), 1);
    assert_same_picture(refused, wanted);
    edit(refused);
    edit(wanted);
    assert_same_picture(refused, wanted);
    struct resident *later = resident_create(device, drawing_parse(document), 1);
    edit(later);
    assert_same_picture(later, wanted);
    assert_int_equal(refusals, 1);
    resident_destroy(later);
    resident_destroy(refused);
    resident_destroy(wanted);
    renderer_destroy(device);
    renderer_destroy(engine);
}

static void a_refused_program_leaves_the_scene_to_the_engine(void **state)
{
    (void)state;
    assert_drawn_by_the_engine(RENDER_COMPUTE);
    assert_drawn_by_the_engine(RENDER_FRAGMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_refused_program_leaves_the_scene_to_the_engine),
    };

    return cmocka_run_group_tests_name("refused program", tests, NULL, NULL);
}
