/* SPDX-License-Identifier: MIT */
/* Which shaders a device draws by: tried once, and kept for this device and driver. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "renderer/renderer_internal.h"
#include "renderer/stage_trial.h"
#include "tests/support/text_file.h"

static char folder[] = "/tmp/fieldcast-stage-XXXXXX", kept[sizeof folder + 8];
static struct renderer *renderer;
static int trials;
static char during[512]; /* what was kept while the last one went on */

static void read_kept(char out[512])
{
    size_t length;
    char *text = text_file_read(kept, &length);

    snprintf(out, 512, "%s", text);
    free(text);
}

static void write_kept(const char *head, enum render_stage stage)
{
    FILE *file = fopen(kept, "w");

    assert_non_null(file);
    fprintf(file, "%s\n%s\n", head, render_stage_names[stage]);
    fclose(file);
}

static const char *own_head(void)
{
    static char head[512];
    const struct renderer_info *info = renderer_info(renderer);

    snprintf(head, sizeof head, "%s, %s", info->name, info->version);
    return head;
}

static void assert_kept(enum render_stage stage)
{
    char text[512], wanted[1024];

    read_kept(text);
    snprintf(wanted, sizeof wanted, "%s\n%s\n", own_head(), render_stage_names[stage]);
    assert_string_equal(text, wanted);
}

static void on_log(void *data, const char *line)
{
    (void)data;
    if (strstr(line, "compute shaders")) {
        trials++;
        read_kept(during);
    }
}

static void a_trial_is_kept(void **state)
{
    const enum render_stage before = renderer_info(renderer)->stage;
    const enum render_stage stage = stage_trial(renderer);

    (void)state;
    assert_true(stage == RENDER_COMPUTE || stage == RENDER_FRAGMENT);
    assert_int_equal(trials, 1);
    assert_int_equal(renderer_info(renderer)->stage, before);
    assert_kept(stage);
    assert_int_equal(stage_trial(renderer), stage);
    assert_int_equal(trials, 1);
}

/* So the next start does not try again what ended this one. */
static void compute_is_kept_while_it_goes_on(void **state)
{
    (void)state;
    assert_non_null(strstr(during, "\ncompute\n"));
}

static void what_is_kept_is_believed(void **state)
{
    (void)state;
    write_kept(own_head(), RENDER_FRAGMENT);
    assert_int_equal(stage_trial(renderer), RENDER_FRAGMENT);
    write_kept(own_head(), RENDER_COMPUTE);
    assert_int_equal(stage_trial(renderer), RENDER_COMPUTE);
    assert_int_equal(trials, 1);
}

static void what_is_not_of_this_device_is_not(void **state)
{
    (void)state;
    write_kept("Another card, 4.6", RENDER_FRAGMENT);
    assert_kept(stage_trial(renderer));
    assert_int_equal(trials, 2);
}

/* Fragment shaders are on a GPU alone. */
static void without_compute_shaders(void **state)
{
    const struct renderer_info gpu = {.compute = false}, newer_gpu = {.compute = true},
                               software = {.software = true, .compute = false};

    (void)state;
    assert_int_equal(renderer_best_stage(&gpu), RENDER_FRAGMENT);
    assert_int_equal(renderer_best_stage(&newer_gpu), RENDER_COMPUTE);
    assert_int_equal(renderer_best_stage(&software), RENDER_ENGINE);
}

static int start(void **state)
{
    struct renderer_params params = {
        .device = {.index = -1}, .stage = RENDER_COMPUTE, .log = on_log};

    (void)state;
    if (!mkdtemp(folder)) {
        return -1;
    }
    snprintf(kept, sizeof kept, "%s/stage", folder);
    params.device.cache_dir = folder;
    renderer = renderer_create(&params, NULL);
    return renderer ? 0 : -1;
}

/* The driver's cache is there too. */
static int end(void **state)
{
    char command[sizeof folder + 16];

    (void)state;
    renderer_destroy(renderer);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_trial_is_kept),
        cmocka_unit_test(compute_is_kept_while_it_goes_on),
        cmocka_unit_test(what_is_kept_is_believed),
        cmocka_unit_test(what_is_not_of_this_device_is_not),
        cmocka_unit_test(without_compute_shaders),
    };

    return cmocka_run_group_tests_name("stage trial", tests, start, end);
}
