/* SPDX-License-Identifier: MIT */
/* Modifiers around a child. Insides are told by other means than in the functions under test. */
#include "modified.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compiled.h"
#include "json_text.h"
#include "protocol/json.h"
#include "renderer/sdf/noise.h"

#define PI 3.141592653589793

/* --- what is inside, by the words of the catalogue --- */

static double at(const struct field *child, double x, double y, double z)
{
    const double p[3] = {x, y, z};

    return field_distance(child, p);
}

static double round_at(const struct field *child, const double p[3], const double *n)
{
    return field_distance(child, p) - n[0];
}

static double shell_at(const struct field *child, const double p[3], const double *n)
{
    return fabs(field_distance(child, p)) - n[0];
}

static double mirror_at(const struct field *child, const double p[3], const double *n)
{
    return at(child, n[0] != 0 ? fabs(p[0]) : p[0], n[1] != 0 ? fabs(p[1]) : p[1],
              n[2] != 0 ? fabs(p[2]) : p[2]);
}

static double middle_out(double x, double half)
{
    return x > half ? x - half : x < -half ? x + half : 0;
}

static double elongate_at(const struct field *child, const double p[3], const double *n)
{
    return at(child, middle_out(p[0], n[0]), middle_out(p[1], n[1]), middle_out(p[2], n[2]));
}

/* Rotations about an axis are right-handed: +Z to +X about +Y, +X to +Y about +Z. */
static double twist_at(const struct field *child, const double p[3], const double *n)
{
    const double c = cos(-n[0] * p[1]), s = sin(-n[0] * p[1]);

    return at(child, c * p[0] + s * p[2], p[1], -s * p[0] + c * p[2]);
}

static double bend_at(const struct field *child, const double p[3], const double *n)
{
    const double c = cos(-n[0] * p[0]), s = sin(-n[0] * p[0]);

    return at(child, c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]);
}

static double offset_at(const struct field *child, const double p[3], const double *n)
{
    return at(child, p[0] + n[0] * sin(n[3] * p[1]), p[1] + n[1] * sin(n[4] * p[2]),
              p[2] + n[2] * sin(n[5] * p[0]));
}

static double displace_at(const struct field *child, const double p[3], const double *n)
{
    const double waves = sin(n[1] * p[0]) * sin(n[2] * p[1]) * sin(n[3] * p[2]);

    return field_distance(child, p) + n[0] * waves;
}

static double noise_at(const struct field *child, const double p[3], const double *n)
{
    const double q[3] = {n[1] * p[0], n[1] * p[1], n[1] * p[2]};
    double noise = noise_octaves(q, (int)n[2], (uint32_t)n[3]), sum = 0;

    for (int i = 0; i < (int)n[2]; i++) {
        sum += pow(2, -i);
    }
    return field_distance(child, p) + n[0] * noise / sum;
}

static double extrude_at(const struct field *child, const double p[3], const double *n)
{
    const double r = fmin(n[1], n[0] / 2), side = at(child, p[0], p[1], 0) + r;
    const double cap = fabs(p[2]) - n[0] / 2 + r;

    return side > 0 && cap > 0 ? sqrt(side * side + cap * cap) - r : fmax(side, cap) - r;
}

static double revolve_at(const struct field *child, const double p[3], const double *n)
{
    return at(child, sqrt(p[0] * p[0] + p[2] * p[2]) - n[0], p[1], 0);
}

static double polar_at(const struct field *child, const double p[3], const double *n)
{
    double least = INFINITY;

    for (int i = 0; i < (int)n[0]; i++) {
        const double c = cos(2 * PI * i / n[0]), s = sin(2 * PI * i / n[0]);
        least = fmin(least, at(child, c * p[0] + s * p[2] - n[1], p[1], c * p[2] - s * p[0]));
    }
    return least;
}

static double repeat_at(const struct field *child, const double p[3], const double *n)
{
    int count[3];
    double least = INFINITY;

    for (int i = 0; i < 3; i++) {
        count[i] = n[3 + i] > 0 ? (int)n[3 + i] : 1;
    }
    for (int i = 0; i < count[0] * count[1] * count[2]; i++) {
        const int k[3] = {i % count[0], i / count[0] % count[1], i / count[0] / count[1]};
        double q[3];
        for (int j = 0; j < 3; j++) {
            q[j] = p[j] - n[j] * (k[j] - (count[j] - 1) / 2.0);
        }
        least = fmin(least, field_distance(child, q));
    }
    return least;
}

static const struct {
    const char *type;
    modified_meaning *at;
} meanings[] = {
    {"round", round_at},         {"shell", shell_at},       {"mirror", mirror_at},
    {"elongate", elongate_at},   {"twist", twist_at},       {"bend", bend_at},
    {"offset_space", offset_at}, {"displace", displace_at}, {"displace_noise", noise_at},
    {"extrude", extrude_at},     {"revolve", revolve_at},   {"repeat", repeat_at},
    {"repeat_polar", polar_at},
};

