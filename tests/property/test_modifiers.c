/* SPDX-License-Identifier: MIT */
/* What changes a distance or the space: inside is what the catalogue says, fields are bounds and no
 * steeper than the distance, factors are no greater than they must be, and a scaled modifier is the
 * same one, scaled. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/modified.h"

#define PI 3.141592653589793

static void random_point(struct random *random, double size, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = random_between(random, -size, size);
    }
}

static double distance_at(const char *root, double x, double y, double z)
{
    const double p[3] = {x, y, z};
    struct field *field = modified_field(root);
    const double d = field_distance(field, p);

    field_unref(field);
    return d;
}

static bool is_modifier(const struct node_type *type)
{
    return type->kind == KIND_DISTANCE || type->kind == KIND_DOMAIN;
}

/* Very many copies, or copies without end, have tests of their own. */
static bool is_told_by_words(const struct modified *modified)
{
    const double *n = modified->n;

    return strcmp(modified->type->record.name, "repeat") != 0 ||
           (n[3] >= 0 && n[4] >= 0 && n[5] >= 0 &&
            modified->whole->loop_trips < SDF_REPEAT_CELLS_MAX - 25);
}

/* The sign is that of the words, and the ball with the distance as its radius holds no point of
 * the other side. */
static void check_bound(struct random *random, const struct modified *modified,
                        modified_meaning *inside)
{
    for (int k = 0; k < 20; k++) {
        double p[3], direction[3], q[3];
        random_point(random, 2, p);
        const double d = field_distance(modified->whole, p);
        const bool in = inside(modified->child, p, modified->n) < 0;
        if (fabs(d) > 1e-5 && in != (d < 0)) {
            fail_msg("%g has the wrong sign at %g %g %g\n%s", d, p[0], p[1], p[2], modified->text);
        }
        for (int j = 0; j < 20 && fabs(d) > 1e-5; j++) {
            random_direction(random, direction);
            for (int i = 0; i < 3; i++) {
                q[i] = p[i] + direction[i] * (fabs(d) - 1e-5) * (j % 2 ? 1 : 0.8);
            }
            if ((inside(modified->child, q, modified->n) < 0) != in) {
                fail_msg("%g oversteps at %g %g %g\n%s", d, p[0], p[1], p[2], modified->text);
            }
        }
    }
}

static void fields_are_bounds_of_what_the_words_say(void **state)
{
    (void)state;
    struct random random = {41};
    size_t rows = 0;

    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        modified_meaning *inside = modified_meaning_find(type->record.name);
        int checked = 0;
        if (!is_modifier(type)) {
            continue;
        }
        if (!inside) {
            fail_msg("this test does not know what is inside a %s", type->record.name);
        }
        rows++;
        for (int round = 0; round < 150; round++) {
            struct modified modified = modified_random(&random, type, round % 2);
            if (is_told_by_words(&modified)) {
                check_bound(&random, &modified, inside);
                checked++;
            }
            modified_finish(&modified);
        }
        assert_true(checked > 30);
    }
    assert_int_equal(rows, modified_meaning_count());
}

static void boxes_hold_what_they_bound(void **state)
{
    (void)state;
    struct random random = {51};

    for (size_t i = 0; i < node_type_count(); i++) {
        for (int round = 0; round < 150 && is_modifier(node_type_at(i)); round++) {
            struct modified modified = modified_random(&random, node_type_at(i), round % 2);
            for (int k = 0; k < 300; k++) {
                double p[3];
                random_point(&random, round % 3 ? 2.5 : 6, p);
                if (!(modified_outside(&modified, p) <= 1e-5)) {
                    fail_msg("%g %g %g is outside\n%s", p[0], p[1], p[2], modified.text);
                }
            }
            modified_finish(&modified);
        }
    }
}

