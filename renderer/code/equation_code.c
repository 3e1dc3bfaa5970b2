/* SPDX-License-Identifier: MIT */
/* An equation as code. Of each of its nodes without x, y and z there is a number sI; of each other
 * one (gradient, value) gI at the point, and a jet jI in the box around it. */
#include "equation_code.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "equation_rules.h"

enum { TRIES = 4 }; /* of steps, for one bound */

struct writer {
    const struct equation *equation;
    const char *const *letters;
    bool used[LIMIT_EQUATION_NODES + 1];
    FILE *out;
};

static const struct equation_node *node_of(const struct writer *w, uint16_t index)
{
    return &w->equation->nodes[index];
}

static bool varies(const struct writer *w, uint16_t index)
{
    return node_of(w, index)->varies;
}

/* --- which nodes, functions and powers are used --- */

static void mark_used(struct writer *w)
{
    w->used[w->equation->left] = w->used[w->equation->right] = true;
    for (size_t i = w->equation->count; i-- > 0;) {
        const struct equation_node *node = &w->equation->nodes[i];
        for (int k = 0; w->used[i] && k < equation_arguments(node); k++) {
            w->used[node->args[k]] = true;
        }
    }
}

static bool is_called(const struct writer *w, enum equation_op op, int which)
{
    for (size_t i = 0; i < w->equation->count; i++) {
        const struct equation_node *node = &w->equation->nodes[i];
        if (w->used[i] && node->op == op && (which < 0 || node->which == which)) {
            return true;
        }
    }
    return false;
}

/* Powers are negative where 1 / x is taken of them. */
static int size_of_power(const struct equation_node *node)
{
    return (int)(node->value < 0 ? -node->value : node->value);
}

/* --- functions --- */

static void write_functions(const struct writer *w)
{
    fputs(equation_sizes, w->out);
    for (int i = 0; i < EQUATION_FUNCTIONS; i++) {
        const bool by_power =
            is_called(w, EQUATION_POWER, -1) && (i == EQUATION_EXP || i == EQUATION_LOG);
        if (by_power || is_called(w, EQUATION_CALL, i)) {
            fputs(equation_rules[i].range, w->out);
        }
    }
    fputs(equation_reciprocal.range, w->out);
}

/* --- numbers --- */

/* A rule's text for an argument, such as g3.w. */
static void write_rule(const struct writer *w, const char *text, const char *argument)
{
    for (; *text; text++) {
        if (*text == '$') {
            fputs(argument, w->out);
        } else {
            fputc(*text, w->out);
        }
    }
}

static void write_number(FILE *out, double value)
{
    char text[40];
    snprintf(text, sizeof text, "%.9g", value);
    fprintf(out, "%s%s", text, strpbrk(text, ".e") ? "" : ".0");
}

/* TYPE to = from^n;, by squaring; n > 0, and `from` is one name. */
static void write_power(FILE *out, const char *type, const char *to, const char *from, int n)
{
    fprintf(out, "%s %s = %s", type, to, from);
    int highest = 1;
    while (2 * highest <= n) {
        highest *= 2;
    }
    for (int bit = highest / 2; bit > 0; bit /= 2) {
        fprintf(out, ";\n%s = %s * %s", to, to, to);
        if (n & bit) {
            fprintf(out, " * %s", from);
        }
    }
    fputs(";\n", out);
}

/* Into the number qI, where a power is to be taken. */
static void write_known_power(const struct writer *w, size_t index)
{
    const struct equation_node *node = node_of(w, (uint16_t)index);
    char to[16], from[16];
    snprintf(to, sizeof to, "q%zu", index);
    snprintf(from, sizeof from, "s%d", node->args[0]);
    if (node->op == EQUATION_WHOLE && size_of_power(node) > 0) {
        write_power(w->out, "float", to, from, size_of_power(node));
    }
}

static void write_known_whole(const struct writer *w, size_t index)
{
    const struct equation_node *node = node_of(w, (uint16_t)index);
    char power[16];
    snprintf(power, sizeof power, size_of_power(node) > 0 ? "q%zu" : "1.0", index);
    write_rule(w, node->value < 0 ? equation_reciprocal.value : "$", power);
}

