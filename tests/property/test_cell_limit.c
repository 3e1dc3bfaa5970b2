/* SPDX-License-Identifier: MIT */
/* Cubes of a field of which nothing can be left out anywhere take no more memory than they may. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "renderer/engine/engine.h"
#include "tests/support/json_text.h"
#include "tests/support/peak.h"
#include "tests/support/random_scene.h"

enum { SPHERES = 2000, POINTS = 6000 };
/* Without the limit it would be more than 2.5 times as much as with it. */
#ifdef __SANITIZE_ADDRESS__
enum { MOST_MIB = 900 }; /* with what is kept of freed memory */
#else
enum { MOST_MIB = 400 };
#endif

/* Each of them changes the distance everywhere. */
static struct field *blended_spheres(void)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    struct error err = {0};

    fprintf(out, "{'format':'fieldcast/1','root':{'id':'r','type':'smooth_union',"
                 "'params':{'k':100},'children':[");
    for (int i = 0; i < SPHERES; i++) {
        fprintf(out, "%s{'id':'s%d','type':'sphere'}", i > 0 ? "," : "", i);
    }
    fprintf(out, "]}}");
    fclose(out);
    struct scene *scene = json_text_valid_scene(text);
    struct field *field = field_compile(scene, &err);
    assert_non_null(field);
    scene_destroy(scene);
    free(text);
    return field;
}

static void cubes_that_leave_nothing_out_are_made_anew(void **state)
{
    static float points[POINTS][3], distances[POINTS];
    struct random random = {.state = 4711};
    struct field *field = blended_spheres();
    struct engine_program *program = engine_program_create(field, 0, 1);
    const long before = peak_mib();

    (void)state;
    for (int i = 0; i < 3 * POINTS; i++) {
        points[i / 3][i % 3] = (float)random_between(&random, -4, 4);
    }
    engine_distances(program, field->params, (const float(*)[3])points, POINTS, 1e-4f, distances);
    assert_in_range(peak_mib() - before, 0, MOST_MIB);
    engine_program_destroy(program);
    field_unref(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cubes_that_leave_nothing_out_are_made_anew),
    };

    return cmocka_run_group_tests_name("cell limit", tests, NULL, NULL);
}
