/* SPDX-License-Identifier: MIT */
/* Pictures after edits, of which the engine draws but what may have changed, have the bytes of
 * those that are drawn as the first of their scene. EDITED_EDITS: how many edits there are, of
 * pictures of half the width and height: 10,000 take some ten minutes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "tests/support/drawing.h"
#include "tests/support/edited_scene.h"
#include "tests/support/edits.h"
#include "tests/support/json_text.h"

enum { WIDTH = 76, HEIGHT = 60, EDITS = 36, EDITS_OF_A_LIFE = 6, SCATTERED = 160 };
enum {
    MANY = 1000,
    TWISTED = 1000,
    FEW = 30,
    APART = 8,
    OTHERS = 2048,
    MOVES = 3,
    LARGER = 4,
    EDITS_OF_MANY = 24,
    REMOVED = 60,
    PAUSES_EVERY = 11 /* times that it is asked for */
};

/* The other one forgets what it knows before each picture, and never pauses. */
static struct renderer *renderer, *forgetful;

/* A scene in both. */
struct pair {
    struct resident *kept, *forgotten;
};

static struct job_desc desc_of(size_t life)
{
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);

    desc.level = life % 4 == 3 ? QUALITY_STILL : QUALITY_INTERACTIVE;
    desc.samples = life % 4 == 3 ? 2 : 1;
    desc.sparse = life % 2;
    desc.aovs[AOV_COLOR] = true;
    if (life % 2 == 0) {
        desc.aovs[AOV_DEPTH] = desc.aovs[AOV_NORMAL] = desc.aovs[AOV_STEPS] = true;
        desc.aovs[AOV_OCCLUSION] = true;
        desc.as_floats = true;
    }
    return desc;
}

static void assert_same(const struct drawing *got, const struct drawing *want, const cJSON *ops)
{
    for (int aov = 0; aov < AOV_COUNT; aov++) {
        if (!drawing_is_same(&got->of[aov], &want->of[aov])) {
            char *text = json_print(ops, false);
            fail_msg("%s differs after %s", aov_name((enum aov)aov), text);
        }
    }
}

/* Draws it again after an edit; answers which part of the pixels was drawn. */
static double check(const struct pair *pair, const struct job_desc *desc, const cJSON *ops)
{
    const uint64_t before = renderer_counters(renderer).pixels;
    const uint64_t pixels = (uint64_t)desc->width * (uint64_t)desc->height;
    const uint64_t all = renderer_counters(forgetful).pixels + pixels;
    struct drawing got = drawing_outputs(renderer, pair->kept, desc);
    const uint64_t drawn = renderer_counters(renderer).pixels - before;

    renderer_forget(forgetful);
    struct drawing want = drawing_outputs(forgetful, pair->forgotten, desc);
    /* On a slow machine a row may be begun again, and then more is drawn than there is. */
    assert_true(renderer_counters(forgetful).pixels >= all);
    assert_same(&got, &want, ops);
    assert_true(got.drawn_part * (double)pixels < (double)drawn + 0.5);
    drawing_finish(&got);
    drawing_finish(&want);
    return (double)drawn / (double)pixels;
}

/* False: it was refused, or nothing can be drawn any more. */
static bool edit(const struct pair *pair, const cJSON *ops)
{
    const uint64_t revision = resident_revision(pair->kept) + 1;
    struct error err = {0};

    return resident_edit(pair->kept, ops, revision, &err) &&
           resident_edit(pair->forgotten, ops, revision, &err) &&
           resident_error(pair->kept)->kind == ERROR_NONE &&
           resident_scene(pair->kept)->root->child_count > 0;
}

/* An edit that has to go, and its picture. Takes `ops`; answers which part of it was drawn. */
static double follow(const struct pair *pair, const struct job_desc *desc, cJSON *ops)
{
    assert_true(edit(pair, ops));
    const double part = check(pair, desc, ops);
    cJSON_Delete(ops);
    return part;
}

