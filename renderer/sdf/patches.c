/* SPDX-License-Identifier: MIT */
#include "patches.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

enum {
    STEPS = 3,    /* of Newton, at most */
    BOX_ROW = 12, /* of a patch */
};
#define SMALL 0.05 /* a step after which the next one makes no difference */
#define BENT 0.9   /* cosine: patches that turn by more may have several nearest points */

/* Of the grid, in cubes. */
#define BAND_BEGIN 1.3 /* so near all is exact */
#define BAND_WIDTH 0.5
#define MARGIN 1.5 /* around the sheet */
#define FAR_AWAY 1e9
/* Of their distance, what corners tell less, where they are farther than twice EXACT cubes. */
#define FAR_PART 0.02
#define EXACT 4.0

static const int corners_of[] = {
    [4] = 13 * 13 * 13, [5] = 25 * 25 * 25, [PATCHES_LEVELS_MAX] = 29 * 29 * 29};

static int nodes_of(int levels)
{
    return ((1 << (2 * (levels + 1))) - 1) / 3;
}

size_t patches_rows(int levels)
{
    return PATCHES_HEAD + (size_t)corners_of[levels] + 2 * (size_t)nodes_of(levels) +
           PATCH_ROWS * ((size_t)1 << (2 * levels));
}

int patches_trips(void)
{
    return PATCHES_VISITS + 3 * PATCHES_LEVELS_MAX + STEPS * 8;
}

/* --- where numbers lie --- */

struct parts {
    double *corners, *tree, *patches;
};

static struct parts parts_of(double *n, int corners, int nodes)
{
    double *tree = n + (size_t)(4 * (PATCHES_HEAD + corners));

    return (struct parts){n + (size_t)(4 * PATCHES_HEAD), tree, tree + (size_t)(8 * nodes)};
}

/* --- the nearest point --- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A point, its derivatives by u and by v, then by u u, u v and v v. */
enum { POINT, BY_U, BY_V, BY_UU, BY_UV, BY_VV, ORDERS };

static void patch_at(const double *n, const double uv[2], double out[ORDERS][3])
{
    const double u = uv[0], v = uv[1];

    for (int axis = 0; axis < 3; axis++) {
        double r[4], t[4], b[4];
        for (int i = 0; i < 4; i++) {
            const double *c = n + (size_t)(12 * i + 4 * axis);
            r[i] = ((c[3] * v + c[2]) * v + c[1]) * v + c[0];
            t[i] = (3 * c[3] * v + 2 * c[2]) * v + c[1];
            b[i] = 6 * c[3] * v + 2 * c[2];
        }
        out[POINT][axis] = ((r[3] * u + r[2]) * u + r[1]) * u + r[0];
        out[BY_U][axis] = (3 * r[3] * u + 2 * r[2]) * u + r[1];
        out[BY_V][axis] = ((t[3] * u + t[2]) * u + t[1]) * u + t[0];
        out[BY_UU][axis] = 6 * r[3] * u + 2 * r[2];
        out[BY_UV][axis] = (3 * t[3] * u + 2 * t[2]) * u + t[1];
        out[BY_VV][axis] = ((b[3] * u + b[2]) * u + b[1]) * u + b[0];
    }
}

static double clamp(double x, double low, double high)
{
    return fmin(fmax(x, low), high);
}

/* One step of Newton's method for the least square of e = p - point, in the square of parameters:
 * where one of them is at its end, the other goes on alone. The second derivatives are kept
 * positive: where they are not, half of those by Gauss. */
static void step(const double p[3], double at[ORDERS][3], double uv[2])
{
    const double e[3] = {p[0] - at[POINT][0], p[1] - at[POINT][1], p[2] - at[POINT][2]};
    const double gu = dot(at[BY_U], at[BY_U]), gv = dot(at[BY_V], at[BY_V]);
    const double bu = dot(at[BY_U], e), bv = dot(at[BY_V], e), small = 1e-6 * (gu + gv) + 1e-30;
    const double uu = fmax(gu - dot(at[BY_UU], e), 0.25 * gu) + small;
    const double vv = fmax(gv - dot(at[BY_VV], e), 0.25 * gv) + small;
    const double most = 0.95 * sqrt(uu * vv);
    const double mixed = clamp(dot(at[BY_U], at[BY_V]) - dot(at[BY_UV], e), -most, most);
    double du = (bu * vv - bv * mixed) / (uu * vv - mixed * mixed);

    du = clamp(du, -uv[0], 1 - uv[0]);
    const double dv = clamp((bv - mixed * du) / vv, -uv[1], 1 - uv[1]);
    du = clamp((bu - mixed * dv) / uu, -uv[0], 1 - uv[0]);
    uv[0] += du;
    uv[1] += dv;
}

