/* SPDX-License-Identifier: MIT */
/* A patched field is, to the last bit, the one that compiling the edited scene gives, and older
 * fields stay as they were: for edits of every type's numbers, of the examples, and of scenes whose
 * edits change anything. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "renderer/field/field_patch.h"
#include "server/embedded.h"
#include "tests/support/compiled.h"
#include "tests/support/json_text.h"
#include "tests/support/numeric_edit.h"
#include "tests/support/random_edit.h"

enum { POINTS = 12, HELD = 4 };
#define SIZE 4.0

/* --- allocations --- */

/* The linker gives these the calls of the program (Makefile). */
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);

static size_t allocations;

void *__wrap_malloc(size_t size)
{
    allocations++;
    return __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
    allocations++;
    return __real_calloc(count, size);
}

void *__wrap_realloc(void *block, size_t size)
{
    allocations++;
    return __real_realloc(block, size);
}

/* --- comparison --- */

static const char *last_edit = "";

static void assert_same_instructions(const struct field *a, const struct field *b)
{
    assert_int_equal(a->instruction_count, b->instruction_count);
    for (size_t i = 0; i < a->instruction_count; i++) {
        const struct field_instruction *x = &a->instructions[i], *y = &b->instructions[i];
        assert_true(x->op == y->op && x->type == y->type && x->sdf == y->sdf && x->a == y->a &&
                    x->b == y->b && x->point == y->point && x->out == y->out &&
                    x->choices == y->choices && x->params == y->params && x->seen == y->seen &&
                    x->arguments == y->arguments && x->hidden == y->hidden && x->side == y->side);
    }
}

static void assert_same_box(const struct bounds *a, const struct bounds *b)
{
    assert_memory_equal(a, b, sizeof *a);
}

/* What the evaluator in C reads. */
static void assert_same_answers(struct random *random, const struct field *a, const struct field *b)
{
    for (int i = 0; i < POINTS; i++) {
        const double p[3] = {random_between(random, -SIZE, SIZE),
                             random_between(random, -SIZE, SIZE),
                             random_between(random, -SIZE, SIZE)};
        const struct field_surface x = field_surface(a, p, NULL), y = field_surface(b, p, NULL);
        const double d = field_distance(a, p), e = field_distance(b, p);
        assert_memory_equal(&d, &e, sizeof d);
        assert_int_equal(x.number, y.number);
        assert_memory_equal(x.material, y.material, sizeof x.material);
    }
}

static void assert_same_field(struct random *random, const struct field *a, const struct field *b)
{
    assert_true(a->structure_hash == b->structure_hash);
    assert_int_equal(a->vec4_count, b->vec4_count);
    if (memcmp(a->params, b->params, a->vec4_count * 4 * sizeof *a->params) != 0) {
        fail_msg("other numbers after %s", last_edit);
    }
    assert_same_instructions(a, b);
    assert_same_box(&a->bounds, &b->bounds);
    assert_int_equal(a->transmissive, b->transmissive);
    if (a->transmissive) {
        assert_same_box(&a->transmissive_bounds, &b->transmissive_bounds);
    }
    assert_int_equal(a->loop_trips, b->loop_trips);
    assert_int_equal(a->argument_count, b->argument_count);
    assert_int_equal(a->leaf_count, b->leaf_count);
    for (size_t i = 0; i < a->leaf_count; i++) {
        assert_int_equal(a->leaves[i].number, b->leaves[i].number);
        assert_string_equal(a->leaves[i].id, b->leaves[i].id);
    }
    assert_int_equal(a->member_count, b->member_count);
    assert_memory_equal(a->members, b->members, a->member_count * sizeof *a->members);
    assert_same_answers(random, a, b);
}

/* --- a scene under edits --- */

/* Fields that pictures under way still hold, with what their numbers were. */
struct held_field {
    struct field *field;
    float *numbers;
};

struct life {
    struct random *random;
    struct scene *scene;
    struct field *newest;
    struct field *spare;
    struct held_field held[HELD];
    size_t edits, patched;
};

static float *copy_numbers(const struct field *field)
{
    const size_t size = field->vec4_count * 4 * sizeof *field->params;

    return memcpy(malloc(size), field->params, size);
}

