/* SPDX-License-Identifier: MIT */
/* Functions of equations that are written by others. */
#include <math.h>

#include "equation_internal.h"

const struct equation_function equation_composites[EQUATION_COMPOSITES] = {
    [EQUATION_HYPOT] = {.name = "hypot", .arguments = 2},
    [EQUATION_CLAMP] = {.name = "clamp", .arguments = 3},
    [EQUATION_MIX] = {.name = "mix", .arguments = 3},
    [EQUATION_LOG2] = {.name = "log2", .arguments = 1},
    [EQUATION_POW] = {.name = "pow", .arguments = 2},
    [EQUATION_FRACT] = {.name = "fract", .arguments = 1},
    [EQUATION_MOD] = {.name = "mod", .arguments = 2},
    [EQUATION_STEP] = {.name = "step", .arguments = 2},
    [EQUATION_SMOOTHSTEP] = {.name = "smoothstep", .arguments = 3},
    [EQUATION_CHEB] = {.name = "cheb", .arguments = 2},
};

struct maker {
    struct equation *equation;
    bool full;
};

static uint16_t make(struct maker *m, struct equation_node node)
{
    uint16_t index = 0;

    m->full = m->full || !equation_add(m->equation, node, &index);
    return index;
}

static uint16_t number(struct maker *m, double value)
{
    return make(m, (struct equation_node){.op = EQUATION_NUMBER, .value = value});
}

static uint16_t two(struct maker *m, enum equation_op op, uint16_t a, uint16_t b)
{
    return make(m, (struct equation_node){.op = (uint8_t)op, .args = {a, b}});
}

static uint16_t call(struct maker *m, enum equation_name name, uint16_t a, uint16_t b)
{
    return make(
        m, (struct equation_node){.op = EQUATION_CALL, .which = (uint8_t)name, .args = {a, b}});
}

static uint16_t whole(struct maker *m, uint16_t base, double exponent)
{
    return make(m,
                (struct equation_node){.op = EQUATION_WHOLE, .args = {base, 0}, .value = exponent});
}

static uint16_t times(struct maker *m, double factor, uint16_t a)
{
    return two(m, EQUATION_MULTIPLY, number(m, factor), a);
}

static uint16_t minus(struct maker *m, uint16_t a, uint16_t b)
{
    return two(m, EQUATION_SUBTRACT, a, b);
}

static uint16_t clamp(struct maker *m, uint16_t x, uint16_t low, uint16_t high)
{
    return call(m, EQUATION_MIN, call(m, EQUATION_MAX, x, low), high);
}

/* y floor(x / y) */
static uint16_t wholes(struct maker *m, uint16_t x, uint16_t y)
{
    return two(m, EQUATION_MULTIPLY, y, call(m, EQUATION_FLOOR, two(m, EQUATION_DIVIDE, x, y), 0));
}

/* t^2 (3 - 2 t) */
static uint16_t smooth(struct maker *m, const uint16_t *in)
{
    const uint16_t along = two(m, EQUATION_DIVIDE, minus(m, in[2], in[0]), minus(m, in[1], in[0]));
    const uint16_t t = clamp(m, along, number(m, 0), number(m, 1));

    return two(m, EQUATION_MULTIPLY, whole(m, t, 2), minus(m, number(m, 3), times(m, 2, t)));
}

/* The Chebyshev polynomial T_n. T_mn is T_m of T_n, which intervals enclose much more narrowly than
 * sums of powers; else T_(2k + 1) = 2 T_k T_(k + 1) - x. */
static uint16_t cheb(struct maker *m, int n, uint16_t x)
{
    int divisor = 2;

    while (divisor < n && n % divisor) {
        divisor++;
    }
    if (n < 2) {
        return n == 0 ? number(m, 1) : x;
    }
    if (n == 2) {
        return minus(m, times(m, 2, whole(m, x, 2)), number(m, 1));
    }
    if (divisor < n) {
        return cheb(m, divisor, cheb(m, n / divisor, x));
    }
    const uint16_t below = cheb(m, n / 2, x), above = cheb(m, n / 2 + 1, x);
    return minus(m, times(m, 2, two(m, EQUATION_MULTIPLY, below, above)), x);
}

bool equation_compose(struct equation *equation, enum equation_composite which, const uint16_t *in,
                      uint16_t *out)
{
    struct maker m = {.equation = equation};

    switch (which) {
    case EQUATION_HYPOT:
        *out = call(&m, EQUATION_SQRT,
                    two(&m, EQUATION_ADD, whole(&m, in[0], 2), whole(&m, in[1], 2)), 0);
        break;
    case EQUATION_CLAMP:
        *out = clamp(&m, in[0], in[1], in[2]);
        break;
    case EQUATION_MIX:
        *out = two(&m, EQUATION_ADD, in[0],
                   two(&m, EQUATION_MULTIPLY, minus(&m, in[1], in[0]), in[2]));
        break;
    case EQUATION_LOG2:
        *out = two(&m, EQUATION_DIVIDE, call(&m, EQUATION_LOG, in[0], 0),
                   call(&m, EQUATION_LOG, number(&m, 2), 0));
        break;
    case EQUATION_FRACT:
        *out = minus(&m, in[0], call(&m, EQUATION_FLOOR, in[0], 0));
        break;
    case EQUATION_MOD:
        *out = minus(&m, in[0], wholes(&m, in[0], in[1]));
        break;
    case EQUATION_STEP:
        *out = times(&m, 0.5,
                     two(&m, EQUATION_ADD, number(&m, 1),
                         call(&m, EQUATION_SIGN, minus(&m, in[1], in[0]), 0)));
        break;
    case EQUATION_SMOOTHSTEP:
        *out = smooth(&m, in);
        break;
    case EQUATION_CHEB:
        *out = cheb(&m, (int)equation->nodes[in[0]].constant, in[1]);
        break;
    default:
        *out = 0;
    }
    return !m.full;
}
