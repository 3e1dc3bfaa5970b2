/* SPDX-License-Identifier: MIT */
/* Undo and redo: groups, authors, and what others did meanwhile. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/edit.h"
#include "protocol/json.h"
#include "protocol/limits.h"
#include "protocol/memory.h"
#include "tests/support/edits.h"
#include "tests/support/json_text.h"
#include "tests/support/random_edit.h"

static const char base[] = "{'format':'fieldcast/1','materials':{'snow':{'shader':'phong'},"
                           "'ice':{'shader':'phong'}},"
                           "'root':{'id':'root','type':'union','children':["
                           "{'id':'body','type':'sphere'},{'id':'head','type':'sphere'}]}}";

static struct scene *scene;
static struct history *history;
static struct error err;

static int set_up(void **state)
{
    (void)state;
    scene = json_text_scene(base, &err);
    history = history_create();
    return scene ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    scene_destroy(scene);
    history_destroy(history);
    return 0;
}

/* Takes `applied` and `inverse`. */
static void record(struct history *steps, const char *author, const char *group, cJSON *applied,
                   cJSON *inverse)
{
    struct history_entry entry = {
        .author = author, .group = group, .applied = applied, .inverse = inverse};

    history_depth(steps, author, &entry.undo, &entry.redo);
    history_record(steps, &entry);
    cJSON_Delete(applied);
}

static void edit_as(const char *author, const char *group, const char *text)
{
    cJSON *ops = json_text_parse(text, &err), *applied, *inverse;

    assert_non_null(ops);
    assert_true(edit_apply(scene, ops, &applied, &inverse, &err));
    record(history, author, group, applied, inverse);
    cJSON_Delete(ops);
}

static void set_radius(const char *author, const char *group, const char *id, double radius)
{
    char text[200];

    snprintf(text, sizeof text, "[{'op':'set','at':'/nodes/%s/params/radius','value':%g}]", id,
             radius);
    edit_as(author, group, text);
}

static double radius_of(const char *id)
{
    return record_number(&scene_find(scene, id)->params, "radius");
}

static bool undo(const char *author)
{
    return history_undo(history, scene, author, NULL, &err);
}

static bool redo(const char *author)
{
    return history_redo(history, scene, author, NULL, &err);
}

static void assert_depth(const char *author, size_t undo_steps, size_t redo_steps)
{
    size_t undos, redos;

    history_depth(history, author, &undos, &redos);
    assert_int_equal(undos, undo_steps);
    assert_int_equal(redos, redo_steps);
}

static void nothing_to_undo(void **state)
{
    (void)state;
    assert_false(undo("anna"));
    assert_int_equal(err.kind, ERROR_NOT_FOUND);
    assert_false(redo("anna"));
    assert_depth("anna", 0, 0);
}

static void a_group_is_one_step(void **state)
{
    (void)state;
    char *before = scene_print(scene, false);

    for (int i = 1; i <= 1000; i++) {
        set_radius("anna", "drag", "body", i);
    }
    assert_depth("anna", 1, 0);
    struct history_move move;
    assert_true(history_undo(history, scene, "anna", &move, &err));
    assert_int_equal(cJSON_GetArraySize(move.applied), 1); /* only the oldest value was kept */
    history_move_finish(&move);
    char *after = scene_print(scene, false);
    assert_string_equal(before, after);
    assert_true(redo("anna"));
    assert_float_equal(radius_of("body"), 1000, 0);
    free(before);
    free(after);
}

static void other_groups_and_no_group_are_steps(void **state)
{
    (void)state;
    set_radius("anna", "one", "body", 2);
    set_radius("anna", "two", "body", 3);
    set_radius("anna", "", "body", 4);
    set_radius("anna", "", "body", 5);
    set_radius("anna", NULL, "body", 6);
    assert_depth("anna", 5, 0);
    assert_true(undo("anna"));
    assert_true(undo("anna"));
    assert_float_equal(radius_of("body"), 4, 0);
    assert_depth("anna", 3, 2);
    set_radius("anna", "", "head", 9); /* a new edit forgets what was undone */
    assert_depth("anna", 4, 0);
}