/* The picture is drawn: its field may be written over. */
static void let_go(struct life *life, struct held_field *held)
{
    if (!held->field) {
        return;
    }
    assert_memory_equal(held->field->params, held->numbers,
                        held->field->vec4_count * 4 * sizeof *held->numbers);
    free(held->numbers);
    if (held->field->references > 1 || life->spare) {
        field_unref(held->field);
    } else {
        life->spare = held->field;
    }
    *held = (struct held_field){NULL, NULL};
}

static void hold(struct life *life, struct field *field)
{
    struct held_field *held = &life->held[random_below(life->random, HELD)];

    let_go(life, held);
    *held = (struct held_field){field, copy_numbers(field)};
}

static struct field *compile(const struct life *life, const struct field *drawn)
{
    return field_compile_as(life->scene, &(struct field_options){.drawn = drawn, .patchable = true},
                            NULL);
}

/* What of the spare is other than before lies in there. */
static void assert_within(const struct field *field, const float *before,
                          const struct field_span *changed)
{
    for (size_t i = 0; i < field->vec4_count; i++) {
        if (i < changed->first || i >= changed->end) {
            assert_memory_equal(field->params + 4 * i, before + 4 * i, 4 * sizeof *before);
        }
    }
}

static struct field *patch(struct life *life, const cJSON *ops)
{
    float *before = life->spare ? copy_numbers(life->spare) : NULL;
    struct field *spare = life->spare;
    struct field_span changed;
    struct field *field = field_patch(life->newest, spare, life->scene, ops, &changed);

    if (field && field == spare) {
        assert_within(field, before, &changed);
    } else if (field && field != life->newest) {
        assert_int_equal(changed.first, 0);
        assert_int_equal(changed.end, field->vec4_count);
    }
    if (field != life->newest) {
        field_unref(spare);
        life->spare = NULL;
    }
    free(before);
    return field;
}

/* Whether it sets what decides if light goes through a material. */
static bool is_of_light(const cJSON *ops)
{
    for (const cJSON *op = ops->child; op; op = op->next) {
        const char *at = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(op, "at"));
        if (strstr(at, "/opacity") || strstr(at, "/transmission")) {
            return true;
        }
    }
    return false;
}

/* Only what changes more than numbers need not be patched. */
static void check_refusal(const struct life *life, const struct field *fresh, const cJSON *ops)
{
    if (life->newest->structure_hash == fresh->structure_hash && !is_of_light(ops)) {
        char *text = json_print(ops, false), *root = root_text(life->scene);
        fail_msg("not patched: %s\n%s", text, root);
    }
}

static void assert_patched(const struct life *life, const struct field *patched,
                           const struct field *fresh, const cJSON *ops)
{
    char *text = json_print(ops, false);

    last_edit = text;
    assert_same_field(life->random, patched, fresh);
    last_edit = "";
    free(text);
}

/* The scene has become no field: it is taken back. */
static struct field *take_back(struct life *life, const cJSON *inverse)
{
    assert_true(edit_apply(life->scene, inverse, NULL, NULL, NULL));
    return compile(life, NULL);
}

/* After an edit that was refused. */
static void start_anew(struct life *life)
{
    struct field_span changed;

    field_end_patches(life->newest);
    assert_null(field_patch(life->newest, life->spare, life->scene, NULL, &changed));
    struct field *fresh = compile(life, life->newest);
    hold(life, life->newest);
    life->newest = fresh;
}

/* `numeric`: it has to be patched where nothing but numbers has changed. */
static void edit(struct life *life, cJSON *ops, bool numeric)
{
    cJSON *inverse = NULL;

    if (edit_apply(life->scene, ops, NULL, &inverse, NULL)) {
        struct field *fresh = compile(life, life->newest), *patched = patch(life, ops);
        if (patched) {
            assert_non_null(fresh);
            assert_patched(life, patched, fresh, ops);
            field_unref(fresh);
            life->patched++;
        } else if (fresh && numeric) {
            check_refusal(life, fresh, ops);
        }
        life->edits++;
        hold(life, life->newest);
        life->newest = patched ? patched : fresh ? fresh : take_back(life, inverse);
    } else {
        start_anew(life);
    }
    cJSON_Delete(inverse);
    cJSON_Delete(ops);
}

static struct life begin(struct random *random, struct scene *scene)
{
    struct life life = {.random = random, .scene = scene};

