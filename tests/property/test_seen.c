/* SPDX-License-Identifier: MIT */
/* The picture is where the surface is: depth, normal and id of small pictures against the C
 * evaluator (tests/support/oracle.h).
 * Every type of the registry, as golden/nodes has it but with its floor hidden, and compositions
 * (tests/support/compositions.h). Each is seen up close, and once more from elsewhere, at another
 * scale. The engine draws all of them; compute shaders draw the first batches of compositions.
 *
 * Hiding, cameras and scales are numbers, so compositions are a few in a scene, all but one hidden:
 * compiling takes longer than drawing and hardly longer for four shapes than for one. */
#include <assert.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/compositions.h"
#include "tests/support/drawing.h"
#include "tests/support/json_text.h"
#include "tests/support/oracle.h"
#include "tests/support/text_file.h"

enum { WIDTH = 128, HEIGHT = 96, CASES_MAX = 200, BATCH = 4 };

/* Lengths are for a scene of scale 1. */
#define TOLERANCE 1e-7  /* so near is on the surface */
#define DEPTH_ROOM 2e-3 /* from the true depth */
#define GRADIENT 1e-5

static const struct oracle_bounds smooth_bounds = {
    .overlap = 0.995, .depths = 0.005, .normals = 0.02, .ids = 0.01};
/* Of creased types (protocol/nodes.h): depths to CREASED_ROOM, normals to CREASED_DEGREES. */
static const struct oracle_bounds creased_bounds = {
    .overlap = 0.99, .depths = 0.02, .normals = 0.15, .ids = 0.01};
#define CREASED_ROOM 4 /* half pixels */
#define CREASED_DEGREES 90
#define CREASED_EVERY 2 /* pixels each way: fractals take their time, and their bounds are wide */

/* Changes the camera of a scene, which looks at what is around the origin, about 1 in radius. */
struct view {
    const char *name;
    double scale; /* of everything */
    double from[3];
    double fov;    /* degrees */
    double height; /* of an orthographic picture; 0: perspective */
};

static const struct view near_view = {"near", .scale = 1};
static const struct view views[] = {
    {"parallel 1/100", .scale = 0.01, .from = {-1.1, 0.9, 2.3}, .height = 1.9},
    {"far x100", .scale = 100, .from = {21, 17, -41}, .fov = 2.1},
    {"wide x1/10", .scale = 0.1, .from = {-1.05, 0.6, -0.95}, .fov = 72},
    {"parallel x10", .scale = 10, .from = {0.7, -1.4, 1.9}, .height = 2.2},
};
enum {
    VIEWS = sizeof views / sizeof views[0],
    FIRST_VIEW = 2, /* of the compositions: seen so, no eye is inside of something opaque */
    COMPUTED = 9,   /* the first compositions, which are thin, hollow or overlapping */
};

static struct renderer *renderer;
static bool wordy;

/* --- scenes --- */

struct seen_case {
    char name[80];
    const struct node_type *type;          /* of golden/nodes; NULL: a composition */
    const struct composition *composition; /* one of `count` from `first` on */
    size_t first, count;
    enum render_stage stage;
    const struct view *second;
};

static void hide(cJSON *node)
{
    cJSON_AddFalseToObject(node, "visible");
}

/* `whole`: with its floor. */
static cJSON *read_golden(const struct node_type *type, bool whole)
{
    char path[200];

    snprintf(path, sizeof path, "tests/golden/nodes/%s/scene.json", type->record.name);
    char *text = text_file_read(path, NULL);
    cJSON *document = cJSON_Parse(text), *child;

    free(text);
    cJSON_ArrayForEach(child,
                       cJSON_GetObjectItem(cJSON_GetObjectItem(document, "root"), "children"))
    {
        const char *id = cJSON_GetStringValue(cJSON_GetObjectItem(child, "id"));
        if (!whole && strcmp(id, "floor") == 0) {
            hide(child);
        }
    }
    return document;
}

static cJSON *read_composition(const struct composition *composition)
{
    char *text;

    assert_true(asprintf(&text,
                         "{'format':'fieldcast/1',%s'root':{'type':'group',"
                         "'children':[{'type':'group','children':[%s]}]}}",
                         composition->head, composition->root) > 0);
    cJSON *document = json_text_parse(text, NULL);

    if (!document) {
        fail_msg("%s: is no JSON: %s", composition->name, text);
    }
    free(text);
    return document;
}

static cJSON *children_of(const cJSON *document)
{
    return cJSON_GetObjectItem(cJSON_GetObjectItem(document, "root"), "children");
}

