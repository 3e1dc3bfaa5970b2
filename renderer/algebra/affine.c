/* SPDX-License-Identifier: MIT */
/* Affine sums, read off the nodes of an equation. */
#include "affine.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/json.h"

void affine_init(struct affine *a)
{
    for (int i = 0; i < AFFINE_TERMS; i++) {
        fmpq_init(a->of[i]);
    }
}

void affine_clear(struct affine *a)
{
    for (int i = 0; i < AFFINE_TERMS; i++) {
        fmpq_clear(a->of[i]);
    }
}

void affine_number(fmpq_t out, double value)
{
    char text[32], digits[32] = "";
    long exponent = 0;
    size_t used = 0;
    fmpz_t scale;

    json_number(value, text);
    for (const char *c = text, *point = NULL; *c; c++) {
        if (*c == 'e') {
            exponent += strtol(c + 1, NULL, 10);
            break;
        }
        if (*c == '.') {
            point = c;
        } else {
            digits[used++] = *c;
            exponent -= point != NULL;
        }
    }
    fmpz_init(scale);
    fmpz_set_str(fmpq_numref(out), digits, 10);
    fmpz_one(fmpq_denref(out));
    fmpz_set_ui(scale, 10);
    fmpz_pow_ui(scale, scale, (ulong)labs(exponent));
    if (exponent < 0) {
        fmpq_div_fmpz(out, out, scale);
    } else {
        fmpq_mul_fmpz(out, out, scale);
    }
    fmpz_clear(scale);
}

static void scale(struct affine *a, const fmpq_t by, bool divide)
{
    for (int i = 0; i < AFFINE_TERMS; i++) {
        if (divide) {
            fmpq_div(a->of[i], a->of[i], by);
        } else {
            fmpq_mul(a->of[i], a->of[i], by);
        }
    }
}

static bool is_number(const struct affine *a)
{
    bool others = false;

    for (int i = 0; i < AFFINE_TERMS; i++) {
        others = others || (i != AFFINE_ONE && !fmpq_is_zero(a->of[i]));
    }
    return !others;
}

static bool combine(struct affine *a, struct affine *b, enum equation_op op)
{
    switch (op) {
    case EQUATION_ADD:
    case EQUATION_SUBTRACT:
        for (int i = 0; i < AFFINE_TERMS; i++) {
            if (op == EQUATION_ADD) {
                fmpq_add(a->of[i], a->of[i], b->of[i]);
            } else {
                fmpq_sub(a->of[i], a->of[i], b->of[i]);
            }
        }
        return true;
    case EQUATION_MULTIPLY:
        if (!is_number(b)) {
            const struct affine swapped = *a;
            *a = *b;
            *b = swapped;
        }
        if (is_number(b)) {
            scale(a, b->of[AFFINE_ONE], false);
            return true;
        }
        return false;
    case EQUATION_DIVIDE:
        if (is_number(b) && !fmpq_is_zero(b->of[AFFINE_ONE])) {
            scale(a, b->of[AFFINE_ONE], true);
            return true;
        }
        return false;
    default:
        return false;
    }
}

static bool read_constant(struct affine *out, const struct equation_node *node)
{
    const char *name = equation_constants[node->which].name;
    const bool is_pi = strcmp(name, "pi") == 0, is_tau = strcmp(name, "tau") == 0;

    fmpq_set_si(out->of[AFFINE_PI], is_tau ? 2 : 1, 1);
    return is_pi || is_tau;
}

bool affine_read(struct affine *out, const struct equation *equation, uint16_t index)
{
    const struct equation_node *node = &equation->nodes[index];
    struct affine other;
    bool ok;

    switch ((enum equation_op)node->op) {
    case EQUATION_NUMBER:
        affine_number(out->of[AFFINE_ONE], node->value);
        return true;
    case EQUATION_CONSTANT:
        return read_constant(out, node);
    case EQUATION_LETTER:
        fmpq_one(out->of[node->which]);
        return true;
    case EQUATION_NEGATE:
        ok = affine_read(out, equation, node->args[0]);
        for (int i = 0; i < AFFINE_TERMS; i++) {
            fmpq_neg(out->of[i], out->of[i]);
        }
        return ok;
    case EQUATION_ADD:
    case EQUATION_SUBTRACT:
    case EQUATION_MULTIPLY:
    case EQUATION_DIVIDE:
        affine_init(&other);
        ok = affine_read(out, equation, node->args[0]) &&
             affine_read(&other, equation, node->args[1]) &&
             combine(out, &other, (enum equation_op)node->op);
        affine_clear(&other);
        return ok;
    default:
        return false;
    }
}
