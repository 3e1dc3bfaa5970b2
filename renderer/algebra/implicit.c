/* SPDX-License-Identifier: MIT */
/* The letters of an equation are numbers of its node; decimals are the fractions that are written.
 */
#include "implicit.h"

#include <stdlib.h>
#include <string.h>

#include "affine.h"
#include "expression.h"
#include "protocol/limits.h"

struct values {
    const struct record *params;
    const fmpz_mpoly_ctx_struct *space;
    struct error *err;
};

static bool leaf(void *data, const struct equation_node *node, struct fraction *out)
{
    const struct values *values = data;

    if (node->op == EQUATION_AXIS) {
        fmpz_mpoly_gen(out->over, node->which, values->space);
        return true;
    }
    if (node->op != EQUATION_LETTER) {
        return expression_refuse(node, values->err);
    }
    fmpq_t number;
    fmpq_init(number);
    affine_number(number, record_number(values->params, equation_letters[node->which]));
    fraction_set_fmpq(out, number, values->space);
    fmpq_clear(number);
    return true;
}

static struct equation *read_text(const char *text, struct error *err)
{
    struct equation_errors errors = {0};
    struct equation *equation = equation_read(text, equation_letters, &errors);

    if (!equation) {
        equation_errors_tell(&errors, ERROR_INVALID, "", err);
    }
    return equation;
}

bool implicit_read(struct fraction *out, const struct record *params, const fmpz_mpoly_ctx_t space,
                   struct error *err)
{
    const char *text = record_text(params, "equation");
    struct fraction right;
    struct equation *equation =
        expression_check_digits(text, "", err) ? read_text(text, err) : NULL;

    if (!equation) {
        return false;
    }
    struct values values = {params, space, err};
    const struct expression e = {equation, space, leaf, &values, err};
    fraction_init(&right, space);
    bool ok =
        expression_value(&e, equation->left, out) && expression_value(&e, equation->right, &right);
    if (ok) {
        fraction_negate(&right, &right, space);
        ok = fraction_add(out, out, &right, space, err);
    }
    fraction_clear(&right, space);
    free(equation);
    return ok;
}
