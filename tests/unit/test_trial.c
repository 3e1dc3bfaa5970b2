/* SPDX-License-Identifier: MIT */
/* Users' code whose numbers are edited is tried out again with them, beside pictures that do not
 * wait for it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/renderer.h"
#include "tests/support/drawing.h"
#include "tests/support/json_text.h"

static struct renderer *renderer;

static const char document[] =
    "{'format':'fieldcast/1','primitives':{'blob':{'params':[{'name':'k','type':'float',"
    "'default':1}],'code':'float sdf(vec3 p) { return k * (length(p) - 0.5); }'}},"
    "'root':{'id':'root','type':'union','children':["
    "{'id':'a','type':'field','params':{'primitive':'blob'}},"
    "{'id':'b','type':'sphere','transform':{'translation':[2,0,0]}}]}}";

static void finish_trials(void)
{
    while (renderer_is_trying(renderer)) {
        renderer_poll(renderer, 0);
    }
}

static void edit(struct resident *resident, const char *text)
{
    struct error err = {0};
    cJSON *ops = json_text_parse(text, NULL);

    if (!resident_edit(resident, ops, resident_revision(resident) + 1, &err)) {
        fail_msg("%s: %s", err.place, err.message);
    }
    cJSON_Delete(ops);
}

static void numbers_are_tried_again(void **state)
{
    struct resident *resident = resident_create(renderer, drawing_parse(document), 1);
    (void)state;

    finish_trials();
    assert_int_equal(resident_warning(resident).error.kind, ERROR_NONE);

    edit(resident, "[{'op':'set','at':'/nodes/a/params/k','value':5}]");
    assert_int_equal(resident_shown_revision(resident), resident_revision(resident));
    assert_true(renderer_is_trying(renderer));
    finish_trials();
    const struct warning warning = resident_warning(resident);
    assert_int_equal(warning.kind, WARNING_LIPSCHITZ);
    assert_string_equal(warning.error.place, "/primitives/blob/code");
    assert_non_null(strstr(warning.error.message, "up to 5 "));

    edit(resident, "[{'op':'set','at':'/nodes/a/params/k','value':1}]");
    finish_trials();
    assert_int_equal(resident_warning(resident).error.kind, ERROR_NONE);
    resident_destroy(resident);
}

static void other_numbers_are_not(void **state)
{
    struct resident *resident = resident_create(renderer, drawing_parse(document), 1);
    (void)state;

    finish_trials();
    edit(resident, "[{'op':'set','at':'/nodes/b/params/radius','value':0.7}]");
    edit(resident, "[{'op':'set','at':'/nodes/a/transform/translation','value':[0,1,0]}]");
    assert_false(renderer_is_trying(renderer));
    resident_destroy(resident);
}

/* Long, and begun first; it takes ten times as long at least. */
static void a_short_trial_does_not_wait_for_a_long_one(void **state)
{
    static const char many[] =
        "{'format':'fieldcast/1','root':{'id':'root','type':'field','params':{'code':"
        "'float sdf(vec3 p) { float d = length(p) - 0.5; for (int i = 0; i < 200; i++) { "
        "d += 0.000001 * sin(p.x * float(i)) * cos(p.y * float(i)); } return d; }'}}}";
    struct resident *slow = resident_create(renderer, drawing_parse(many), 1);
    struct resident *quick = resident_create(renderer, drawing_parse(document), 1);
    (void)state;

    assert_true(renderer_is_trying(renderer));
    while (resident_shown_revision(quick) == 0) {
        renderer_poll(renderer, 0);
    }
    assert_int_equal(resident_shown_revision(slow), 0);
    finish_trials();
    assert_int_equal(resident_shown_revision(slow), 1);
    resident_destroy(slow);
    resident_destroy(quick);
}

static int start(void **state)
{
    (void)state;
    renderer = drawing_renderer(0);
    renderer_use_stage(renderer, RENDER_ENGINE);
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
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_tried_again),
        cmocka_unit_test(other_numbers_are_not),
        cmocka_unit_test(a_short_trial_does_not_wait_for_a_long_one),
    };

    return cmocka_run_group_tests(tests, start, stop);
}
