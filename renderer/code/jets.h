/* SPDX-License-Identifier: MIT */
/* What the code of equations calls and users' code cannot: products and chain rules of what an
 * equation's parts are at a point and in a box. In C; in GLSL they are in glsl/jets.glsl.
 *
 * Duals are (gradient, value), four numbers. Jets are matrices of three columns: the least slopes
 * along x, y and z in a box, the greatest, and (least value, greatest value, 0). No number of a jet
 * that a function gives exceeds twice JET_MAX. Rules of intervals: Moore, Interval Analysis
 * (1966). */
#ifndef RENDERER_CODE_JETS_H
#define RENDERER_CODE_JETS_H

#define JET_MAX 1e18  /* as in glsl/jets.glsl */
#define JET_SECANTS 8 /* rounds of a search by false position, as there */

/* As `whole` of struct builtin; `in` are the arguments. */
void jet_dual_times(double *out, const double *const in[], int n); /* dual, dual */
void jet_dual_of(double *out, const double *const in[], int n);    /* dual, value, slope */
void jet_times(double *out, const double *const in[], int n);      /* jet, jet */
void jet_minus(double *out, const double *const in[], int n);      /* jet, jet */
void jet_scaled(double *out, const double *const in[], int n);     /* jet, factor */
void jet_moved(double *out, const double *const in[], int n);      /* jet, what is added */
/* Of a function: jet, its least and greatest value, its least and greatest slope. */
void jet_of(double *out, const double *const in[], int n);
/* To the even or odd power k: jet, |end of its values|^(k - 1) of both ends, k. */
void jet_even(double *out, const double *const in[], int n);
void jet_odd(double *out, const double *const in[], int n);
/* Of an interval: least and greatest sine, least and greatest cosine. */
void jet_turn(double *out, const double *const in[], int n);
void jet_cos(double *out, const double *const in[], int n); /* jet, turn of its values */
void jet_exp(double *out, const double *const in[], int n); /* of at most 40 */
void jet_dual_exp(double *out, const double *const in[], int n);
void jet_dual_sin(double *out, const double *const in[], int n);
void jet_dual_cos(double *out, const double *const in[], int n);

/* The nearest point of a clip, and the way there, in the clip less than 0: point, size. */
void jet_near_box(double *out, const double *const in[], int n);
void jet_near_ball(double *out, const double *const in[], int n);
/* A distance: the same, and the distance at that point. */
void jet_clipped(double *out, const double *const in[], int n);
/* What boxes begin with: |f|, half of the side of the next box, half of that of the least box that
 * may have a zero, the way that is free. Dual, the most that a half may be. */
void jet_begin(double *out, const double *const in[], int n);
/* How much an estimate of the distance may be: as much as said where one is asked for
 * (glsl/field_mask.glsl), else 0. In C none is. */
void jet_room(double *out, const double *const in[], int n);
/* Where Newton's step leads, as long as in the second number of jet_begin: point, dual, these. */
void jet_ahead(double *out, const double *const in[], int n);
/* About how far the surface is along it, if what the dual, and the dual at that place, tell of the
 * function is a parabola: right at simple and double roots. Dual, those numbers, dual ahead. */
void jet_estimated(double *out, const double *const in[], int n);
/* The same after a box, 0 for the next one: none. The jet in it, what was known before, the
 * thickness. */
void jet_solid(double *out, const double *const in[], int n);
void jet_sheet(double *out, const double *const in[], int n);

/* The way that is free, exactly: the greatest half side r of a box in which |f| is known to stay
 * above 0, by the slope, |f| > M r, or by the values. This r changes by no more than the way, and
 * without jumps, since the box around another point lies in one that is larger by the way there:
 * so what mixes distances can have it. It is the root of a falling function, found by false
 * position (Illinois, Dowell and Jarratt 1971), or by halves where the function jumps. The search
 * is a matrix of the columns (r to try, |f|, which end was moved: -1, 1, or 2: r is it), (least
 * end, its function, longest r), (greatest end, its function, rounds). Dual, longest r. */
void jet_search(double *out, const double *const in[], int n);
void jet_searched(double *out, const double *const in[], int n); /* jet in the box, search */

#endif