/* The square of the distance; `uv` is where to begin, and then where it is. */
static double patch_near(const double p[3], const double *n, double uv[2])
{
    double at[ORDERS][3], way = 1;

    for (int i = 0; i < STEPS && way >= SMALL; i++) {
        const double from[2] = {uv[0], uv[1]};
        patch_at(n, uv, at);
        step(p, at, uv);
        way = fmax(fabs(uv[0] - from[0]), fabs(uv[1] - from[1]));
    }
    patch_at(n, uv, at);
    const double e[3] = {p[0] - at[POINT][0], p[1] - at[POINT][1], p[2] - at[POINT][2]};
    return dot(e, e);
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = a[j] * b[k] - a[k] * b[j];
    }
}

/* The square of the distance to the box along the patch's own axes, at most. `uv` is about where
 * the nearest point is. */
static double own_box_square(const double p[3], const double *patch, double uv[2])
{
    const double *box = patch + (size_t)(4 * BOX_ROW);
    const double e[3] = {p[0] - box[0], p[1] - box[1], p[2] - box[2]};
    double third[3], square = 0;

    cross(box + 4, box + 8, third);
    const double place[3] = {dot(e, box + 4), dot(e, box + 8), dot(e, third)};
    for (int i = 0; i < 3; i++) {
        const double out = fmax(fabs(place[i]) - fabs(box[4 * i + 3]), 0);
        square += out * out;
    }
    for (int i = 0; i < 2; i++) {
        uv[i] = clamp(0.5 + 0.5 * place[i] / box[4 * i + 3], 0, 1);
    }
    return square;
}

static bool is_bent(const double *patch)
{
    return patch[4 * BOX_ROW + 11] < 0;
}

/* The square of the distance to a patch, or `best` where that is less; `uv` is where. A bent patch
 * may have several nearest points, so that the search begins at five places. */
static double patch_nearer(const double p[3], const double *patch, double best, double uv[2])
{
    double begin[2];

    if (own_box_square(p, patch, begin) >= best) {
        return best;
    }
    for (int i = is_bent(patch) ? 4 : 0; i >= 0; i--) {
        double at[2] = {i % 2 ? 0.25 : 0.75, i > 2 ? 0.25 : 0.75};
        if (i == 0) {
            memcpy(at, begin, sizeof at);
        }
        const double square = patch_near(p, patch, at);
        if (square < best) {
            best = square;
            memcpy(uv, at, sizeof at);
        }
    }
    return best;
}

static double box_square(const double p[3], const double *node)
{
    double square = 0;

    for (int i = 0; i < 3; i++) {
        const double away = fmax(fmax(node[i] - p[i], p[i] - node[4 + i]), 0);
        square += away * away;
    }
    return square;
}

static double trilinear(const double d[8], const double f[3])
{
    const double a = d[0] + (d[1] - d[0]) * f[0], b = d[2] + (d[3] - d[2]) * f[0];
    const double c = d[4] + (d[5] - d[4]) * f[0], e = d[6] + (d[7] - d[6]) * f[0];
    const double low = a + (b - a) * f[1], high = c + (e - c) * f[1];

    return low + (high - low) * f[2];
}

