/* SPDX-License-Identifier: MIT */
/* Hidden nodes, and those beside isolated ones, are numbers: a field with them is the field of the
 * document without them, to the last bit in C and within the usual tolerance in GLSL, and has the
 * shape of the one that shows them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "renderer/field/shader.h"
#include "tests/support/compiled.h"
#include "tests/support/json_text.h"
#include "tests/support/probe.h"
#include "tests/support/random_scene.h"

enum { POINTS = 60, FIELDS_MAX = 4, GLSL_POINTS = 256, LOOPS_MAX = 65535 / 2 / FIELDS_MAX };
#define SIZE 4.0
#define TOLERANCE (1e-4 * SIZE)

/* --- documents without what is hidden --- */

static bool is_hidden(const cJSON *node)
{
    return cJSON_IsFalse(cJSON_GetObjectItemCaseSensitive(node, "visible"));
}

static cJSON *empty_group(void)
{
    cJSON *group = cJSON_CreateObject();

    cJSON_AddStringToObject(group, "type", "group");
    return group;
}

/* Of two operands, what is hidden keeps its place. */
static void cut_to_operands(const cJSON *node, cJSON *children)
{
    const char *type = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(node, "type"));

    while (strcmp(type, "morph") == 0 && cJSON_GetArraySize(children) > 2) {
        cJSON_DeleteItemFromArray(children, 2);
    }
}

static void drop_hidden(cJSON *children)
{
    for (int i = cJSON_GetArraySize(children) - 1; i >= 0; i--) {
        if (is_hidden(cJSON_GetArrayItem(children, i))) {
            cJSON_DeleteItemFromArray(children, i);
        }
    }
}

/* A difference without its first is nothing. */
static void prune_children(const cJSON *node, cJSON *children)
{
    const char *type = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(node, "type"));
    const bool of_first = strstr(type, "difference") != NULL;

    cut_to_operands(node, children);
    if (of_first && is_hidden(cJSON_GetArrayItem(children, 0))) {
        cJSON_ReplaceItemInArray(children, 0, empty_group());
    }
    drop_hidden(children);
}

static void prune(cJSON *node)
{
    cJSON *children = cJSON_GetObjectItemCaseSensitive(node, "children"), *child;

    if (children) {
        prune_children(node, children);
        cJSON_ArrayForEach(child, children)
        {
            prune(child);
        }
    }
}

/* Which nodes alone are seen; a count of 0: all. */
struct isolated {
    const char *ids[4];
    size_t count;
};

static bool is_among(const struct isolated *isolated, const char *id)
{
    for (size_t i = 0; i < isolated->count; i++) {
        if (strcmp(isolated->ids[i], id) == 0) {
            return true;
        }
    }
    return false;
}

/* What is around isolated nodes: a shape itself is not seen. */
static void make_frame(cJSON *node)
{
    const struct node_type *type =
        node_type_find(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(node, "type")));

    if (type->kind == KIND_SHAPE || type->kind == KIND_FLAT || type->kind == KIND_CODE) {
        cJSON_ReplaceItemInObjectCaseSensitive(node, "type", cJSON_CreateString("group"));
        cJSON_DeleteItemFromObjectCaseSensitive(node, "params");
    }
}

/* Removes what is neither isolated nor around it; false: the node itself is such. A difference is
 * not nothing then: another operand comes first. */
static bool isolate(cJSON *node, const struct isolated *isolated)
{
    cJSON *children = cJSON_GetObjectItemCaseSensitive(node, "children");
    bool any = false;

    if (is_among(isolated, cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(node, "id")))) {
        return true;
    }
    cut_to_operands(node, children);
    const cJSON *first = cJSON_GetArrayItem(children, 0);
    for (int i = cJSON_GetArraySize(children) - 1; i >= 0; i--) {
        if (isolate(cJSON_GetArrayItem(children, i), isolated)) {
            any = true;
        } else {
            cJSON_DeleteItemFromArray(children, i);
        }
    }
    if (first != cJSON_GetArrayItem(children, 0)) {
        drop_hidden(children);
    }
    make_frame(node);
    return any;
}

/* The root, or a model, whose place in the document has to be taken. */
static void prune_root(cJSON *parent, const char *name)
{
    if (is_hidden(cJSON_GetObjectItemCaseSensitive(parent, name))) {
        cJSON_ReplaceItemInObjectCaseSensitive(parent, name, empty_group());
    }
    prune(cJSON_GetObjectItemCaseSensitive(parent, name));
}

