/* SPDX-License-Identifier: MIT */
/* Depth, normal and id as drawn are what the C evaluator says, marched in double precision along
 * rays that this file makes from the camera by itself: of every scene in golden/nodes, and of
 * examples with a sky behind them.
 *
 * Pictures are good to a pixel, so they are large, and every fifth pixel each way is looked at.
 * Normals are gradients over half of a pixel's footprint, which is half a pixel in radius, by
 * either way. A depth is off when the place is farther from the surface than one footprint,
 * measured at right angles to it, and farther along the ray than a thousandth. */
#include <dirent.h>
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/compiled.h"
#include "tests/support/drawing.h"

enum { EVERY = 5, WIDTH = 128, HEIGHT = 72, PLACES = WIDTH * HEIGHT, THREADS = 2 };
enum { SCENES_MAX = 200, PATH_BYTES = 300 };

#define TOLERANCE 1e-6      /* so near is on the surface */
#define LEAST_OVERLAP 0.995 /* of silhouettes: hit in both, of those hit in either */
#define MOST_DEPTHS 0.005   /* off, of the places hit in both */
#define MOST_NORMALS 0.02   /* off by more than NORMAL_DEGREES, of the same */
#define NORMAL_DEGREES 5.0
#define MOST_IDS 0.01 /* of the places around which all have the same id */

/* Whether a ray meets something beyond so much of the greatest distance is no silhouette. */
#define END_OF_SIGHT 0.95

static const char *const examples[] = {
    "blend",      "elongate", "flat-shapes", "gyroid",     "lecture-4-transforms",
    "lighthouse", "mirror",   "own-code",    "primitives", "robot",
    "snowman",    "twist",
};

/* Their surfaces have waves shorter than a pixel: depth and normal there are those of a place, not
 * of a pixel. */
static const char *const rough[] = {"displace_noise", "julia", "mandelbulb", "terrain"};

static struct renderer *renderer;

/* --- rays --- */

struct view {
    double eye[3], forward[3], right[3], up[3]; /* of length 1 */
    double half;                                /* of the picture's height, at distance 1 */
    bool parallel;
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = a[j] * b[k] - a[k] * b[j];
    }
}

static void to_unit(double v[3])
{
    const double length = sqrt(dot(v, v));

    for (int i = 0; i < 3; i++) {
        v[i] /= length;
    }
}

static struct view view_of(const struct record *camera)
{
    struct view view = {.parallel = record_is(camera, "type", "orthographic")};
    const double *target = record_vector(camera, "target");

    memcpy(view.eye, record_vector(camera, "position"), sizeof view.eye);
    for (int i = 0; i < 3; i++) {
        view.forward[i] = target[i] - view.eye[i];
    }
    to_unit(view.forward);
    cross(view.forward, record_vector(camera, "up"), view.right);
    to_unit(view.right);
    cross(view.right, view.forward, view.up);
    view.half = view.parallel ? record_number(camera, "height") / 2
                              : tan(record_number(camera, "fov") / 2 * M_PI / 180);
    return view;
}

/* Through the centre of the place's pixel. */
static void ray_of(const struct view *view, int place, double origin[3], double direction[3])
{
    const double pixel = 2 * view->half / (EVERY * HEIGHT);
    const double x = pixel * (EVERY * (place % WIDTH) + 0.5 - EVERY * WIDTH / 2.0);
    const double y = pixel * (EVERY * HEIGHT / 2.0 - EVERY * (place / WIDTH) - 0.5);

    for (int i = 0; i < 3; i++) {
        const double aside = x * view->right[i] + y * view->up[i];
        origin[i] = view->eye[i] + (view->parallel ? aside : 0);
        direction[i] = view->forward[i] + (view->parallel ? 0 : aside);
    }
    to_unit(direction);
}

static double footprint(const struct view *view, double t)
{
    return view->half / (EVERY * HEIGHT) * (view->parallel ? 1 : t);
}

/* --- what the evaluator says --- */

struct found {
    double t; /* -1: nothing */
    double normal[3];
    double slant; /* cosine between the normal and the ray */
    uint32_t id;
};

struct oracle {
    struct field *field;
    struct view view;
    double reach;
    struct found found[PLACES];
    atomic_int row; /* the next to be taken */
};

static void march_place(struct oracle *oracle, int place)
{
    struct found *found = &oracle->found[place];
    double origin[3], direction[3], p[3];

    ray_of(&oracle->view, place, origin, direction);
    found->t = field_march(oracle->field, origin, direction, oracle->reach, TOLERANCE);
    if (found->t < 0) {
        return;
    }
    for (int i = 0; i < 3; i++) {
        p[i] = origin[i] + found->t * direction[i];
    }
    field_normal(oracle->field, p, footprint(&oracle->view, found->t) / 2, found->normal);
    found->slant = fabs(dot(found->normal, direction));
    found->id = field_surface(oracle->field, p, NULL).number;
}

static void *march_rows(void *data)
{
    struct oracle *oracle = data;

    for (int row; (row = atomic_fetch_add(&oracle->row, 1)) < HEIGHT;) {
        for (int x = 0; x < WIDTH; x++) {
            march_place(oracle, row * WIDTH + x);
        }
    }
    return NULL;
}

/* Caller frees. */
static struct oracle *ask_oracle(const char *path)
{
    struct scene *scene = drawing_read(path);
    struct oracle *oracle = calloc(1, sizeof *oracle);
    pthread_t threads[THREADS];