/* From the corner `seed`. What is not looked at counts as if its boxes were full. */
static double search(const double p[3], const double *tree, int nodes, const double *patches,
                     const double seed[4])
{
    const int begin = (int)seed[1];
    double uv[2] = {seed[2], seed[3]};
    double best = patch_near(p, patches + (size_t)(4 * PATCH_ROWS * begin), uv);
    int left = PATCHES_VISITS;

    for (int i = 0; i < nodes; left--) {
        const double *node = tree + (size_t)(8 * i);
        const double square = box_square(p, node);
        bool down = square < best;
        if (down && node[7] >= 0) {
            const double *patch = patches + (size_t)(4 * PATCH_ROWS * (int)node[7]);
            if ((int)node[7] != begin || is_bent(patch)) {
                best = patch_nearer(p, patch, best, uv);
            }
            down = false;
        } else if (down && left <= 0) {
            best = square;
            down = false;
        }
        i = down ? i + 1 : (int)node[3];
    }
    return sqrt(best);
}

static double within(const double p[3], const double *n)
{
    const double *corners = n + (size_t)(4 * PATCHES_HEAD);
    const int along[3] = {(int)n[8], (int)n[9], (int)n[10]}, nodes = (int)n[15];
    double f[3], d[8];
    int first = 0, seed = 0;

    for (int i = 2; i >= 0; i--) {
        const double at = (p[i] - n[i]) / n[3];
        const int cell = (int)clamp(floor(at), 0, along[i] - 2);
        f[i] = at - cell;
        first = first * along[i] + cell;
        seed = seed * along[i] + cell + (f[i] > 0.5);
    }
    for (int k = 0; k < 8; k++) {
        const int corner = first + (k & 1) + along[0] * ((k >> 1 & 1) + along[1] * (k >> 2));
        d[k] = corners[(size_t)(4 * corner)];
    }
    const double mean = trilinear(d, f);
    const double far = fmax(mean - n[14], 0);
    const double share = clamp((mean - n[12]) * n[13], 0, 1);
    if (share == 1) {
        return far;
    }
    const double *tree = corners + (size_t)(4 * (int)n[11]);
    const double exact =
        search(p, tree, nodes, tree + (size_t)(8 * nodes), corners + (size_t)(4 * seed));
    return exact + (far - exact) * share;
}

double patches_distance(const double p[3], const double *n)
{
    double near[3], square = 0;

    for (int i = 0; i < 3; i++) {
        near[i] = clamp(p[i], n[i], n[4 + i]);
        square += (p[i] - near[i]) * (p[i] - near[i]);
    }
    return hypot(sqrt(square), within(near, n)) - n[7];
}

bool patches_point(const double *n, int patch, double u, double v, double out[3])
{
    const double *tree = n + (size_t)(4 * (PATCHES_HEAD + (int)n[11]));
    const double *c = tree + (size_t)(8 * (int)n[15] + 4 * PATCH_ROWS * patch);
    const double uv[2] = {u, v};
    double at[ORDERS][3];
    bool any = false;

    for (int i = 0; i < 4 * PATCH_ROWS; i++) {
        any = any || c[i] != 0;
    }
    patch_at(c, uv, at);
    memcpy(out, at[POINT], sizeof at[POINT]);
    return any;
}

/* As plant() goes: two bits for each level. */
void patches_place(int patch, int out[2])
{
    out[0] = out[1] = 0;
    for (int level = 0; level < PATCHES_LEVELS_MAX; level++) {
        const int bits = patch >> (2 * level);
        out[0] |= (bits >> 1 & 1) << level;
        out[1] |= (bits & 1) << level;
    }
}

double patches_loose(const double *n)
{
    return 0.87 * n[3] + n[14] + FAR_PART * hypot(hypot(n[4] - n[0], n[5] - n[1]), n[6] - n[2]);
}

/* --- patches --- */

/* What four values at 0, 1/3, 2/3 and 1 are as a polynomial. */
static void cubic(const double *from, size_t stride, double out[4])
{
    const double a = from[0], b = from[stride], c = from[2 * stride], d = from[3 * stride];

    out[0] = a;
    out[1] = -5.5 * a + 9 * b - 4.5 * c + d;
    out[2] = 9 * a - 22.5 * b + 18 * c - 4.5 * d;
    out[3] = -4.5 * a + 13.5 * b - 13.5 * c + 4.5 * d;
}

/* The polynomial of one coordinate in both parameters, from a corner on. */
static void bicubic(const double *points, int across, int axis, double out[4][4])
{
    double rows[4][4];

    for (int i = 0; i < 4; i++) {
        cubic(points + (size_t)(3 * i * across + axis), 3, rows[i]);
    }
    for (int j = 0; j < 4; j++) {
        double column[4];
        cubic(&rows[0][j], 4, column);
        for (int i = 0; i < 4; i++) {
            out[i][j] = column[i];
        }
    }
}

