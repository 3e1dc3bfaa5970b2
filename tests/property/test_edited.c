/* SPDX-License-Identifier: MIT */
/* Pictures after edits, of which the engine draws but what may have changed, have the bytes of
 * those that are drawn as the first of their scene. EDITED_EDITS: how many edits there are, of
 * pictures of half the width and height: 10,000 take some ten minutes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "tests/support/drawing.h"
#include "tests/support/json_text.h"
#include "tests/support/numeric_edit.h"

enum { WIDTH = 76, HEIGHT = 60, EDITS = 36, EDITS_OF_A_LIFE = 6, SCATTERED = 160 };
enum { MANY = 1000, FEW = 30, MOVES = 3, LARGER = 4 };

/* The other one forgets what it knows before each picture. */
static struct renderer *renderer, *forgetful;

/* A scene in both. */
struct pair {
    struct resident *kept, *forgotten;
};

/* --- scenes --- */

#define BESIDE                                                                                     \
    "{'format':'fieldcast/1','camera':{'position':[0,3,7],'target':[0,0,0]},"                      \
    "'render':{'max_distance':60},"                                                                \
    "'lights':[{'id':'sun','type':'directional','direction':[-0.5,-1,-0.3]},"                      \
    "{'id':'lamp','type':'point','position':[2,3,2],'intensity':9}],"                              \
    "'materials':{'m0':{'shader':'phong'},'m1':{'shader':'checker'},"                              \
    "'m2':{'shader':'standard','properties':{'metallic':1,'base_color':[0.8,0.7,0.5]}},"           \
    "'m3':{'shader':'standard','properties':{'transmission':0.8}}},"

/* Many small shapes on a plane, of the first materials; the third one is metal. */
static void write_scattered(struct random *random, FILE *out, int count, size_t materials)
{
    const double size = 2.5 / sqrt(count);

    static const char *const types[] = {"sphere", "box", "torus", "capsule"};

    fputs("'root':{'id':'root','type':'union','children':[{'id':'floor','type':'plane'}", out);
    for (int i = 0; i < count; i++) {
        fprintf(out,
                ",{'id':'s%d','type':'%s','material':'m%d','transform':{'translation':"
                "[%.3f,%.3f,%.3f],'scale':[%.3f,%.3f,%.3f]}}",
                i, types[random_below(random, 4)], (int)random_below(random, materials),
                random_between(random, -3, 3), random_between(random, 0, 0.6),
                random_between(random, -3, 3), size, size, size * random_between(random, 0.5, 1.5));
    }
    fputs("]}}", out);
}

/* Of all types: repeats and mirrors, blends and cuts. */
static void write_kinds(struct random *random, FILE *out)
{
    const struct random_limits limits = {.depth = 2, .lean = true, .inner = true};

    fputs("'root':{'id':'root','type':'union','children':[", out);
    for (int i = 0; i < 24; i++) {
        const struct node_type *type;
        do {
            type = node_type_at(random_below(random, node_type_count()));
        } while (type->kind == KIND_CODE || type->kind == KIND_MODEL || type->kind == KIND_FLAT ||
                 type->kind == KIND_EQUATION);
        fputs(i > 0 ? "," : "", out);
        fprintf(out,
                "{'id':'g%d','type':'group','material':'m%d','transform':{'translation':"
                "[%.3f,0,%.3f],'scale':[0.35,0.35,0.35]},'children':[",
                i, i % 4, i % 6 - 2.5, i / 6 - 1.5);
        random_node(random, out, type, &limits);
        fputs("]}", out);
    }
    fputs("]}}", out);
}

static struct scene *make_scene(struct random *random, size_t life)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    fputs(BESIDE, out);
    if (life % 3 == 1) {
        write_kinds(random, out);
    } else {
        write_scattered(random, out, SCATTERED, 3);
    }
    assert_int_equal(fclose(out), 0);
    struct scene *scene = life % 6 == 5 ? drawing_read(DRAWING_RICH) : json_text_valid_scene(text);
    free(text);
    return scene;
}

/* --- edits --- */

static cJSON *parse(const char *format, ...) __attribute__((format(printf, 1, 2)));
static cJSON *parse(const char *format, ...)
{
    char text[300];
    struct error err = {0};
    va_list arguments;

    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (int i = 0; i < length; i++) {
        text[i] = text[i] == '\'' ? '"' : text[i];
    }
    cJSON *ops = json_parse(text, (size_t)length, &err);
    assert_non_null(ops);
    return ops;
}

static const struct node *any_child(struct random *random, const struct scene *scene)
{
    return scene->root->children[random_below(random, scene->root->child_count)];
}

/* Something small goes a small way, mostly; numbers, materials, the camera and the floor; lights;
 * what is seen; nodes that come and go. */
