/* SPDX-License-Identifier: MIT */
/* The tables of the language, and the nodes of an equation. */
#include "equation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "equation_internal.h"

const char *const equation_axes[] = {"x", "y", "z", NULL};

/* clang-format off */
const struct equation_function equation_functions[EQUATION_FUNCTIONS] = {
    [EQUATION_SIN]   = {"sin",   1, EQUATION_CALLED, NULL,     NULL},
    [EQUATION_COS]   = {"cos",   1, EQUATION_CALLED, NULL,     NULL},
    [EQUATION_TAN]   = {"tan",   1, EQUATION_CALLED, NULL,     NULL},
    [EQUATION_ASIN]  = {"asin",  1, EQUATION_CALLED, "arcsin", NULL},
    [EQUATION_ACOS]  = {"acos",  1, EQUATION_CALLED, "arccos", NULL},
    [EQUATION_ATAN]  = {"atan",  1, EQUATION_CALLED, "arctan", NULL},
    [EQUATION_SINH]  = {"sinh",  1, EQUATION_CALLED, NULL,     NULL},
    [EQUATION_COSH]  = {"cosh",  1, EQUATION_CALLED, NULL,     NULL},
    [EQUATION_TANH]  = {"tanh",  1, EQUATION_CALLED, NULL,     NULL},
    [EQUATION_EXP]   = {"exp",   1, EQUATION_RAISED, "e",      NULL},
    [EQUATION_LOG]   = {"log",   1, EQUATION_CALLED, "ln",     NULL},
    [EQUATION_SQRT]  = {"sqrt",  1, EQUATION_ROOT,   NULL,     NULL},
    [EQUATION_CBRT]  = {"cbrt",  1, EQUATION_ROOT,   "3",      NULL},
    [EQUATION_ABS]   = {"abs",   1, EQUATION_FENCED, "|",      "|"},
    [EQUATION_SIGN]  = {"sign",  1, EQUATION_CALLED, "sgn",    NULL},
    [EQUATION_FLOOR] = {"floor", 1, EQUATION_FENCED, "\u230a", "\u230b"},
    [EQUATION_CEIL]  = {"ceil",  1, EQUATION_FENCED, "\u2308", "\u2309"},
    [EQUATION_MIN]   = {"min",   2, EQUATION_CALLED, NULL,     NULL},
    [EQUATION_MAX]   = {"max",   2, EQUATION_CALLED, NULL,     NULL},
    [EQUATION_ATAN2] = {"atan2", 2, EQUATION_CALLED, NULL,     NULL},
};

const struct equation_constant equation_constants[] = {
    {"pi",  M_PI,               "\u03c0"},
    {"tau", 2 * M_PI,           "\u03c4"},
    {"e",   M_E,                "e"},
    {"phi", 1.6180339887498949, "\u03c6"},
    {NULL,  0,                  NULL},
};

const struct equation_sign equation_relations[] = {
    [EQUATION_EQUALS]        = {"=",  "="},
    [EQUATION_LESS]          = {"<",  "&lt;"},
    [EQUATION_LESS_EQUAL]    = {"<=", "\u2264"},
    [EQUATION_GREATER]       = {">",  "&gt;"},
    [EQUATION_GREATER_EQUAL] = {">=", "\u2265"},
};
/* clang-format on */

#define LETTER_NAME(LETTER, ...) LETTER,
const char *const equation_letters[] = {EQUATION_LETTERS_EACH(LETTER_NAME, ) NULL};

int equation_arguments(const struct equation_node *node)
{
    switch ((enum equation_op)node->op) {
    case EQUATION_NUMBER:
    case EQUATION_CONSTANT:
    case EQUATION_AXIS:
    case EQUATION_LETTER:
        return 0;
    case EQUATION_NEGATE:
    case EQUATION_WHOLE:
        return 1;
    case EQUATION_CALL:
        return equation_functions[node->which].arguments;
    default:
        return 2;
    }
}