static void write_scalar(const struct writer *w, size_t index)
{
    static const char signs[] = {
        [EQUATION_ADD] = '+', [EQUATION_SUBTRACT] = '-', [EQUATION_MULTIPLY] = '*'};
    const struct equation_node *node = &w->equation->nodes[index];
    const int a = node->args[0], b = node->args[1];
    char argument[16];
    write_known_power(w, index);
    fprintf(w->out, "float s%zu = ", index);
    switch ((enum equation_op)node->op) {
    case EQUATION_NUMBER:
        write_number(w->out, node->value);
        break;
    case EQUATION_CONSTANT:
        write_number(w->out, equation_constants[node->which].value);
        break;
    case EQUATION_LETTER:
        fputs(w->letters[node->which], w->out);
        break;
    case EQUATION_DIVIDE:
        snprintf(argument, sizeof argument, "s%d", b);
        fprintf(w->out, "s%d * ", a);
        write_rule(w, equation_reciprocal.value, argument);
        break;
    case EQUATION_POWER:
        fprintf(w->out, "pow(max(s%d, 1e-18), s%d)", a, b);
        break;
    case EQUATION_NEGATE:
        fprintf(w->out, "-s%d", a);
        break;
    case EQUATION_WHOLE:
        write_known_whole(w, index);
        break;
    case EQUATION_CALL:
        snprintf(argument, sizeof argument, "s%d", a);
        if (equation_rules[node->which].slope) {
            write_rule(w, equation_rules[node->which].value, argument);
        } else {
            fprintf(w->out, "%s(s%d, s%d)", equation_rules[node->which].value, a, b);
        }
        break;
    default:
        fprintf(w->out, "s%d %c s%d", a, signs[node->op], b);
    }
    fputs(";\n", w->out);
}

/* --- gradient and value --- */

/* An operand as (gradient, value). */
static void write_dual(const struct writer *w, uint16_t index)
{
    fprintf(w->out, varies(w, index) ? "g%d" : "vec4(0.0, 0.0, 0.0, s%d)", index);
}

static void write_dual_times(const struct writer *w, uint16_t a, uint16_t b)
{
    if (varies(w, a) && varies(w, b)) {
        fprintf(w->out, "jet_dual_times(g%d, g%d)", a, b);
    } else {
        fprintf(w->out, varies(w, a) ? "g%d * s%d" : "s%d * g%d", a, b);
    }
}

static void write_dual_rule(const struct writer *w, const struct equation_rule *rule, uint16_t a)
{
    char argument[16];
    snprintf(argument, sizeof argument, "g%d.w", a);
    fprintf(w->out, "jet_dual_of(g%d, ", a);
    write_rule(w, rule->value, argument);
    fputs(", ", w->out);
    write_rule(w, rule->slope, argument);
    fputs(")", w->out);
}

/* qI is the next lower power. */
static void write_dual_power_below(const struct writer *w, size_t index)
{
    const struct equation_node *node = node_of(w, (uint16_t)index);
    char to[16], from[16];
    snprintf(to, sizeof to, "q%zu", index);
    snprintf(from, sizeof from, "g%d.w", node->args[0]);
    if (node->op == EQUATION_WHOLE && size_of_power(node) > 1) {
        write_power(w->out, "float", to, from, size_of_power(node) - 1);
    }
}

static void write_dual_whole(const struct writer *w, size_t index)
{
    const struct equation_node *node = node_of(w, (uint16_t)index);
    const int n = size_of_power(node), a = node->args[0];
    if (n == 0) {
        fputs("vec4(0.0, 0.0, 0.0, 1.0)", w->out);
    } else if (n == 1) {
        fprintf(w->out, "g%d", a);
    } else {
        fprintf(w->out, "jet_dual_of(g%d, q%zu * g%d.w, %d.0 * q%zu)", a, index, a, n, index);
    }
}

/* What is divided by, or taken to a negative power: first itself, then 1 / it. */
static void write_dual_below(const struct writer *w, size_t index, const struct equation_node *node)
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
    write_rule(w, equation_reciprocal.value, argument);
    fputs(", ", w->out);
    write_rule(w, equation_reciprocal.slope, argument);
    fputs(");\n", w->out);
}

static bool divides(const struct writer *w, const struct equation_node *node)
{
    return (node->op == EQUATION_DIVIDE && varies(w, node->args[1])) ||
           (node->op == EQUATION_WHOLE && node->value < 0);
}

static void write_dual_quotient(const struct writer *w, size_t index,
                                const struct equation_node *node)
{
    const uint16_t a = node->args[0], b = node->args[1];
    char argument[16];
    if (node->op == EQUATION_WHOLE) {
        fprintf(w->out, "h%zu", index);
    } else if (!varies(w, b)) {
        snprintf(argument, sizeof argument, "s%d", b);
        fprintf(w->out, "g%d * ", a);
        write_rule(w, equation_reciprocal.value, argument);
    } else if (!varies(w, a)) {
        fprintf(w->out, "s%d * h%zu", a, index);
    } else {
        fprintf(w->out, "jet_dual_times(g%d, h%zu)", a, index);
    }
}