/* Children are blends; copies of those may jump (never above the distance), so theirs are exact. */
static void no_modifier_makes_a_field_steeper(void **state)
{
    (void)state;
    struct random random = {42};

    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        const bool copies = strncmp(type->record.name, "repeat", 6) == 0;
        for (int round = 0; round < 60 && is_modifier(type); round++) {
            struct modified modified = modified_random(&random, type, copies);
            for (int k = 0; k < 60; k++) {
                const double slope = modified_steepness(&random, &modified);
                if (!(slope <= 1 + 1e-3)) {
                    fail_msg("%g\n%s", slope, modified.text);
                }
            }
            modified_finish(&modified);
        }
    }
}

/* Near the point the field is nearly as steep as the distance, but nowhere steeper. */
static void assert_tight(const char *root, double x, double y, double z)
{
    struct random random = {43};
    struct field *field = modified_field(root);
    double worst = 0;

    for (int k = 0; k < 40000; k++) {
        double normal[3], p[3] = {x, y, z}, q[3];
        for (int i = 0; i < 3; i++) {
            p[i] += random_between(&random, -0.2, 0.2);
        }
        field_normal(field, p, 1e-5, normal);
        for (int i = 0; i < 3; i++) {
            q[i] = p[i] + 1e-4 * normal[i];
        }
        worst = fmax(worst, fabs(field_distance(field, q) - field_distance(field, p)) / 1e-4);
    }
    field_unref(field);
    if (!(worst > 0.95 && worst < 1.001)) {
        fail_msg("%g\n%s", worst, root);
    }
}

#define DOT(x, y, z)                                                                               \
    "'children':[{'type':'sphere','params':{'radius':0.01},'transform':{"                          \
    "'translation':[" #x "," #y "," #z "]}}]}"
#define FLOOR "'children':[{'type':'plane'}]}"

static void factors_are_no_greater_than_they_must_be(void **state)
{
    (void)state;
    assert_tight("{'type':'twist','params':{'rate':1.5}," DOT(1, 0, 0), 0.75, 0, 0);
    assert_tight("{'type':'bend','params':{'rate':1.5}," DOT(0, 1, 0), 0, 0.75, 0);
    assert_tight("{'type':'offset_space','params':{'amplitude':0.2,'frequency':8},"
                 "'children':[{'type':'plane','params':{'normal':[1,1,1]}}]}",
                 0, 0, 0);
    assert_tight("{'type':'offset_space','params':{'amplitude':[0,0.2,0],"
                 "'frequency':8},'children':[{'type':'plane','params':{"
                 "'normal':[0,1,0.48]}}]}",
                 0, 0, 0);
    assert_tight("{'type':'displace','params':{'amplitude':0.1,'frequency':[5,9,5]}," FLOOR,
                 PI / 10, 0, PI / 10);
    /* From some way on a displaced field is the plain one less the amplitude. */
    const char *noisy = "{'type':'displace_noise','params':{'amplitude':0.25}," FLOOR;
    const char *wavy = "{'type':'displace','params':{'amplitude':0.25}," FLOOR;
    assert_true(fabs(distance_at(noisy, 1, 9, 1) - 8.75) < 1e-6);
    assert_true(fabs(distance_at(wavy, 1, 9, 1) - 8.75) < 1e-6);
    assert_true(distance_at(noisy, 1, 0.3, 1) > 0.05 - 1e-6);
}

/* The same node in a scaled group. */
static struct field *scaled_field(const struct modified *modified, double scale)
{
    char *text;

    if (asprintf(&text, "{'type':'group','transform':{'scale':%.17g},'children':[%s]}", scale,
                 modified->text) < 0) {
        abort();
    }
    struct field *field = modified_field(text);
    free(text);
    return field;
}

static void modifiers_scale(void **state)
{
    (void)state;
    struct random random = {44};

    for (size_t i = 0; i < node_type_count(); i++) {
        for (int round = 0; round < 60 && is_modifier(node_type_at(i)); round++) {
            struct modified modified = modified_random(&random, node_type_at(i), true);
            const double scale = pow(2, random_between(&random, -4, 4));
            struct field *scaled = scaled_field(&modified, scale);
            for (int k = 0; k < 30; k++) {
                double p[3];
                random_point(&random, k % 2 ? 0.4 : 3, p);
                const double q[3] = {p[0] * scale, p[1] * scale, p[2] * scale};
                const double want = field_distance(modified.whole, p);
                const double got = field_distance(scaled, q) / scale;
                if (!(fabs(got - want) < 1e-5)) {
                    fail_msg("scaled by %g: %g instead of %g\n%s", scale, got, want, modified.text);
                }
            }
            field_unref(scaled);
            modified_finish(&modified);
        }
    }
}