/* `whole`: with all that it shares its program with, which else are hidden. */
static cJSON *read_batch(const struct seen_case *it, bool whole)
{
    cJSON *document = read_composition(it->composition), *all = cJSON_CreateArray();

    for (size_t i = it->first; i < it->first + it->count; i++) {
        cJSON *other = read_composition(&compositions[i]);
        cJSON *child = cJSON_DetachItemFromArray(children_of(other), 0);
        cJSON *models = cJSON_DetachItemFromObject(other, "models");
        if (!whole && &compositions[i] != it->composition) {
            hide(child);
        }
        if (models && !cJSON_GetObjectItem(document, "models")) {
            cJSON_AddItemToObject(document, "models", cJSON_Duplicate(models, true));
        }
        cJSON_AddItemToArray(all, child);
        cJSON_Delete(models);
        cJSON_Delete(other);
    }
    cJSON_ReplaceItemInObject(cJSON_GetObjectItem(document, "root"), "children", all);
    return document;
}

static void scale_vector(cJSON *camera, const char *name, double scale)
{
    cJSON *item;

    cJSON_ArrayForEach(item, cJSON_GetObjectItem(camera, name))
    {
        cJSON_SetNumberValue(item, item->valuedouble * scale);
    }
}

static void set_camera(cJSON *document, const struct view *view)
{
    cJSON *camera = cJSON_CreateObject();

    if (view->height > 0) {
        cJSON_AddStringToObject(camera, "type", "orthographic");
        cJSON_AddNumberToObject(camera, "height", view->height * view->scale);
    } else {
        cJSON_AddNumberToObject(camera, "fov", view->fov);
    }
    cJSON_AddItemToObject(camera, "position", cJSON_CreateDoubleArray(view->from, 3));
    cJSON_ReplaceItemInObject(document, "camera", camera);
}

/* The document as it is seen: its camera set, everything scaled. */
static struct scene *scene_of(const struct seen_case *it, const struct view *view, bool whole)
{
    cJSON *document = it->type ? read_golden(it->type, whole) : read_batch(it, whole);
    cJSON *transform = cJSON_CreateObject(), *render = cJSON_CreateObject();
    struct error err = {0};

    if (view->fov > 0 || view->height > 0) {
        set_camera(document, view);
    }
    scale_vector(cJSON_GetObjectItem(document, "camera"), "position", view->scale);
    scale_vector(cJSON_GetObjectItem(document, "camera"), "target", view->scale);
    cJSON_AddNumberToObject(transform, "scale", view->scale);
    cJSON_AddItemToObject(cJSON_GetObjectItem(document, "root"), "transform", transform);
    cJSON_AddNumberToObject(render, "max_distance", 120 * view->scale);
    cJSON_AddItemToObject(document, "render", render);
    struct scene *scene = scene_read(document, &err);
    if (!scene) {
        fail_msg("%s: %s: %s", it->name, err.place, err.message);
    }
    cJSON_Delete(document);
    return scene;
}

/* --- comparison --- */

/* Of the last case, and of those that share its program. */
static struct {
    const void *owner;
    enum render_stage stage;
    struct resident *resident;
    uint64_t revision;
} shown;

static const void *owner_of(const struct seen_case *it)
{
    return it->type ? (const void *)it->type : &compositions[it->first];
}

static void forget_shown(void)
{
    resident_destroy(shown.resident);
    shown.resident = NULL;
    shown.owner = NULL;
}

static struct resident *show(const struct seen_case *it, const struct view *view)
{
    if (shown.owner != owner_of(it) || shown.stage != it->stage) {
        forget_shown();
        shown.owner = owner_of(it);
        shown.stage = it->stage;
        renderer_use_stage(renderer, it->stage);
        shown.revision = 1;
        shown.resident = resident_create(renderer, scene_of(it, &near_view, true), 1);
        while (renderer_is_trying(renderer)) {
            renderer_poll(renderer, 0);
        }
    }
    const uint64_t structure = resident_structure_hash(shown.resident);
    resident_replace(shown.resident, scene_of(it, view, false), ++shown.revision);
    assert_true(resident_structure_hash(shown.resident) == structure);
    return shown.resident;
}

static double scale_now; /* of the view that is judged */

static bool is_near(const struct oracle_found *found, double depth, double footprint)
{
    (void)footprint;
    return fabs(depth - found->t) <= DEPTH_ROOM * scale_now;
}

static bool is_near_creases(const struct oracle_found *found, double depth, double footprint)
{
    return fabs(depth - found->t) <= CREASED_ROOM * footprint;
}

static bool is_creased(const struct seen_case *it)
{
    return it->type && it->type->creased;
}