/* The points whose hull a polynomial lies in: its form of Bernstein. */
static void control(double c[4][4], double out[4][4])
{
    /* x^k = the sum of C(i, k) / C(3, k) of the Bernstein polynomials i. */
    static const double to[4][4] = {
        {1, 0, 0, 0}, {1, 1 / 3.0, 0, 0}, {1, 2 / 3.0, 1 / 3.0, 0}, {1, 1, 1, 1}};

    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            out[i][j] = 0;
            for (int k = 0; k <= i; k++) {
                for (int l = 0; l <= j; l++) {
                    out[i][j] += to[i][k] * to[j][l] * c[k][l];
                }
            }
        }
    }
}

static bool normalize(double v[3])
{
    const double length = sqrt(dot(v, v));

    for (int i = 0; i < 3; i++) {
        v[i] /= length;
    }
    return length > 1e-12 && isfinite(length);
}

/* Along u, and at right angles to it along the patch. */
static void own_axes(const double *patch, double first[3], double second[3])
{
    double at[ORDERS][3], normal[3];

    patch_at(patch, (const double[]){0.5, 0.5}, at);
    memcpy(first, at[BY_U], sizeof at[BY_U]);
    cross(at[BY_U], at[BY_V], normal);
    cross(normal, at[BY_U], second);
    if (!normalize(first) || !normalize(second)) {
        memcpy(first, (const double[]){1, 0, 0}, 3 * sizeof *first);
        memcpy(second, (const double[]){0, 1, 0}, 3 * sizeof *second);
    }
    for (int i = 0; i < 3; i++) {
        first[i] = (float)first[i];
        second[i] = (float)second[i];
    }
}

/* Whether what goes along a parameter turns a lot, from the middle of the patch on. */
static bool is_bending(const double *patch)
{
    double middle[ORDERS][3], at[ORDERS][3];

    patch_at(patch, (const double[]){0.5, 0.5}, middle);
    for (int i = 0; i < 25; i++) {
        patch_at(patch, (const double[]){0.25 * (i % 5), 0.05 * (i - i % 5)}, at);
        for (int way = BY_U; way <= BY_V; way++) {
            const double here = sqrt(dot(at[way], at[way]));
            const double there = sqrt(dot(middle[way], middle[way]));
            if (here > 0.01 * there && dot(at[way], middle[way]) < BENT * here * there) {
                return true;
            }
        }
    }
    return false;
}

/* A little larger, for what floats leave. */
static void write_own_box(double points[3][4][4], double *patch)
{
    double *box = patch + (size_t)(4 * BOX_ROW), axes[3][3], middle[3] = {0}, half[3], size = 0;

    own_axes(patch, axes[0], axes[1]);
    cross(axes[0], axes[1], axes[2]);
    for (int a = 0; a < 3; a++) {
        double low = INFINITY, high = -INFINITY;
        for (int i = 0; i < 16; i++) {
            const double x = points[0][i / 4][i % 4], y = points[1][i / 4][i % 4];
            const double z = points[2][i / 4][i % 4];
            const double along = axes[a][0] * x + axes[a][1] * y + axes[a][2] * z;
            low = fmin(low, along);
            high = fmax(high, along);
            size = fmax(size, fmax(fabs(x), fmax(fabs(y), fabs(z))));
        }
        half[a] = (high - low) / 2;
        for (int i = 0; i < 3; i++) {
            middle[i] += axes[a][i] * (low + high) / 2;
        }
    }
    for (int i = 0; i < 3; i++) {
        box[i] = (float)middle[i];
        box[4 + i] = axes[0][i];
        box[8 + i] = axes[1][i];
        box[4 * i + 3] = (float)(half[i] + 1e-6 * size + 1e-30);
    }
    box[11] *= is_bending(patch) ? -1 : 1;
}

static bool is_whole(const double *points, int across)
{
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 12; j++) {
            if (!isfinite(points[(size_t)(3 * i * across + j)])) {
                return false;
            }
        }
    }
    return true;
}

