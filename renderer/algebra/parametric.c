/* SPDX-License-Identifier: MIT */
/* From three texts to four polynomials: what kind of number each letter is, the value of each node
 * as a fraction, the common denominator. */
#include "parametric.h"

#include <stdlib.h>
#include <string.h>

#include "affine.h"
#include "expression.h"
#include "protocol/limits.h"

static const char *const *const letters = surface_names + SURFACE_PARTS;

enum letter_kind { UNUSED, PLAIN, ANGLE, GROWTH };
static const char *const family_of[] = {
    [ANGLE] = "sin, cos or tan", [GROWTH] = "exp, sinh, cosh or tanh"};

struct reading {
    struct patch *patch;
    const struct equation *equation;
    enum letter_kind kinds[SURFACE_LETTERS];
    fmpq_t units[SURFACE_LETTERS]; /* all multiples of the letter are whole multiples of this */
    int variables[SURFACE_LETTERS];
    bool seen[LIMIT_EQUATION_NODES];
    struct error *err;
};

static bool refuse(const struct reading *r, const char *what)
{
    return error_set(r->err, ERROR_INVALID, "", "%s", what);
}

/* --- what kind each letter is --- */

static enum letter_kind family(const struct equation_node *call)
{
    switch ((enum equation_name)call->which) {
    case EQUATION_SIN:
    case EQUATION_COS:
    case EQUATION_TAN:
        return ANGLE;
    case EQUATION_EXP:
    case EQUATION_SINH:
    case EQUATION_COSH:
    case EQUATION_TANH:
        return GROWTH;
    default:
        return UNUSED;
    }
}

static bool use(struct reading *r, int letter, enum letter_kind kind)
{
    const enum letter_kind before = r->kinds[letter];

    if (before != UNUSED && before != kind) {
        const enum letter_kind within = before > kind ? before : kind;
        return before != PLAIN && kind != PLAIN
                   ? error_set(r->err, ERROR_INVALID, "",
                               "%s stands in %s and in %s: this surface is not algebraic",
                               letters[letter], family_of[before], family_of[kind])
                   : error_set(r->err, ERROR_INVALID, "",
                               "%s stands inside and outside of %s: this surface is not algebraic",
                               letters[letter], family_of[within]);
    }
    r->kinds[letter] = kind;
    return true;
}

static bool survey_call(struct reading *r, const struct equation_node *node)
{
    const enum letter_kind kind = family(node);
    const char *name = equation_functions[node->which].name;
    struct affine argument;
    bool ok = true;

    if (kind == UNUSED) {
        return expression_refuse(node, r->err);
    }
    affine_init(&argument);
    if (!affine_read(&argument, r->equation, node->args[0])) {
        ok = error_set(r->err, ERROR_INVALID, "",
                       "the argument of %s() is no sum of rational multiples of letters and pi",
                       name);
    }
    for (int i = 0; ok && i < SURFACE_LETTERS; i++) {
        if (!fmpq_is_zero(argument.of[i])) {
            ok = use(r, i, kind);
            fmpq_gcd(r->units[i], r->units[i], argument.of[i]);
        }
    }
    affine_clear(&argument);
    return ok;
}

static bool survey(struct reading *r, uint16_t index)
{
    const struct equation_node *node = &r->equation->nodes[index];

    if (r->seen[index]) {
        return true;
    }
    r->seen[index] = true;
    switch ((enum equation_op)node->op) {
    case EQUATION_CALL:
        return survey_call(r, node);
    case EQUATION_LETTER:
        return use(r, node->which, PLAIN);
    case EQUATION_CONSTANT:
    case EQUATION_POWER:
        return expression_refuse(node, r->err);
    default:
        for (int i = 0; i < equation_arguments(node); i++) {
            if (!survey(r, node->args[i])) {
                return false;
            }
        }
        return true;
    }
}

/* --- values --- */

/* The multiple of letter `i` in units; at most as an exponent may be. */
static bool whole_multiple(const struct reading *r, const struct affine *argument, int i, long *out)
{
    fmpq_t ratio;

    *out = 0;
    if (fmpq_is_zero(argument->of[i])) {
        return true;
    }
    fmpq_init(ratio);
    fmpq_div(ratio, argument->of[i], r->units[i]);
    const bool fits = fmpz_bits(fmpq_numref(ratio)) < 32;
    *out = fits ? fmpz_get_si(fmpq_numref(ratio)) : LIMIT_EQUATION_EXPONENT + 1;
    fmpq_clear(ratio);
    return labs(*out) <= LIMIT_EQUATION_EXPONENT ||
           error_set(r->err, ERROR_LIMIT, "",
                     "%s has multiples that differ by a factor over %d (equation_exponent)",
                     letters[i], LIMIT_EQUATION_EXPONENT);
}

