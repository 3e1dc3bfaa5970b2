/* SPDX-License-Identifier: MIT */
/* The parts of an equation at a point, as code: (gradient, value). */
#include "equation_writer.h"

/* An operand as (gradient, value). */
static void write_dual(const struct equation_writer *w, uint16_t index)
{
    fprintf(w->out, varies(w, index) ? "g%d" : "vec4(0.0, 0.0, 0.0, s%d)", index);
}

static void write_dual_sum(const struct equation_writer *w, const struct equation_node *node)
{
    const int a = node->args[0], b = node->args[1];
    const char sign = node->op == EQUATION_ADD ? '+' : '-';

    if (!varies(w, b)) {
        fprintf(w->out, "vec4(g%d.xyz, g%d.w %c s%d)", a, a, sign, b);
    } else if (!varies(w, a)) {
        fprintf(w->out, "vec4(%sg%d.xyz, s%d %c g%d.w)", sign == '-' ? "-" : "", b, a, sign, b);
    } else {
        fprintf(w->out, "g%d %c g%d", a, sign, b);
    }
}

static void write_dual_times(const struct equation_writer *w, uint16_t a, uint16_t b)
{
    if (varies(w, a) && varies(w, b)) {
        fprintf(w->out, "jet_dual_times(g%d, g%d)", a, b);
    } else {
        fprintf(w->out, varies(w, a) ? "g%d * s%d" : "s%d * g%d", a, b);
    }
}

static void write_dual_rule(const struct equation_writer *w, const struct equation_rule *rule,
                            uint16_t a)
{
    char argument[16];

    snprintf(argument, sizeof argument, "g%d.w", a);
    fprintf(w->out, "jet_dual_of(g%d, ", a);
    equation_write_rule(w, rule->value, argument);
    fputs(", ", w->out);
    equation_write_rule(w, rule->slope, argument);
    fputs(")", w->out);
}

/* qI is the next lower power; that of a square is its root itself. */
static void write_dual_power_below(const struct equation_writer *w, size_t index)
{
    const struct equation_node *node = node_of(w, (uint16_t)index);
    char to[16], from[16];

    snprintf(to, sizeof to, "q%zu", index);
    snprintf(from, sizeof from, "g%d.w", node->args[0]);
    if (node->op == EQUATION_WHOLE && size_of_power(node) > 2) {
        equation_write_power(w->out, "float", to, from, size_of_power(node) - 1);
    }
}

static void write_dual_whole(const struct equation_writer *w, size_t index)
{
    const struct equation_node *node = node_of(w, (uint16_t)index);
    const int n = size_of_power(node), a = node->args[0];

    if (n == 0) {
        fputs("vec4(0.0, 0.0, 0.0, 1.0)", w->out);
    } else if (n == 1) {
        fprintf(w->out, "g%d", a);
    } else if (n == 2) {
        fprintf(w->out, "jet_dual_of(g%d, g%d.w * g%d.w, 2.0 * g%d.w)", a, a, a, a);
    } else {
        fprintf(w->out, "jet_dual_of(g%d, q%zu * g%d.w, %d.0 * q%zu)", a, index, a, n, index);
    }
}

/* What is divided by, or taken to a negative power: first itself, then 1 / it. */
static void write_dual_below(const struct equation_writer *w, size_t index,
                             const struct equation_node *node)
{
    char argument[16];

    snprintf(argument, sizeof argument, "h%zu.w", index);
    fprintf(w->out, "vec4 h%zu = ", index);
    if (node->op == EQUATION_DIVIDE) {
        fprintf(w->out, "g%d", node->args[1]);
    } else {
        write_dual_whole(w, index);
    }
    fprintf(w->out, ";\nh%zu = jet_dual_of(h%zu, ", index, index);
    equation_write_rule(w, equation_reciprocal.value, argument);
    fputs(", ", w->out);
    equation_write_rule(w, equation_reciprocal.slope, argument);
    fputs(");\n", w->out);
}