static struct scene *pruned(const struct scene *scene, const struct isolated *isolated)
{
    cJSON *document = scene_to_json(scene);
    cJSON *models = cJSON_GetObjectItemCaseSensitive(document, "models");

    if (isolated->count > 0 &&
        !isolate(cJSON_GetObjectItemCaseSensitive(document, "root"), isolated)) {
        fail_msg("nothing is isolated");
    }
    for (size_t i = 0; i < scene->models.count; i++) {
        prune_root(models, scene->models.items[i]->name);
    }
    prune_root(document, "root");
    struct error err = {0};
    struct scene *out = scene_read(document, &err);
    if (!out) {
        fail_msg("%s: %s", err.place, err.message);
    }
    cJSON_Delete(document);
    return out;
}

/* --- comparison --- */

static const struct isolated none = {.count = 0};

static struct field *compile_after(const struct scene *scene, const struct field *drawn,
                                   const struct isolated *isolated)
{
    struct error err = {0};
    const struct field_options options = {
        .drawn = drawn, .isolated = isolated->ids, .isolated_count = isolated->count};
    struct field *field = field_compile_as(scene, &options, &err);

    if (!field) {
        fail_msg("%s: %s", err.place, err.message);
    }
    return field;
}

static void assert_same_text(const char *a, const char *b)
{
    if (a == b) {
        return;
    }
    assert_non_null(a);
    assert_non_null(b);
    assert_string_equal(a, b);
}

/* Numbers of leaves count what is hidden, so their ids are compared. */
static void assert_same_at(const struct scene *scene, const struct field *a, const struct field *b,
                           const double p[3])
{
    const double got = field_distance(a, p), want = field_distance(b, p);

    if (got != want) {
        fail_msg("%.17g instead of %.17g at %g %g %g\n%s", got, want, p[0], p[1], p[2],
                 root_text(scene));
    }
    struct field_surface sa = field_surface(a, p, NULL), sb = field_surface(b, p, NULL);
    assert_true(sa.distance == sb.distance);
    assert_memory_equal(sa.material, sb.material, sizeof sa.material);
    assert_same_text(field_leaf_id(a, sa.number), field_leaf_id(b, sb.number));
}

static void assert_same_box(const struct bounds *a, const struct bounds *b)
{
    assert_memory_equal(a->low, b->low, sizeof a->low);
    assert_memory_equal(a->high, b->high, sizeof a->high);
}

static void assert_same_field(struct random *random, const struct scene *scene,
                              const struct field *a, const struct field *b)
{
    assert_same_box(&a->bounds, &b->bounds);
    assert_int_equal(a->transmissive, b->transmissive);
    if (a->transmissive) {
        assert_same_box(&a->transmissive_bounds, &b->transmissive_bounds);
    }
    for (int i = 0; i < POINTS; i++) {
        double p[3];
        for (int j = 0; j < 3; j++) {
            p[j] = random_between(random, -SIZE, SIZE);
        }
        assert_same_at(scene, a, b, p);
    }
}

static void show(struct node *node, bool visible)
{
    struct value *value = &node->common.values[record_type_find(node->common.type, "visible")];

    value->number[0] = visible;
    value->set = true;
}

/* One in `one_of` nodes. */
static void hide_some(struct random *random, struct node *root, size_t one_of)
{
    for (struct node *node = root; node; node = node_next(node, root)) {
        show(node, random_below(random, one_of) != 0);
    }
}

/* With hidden nodes in the program of `drawn`. */
static void check_seen(struct random *random, const struct scene *scene, const struct field *drawn,
                       const struct isolated *isolated)
{
    struct scene *less = pruned(scene, isolated);
    struct field *kept = compile_after(scene, drawn, isolated), *want = compile_field(less);

    assert_true(kept->structure_hash == drawn->structure_hash);
    assert_same_field(random, scene, kept, want);
    field_unref(kept);
    field_unref(want);
    scene_destroy(less);
}

/* With hidden nodes in the program of `drawn`, and without them. */
static void check_hidden(struct random *random, const struct scene *scene,
                         const struct field *drawn)
{
    struct scene *less = pruned(scene, &none);
    struct field *left_out = compile_field(scene), *want = compile_field(less);

    check_seen(random, scene, drawn, &none);
    assert_same_field(random, scene, left_out, want);
    field_unref(left_out);
    field_unref(want);
    scene_destroy(less);
}