    life.newest = compile(&life, NULL);
    assert_non_null(life.newest);
    return life;
}

static void end(struct life *life)
{
    for (size_t i = 0; i < HELD; i++) {
        let_go(life, &life->held[i]);
    }
    field_unref(life->spare);
    field_unref(life->newest);
    scene_destroy(life->scene);
}

/* --- tests --- */

/* Nodes that are hidden, of which some stand in the program. */
static void hide_some(struct life *life)
{
    for (struct node *node = life->scene->root; node; node = node_next(node, life->scene->root)) {
        struct value *value = &node->common.values[record_type_find(node->common.type, "visible")];
        value->number[0] = random_below(life->random, 8) != 0;
        value->set = true;
    }
    struct field *kept = compile(life, life->newest);
    field_unref(life->newest);
    life->newest = kept;
}

static struct scene *long_union(struct random *random, int count)
{
    const struct random_limits limits = {.depth = 1, .lean = true, .inner = true};
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    fputs("{'format':'fieldcast/1','materials':{'m0':{'shader':'phong'},"
          "'m1':{'shader':'standard','properties':{'transmission':0.5}},"
          "'m2':{'shader':'checker'}},'root':{'type':'group','children':[",
          out);
    for (int i = 0; i < count; i++) {
        const struct node_type *type = node_type_at(random_below(random, node_type_count()));
        /* The numbers of surfaces are made in memory of their own. */
        while (type->kind == KIND_CODE || type->kind == KIND_MODEL || type->kind == KIND_FLAT ||
               type->kind == KIND_SURFACE) {
            type = node_type_at(random_below(random, node_type_count()));
        }
        fputs(i > 0 ? "," : "", out);
        random_node(random, out, type, &limits);
    }
    fputs("]}}", out);
    assert_int_equal(fclose(out), 0);
    struct scene *scene = json_text_valid_scene(text);
    free(text);
    return scene;
}

static void every_type_is_patched(void **state)
{
    (void)state;
    struct random random = {61};
    struct random_limits limits = {.depth = 1};

    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        for (int k = 0; k < 8; k++) {
            limits.depth = 1 + k % 3;
            struct life life = begin(&random, random_scene(&random, type, &limits));
            if (k % 2) {
                hide_some(&life);
            }
            for (int n = 0; n < 12; n++) {
                edit(&life, numeric_edit(&random, life.scene, n % 6 == 5), k < 4 && n % 6 < 5);
            }
            end(&life);
        }
    }
}

static void the_examples_are_patched(void **state)
{
    (void)state;
    struct random random = {62};

    for (size_t i = 0; i < examples_count; i++) {
        struct error err = {0};
        struct scene *scene =
            scene_parse((const char *)examples_table[i].bytes, examples_table[i].length, &err);
        assert_non_null(scene);
        struct life life = begin(&random, scene);
        for (int n = 0; n < 40; n++) {
            edit(&life, numeric_edit(&random, life.scene, n % 8 == 7), false);
        }
        end(&life);
    }
}

static struct scene *drawable_document(struct random *random)
{
    for (;;) {
        struct scene *scene = random_document(random, 30);
        struct field *field = field_compile(scene, NULL);
        field_unref(field);
        if (field) {
            return scene;
        }
        scene_destroy(scene);
    }
}

/* Operands that have not changed are passed over: many, with loops and guards among them. */
static void long_unions_are_patched(void **state)
{
    (void)state;
    struct random random = {64};

    for (int i = 0; i < 40; i++) {
        struct life life = begin(&random, long_union(&random, 60));
        if (i % 2) {
            hide_some(&life);
        }
        for (int n = 0; n < 40; n++) {
            edit(&life, numeric_edit(&random, life.scene, false), true);
        }
        end(&life);
    }
}