static void edits_change_what_they_have_to(void **state)
{
    (void)state;
    const char *asked = getenv("EDITED_EDITS");
    const size_t edits = asked ? (size_t)atoi(asked) : EDITS;
    struct random random = {81};
    size_t less = 0;

    for (size_t i = 0, life = 0; i < edits; life++) {
        struct job_desc desc = desc_of(life);
        desc.width /= asked ? 2 : 1;
        desc.height /= asked ? 2 : 1;
        struct scene *scene = edited_scene(&random, life, SCATTERED);
        const struct pair pair = {resident_create(renderer, scene_copy(scene), 1),
                                  resident_create(forgetful, scene, 1)};
        bool goes = true;
        for (int k = 0; k < EDITS_OF_A_LIFE && goes; k++, i++) {
            cJSON *ops = edited_scene_ops(&random, resident_scene(pair.kept), k);
            goes = edit(&pair, ops);
            less += goes && check(&pair, &desc, ops) < 1;
            cJSON_Delete(ops);
        }
        resident_destroy(pair.kept);
        resident_destroy(pair.forgotten);
    }
    print_message("%zu of %zu pictures were drawn in part\n", less, edits);
    assert_true(less > edits / 5);
}

/* The one that the scene's bounds depend on. */
static const struct node *highest(const struct scene *scene)
{
    const struct node *best = scene->root->children[0];

    for (size_t i = 1; i < scene->root->child_count; i++) {
        const struct node *node = scene->root->children[i];
        if (record_vector(&node->transform, "translation")[1] >
            record_vector(&best->transform, "translation")[1]) {
            best = node;
        }
    }
    return best;
}

/* Draws it once. */
static struct pair pair_of(struct scene *scene, const struct job_desc *desc)
{
    const struct pair pair = {resident_create(renderer, scene_copy(scene), 1),
                              resident_create(forgetful, scene, 1)};

    check(&pair, desc, NULL);
    return pair;
}

static struct pair scattered(struct random *random, int count, const struct job_desc *desc)
{
    return pair_of(edited_scene_scattered(random, count, 2), desc);
}

/* The first ones and the floor go, so that all others have other places on tapes, and matter. */
static cJSON *removal(int count)
{
    char text[4096] = "[{'op':'remove','at':'/nodes/floor'}";
    size_t length = strlen(text);

    for (int i = 0; i < count; i++) {
        length += (size_t)snprintf(text + length, sizeof text - length,
                                   ",{'op':'remove','at':'/nodes/s%d'}", i);
        assert_true(length < sizeof text - 1);
    }
    snprintf(text + length, sizeof text - length, "]");
    return edits_parse(text);
}

/* Long tapes are not run whole after an edit (engine/checkpoints.c): what a place is asked for is
 * what the operations before and behind it give. */
static void edits_of_many_shapes_change_what_they_have_to(void **state)
{
    (void)state;
    struct random random = {85};
    struct job_desc desc = desc_of(0);

    desc.width /= 2;
    desc.height /= 2;
    const struct pair pairs[] = {scattered(&random, MANY, &desc),
                                 pair_of(edited_scene_twisted(&random, TWISTED, 2), &desc)};

    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        for (int k = 0; k < EDITS_OF_MANY; k++) {
            cJSON *ops = k == 0 ? removal(REMOVED)
                                : edited_scene_ops(&random, resident_scene(pairs[i].kept), k);
            follow(&pairs[i], &desc, ops);
        }
        resident_destroy(pairs[i].kept);
        resident_destroy(pairs[i].forgotten);
    }
}

/* No shape has changed, but all are elsewhere. */
static void a_moved_mirror_moves_what_is_in_it(void **state)
{
    (void)state;
    struct random random = {86};
    struct job_desc desc = desc_of(0);

    desc.width /= 2;
    desc.height /= 2;
    const struct pair pair = pair_of(edited_scene_mirrored(&random, MANY, 2), &desc);
    static const double to[][2] = {{2, -1}, {-1.5, 1}, {0, 2.5}, {0, 0}};
    for (size_t i = 0; i < sizeof to / sizeof to[0]; i++) {
        cJSON *ops = edits_format(
            "[{'op':'set','at':'/nodes/mirror/transform/translation','value':[%.9g,0,%.9g]}]",
            to[i][0], to[i][1]);
        follow(&pair, &desc, ops);
    }
    resident_destroy(pair.kept);
    resident_destroy(pair.forgotten);
}

