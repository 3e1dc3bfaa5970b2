/* SPDX-License-Identifier: MIT */
/* A picture is the same bytes whatever was drawn before and whatever the scene was meanwhile. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/drawing.h"
#include "tests/support/random_edit.h"

enum { WIDTH = 80, HEIGHT = 45, EDITS = 400, GLANCES = 20 };

static struct renderer *renderer;

static void assert_draws(struct resident *resident, const struct image *expected, const char *after)
{
    const struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    struct image image = drawing_of(resident, &desc, AOV_COLOR);

    if (!drawing_is_same(&image, expected)) {
        fail_msg("another picture %s", after);
    }
    image_finish(&image);
}

static void what_was_drawn_before_does_not_show(void **state)
{
    struct resident *resident = drawing_resident(renderer, DRAWING_RICH), *other;
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    struct image first = drawing_of(resident, &desc, AOV_COLOR), image;

    (void)state;
    assert_draws(resident, &first, "the second time");
    for (int level = 0; level < QUALITY_COUNT; level++) {
        desc = drawing_desc(WIDTH / 2, 2 * HEIGHT);
        desc.level = level;
        image = drawing_of(resident, &desc, AOV_COLOR);
        image_finish(&image);
    }
    assert_draws(resident, &first, "after other levels");
    for (int aov = 0; aov < AOV_COUNT; aov++) {
        desc = drawing_desc(WIDTH, HEIGHT);
        desc.as_floats = true;
        image = drawing_of(resident, &desc, (enum aov)aov);
        image_finish(&image);
    }
    assert_draws(resident, &first, "after other outputs");
    other = drawing_resident(renderer, "tests/golden/nodes/torus/scene.json");
    desc = drawing_desc(WIDTH, HEIGHT);
    image = drawing_of(other, &desc, AOV_COLOR);
    assert_false(drawing_is_same(&image, &first));
    image_finish(&image);
    assert_draws(resident, &first, "after another scene's");
    resident_destroy(other);
    resident_destroy(resident);
    image_finish(&first);
}

/* Draws the little that can be drawn of the scene as it is, or of what it was a moment ago. */
static void glance(struct resident *resident)
{
    struct job_desc desc = drawing_desc(16, 9);
    struct error err = {0};
    struct image image = {0};

    desc.exact = false;
    desc.level = QUALITY_DRAFT;
    if (renderer_render(resident, &desc, &image, &err)) {
        image_finish(&image);
    }
}

/* Applies a random edit to `scene` and to the resident. Returns its inverse; NULL where it was
 * refused. */
static cJSON *edit(struct random *random, struct scene *scene, struct resident *resident)
{
    cJSON *ops = random_edit(random, scene), *applied = NULL, *inverse = NULL;
    struct error err = {0};

    if (edit_apply(scene, ops, &applied, &inverse, &err)) {
        assert_true(resident_edit(resident, applied, resident_revision(resident) + 1, &err));
    }
    cJSON_Delete(applied);
    cJSON_Delete(ops);
    return inverse;
}

static void edits_and_their_undo_leave_nothing(void **state)
{
    static cJSON *inverses[EDITS];
    struct random random = {71};
    struct scene *scene = drawing_read(DRAWING_RICH);
    struct resident *resident = drawing_resident(renderer, DRAWING_RICH);
    const struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    struct image first = drawing_of(resident, &desc, AOV_COLOR);
    struct error err = {0};

    (void)state;
    for (int i = 0; i < EDITS;) {
        inverses[i] = edit(&random, scene, resident);
        i += inverses[i] != NULL;
        if (i % (EDITS / GLANCES) == 0) {
            glance(resident);
        }
    }
    for (int i = EDITS - 1; i >= 0; i--) {
        assert_true(resident_edit(resident, inverses[i], resident_revision(resident) + 1, &err));
        cJSON_Delete(inverses[i]);
    }
    assert_draws(resident, &first, "after edits and their undo");
    resident_destroy(resident);
    scene_destroy(scene);
    image_finish(&first);
}

static int start(void **state)
{
    (void)state;
    renderer = drawing_renderer(0);
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
        cmocka_unit_test(what_was_drawn_before_does_not_show),
        cmocka_unit_test(edits_and_their_undo_leave_nothing),
    };

    return cmocka_run_group_tests_name("determinism", tests, start, stop);
}
