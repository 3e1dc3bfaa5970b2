/* SPDX-License-Identifier: MIT */
/* Random scenes. Parameters come from the registry's rows: a new row needs nothing here. */
#include "random_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    double y = random_between(random, -1, 1), angle = random_between(random, 0, 2 * acos(-1));
    double r = sqrt(1 - y * y);
    out[0] = r * cos(angle);
    out[1] = y;
    out[2] = r * sin(angle);
}

/* One component of a parameter, somewhere useful inside its range. */
static double component(struct random *random, const struct param *param)
{
    switch (param->type) {
    case PARAM_BOOL:
    case PARAM_BVEC3:
        return (double)random_below(random, 2);
    case PARAM_INT:
    case PARAM_IVEC3:
        return (double)random_below(random, 6) - 1;
    case PARAM_ENUM:
        return 0;
    default:
        break;
    }
    if (param->unit == UNIT_ANGLE) {
        return random_between(random, -3, 3);
    }
    if (param->min == 0 && param->max > 0) {
        return random_between(random, param->above_min ? 0.15 : 0, 1.2);
    }
    return random_between(random, -1, 1);
}

static void write_value(FILE *out, const struct param *param, const double *numbers)
{
    int count = param_components(param->type);
    bool boolean = param->type == PARAM_BOOL || param->type == PARAM_BVEC3;
    fprintf(out, count == 3 ? "[" : "");
    for (int i = 0; i < count; i++) {
        fprintf(out, i ? "," : "");
        if (boolean) {
            fprintf(out, numbers[i] != 0 ? "true" : "false");
        } else {
            fprintf(out, "%.9g", numbers[i]);
        }
    }
    fprintf(out, count == 3 ? "]" : "");
}

static void write_params(struct random *random, FILE *out, const struct node_type *type)
{
    fprintf(out, "\"params\":{");
    const char *comma = "";
    for (const struct param *param = type->record.params; param->name; param++) {
        if (param->type == PARAM_ENUM || param_components(param->type) == 0) {
            continue;
        }
        double numbers[3];
        for (int i = 0; i < 3; i++) {
            numbers[i] = component(random, param);
        }
        fprintf(out, "%s\"%s\":", comma, param->name);
        write_value(out, param, numbers);
        comma = ",";
    }
    fprintf(out, "}");
}

static void random_transform(struct random *random, const struct random_limits *limits,
                             double translation[3], double rotation[3], double scale[3])
{
    bool uniform = limits->exact || random_below(random, 2);
    double all = random_between(random, 0.6, 1.4);
    for (int i = 0; i < 3; i++) {
        translation[i] = random_between(random, -1, 1);
        rotation[i] = random_between(random, -3.2, 3.2);
        scale[i] = uniform ? all : random_between(random, 0.6, 1.4);
        scale[i] *= random_below(random, 8) == 0 ? -1 : 1;
    }
}

static void write_transform(struct random *random, FILE *out, const struct random_limits *limits)
{
    double t[3], r[3], s[3];
    random_transform(random, limits, t, r, s);
    fprintf(out,
            ",\"transform\":{\"translation\":[%.9g,%.9g,%.9g],\"rotation\":[%.9g,%.9g,%.9g],"
            "\"scale\":[%.9g,%.9g,%.9g]}",
            t[0], t[1], t[2], r[0], r[1], r[2], s[0], s[1], s[2]);
}

static bool allowed(const struct node_type *type, const struct random_limits *limits)
{
    if (limits->bounded && strcmp(type->record.name, "plane") == 0) {
        return false;
    }
    return !limits->exact || type->kind != KIND_SHAPE || type->exactness == EXACT;
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

void random_node(struct random *random, FILE *out, const struct node_type *type,
                 const struct random_limits *limits)
{
    fprintf(out, "{\"type\":\"%s\",", type->record.name);
    write_params(random, out, type);
    if (!limits->plain) {
        write_transform(random, out, limits);
    }
    if (random_below(random, 2)) {
        fprintf(out, ",\"material\":\"m%zu\"", random_below(random, 3));
    }
    size_t count = type->kind == KIND_SHAPE     ? (limits->depth > 0 && !random_below(random, 6))
                   : type->kind == KIND_COMBINE ? 2 + random_below(random, 2)
                                                : 1 + random_below(random, 2);
    struct random_limits below = *limits;
    below.depth--;
    if (count) {
        fprintf(out, ",\"children\":[");
        for (size_t i = 0; i < count; i++) {
            bool deeper = below.depth > 0 && random_below(random, 3);
            const struct node_type *child =
                deeper
                    ? random_type(random, (enum node_kind)(KIND_COMBINE + random_below(random, 4)),
                                  limits)
                    : random_type(random, KIND_SHAPE, limits);
            fprintf(out, i ? "," : "");
            random_node(random, out, child, &below);
        }
        fprintf(out, "]");
    }
    fprintf(out, "}");
}

static void write_materials(struct random *random, FILE *out)
{
    static const char *const names[] = {"diffuse", "specular", "emission", "ambient"};
    fprintf(out, "\"materials\":{");
    for (int i = 0; i < 3; i++) {
        fprintf(out, "%s\"m%d\":{\"shader\":\"phong\",\"properties\":{\"shininess\":%.9g",
                i ? "," : "", i, random_between(random, 1, 100));
        for (int j = 0; j < 4; j++) {
            fprintf(out, ",\"%s\":[%.9g,%.9g,%.9g]", names[j], random_between(random, 0, 1),
                    random_between(random, 0, 1), random_between(random, 0, 1));
        }
        fprintf(out, "}}");
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
    fprintf(out, "{\"format\":\"fieldcast/1\",");
    write_materials(random, out);
    fprintf(out, ",\"root\":");
    random_node(random, out, type, limits);
    fprintf(out, "}");
    fclose(out);
    struct error err = {0};
    struct scene *scene = scene_parse(text, length, &err);
    if (!scene) {
        error_print(&err, stderr);
        abort();
    }
    free(text);
    return scene;
}

void random_numbers(struct random *random, struct node *node, const struct random_limits *limits)
{
    const struct param *params = node->type->record.params;
    for (size_t i = 0; params[i].name; i++) {
        for (int c = 0; c < param_components(params[i].type); c++) {
            node->params.values[i].number[c] = component(random, &params[i]);
        }
    }
    if (!limits->plain) {
        double parts[3][3];
        static const char *const names[] = {"translation", "rotation", "scale"};
        random_transform(random, limits, parts[0], parts[1], parts[2]);
        for (int i = 0; i < 3; i++) {
            int at = record_type_find(&transform_type, names[i]);
            memcpy(node->transform.values[at].number, parts[i], sizeof parts[i]);
        }
    }
    for (size_t i = 0; i < node->child_count; i++) {
        random_numbers(random, node->children[i], limits);
    }
}