/* Nodes of the tree by chance; operations have no more operands than they take. */
static struct isolated isolate_some(struct random *random, const struct scene *scene)
{
    struct isolated isolated = {.count = 1 + random_below(random, 3)};

    for (size_t i = 0; i < isolated.count; i++) {
        const struct node *node = scene->root;
        while (node->child_count > 0 && random_below(random, 4)) {
            const size_t among =
                strcmp(node->type->record.name, "morph") == 0 ? 2 : node->child_count;
            node = node->children[random_below(random, among)];
        }
        isolated.ids[i] = node->id;
    }
    return isolated;
}

static void hidden_nodes_are_left_out(void **state)
{
    (void)state;
    struct random random = {31};
    struct random_limits limits = {.depth = 1};

    for (int i = 0; i < 600; i++) {
        const enum node_kind kind = (enum node_kind)(KIND_COMBINE + i % 4);
        limits.depth = 1 + i % 4;
        struct scene *scene = random_scene(&random, random_type(&random, kind, &limits), &limits);
        struct field *drawn = compile_field(scene);
        for (int k = 0; k < 4; k++) {
            hide_some(&random, scene->root, 2 + random_below(&random, 5));
            check_hidden(&random, scene, drawn);
        }
        field_unref(drawn);
        scene_destroy(scene);
    }
}

/* Every operation with every set of its children hidden. */
static void every_set_of_operands_may_be_hidden(void **state)
{
    (void)state;
    struct random random = {32};
    const struct random_limits limits = {.depth = 1};

    enum { OPERANDS = 3 };
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        for (int k = 0; type->kind == KIND_COMBINE && k < 12; k++) {
            struct scene *scene = random_scene(&random, type, &limits);
            struct field *drawn = compile_field(scene);
            for (unsigned set = 0; set < 1u << OPERANDS; set++) {
                for (size_t c = 0; c < scene->root->child_count; c++) {
                    show(scene->root->children[c], !(set >> c & 1));
                }
                check_hidden(&random, scene, drawn);
            }
            field_unref(drawn);
            scene_destroy(scene);
        }
    }
}

static void isolated_nodes_are_alone(void **state)
{
    (void)state;
    struct random random = {35};
    struct random_limits limits = {.depth = 1};

    for (int i = 0; i < 600; i++) {
        const enum node_kind kind = (enum node_kind)(KIND_COMBINE + i % 4);
        limits.depth = 1 + i % 4;
        struct scene *scene = random_scene(&random, random_type(&random, kind, &limits), &limits);
        struct field *drawn = compile_field(scene);
        for (int k = 0; k < 4; k++) {
            const struct isolated isolated = isolate_some(&random, scene);
            hide_some(&random, scene->root, k % 2 ? 6 : 1000000);
            check_seen(&random, scene, drawn, &isolated);
        }
        field_unref(drawn);
        scene_destroy(scene);
    }
}

/* --- what random scenes have not --- */

#define CODE "'type':'field','params':{'code':'float sdf(vec3 p) { return length(p) - 0.4; }'}"
static const char document[] =
    "{'format':'fieldcast/1','environment':{'floor':true,'floor_height':-1},"
    "'materials':{'glass':{'shader':'standard','properties':{'transmission':1}}},"
    "'models':{'pair':{'id':'pair','type':'union','children':["
    "{'id':'ball','type':'sphere','material':'glass'},"
    "{'id':'code'," CODE ",'transform':{'translation':[1,0,0]}}]}},"
    "'root':{'id':'root','type':'union','children':["
    "{'id':'one','type':'model','params':{'model':'pair'}},"
    "{'id':'cut','type':'intersection','children':["
    "{'id':'lens','type':'sphere','transform':{'translation':[0,1.5,0]}},"
    "{'id':'pane','type':'box','material':'glass','transform':{'translation':[0,1,0]}}]},"
    "{'id':'row','type':'repeat','params':{'spacing':[2,2,2],'count':[3,0,0]},'children':["
    "{'id':'two','type':'model','params':{'model':'pair'}},"
    "{'id':'bead','type':'sphere','params':{'radius':0.2}}]},"
    "{'id':'body','type':'torus','material':'glass','transform':{'translation':[0,-1.5,0]},"
    "'children':[{'id':'knob','type':'sphere'}]}]}}";

static void models_code_and_the_floor_are_no_exception(void **state)
{
    (void)state;
    struct random random = {33};
    struct scene *scene = json_text_valid_scene(document);
    struct field *drawn = compile_field(scene);

    for (int i = 0; i < 300; i++) {
        hide_some(&random, scene->root, 4);
        hide_some(&random, scene->models.items[0]->root, 5);
        check_hidden(&random, scene, drawn);
    }
    field_unref(drawn);
    scene_destroy(scene);
}

