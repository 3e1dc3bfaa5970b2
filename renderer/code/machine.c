/* SPDX-License-Identifier: MIT */
/* Runs steps. Every loop has a bound, every index is inside: lower.h and check.h saw to that. */
#include "machine.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COMPONENTS_MAX = 16 };

void machine_code_finish(struct machine_code *code)
{
    free(code->steps);
    free(code->origins);
    free(code->constants);
    free(code->constant_bases);
    *code = (struct machine_code){0};
}

size_t machine_frame_size(const struct machine_code *code)
{
    return code->value_count + code->constant_count;
}

void machine_prepare(const struct machine_code *code, double *frame)
{
    if (code->constant_count > 0) {
        memcpy(frame + code->value_count, code->constants, code->constant_count * sizeof(double));
    }
}

/* --- whole numbers, modulo 2^32 --- */

static uint32_t bits_of(double number)
{
    return (uint32_t)(int64_t)number;
}

static double number_of(uint32_t bits, bool is_unsigned)
{
    return is_unsigned ? bits : (double)(int32_t)bits;
}

static uint32_t divide(uint32_t a, uint32_t b, bool is_unsigned)
{
    if (b == 0) {
        return 0;
    }
    return is_unsigned ? a / b : (uint32_t)((int64_t)(int32_t)a / (int32_t)b);
}

static uint32_t shift_right(uint32_t a, uint32_t by, bool is_unsigned)
{
    return is_unsigned ? a >> by : (uint32_t)((int32_t)a >> by);
}

uint32_t machine_whole(enum op op, uint32_t a, uint32_t b, bool is_unsigned)
{
    switch (op) {
    case OP_ADD:
        return a + b;
    case OP_SUBTRACT:
        return a - b;
    case OP_MULTIPLY:
        return a * b;
    case OP_DIVIDE:
        return divide(a, b, is_unsigned);
    case OP_REMAINDER:
        return a - b * divide(a, b, is_unsigned);
    case OP_SHIFT_LEFT:
        return a << (b & 31);
    case OP_SHIFT_RIGHT:
        return shift_right(a, b & 31, is_unsigned);
    case OP_BIT_AND:
        return a & b;
    case OP_BIT_OR:
        return a | b;
    case OP_BIT_XOR:
        return a ^ b;
    default:
        assert(!"an operator of whole numbers");
        return 0;
    }
}

static double operate(enum op op, double x, double y, bool is_unsigned)
{
    return number_of(machine_whole(op, bits_of(x), bits_of(y), is_unsigned), is_unsigned);
}

/* The bounds are those of glsl/code.glsl: floats just inside of what the types hold. */
static double convert(double x, enum base to)
{
    switch (to) {
    case BASE_INT:
        return isnan(x) ? 0 : trunc(fmin(fmax(x, -2147483520.0), 2147483520.0));
    case BASE_UINT:
        return isnan(x) ? 0 : trunc(fmin(fmax(x, 0), 4294967040.0));
    case BASE_BOOL:
        return x != 0;
    default:
        return x;
    }
}

/* --- steps --- */

/* Columns lie one behind the other; vectors are matrices of one column, or of one row. */
static void multiply_matrices(const struct step *s, double *out, const double *a, const double *b)
{
    double product[COMPONENTS_MAX];
    const int rows = s->n, inner = s->c, columns = s->extra;

    for (int column = 0; column < columns; column++) {
        for (int row = 0; row < rows; row++) {
            double sum = 0;
            for (int i = 0; i < inner; i++) {
                sum += a[i * rows + row] * b[column * inner + i];
            }
            product[column * rows + row] = sum;
        }
    }
    memcpy(out, product, (size_t)(rows * columns) * sizeof *out);
}

/* p.yz = p.xy: source and destination may overlap. */
static void move(const struct step *s, double *out, const double *from)
{
    if (s->flags & SPREAD_A) {
        const double number = *from;
        for (int i = 0; i < s->n; i++) {
            out[i] = number;
        }
    } else if (s->n == 1) {
        *out = *from;
    } else {
        memmove(out, from, s->n * sizeof *out);
    }
}

static void scatter(const struct step *s, double *out, const double *from)
{
    double copy[4];

    memcpy(copy, from, s->n * sizeof *out);
    for (int i = 0; i < s->n; i++) {
        out[s->extra >> (2 * i) & 3] = copy[i];
    }
}

static double index_of(double at, int count)
{
    return at <= 0 ? 0 : at >= count ? count - 1 : at;
}

static bool all_equal(const struct step *s, const double *a, const double *b)
{
    for (int i = 0; i < s->n; i++) {
        if (a[i] != b[i]) {
            return false;
        }
    }
    return true;
}

static void note(struct code_fault *fault, const struct origin *origin, const char *what)
{
    if (fault->line == 0) {
        fault->line = origin->at.line;
        fault->column = origin->at.column;
        snprintf(fault->message, sizeof fault->message, "%.40s %s", origin->what, what);
    }
}

