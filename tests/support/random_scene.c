/* SPDX-License-Identifier: MIT */
/* Random scenes. Parameters come from the registry's rows: a new row needs nothing here. */
#include "random_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "json_text.h"
#include "protocol/limits.h"
#include "renderer/sdf/sdf.h"

/* splitmix64 (Steele, Lea, Flood, Fast splittable pseudorandom number generators, 2014). */
static uint64_t next(struct random *random)
{
    uint64_t z = random->state += UINT64_C(0x9e3779b97f4a7c15);

    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

double random_between(struct random *random, double low, double high)
{
    return low + (high - low) * (double)(next(random) >> 11) * 0x1p-53;
}

size_t random_below(struct random *random, size_t count)
{
    return (size_t)(next(random) % count);
}

void random_direction(struct random *random, double out[3])
{
    const double y = random_between(random, -1, 1), angle = random_between(random, 0, 2 * acos(-1));
    const double r = sqrt(1 - y * y);

    out[0] = r * cos(angle);
    out[1] = y;
    out[2] = r * sin(angle);
}

static bool is_whole(const struct param *param)
{
    return param->type == PARAM_INT || param->type == PARAM_IVEC3;
}

/* The part of a row's range that is drawn from: around its default, or around 0. */
static void useful_range(struct random *random, const struct param *param, int part,
                         const struct random_limits *limits, double *low, double *high)
{
    double least, most, usual = fabs(param->def[part]);

    param_range(param, &least, &most);
    if (is_whole(param)) {
        const bool ends = param->type == PARAM_IVEC3 && limits->bounded && limits->inner;
        *low = fmax(least, ends ? 0 : -1); /* -1: copies without end */
        *high = fmin(most, *low + 5);
    } else if (param->unit == UNIT_ANGLE || least < 0) {
        const double size = param->unit == UNIT_ANGLE ? 3 : 1;
        *low = fmax(least, -size);
        *high = fmin(most, size);
    } else if (usual > 0 && random_below(random, 8)) {
        *low = fmax(least, 0.3 * usual);
        *high = fmin(most, 2.4 * usual);
    } else {
        *low = least + (param->above_min ? 0.15 : 0);
        *high = fmin(most, least + 1.2);
    }
    if (param->unit == UNIT_LENGTH) {
        *high = fmin(*high, 4); /* the scene stays small */
    }
}

/* One component of a parameter: legal, mostly usual, now and then at a limit. */
static double component(struct random *random, const struct param *param, int part,
                        const struct random_limits *limits)
{
    double least, most, low, high;

    if (param->type == PARAM_BOOL || param->type == PARAM_BVEC3) {
        return (double)random_below(random, 2);
    }
    param_range(param, &least, &most);
    if (random_below(random, 16) == 0 && most <= LIMIT_POINTS && least >= -LIMIT_POINTS) {
        return random_below(random, 2) && !param->above_min ? least : most;
    }
    useful_range(random, param, part, limits, &low, &high);
    return is_whole(param) ? low + (double)random_below(random, (size_t)(high - low) + 1)
                           : random_between(random, low, high);
}

static int component_count(const struct param *param)
{
    return param->type == PARAM_ENUM ? 0 : param_components(param->type);
}

static void random_components(struct random *random, const struct param *param,
                              const struct random_limits *limits, double *out)
{
    for (int i = 0; i < component_count(param); i++) {
        out[i] = component(random, param, i, limits);
    }
}

/* The corners of a simple polygon around the origin, in either order. */
static void random_corners(struct random *random, size_t count, double *out)
{
    const double step = 2 * acos(-1) / (double)count * (random_below(random, 2) ? 1 : -1);
    const double phase = random_between(random, 0, 7);

    for (size_t i = 0; i < count; i++) {
        const double angle = phase + step * ((double)i + random_between(random, 0, 0.4));
        const double radius = random_between(random, 0.2, 1);
        out[2 * i] = radius * cos(angle);
        out[2 * i + 1] = radius * sin(angle);
    }
}

static void write_components(FILE *out, const struct param *param, const double *numbers)
{
    const int count = component_count(param);
    const bool boolean = param->type == PARAM_BOOL || param->type == PARAM_BVEC3;

    fprintf(out, count > 1 ? "[" : "");
    for (int i = 0; i < count; i++) {
        fprintf(out, i ? "," : "");
        if (boolean) {
            fprintf(out, numbers[i] != 0 ? "true" : "false");
        } else {
            fprintf(out, "%.9g", numbers[i]);
        }
    }
    fprintf(out, count > 1 ? "]" : "");
}

static void write_corners(struct random *random, FILE *out, const struct param *param)
{
    double corners[2 * LIMIT_POINTS];
    const size_t least = (size_t)param->min;
    const size_t count =
        random_below(random, 16) ? least + random_below(random, 8) : (size_t)param->max;

    random_corners(random, count, corners);
    for (size_t i = 0; i < count; i++) {
        fprintf(out, "%s[%.9g,%.9g]", i ? "," : "[", corners[2 * i], corners[2 * i + 1]);
    }
    fprintf(out, "]");
}

static void write_choice(struct random *random, FILE *out, const struct param *param)
{
    size_t count = 0;

    while (param->choices[count]) {
        count++;
    }
    fprintf(out, "'%s'", param->choices[random_below(random, count)]);
}

/* Names and code keep their defaults. */
static void write_params(struct random *random, FILE *out, const struct node_type *type,
                         const struct random_limits *limits)
{
    const char *comma = "";

    fprintf(out, "'params':{");
    for (const struct param *param = type->record.params; param->name; param++) {
        if (component_count(param) == 0 && param->type != PARAM_ENUM &&
            param->type != PARAM_POINTS && param->type != PARAM_SURFACE) {
            continue;
        }
        fprintf(out, "%s'%s':", comma, param->name);
        comma = ",";
        if (param->type == PARAM_SURFACE) {
            fprintf(out, "{'x':'s*cos(t)','y':'0.3*cos(a)*(t-s)','z':'s*sin(t+b*s)','s':[-0.6,1],"
                         "'t':[0,4]}");
        } else if (param->type == PARAM_ENUM) {
            write_choice(random, out, param);
        } else if (param->type == PARAM_POINTS) {
            write_corners(random, out, param);
        } else {
            double numbers[4];
            random_components(random, param, limits, numbers);
            write_components(out, param, numbers);
        }
    }
    fprintf(out, "}");
}

/* Flat shapes that must end stay in the plane of their section. */
static void random_transform(struct random *random, const struct node_type *type,
                             const struct random_limits *limits, double translation[3],
                             double rotation[3], double scale[3])
{
    const bool uniform = limits->exact || random_below(random, 2);
    const double all = random_between(random, 0.6, 1.4);

    for (int i = 0; i < 3; i++) {
        translation[i] = random_between(random, -1, 1);
        rotation[i] = random_between(random, -3.2, 3.2);
        scale[i] = uniform ? all : random_between(random, 0.6, 1.4);
        scale[i] *= random_below(random, 8) == 0 ? -1 : 1;
    }
    if (type->kind == KIND_FLAT && limits->bounded) {
        rotation[0] = rotation[1] = 0;
    }
}

static void write_transform(struct random *random, FILE *out, const struct node_type *type,
                            const struct random_limits *limits)
{
    double t[3], r[3], s[3];

    random_transform(random, type, limits, t, r, s);
    fprintf(out,
            ",'transform':{'translation':[%.9g,%.9g,%.9g],'rotation':[%.9g,%.9g,%.9g],"
            "'scale':[%.9g,%.9g,%.9g]}",
            t[0], t[1], t[2], r[0], r[1], r[2], s[0], s[1], s[2]);
}

static bool is_section(const struct node_type *type)
{
    return strcmp(type->record.name, "extrude") == 0 || strcmp(type->record.name, "revolve") == 0;
}

static bool is_endless(const struct node_type *type)
{
    const struct sdf *sdf = sdf_find(type);
    double numbers[SDF_NUMBERS_MAX];
    struct record record;

    record_init(&record, &type->record);
    sdf_numbers(type->record.params, record.values, numbers);
    record_finish(&record);
    if (sdf->prepare) {
        sdf->prepare(numbers);
    }
    struct bounds box = sdf->box(numbers);
    return !bounds_is_finite(&box);
}

static bool allowed(const struct node_type *type, const struct random_limits *limits)
{
    const bool shape = type->kind == KIND_SHAPE || type->kind == KIND_FLAT;

    if (shape && limits->exact && type->exactness != EXACT) {
        return false;
    }
    return type->kind != KIND_SHAPE || !limits->bounded || !is_endless(type);
}

const struct node_type *random_type(struct random *random, enum node_kind kind,
                                    const struct random_limits *limits)
{
    for (;;) {
        const struct node_type *type = node_type_at(random_below(random, node_type_count()));
        if (type->kind == kind && allowed(type, limits)) {
            return type;
        }
    }
}

static const struct node_type *random_section(struct random *random)
{
    return node_type_find(random_below(random, 2) ? "extrude" : "revolve");
}

/* A shape, among them sections of flat ones, which are bounds, and now and then a flat one without
 * an end. */
static const struct node_type *random_leaf(struct random *random,
                                           const struct random_limits *limits)
{
    if (limits->exact || random_below(random, 4)) {
        return random_type(random, KIND_SHAPE, limits);
    }
    return limits->bounded || random_below(random, 12) ? random_section(random)
                                                       : random_type(random, KIND_FLAT, limits);
}

static const struct node_type *random_child(struct random *random, const struct node_type *parent,
                                            const struct random_limits *limits, bool first)
{
    const bool deeper = limits->depth > 0 && (limits->lean ? first : random_below(random, 3) != 0);

    if (is_section(parent) && !(limits->lean && deeper) && random_below(random, 4)) {
        return random_type(random, KIND_FLAT, limits);
    }
    if (deeper) {
        return random_type(random, (enum node_kind)(KIND_COMBINE + random_below(random, 4)),
                           limits);
    }
    return limits->depth < 0 ? random_type(random, KIND_SHAPE, limits)
                             : random_leaf(random, limits);
}

static size_t random_child_count(struct random *random, const struct node_type *type,
                                 const struct random_limits *limits)
{
    if (type->kind == KIND_SHAPE || type->kind == KIND_FLAT) {
        return limits->depth > 0 && random_below(random, 6) == 0;
    }
    return (type->kind == KIND_COMBINE ? 2 : 1) + (limits->lean ? 0 : random_below(random, 2));
}

void random_node(struct random *random, FILE *out, const struct node_type *type,
                 const struct random_limits *limits)
{
    fprintf(out, "{'type':'%s',", type->record.name);
    write_params(random, out, type, limits);
    if (!limits->plain) {
        write_transform(random, out, type, limits);
    }
    if (random_below(random, 2)) {
        fprintf(out, ",'material':'m%zu'", random_below(random, 3));
    }
    const size_t count = random_child_count(random, type, limits);
    struct random_limits below = *limits;
    below.depth--;
    below.inner = true;
    for (size_t i = 0; i < count; i++) {
        fprintf(out, i ? "," : ",'children':[");
        random_node(random, out, random_child(random, type, &below, i == 0), &below);
    }
    fprintf(out, count ? "]}" : "}");
}

static void write_material(struct random *random, FILE *out, const struct record_type *shader)
{
    fprintf(out, "{'shader':'%s','properties':{", shader->name);
    for (const struct param *param = shader->params; param->name; param++) {
        const double low = fmax(param->min, 0.5), high = fmin(param->max, 4 * low);
        fprintf(out, "%s'%s':", param == shader->params ? "" : ",", param->name);
        if (param->type == PARAM_COLOR) {
            fprintf(out, "[%.9g,%.9g,%.9g]", random_between(random, 0.2, 1),
                    random_between(random, 0.2, 1), random_between(random, 0.2, 1));
        } else {
            fprintf(out, "%.9g", random_between(random, low, high));
        }
    }
    fprintf(out, "}}");
}

static void write_materials(struct random *random, FILE *out)
{
    static const char *const shaders[] = {"phong", "standard", "blinn"};

    fprintf(out, "'materials':{");
    for (int i = 0; i < 3; i++) {
        fprintf(out, "%s'm%d':", i ? "," : "", i);
        write_material(random, out, record_type_in(shader_types, shaders[i]));
    }
    fprintf(out, "}");
}

struct scene *random_scene(struct random *random, const struct node_type *type,
                           const struct random_limits *limits)
{
    char *text;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    if (!out) {
        abort();
    }
    fprintf(out, "{'format':'fieldcast/1',");
    write_materials(random, out);
    fprintf(out, ",'root':");
    random_node(random, out, type, limits);
    fprintf(out, "}");
    fclose(out);
    struct error err = {0};
    struct scene *scene = json_text_scene(text, &err);
    if (!scene) {
        error_print(&err, stderr);
        abort();
    }
    free(text);
    return scene;
}

static void random_values(struct random *random, const struct param *param, struct value *value,
                          const struct random_limits *limits)
{
    random_components(random, param, limits, value->number);
    if (param->type == PARAM_POINTS) {
        random_corners(random, (size_t)value->number[0], value->points);
    }
}

void random_numbers(struct random *random, struct node *node, const struct random_limits *limits)
{
    const struct param *params = node->type->record.params;
    struct random_limits here = *limits;

    here.inner = node->parent != NULL;
    for (size_t i = 0; params[i].name; i++) {
        random_values(random, &params[i], &node->params.values[i], &here);
    }
    if (!limits->plain) {
        double parts[3][3];
        static const char *const names[] = {"translation", "rotation", "scale"};
        random_transform(random, node->type, limits, parts[0], parts[1], parts[2]);
        for (int i = 0; i < 3; i++) {
            const int at = record_type_find(&transform_type, names[i]);
            memcpy(node->transform.values[at].number, parts[i], sizeof parts[i]);
        }
    }
    for (size_t i = 0; i < node->child_count; i++) {
        random_numbers(random, node->children[i], limits);
    }
}