static uint64_t shape_after(const struct scene *scene, const struct field *drawn)
{
    struct field *field = compile_after(scene, drawn, &none);
    const uint64_t shape = field->structure_hash;

    field_unref(field);
    return shape;
}

static double distance_at(const struct field *field, double x, double y, double z)
{
    const double p[3] = {x, y, z};

    return field_distance(field, p);
}

/* Every instance shows it; an instance shows all of its model; ids that are not there isolate
 * nothing; the floor stays. */
static void nodes_of_models_are_isolated_in_all_instances(void **state)
{
    (void)state;
    struct scene *scene = json_text_valid_scene(document);
    struct field *drawn = compile_field(scene);
    struct field *code = compile_after(scene, drawn, &(struct isolated){{"code"}, 1});
    struct field *two = compile_after(scene, drawn, &(struct isolated){{"two"}, 1});
    struct field *nobody = compile_after(scene, drawn, &(struct isolated){{"nobody"}, 1});
    struct field *rest = compile_after(scene, drawn, &(struct isolated){{"nobody", "pane"}, 2});

    assert_true(fabs(distance_at(code, 1, 0, 0) + 0.4) < 1e-6);
    assert_true(fabs(distance_at(code, 3, 0, 0) + 0.4) < 1e-6);
    assert_true(distance_at(code, 0, 0, 0) > 0.5);
    assert_true(fabs(distance_at(two, 3, 0, 0) + 0.4) < 1e-6);
    assert_true(distance_at(two, 2, 0, 0) < -0.4);
    assert_true(distance_at(nobody, 0.3, 0.2, 0.1) == distance_at(drawn, 0.3, 0.2, 0.1));
    assert_true(fabs(distance_at(rest, 0, 1, 0) + 0.5) < 1e-6);
    assert_true(fabs(distance_at(rest, 0, -1, 0)) < 1e-6);
    assert_true(code->structure_hash == drawn->structure_hash &&
                rest->structure_hash == drawn->structure_hash);
    field_unref(rest);
    field_unref(nobody);
    field_unref(two);
    field_unref(code);
    field_unref(drawn);
    scene_destroy(scene);
}

/* Not in the program: what was hidden before it was made, and what has become something else. */
static void what_was_never_drawn_is_left_out(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene *scene = json_text_valid_scene(document);

    show(scene_find(scene, "cut"), false);
    struct field *drawn = compile_field(scene);
    show(scene_find(scene, "bead"), false);
    assert_true(shape_after(scene, drawn) == drawn->structure_hash);
    show(scene_find(scene, "cut"), true);
    assert_true(shape_after(scene, drawn) != drawn->structure_hash);
    show(scene_find(scene, "cut"), false);

    struct node *code = scene_find(scene, "code");
    show(code, false);
    assert_true(shape_after(scene, drawn) == drawn->structure_hash);
    cJSON *broken = cJSON_CreateString("no code");
    assert_true(
        record_set(&code->params, record_type_find(code->params.type, "code"), broken, "", &err));
    struct field *field = compile_after(scene, drawn, &none);
    assert_int_equal(field->code_count, 0);
    field_unref(field);
    cJSON_Delete(broken);
    field_unref(drawn);
    scene_destroy(scene);
}

/* --- in GLSL --- */

struct batch {
    struct scene *scenes[FIELDS_MAX];
    struct field *drawn[FIELDS_MAX], *kept[FIELDS_MAX];
    size_t count;
};

static void add_scene(struct batch *batch, struct scene *scene)
{
    batch->scenes[batch->count] = scene;
    batch->drawn[batch->count++] = compile_field(scene);
}

static void finish_batch(struct batch *batch)
{
    for (size_t i = 0; i < batch->count; i++) {
        field_unref(batch->drawn[i]);
        scene_destroy(batch->scenes[i]);
    }
    batch->count = 0;
}

static void compare(const struct scene *scene, const struct field *field, const float point[3],
                    const struct probe_answer *answer)
{
    const double p[3] = {point[0], point[1], point[2]};
    const double want = field_distance(field, p);
    const bool empty = want >= FIELD_FAR;

    if (empty ? answer->distance < 1e8f : !(fabs(want - answer->distance) <= TOLERANCE)) {
        fail_msg("%g instead of %g at %g %g %g\n%s", (double)answer->distance, want, p[0], p[1],
                 p[2], root_text(scene));
    }
    if (!empty && !probe_agrees(field, point, answer)) {
        fail_msg("surfaces differ at %g %g %g\n%s", p[0], p[1], p[2], root_text(scene));
    }
}

