/* SPDX-License-Identifier: MIT */
/* Handles of parameters: each can be read, is where its shape has its surface or its place,
 * whatever the numbers, and moves with the value. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "protocol/kinds.h"
#include "renderer/sdf/sdf.h"
#include "tests/support/handle.h"
#include "tests/support/modified.h"

enum { SETS = 200, EVERY = -1 };
#define NEAR 1e-6 /* shapes are about 1 in size */

/* Points of shapes that are not on the surface. */
static const struct {
    const char *type, *param;
    int point;
} apart[] = {
    {"gyroid", "period", 0},     /* in the middle of the wall: its sides have no closed form */
    {"gyroid", "thickness", 0},  /* beside that, so far along the normal */
    {"gyroid", "size", EVERY},   /* on the box that cuts, which may do so in a hole */
    {"terrain", "size", 1},      /* as high as peaks may be; there may be none in the middle */
    {"implicit", "size", EVERY}, /* on the box that cuts */
    {"implicit", "radius", 0},   /* on the ball that cuts */
};

/* Numbers that a compact view shows and that are no counts, without a handle. A type of NULL: of
 * any that has them. */
static const struct {
    const char *type, *param;
} bare[] = {
    {"polygon", "points"}, /* a list: its points are places themselves */
    {"julia", "c"},        /* a place in four dimensions */
    {"implicit", "a"},     /* what a letter does, its equation says */
    {"morph", "t"},        /* a share of two shapes, which may be in one place */
    {NULL, "position"},    /* the gizmo moves what has one */
    {NULL, "direction"},   /* the gizmo turns what has one */
    {NULL, "intensity"},   /* how bright, not where */
    {NULL, "density"},     /* how thick, not where */
};

static bool is_apart(const char *type, const char *param, int point)
{
    for (size_t i = 0; i < sizeof apart / sizeof apart[0]; i++) {
        if (strcmp(apart[i].type, type) == 0 && strcmp(apart[i].param, param) == 0 &&
            (apart[i].point == EVERY || apart[i].point == point)) {
            return true;
        }
    }
    return false;
}

static bool is_bare(const char *type, const char *param)
{
    for (size_t i = 0; i < sizeof bare / sizeof bare[0]; i++) {
        if ((!bare[i].type || strcmp(bare[i].type, type) == 0) &&
            strcmp(bare[i].param, param) == 0) {
            return true;
        }
    }
    return false;
}

/* --- values --- */

static double *numbers(const struct record *record, const char *name)
{
    return record->values[record_type_find(record->type, name)].number;
}

/* What the words of a row take for granted. */
static void adjust(struct random *random, const struct record *record)
{
    const char *type = record->type->name;

    if (strcmp(type, "quad") == 0) { /* flat and convex */
        for (int i = 0; i < 3; i++) {
            numbers(record, "d")[i] =
                numbers(record, "a")[i] + numbers(record, "c")[i] - numbers(record, "b")[i];
        }
    } else if (strcmp(type, "death_star") == 0) { /* the two balls' surfaces meet */
        double *ball = numbers(record, "radius1"), *hollow = numbers(record, "radius2");
        double *distance = numbers(record, "distance");
        *distance = fmin(*distance, 0.99 * (*ball + *hollow));
        *ball = fmin(*ball, 0.99 * (*distance + *hollow));
    } else if (strcmp(type, "revolve") == 0) { /* what is beyond the axis is not drawn */
        *numbers(record, "offset") = fabs(*numbers(record, "offset"));
    } else if (strcmp(type, "repeat") == 0) {
        static const double copies[] = {-1, 2, 3, 4, 5};
        for (int i = 0; i < 3; i++) {
            numbers(record, "count")[i] = copies[random_below(random, 5)];
        }
    }
}

/* Numbers by the defaults times 0.7 to 1.3; a default of 0 by the numbers around it. */
static struct record random_record(struct random *random, const struct record_type *type)
{
    struct record record;

