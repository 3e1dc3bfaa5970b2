/* SPDX-License-Identifier: MIT */
/* The parts of an equation in a box, as code: jets (jets.h). */
#include "equation_writer.h"

static void write_jet_sum(const struct equation_writer *w, const struct equation_node *node)
{
    const uint16_t a = node->args[0], b = node->args[1];
    const bool minus = node->op == EQUATION_SUBTRACT;

    if (!varies(w, b)) {
        fprintf(w->out, "jet_moved(j%d, %ss%d)", a, minus ? "-" : "", b);
    } else if (!varies(w, a)) {
        fprintf(w->out, minus ? "jet_moved(jet_scaled(j%d, -1.0), s%d)" : "jet_moved(j%d, s%d)", b,
                a);
    } else {
        fprintf(w->out, minus ? "jet_minus(j%d, j%d)" : "j%d + j%d", a, b);
    }
}

static void write_jet_product(const struct equation_writer *w, uint16_t a, uint16_t b)
{
    if (varies(w, a) && varies(w, b)) {
        fprintf(w->out, "jet_times(j%d, j%d)", a, b);
    } else {
        fprintf(w->out, "jet_scaled(j%d, s%d)", varies(w, a) ? a : b, varies(w, a) ? b : a);
    }
}

static void write_jet_quotient(const struct equation_writer *w, const struct equation_node *node)
{
    const uint16_t a = node->args[0], b = node->args[1];
    char argument[16], below[64];

    snprintf(below, sizeof below, "jet_of(j%d, range_reciprocal(j%d[2].xy))", b, b);
    if (!varies(w, b)) {
        snprintf(argument, sizeof argument, "s%d", b);
        fprintf(w->out, "jet_scaled(j%d, ", a);
        equation_write_rule(w, equation_reciprocal.value, argument);
        fputs(")", w->out);
    } else if (varies(w, a)) {
        fprintf(w->out, "jet_times(j%d, %s)", a, below);
    } else {
        fprintf(w->out, "jet_scaled(%s, s%d)", below, a);
    }
}

/* qI is the next lower power of the sizes of both ends, which are eI. */
static void write_jet_power_below(const struct equation_writer *w, size_t index)
{
    const struct equation_node *node = node_of(w, (uint16_t)index);
    char to[16], from[16];

    snprintf(to, sizeof to, "q%zu", index);
    snprintf(from, sizeof from, "e%zu", index);
    if (node->op != EQUATION_WHOLE || size_of_power(node) < 2) {
        return;
    }
    if (size_of_power(node) == 2) {
        fprintf(w->out, "vec2 q%zu = abs(j%d[2].xy);\n", index, node->args[0]);
    } else {
        fprintf(w->out, "vec2 %s = abs(j%d[2].xy);\n", from, node->args[0]);
        equation_write_power(w->out, "vec2", to, from, size_of_power(node) - 1);
    }
}

static void write_jet_whole(const struct equation_writer *w, size_t index,
                            const struct equation_node *node)
{
    const int n = size_of_power(node), a = node->args[0];

    if (n == 0) {
        fprintf(w->out, "jet_moved(jet_scaled(j%d, 0.0), 1.0)", a);
    } else if (n == 1) {
        fprintf(w->out, "j%d", a);
    } else {
        fprintf(w->out, "jet_%s(j%d, q%zu, %d.0)", n % 2 ? "odd" : "even", a, index, n);
    }
    if (node->value < 0) {
        fprintf(w->out, ";\nj%zu = jet_of(j%zu, range_reciprocal(j%zu[2].xy))", index, index,
                index);
    }
}

static void write_jet_power(const struct equation_writer *w, const struct equation_node *node)
{
    const uint16_t a = node->args[0], b = node->args[1];
    char logarithm[64], product[160];

    if (varies(w, a)) {
        snprintf(logarithm, sizeof logarithm, "jet_of(j%d, range_log(j%d[2].xy))", a, a);
    } else {
        snprintf(logarithm, sizeof logarithm, "log(max(s%d, 1e-18))", a);
    }
    if (varies(w, a) && varies(w, b)) {
        snprintf(product, sizeof product, "jet_times(%s, j%d)", logarithm, b);
    } else if (varies(w, a)) {
        snprintf(product, sizeof product, "jet_scaled(%s, s%d)", logarithm, b);
    } else {
        snprintf(product, sizeof product, "jet_scaled(j%d, %s)", b, logarithm);
    }
    fprintf(w->out, "jet_exp(%s)", product);
}

static void write_jet_operand(const struct equation_writer *w, uint16_t index)
{
    fprintf(w->out, varies(w, index) ? "j%d" : "mat3(vec3(0.0), vec3(0.0), vec3(s%d, s%d, 0.0))",
            index, index);
}

/* The first sine or cosine of the same argument. */
static size_t find_turn(const struct equation_writer *w, size_t index)
{
    const uint16_t a = node_of(w, index)->args[0];
    size_t first = 0;

    while (!(equation_is_wave(node_of(w, first)) && node_of(w, first)->args[0] == a)) {
        first++;
    }
    return first;
}

/* Sines and cosines of one argument are ranges rI, which the first of them makes. */
static void write_turn(const struct equation_writer *w, size_t index)
{
    const struct equation_node *node = node_of(w, index);

    if (equation_is_wave(node) && find_turn(w, index) == index) {
        fprintf(w->out, "vec4 r%zu = jet_turn(j%d[2].xy);\n", index, node->args[0]);
    }
}

static void write_jet_call(const struct equation_writer *w, size_t index)
{
    const struct equation_node *node = node_of(w, index);
    const char *name = equation_functions[node->which].name;
    const uint16_t a = node->args[0];

    if (equation_is_exp(node)) {
        fprintf(w->out, "jet_exp(j%d)", a);
        return;
    }
    if (equation_is_wave(node)) {
        fprintf(w->out, "jet_%s(j%d, r%zu)", node->which == EQUATION_SIN ? "of" : "cos", a,
                find_turn(w, index));
        return;
    }
    if (equation_rules[node->which].slope) {
        fprintf(w->out, "jet_of(j%d, range_%s(j%d[2].xy))", a, name, a);
        return;
    }
    fprintf(w->out, "jet_%s(", name);
    write_jet_operand(w, a);
    fputs(", ", w->out);
    write_jet_operand(w, node->args[1]);
    fputs(")", w->out);
}

void equation_write_jet(const struct equation_writer *w, size_t index)
{
    const struct equation_node *node = &w->equation->nodes[index];

    if (node->op == EQUATION_AXIS) {
        fprintf(w->out, "j%zu[2].xy = p.%c + sides;\n", index, "xyz"[node->which]);
        return;
    }
    write_jet_power_below(w, index);
    write_turn(w, index);
    fprintf(w->out, "mat3 j%zu = ", index);
    switch ((enum equation_op)node->op) {
    case EQUATION_NEGATE:
        fprintf(w->out, "jet_scaled(j%d, -1.0)", node->args[0]);
        break;
    case EQUATION_MULTIPLY:
        write_jet_product(w, node->args[0], node->args[1]);
        break;
    case EQUATION_DIVIDE:
        write_jet_quotient(w, node);
        break;
    case EQUATION_WHOLE:
        write_jet_whole(w, index, node);
        break;
    case EQUATION_POWER:
        write_jet_power(w, node);
        break;
    case EQUATION_CALL:
        write_jet_call(w, index);
        break;
    default:
        write_jet_sum(w, node);
    }
    fputs(";\n", w->out);
}
