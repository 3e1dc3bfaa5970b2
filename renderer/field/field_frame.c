/* SPDX-License-Identifier: MIT */
/* Transforms, folded from the scene down. */
#include "field_frame.h"

#include <math.h>
#include <string.h>

static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/* The matrix from the parent's space to the node's, (S^-1)(R^-1)(p - t), and back. */
static void node_matrices(const struct node *node, double out_to[12], double out_from[12],
                          double *out_least, double *out_greatest)
{
    const double *t = record_vector(&node->transform, "translation");
    const double *r = record_vector(&node->transform, "rotation");
    const double *s = record_vector(&node->transform, "scale");
    const double cx = cos(r[0]), sx = sin(r[0]), cy = cos(r[1]), sy = sin(r[1]), cz = cos(r[2]),
                 sz = sin(r[2]);

    /* Rz * Ry * Rx */
    double rotation[3][3] = {{cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx},
                             {sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx},
                             {-sy, cy * sx, cy * cx}};
    for (int i = 0; i < 3; i++) {
        out_to[4 * i + 3] = 0;
        for (int j = 0; j < 3; j++) {
            out_to[4 * i + j] = rotation[j][i] / s[i];
            out_to[4 * i + 3] -= rotation[j][i] / s[i] * t[j];
            out_from[4 * i + j] = rotation[i][j] * s[j];
        }
        out_from[4 * i + 3] = t[i];
    }
    *out_least = fmin(fabs(s[0]), fmin(fabs(s[1]), fabs(s[2])));
    *out_greatest = fmax(fabs(s[0]), fmax(fabs(s[1]), fabs(s[2])));
}

static void multiply(const double a[12], const double b[12], double out[12])
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            out[4 * i + j] = a[4 * i] * b[j] + a[4 * i + 1] * b[4 + j] + a[4 * i + 2] * b[8 + j] +
                             (j == 3 ? a[4 * i + 3] : 0);
        }
    }
}

struct node_frame node_frame_create(uint16_t point, double scale, size_t material)
{
    struct node_frame frame = {
        .scale = scale, .slot_scale = scale, .point = point, .material = material};

    memcpy(frame.matrix, identity, sizeof identity);
    memcpy(frame.back, identity, sizeof identity);
    return frame;
}

struct node_frame node_frame_enter(const struct node_frame *outer, const struct node *node,
                                   double out_from[12], double *out_ratio)
{
    struct node_frame frame = *outer;
    double to[12], least, greatest;

    node_matrices(node, to, out_from, &least, &greatest);
    multiply(to, outer->matrix, frame.matrix);
    multiply(outer->back, out_from, frame.back);
    frame.scale *= least;
    *out_ratio = greatest / least;
    return frame;
}

/* Far inside what a float holds: products of two such numbers must not overflow. */
bool node_frame_is_sane(const struct node_frame *frame)
{
    bool sane = frame->scale > 1e-15;

    for (int i = 0; i < 12; i++) {
        sane = sane && fabs(frame->matrix[i]) < 1e15;
    }
    return sane;
}