/* (re + i im) becomes times (1 - v^2 + 2 v i) for an angle of 2 atan(v), or its conjugate. */
static void turn(struct fraction *re, struct fraction *im, struct fraction *angle, bool back,
                 const fmpz_mpoly_ctx_t ring)
{
    fmpz_mpoly_t a, b, c;

    fmpz_mpoly_init(a, ring);
    fmpz_mpoly_init(b, ring);
    fmpz_mpoly_init(c, ring);
    fmpz_mpoly_mul(a, re->over, angle->over, ring);
    fmpz_mpoly_mul(b, im->over, angle->under, ring);
    fmpz_mpoly_mul(c, re->over, angle->under, ring);
    fmpz_mpoly_mul(im->over, im->over, angle->over, ring);
    if (back) {
        fmpz_mpoly_add(re->over, a, b, ring);
        fmpz_mpoly_sub(im->over, im->over, c, ring);
    } else {
        fmpz_mpoly_sub(re->over, a, b, ring);
        fmpz_mpoly_add(im->over, im->over, c, ring);
    }
    fmpz_mpoly_clear(a, ring);
    fmpz_mpoly_clear(b, ring);
    fmpz_mpoly_clear(c, ring);
}

/* `angle`: 1 - v^2 and 2 v; `size`: 1 + v^2. */
static void half_tangent(struct fraction *angle, fmpz_mpoly_t size, slong variable,
                         const fmpz_mpoly_ctx_t ring)
{
    fmpz_mpoly_t square;

    fmpz_mpoly_init(square, ring);
    fmpz_mpoly_gen(angle->under, variable, ring);
    fmpz_mpoly_mul(square, angle->under, angle->under, ring);
    fmpz_mpoly_scalar_mul_si(angle->under, angle->under, 2, ring);
    fmpz_mpoly_one(size, ring);
    fmpz_mpoly_sub(angle->over, size, square, ring);
    fmpz_mpoly_add(size, size, square, ring);
    fmpz_mpoly_clear(square, ring);
}

/* Quarter turns of an angle that has no letters. */
static bool quarter_turns(const struct reading *r, const struct affine *argument, int *out)
{
    fmpq_t quarters;

    fmpq_init(quarters);
    fmpq_mul_si(quarters, argument->of[AFFINE_PI], 2);
    const bool ok = fmpq_is_zero(argument->of[AFFINE_ONE]) && fmpz_is_one(fmpq_denref(quarters));
    *out = (int)fmpz_fdiv_ui(fmpq_numref(quarters), 4);
    fmpq_clear(quarters);
    return ok || refuse(r, "an angle may be shifted by multiples of pi/2 only: others are not "
                           "rational");
}

static bool angle_value(struct reading *r, struct fraction *out, const struct equation_node *node,
                        const struct affine *argument)
{
    const fmpz_mpoly_ctx_struct *ring = r->patch->ring;
    struct fraction re, im, angle;
    fmpz_mpoly_t size, sizes;
    int quarters = 0;

    fraction_init(&re, ring), fraction_init(&im, ring), fraction_init(&angle, ring);
    fmpz_mpoly_init(size, ring), fmpz_mpoly_init(sizes, ring);
    fmpz_mpoly_one(re.over, ring), fmpz_mpoly_one(sizes, ring);
    bool ok = quarter_turns(r, argument, &quarters);
    for (int i = 0; ok && i < SURFACE_LETTERS; i++) {
        long times;
        ok = whole_multiple(r, argument, i, &times);
        if (ok && times != 0) {
            half_tangent(&angle, size, r->variables[i], ring);
        }
        for (long k = 0; ok && k < labs(times); k++) {
            turn(&re, &im, &angle, times < 0, ring);
            fmpz_mpoly_mul(sizes, sizes, size, ring);
        }
    }
    for (int i = 0; i < quarters; i++) {
        fmpz_mpoly_swap(re.over, im.over, ring);
        fmpz_mpoly_neg(re.over, re.over, ring);
    }
    const bool is_tan = node->which == EQUATION_TAN;
    ok = ok && fraction_set_quotient(out, node->which == EQUATION_COS ? re.over : im.over,
                                     is_tan ? re.over : sizes, ring, r->err);
    fmpz_mpoly_clear(size, ring), fmpz_mpoly_clear(sizes, ring);
    fraction_clear(&re, ring), fraction_clear(&im, ring), fraction_clear(&angle, ring);
    return ok;
}