    record_init(&record, type);
    for (size_t i = 0; type->params[i].name; i++) {
        const struct param *param = &type->params[i];
        double low, high;
        param_range(param, &low, &high);
        if (param->type == PARAM_BOOL || param->type == PARAM_BVEC3 || param->type == PARAM_ENUM) {
            continue;
        }
        for (int k = 0; k < param_components(param->type); k++) {
            double *number = &record.values[i].number[k];
            const double factor = random_between(random, 0.7, 1.3);
            *number = param_is_whole(param->type) ? round(*number * factor)
                      : *number != 0              ? *number * factor
                                                  : random_between(random, fmax(low, -0.3), 0.3);
            *number = fmin(fmax(*number, low), high);
            record.values[i].set = true;
        }
    }
    adjust(random, &record);
    return record;
}

/* Every table with handles: nodes, lights, volumes; NULL behind the last. */
static const struct record_type *table_at(size_t index)
{
    if (index < node_type_count()) {
        return &node_type_at(index)->record;
    }
    index -= node_type_count();
    return index < LIGHT_KIND_COUNT                       ? &light_types[index]
           : index - LIGHT_KIND_COUNT < VOLUME_KIND_COUNT ? &volume_types[index - LIGHT_KIND_COUNT]
                                                          : NULL;
}

static int points_of(const struct param *param, const struct record *record,
                     double out[HANDLE_POINTS][3])
{
    const int count = handle_points(param->handle, record, out);
    const int components = param_components(param->type);

    if (count != 1 && (count == 0 || count != components)) {
        fail_msg("%s.%s: %d points in \"%s\"", record->type->name, param->name, count,
                 param->handle);
    }
    for (int i = 0; i < count; i++) {
        if (!isfinite(out[i][0]) || !isfinite(out[i][1]) || !isfinite(out[i][2])) {
            fail_msg("%s.%s: point %d is not finite", record->type->name, param->name, i);
        }
    }
    return count;
}

typedef void visit(const struct node_type *type, const struct record *record, int index);

/* For SETS records of each type that is chosen: every row with a handle. */
static void visit_handles(uint64_t seed, bool (*chosen)(const struct node_type *), visit *each)
{
    struct random random = {seed};
    int visited = 0;

    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        for (int set = 0; set < SETS && chosen(type); set++) {
            struct record record = random_record(&random, &type->record);
            for (int k = 0; type->record.params[k].name; k++) {
                if (type->record.params[k].handle) {
                    each(type, &record, k);
                    visited++;
                }
            }
            record_finish(&record);
        }
    }
    assert_true(visited > 0);
}

/* --- all --- */

/* How the point goes where the component grows; its length is per unit. */
static void direction_of(struct record *record, int index, int point, int component, double out[3])
{
    const struct param *param = &record->type->params[index];
    double *number = &record->values[index].number[component], kept = *number, step = 1e-5;
    double before[HANDLE_POINTS][3], after[HANDLE_POINTS][3];

    *number = kept - step;
    points_of(param, record, before);
    *number = kept + step;
    points_of(param, record, after);
    *number = kept;
    for (int i = 0; i < 3; i++) {
        out[i] = (after[point][i] - before[point][i]) / (2 * step);
    }
}

static void check_moves(struct record *record, int index)
{
    const struct param *param = &record->type->params[index];
    double points[HANDLE_POINTS][3], way[3];
    const int count = points_of(param, record, points);

    for (int k = 0; k < param_components(param->type); k++) {
        direction_of(record, index, count > 1 ? k : 0, k, way);
        if (!(hypot(hypot(way[0], way[1]), way[2]) > 0.01)) {
            fail_msg("%s.%s: component %d does not move its point", record->type->name, param->name,
                     k);
        }
    }
}