/* Instances with numbers of their own, one through another. */
static void instances_are_patched(void **state)
{
    (void)state;
    static const char text[] =
        "{'format':'fieldcast/1','models':{'lamp':{'params':["
        "{'name':'high','type':'float','sets':'/nodes/pole/params/height','range':[0.1,4]},"
        "{'name':'at','type':'vec3','sets':'/nodes/head/transform/translation'},"
        "{'name':'size','type':'float','sets':'/nodes/head/params/radius','range':[0.1,2]}],"
        "'root':{'id':'top','type':'smooth_union','children':[{'id':'pole','type':'cylinder'},"
        "{'id':'head','type':'model','params':{'model':'head'}},"
        "{'id':'row','type':'repeat','params':{'count':[2,0,2]},'children':["
        "{'id':'small','type':'model','params':{'model':'head','radius':0.2}}]}]}},"
        "'head':{'params':[{'name':'radius','type':'float','sets':'/nodes/ball/params/radius',"
        "'range':[0.1,3]},{'name':'grow','type':'float','sets':'/nodes/ball/transform/scale',"
        "'range':[0.5,2]}],'root':{'id':'ball','type':'sphere'}}},"
        "'root':{'type':'group','children':["
        "{'id':'a','type':'model','params':{'model':'lamp'}},"
        "{'id':'b','type':'model','params':{'model':'lamp','high':2,'at':[0,1,0],'size':0.4}},"
        "{'id':'c','type':'twist','children':["
        "{'id':'d','type':'model','params':{'model':'lamp','at':[0,2,0]}}]},"
        "{'id':'e','type':'model','params':{'model':'head','grow':1.5}}]}}";
    struct random random = {66};

    for (int i = 0; i < 12; i++) {
        struct life life = begin(&random, json_text_valid_scene(text));
        for (int n = 0; n < 60; n++) {
            edit(&life, numeric_edit(&random, life.scene, false), true);
        }
        assert_true(life.patched > life.edits / 2);
        end(&life);
    }
}

static bool is_of_environment(const cJSON *ops)
{
    for (const cJSON *op = ops->child; op; op = op->next) {
        if (strstr(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(op, "at")),
                   "/environment")) {
            return true;
        }
    }
    return false;
}

/* The newest becomes the spare. */
static void take_turns(struct life *life, struct field *field)
{
    field_unref(life->spare);
    life->spare = life->newest;
    life->newest = field;
}

/* What is refused is compiled, and two fields have to be made again. A changed environment paints
 * the floor by way of a record, which is allocated. */
static void patching_two_fields_allocates_nothing(void **state)
{
    (void)state;
    struct random random = {65};
    struct life life = begin(&random, long_union(&random, 200));
    size_t fields = 0, free_of_any = 0;

    for (int n = 0; n < 200; n++) {
        cJSON *ops = numeric_edit(&random, life.scene, false);
        const bool fits = !is_of_environment(ops);
        struct field_span changed;
        if (fits && !edit_apply(life.scene, ops, NULL, NULL, NULL)) {
            field_end_patches(life.newest);
        } else if (fits) {
            const size_t before = allocations;
            struct field *field = field_patch(life.newest, life.spare, life.scene, ops, &changed);
            const size_t made = allocations - before;
            if (field && fields == 2) {
                assert_int_equal(made, 0);
                free_of_any++;
            }
            fields = !field ? 0 : fields + (fields < 2 && field != life.newest);
            if (field == life.newest) {
                field_unref(field);
            } else {
                take_turns(&life, field ? field : compile(&life, life.newest));
            }
        }
        cJSON_Delete(ops);
    }
    assert_true(free_of_any > 50);
    end(&life);
}

static void any_edit_is_patched_or_refused(void **state)
{
    (void)state;
    struct random random = {63};
    size_t patched = 0, edits = 0;

    for (int i = 0; i < 60; i++) {
        struct life life = begin(&random, drawable_document(&random));
        for (int n = 0; n < 40; n++) {
            const bool numeric = random_below(&random, 4) != 0;
            edit(&life,
                 numeric ? numeric_edit(&random, life.scene, n % 2 == 0)
                         : random_edit(&random, life.scene),
                 false);
        }
        patched += life.patched;
        edits += life.edits;
        end(&life);
    }
    assert_true(patched > edits / 4 && patched < edits);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_type_is_patched),
        cmocka_unit_test(the_examples_are_patched),
        cmocka_unit_test(long_unions_are_patched),
        cmocka_unit_test(instances_are_patched),
        cmocka_unit_test(patching_two_fields_allocates_nothing),
        cmocka_unit_test(any_edit_is_patched_or_refused),
    };

    return cmocka_run_group_tests_name("patched fields", tests, NULL, NULL);
}