static void loops_are_counted(void **state)
{
    (void)state;
    static const struct {
        const char *root;
        uint32_t trips;
    } cases[] = {
        {"{'type':'repeat_polar','params':{'count':12,'radius':2}," DOT(0, 0, 0), 2},
        {"{'type':'repeat_polar','params':{'count':12,'radius':0}," DOT(0, 0, 0), 12},
        {"{'type':'displace_noise','params':{'octaves':3}," DOT(0, 0, 0), 3},
        {"{'type':'repeat_polar','params':{'count':5,'radius':0},'children':[{'type':"
         "'displace_noise','params':{'octaves':7}," DOT(0, 0, 0) "]}",
         5 * (1 + 7)},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct field *field = modified_field(cases[i].root);
        assert_int_equal(field->loop_trips, cases[i].trips);
        field_unref(field);
    }
}

static void assert_same(const char *a, const char *b)
{
    struct random random = {47};
    struct field *fields[2] = {modified_field(a), modified_field(b)};

    for (int k = 0; k < 1000; k++) {
        double p[3];
        random_point(&random, 2, p);
        const double d = field_distance(fields[0], p), want = field_distance(fields[1], p);
        if (!(fabs(d - want) < 1e-6)) {
            fail_msg("%g instead of %g\n%s", d, want, a);
        }
    }
    field_unref(fields[0]);
    field_unref(fields[1]);
}

static void sections_make_known_shapes(void **state)
{
    (void)state;
    assert_same("{'type':'revolve','params':{'offset':0.7},'children':[{'type':"
                "'circle','params':{'radius':0.2}}]}",
                "{'type':'torus','params':{'radius':0.7,'tube':0.2}}");
    assert_same("{'type':'revolve','children':[{'type':'rectangle','params':{'size':"
                "[1.4,0.6]}}]}",
                "{'type':'cylinder','params':{'radius':0.7,'height':0.6}}");
    assert_same("{'type':'extrude','params':{'height':0.8},'children':[{'type':"
                "'rectangle','params':{'size':[1.4,0.6]}}]}",
                "{'type':'box','params':{'size':[1.4,0.6,0.8]}}");
    assert_same("{'type':'extrude','params':{'height':0.8},'children':[{'type':"
                "'circle','params':{'radius':0.6}}]}",
                "{'type':'cylinder','params':{'radius':0.6,'height':0.8},'transform':{"
                "'rotation':[1.5707963267948966,0,0]}}");
    assert_same("{'type':'extrude','params':{'height':0.8,'rounding':0.2},'children':[{"
                "'type':'circle','params':{'radius':0.6}}]}",
                "{'type':'round_cylinder','params':{'radius':0.6,'height':0.8,"
                "'rounding':0.2},'transform':{'rotation':[1.5707963267948966,0,0]}}");
    assert_same("{'type':'elongate','params':{'size':[0.3,0.4,0.5]},'children':[{"
                "'type':'box','params':{'size':[0.2,0.2,0.2]}}]}",
                "{'type':'box','params':{'size':[0.8,1,1.2]}}");
    assert_same("{'type':'elongate','params':{'size':[0,0.4,0]},'children':[{"
                "'type':'sphere','params':{'radius':0.5}}]}",
                "{'type':'capsule','params':{'a':[0,-0.4,0],'b':[0,0.4,0],"
                "'radius':0.5}}");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_are_bounds_of_what_the_words_say),
        cmocka_unit_test(boxes_hold_what_they_bound),
        cmocka_unit_test(no_modifier_makes_a_field_steeper),
        cmocka_unit_test(factors_are_no_greater_than_they_must_be),
        cmocka_unit_test(modifiers_scale),
        cmocka_unit_test(loops_are_counted),
        cmocka_unit_test(sections_make_known_shapes),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