static void authors_undo_their_own(void **state)
{
    (void)state;
    set_radius("anna", "", "body", 2);
    set_radius("bert", "", "head", 3);
    assert_true(undo("anna"));
    assert_float_equal(radius_of("body"), 0.5, 0);
    assert_float_equal(radius_of("head"), 3, 0);
    assert_depth("bert", 1, 0);
    assert_true(undo("bert"));
    assert_float_equal(radius_of("head"), 0.5, 0);
}

static void what_others_removed_is_skipped(void **state)
{
    (void)state;
    set_radius("anna", "", "head", 2);
    set_radius("anna", "", "body", 3);
    edit_as("bert", "", "[{'op':'remove','at':'/nodes/body'}]");
    assert_false(undo("anna"));
    assert_string_equal(err.place, "/nodes/body/params/radius");
    assert_true(undo("anna")); /* the step that cannot be undone is gone */
    assert_float_equal(radius_of("head"), 0.5, 0);
    assert_true(undo("bert"));
    assert_float_equal(radius_of("body"), 3, 0);
}

static void newer_values_of_others_are_left_alone(void **state)
{
    (void)state;
    struct history_move move;

    set_radius("bert", "", "body", 0.4);
    set_radius("anna", "", "body", 0.7);
    assert_false(history_undo(history, scene, "bert", &move, &err));
    assert_int_equal(err.kind, ERROR_CONFLICT);
    assert_string_equal(err.place, "/nodes/body/params/radius");
    assert_float_equal(radius_of("body"), 0.7, 0);
    edits_assert_prints(cJSON_Duplicate(move.skipped, true),
                        "[{'op':'set','at':'/nodes/body/params/radius','value':null}]");
    history_move_finish(&move);
    assert_true(undo("anna"));
    assert_float_equal(radius_of("body"), 0.4, 0);
}

static void the_rest_of_such_a_step_is_undone(void **state)
{
    (void)state;
    struct history_move move;

    set_radius("bert", "g", "body", 0.4);
    set_radius("bert", "g", "head", 0.3);
    set_radius("bert", "g", "body", 0.6);
    set_radius("anna", "", "body", 0.7);
    assert_true(history_undo(history, scene, "bert", &move, &err));
    assert_int_equal(cJSON_GetArraySize(move.applied), 1);
    assert_int_equal(cJSON_GetArraySize(move.skipped), 1);
    history_move_finish(&move);
    assert_float_equal(radius_of("body"), 0.7, 0);
    assert_float_equal(radius_of("head"), 0.5, 0);
    assert_true(redo("bert"));
    assert_float_equal(radius_of("body"), 0.7, 0);
    assert_float_equal(radius_of("head"), 0.3, 0);
}

/* With what was left out, as if nothing had been tried. */
static void a_step_that_is_returned_is_undone_later(void **state)
{
    (void)state;
    struct history_move move;
    struct scene *copy;

    set_radius("bert", "g", "body", 0.4);
    set_radius("bert", "g", "head", 0.3);
    set_radius("anna", "", "body", 0.7);
    copy = scene_copy(scene);
    assert_true(history_take(history, "bert", false, &move, &err));
    assert_true(history_apply(&move, copy, &err));
    assert_int_equal(cJSON_GetArraySize(move.skipped), 1);
    history_return(history, "bert", false, &move);
    assert_null(move.skipped);
    scene_destroy(copy);
    assert_depth("bert", 1, 0);
    assert_true(undo("anna"));
    assert_true(undo("bert"));
    assert_float_equal(radius_of("body"), 0.5, 0);
    assert_float_equal(radius_of("head"), 0.5, 0);
}

static void a_value_that_was_put_back_is_no_conflict(void **state)
{
    (void)state;
    set_radius("bert", "", "body", 0.4);
    set_radius("anna", "", "body", 0.7);
    assert_true(undo("anna"));
    assert_true(undo("bert"));
    assert_float_equal(radius_of("body"), 0.5, 0);
    set_radius("anna", "", "body", 0.7);
    assert_false(redo("bert"));
    assert_float_equal(radius_of("body"), 0.7, 0);
}