/* x^y = exp(y log x). */
static void write_dual_power(const struct writer *w, const struct equation_node *node)
{
    const uint16_t a = node->args[0], b = node->args[1];
    char base[16], exponent[16];
    snprintf(base, sizeof base, varies(w, a) ? "g%d.w" : "s%d", a);
    snprintf(exponent, sizeof exponent, varies(w, b) ? "g%d.w" : "s%d", b);
    fprintf(w->out, "vec4(");
    if (varies(w, a)) {
        fprintf(w->out, "g%d.xyz * (%s * pow(max(%s, 1e-18), %s - 1.0))", a, exponent, base,
                exponent);
    }
    if (varies(w, b)) {
        fprintf(w->out, "%sg%d.xyz * (log(max(%s, 1e-18)) * pow(max(%s, 1e-18), %s))",
                varies(w, a) ? " + " : "", b, base, base, exponent);
    }
    fprintf(w->out, ", pow(max(%s, 1e-18), %s))", base, exponent);
}

static void write_dual_call(const struct writer *w, const struct equation_node *node)
{
    const struct equation_rule *rule = &equation_rules[node->which];
    if (rule->slope) {
        write_dual_rule(w, rule, node->args[0]);
        return;
    }
    for (int i = 0; i < 2; i++) {
        fputs(i == 0 ? "(" : node->which == EQUATION_MIN ? ".w < " : ".w > ", w->out);
        write_dual(w, node->args[i]);
    }
    fputs(".w ? ", w->out);
    write_dual(w, node->args[0]);
    fputs(" : ", w->out);
    write_dual(w, node->args[1]);
    fputs(")", w->out);
}

static void write_gradient(const struct writer *w, size_t index)
{
    static const char *const axes[] = {"1.0, 0.0, 0.0, p.x", "0.0, 1.0, 0.0, p.y",
                                       "0.0, 0.0, 1.0, p.z"};
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
        write_dual(w, node->args[0]);
        fputs(node->op == EQUATION_ADD ? " + " : " - ", w->out);
        write_dual(w, node->args[1]);
    }
    fputs(";\n", w->out);
}

/* --- jets --- */

static void write_jet_sum(const struct writer *w, const struct equation_node *node)
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

static void write_jet_product(const struct writer *w, uint16_t a, uint16_t b)
{
    if (varies(w, a) && varies(w, b)) {
        fprintf(w->out, "jet_times(j%d, j%d)", a, b);
    } else {
        fprintf(w->out, "jet_scaled(j%d, s%d)", varies(w, a) ? a : b, varies(w, a) ? b : a);
    }
}

static void write_jet_quotient(const struct writer *w, const struct equation_node *node)
{
    const uint16_t a = node->args[0], b = node->args[1];
    char argument[16], below[64];
    snprintf(below, sizeof below, "jet_of(j%d, range_reciprocal(j%d[2].xy))", b, b);
    if (!varies(w, b)) {
        snprintf(argument, sizeof argument, "s%d", b);
        fprintf(w->out, "jet_scaled(j%d, ", a);
        write_rule(w, equation_reciprocal.value, argument);
        fputs(")", w->out);
    } else if (varies(w, a)) {
        fprintf(w->out, "jet_times(j%d, %s)", a, below);
    } else {
        fprintf(w->out, "jet_scaled(%s, s%d)", below, a);
    }
}

/* qI is the next lower power of the sizes of both ends, which are eI. */
static void write_jet_power_below(const struct writer *w, size_t index)
{
    const struct equation_node *node = node_of(w, (uint16_t)index);
    char to[16], from[16];
    snprintf(to, sizeof to, "q%zu", index);
    snprintf(from, sizeof from, "e%zu", index);
    if (node->op == EQUATION_WHOLE && size_of_power(node) > 1) {
        fprintf(w->out, "vec2 %s = abs(j%d[2].xy);\n", from, node->args[0]);
        write_power(w->out, "vec2", to, from, size_of_power(node) - 1);
    }
}

static void write_jet_whole(const struct writer *w, size_t index, const struct equation_node *node)
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

static void write_jet_power(const struct writer *w, const struct equation_node *node)
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

static void write_jet_operand(const struct writer *w, uint16_t index)
{
    fprintf(w->out, varies(w, index) ? "j%d" : "mat3(vec3(0.0), vec3(0.0), vec3(s%d, s%d, 0.0))",
            index, index);
}

