/* SPDX-License-Identifier: MIT */
/* Surfaces by patches, whose coefficients are numbers of the field: what a parametric surface is
 * drawn by. It is divided evenly into patches by both parameters. Each is a bicubic polynomial
 * through 4 x 4 of its points, off by the fourth power of its width where the surface is smooth.
 *
 * A sheet is all that is at most half of its thickness away from a patch. Its distance is that to
 * the nearest patch, less half of the thickness. The nearest point of one patch is found by steps
 * of Newton's method in its square of parameters, one or two for most; of a bent patch from five
 * places, because it may have several. Which patches are asked, by a tree of boxes over the two
 * parameters, and by a box along the axes of each patch, which is flat where the patch is: a box
 * that is no nearer than what is found leaves out all that is in it. After PATCHES_VISITS nodes,
 * which only patches that lie in each other take, boxes stand for what is in them.
 *
 * Around the patches is a grid whose corners know their distance and their nearest point. From the
 * one nearest to a point the search begins, so that it asks few patches. Farther away than about
 * 1.8 cells nothing is searched: with I the distances of the corners, interpolated, and s the side
 * of a cube, the distance d has I - d <= 3 s^2 / 8 d. (A corner c is at most |c - x| away from the
 * point x that is nearest to p. By the square root's tangent |c - x| is at most d + (p - x)(c - p)
 * / d + |c - p|^2 / 2 d, and the middle terms of the corners cancel.) So d is at least (I +
 * sqrt(I^2 - 3 s^2 / 2)) / 2, and I less a constant is a lower bound that goes as fast as I.
 * Outside of the grid the nearest point of the grid is asked: what is in it lies beyond that point,
 * at a right angle or more.
 *
 * So the distance is exact near the surface. Elsewhere it is a lower bound, at most patches_loose()
 * below what changes no faster than the way. Double precision here; glsl/patches.glsl is the same
 * in floats. */
#ifndef RENDERER_SDF_PATCHES_H
#define RENDERER_SDF_PATCHES_H

#include <stddef.h>

#include "sdf.h"

/* The numbers, four in each row:
 *     least corner of the grid, side of a cube
 *     greatest corner of the grid, half of the thickness
 *     corners along x, y and z, corners in all
 *     where the search begins to fade, 1 / way on which it does, what I is too great by at most
 *     from there on, nodes of the tree
 *     for each corner: (distance, number of the nearest patch, u and v there)
 *     for each node of the tree, parents first: (least corner of its box, next node outside of it),
 *     (greatest corner, number of its patch, or -1)
 *     for each patch: for each power of u: (x of the powers of v), (y ...), (z ...); its box:
 *     (middle, half of its length along the first axis), (first axis, half along the second),
 *     (second axis, half along the third, less than 0 of a bent patch). */
enum {
    PATCHES_HEAD = 4,
    PATCH_ROWS = 15,
    PATCHES_LEVELS_MIN = 4,
    PATCHES_LEVELS_MAX = 6,
    PATCHES_VISITS = 256, /* nodes of the tree that a search looks at, at most */
};

/* With 2 to the power of `levels` patches along each parameter. */
static inline int patches_side(int levels)
{
    return 1 << levels;
}
/* Points along each parameter. */
static inline int patches_points(int levels)
{
    return 3 * patches_side(levels) + 1;
}
size_t patches_rows(int levels);
/* Loop iterations of one evaluation in GLSL, at most. */
int patches_trips(void);

/* Writes all numbers. `points`: x, y, z of each of patches_points() times as many, the second
 * parameter faster. A patch with a point that is not finite is left out. Returns the box around the
 * sheet; around nothing it is empty space, and the box is a point. Takes 10 to 100 ms. */
struct bounds patches_write(int levels, double thickness, const double *points, double *out);
/* See above. */
double patches_loose(const double *n);
/* Of numbers that are written: the box around the sheet; a point of a patch, of which there are
 * patches_side() squared (false: it is left out); where its square begins, in steps of patches. */
struct bounds patches_box(const double *n);
bool patches_point(const double *n, int patch, double u, double v, double out[3]);
void patches_place(int patch, int out[2]);

/* The row of such shapes; its numbers begin behind SDF_CUT_NUMBERS. */
extern const struct sdf sdf_patches;
double patches_distance(const double p[3], const double *n);

#endif