static bool divides(const struct equation_writer *w, const struct equation_node *node)
{
    return (node->op == EQUATION_DIVIDE && varies(w, node->args[1])) ||
           (node->op == EQUATION_WHOLE && node->value < 0);
}

static void write_dual_quotient(const struct equation_writer *w, size_t index,
                                const struct equation_node *node)
{
    const uint16_t a = node->args[0], b = node->args[1];
    char argument[16];

    if (node->op == EQUATION_WHOLE) {
        fprintf(w->out, "h%zu", index);
    } else if (!varies(w, b)) {
        snprintf(argument, sizeof argument, "s%d", b);
        fprintf(w->out, "g%d * ", a);
        equation_write_rule(w, equation_reciprocal.value, argument);
    } else if (!varies(w, a)) {
        fprintf(w->out, "s%d * h%zu", a, index);
    } else {
        fprintf(w->out, "jet_dual_times(g%d, h%zu)", a, index);
    }
}

/* x^y = exp(y log x). */
static void write_dual_power(const struct equation_writer *w, const struct equation_node *node)
{
    const uint16_t a = node->args[0], b = node->args[1];
    char base[16], exponent[16];

    snprintf(base, sizeof base, varies(w, a) ? "g%d.w" : "s%d", a);
    snprintf(exponent, sizeof exponent, varies(w, b) ? "g%d.w" : "s%d", b);
    fprintf(w->out, "vec4(");
    if (varies(w, a)) {
        fprintf(w->out, "g%d.xyz * (%s > 1e-18 ? %s * pow(%s, %s - 1.0) : 0.0)", a, base, exponent,
                base, exponent);
    }
    if (varies(w, b)) {
        fprintf(w->out, "%sg%d.xyz * (log(max(%s, 1e-18)) * pow(max(%s, 1e-18), %s))",
                varies(w, a) ? " + " : "", b, base, base, exponent);
    }
    fprintf(w->out, ", pow(max(%s, 1e-18), %s))", base, exponent);
}

static void write_dual_call(const struct equation_writer *w, const struct equation_node *node)
{
    const struct equation_rule *rule = &equation_rules[node->which];

    if (equation_is_wave(node) || equation_is_exp(node)) {
        fprintf(w->out, "jet_dual_%s(g%d)", equation_functions[node->which].name, node->args[0]);
        return;
    }
    if (rule->slope) {
        write_dual_rule(w, rule, node->args[0]);
        return;
    }
    fprintf(w->out, "dual_%s(", equation_functions[node->which].name);
    write_dual(w, node->args[0]);
    fputs(", ", w->out);
    write_dual(w, node->args[1]);
    fputs(")", w->out);
}

void equation_write_gradient(const struct equation_writer *w, size_t index)
{
    static const char *const axes[] = {"1.0, 0.0, 0.0, point.x", "0.0, 1.0, 0.0, point.y",
                                       "0.0, 0.0, 1.0, point.z"};
    const struct equation_node *node = &w->equation->nodes[index];

    write_dual_power_below(w, index);
    if (divides(w, node)) {
        write_dual_below(w, index, node);
    }
    fprintf(w->out, "vec4 g%zu = ", index);
    switch ((enum equation_op)node->op) {
    case EQUATION_AXIS:
        fprintf(w->out, "vec4(%s)", axes[node->which]);
        break;
    case EQUATION_NEGATE:
        fprintf(w->out, "-g%d", node->args[0]);
        break;
    case EQUATION_MULTIPLY:
        write_dual_times(w, node->args[0], node->args[1]);
        break;
    case EQUATION_DIVIDE:
        write_dual_quotient(w, index, node);
        break;
    case EQUATION_WHOLE:
        if (node->value < 0) {
            write_dual_quotient(w, index, node);
        } else {
            write_dual_whole(w, index);
        }
        break;
    case EQUATION_POWER:
        write_dual_power(w, node);
        break;
    case EQUATION_CALL:
        write_dual_call(w, node);
        break;
    default:
        write_dual_sum(w, node);
    }
    fputs(";\n", w->out);
}