static void check_round(struct random *random, const struct probe *probe,
                        const struct probe_program *program, struct batch *batch)
{
    static float points[GLSL_POINTS][3];
    static struct probe_answer answers[FIELDS_MAX * GLSL_POINTS];

    for (int i = 0; i < 3 * GLSL_POINTS; i++) {
        points[i / 3][i % 3] = (float)random_between(random, -SIZE, SIZE);
    }
    for (size_t i = 0; i < batch->count; i++) {
        hide_some(random, batch->scenes[i]->root, 2 + random_below(random, 5));
        struct isolated isolated = isolate_some(random, batch->scenes[i]);
        isolated.count *= random_below(random, 2);
        batch->kept[i] = compile_after(batch->scenes[i], batch->drawn[i], &isolated);
        assert_true(batch->kept[i]->structure_hash == batch->drawn[i]->structure_hash);
    }
    probe_run(probe, program, batch->kept, batch->count, points, GLSL_POINTS, answers);
    for (size_t i = 0; i < batch->count * GLSL_POINTS; i++) {
        const size_t field = i / GLSL_POINTS;
        compare(batch->scenes[field], batch->kept[field], points[i % GLSL_POINTS], &answers[i]);
    }
    for (size_t i = 0; i < batch->count; i++) {
        field_unref(batch->kept[i]);
    }
}

static void check_batch(struct random *random, const struct probe *probe, struct batch *batch)
{
    struct error err = {0};
    struct probe_program program;

    if (!probe_program_init(&program, probe, batch->drawn, batch->count, true, false, &err)) {
        fail_msg("%s", err.message);
    }
    for (int round = 0; round < 12; round++) {
        check_round(random, probe, &program, batch);
    }
    probe_program_finish(&program, probe);
    finish_batch(batch);
}

/* The first parameter with choices; -1: none. */
static int choice_of(const struct node_type *type)
{
    int i = 0;

    while (type->record.params[i].name && type->record.params[i].type != PARAM_ENUM) {
        i++;
    }
    return type->record.params[i].name ? i : -1;
}

static struct scene *scene_of_type(struct random *random, const struct node_type *type, int choice)
{
    const struct random_limits limits = {.depth = 2, .lean = true};

    for (;;) {
        struct scene *scene = random_scene(random, type, &limits);
        if (choice >= 0) {
            scene->root->params.values[choice_of(type)].number[0] = choice;
        }
        struct field *field = compile_field(scene);
        const bool usable = field->loop_trips <= LOOPS_MAX;
        field_unref(field);
        if (usable) {
            return scene;
        }
        scene_destroy(scene);
    }
}

static void glsl_agrees(void **state)
{
    (void)state;
    struct random random = {34};
    struct batch batch = {.count = 0};
    struct error err = {0};
    struct probe probe;

    assert_true(probe_init(&probe, &err));
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        const int at = choice_of(type);
        const char *const *choices = at < 0 ? NULL : type->record.params[at].choices;
        bool inner =
            type->kind == KIND_COMBINE || type->kind == KIND_DISTANCE || type->kind == KIND_DOMAIN;
        for (int k = 0; inner && (k == 0 || (choices && choices[k])); k++) {
            add_scene(&batch, scene_of_type(&random, type, choices ? k : -1));
            if (batch.count == FIELDS_MAX) {
                check_batch(&random, &probe, &batch);
            }
        }
    }
    if (batch.count > 0) {
        check_batch(&random, &probe, &batch);
    }
    add_scene(&batch, json_text_valid_scene(document));
    check_batch(&random, &probe, &batch);
    probe_finish(&probe);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hidden_nodes_are_left_out),
        cmocka_unit_test(every_set_of_operands_may_be_hidden),
        cmocka_unit_test(isolated_nodes_are_alone),
        cmocka_unit_test(nodes_of_models_are_isolated_in_all_instances),
        cmocka_unit_test(models_code_and_the_floor_are_no_exception),
        cmocka_unit_test(what_was_never_drawn_is_left_out),
        cmocka_unit_test(glsl_agrees),
    };

    return cmocka_run_group_tests_name("hidden nodes", tests, NULL, NULL);
}
