/* SPDX-License-Identifier: MIT */
/* Random and damaged edits: exact inverses, nothing left of what is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "tests/support/random_edit.h"

enum { DOCUMENTS = 75, EDITS = 60, DAMAGED = 3000, BATCHES = 300, BATCH = 40 };

static struct error err;

static void assert_same(const char *a, const char *b, const cJSON *ops)
{
    if (strcmp(a, b) != 0) {
        char *text = json_print(ops, true);
        print_error("%s", text);
        free(text);
    }
    assert_string_equal(a, b);
}

/* Kinds of operations that random edits have to reach, each with an inverse of more than itself
 * where it says so. */
static struct {
    const char *op, *begins, *ends;
    bool more;
    int seen;
} reached[] = {
    {"set", "/primitives/", "/params", false, 0},
    {"set", "/primitives/", "/params", true, 0},
    {"set", "/shaders/", "/properties", false, 0},
    {"set", "/shaders/", "/properties", true, 0},
    {"set", "/nodes/", "/params/primitive", false, 0},
    {"set", "/nodes/", "/params/primitive", true, 0},
    {"set", "/nodes/", "/params/model", false, 0},
    {"set", "/nodes/", "/type", true, 0},
    {"set", "/nodes/", "/params/points", false, 0},
    {"set", "/nodes/", "/params/code", false, 0},
    {"set", "/materials/", "/shader", true, 0},
    {"set", "/primitives/", "/code", false, 0},
    {"set", "/lights/", "/type", true, 0},
    {"set", "/volumes/", "/type", true, 0},
    {"set", "/environment/", "image", false, 0},
    {"insert", "/volumes", "", false, 0},
    {"remove", "/volumes/", "", false, 0},
    {"move", "/volumes/", "", false, 0},
    {"insert", "/primitives", "", false, 0},
    {"insert", "/shaders", "", false, 0},
    {"insert", "/models", "", false, 0},
    {"remove", "/primitives/", "", false, 0},
    {"remove", "/shaders/", "", false, 0},
    {"remove", "/models/", "", false, 0},
    {"move", "/models/", "", false, 0},
    {"move", "/nodes/", "", false, 0},
    {"remove", "/nodes/", "", false, 0},
};

enum { REACHED = sizeof reached / sizeof reached[0] };

static void note_reached(const cJSON *applied, const cJSON *inverse)
{
    const char *name = cJSON_GetObjectItem(applied->child, "op")->valuestring;
    const cJSON *at = cJSON_GetObjectItem(applied->child, "at");

    at = at ? at : cJSON_GetObjectItem(applied->child, "into");
    for (int i = 0; i < REACHED && !applied->child->next; i++) {
        const size_t length = strlen(at->valuestring), end = strlen(reached[i].ends);
        reached[i].seen +=
            strcmp(name, reached[i].op) == 0 && (inverse->child->next || !reached[i].more) &&
            strncmp(at->valuestring, reached[i].begins, strlen(reached[i].begins)) == 0 &&
            length >= end && strcmp(at->valuestring + length - end, reached[i].ends) == 0;
    }
}

static void assert_same_users(const struct scene *a, const struct scene *b)
{
    for (int kind = 0; kind < RANDOM_KINDS; kind++) {
        const struct resource_list *one = random_list(a, kind), *other = random_list(b, kind);
        assert_int_equal(one->count, other->count);
        for (size_t i = 0; i < one->count; i++) {
            assert_int_equal(one->items[i]->users, other->items[i]->users);
        }
    }
}

static size_t height_of(const struct node *node)
{
    size_t height = 1;

    for (size_t i = 0; i < node->child_count; i++) {
        const size_t child = height_of(node->children[i]);
        assert_int_equal(node_position(node->children[i]), i);
        assert_ptr_equal(node->children[i]->parent, node);
        height = child + 1 > height ? child + 1 : height;
    }
    assert_int_equal(node->height, height);
    return height;
}

/* What nodes remember of their place is right. */
static void assert_trees(const struct scene *scene)
{
    height_of(scene->root);
    for (size_t i = 0; i < scene->models.count; i++) {
        height_of(scene->models.items[i]->root);
        assert_ptr_equal(node_owner(scene->models.items[i]->root), scene->models.items[i]);
    }
}

static struct scene *parse(const char *text)
{
    struct scene *scene = scene_parse(text, strlen(text), &err);

    assert_non_null(scene); /* whatever edits do, the document stays valid */
    return scene;
}

/* A document that is edited, its text, and what is read of that. */
struct edited {
    struct scene *wild, *read;
    char *text;
};

/* The server counts on it, where it does not print a scene to know how long it is. */
static void assert_grown_by_no_more(const char *before, const char *after, const cJSON *applied)
{
    char *text = json_print(applied, false);

    if (strlen(after) > strlen(before) + strlen(text)) {
        fail_msg("%zu and %zu bytes make %zu: %s", strlen(before), strlen(text), strlen(after),
                 text);
    }
    free(text);
}

/* Of the copy of before: the canonical form does what the edit did, the inverse takes it back. */
static void follow(struct edited *edited, struct scene *copy, const cJSON *ops,
                   const cJSON *applied, const cJSON *inverse)
{
    char *after = scene_print(edited->wild, false);

    assert_grown_by_no_more(edited->text, after, applied);
    assert_grown_by_no_more(after, edited->text, inverse);
    assert_true(edit_apply(copy, applied, NULL, NULL, &err));
    char *again = scene_print(copy, false);
    assert_same(after, again, ops);
    free(again);
    assert_true(edit_apply(copy, inverse, NULL, NULL, &err));
    again = scene_print(copy, false);
    assert_same(edited->text, again, ops);
    free(again);
    assert_true(edit_check(applied, NULL));
    note_reached(applied, inverse);
    free(edited->text);
    edited->text = after;
    scene_destroy(edited->read);
    edited->read = parse(after);
}