modified_meaning *modified_meaning_find(const char *type)
{
    for (size_t i = 0; i < modified_meaning_count(); i++) {
        if (strcmp(meanings[i].type, type) == 0) {
            return meanings[i].at;
        }
    }
    return NULL;
}

size_t modified_meaning_count(void)
{
    return sizeof meanings / sizeof meanings[0];
}

/* --- scenes --- */

static struct scene *scene_of(const char *root)
{
    struct error err = {0};
    char *text;

    if (asprintf(&text,
                 "{'format':'fieldcast/1','materials':{'m0':{'shader':'phong'},'m1':{"
                 "'shader':'phong'},'m2':{'shader':'phong'}},'root':%s}",
                 root) < 0) {
        abort();
    }
    struct scene *scene = json_text_scene(text, &err);
    if (!scene) {
        error_print(&err, stderr);
        abort();
    }
    free(text);
    return scene;
}

struct field *modified_field(const char *node)
{
    struct scene *scene = scene_of(node);
    struct field *field = compile_field(scene);

    scene_destroy(scene);
    return field;
}

struct modified modified_create(const char *type, const char *params, const char *child)
{
    struct modified modified = {.type = node_type_find(type)};

    if (asprintf(&modified.text, "{'type':'%s','params':%s,'children':[%s]}", type, params, child) <
        0) {
        abort();
    }
    modified.whole = modified_field(modified.text);
    modified.child = modified_field(child);
    return modified;
}

static char *random_child(struct random *random, const struct random_limits *limits, bool flat,
                          bool blend)
{
    char *text;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    const enum node_kind kind = flat ? KIND_FLAT : KIND_SHAPE;

    if (!out) {
        abort();
    }
    fprintf(out, blend ? "{'type':'smooth_union','params':{'k':0.3},'children':[" : "");
    random_node(random, out, random_type(random, kind, limits), limits);
    if (blend) {
        fprintf(out, ",");
        random_node(random, out, random_type(random, kind, limits), limits);
        fprintf(out, "]}");
    }
    fclose(out);
    return text;
}

static bool is_section(const struct node_type *type)
{
    return strcmp(type->record.name, "extrude") == 0 || strcmp(type->record.name, "revolve") == 0;
}

struct modified modified_random(struct random *random, const struct node_type *type, bool exact)
{
    const struct random_limits limits = {.bounded = true, .exact = exact, .inner = true};
    const struct random_limits plain = {.bounded = true, .plain = true};
    const bool flat = is_section(type) && random_below(random, 4);
    char *child = random_child(random, &limits, flat, !exact);
    struct scene *scene = random_scene(random, type, &plain);
    cJSON *object = cJSON_CreateObject();

    record_print(&scene->root->params, object);
    char *params = json_print(object, false);
    struct modified modified = modified_create(type->record.name, params, child);
    sdf_numbers(type->record.params, scene->root->params.values, modified.n);
    scene_destroy(scene);
    cJSON_Delete(object);
    free(params);
    free(child);
    return modified;
}

void modified_finish(struct modified *modified)
{
    field_unref(modified->whole);
    field_unref(modified->child);
    free(modified->text);
}

/* --- bounds --- */

double modified_outside(const struct modified *modified, const double p[3])
{
    const struct bounds *box = &modified->whole->bounds;
    double d = field_distance(modified->whole, p), square = 0;

    for (int i = 0; i < 3; i++) {
        const double out = fmax(fmax(box->low[i] - p[i], p[i] - box->high[i]), 0);
        square += out * out;
    }
    return sqrt(square) - fmax(d, 0) * box->stretch;
}

/* Anywhere, and where one cell, side or piece becomes another. */
static void random_seam(struct random *random, const struct modified *modified, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = random_between(random, -2.5, 2.5);
    }
    const int axis = (int)random_below(random, 3);
    switch (random_below(random, 4)) {
    case 0:
        out[axis] = 0;
        break;
    case 1: /* faces of what is elongated or extruded; cell walls */
        out[axis] = modified->n[axis] * (random_below(random, 2) ? 0.5 : -1);
        break;
    case 2: { /* between copies around the axis */
        double angle =
            PI / fmax(round(modified->n[0]), 1) * (double)(1 + 2 * random_below(random, 9));
        const double r = hypot(out[0], out[2]);
        out[0] = r * cos(angle);
        out[2] = r * sin(angle);
        break;
    }
    default:
        break;
    }
}

double modified_steepness(struct random *random, const struct modified *modified)
{
    double p[3], q[3], direction[3], worst = 0;

    random_seam(random, modified, p);
    const double d = field_distance(modified->whole, p);
    for (int k = 0; k < 4; k++) {
        const double step =
            pow(10, random_between(random, -3, 0.4)); /* numbers are those of floats */
        random_direction(random, direction);
        if (k == 0) {
            field_normal(modified->whole, p, 1e-5, direction);
        }
        for (int i = 0; i < 3; i++) {
            q[i] = p[i] + step * direction[i];
        }
        worst = fmax(worst, fabs(field_distance(modified->whole, q) - d) / step);
    }
    return worst;
}
