/* SPDX-License-Identifier: MIT */
/* Values of expressions, from arguments to results: arguments have lower indices. */
#include "expression.h"

#include <ctype.h>
#include <stdlib.h>

#include "affine.h"

enum { EXACT_DIGITS = 15 }; /* decimals that a double gives back as they were */

bool expression_check_digits(const char *text, const char *place, struct error *err)
{
    int digits = 0;

    for (const char *at = text; *at; at++) {
        if (isdigit((unsigned char)*at)) {
            digits += digits > 0 || *at != '0';
        } else if (*at != '.') {
            digits = 0;
        }
        if (digits > EXACT_DIGITS) {
            return error_set(err, ERROR_LIMIT, place,
                             "a number has more than %d digits, which are rounded", EXACT_DIGITS);
        }
    }
    return true;
}

static bool is_leaf(const struct equation_node *node)
{
    switch ((enum equation_op)node->op) {
    case EQUATION_CONSTANT:
    case EQUATION_AXIS:
    case EQUATION_LETTER:
    case EQUATION_POWER:
    case EQUATION_CALL:
        return true;
    default:
        return false;
    }
}

bool expression_refuse(const struct equation_node *node, struct error *err)
{
    switch ((enum equation_op)node->op) {
    case EQUATION_CONSTANT:
        return error_set(err, ERROR_INVALID, "",
                         "%s is no rational number; outside of sin and cos write a decimal",
                         equation_constants[node->which].name);
    case EQUATION_POWER:
        return error_set(err, ERROR_INVALID, "",
                         "an exponent that is no whole number makes no polynomial");
    case EQUATION_CALL:
        return error_set(err, ERROR_INVALID, "", "%s() makes no polynomial",
                         equation_functions[node->which].name);
    default:
        return error_set(err, ERROR_INVALID, "", "this makes no polynomial");
    }
}

static void number_value(struct fraction *out, double value, const fmpz_mpoly_ctx_t ring)
{
    fmpq_t number;

    fmpq_init(number);
    affine_number(number, value);
    fraction_set_fmpq(out, number, ring);
    fmpq_clear(number);
}

static bool find_value(const struct expression *e, struct fraction *values, uint16_t index)
{
    const struct equation_node *node = &e->equation->nodes[index];
    struct fraction *out = &values[index], *a = &values[node->args[0]], *b = &values[node->args[1]];

    switch ((enum equation_op)node->op) {
    case EQUATION_NUMBER:
        number_value(out, node->value, e->ring);
        return true;
    case EQUATION_ADD:
        return fraction_add(out, a, b, e->ring, e->err);
    case EQUATION_SUBTRACT:
        fraction_negate(out, b, e->ring);
        return fraction_add(out, a, out, e->ring, e->err);
    case EQUATION_MULTIPLY:
        return fraction_multiply(out, a, b, e->ring, e->err);
    case EQUATION_DIVIDE:
        return fraction_invert(out, b, e->ring, e->err) &&
               fraction_multiply(out, a, out, e->ring, e->err);
    case EQUATION_NEGATE:
        fraction_negate(out, a, e->ring);
        return true;
    case EQUATION_WHOLE:
        return fraction_power(out, a, (long)node->value, e->ring, e->err);
    default:
        return e->leaf(e->data, node, out);
    }
}

/* What the root hangs on, arguments of leaves left out. */
static void mark_needed(const struct equation *equation, uint16_t root, bool *needed)
{
    needed[root] = true;
    for (int i = root; i >= 0; i--) {
        const struct equation_node *node = &equation->nodes[i];
        for (int k = 0; needed[i] && !is_leaf(node) && k < equation_arguments(node); k++) {
            needed[node->args[k]] = true;
        }
    }
}

bool expression_value(const struct expression *e, uint16_t root, struct fraction *out)
{
    const size_t count = root + 1u;
    bool needed[LIMIT_EQUATION_NODES + 1] = {false};
    struct fraction *values = calloc(count, sizeof *values);

    if (!values) {
        return error_set(e->err, ERROR_INTERNAL, "", "out of memory");
    }
    mark_needed(e->equation, root, needed);
    bool ok = true;
    for (size_t i = 0; i < count; i++) {
        fraction_init(&values[i], e->ring);
        ok = ok && (!needed[i] || find_value(e, values, (uint16_t)i));
    }
    if (ok) {
        fraction_set(out, &values[root], e->ring);
    }
    for (size_t i = 0; i < count; i++) {
        fraction_clear(&values[i], e->ring);
    }
    free(values);
    return ok;
}