/* Dropping an older value would here leave the material in use when its insertion is undone. */
static void groups_with_more_than_values_keep_all(void **state)
{
    (void)state;
    char *before = scene_print(scene, false);

    edit_as("anna", "g", "[{'op':'set','at':'/nodes/body/material','value':'snow'}]");
    edit_as("anna", "g",
            "[{'op':'insert','into':'/materials','name':'new',"
            "'value':{'shader':'phong'}}]");
    edit_as("anna", "g", "[{'op':'set','at':'/nodes/body/material','value':'new'}]");
    edit_as("anna", "g", "[{'op':'set','at':'/nodes/body/type','value':'box'}]");
    assert_depth("anna", 1, 0);
    assert_true(undo("anna"));
    char *after = scene_print(scene, false);
    assert_string_equal(before, after);
    free(before);
    free(after);
}

/* Of several sets of one place only the oldest counts: but not where another value was possible
 * only in between. Each list is one group; undone, it gives back the first byte. */
static void groups_keep_what_values_depend_on(void **state)
{
    (void)state;
    static const char text[] = "{'format':'fieldcast/1','primitives':{"
                               "'a':{'params':[{'name':'t','type':'float'}]},"
                               "'b':{'params':[{'name':'t','type':'float'}]},'c':{}},'models':{"
                               "'m':{'id':'x','type':'model'},"
                               "'n':{'id':'y','type':'model','params':{'model':'m'}}},"
                               "'root':{'id':'f','type':'field','params':{'primitive':'a','t':7}}}";
    static const char *const groups[][3] = {
        {"[{'op':'set','at':'/nodes/f/params/primitive','value':'b'}]",
         "[{'op':'set','at':'/nodes/f/params/t','value':1}]",
         "[{'op':'set','at':'/nodes/f/params/primitive','value':'c'}]"},
        {"[{'op':'set','at':'/primitives/a/params','value':[{'name':'t',"
         "'type':'float'},{'name':'u','type':'float'}]}]",
         "[{'op':'set','at':'/nodes/f/params/t','value':1}]",
         "[{'op':'set','at':'/primitives/a/params','value':[]}]"},
        {"[{'op':'set','at':'/nodes/x/params/model','value':null}]",
         "[{'op':'set','at':'/nodes/y/params/model','value':null}]",
         "[{'op':'set','at':'/nodes/x/params/model','value':'n'}]"},
    };

    for (size_t i = 0; i < sizeof groups / sizeof groups[0]; i++) {
        tear_down(NULL);
        scene = json_text_scene(text, &err);
        history = history_create();
        assert_non_null(scene);
        for (int step = 0; step < 3; step++) {
            edit_as("anna", "g", groups[i][step]);
        }
        assert_depth("anna", 1, 0);
        assert_true(undo("anna"));
        char *after = scene_print(scene, false), *before = json_text(text);
        assert_string_equal(after, before);
        free(after);
        free(before);
    }
}

static void steps_are_bounded(void **state)
{
    (void)state;
    for (int i = 0; i < LIMIT_UNDO_GROUPS + 10; i++) {
        set_radius("anna", "", "body", i + 1);
    }
    assert_depth("anna", LIMIT_UNDO_GROUPS, 0);
    while (undo("anna")) {
    }
    assert_float_equal(radius_of("body"), 10, 0);
    assert_depth("anna", 0, LIMIT_UNDO_GROUPS);
}

/* Operations that set a value of so many bytes. */
static cJSON *long_value(const char *at, size_t bytes)
{
    char *text = memory_alloc(bytes + 1, 1);
    cJSON *ops = cJSON_CreateArray(), *op = cJSON_CreateObject();

    memset(text, 'x', bytes);
    cJSON_AddStringToObject(op, "op", "set");
    cJSON_AddStringToObject(op, "at", at);
    cJSON_AddStringToObject(op, "value", text);
    cJSON_AddItemToArray(ops, op);
    free(text);
    return ops;
}

enum { LONG = 1 << 20, LONG_STEPS = LIMIT_UNDO_BYTES / LONG - 1 }; /* of which as many have room */

static void record_long(const char *author, const char *group, size_t bytes)
{
    record(history, author, group, long_value("/nodes/body/name", 1),
           long_value("/nodes/body/name", bytes));
}

/* Frees the steps that are gone; answers how long they were, in whole LONG. */
static size_t free_dropped(void)
{
    size_t bytes;

    history_discard(history_take_dropped(history, &bytes));
    return bytes / LONG;
}

