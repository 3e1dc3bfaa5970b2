/* SPDX-License-Identifier: MIT */
/* Letters of equations, numbers in their texts and sizes are numbers of a field: they compile
 * nothing. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "tests/support/equation_rows.h"
#include "tests/support/json_text.h"

/* A slider compiles nothing. */
static void letters_and_sizes_are_numbers(void **state)
{
    static const char text[] = "sin(a*x) + b*y = exp(z)*c";
    struct field *first = equation_rows_field(text, ""),
                 *other =
                     equation_rows_field(text, ",'b':2.5,'c':-1,'size':[3,1,2],'thickness':0.3"),
                 *more = equation_rows_field("sin(a*x) + b*y = exp(z)*c*c", "");
    (void)state;

    assert_true(first->structure_hash == other->structure_hash);
    assert_true(first->structure_hash != more->structure_hash);
    field_unref(first);
    field_unref(other);
    field_unref(more);
}

/* In a node's equation, and in a material's function. */
static void every_letter_is_a_number(void **state)
{
    static const double p[3] = {0.3, 0.2, -0.1};
    (void)state;

    for (int i = 0; equation_letters[i]; i++) {
        const char *letter = equation_letters[i];
        char text[64], value[32], json[512];
        struct error err = {0};
        snprintf(text, sizeof text, "sin(%s*x) + y = exp(z)", letter);
        snprintf(value, sizeof value, ",'%s':0.5", letter);
        struct field *one = equation_rows_field(text, ""),
                     *half = equation_rows_field(text, i > 0 ? value : "");
        assert_true(one->structure_hash == half->structure_hash);
        assert_true(i == 0 || fabs(field_distance(one, p) - field_distance(half, p)) > 1e-3);
        field_unref(one);
        field_unref(half);
        snprintf(json, sizeof json,
                 "{'format':'fieldcast/1','materials':{'m':{'shader':'map','properties':{"
                 "'function':'%s*x'%s}}},'root':{'type':'sphere','material':'m'}}",
                 letter, value);
        struct scene *scene = json_text_valid_scene(json);
        struct field *field = field_compile(scene, &err);
        if (!field) {
            fail_msg("%s: %s", letter, err.message);
        }
        field_unref(field);
        scene_destroy(scene);
    }
}

static void numbers_in_the_text_are_numbers(void **state)
{
    static const char text[] = "sin(2*x) + 0.5*y^2 = exp(z) + 1";
    static const double p[3] = {0.3, 0.2, -0.1};
    struct field *first = equation_rows_field(text, ""),
                 *other = equation_rows_field("sin(2.25*x) + 0.75*y^2 = exp(z) + 3", ""),
                 *more = equation_rows_field("sin(2*x) + 0.5*y^3 = exp(z) + 1", "");
    (void)state;

    assert_true(first->structure_hash == other->structure_hash);
    assert_true(first->structure_hash != more->structure_hash);
    assert_true(field_distance(first, p) < 0.9 * field_distance(other, p));
    field_unref(first);
    field_unref(other);
    field_unref(more);
}

#define WAVES(NUMBER, MORE)                                                                        \
    "{'type':'implicit','params':{'equation':'sin(" NUMBER "*x) = y + exp(z)'" MORE "}}"

static void equations_share_code_of_the_same_form(void **state)
{
    struct error err;
    struct scene *scene = json_text_valid_scene(
        "{'format':'fieldcast/1','root':{'type':'union','children':[" WAVES("2", "") "," WAVES(
            "3",
            "") "," WAVES("2",
                          ",'mode':'sheet'") ",{'type':'round','children':[" WAVES("2",
                                                                                   "") "]}]}}");
    struct field *field = field_compile(scene, &err);
    (void)state;

    assert_int_equal(field->code_count, 3);
    field_unref(field);
    scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_and_sizes_are_numbers),
        cmocka_unit_test(every_letter_is_a_number),
        cmocka_unit_test(numbers_in_the_text_are_numbers),
        cmocka_unit_test(equations_share_code_of_the_same_form),
    };

    return cmocka_run_group_tests_name("numbers of equations", tests, NULL, NULL);
}
