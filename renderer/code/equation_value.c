/* SPDX-License-Identifier: MIT */
#include "equation_value.h"

#include <math.h>

double equation_call(enum equation_name name, double a, double b)
{
    switch (name) {
    case EQUATION_SIN:
        return sin(a);
    case EQUATION_COS:
        return cos(a);
    case EQUATION_TAN:
        return tan(a);
    case EQUATION_ASIN:
        return asin(fmin(fmax(a, -1), 1));
    case EQUATION_ACOS:
        return acos(fmin(fmax(a, -1), 1));
    case EQUATION_ATAN:
        return atan(a);
    case EQUATION_SINH:
        return sinh(a);
    case EQUATION_COSH:
        return cosh(a);
    case EQUATION_TANH:
        return tanh(a);
    case EQUATION_EXP:
        return exp(a);
    case EQUATION_LOG:
        return log(fmax(a, 1e-18));
    case EQUATION_SQRT:
        return sqrt(fmax(a, 0));
    case EQUATION_CBRT:
        return cbrt(a);
    case EQUATION_ABS:
        return fabs(a);
    case EQUATION_SIGN:
        return (a > 0) - (a < 0);
    case EQUATION_FLOOR:
        return floor(a);
    case EQUATION_CEIL:
        return ceil(a);
    case EQUATION_ATAN2:
        return atan2(a, b);
    case EQUATION_MIN:
        return fmin(a, b);
    case EQUATION_MAX:
        return fmax(a, b);
    case EQUATION_FUNCTIONS:
        break;
    }
    return NAN;
}

static double node_value(const struct equation_node *node, const double *in, const double p[3],
                         const double *letters)
{
    const double a = in[node->args[0]], b = in[node->args[1]];

    switch ((enum equation_op)node->op) {
    case EQUATION_NUMBER:
        return node->value;
    case EQUATION_CONSTANT:
        return equation_constants[node->which].value;
    case EQUATION_AXIS:
        return p[node->which];
    case EQUATION_LETTER:
        return letters[node->which];
    case EQUATION_ADD:
        return a + b;
    case EQUATION_SUBTRACT:
        return a - b;
    case EQUATION_MULTIPLY:
        return a * b;
    case EQUATION_DIVIDE:
        return a / b;
    case EQUATION_POWER:
        return pow(fmax(a, 1e-18), b);
    case EQUATION_NEGATE:
        return -a;
    case EQUATION_WHOLE:
        return pow(a, node->value);
    case EQUATION_CALL:
        return equation_call((enum equation_name)node->which, a, b);
    }
    return NAN;
}

static void find_values(const struct equation *equation, const double p[3], const double *letters,
                        double *values)
{
    for (size_t i = 0; i < equation->count; i++) {
        values[i] = node_value(&equation->nodes[i], values, p, letters);
    }
}

double equation_expression_value(const struct equation *equation, const double *letters,
                                 double *room)
{
    static const double origin[3];

    room[0] = 0; /* what nodes without arguments name */
    find_values(equation, origin, letters, room);
    return room[equation->left];
}

double equation_value(const struct equation *equation, const double p[3], const double *letters)
{
    double values[LIMIT_EQUATION_NODES + 1] = {0};

    find_values(equation, p, letters, values);
    const double f = values[equation->left] - values[equation->right];
    return equation->relation == EQUATION_GREATER || equation->relation == EQUATION_GREATER_EQUAL
               ? -f
               : f;
}