/* A patch of the tree's order, and the box around it, of a leaf. */
static void write_patch(const double *points, int across, double *out, double *node)
{
    double around[3][4][4];

    for (int axis = 0; axis < 3; axis++) {
        double c[4][4];
        bicubic(points, across, axis, c);
        for (int i = 0; i < 4; i++) {
            for (int j = 0; j < 4; j++) {
                c[i][j] = out[12 * i + 4 * axis + j] = (float)c[i][j];
            }
        }
        control(c, around[axis]);
        for (int i = 0; i < 16; i++) {
            node[axis] = fmin(node[axis], around[axis][i / 4][i % 4]);
            node[4 + axis] = fmax(node[4 + axis], around[axis][i / 4][i % 4]);
        }
    }
    write_own_box(around, out);
}

/* --- the tree --- */

struct planting {
    const double *points;
    int across, leaves;
    double *tree, *patches;
    int next;
};

static void open_box(double *node)
{
    for (int i = 0; i < 3; i++) {
        node[i] = FAR_AWAY;
        node[4 + i] = -FAR_AWAY;
    }
}

/* The node for a square of 2^levels patches whose first is (s, t), and all below it. */
static const double *plant(struct planting *p, int levels, int s, int t)
{
    double *node = p->tree + (size_t)(8 * p->next++);

    open_box(node);
    node[7] = -1;
    if (levels == 0) {
        const double *points = p->points + (size_t)(3 * 3 * (s * p->across + t));
        if (is_whole(points, p->across)) {
            write_patch(points, p->across, p->patches + (size_t)(4 * PATCH_ROWS * p->leaves), node);
            node[7] = p->leaves;
        }
        p->leaves++;
    }
    for (int k = 0; levels > 0 && k < 4; k++) {
        const int half = 1 << (levels - 1);
        const double *child = plant(p, levels - 1, s + (k >> 1) * half, t + (k & 1) * half);
        for (int i = 0; i < 3; i++) {
            node[i] = fmin(node[i], child[i]);
            node[4 + i] = fmax(node[4 + i], child[4 + i]);
        }
    }
    node[3] = p->next;
    return node;
}

/* --- the grid --- */

/* The side of cubes that fills a box with as many corners as there may be. */
static double fit(const double size[3], double around, int most, int along[3])
{
    double side = 2 * around + fmax(fmax(size[0], size[1]), size[2]);

    for (double smaller = side; smaller > 1e-3 * side; smaller *= 0.98) {
        int64_t count = 1;
        int trial[3];
        for (int i = 0; i < 3; i++) {
            trial[i] = 2 + (int)ceil((size[i] + 2 * (around + MARGIN * smaller)) / smaller);
            count *= trial[i];
        }
        if (count > most) {
            break;
        }
        side = smaller;
        memcpy(along, trial, sizeof trial);
    }
    return side;
}

struct corner_search {
    const double *tree, *patches;
    int nodes;
    double side;
};

/* What a corner tells less than its distance, as a part of that. */
static double far_part(const struct corner_search *s, double distance)
{
    return FAR_PART * clamp(distance / (EXACT * s->side) - 1, 0, 1);
}

/* The corner's distance, or a little less where it is far, and its nearest point. `seed` is the one
 * of a corner beside it. */
static void find_corner(const struct corner_search *s, const double p[3], const double seed[4],
                        double out[4])
{
    double uv[2] = {seed[2], seed[3]};
    double best = patch_near(p, s->patches + (size_t)(4 * PATCH_ROWS) * (size_t)seed[1], uv);
    double part = 1 - far_part(s, sqrt(best));

    memcpy(out, (const double[]){0, seed[1], uv[0], uv[1]}, 4 * sizeof *out);
    for (int i = 0; i < s->nodes;) {
        const double *node = s->tree + (size_t)(8 * i);
        if (box_square(p, node) >= part * part * best) {
            i = (int)node[3];
            continue;
        }
        const double *patch = s->patches + (size_t)(4 * PATCH_ROWS) * (size_t)fmax(node[7], 0);
        const double square =
            node[7] < 0 ? INFINITY : patch_nearer(p, patch, part * part * best, uv);
        if (node[7] >= 0 && square < part * part * best) {
            best = square;
            part = 1 - far_part(s, sqrt(best));
            memcpy(out, (const double[]){0, node[7], uv[0], uv[1]}, 4 * sizeof *out);
        }
        i++;
    }
    out[0] = part * sqrt(best);
}