    assert_non_null(oracle);
    oracle->field = compile_field(scene);
    oracle->view = view_of(&scene->camera);
    oracle->reach = record_number(&scene->render, "max_distance");
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, march_rows, oracle), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
    }
    field_unref(oracle->field);
    scene_destroy(scene);
    return oracle;
}

/* --- comparison --- */

struct tally {
    int either, both, inner;  /* places */
    int depths, normals, ids; /* off */
};

/* Whether all places around this one have its id. */
static bool is_inner(const struct oracle *oracle, int place)
{
    for (int i = 0; i < 9; i++) {
        const int x = place % WIDTH + i % 3 - 1, y = place / WIDTH + i / 3 - 1;
        if (x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT &&
            oracle->found[y * WIDTH + x].id != oracle->found[place].id) {
            return false;
        }
    }
    return true;
}

static bool is_near(const struct view *view, const struct found *found, double depth)
{
    const double off = fabs(depth - found->t);

    return off <= 1e-3 * found->t || off * found->slant <= footprint(view, found->t);
}

static void compare(struct tally *tally, const struct oracle *oracle, int place, float depth,
                    const float normal[3], uint32_t id)
{
    const struct found *found = &oracle->found[place];
    const bool hit = found->t >= 0, drawn = depth < INFINITY;
    const double n[3] = {normal[0], normal[1], normal[2]};
    const double far = END_OF_SIGHT * oracle->reach;

    if (found->t > far || (drawn && depth > far)) {
        return;
    }
    tally->either += hit || drawn;
    tally->both += hit && drawn;
    if (hit && drawn) {
        tally->depths += !is_near(&oracle->view, found, depth);
        tally->normals += !(dot(n, found->normal) >= cos(NORMAL_DEGREES * M_PI / 180));
    }
    if (is_inner(oracle, place)) {
        tally->inner++;
        tally->ids += id != found->id;
    }
}

static struct tally tally_picture(const char *path, const struct oracle *oracle)
{
    struct job_desc desc = drawing_desc(EVERY * WIDTH, EVERY * HEIGHT);
    struct resident *resident = drawing_resident(renderer, path);
    desc.as_floats = true;
    desc.aovs[AOV_DEPTH] = desc.aovs[AOV_NORMAL] = desc.aovs[AOV_ID] = true;
    struct drawing drawing = drawing_outputs(renderer, resident, &desc);
    const float *depths = drawing.of[AOV_DEPTH].pixels, *normals = drawing.of[AOV_NORMAL].pixels;
    const uint32_t *ids = drawing.of[AOV_ID].pixels;
    struct tally tally = {0};

    for (int i = 0; i < PLACES; i++) {
        const int pixel = EVERY * (i / WIDTH * EVERY * WIDTH + i % WIDTH);
        compare(&tally, oracle, i, depths[pixel], normals + 3L * pixel, ids[pixel]);
    }
    drawing_finish(&drawing);
    resident_destroy(resident);
    return tally;
}

/* False, with a message, where more is off than may be. */
static bool agrees(const struct tally *tally, bool is_rough)
{
    const bool good = tally->both >= LEAST_OVERLAP * tally->either &&
                      tally->ids <= MOST_IDS * tally->inner &&
                      (is_rough || (tally->depths <= MOST_DEPTHS * tally->both &&
                                    tally->normals <= MOST_NORMALS * tally->both));

    if (!good) {
        print_message("hit in either %d, in both %d; off: %d depths, %d normals, %d ids of %d\n",
                      tally->either, tally->both, tally->depths, tally->normals, tally->ids,
                      tally->inner);
    }
    return good;
}

/* --- scenes --- */

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
    for (size_t i = 0; i < sizeof examples / sizeof examples[0] && scene_count < SCENES_MAX; i++) {
        snprintf(scenes[scene_count++].path, PATH_BYTES, "protocol/examples/%s.json", examples[i]);
    }
}

static void test_scene(void **state)
{
    const struct drawn_scene *scene = *state;
    struct oracle *oracle = ask_oracle(scene->path);
    const struct tally tally = tally_picture(scene->path, oracle);

    free(oracle);
    assert_true(tally.either > PLACES / 4);
    assert_true(agrees(&tally, scene->rough));
}

static void there_are_forty(void **state)
{
    (void)state;
    assert_true(scene_count >= 40);
}

static void another_scene_is_noticed(void **state)
{
    struct oracle *oracle = ask_oracle("tests/golden/nodes/sphere/scene.json");
    const struct tally tally = tally_picture("tests/golden/nodes/ellipsoid/scene.json", oracle);

    (void)state;
    free(oracle);
    assert_false(agrees(&tally, false));
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

/* An argument, as "*lighthouse*", chooses scenes. */
int main(int argc, char **argv)
{
    static struct CMUnitTest tests[SCENES_MAX + 2];
    size_t n = 0;

    tests[n++] = (struct CMUnitTest)cmocka_unit_test(there_are_forty);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(another_scene_is_noticed);
    find_scenes();
    for (size_t i = 0; i < scene_count; i++) {
        tests[n++] = (struct CMUnitTest){scenes[i].path, test_scene, NULL, NULL, &scenes[i]};
    }
    if (argc > 1) {
        cmocka_set_test_filter(argv[1]);
    }
    return _cmocka_run_group_tests("oracle", tests, n, start, stop);
}
