/* SPDX-License-Identifier: MIT */
#include "equation_expand.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "equation_value.h"
#include "protocol/memory.h"
#include "renderer/sdf/polynomial.h"

/* --- degrees --- */

/* -1: no polynomial. */
static int degree_of(const struct equation_node *node, const int *degrees)
{
    const int a = degrees[node->args[0]], b = degrees[node->args[1]];

    if (!node->varies) {
        return 0;
    }
    switch ((enum equation_op)node->op) {
    case EQUATION_AXIS:
        return 1;
    case EQUATION_ADD:
    case EQUATION_SUBTRACT:
        return a < 0 || b < 0 ? -1 : a > b ? a : b;
    case EQUATION_MULTIPLY:
        return a < 0 || b < 0 ? -1 : a + b;
    case EQUATION_DIVIDE:
        return b == 0 ? a : -1;
    case EQUATION_NEGATE:
        return a;
    case EQUATION_WHOLE:
        return a < 0 || node->value < 0 ? -1 : a * (int)node->value;
    default:
        return -1;
    }
}

int equation_degree(const struct equation *equation)
{
    int degrees[LIMIT_EQUATION_NODES + 1];

    for (size_t i = 0; i < equation->count; i++) {
        const struct equation_node *node = &equation->nodes[i];
        degrees[i] = degree_of(node, degrees);
        if (degrees[i] > LIMIT_POLYNOMIAL_DEGREE) {
            degrees[i] = -1;
        }
    }
    const int a = degrees[equation->left], b = degrees[equation->right];
    return a < 0 || b < 0 ? -1 : a > b ? a : b;
}

bool equation_take_root(struct equation *equation)
{
    const struct equation_node *left = &equation->nodes[equation->left];
    const struct equation_node *right = &equation->nodes[equation->right];
    const bool is_zero =
        right->op == EQUATION_NUMBER && right->value == 0 &&
        (equation->relation == EQUATION_EQUALS || equation->relation == EQUATION_LESS_EQUAL);
    const bool is_even = left->op == EQUATION_WHOLE && left->value > 0 && fmod(left->value, 2) == 0;

    if (is_zero && is_even) {
        equation->left = left->args[0];
    }
    return is_zero && is_even;
}

/* --- numbers --- */

static double divided(double a, double b)
{
    return a / copysign(fmax(fabs(b), 1e-18), b);
}

static double number_of(const struct equation_node *node, const double *letters, double a, double b)
{
    switch ((enum equation_op)node->op) {
    case EQUATION_NUMBER:
        return node->value;
    case EQUATION_CONSTANT:
        return equation_constants[node->which].value;
    case EQUATION_LETTER:
        return letters[node->which];
    case EQUATION_ADD:
        return a + b;
    case EQUATION_SUBTRACT:
        return a - b;
    case EQUATION_MULTIPLY:
        return a * b;
    case EQUATION_DIVIDE:
        return divided(a, b);
    case EQUATION_POWER:
        return pow(fmax(a, 1e-18), b);
    case EQUATION_NEGATE:
        return -a;
    case EQUATION_WHOLE:
        return node->value < 0 ? divided(1, pow(a, -node->value)) : pow(a, node->value);
    default:
        return equation_call((enum equation_name)node->which, a, b);
    }
}

/* --- polynomials --- */

struct expansion {
    int degree;
    double *c;
};

static size_t count_of(int degree)
{
    return polynomial_at(degree, degree, 0) + 1;
}

static struct expansion begin(int degree)
{
    return (struct expansion){degree, memory_alloc(count_of(degree), sizeof(double))};
}

/* to += factor * from */
static void add(struct expansion *to, const struct expansion *from, double factor)
{
    const double *c = from->c;

    for (int i = 0; i <= from->degree; i++) {
        for (int j = 0; j <= from->degree - i; j++) {
            double *row = to->c + polynomial_at(to->degree, i, j);
            for (int k = 0; k <= from->degree - i - j; k++) {
                row[k] += factor * *c++;
            }
        }
    }
}

/* to += c x^i y^j z^k of b */
static void add_shifted(struct expansion *to, const struct expansion *b, const int by[3], double c)
{
    const double *from = b->c;

    for (int i = 0; i <= b->degree; i++) {
        for (int j = 0; j <= b->degree - i; j++) {
            double *row = to->c + polynomial_at(to->degree, i + by[0], j + by[1]) + by[2];
            for (int k = 0; k <= b->degree - i - j; k++) {
                row[k] += c * *from++;
            }
        }
    }
}

