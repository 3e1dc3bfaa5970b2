/* SPDX-License-Identifier: MIT */
/* What changes the distance or the space of its children, and lengthens none. */
#include <string.h>

#include "tools.h"

/* --- of the distance --- */

static double change_round(double d, const double *n)
{
    return d - n[0];
}

static double change_shell(double d, const double *n)
{
    return fabs(d) - n[0];
}

static double whole_lowered(const double *n, size_t count)
{
    (void)count;
    return n[0];
}

/* --- of the space --- */

static void mirror_prepare(const double *params, const struct bounds *child, double scale,
                           double *out_n)
{
    (void)child, (void)scale;
    memcpy(out_n, params, 3 * sizeof *params);
}

static struct bounds mirror_box(const double *params, const struct bounds *child)
{
    struct bounds out = *child;

    for (int i = 0; i < 3; i++) {
        if (params[i] != 0) {
            /* Nothing on the positive side: what grows there by and by lies around the plane. */
            out.high[i] = fabs(out.high[i]);
            out.low[i] = -out.high[i];
        }
    }
    return out;
}

static void mirror_map(const double p[3], const double *n, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = n[i] != 0 ? fabs(p[i]) : p[i];
    }
}

/* elongate: n = size, scale. Where the child holds the origin, what is pulled apart has a block in
 * it whose points all see the origin: the way to the block's faces is added to their depth. Where
 * it does not, the block is outside and stays as it is. */
static void elongate_prepare(const double *params, const struct bounds *child, double scale,
                             double *out_n)
{
    (void)child;
    memcpy(out_n, params, 3 * sizeof *params);
    out_n[3] = scale;
}

static struct bounds elongate_box(const double *params, const struct bounds *child)
{
    struct bounds out = *child;

    for (int i = 0; i < 3; i++) {
        out.low[i] -= params[i];
        out.high[i] += params[i];
    }
    return out;
}

static void elongate_map(const double p[3], const double *n, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = p[i] - clamp(p[i], -n[i], n[i]);
    }
}

static double elongate_after(double d, const double p[3], const double *n)
{
    const double face = fmax(fabs(p[0]) - n[0], fmax(fabs(p[1]) - n[1], fabs(p[2]) - n[2]));

    return d < 0 ? d + fmin(face, 0) * n[3] : d;
}

/* extrude: n = half height, scale, rounding times scale. The section, drawn in by the rounding and
 * as much lower, grows back by it: only edges between cap and side become round. */
enum { HALF, EXTRUDE_SCALE, ROUNDING };

static void extrude_prepare(const double *params, const struct bounds *child, double scale,
                            double *out_n)
{
    (void)child;
    out_n[HALF] = params[0] / 2;
    out_n[EXTRUDE_SCALE] = scale;
    out_n[ROUNDING] = fmin(params[1], params[0] / 2) * scale;
}

static struct bounds extrude_box(const double *params, const struct bounds *child)
{
    struct bounds out = *child;

    out.high[2] = params[0] / 2;
    out.low[2] = -out.high[2];
    return out;
}

static void extrude_map(const double p[3], const double *n, double out[3])
{
    (void)n;
    out[0] = p[0], out[1] = p[1], out[2] = 0;
}

/* Distances along the section and across it stand at a right angle, so the gradient stays 1. */
static double extrude_after(double d, const double p[3], const double *n)
{
    const double along = (fabs(p[2]) - n[HALF]) * n[EXTRUDE_SCALE];

    return corner(d + n[ROUNDING], along + n[ROUNDING]) - n[ROUNDING];
}

/* revolve: n = offset. The way to the section's point lengthens no distance. */
static void revolve_prepare(const double *params, const struct bounds *child, double scale,
                            double *out_n)
{
    (void)child, (void)scale;
    out_n[0] = params[0];
}

static struct bounds revolve_box(const double *params, const struct bounds *child)
{
    struct bounds out = *child;
    const double radius = fmax(child->high[0] + params[0], 0);

    out.low[0] = out.low[2] = -radius;
    out.high[0] = out.high[2] = radius;
    return out;
}

static void revolve_map(const double p[3], const double *n, double out[3])
{
    out[0] = hypot(p[0], p[2]) - n[0];
    out[1] = p[1];
    out[2] = 0;
}

static const struct sdf_domain mirror = {
    .vec4s = 1, .prepare = mirror_prepare, .box = mirror_box, .map = mirror_map};
static const struct sdf_domain elongate = {.vec4s = 1,
                                           .prepare = elongate_prepare,
                                           .box = elongate_box,
                                           .map = elongate_map,
                                           .after = elongate_after};
static const struct sdf_domain extrude = {.vec4s = 1,
                                          .prepare = extrude_prepare,
                                          .box = extrude_box,
                                          .map = extrude_map,
                                          .after = extrude_after};
static const struct sdf_domain revolve = {
    .vec4s = 1, .prepare = revolve_prepare, .box = revolve_box, .map = revolve_map};

const struct sdf sdf_modifiers[] = {
    {"round", .change = change_round, .lowered = whole_lowered},
    {"shell", .change = change_shell, .lowered = whole_lowered},
    {"mirror", .domain = &mirror},
    {"elongate", .domain = &elongate},
    {"extrude", .domain = &extrude},
    {"revolve", .domain = &revolve},
    {.type = NULL},
};