static bool try_edit(struct edited *edited, struct random *random)
{
    cJSON *ops = random_edit(random, edited->wild), *applied, *inverse;
    struct scene *copy = scene_copy(edited->wild);
    const bool accepted = edit_apply(edited->wild, ops, &applied, &inverse, &err);

    if (accepted) {
        follow(edited, copy, ops, applied, inverse);
        cJSON_Delete(applied);
        cJSON_Delete(inverse);
    } else {
        assert_true(*err.message);
        char *after = scene_print(edited->wild, false);
        assert_same(edited->text, after, ops);
        free(after);
    }
    assert_int_equal(edited->read->node_count, edited->wild->node_count);
    assert_same_users(edited->read, edited->wild);
    assert_trees(edited->wild);
    scene_destroy(copy);
    cJSON_Delete(ops);
    return accepted;
}

/* An edit and its inverse leave the document byte for byte as it was; a refused edit changes
 * nothing; the canonical form does what the edit did. */
static void random_edits_have_exact_inverses(void **state)
{
    (void)state;
    int accepted = 0, refused = 0;

    for (uint64_t seed = 1; seed <= DOCUMENTS; seed++) {
        struct random random = {seed};
        struct edited edited = {.wild = random_document(&random, 1 + random_below(&random, 20))};
        edited.text = scene_print(edited.wild, false);
        edited.read = parse(edited.text);
        for (int i = 0; i < EDITS; i++) {
            if (try_edit(&edited, &random)) {
                accepted++;
            } else {
                refused++;
            }
        }
        free(edited.text);
        scene_destroy(edited.read);
        scene_destroy(edited.wild);
    }
    assert_true(accepted > DOCUMENTS * EDITS / 5 && refused > DOCUMENTS * EDITS / 10);
    for (int i = 0; i < REACHED; i++) {
        if (reached[i].seen == 0) {
            fail_msg("%s %s...%s: never", reached[i].op, reached[i].begins, reached[i].ends);
        }
    }
}

/* Adds to `ops` what the scene accepts, with the ids that it gives. */
static void add_accepted(cJSON *ops, struct scene *scene, struct random *random)
{
    cJSON *edit = random_edit(random, scene), *applied = NULL;

    if (edit_apply(scene, edit, &applied, NULL, &err)) {
        while (applied->child) {
            cJSON_AddItemToArray(ops, cJSON_DetachItemFromArray(applied, 0));
        }
    }
    cJSON_Delete(applied);
    cJSON_Delete(edit);
}

/* Many operations that are accepted one after the other, and one at the end that is not. */
static cJSON *refused_batch(struct random *random, const struct scene *scene)
{
    struct scene *copy = scene_copy(scene);
    cJSON *ops = cJSON_CreateArray(), *last = cJSON_CreateObject();

    for (size_t i = 2 + random_below(random, BATCH); i > 0; i--) {
        add_accepted(ops, copy, random);
    }
    cJSON_AddStringToObject(last, "op", "remove");
    cJSON_AddStringToObject(last, "at", "/nodes/nobody");
    cJSON_AddItemToArray(ops, last);
    scene_destroy(copy);
    return ops;
}

/* What was done before the operation that is refused is undone: where that could fail, it would end
 * the server. */
static void refused_batches_leave_nothing(void **state)
{
    (void)state;

    for (uint64_t seed = 1; seed <= BATCHES; seed++) {
        struct random random = {1000 + seed};
        struct scene *scene = random_document(&random, 1 + random_below(&random, 12));
        char *before = scene_print(scene, false);
        cJSON *ops = refused_batch(&random, scene);

        assert_false(edit_apply(scene, ops, NULL, NULL, &err));
        assert_int_equal(err.kind, ERROR_NOT_FOUND);
        assert_string_equal(err.place, "/nodes/nobody");
        char *after = scene_print(scene, false);
        assert_same(before, after, ops);
        struct scene *read = parse(before);
        assert_same_users(read, scene);
        assert_trees(scene);
        scene_destroy(read);
        free(before);
        free(after);
        cJSON_Delete(ops);
        scene_destroy(scene);
    }
}

/* Edits with damaged texts: refused without a trace, or applied and taken back. */
static void damaged_edits(void **state)
{
    (void)state;
    struct random random = {5};
    struct scene *wild = random_document(&random, 30);
    char *before = scene_print(wild, false);
    int accepted = 0, refused = 0;

    for (int i = 0; i < DAMAGED; i++) {
        cJSON *edit = random_edit(&random, wild), *inverse;
        char *text = json_print(edit, false);
        const size_t length = strlen(text);
        random_damage(&random, text, length);
        cJSON *ops = json_parse(text, length, &err);
        if (ops && edit_check(ops, &err) && edit_apply(wild, ops, NULL, &inverse, &err)) {
            assert_true(edit_apply(wild, inverse, NULL, NULL, &err));
            cJSON_Delete(inverse);
            accepted++;
        } else if (ops) {
            refused++;
        }
        if (i % 100 == 0) {
            char *after = scene_print(wild, false);
            assert_string_equal(before, after);
            free(after);
        }
        cJSON_Delete(ops);
        cJSON_Delete(edit);
        free(text);
    }
    assert_true(accepted > DAMAGED / 100 && refused > DAMAGED / 100);
    char *after = scene_print(wild, false);
    assert_string_equal(before, after);
    free(before);
    free(after);
    scene_destroy(wild);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_edits_have_exact_inverses),
        cmocka_unit_test(refused_batches_leave_nothing),
        cmocka_unit_test(damaged_edits),
    };

    return cmocka_run_group_tests_name("edit_random", tests, NULL, NULL);
}
