/* SPDX-License-Identifier: MIT */
/* The parts of an equation without x, y and z, as code: numbers. */
#include "equation_writer.h"

#include <string.h>

/* A rule's text for an argument, such as g3.w. */
void equation_write_rule(const struct equation_writer *w, const char *text, const char *argument)
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
void equation_write_power(FILE *out, const char *type, const char *to, const char *from, int n)
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
static void write_known_power(const struct equation_writer *w, size_t index)
{
    const struct equation_node *node = node_of(w, (uint16_t)index);
    char to[16], from[16];

    snprintf(to, sizeof to, "q%zu", index);
    snprintf(from, sizeof from, "s%d", node->args[0]);
    if (node->op == EQUATION_WHOLE && size_of_power(node) > 0) {
        equation_write_power(w->out, "float", to, from, size_of_power(node));
    }
}

static void write_known_whole(const struct equation_writer *w, size_t index)
{
    const struct equation_node *node = node_of(w, (uint16_t)index);
    char power[16];

    snprintf(power, sizeof power, size_of_power(node) > 0 ? "q%zu" : "1.0", index);
    equation_write_rule(w, node->value < 0 ? equation_reciprocal.value : "$", power);
}

void equation_write_scalar(const struct equation_writer *w, size_t index)
{
    static const char signs[] = {
        [EQUATION_ADD] = '+', [EQUATION_SUBTRACT] = '-', [EQUATION_MULTIPLY] = '*'};
    const struct equation_node *node = &w->equation->nodes[index];
    const int a = node->args[0], b = node->args[1];
    char argument[16];

    const int place = w->places[index];

    if (place > 0) {
        fprintf(w->out, "float s%zu = v%d.%c;\n", index, place / 4, "xyzw"[place % 4]);
        return;
    }
    write_known_power(w, index);
    fprintf(w->out, "%sfloat s%zu = ", node->op == EQUATION_NUMBER ? "const " : "", index);
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
        equation_write_rule(w, equation_reciprocal.value, argument);
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
            equation_write_rule(w, equation_rules[node->which].value, argument);
        } else {
            fprintf(w->out, "%s(s%d, s%d)", equation_rules[node->which].value, a, b);
        }
        break;
    default:
        fprintf(w->out, "s%d %c s%d", a, signs[node->op], b);
    }
    fputs(";\n", w->out);
}
