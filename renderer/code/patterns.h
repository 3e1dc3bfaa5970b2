/* SPDX-License-Identifier: MIT */
/* Patterns that users' code can call, in C; in GLSL they are in glsl/code.glsl. What they give
 * stands in the table (builtins.c).
 *
 * Cells have their walls at whole numbers, but for a little farther from the origin: a face that
 * lies on whole numbers has the colour of what is inside, where rounding would else make noise of
 * it. */
#ifndef RENDERER_CODE_PATTERNS_H
#define RENDERER_CODE_PATTERNS_H

/* As in glsl/code.glsl. */
#define PATTERN_WALL 0.015625 /* how far walls are beyond whole numbers */
enum { PATTERN_OCTAVES = 8 };

double pattern_stripes(double x);

/* As `whole` of struct builtin: `in` are the arguments, the first a vector of `n`. */
void pattern_noise(double *out, const double *const in[], int n);
void pattern_fbm(double *out, const double *const in[], int n);
void pattern_hash(double *out, const double *const in[], int n);
void pattern_checker(double *out, const double *const in[], int n);
void pattern_triplanar(double *out, const double *const in[], int n);

#endif
