/* SPDX-License-Identifier: MIT */
/* About where an imported scene is, for a camera that sees all of it: boxes of the types that the
 * thesis has, others and what a user's code bounds guessed from the numbers that they are given. */
#include <assert.h>
#include <math.h>
#include <string.h>

#include "import_internal.h"

enum { VISITS_MAX = 100000 }; /* models of models can be more nodes than anybody has time for */

struct box {
    double low[3], high[3];
    bool some;
};

static void box_add(struct box *box, const double low[3], const double high[3])
{
    for (int i = 0; i < 3; i++) {
        box->low[i] = box->some ? fmin(box->low[i], low[i]) : low[i];
        box->high[i] = box->some ? fmax(box->high[i], high[i]) : high[i];
    }
    box->some = true;
}

static void box_add_half(struct box *box, double x, double y, double z)
{
    box_add(box, (double[3]){-x, -y, -z}, (double[3]){x, y, z});
}

/* R = Rz Ry Rx of a scaled point, moved. */
static void place(const struct record *transform, const double p[3], double out[3])
{
    const double *t = record_vector(transform, "translation");
    const double *r = record_vector(transform, "rotation");
    const double *s = record_vector(transform, "scale");
    double v[3] = {p[0] * s[0], p[1] * s[1], p[2] * s[2]};

    for (int axis = 0; axis < 3; axis++) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        const double va = v[a];

        v[a] = cos(r[axis]) * va - sin(r[axis]) * v[b];
        v[b] = sin(r[axis]) * va + cos(r[axis]) * v[b];
    }
    for (int i = 0; i < 3; i++) {
        out[i] = v[i] + t[i];
    }
}

static struct box box_placed(const struct record *transform, const struct box *box)
{
    struct box out = {0};

    for (int corner = 0; box->some && corner < 8; corner++) {
        double p[3], q[3];

        for (int i = 0; i < 3; i++) {
            p[i] = corner >> i & 1 ? box->high[i] : box->low[i];
        }
        place(transform, p, q);
        box_add(&out, q, q);
    }
    return out;
}

/* The largest of the numbers that the primitive is given; 1 without any. */
static double guess(const struct record *params)
{
    double most = 0;

    for (size_t i = 0; params->type->params[i].name; i++) {
        if (strncmp(params->type->params[i].name, "data", 4) == 0) {
            most = fmax(most, fabs(params->values[i].number[0]));
        }
    }
    return most > 0 ? most : 1;
}

/* How far a type's lengths may take it from where it is: the sum of them. Of a `size` a half. */
static double reach(const struct record *params)
{
    double sum = 0;

    for (size_t i = 0; params->type->params[i].name; i++) {
        const struct param *param = &params->type->params[i];
        const double part = strcmp(param->name, "size") == 0 ? 0.5 : 1;
        const int count = param_components(param->type);
        double most = 0;

        for (int k = 0; k < count && param->unit == UNIT_LENGTH; k++) {
            most = fmax(most, part * fabs(params->values[i].number[k]));
        }
        for (int k = 0; param->type == PARAM_POINTS && k < 2 * params->values[i].number[0]; k++) {
            most = fmax(most, fabs(params->values[i].points[k]));
        }
        sum += most;
    }
    return sum;
}

static bool is_endless(const struct node *node)
{
    return strcmp(node->type->record.name, "plane") == 0;
}

static void add_own(struct box *box, const struct node *node)
{
    const char *type = node->type->record.name;
    const struct record *params = &node->params;

    if (strcmp(type, "box") == 0) {
        const double *size = record_vector(params, "size");
        box_add_half(box, size[0] / 2, size[1] / 2, size[2] / 2);
    } else if (strcmp(type, "cylinder") == 0) {
        const double r = record_number(params, "radius");
        box_add_half(box, r, record_number(params, "height") / 2, r);
    } else if (node->type->kind == KIND_CODE) {
        const double r = guess(params);
        box_add_half(box, r, r, r);
    } else if (node->type->kind == KIND_SHAPE || node->type->kind == KIND_FLAT) {
        const double r = is_endless(node) ? 0 : reach(params);
        if (r > 0) {
            box_add_half(box, r, r, r);
        }
    }
}

/* By what a modifier may put beyond its children. */
static void grow(struct box *box, const struct node *node)
{
    const struct record *params = &node->params;
    const bool repeat = strcmp(node->type->record.name, "repeat") == 0;

    for (int i = 0; box->some && i < 3; i++) {
        const double copies = repeat ? fmax(record_vector(params, "count")[i] - 1, 0) : 0;
        const double by = repeat ? copies / 2 * record_vector(params, "spacing")[i] : reach(params);

        box->low[i] -= by;
        box->high[i] += by;
    }
}

static struct box node_box(const struct scene *scene, const struct node *node, size_t *visits)
{
    const struct resource *model = node_model(scene, node);
    const bool first_only = strcmp(node->type->record.name, "difference") == 0;
    struct box box = {0};

    if (++*visits > VISITS_MAX) {
        return box;
    }
    add_own(&box, node);
    if (model) {
        const struct box inner = node_box(scene, model->root, visits);
        if (inner.some) {
            box_add(&box, inner.low, inner.high);
        }
    }
    for (size_t i = 0; i < node->child_count && !(first_only && i > 0); i++) {
        const struct box inner = node_box(scene, node->children[i], visits);
        if (inner.some) {
            box_add(&box, inner.low, inner.high);
        }
    }
    if (node->type->group == GROUP_MODIFIER) {
        grow(&box, node);
    }
    return box_placed(&node->transform, &box);
}

static void set_vector(struct record *record, const char *name, const double v[3])
{
    cJSON *json = cJSON_CreateDoubleArray(v, 3);

    /* Only what is beyond the largest coordinate is refused; then the default stays. */
    record_set(record, record_type_find(record->type, name), json, "", NULL);
    cJSON_Delete(json);
}

void import_lay_out(struct scene *scene)
{
    double x = 0;

    for (size_t i = 0; i < scene->root->child_count; i++) {
        struct node *node = scene->root->children[i];
        size_t visits = 0;
        const struct box box = node_box(scene, node, &visits);
        const double width = box.some ? box.high[0] - box.low[0] : 0;

        if (i > 0) {
            set_vector(&node->transform, "translation", (double[3]){x - box.low[0], 0, 0});
        }
        x = (i > 0 ? x + width : box.high[0]) + 0.25 * width;
    }
}

void import_frame(struct scene *scene)
{
    static const double from[3] = {0.45, 0.35, 0.82}; /* about a unit vector */
    const double half_view = record_number(&scene->camera, "fov") * 0.5 * 3.14159265358979 / 180;
    size_t visits = 0;
    const struct box box = node_box(scene, scene->root, &visits);
    double target[3], position[3], radius = 0;

    if (!box.some) {
        return;
    }
    for (int i = 0; i < 3; i++) {
        target[i] = (box.low[i] + box.high[i]) / 2;
        radius += (box.high[i] - box.low[i]) * (box.high[i] - box.low[i]) / 4;
    }
    const double distance = fmax(sqrt(radius), 1e-3) / sin(half_view);
    for (int i = 0; i < 3; i++) {
        position[i] = target[i] + distance * from[i];
    }
    set_vector(&scene->camera, "target", target);
    set_vector(&scene->camera, "position", position);
    if (4 * distance > record_number(&scene->render, "max_distance")) {
        cJSON *far = cJSON_CreateNumber(4 * distance);

        record_set(&scene->render, record_type_find(&render_type, "max_distance"), far, "", NULL);
        cJSON_Delete(far);
    }
}