static void memory_of_steps_is_bounded(void **state)
{
    (void)state;
    for (int i = 0; i < LONG_STEPS + 10; i++) {
        record_long("anna", "", LONG);
    }
    assert_depth("anna", LONG_STEPS, 0);
    assert_int_equal(free_dropped(), 10);
    record_long("bert", "", 2 * LIMIT_UNDO_BYTES);
    assert_depth("bert", 1, 0); /* the newest stays, whatever it takes */
    record_long("bert", "", LONG);
    assert_depth("bert", 1, 0);
    assert_depth("anna", LONG_STEPS, 0);
    assert_int_equal(free_dropped(), 2 * LIMIT_UNDO_BYTES / LONG);
    assert_int_equal(free_dropped(), 0);
}

/* Whose lock it takes does not wait until they are freed. */
static void steps_that_are_gone_are_handed_out(void **state)
{
    (void)state;
    record_long("anna", "", 2 * LONG);
    record_long("anna", "", 3 * LONG);
    record_long("bert", "", 4 * LONG);
    assert_int_equal(free_dropped(), 0);
    history_forget(history, "bert");
    assert_int_equal(free_dropped(), 4);
    assert_int_equal(history_bytes(history) / LONG, 5);
    history_clear(history);
    assert_int_equal(history_bytes(history), 0);
    assert_depth("anna", 0, 0);
    assert_int_equal(free_dropped(), 5);
}

static void memory_of_authors_is_bounded(void **state)
{
    (void)state;
    const char *const names[] = {"anna", "bert", "cleo", "dora", "emil", "finn"};

    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        for (int k = 0; k < LONG_STEPS; k++) {
            record_long(names[i], "", LONG);
            free_dropped();
        }
    }
    assert_depth("anna", 0, 0);
    assert_depth("cleo", LONG_STEPS, 0);
    assert_depth("finn", LONG_STEPS, 0);
}

/* However long something is dragged, it takes the memory of one value. */
static void groups_take_the_memory_of_one_edit(void **state)
{
    (void)state;
    set_radius("anna", "", "body", 2);
    for (int i = 0; i < LONG_STEPS + 10; i++) {
        record(history, "anna", "drag", long_value("/nodes/body/name", LONG),
               long_value("/nodes/body/name", LONG));
    }
    assert_depth("anna", 2, 0);
}

static void authors_are_bounded(void **state)
{
    (void)state;
    for (int i = 0; i <= LIMIT_SESSIONS; i++) {
        char name[32];
        snprintf(name, sizeof name, "author-%d", i);
        set_radius(name, "", "body", i + 1);
        if (i == 1) {
            set_radius("author-0", "", "body", 1); /* heard of again */
        }
    }
    assert_depth("author-0", 2, 0);
    assert_depth("author-1", 0, 0);
    assert_depth("author-2", 1, 0);
}

static const char *const authors[] = {"anna", "bert"};

/* --- rebuilt from a log --- */

enum { LOGGED = 60 };

struct logged {
    enum history_kind kind;
    const char *author, *group;
    char *label;
    cJSON *applied, *inverse;
    size_t undo, redo;
};

static bool log_edit(struct logged *entry, struct random *random, struct scene *wild,
                     struct history *steps)
{
    cJSON *ops = random_edit(random, wild), *inverse;
    const bool ok = edit_apply(wild, ops, &entry->applied, &inverse, NULL);

    if (ok) {
        history_depth(steps, entry->author, &entry->undo, &entry->redo);
        entry->group = random_below(random, 2) ? "g" : "";
        entry->inverse = cJSON_Duplicate(inverse, true);
        assert_true(asprintf(&entry->label, "label %zu", random_below(random, 1000)) > 0);
        history_record(steps, &(struct history_entry){.author = entry->author,
                                                      .group = entry->group,
                                                      .label = entry->label,
                                                      .applied = entry->applied,
                                                      .inverse = inverse,
                                                      .undo = entry->undo,
                                                      .redo = entry->redo});
    }
    cJSON_Delete(ops);
    return ok;
}