static void handles_move_with_their_values(void **state)
{
    (void)state;
    struct random random = {1};
    int handles = 0;
    const struct record_type *type;

    for (size_t i = 0; (type = table_at(i)); i++) {
        for (int set = 0; set < SETS; set++) {
            struct record record = random_record(&random, type);
            for (int k = 0; type->params[k].name; k++) {
                if (type->params[k].handle) {
                    check_moves(&record, k);
                    handles++;
                }
            }
            record_finish(&record);
        }
    }
    assert_true(handles > 100 * SETS);
}

/* Counts and colours are for fields. */
static bool is_for_hands(const struct param *param)
{
    const bool numbers = param->type == PARAM_FLOAT || param->type == PARAM_VEC2 ||
                         param->type == PARAM_VEC3 || param->type == PARAM_VEC4;

    return param->main && (numbers || param->type == PARAM_POINTS);
}

static void main_numbers_have_handles(void **state)
{
    (void)state;
    const struct record_type *type;

    for (size_t i = 0; (type = table_at(i)); i++) {
        for (const struct param *param = type->params; param->name; param++) {
            if (is_for_hands(param) &&
                (param->handle == NULL) != is_bare(type->name, param->name)) {
                fail_msg("%s.%s: %s", type->name, param->name,
                         param->handle ? "named as one without a handle" : "no handle");
            }
        }
    }
}

/* --- shapes --- */

static bool is_measured(const struct node_type *type)
{
    return type->kind == KIND_SHAPE || type->kind == KIND_FLAT;
}

static double distance(const struct node_type *type, const struct record *record, const double p[3])
{
    const struct sdf *sdf = sdf_find(type);
    double n[SDF_NUMBERS_MAX];

    sdf_numbers(type->record.params, record->values, n);
    if (sdf->prepare) {
        sdf->prepare(n);
    }
    return sdf->shape(p, n);
}

static void check_place(const struct record *record, int index, const double p[3])
{
    const struct param *param = &record->type->params[index];

    for (int i = 0; i < 3; i++) {
        const double wanted =
            i < param_components(param->type) ? record->values[index].number[i] : 0;
        if (fabs(p[i] - wanted) > NEAR) {
            fail_msg("%s.%s: not at the place", record->type->name, param->name);
        }
    }
}

/* A tenth less or more takes the surface away from where it is. */
static bool is_left(const struct node_type *type, const struct record *record, int index,
                    int component, const double p[3])
{
    double *number = &record->values[index].number[component], kept = *number, most = 0;

    for (int i = 0; i < 2; i++) {
        *number = kept * (i ? 1.1 : 0.9);
        most = fmax(most, fabs(distance(type, record, p)));
    }
    *number = kept;
    return most > 100 * NEAR || fabs(kept) < 0.01;
}

static void check_surface(const struct node_type *type, const struct record *record, int index)
{
    const struct param *param = &type->record.params[index];
    double points[HANDLE_POINTS][3];
    const int count = points_of(param, record, points);

    if (count == 1 && param_components(param->type) > 1) {
        check_place(record, index, points[0]);
        return;
    }
    for (int i = 0; i < count; i++) {
        const double *p = points[i], d = distance(type, record, p);
        if (is_apart(type->record.name, param->name, i)) {
            continue;
        }
        if (!(fabs(d) < NEAR) || (type->kind == KIND_FLAT && p[2] != 0)) {
            fail_msg("%s.%s: point %d at %g %g %g is %g from the surface", type->record.name,
                     param->name, i, p[0], p[1], p[2], d);
        }
        if (!is_left(type, record, index, i, p)) {
            fail_msg("%s.%s: the surface at point %d does not depend on it", type->record.name,
                     param->name, i);
        }
    }
}

static void handles_of_shapes_are_on_the_surface(void **state)
{
    (void)state;
    visit_handles(2, is_measured, check_surface);
}