/* Balls that are not seen, so that an edit changes few of all operations. */
static void write_far_off(char out[OTHERS])
{
    for (int i = 0; i < FEW; i++) {
        const size_t length = strlen(out);
        snprintf(out + length, OTHERS - length,
                 "%s{'type':'sphere','transform':{'translation':[%d,0,-90]}}", i > 0 ? "," : "", i);
    }
}

/* Deep in the box both take the second operand alone, but one negates it. What was seen from below
 * is seen from above. */
static void an_intersection_becomes_a_difference(void **state)
{
    static const char scene[] =
        "{'format':'fieldcast/1','camera':{'position':[0,-40,1],'target':[0,-10,0]},"
        "'lights':[{'id':'sun','type':'directional','direction':[-0.5,-1,-0.3]}],"
        "'root':{'id':'root','type':'union','children':[{'id':'cut','type':'%s','children':["
        "{'type':'box','params':{'size':[40,40,40]},'transform':{'translation':[0,-19,0]}},"
        "{'type':'union','children':[%s]}]},"
        "{'type':'union','children':[%s]}]}}";
    static const char holes[] =
        "{'type':'cylinder','params':{'radius':3,'height':30}},"
        "{'type':'cylinder','params':{'radius':3,'height':30},'transform':{'translation':[1,0,0]}},"
        "{'type':'cylinder','params':{'radius':3,'height':30},'transform':{'translation':[0,0,1]}}";
    static const char *const types[] = {"difference", "intersection", "difference"};
    char others[OTHERS] = "", text[4096];
    struct job_desc desc = desc_of(0);

    (void)state;
    write_far_off(others);
    snprintf(text, sizeof text, scene, "intersection", holes, others);
    const struct pair pair = pair_of(json_text_valid_scene(text), &desc);
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        cJSON *ops = edits_format("[{'op':'set','at':'/nodes/cut/type','value':'%s'},"
                                  "{'op':'set','at':'/camera/position','value':[0,%d,1]}]",
                                  types[i], i % 2 ? -40 : 40);
        follow(&pair, &desc, ops);
    }
    resident_destroy(pair.kept);
    resident_destroy(pair.forgotten);
}

/* As an intersection the two balls are so far from the floor that tapes leave both out; as parts of
 * the union the first one rises from the floor, and the second is left out at the same place. */
static void an_intersection_becomes_a_union(void **state)
{
    static const char scene[] =
        "{'format':'fieldcast/1','camera':{'position':[0,4,6],'target':[0,0,0]},"
        "'lights':[{'id':'sun','type':'directional','direction':[-0.5,-1,-0.3]}],"
        "'root':{'id':'root','type':'union','children':[{'type':'plane'},%s,"
        "{'id':'both','type':'intersection','children':["
        "{'type':'sphere','params':{'radius':0.7}},{'type':'sphere','params':{'radius':0.3},"
        "'transform':{'translation':[0,%g,0]}}]}]}}";
    char others[OTHERS] = "", text[4096];
    struct job_desc desc = desc_of(0);

    (void)state;
    write_far_off(others);
    for (int i = 0; i < APART; i++) {
        snprintf(text, sizeof text, scene, others, 1 + 0.2 * i);
        const struct pair pair = pair_of(json_text_valid_scene(text), &desc);
        follow(&pair, &desc,
               edits_format("[{'op':'set','at':'/nodes/both/type','value':'union'}]"));
        resident_destroy(pair.kept);
        resident_destroy(pair.forgotten);
    }
}

/* Answers which part of the pixels was drawn. */
static double go(const struct pair *pair, const struct job_desc *desc, const struct node *node,
                 double right, double up)
{
    const double *at = record_vector(&node->transform, "translation");
    cJSON *ops = edits_format(
        "[{'op':'set','at':'/nodes/%s/transform/translation','value':[%.9g,%.9g,%.9g]}]", node->id,
        at[0] + right, at[1] + up, at[2]);

    const double part = follow(pair, desc, ops);
    print_message("%.3f of the pixels were drawn\n", part);
    return part;
}