static bool log_move(struct logged *entry, struct scene *wild, struct history *steps)
{
    struct history_move move;
    const bool ok = (entry->kind == HISTORY_UNDO ? history_undo : history_redo)(
        steps, wild, entry->author, &move, NULL);

    if (ok) {
        entry->label = strdup(move.label);
        entry->inverse = cJSON_Duplicate(move.inverse, true);
        entry->undo = move.undo;
        entry->redo = move.redo;
        entry->applied = move.applied;
        move.applied = NULL;
    }
    history_move_finish(&move);
    return ok;
}

/* The last that an author does tells which steps there still are. */
static size_t log_last(struct logged *log, const char *author, struct random *random,
                       struct scene *wild, struct history *steps)
{
    log[0] = (struct logged){.kind = HISTORY_EDIT, .author = author};
    while (!log_edit(&log[0], random, wild, steps)) {
    }
    log[1] = (struct logged){.kind = HISTORY_UNDO, .author = author};
    return log_move(&log[1], wild, steps) ? 2 : 1;
}

static size_t log_random(struct logged *log, struct random *random, struct scene *wild,
                         struct history *steps)
{
    size_t count = 0;

    while (count < LOGGED) {
        struct logged *entry = &log[count];
        unsigned kind = random_below(random, 6);
        *entry = (struct logged){.kind = kind == 0   ? HISTORY_REDO
                                         : kind <= 2 ? HISTORY_UNDO
                                                     : HISTORY_EDIT,
                                 .author = authors[random_below(random, 2)]};
        count += entry->kind == HISTORY_EDIT ? log_edit(entry, random, wild, steps)
                                             : log_move(entry, wild, steps);
    }
    count += log_last(log + count, authors[0], random, wild, steps);
    return count + log_last(log + count, authors[1], random, wild, steps);
}

static struct history *rebuild(const struct logged *log, size_t count)
{
    struct history *steps = history_create();

    for (size_t i = 0; i < count; i++) {
        history_record(steps, &(struct history_entry){.kind = log[i].kind,
                                                      .author = log[i].author,
                                                      .group = log[i].group,
                                                      .label = log[i].label,
                                                      .applied = log[i].applied,
                                                      .inverse = log[i].inverse,
                                                      .undo = log[i].undo,
                                                      .redo = log[i].redo});
    }
    return steps;
}

/* Undoes and redoes all of an author's steps; both must do the same. */
static void assert_same_steps(struct history *a, struct history *b, const char *author,
                              struct scene *first, struct scene *second)
{
    for (int redoing = 0; redoing < 2; redoing++) {
        bool ok = true;
        while (ok) {
            const char *label = history_label(a, author, redoing, 0);
            assert_string_equal(label ? label : "none", history_label(b, author, redoing, 0)
                                                            ? history_label(b, author, redoing, 0)
                                                            : "none");
            ok = (redoing ? history_redo : history_undo)(a, first, author, NULL, NULL);
            assert_int_equal((redoing ? history_redo : history_undo)(b, second, author, NULL, NULL),
                             ok);
            char *one = scene_print(first, false), *two = scene_print(second, false);
            assert_string_equal(one, two);
            free(one);
            free(two);
        }
    }
}

static void a_log_gives_back_the_steps(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        struct random random = {seed};
        struct scene *wild = random_document(&random, 1 + random_below(&random, 20));
        struct history *steps = history_create();
        struct logged log[LOGGED + 4];
        const size_t count = log_random(log, &random, wild, steps);
        char *text = scene_print(wild, false);
        struct scene *copy = scene_parse(text, strlen(text), &err);
        struct history *again = rebuild(log, count);
        for (size_t i = 0; i < 2; i++) {
            assert_same_steps(steps, again, authors[i], wild, copy);
        }
        for (size_t i = 0; i < count; i++) {
            cJSON_Delete(log[i].applied);
            free(log[i].label);
        }
        free(text);
        scene_destroy(copy);
        scene_destroy(wild);
        history_destroy(steps);
        history_destroy(again);
    }
}

static void random_step(struct random *random, struct scene *wild, struct history *steps)
{
    static const char *const groups[] = {"", "", "a", "b"};
    cJSON *ops = random_edit(random, wild), *applied, *inverse;

    if (edit_apply(wild, ops, &applied, &inverse, NULL)) {
        record(steps, authors[random_below(random, 2)], groups[random_below(random, 4)], applied,
               inverse);
    }
    cJSON_Delete(ops);
}