/* Where the editor looks for the `skin` of a shape: the first length that is no place; -1: none. */
static int first_length(const struct record *record)
{
    const struct param *params = record->type->params;
    double points[HANDLE_POINTS][3];

    for (int i = 0; params[i].name; i++) {
        if (params[i].handle && params[i].unit == UNIT_LENGTH &&
            points_of(&params[i], record, points) == param_components(params[i].type)) {
            return i;
        }
    }
    return -1;
}

static void check_growth(const struct node_type *type, const struct record *record, int index)
{
    const struct param *param = &type->record.params[index];
    struct record moved = *record;
    double points[HANDLE_POINTS][3], way[3], d[2];

    if (index != first_length(record) || is_apart(type->record.name, param->name, 0)) {
        return;
    }
    points_of(param, record, points);
    direction_of(&moved, index, 0, 0, way);
    for (int i = 0; i < 2; i++) {
        const double by = i ? 1e-4 : -1e-4;
        const double p[3] = {points[0][0] + by * way[0], points[0][1] + by * way[1],
                             points[0][2] + by * way[2]};
        d[i] = distance(type, record, p);
    }
    if (!(d[1] > d[0])) {
        fail_msg("%s.%s: its point goes inwards", type->record.name, param->name);
    }
}

static void first_lengths_grow_outwards(void **state)
{
    (void)state;
    visit_handles(5, is_measured, check_growth);
}

/* --- modifiers --- */

/* What the skin is of: its radius is HANDLE_SKIN. */
#define BALL_OF(TYPE) "{'type':'" TYPE "','params':{'radius':0.5}}"

/* What is drawn around the handle, or ends there. */
static const struct {
    const char *type, *child;
} children[] = {
    {"repeat", "{'type':'sphere','params':{'radius':0.01}}"},
    {"repeat_polar", "{'type':'sphere','params':{'radius':0.01}}"},
    {"elongate", "{'type':'sphere','params':{'radius':0.01}}"},
    {"twist", "{'type':'sphere','params':{'radius':0.01},'transform':{'translation':[1,1,0]}}"},
    {"bend", "{'type':'capsule','params':{'a':[0,0,0],'b':[1,0,0],'radius':0.01}}"},
    {"revolve", "{'type':'circle','params':{'radius':0.01}}"},
    {"extrude", BALL_OF("circle")},
    {"round", BALL_OF("sphere")},
    {"shell", BALL_OF("sphere")},
};

static bool is_domain(const struct node_type *type)
{
    return type->kind == KIND_DOMAIN;
}

static struct field *field_around_child(const struct record *record)
{
    for (size_t i = 0; i < sizeof children / sizeof children[0]; i++) {
        if (strcmp(children[i].type, record->type->name) == 0) {
            cJSON *params = cJSON_CreateObject();
            char text[1024];
            record_print(record, params);
            char *printed = json_print(params, false);
            snprintf(text, sizeof text, "{'type':'%s','params':%s,'children':[%s]}",
                     record->type->name, printed, children[i].child);
            free(printed);
            cJSON_Delete(params);
            return modified_field(text);
        }
    }
    fail_msg("this test does not know what is at the handles of %s", record->type->name);
    return NULL;
}

static double beside(const struct field *field, const double p[3], const double way[3], double by)
{
    const double length = hypot(hypot(way[0], way[1]), way[2]);
    const double q[3] = {p[0] + by * way[0] / length, p[1] + by * way[1] / length,
                         p[2] + by * way[2] / length};

    return field_distance(field, q);
}

static bool has_skin(const struct param *param)
{
    return strstr(param->handle, "skin") != NULL;
}

/* Where a wave ends, there is nothing of the children. */
static bool is_wave(const struct param *param)
{
    return strcmp(param->name, "frequency") == 0;
}