static struct expansion product(const struct expansion *a, const struct expansion *b)
{
    struct expansion out = begin(a->degree + b->degree);
    const double *c = a->c;

    for (int i = 0; i <= a->degree; i++) {
        for (int j = 0; j <= a->degree - i; j++) {
            for (int k = 0; k <= a->degree - i - j; k++, c++) {
                if (*c != 0) {
                    add_shifted(&out, b, (const int[]){i, j, k}, *c);
                }
            }
        }
    }
    return out;
}

static struct expansion power(const struct expansion *a, int n)
{
    struct expansion out = begin(0);

    out.c[0] = 1;
    for (int i = 0; i < n; i++) {
        struct expansion next = product(&out, a);
        free(out.c);
        out = next;
    }
    return out;
}

static struct expansion sum(const struct expansion *a, const struct expansion *b, double factor)
{
    struct expansion out = begin(a->degree > b->degree ? a->degree : b->degree);

    add(&out, a, 1);
    add(&out, b, factor);
    return out;
}

static struct expansion scaled(const struct expansion *a, double factor)
{
    struct expansion out = begin(a->degree);

    add(&out, a, factor);
    return out;
}

static struct expansion expand_axis(int axis, double extent)
{
    struct expansion out = begin(1);

    out.c[polynomial_at(1, axis == 0, axis == 1) + (axis == 2)] = extent;
    return out;
}

static struct expansion expand(const struct equation_node *node, const struct expansion *a,
                               const struct expansion *b, const double *letters, double extent)
{
    if (!node->varies) {
        struct expansion out = begin(0);
        out.c[0] = number_of(node, letters, a->c ? a->c[0] : 0, b->c ? b->c[0] : 0);
        return out;
    }
    switch ((enum equation_op)node->op) {
    case EQUATION_AXIS:
        return expand_axis(node->which, extent);
    case EQUATION_ADD:
        return sum(a, b, 1);
    case EQUATION_SUBTRACT:
        return sum(a, b, -1);
    case EQUATION_DIVIDE:
        return scaled(a, divided(1, b->c[0]));
    case EQUATION_NEGATE:
        return scaled(a, -1);
    case EQUATION_WHOLE:
        return power(a, (int)node->value);
    default:
        return product(a, b);
    }
}

/* The largest becomes 1, or -1. */
static void normalize(double *c, size_t count)
{
    double most = 0;

    for (size_t i = 0; i < count; i++) {
        c[i] = isfinite(c[i]) ? c[i] : 0;
        most = fmax(most, fabs(c[i]));
    }
    for (size_t i = 0; most > 0 && i < count; i++) {
        c[i] /= most;
    }
}

static void mark_used(const struct equation *equation, bool *used)
{
    used[equation->left] = used[equation->right] = true;
    for (size_t i = equation->count; i-- > 0;) {
        for (int k = 0; used[i] && k < equation_arguments(&equation->nodes[i]); k++) {
            used[equation->nodes[i].args[k]] = true;
        }
    }
}

void equation_expand(const struct equation *equation, const double *letters, double extent,
                     int degree, double *out)
{
    bool used[LIMIT_EQUATION_NODES + 1] = {false};
    struct expansion *parts = memory_alloc(equation->count, sizeof *parts);
    const bool turned =
        equation->relation == EQUATION_GREATER || equation->relation == EQUATION_GREATER_EQUAL;
    struct expansion whole = {degree, out};

    mark_used(equation, used);
    memset(out, 0, count_of(degree) * sizeof *out);
    for (size_t i = 0; i < equation->count; i++) {
        const struct equation_node *node = &equation->nodes[i];
        if (used[i]) {
            parts[i] = expand(node, &parts[node->args[0]], &parts[node->args[1]], letters, extent);
        }
    }
    add(&whole, &parts[equation->left], turned ? -1 : 1);
    add(&whole, &parts[equation->right], turned ? 1 : -1);
    normalize(out, count_of(degree));
    for (size_t i = 0; i < equation->count; i++) {
        free(parts[i].c);
    }
    free(parts);
}
