/* SPDX-License-Identifier: MIT */
/* Depth, normal and id as drawn are what the C evaluator says, of every scene in golden/nodes.
 *
 * Pictures are good to a pixel, so they are large, and every eighth pixel each way is looked at
 * (tests/support/picture_oracle.h). */
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/drawing.h"
#include "tests/support/picture_oracle.h"

enum { EVERY = 8, SCENES_MAX = 200, PATH_BYTES = 300 };

/* Their surfaces have waves shorter than a pixel: depth and normal there are those of a place, not
 * of a pixel. */
static const char *const rough[] = {"displace_noise", "julia", "mandelbulb", "terrain"};

static struct renderer *renderer;

struct drawn_scene {
    char path[PATH_BYTES];
    bool rough;
};

static struct drawn_scene scenes[SCENES_MAX];
static size_t scene_count;

static bool is_rough(const char *name)
{
    for (size_t i = 0; i < sizeof rough / sizeof rough[0]; i++) {
        if (strcmp(name, rough[i]) == 0) {
            return true;
        }
    }
    return false;
}

static int is_case(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

static void find_scenes(void)
{
    struct dirent **nodes = NULL;
    const int count = scandir("tests/golden/nodes", &nodes, is_case, alphasort);

    for (int i = 0; i < count && scene_count < SCENES_MAX; i++) {
        struct drawn_scene *scene = &scenes[scene_count++];
        snprintf(scene->path, PATH_BYTES, "tests/golden/nodes/%.200s/scene.json", nodes[i]->d_name);
        scene->rough = is_rough(nodes[i]->d_name);
        free(nodes[i]);
    }
    free(nodes);
}

static void picture_agrees_with_the_oracle(void **state)
{
    const struct drawn_scene *scene = *state;

    picture_oracle_assert(renderer, scene->path, EVERY, scene->rough);
}

static void every_type_has_a_scene(void **state)
{
    (void)state;
    assert_int_equal(scene_count, node_type_count());
}

static void another_scene_is_noticed(void **state)
{
    const char *other = "tests/golden/nodes/ellipsoid/scene.json";
    struct oracle *oracle = picture_oracle_create("tests/golden/nodes/sphere/scene.json", EVERY);
    const struct oracle_tally tally = picture_oracle_judge(oracle, renderer, other);

    (void)state;
    oracle_destroy(oracle);
    assert_false(picture_oracle_agrees(other, &tally, false));
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

/* An argument, as "*torus*", chooses scenes. */
int main(int argc, char **argv)
{
    static struct CMUnitTest tests[SCENES_MAX + 2];
    size_t n = 0;

    tests[n++] = (struct CMUnitTest)cmocka_unit_test(every_type_has_a_scene);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(another_scene_is_noticed);
    find_scenes();
    for (size_t i = 0; i < scene_count; i++) {
        tests[n++] = (struct CMUnitTest){scenes[i].path, picture_agrees_with_the_oracle, NULL, NULL,
                                         &scenes[i]};
    }
    if (argc > 1) {
        cmocka_set_test_filter(argv[1]);
    }
    return _cmocka_run_group_tests("oracle", tests, n, start, stop);
}