static struct oracle *ask_oracle(const struct seen_case *it, const struct view *view)
{
    struct scene *scene = scene_of(it, view, false);
    const bool creased = is_creased(it);
    const int every = creased ? CREASED_EVERY : 1;
    struct oracle *oracle = oracle_create(
        scene, &(struct oracle_params){.width = WIDTH / every,
                                       .height = HEIGHT / every,
                                       .every = every,
                                       .tolerance = TOLERANCE * view->scale,
                                       .gradient = GRADIENT * view->scale,
                                       .end_of_sight = 0.9,
                                       .degrees = creased ? CREASED_DEGREES : 5,
                                       .inner_only = true,
                                       .is_near = creased ? is_near_creases : is_near});

    scale_now = view->scale;
    scene_destroy(scene);
    return oracle;
}

/* Whether the picture of one is what the oracle says of the other, mostly the same. */
static bool is_seen_as(const struct seen_case *drawn, const struct seen_case *asked,
                       const struct view *view)
{
    struct oracle *oracle = ask_oracle(asked, view);
    const struct oracle_tally tally = oracle_judge(oracle, renderer, show(drawn, view));
    const int every = is_creased(asked) ? CREASED_EVERY : 1;
    char name[200];

    oracle_destroy(oracle);
    snprintf(name, sizeof name, "%s, %s", drawn->name, view->name);
    if (tally.either < WIDTH * HEIGHT / (every * every) / 400) {
        fail_msg("%s: only %d pixels are covered", name, tally.either);
    }
    return oracle_agrees(name, &tally, is_creased(asked) ? &creased_bounds : &smooth_bounds, wordy);
}

static void case_is_seen_as_it_says(void **state)
{
    const struct seen_case *it = *state;
    bool good = is_seen_as(it, it, &near_view);

    if (it->second) {
        good = is_seen_as(it, it, it->second) && good;
    }
    assert_true(good);
    assert_true(it->stage != RENDER_COMPUTE || renderer_counters(renderer).compilations > 0);
}

/* --- */

static struct seen_case cases[CASES_MAX];
static size_t case_count;

static struct seen_case *find_case(const char *name)
{
    for (size_t i = 0; i < case_count; i++) {
        if (strcmp(cases[i].name, name) == 0) {
            return &cases[i];
        }
    }
    fail_msg("%s: no such case", name);
    return NULL;
}

/* A function whose bound holds in its box alone is the torus that its formula means. */
static void a_quartic_is_a_torus(void **state)
{
    (void)state;
    assert_true(
        is_seen_as(find_case("quartic torus"), find_case("torus of that quartic"), &near_view));
}

static void another_scene_is_noticed(void **state)
{
    (void)state;
    assert_false(is_seen_as(find_case("ellipsoid"), find_case("sphere"), &near_view));
}

/* How many from `first` on share a program. */
static size_t batch_length(size_t first)
{
    size_t count = 1;

    while (count < BATCH && first + count < composition_count && !compositions[first].alone &&
           !compositions[first + count].alone) {
        count++;
    }
    return count;
}

static struct seen_case *add_case(const char *name, enum render_stage stage)
{
    assert(case_count < CASES_MAX);
    struct seen_case *it = &cases[case_count++];
    it->stage = stage;
    snprintf(it->name, sizeof it->name, "%s%s", name, stage == RENDER_COMPUTE ? ", computed" : "");
    return it;
}

static void add_batches(size_t end, enum render_stage stage)
{
    for (size_t first = 0, count; first < end; first += count) {
        count = batch_length(first);
        for (size_t i = first; i < first + count; i++) {
            struct seen_case *it = add_case(compositions[i].name, stage);
            it->composition = &compositions[i];
            it->first = first;
            it->count = count;
        }
    }
}

static void list_cases(void)
{
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        add_case(type->record.name, RENDER_ENGINE)->type = type;
    }
    add_batches(composition_count, RENDER_ENGINE);
    add_batches(COMPUTED, RENDER_COMPUTE);
    for (size_t i = 0; i < case_count; i++) {
        const struct composition *composition = cases[i].composition;
        const size_t view = composition ? FIRST_VIEW + (size_t)(composition - compositions) : i;
        cases[i].second = composition && composition->inside ? NULL : &views[view % VIEWS];
    }
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
    forget_shown();
    renderer_destroy(renderer);
    return 0;
}

/* An argument, as "*torus*", chooses cases, and all figures are printed. */
int main(int argc, char **argv)
{
    static struct CMUnitTest tests[CASES_MAX + 2];
    size_t n = 0;

    list_cases();
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(another_scene_is_noticed);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(a_quartic_is_a_torus);
    for (size_t i = 0; i < case_count; i++) {
        tests[n++] =
            (struct CMUnitTest){cases[i].name, case_is_seen_as_it_says, NULL, NULL, &cases[i]};
    }
    if (argc > 1) {
        cmocka_set_test_filter(argv[1]);
        wordy = true;
    }
    return _cmocka_run_group_tests("seen", tests, n, start, stop);
}