static void write_jet_call(const struct writer *w, const struct equation_node *node)
{
    const char *name = equation_functions[node->which].name;
    const uint16_t a = node->args[0];
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

static void write_jet(const struct writer *w, size_t index)
{
    const struct equation_node *node = &w->equation->nodes[index];
    if (node->op == EQUATION_AXIS) {
        fprintf(w->out, "j%zu[2].xy = p.%c + sides;\n", index, "xyz"[node->which]);
        return;
    }
    write_jet_power_below(w, index);
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
        write_jet_call(w, node);
        break;
    default:
        write_jet_sum(w, node);
    }
    fputs(";\n", w->out);
}

/* --- the whole --- */

static void write_nodes(const struct writer *w, bool varying,
                        void (*write)(const struct writer *, size_t))
{
    for (size_t i = 0; i < w->equation->count; i++) {
        if (w->used[i] && w->equation->nodes[i].varies == varying) {
            write(w, i);
        }
    }
}

/* The slopes of the axes, which are the same in each box. */
static void write_axis(const struct writer *w, size_t index)
{
    if (w->equation->nodes[index].op == EQUATION_AXIS) {
        fprintf(w->out, "mat3 j%zu = mat3(g%zu.xyz, g%zu.xyz, vec3(0.0));\n", index, index, index);
    }
}

/* Where the slope in a box tells less than that in a smaller one would, the box shrinks. */
static void write_bound(const struct writer *w, uint16_t root, struct equation_form form)
{
    fprintf(w->out,
            "float value = abs(g%d.w), d = 0.0, first = -1.0;\n"
            "float reach = min(value / max(length(g%d.xyz), 1e-18), 0.25 * %s);\n",
            root, root, form.ball ? "radius" : "length(size)");
    write_nodes(w, true, write_axis);
    fprintf(w->out, "for (int i = 0; i < %d; i++) {\nvec2 sides = vec2(-reach, reach);\n", TRIES);
    write_nodes(w, true, write_jet);
    fprintf(w->out,
            "float most = length(max(abs(j%d[0]), abs(j%d[1])));\n"
            "float free = min(value / max(most, 1e-18), reach);\n"
            "d = max(d, most < 1e17 ? free : 0.02 * reach);\n"
            "first = first < 0.0 ? d : first;\n"
            "if (free > 0.4 * reach%s) {\nbreak;\n}\n"
            "reach = sqrt(max(free, 0.001 * reach) * reach);\n"
            "}\n",
            root, root, form.sheet ? " || reach < thickness" : "");
}

/* Near a sheet the first of the bounds is its distance: it is as smooth as the function is. */
static void write_sdf(const struct writer *w, uint16_t root, struct equation_form form)
{
    fputs("float sdf(vec3 p)\n{\n", w->out);
    write_nodes(w, false, write_scalar);
    write_nodes(w, true, write_gradient);
    write_bound(w, root, form);
    if (form.sheet) {
        fputs("d = d > 2.0 * thickness ? d - thickness : first - 0.5 * thickness;\n", w->out);
    } else {
        fprintf(w->out, "d = g%d.w < 0.0 ? -d : d;\n", root);
    }
    fputs(form.ball ? "return max(d, length(p) - radius);\n}\n" : "return d;\n}\n", w->out);
}

/* What is negative inside. */
static uint16_t add_root(struct equation *equation)
{
    const struct equation_node *right = &equation->nodes[equation->right];
    const bool turned =
        equation->relation == EQUATION_GREATER || equation->relation == EQUATION_GREATER_EQUAL;
    const uint16_t first = turned ? equation->right : equation->left;
    const uint16_t second = turned ? equation->left : equation->right;
    if (!turned && right->op == EQUATION_NUMBER && right->value == 0) {
        return equation->left;
    }
    equation->nodes[equation->count] =
        (struct equation_node){.op = EQUATION_SUBTRACT, .args = {first, second}, .varies = true};
    return (uint16_t)equation->count++;
}

char *equation_code(const struct equation *equation, const char *const *letters,
                    struct equation_form form)
{
    struct equation whole = *equation;
    char *text = NULL;
    size_t length = 0;
    const uint16_t root = add_root(&whole);
    struct writer w = {
        .equation = &whole, .letters = letters, .out = open_memstream(&text, &length)};
    mark_used(&w);
    w.used[root] = true;
    write_functions(&w);
    if (is_called(&w, EQUATION_POWER, -1)) {
        fputs("mat3 jet_exp(mat3 a) { return jet_of(a, range_exp(a[2].xy)); }\n", w.out);
    }
    write_sdf(&w, root, form);
    fclose(w.out);
    return text;
}