/* exp(argument) as a fraction of powers of the letters' exponentials. */
static bool exponential(struct reading *r, struct fraction *out, const struct affine *argument)
{
    const fmpz_mpoly_ctx_struct *ring = r->patch->ring;
    struct fraction letter, power;
    bool ok = true;

    if (!fmpq_is_zero(argument->of[AFFINE_ONE]) || !fmpq_is_zero(argument->of[AFFINE_PI])) {
        return refuse(r, "exp of a number is not rational; take it out of the exponent");
    }
    fraction_init(&letter, ring);
    fraction_init(&power, ring);
    fmpz_mpoly_one(out->over, ring);
    for (int i = 0; ok && i < SURFACE_LETTERS; i++) {
        long times;
        ok = whole_multiple(r, argument, i, &times);
        if (ok && times != 0) {
            fmpz_mpoly_gen(letter.over, r->variables[i], ring);
            ok = fraction_power(&power, &letter, times, ring, r->err) &&
                 fraction_multiply(out, out, &power, ring, r->err);
        }
    }
    fraction_clear(&letter, ring);
    fraction_clear(&power, ring);
    return ok;
}

/* With exp = a/b: cosh = (a^2 + b^2)/(2ab), sinh = (a^2 - b^2)/(2ab), tanh = sinh/cosh. */
static bool growth_value(struct reading *r, struct fraction *out, const struct equation_node *node,
                         const struct affine *argument)
{
    const fmpz_mpoly_ctx_struct *ring = r->patch->ring;
    struct fraction e, squares;
    fmpz_mpoly_t both, sum, difference;
    bool ok = exponential(r, out, argument);

    if (!ok || node->which == EQUATION_EXP) {
        return ok;
    }
    fraction_init(&e, ring);
    fraction_init(&squares, ring);
    fmpz_mpoly_init(both, ring), fmpz_mpoly_init(sum, ring), fmpz_mpoly_init(difference, ring);
    fraction_set(&e, out, ring);
    fmpz_mpoly_mul(both, e.over, e.under, ring);
    fmpz_mpoly_scalar_mul_si(both, both, 2, ring);
    fmpz_mpoly_mul(squares.over, e.over, e.over, ring);
    fmpz_mpoly_mul(squares.under, e.under, e.under, ring);
    fmpz_mpoly_add(sum, squares.over, squares.under, ring);
    fmpz_mpoly_sub(difference, squares.over, squares.under, ring);
    ok = fraction_set_quotient(out, node->which == EQUATION_COSH ? sum : difference,
                               node->which == EQUATION_TANH ? sum : both, ring, r->err);
    fmpz_mpoly_clear(both, ring), fmpz_mpoly_clear(sum, ring), fmpz_mpoly_clear(difference, ring);
    fraction_clear(&squares, ring);
    fraction_clear(&e, ring);
    return ok;
}

static bool call_value(struct reading *r, struct fraction *out, const struct equation_node *node)
{
    struct affine argument;

    affine_init(&argument);
    affine_read(&argument, r->equation, node->args[0]);
    const bool ok = family(node) == ANGLE ? angle_value(r, out, node, &argument)
                                          : growth_value(r, out, node, &argument);
    affine_clear(&argument);
    return ok;
}

static bool leaf(void *data, const struct equation_node *node, struct fraction *out)
{
    struct reading *r = data;

    if (node->op == EQUATION_LETTER) {
        fmpz_mpoly_gen(out->over, r->variables[node->which], r->patch->ring);
        return true;
    }
    return node->op == EQUATION_CALL ? call_value(r, out, node) : expression_refuse(node, r->err);
}

static bool find_value(struct reading *r, struct fraction *out)
{
    const struct expression e = {r->equation, r->patch->ring, leaf, r, r->err};

    return expression_value(&e, r->equation->left, out);
}

/* --- texts --- */

static struct equation *read_text(const char *text, const char *place, struct error *err)
{
    struct equation_errors errors = {0};

    if (!expression_check_digits(text, place, err)) {
        return NULL;
    }
    struct equation *equation = strlen(text) <= LIMIT_EQUATION_BYTES
                                    ? equation_read_expression(text, letters, &errors)
                                    : NULL;

    if (!equation && errors.count == 0) {
        error_set(err, ERROR_LIMIT, place, "%zu bytes; the limit is %d (equation_bytes)",
                  strlen(text), LIMIT_EQUATION_BYTES);
    } else if (!equation) {
        equation_errors_tell(&errors, ERROR_INVALID, place, err);
    }
    return equation;
}

static void name_place(struct error *err, const char *place)
{
    if (err && !err->place[0]) {
        snprintf(err->place, sizeof err->place, "%s", place);
    }
}