/* One of many goes by a tenth of its size. */
static void a_small_move_draws_little(void **state)
{
    (void)state;
    struct random random = {82};
    struct job_desc desc = desc_of(0);

    desc.width *= LARGER;
    desc.height *= LARGER;
    const struct pair pair = scattered(&random, MANY, &desc);
    for (int i = 0; i < MOVES; i++) {
        const struct node *node = edited_scene_child(&random, resident_scene(pair.kept));
        assert_true(go(&pair, &desc, node, 0.008, 0) <= 0.2);
    }
    resident_destroy(pair.kept);
    resident_destroy(pair.forgotten);
}

/* The outermost one is lifted: of few shapes nearly each one is the outermost on some side. */
static void lift(int count, double most)
{
    struct random random = {83};
    struct job_desc desc = desc_of(0);

    desc.width *= LARGER;
    desc.height *= LARGER;
    const struct pair pair = scattered(&random, count, &desc);
    for (int i = 0; i < MOVES; i++) {
        const struct node *node = highest(resident_scene(pair.kept));
        assert_true(go(&pair, &desc, node, 0, 0.01) <= most);
    }
    resident_destroy(pair.kept);
    resident_destroy(pair.forgotten);
}

static void a_move_of_the_bounds_draws_little(void **state)
{
    (void)state;
    lift(FEW, 0.6);
    lift(MANY, 0.2);
}

/* So does a small shape that comes, is hidden, and goes. */
static void a_shape_more_or_less_draws_little(void **state)
{
    static const char *const edits[] = {
        "[{'op':'insert','into':'/nodes/shapes','before':null,'value':{'id':'new','type':'sphere',"
        "'transform':{'translation':[0.3,0.2,0.4],'scale':0.05}}}]",
        "[{'op':'set','at':'/nodes/new/visible','value':false}]",
        "[{'op':'set','at':'/nodes/new/visible','value':true}]",
        "[{'op':'remove','at':'/nodes/new'}]",
    };
    struct random random = {84};
    struct job_desc desc = desc_of(0);

    (void)state;
    desc.width *= LARGER;
    desc.height *= LARGER;
    const struct pair pair = scattered(&random, MANY, &desc);
    for (size_t i = 0; i < sizeof edits / sizeof edits[0]; i++) {
        cJSON *ops = edits_parse(edits[i]);
        assert_true(follow(&pair, &desc, ops) <= 0.2);
    }
    resident_destroy(pair.kept);
    resident_destroy(pair.forgotten);
}

/* Rays of so many shapes take other steps: far from surfaces, by bounds. */
static void a_shape_more_changes_the_steps(void **state)
{
    struct random random = {85};
    const struct job_desc desc = desc_of(0);

    (void)state;
    for (int count = 22; count < 27; count++) {
        const struct pair pair = scattered(&random, count, &desc);
        follow(&pair, &desc,
               edits_format("[{'op':'insert','into':'/nodes/shapes','before':null,'value':{"
                            "'type':'sphere','transform':{'scale':0.05}}}]"));
        resident_destroy(pair.kept);
        resident_destroy(pair.forgotten);
    }
}

/* Pauses come in the middle of parts of tiles. */
static bool is_wanted(void *data)
{
    static atomic_uint asked;

    (void)data;
    return atomic_fetch_add(&asked, 1) % PAUSES_EVERY == 0;
}

static int set_up(void **state)
{
    struct renderer_params params = {.device = {.kind = DEVICE_NONE, .index = -1},
                                     .stage = RENDER_ENGINE,
                                     .threads = 2,
                                     .tile_side = 56};
    struct error err = {0};

    (void)state;
    forgetful = renderer_create(&params, &err);
    params.is_wanted = is_wanted;
    renderer = renderer_create(&params, &err);
    return renderer && forgetful ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    renderer_destroy(forgetful);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edits_change_what_they_have_to),
        cmocka_unit_test(edits_of_many_shapes_change_what_they_have_to),
        cmocka_unit_test(a_moved_mirror_moves_what_is_in_it),
        cmocka_unit_test(an_intersection_becomes_a_difference),
        cmocka_unit_test(an_intersection_becomes_a_union),
        cmocka_unit_test(a_small_move_draws_little),
        cmocka_unit_test(a_move_of_the_bounds_draws_little),
        cmocka_unit_test(a_shape_more_or_less_draws_little),
        cmocka_unit_test(a_shape_more_changes_the_steps),
    };

    return cmocka_run_group_tests_name("pictures after edits", tests, set_up, tear_down);
}