/* Whatever two authors did, n undos of one and as many redos give back every byte. */
static void undos_and_redos_cancel(void **state)
{
    (void)state;
    size_t total = 0;

    for (uint64_t seed = 1; seed <= 150; seed++) {
        struct random random = {seed};
        struct scene *wild = random_document(&random, 1 + random_below(&random, 20));
        struct history *steps = history_create();
        for (int round = 0; round < 4; round++) {
            for (int i = 0; i < 20; i++) {
                random_step(&random, wild, steps);
            }
            const char *author = authors[random_below(&random, 2)];
            char *before = scene_print(wild, false);
            size_t undos, redos, wanted, done = 0;
            history_depth(steps, author, &wanted, &redos);
            wanted = random_below(&random, wanted + 1);
            for (size_t i = 0; i < wanted; i++) {
                done += history_undo(steps, wild, author, NULL, NULL);
            }
            history_depth(steps, author, &undos, &redos);
            assert_int_equal(redos, done);
            for (size_t i = 0; i < done; i++) {
                assert_true(history_redo(steps, wild, author, NULL, NULL));
            }
            char *after = scene_print(wild, false);
            assert_string_equal(before, after);
            free(before);
            free(after);
            total += done;
        }
        history_destroy(steps);
        scene_destroy(wild);
    }
    assert_true(total > 1000);
}

/* One author alone gets back to the first byte, whatever the groups. */
static void undoing_everything_gives_the_beginning(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 150; seed++) {
        struct random random = {seed};
        struct scene *wild = random_document(&random, 1 + random_below(&random, 20));
        struct history *steps = history_create();
        char *before = scene_print(wild, false);
        for (int i = 0; i < 40; i++) {
            cJSON *ops = random_edit(&random, wild), *applied, *inverse;
            if (edit_apply(wild, ops, &applied, &inverse, NULL)) {
                record(steps, "anna", random_below(&random, 2) ? "g" : "", applied, inverse);
            }
            cJSON_Delete(ops);
        }
        char *end = scene_print(wild, false), *text;
        while (history_undo(steps, wild, "anna", NULL, NULL)) {
        }
        text = scene_print(wild, false);
        assert_string_equal(before, text);
        free(text);
        while (history_redo(steps, wild, "anna", NULL, NULL)) {
        }
        text = scene_print(wild, false);
        assert_string_equal(end, text);
        free(text);
        free(before);
        free(end);
        history_destroy(steps);
        scene_destroy(wild);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(nothing_to_undo, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_group_is_one_step, set_up, tear_down),
        cmocka_unit_test_setup_teardown(other_groups_and_no_group_are_steps, set_up, tear_down),
        cmocka_unit_test_setup_teardown(authors_undo_their_own, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_others_removed_is_skipped, set_up, tear_down),
        cmocka_unit_test_setup_teardown(newer_values_of_others_are_left_alone, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_rest_of_such_a_step_is_undone, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_step_that_is_returned_is_undone_later, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_value_that_was_put_back_is_no_conflict, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(groups_with_more_than_values_keep_all, set_up, tear_down),
        cmocka_unit_test_setup_teardown(groups_keep_what_values_depend_on, set_up, tear_down),
        cmocka_unit_test_setup_teardown(steps_are_bounded, set_up, tear_down),
        cmocka_unit_test_setup_teardown(authors_are_bounded, set_up, tear_down),
        cmocka_unit_test_setup_teardown(memory_of_steps_is_bounded, set_up, tear_down),
        cmocka_unit_test_setup_teardown(memory_of_authors_is_bounded, set_up, tear_down),
        cmocka_unit_test_setup_teardown(steps_that_are_gone_are_handed_out, set_up, tear_down),
        cmocka_unit_test_setup_teardown(groups_take_the_memory_of_one_edit, set_up, tear_down),
        cmocka_unit_test(undos_and_redos_cancel),
        cmocka_unit_test(a_log_gives_back_the_steps),
        cmocka_unit_test(undoing_everything_gives_the_beginning),
    };

    return cmocka_run_group_tests_name("history", tests, NULL, NULL);
}
