/* SPDX-License-Identifier: MIT */
/* Which operations of a field the one before an edit had too. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/engine/matches.h"
#include "tests/support/json_text.h"

#define A "{'id':'a','type':'sphere','params':{'radius':0.1}}"
#define B "{'id':'b','type':'sphere','params':{'radius':0.2}}"
#define PAINTED_B "{'id':'b','type':'sphere','material':'m','params':{'radius':0.2}}"
#define C "{'id':'c','type':'sphere','params':{'radius':0.3}}"
#define D "{'id':'d','type':'sphere','params':{'radius':0.4}}"
#define POLYGON(x) "{'id':'p','type':'polygon','params':{'points':[[0,0],[" x ",0],[0,1]]}}"
#define OWN "{'id':'u','type':'field','params':{'primitive':'own'}}"
#define CODE(x) "'primitives':{'own':{'code':'float sdf(vec3 p) { return length(p) - " x "; }'}},"
#define PHONG "'materials':{'m':{'shader':'phong'}},"

static struct matches_side make(const char *beside, const char *children)
{
    char text[2000];
    struct error err = {0};

    snprintf(text, sizeof text,
             "{'format':'fieldcast/1',%s'root':{'id':'root','type':'union','children':[%s]}}",
             beside, children);
    struct scene *scene = json_text_valid_scene(text);
    struct field *field = field_compile(scene, &err);
    assert_non_null(field);
    struct engine_program *program = engine_program_create(field, 0, 1);
    assert_non_null(program);
    scene_destroy(scene);
    field_unref(field);
    return (struct matches_side){program, program->field->params};
}

#define FLAG (~(uint32_t)TAPE_INDEX) /* what a word of a tape has beside an index */

struct found {
    size_t fresh, lost;
    bool moved, renumbered;
};

/* Each that stays is the same operation, and none is two. */
static struct found find_of(struct matches_side from, struct matches_side to)
{
    struct matches matches;
    size_t kept = 0;

    matches_find(&from, &to, &matches);
    for (size_t i = 0; i < from.program->count; i++) {
        const uint32_t now = matches.now[i];
        uint32_t word = (uint32_t)i | FLAG;
        const bool any = matches_rename(&matches, &word, 1);
        assert_int_equal(word, now | FLAG);
        assert_true(any || now == i);
        kept += now != MATCH_NONE;
        assert_true(now == MATCH_NONE || now < to.program->count);
        for (size_t k = 0; k < i; k++) {
            assert_true(now == MATCH_NONE || now != matches.now[k]);
        }
        if (now != MATCH_NONE) {
            assert_int_equal(from.program->operations[i].op, to.program->operations[now].op);
        }
    }
    const struct found found = {matches.fresh, from.program->count - kept, matches_move(&matches),
                                matches.renumbered};
    matches_finish(&matches);
    engine_program_destroy((struct engine_program *)from.program);
    engine_program_destroy((struct engine_program *)to.program);
    return found;
}

static void assert_same(struct found got, struct found want)
{
    assert_int_equal(got.fresh, want.fresh);
    assert_int_equal(got.lost, want.lost);
    assert_int_equal(got.moved, want.moved);
    assert_int_equal(got.renumbered, want.renumbered);
}

static void assert_found(const char *before, const char *after, struct found want)
{
    assert_same(find_of(make("", before), make("", after)), want);
}

static void the_same_field_is_the_same(void **state)
{
    (void)state;
    assert_found(A "," B "," C, A "," B "," C, (struct found){0});
}

/* A shape and its operation. */
static void one_more_at_the_end_moves_none(void **state)
{
    (void)state;
    assert_found(A "," B "," C, A "," B "," C "," D, (struct found){.fresh = 2});
    assert_found(A "," B "," C "," D, A "," B "," C, (struct found){.lost = 2, .moved = true});
}

static void one_less_in_the_middle_moves_others(void **state)
{
    (void)state;
    assert_found(A "," B "," C "," D, A "," B "," D,
                 (struct found){.lost = 2, .moved = true, .renumbered = true});
}

/* One goes, one comes, and two change places. */
static void several_places_leave_the_rest(void **state)
{
    (void)state;
    assert_found(A "," B "," C "," D, A "," D "," C "," POLYGON("1"),
                 (struct found){.fresh = 1, .lost = 1, .moved = true, .renumbered = true});
}

static void other_numbers_have_their_place(void **state)
{
    (void)state;
    assert_found(A "," B "," C, A ",{'id':'b','type':'sphere','params':{'radius':0.25}}," C,
                 (struct found){.fresh = 1});
}

/* A list lies behind all blocks, wherever these end. */
static void lists_of_points_are_compared(void **state)
{
    (void)state;
    assert_found(A "," POLYGON("1"), A "," POLYGON("1") "," C, (struct found){.fresh = 2});
    assert_found(A "," POLYGON("1"), A "," POLYGON("2"), (struct found){.fresh = 1});
}

static void code_is_compared(void **state)
{
    (void)state;
    assert_same(find_of(make(CODE("0.5"), A "," OWN), make(CODE("0.5"), A "," OWN)),
                (struct found){0});
    assert_same(find_of(make(CODE("0.5"), A "," OWN), make(CODE("0.6"), A "," OWN)),
                (struct found){.fresh = 1, .lost = 1, .moved = true});
}

static void another_material_is_another_number(void **state)
{
    (void)state;
    assert_same(find_of(make(PHONG, A "," B), make(PHONG, A "," PAINTED_B)),
                (struct found){.renumbered = true});
}

static void words_keep_their_marks(void **state)
{
    uint32_t now[] = {2, MATCH_NONE, 0}, words[] = {0, 1 | TAPE_MOVE, 2 | TAPE_NEGATE, MATCH_NONE};
    const struct matches matches = {.now = now, .before = 3};

    (void)state;
    matches_rename(&matches, words, 4);
    assert_int_equal(words[0], 2);
    assert_int_equal(words[1], MATCH_NONE | TAPE_MOVE);
    assert_int_equal(words[2], TAPE_NEGATE);
    assert_int_equal(words[3], MATCH_NONE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_field_is_the_same),
        cmocka_unit_test(one_more_at_the_end_moves_none),
        cmocka_unit_test(one_less_in_the_middle_moves_others),
        cmocka_unit_test(several_places_leave_the_rest),
        cmocka_unit_test(other_numbers_have_their_place),
        cmocka_unit_test(lists_of_points_are_compared),
        cmocka_unit_test(code_is_compared),
        cmocka_unit_test(another_material_is_another_number),
        cmocka_unit_test(words_keep_their_marks),
    };

    return cmocka_run_group_tests_name("matches", tests, NULL, NULL);
}