static bool number_letters(struct reading *r)
{
    int count = 0;

    for (int i = 0; i < SURFACE_LETTERS; i++) {
        r->variables[i] = count;
        r->patch->uses[i] = r->kinds[i] != UNUSED;
        count += r->patch->uses[i];
    }
    return count <= 2 || refuse(r, "a surface has two parameters, and here are more");
}

static bool find_fractions(struct reading *r, struct equation *const equations[3],
                           struct fraction out[3])
{
    bool ok = true;

    for (int i = 0; ok && i < 3; i++) {
        r->equation = equations[i];
        memset(r->seen, 0, sizeof r->seen);
        ok = survey(r, equations[i]->left);
        if (!ok) {
            name_place(r->err, surface_names[i]);
        }
    }
    ok = ok && number_letters(r);
    for (int i = 0; ok && i < 3; i++) {
        r->equation = equations[i];
        ok = find_value(r, &out[i]);
        if (!ok) {
            name_place(r->err, surface_names[i]);
        }
    }
    return ok;
}

/* W is the least common multiple of the denominators; X, Y, Z have it below them. */
static bool join(struct patch *patch, struct fraction in[3], struct error *err)
{
    struct fraction multiple;
    bool ok = true;

    fraction_init(&multiple, patch->ring);
    for (int i = 0; ok && i < 3; i++) {
        /* W / under in lowest terms is k / j; then lcm(W, under) is W j. */
        ok = fraction_set_quotient(&multiple, patch->part[PATCH_W], in[i].under, patch->ring, err);
        fmpz_mpoly_mul(patch->part[PATCH_W], patch->part[PATCH_W], multiple.under, patch->ring);
    }
    for (int i = 0; ok && i < 3; i++) {
        fmpz_mpoly_divides(patch->part[i], patch->part[PATCH_W], in[i].under, patch->ring);
        fmpz_mpoly_mul(patch->part[i], patch->part[i], in[i].over, patch->ring);
    }
    fraction_clear(&multiple, patch->ring);
    const slong degree = patch_degree(patch);
    return ok && (degree <= LIMIT_PARAMETRIC_DEGREE ||
                  error_set(err, ERROR_LIMIT, "",
                            "with one denominator the parameters have degree %ld; the limit is %d "
                            "(parametric_degree)",
                            degree, LIMIT_PARAMETRIC_DEGREE));
}

static void patch_init(struct patch *patch)
{
    fmpz_mpoly_ctx_init(patch->ring, 2, ORD_DEGLEX);
    for (int i = 0; i < PATCH_PARTS; i++) {
        fmpz_mpoly_init(patch->part[i], patch->ring);
    }
    fmpz_mpoly_one(patch->part[PATCH_W], patch->ring);
}

void patch_clear(struct patch *patch)
{
    for (int i = 0; i < PATCH_PARTS; i++) {
        fmpz_mpoly_clear(patch->part[i], patch->ring);
    }
    fmpz_mpoly_ctx_clear(patch->ring);
}

slong patch_degree(const struct patch *patch)
{
    slong degree = 0;

    for (int i = 0; i < PATCH_PARTS; i++) {
        const slong part = fmpz_mpoly_total_degree_si(patch->part[i], patch->ring);
        degree = part > degree ? part : degree;
    }
    return degree;
}

static bool read_equations(struct patch *out, struct equation *const equations[3],
                           struct error *err)
{
    struct reading *r = calloc(1, sizeof *r);
    struct fraction fractions[3];

    if (!r) {
        return error_set(err, ERROR_INTERNAL, "", "out of memory");
    }
    patch_init(out);
    r->patch = out;
    r->err = err;
    for (int i = 0; i < SURFACE_LETTERS; i++) {
        fmpq_init(r->units[i]);
    }
    for (int i = 0; i < 3; i++) {
        fraction_init(&fractions[i], out->ring);
    }
    const bool ok = find_fractions(r, equations, fractions) && join(out, fractions, err);
    for (int i = 0; i < 3; i++) {
        fraction_clear(&fractions[i], out->ring);
    }
    for (int i = 0; i < SURFACE_LETTERS; i++) {
        fmpq_clear(r->units[i]);
    }
    if (!ok) {
        patch_clear(out);
    }
    free(r);
    return ok;
}

bool patch_read(struct patch *out, const char *const texts[3], struct error *err)
{
    struct equation *equations[3] = {NULL};
    bool ok = true;

    for (int i = 0; ok && i < 3; i++) {
        equations[i] = read_text(texts[i], surface_names[i], err);
        ok = equations[i] != NULL;
    }
    ok = ok && read_equations(out, equations, err);
    for (int i = 0; i < 3; i++) {
        free(equations[i]);
    }
    return ok;
}