static void fill_corners(const struct corner_search *s, const double *low, const int along[3],
                         double *corners)
{
    for (int i = 0; i < along[0] * along[1] * along[2]; i++) {
        const int at[3] = {i % along[0], i / along[0] % along[1], i / along[0] / along[1]};
        const int before = at[0] > 0   ? i - 1
                           : at[1] > 0 ? i - along[0]
                           : at[2] > 0 ? i - along[0] * along[1]
                                       : i;
        double p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = low[k] + s->side * at[k];
        }
        find_corner(s, p, corners + (size_t)(4 * before), corners + (size_t)(4 * i));
    }
}

/* Empty space: one cell whose corners are far away. */
static void write_nothing(int corners, double *out)
{
    const double head[16] = {0, 0, 0, 1, 1, 1, 1, 0, 2, 2, 2, corners, 1, 1, 0, 0};

    memcpy(out, head, sizeof head);
    for (int i = 0; i < 8; i++) {
        out[(size_t)(4 * (PATCHES_HEAD + i))] = FAR_AWAY;
    }
}

struct bounds patches_box(const double *n)
{
    const double *root = n + (size_t)(4 * (PATCHES_HEAD + (int)n[11])), half = n[7];
    struct bounds box = {.stretch = 1};

    for (int i = 0; i < 3; i++) {
        box.low[i] = root[i] - half;
        box.high[i] = root[4 + i] + half;
    }
    return box.low[0] < box.high[0] ? box : bounds_centred(0, 0, 0);
}

static void write_head(const double *root, double thickness, int corners, int nodes, int along[3],
                       double *out)
{
    const double half = thickness / 2;
    double size[3];

    for (int i = 0; i < 3; i++) {
        size[i] = root[4 + i] - root[i];
    }
    const double side = (float)fit(size, half, corners, along);
    for (int i = 0; i < 3; i++) {
        const double middle = (root[i] + root[4 + i]) / 2;
        out[i] = (float)(middle - side * (along[i] - 1) / 2);
        out[4 + i] = (float)(out[i] + side * (along[i] - 1));
        out[8 + i] = along[i];
    }
    out[3] = side;
    out[7] = half;
    out[11] = corners;
    out[12] = BAND_BEGIN * side;
    out[13] = 1 / (BAND_WIDTH * side);
    out[14] = 0.5 * (BAND_BEGIN - sqrt(BAND_BEGIN * BAND_BEGIN - 1.5)) * side;
    out[15] = nodes;
}

static int first_patch(const double *tree, int nodes)
{
    for (int i = 0; i < nodes; i++) {
        if (tree[(size_t)(8 * i + 7)] >= 0) {
            return (int)tree[(size_t)(8 * i + 7)];
        }
    }
    return -1;
}

struct bounds patches_write(int levels, double thickness, const double *points, double *out)
{
    const int corners = corners_of[levels], nodes = nodes_of(levels);
    const struct parts parts = parts_of(out, corners, nodes);
    int along[3] = {2, 2, 2};

    memset(out, 0, 4 * patches_rows(levels) * sizeof *out);
    struct planting planting = {.points = points,
                                .across = patches_points(levels),
                                .tree = parts.tree,
                                .patches = parts.patches};
    const double *root = plant(&planting, levels, 0, 0);
    const int first = first_patch(parts.tree, nodes);
    if (first < 0) {
        write_nothing(corners, out);
        return patches_box(out);
    }
    write_head(root, thickness, corners, nodes, along, out);
    const struct corner_search search = {parts.tree, parts.patches, nodes, out[3]};
    parts.corners[1] = first;
    parts.corners[2] = parts.corners[3] = 0.5;
    fill_corners(&search, out, along, parts.corners);
    return patches_box(out);
}

/* Behind the numbers of the cut. */
static double shape(const double p[3], const double *n)
{
    return patches_distance(p, n + SDF_CUT_NUMBERS);
}

const struct sdf sdf_patches = {.type = "parametric", .shape = shape};