static void check_modifier(const struct node_type *type, const struct record *record, int index)
{
    const struct param *param = &type->record.params[index];
    struct record moved = *record;
    double points[HANDLE_POINTS][3], way[3];

    if (has_skin(param) || is_wave(param)) {
        return;
    }
    struct field *field = field_around_child(record);
    const int count = points_of(param, record, points);
    assert_int_equal(count, param_components(param->type));
    for (int i = 0; i < count; i++) {
        direction_of(&moved, index, i, i, way);
        if (beside(field, points[i], way, -0.005) >= 0 || beside(field, points[i], way, 0.02) < 0) {
            fail_msg("%s.%s: point %d at %g %g %g is not there", type->record.name, param->name, i,
                     points[i][0], points[i][1], points[i][2]);
        }
    }
    field_unref(field);
}

static void handles_of_modifiers_are_where_children_come(void **state)
{
    (void)state;
    visit_handles(3, is_domain, check_modifier);
}

/* An amplitude's point is as far as the surface moves at most. */
static bool changes_all(const struct node_type *type)
{
    return type->kind == KIND_DISTANCE || strcmp(type->record.name, "extrude") == 0;
}

static void check_skin(const struct node_type *type, const struct record *record, int index)
{
    const struct param *param = &type->record.params[index];
    double points[HANDLE_POINTS][3];

    if (!has_skin(param)) {
        return;
    }
    struct field *field = field_around_child(record);
    assert_int_equal(points_of(param, record, points), 1);
    const double d = field_distance(field, points[0]);
    field_unref(field);
    if (!(fabs(d) < NEAR)) {
        fail_msg("%s.%s: %g from the surface", type->record.name, param->name, d);
    }
}

static void handles_at_the_skin_are_on_the_surface(void **state)
{
    (void)state;
    visit_handles(6, changes_all, check_skin);
}

/* --- lights and volumes --- */

static void volumes_have_the_handles_of_shapes(void **state)
{
    (void)state;
    for (const struct record_type *type = volume_types; type->name; type++) {
        const struct record_type *shape = &node_type_find(type->name)->record;
        const struct param *param = &shape->params[0];
        const int index = record_type_find(type, param->name);
        assert_string_equal(type->params[index].handle, param->handle);
    }
}

static void the_handle_of_a_spot_is_on_its_cone(void **state)
{
    (void)state;
    struct random random = {4};
    const struct record_type *type = &light_types[LIGHT_SPOT];
    const struct param *angle = &type->params[record_type_find(type, "angle")];

    for (int set = 0; set < SETS; set++) {
        struct record record = random_record(&random, type);
        double *way = numbers(&record, "direction"), points[HANDLE_POINTS][3];
        random_direction(&random, way);
        if (set == 0) { /* straight down, where most of them shine */
            way[0] = way[2] = 0;
            way[1] = -3;
        }
        assert_int_equal(points_of(angle, &record, points), 1);
        const double *p = points[0];
        const double along = p[0] * way[0] + p[1] * way[1] + p[2] * way[2];
        const double cosine = along / hypot(hypot(way[0], way[1]), way[2]);
        if (fabs(hypot(hypot(p[0], p[1]), p[2]) - 1) > NEAR ||
            fabs(cosine - cos(numbers(&record, "angle")[0])) > NEAR) {
            fail_msg("spot.angle: %g %g %g is not on the cone", p[0], p[1], p[2]);
        }
        record_finish(&record);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(main_numbers_have_handles),
        cmocka_unit_test(handles_move_with_their_values),
        cmocka_unit_test(handles_of_shapes_are_on_the_surface),
        cmocka_unit_test(first_lengths_grow_outwards),
        cmocka_unit_test(handles_at_the_skin_are_on_the_surface),
        cmocka_unit_test(handles_of_modifiers_are_where_children_come),
        cmocka_unit_test(volumes_have_the_handles_of_shapes),
        cmocka_unit_test(the_handle_of_a_spot_is_on_its_cone),
    };

    return cmocka_run_group_tests_name("handles", tests, NULL, NULL);
}
