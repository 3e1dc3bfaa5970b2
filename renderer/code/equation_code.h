/* SPDX-License-Identifier: MIT */
/* Implicit equations as distance functions in the language of users' code, so that C, the engine
 * and GLSL run one text.
 *
 * At a point the function's value f and gradient g are computed, by dual numbers. |f| / |g|, which
 * is Newton's step, bounds the distance neither from above nor from below. In a box around the
 * point, with this step as half of its length, intervals give what the slope is at most: M. No
 * point of the surface is nearer than the lesser of |f| / M and the step (the mean value theorem;
 * Mitchell, Robust ray intersection with interval arithmetic, Graphics Interface 1990, for the
 * intervals). Where the step is short M is hardly above |g|, so rays converge as fast as Newton's
 * method. Beside the end of a domain M may have no bound: what tells there is a box, as large as
 * can be found, that has no zero among the values of f (glsl/jets.glsl).
 *
 * The equation is asked within its clip alone, at the point of the clip that is nearest. What is in
 * the clip lies beyond that point, at a right angle or more, so outside both ways together are no
 * longer than the distance. Farther from the clip than EQUATION_MARGIN of its extent the way to the
 * clip is the distance, and the equation is not asked: that took a third of all evaluations. With
 * less of a margin the clip would be seen in soft shadows and ambient occlusion.
 *
 * So the distance changes as fast as the way where it exceeds equation_unsteady(), and is the lower
 * bound of a distance everywhere. Where an estimate is asked for (glsl/field_mask.glsl) it is the
 * way along the gradient to the root of a parabola, by the function's value there, its slope, and
 * its value where Newton's step leads; no box is asked then.
 *
 * What blends shapes, rounds or thickens them draws where distances are not 0: any jump of them is
 * seen there, and a ray that relies on them comes through. For these the bound is `even`: the
 * greatest box is searched for in which the function stays above 0 (jet_search). */
#ifndef RENDERER_EQUATION_CODE_H
#define RENDERER_EQUATION_CODE_H

#include "protocol/equation.h"
#include "protocol/param.h"

/* What is made of the surface. */
struct equation_form {
    bool sheet; /* so thick as the number `thickness` says; else what is behind it, solid */
    bool ball;  /* cut by one of the number `radius`; else by a box of the lengths `size` */
    bool even;  /* the distance changes by no more than the way, everywhere and without jumps */
};

#define EQUATION_MARGIN 0.15  /* around the clip, as a part of its extent */
#define EQUATION_REACH 0.25   /* the same of the longest step that is tried */
#define EQUATION_ESTIMATE 0.5 /* the same of an estimate at most */
/* Above this the distance is that to the clip. No distance is below minus this. `extent` is the
 * radius of the clip, or half of the diagonal of its box. */
double equation_unsteady(double extent);

/* Numbers that the code of a distance reads, four in each vec4: lengths of the clip's box, the
 * ball's radius, the thickness, then letters and numbers of the equation, in the order of its
 * nodes. So equations that differ in numbers alone have one text. All letters have a place. Numbers
 * without one, because these are too many, stay in it. */
enum { EQUATION_VECTORS = 16, EQUATION_FORM_NUMBERS = 5 };

/* `form`: the first of them; `letters`: of equation_letters. Returns how many vec4s. */
int equation_code_numbers(const struct equation *equation, const double form[EQUATION_FORM_NUMBERS],
                          const double *letters, double out[4 * EQUATION_VECTORS]);
/* The parameters of such code: so many vec4s, and a row whose name is NULL. */
void equation_code_params(int vectors, struct param out[EQUATION_VECTORS + 1]);
/* The text of float sdf(vec3 p), which reads these. The caller frees it. */
char *equation_code(const struct equation *equation, struct equation_form form);
/* The text of vec4 function_at(vec3 p), with `rest` behind it: gradient and value of left - right,
 * which reads the equation's letters. The caller frees it. */
char *equation_function_code(const struct equation *equation, const char *const *letters,
                             const char *rest);

#endif