static cJSON *random_ops(struct random *random, const struct scene *scene, int number)
{
    const struct node *node = any_child(random, scene);
    const double *at = record_vector(&node->transform, "translation");
    const size_t what = random_below(random, 16);

    if (what < 5) {
        return parse(
            "[{'op':'set','at':'/nodes/%s/transform/translation','value':[%.9g,%.9g,%.9g]}]",
            node->id, at[0] + random_between(random, -0.1, 0.1), at[1],
            at[2] + random_between(random, -0.1, 0.1));
    }
    if (what < 8 && scene->materials.count == 4) { /* not of the other scene's */
        return parse("[{'op':'set','at':'/materials/m2/properties/roughness','value':%.3f}]",
                     random_between(random, 0, 1));
    }
    if (what == 8) {
        return parse("[{'op':'set','at':'/lights/%s/intensity','value':%.3f}]",
                     scene->lights.items[0]->name, random_between(random, 1, 5));
    }
    if (what == 9) {
        return parse("[{'op':'set','at':'/nodes/%s/visible','value':%s}]", node->id,
                     record_number(&node->common, "visible") != 0 ? "false" : "true");
    }
    if (what == 10) {
        return parse("[{'op':'insert','into':'/nodes/%s','before':null,'value':{'id':'new%d',"
                     "'type':'sphere','transform':{'translation':[0,%.3f,0],'scale':0.4}}}]",
                     scene->root->id, number, random_between(random, -1, 1));
    }
    if (what == 11) {
        return parse("[{'op':'remove','at':'/nodes/%s'}]", node->id);
    }
    if (what < 14) { /* far away, so that another place is looked at */
        return parse(
            "[{'op':'set','at':'/nodes/%s/transform/translation','value':[%.9g,%.9g,%.9g]}]",
            node->id, random_between(random, -2, 2), at[1], random_between(random, -2, 2));
    }
    return numeric_edit(random, scene, what == 14);
}

/* --- pictures --- */

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
    assert_int_equal(renderer_counters(forgetful).pixels, all);
    assert_same(&got, &want, ops);
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
        struct scene *scene = make_scene(&random, life);
        const struct pair pair = {resident_create(renderer, scene_copy(scene), 1),
                                  resident_create(forgetful, scene, 1)};
        bool goes = true;
        for (int k = 0; k < EDITS_OF_A_LIFE && goes; k++, i++) {
            cJSON *ops = random_ops(&random, resident_scene(pair.kept), k);
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

static struct pair scattered(struct random *random, int count, const struct job_desc *desc)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    fputs(BESIDE, out);
    write_scattered(random, out, count, 2);
    assert_int_equal(fclose(out), 0);
    struct scene *scene = json_text_valid_scene(text);
    const struct pair pair = {resident_create(renderer, scene_copy(scene), 1),
                              resident_create(forgetful, scene, 1)};
    free(text);
    check(&pair, desc, NULL);
    return pair;
}

/* Answers which part of the pixels was drawn. */
static double go(const struct pair *pair, const struct job_desc *desc, const struct node *node,
                 double right, double up)
{
    const double *at = record_vector(&node->transform, "translation");
    cJSON *ops =
        parse("[{'op':'set','at':'/nodes/%s/transform/translation','value':[%.9g,%.9g,%.9g]}]",
              node->id, at[0] + right, at[1] + up, at[2]);

    assert_true(edit(pair, ops));
    const double part = check(pair, desc, ops);
    print_message("%.3f of the pixels were drawn\n", part);
    cJSON_Delete(ops);
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
        const struct node *node = any_child(&random, resident_scene(pair.kept));
        assert_true(go(&pair, &desc, node, 0.008, 0) <= 0.2);
    }
    resident_destroy(pair.kept);
    resident_destroy(pair.forgotten);
}

/* Few have some outermost one nearly always. */
static void a_move_of_the_bounds_draws_little(void **state)
{
    (void)state;
    struct random random = {83};
    struct job_desc desc = desc_of(0);

    desc.width *= LARGER;
    desc.height *= LARGER;
    const struct pair pair = scattered(&random, FEW, &desc);
    for (int i = 0; i < MOVES; i++) {
        const struct node *node = highest(resident_scene(pair.kept));
        assert_true(go(&pair, &desc, node, 0, 0.01) <= 0.6);
    }
    resident_destroy(pair.kept);
    resident_destroy(pair.forgotten);
}

/* So does a small shape that comes, is hidden, and goes. */
static void a_shape_more_or_less_draws_little(void **state)
{
    static const char *const edits[] = {
        "[{'op':'insert','into':'/nodes/root','before':null,'value':{'id':'new','type':'sphere',"
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
        cJSON *ops = parse("%s", edits[i]);
        assert_true(edit(&pair, ops));
        assert_true(check(&pair, &desc, ops) <= 0.2);
        cJSON_Delete(ops);
    }
    resident_destroy(pair.kept);
    resident_destroy(pair.forgotten);
}

static int set_up(void **state)
{
    const struct renderer_params params = {.device = {.kind = DEVICE_NONE, .index = -1},
                                           .stage = RENDER_ENGINE,
                                           .threads = 2,
                                           .tile_side = 56};
    struct error err = {0};

    (void)state;
    renderer = renderer_create(&params, &err);
    forgetful = renderer_create(&params, &err);
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
        cmocka_unit_test(a_small_move_draws_little),
        cmocka_unit_test(a_move_of_the_bounds_draws_little),
        cmocka_unit_test(a_shape_more_or_less_draws_little),
    };

    return cmocka_run_group_tests_name("pictures after edits", tests, set_up, tear_down);
}