static bool is_same(const struct equation_node *a, const struct equation_node *b)
{
    return a->op == b->op && a->which == b->which && a->args[0] == b->args[0] &&
           a->args[1] == b->args[1] && memcmp(&a->value, &b->value, sizeof a->value) == 0;
}

/* What the operators make of known numbers. */
static bool compute(const struct equation_node *node, const double in[2], double *out)
{
    switch ((enum equation_op)node->op) {
    case EQUATION_NUMBER:
        *out = node->value;
        return true;
    case EQUATION_CONSTANT:
        *out = equation_constants[node->which].value;
        return true;
    case EQUATION_ADD:
        *out = in[0] + in[1];
        return true;
    case EQUATION_SUBTRACT:
        *out = in[0] - in[1];
        return true;
    case EQUATION_MULTIPLY:
        *out = in[0] * in[1];
        return true;
    case EQUATION_DIVIDE:
        *out = in[0] / in[1];
        return true;
    case EQUATION_NEGATE:
        *out = -in[0];
        return true;
    case EQUATION_WHOLE:
        *out = pow(in[0], node->value);
        return true;
    case EQUATION_POWER:
        *out = pow(in[0], in[1]);
        return true;
    default:
        return false;
    }
}

static void derive(const struct equation *equation, struct equation_node *node)
{
    double in[2] = {0, 0};
    bool all_known = true;

    node->varies = node->op == EQUATION_AXIS;
    node->weight = 1;
    for (int i = 0; i < equation_arguments(node); i++) {
        const struct equation_node *arg = &equation->nodes[node->args[i]];
        node->varies = node->varies || arg->varies;
        node->weight += arg->weight;
        all_known = all_known && arg->known;
        in[i] = arg->constant;
    }
    node->known = all_known && compute(node, in, &node->constant);
}

bool equation_add(struct equation *equation, struct equation_node node, uint16_t *out)
{
    size_t i = 0;

    while (i < equation->count && !is_same(&equation->nodes[i], &node)) {
        i++;
    }
    *out = (uint16_t)i;
    if (i < equation->count) {
        return true;
    }
    derive(equation, &node);
    if (i == LIMIT_EQUATION_NODES || node.weight > LIMIT_EQUATION_WEIGHT) {
        *out = 0;
        return false;
    }
    equation->nodes[equation->count++] = node;
    return true;
}

/* Whether an earlier one says the same, as of a name that is written twice. */
static bool is_again(const struct equation_errors *errors, int which)
{
    int i = 0;

    while (strcmp(errors->list[i].message, errors->list[which].message) != 0) {
        i++;
    }
    return i < which;
}

bool equation_errors_tell(const struct equation_errors *errors, enum error_kind kind,
                          const char *place, struct error *err)
{
    enum { REST = sizeof "; and 7 more)" };
    const struct equation_error *first = &errors->list[0];
    char text[sizeof err->message], next[sizeof first->message + 32];
    size_t used = (size_t)snprintf(text, sizeof text, "%s", first->message);
    int told = 0, more = 0;

    for (int i = 1; i < errors->count; i++) {
        const struct equation_error *one = &errors->list[i];
        if (is_again(errors, i)) {
            continue;
        }
        const size_t length =
            (size_t)snprintf(next, sizeof next, "%s%d:%d: %s", told == 0 ? " (also " : "; ",
                             one->line, one->column, one->message);
        if (more > 0 || used + length + REST > sizeof text) {
            more++;
            continue;
        }
        memcpy(text + used, next, length + 1);
        used += length;
        told++;
    }
    if (more > 0) {
        snprintf(text + used, sizeof text - used, "%sand %d more)", told > 0 ? "; " : " (", more);
    } else if (told > 0) {
        snprintf(text + used, sizeof text - used, ")");
    }
    return error_set_at(err, kind, place, first->line, first->column, "%s", text);
}