static void watch_divisor(const struct step *s, const struct origin *origin, const double *b,
                          struct code_fault *fault)
{
    for (int i = 0; i < (s->flags & SPREAD_B ? 1 : s->n); i++) {
        if (b[i] == 0) {
            note(fault, origin, "divides by 0");
        }
    }
}

static void watch(const struct step *s, const struct origin *origin, double *out,
                  struct code_fault *fault)
{
    for (int i = 0; i < s->parts; i++) {
        if (fabs(out[i]) > (double)FLT_MAX) {
            out[i] = copysign(INFINITY, out[i]);
        }
        if (isnan(out[i])) {
            note(fault, origin, "gives something that is not a number");
        } else if (isinf(out[i])) {
            fault->infinite |= fault->line == 0;
            note(fault, origin, "gives an infinite number");
        }
    }
}

#define EACH(value)                                                                                \
    for (int i = 0; i < s->n; i++) {                                                               \
        out[i] = (value);                                                                          \
    }                                                                                              \
    break
#define A a[i * step_a]
#define B b[i * step_b]
#define C c[i * step_c]

static void call(const struct step *s, double *frame)
{
    const struct builtin *builtin = &builtin_table[s->extra];
    double *out = frame + s->out;
    const double *a = frame + s->a, *b = frame + s->b, *c = frame + s->c;
    const int step_a = !(s->flags & SPREAD_A), step_b = !(s->flags & SPREAD_B),
              step_c = !(s->flags & SPREAD_C);

    switch ((enum step_kind)s->kind) {
    case STEP_ONE:
        EACH(builtin->one(A));
    case STEP_TWO:
        EACH(builtin->two(A, B));
    case STEP_THREE:
        EACH(builtin->three(A, B, C));
    case STEP_TOGETHER:
        builtin->whole(out, (const double *const[]){a, b, c}, s->n);
        break;
    default:
        assert(!"a step that computes");
    }
}

/* What computes; jumps are run by machine_run. */
static void compute(const struct step *s, double *frame)
{
    double *out = frame + s->out;
    const double *a = frame + s->a, *b = frame + s->b;
    const int step_a = !(s->flags & SPREAD_A), step_b = !(s->flags & SPREAD_B);

    switch ((enum step_kind)s->kind) {
    case STEP_MOVE:
        move(s, out, a);
        break;
    case STEP_ZERO:
        EACH(0);
    case STEP_GATHER:
        EACH(a[s->extra >> (2 * i) & 3]);
    case STEP_SCATTER:
        scatter(s, out, a);
        break;
    case STEP_ADD:
        EACH(A + B);
    case STEP_SUBTRACT:
        EACH(A - B);
    case STEP_MULTIPLY:
        EACH(A * B);
    case STEP_DIVIDE:
        EACH(A / builtin_nonzero(B));
    case STEP_NEGATE:
        EACH(-A);
    case STEP_LESS:
        EACH(A < B);
    case STEP_LESS_EQUAL:
        EACH(A <= B);
    case STEP_EQUAL:
        out[0] = all_equal(s, a, b);
        break;
    case STEP_NOT:
        EACH(A == 0);
    case STEP_WHOLE:
        EACH(operate((enum op)s->extra, A, B, s->flags & STEP_UNSIGNED));
    case STEP_CONVERT:
        EACH(convert(A, (enum base)s->extra));
    case STEP_PRODUCT:
        multiply_matrices(s, out, a, b);
        break;
    case STEP_INDEX:
        out[0] = index_of(a[0], s->c) * s->n + (s->b == MACHINE_NOWHERE ? 0 : b[0]);
        break;
    case STEP_LOAD:
        EACH(a[(int)b[0] + i]);
    case STEP_STORE:
        out += (int)b[0];
        EACH(A);
    default:
        call(s, frame);
    }
}

void machine_run(const struct machine_code *code, size_t first, double *frame,
                 struct code_fault *fault)
{
    const struct step *returns[LIMIT_CODE_DEPTH + 1];
    const struct step *s = code->steps + first;
    int calls = 0;

    for (;;) {
        switch ((enum step_kind)s->kind) {
        case STEP_JUMP:
            s = code->steps + s->out;
            break;
        case STEP_UNLESS:
            s = frame[s->a] == 0 ? code->steps + s->out : s + 1;
            break;
        case STEP_LOOP:
            frame[s->a] += 1;
            s = frame[s->a] < frame[s->b] ? code->steps + s->out : s + 1;
            break;
        case STEP_CALL:
            assert(calls < LIMIT_CODE_DEPTH + 1);
            returns[calls++] = s + 1;
            s = code->steps + s->out;
            break;
        case STEP_RETURN:
            if (calls == 0) {
                return;
            }
            s = returns[--calls];
            break;
        default:
            if (fault && s->kind == STEP_DIVIDE) {
                watch_divisor(s, code->origins + (s - code->steps), frame + s->b, fault);
            }
            compute(s, frame);
            if (fault) {
                watch(s, code->origins + (s - code->steps), frame + s->out, fault);
            }
            s++;
        }
    }
}
