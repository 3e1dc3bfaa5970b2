/* SPDX-License-Identifier: MIT */
/* Equations as text, with as few parentheses as the grammar allows. */
#include <stdio.h>
#include <stdlib.h>

#include "equation.h"

/* How tightly a node holds together. */
enum level { SUM, PRODUCT, SIGN, POWER, ATOM };

struct printer {
    const struct equation *equation;
    const char *const *letters;
    FILE *out;
};

static enum level level_of(const struct equation_node *node)
{
    switch ((enum equation_op)node->op) {
    case EQUATION_ADD:
    case EQUATION_SUBTRACT:
        return SUM;
    case EQUATION_MULTIPLY:
    case EQUATION_DIVIDE:
        return PRODUCT;
    case EQUATION_NEGATE:
        return SIGN;
    case EQUATION_POWER:
    case EQUATION_WHOLE:
        return POWER;
    default:
        return ATOM;
    }
}

static void print_node(const struct printer *p, uint16_t index, enum level least);

static void print_number(FILE *out, double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.15g", value);
    if (strtod(text, NULL) != value) {
        snprintf(text, sizeof text, "%.17g", value);
    }
    fputs(text, out);
}

static void print_two(const struct printer *p, const struct equation_node *node, enum level level,
                      const char *sign)
{
    print_node(p, node->args[0], level);
    fputs(sign, p->out);
    print_node(p, node->args[1], level + 1);
}

static void print_bare(const struct printer *p, const struct equation_node *node)
{
    static const char *const axes[] = {"x", "y", "z"};
    switch ((enum equation_op)node->op) {
    case EQUATION_NUMBER:
        print_number(p->out, node->value);
        break;
    case EQUATION_CONSTANT:
        fputs(equation_constants[node->which].name, p->out);
        break;
    case EQUATION_AXIS:
        fputs(axes[node->which], p->out);
        break;
    case EQUATION_LETTER:
        fputs(p->letters[node->which], p->out);
        break;
    case EQUATION_ADD:
        print_two(p, node, SUM, " + ");
        break;
    case EQUATION_SUBTRACT:
        print_two(p, node, SUM, " - ");
        break;
    case EQUATION_MULTIPLY:
        print_two(p, node, PRODUCT, "*");
        break;
    case EQUATION_DIVIDE:
        print_two(p, node, PRODUCT, "/");
        break;
    case EQUATION_NEGATE:
        fputs("-", p->out);
        print_node(p, node->args[0], SIGN);
        break;
    case EQUATION_POWER:
        print_node(p, node->args[0], ATOM);
        fputs("^", p->out);
        print_node(p, node->args[1], SIGN);
        break;
    case EQUATION_WHOLE:
        print_node(p, node->args[0], ATOM);
        fputs("^", p->out);
        print_number(p->out, node->value);
        break;
    case EQUATION_CALL:
        fprintf(p->out, "%s(", equation_functions[node->which].name);
        for (int i = 0; i < equation_arguments(node); i++) {
            fputs(i > 0 ? ", " : "", p->out);
            print_node(p, node->args[i], SUM);
        }
        fputs(")", p->out);
        break;
    }
}

static void print_node(const struct printer *p, uint16_t index, enum level least)
{
    const struct equation_node *node = &p->equation->nodes[index];
    const bool bare = level_of(node) >= least;
    fputs(bare ? "" : "(", p->out);
    print_bare(p, node);
    fputs(bare ? "" : ")", p->out);
}

char *equation_print(const struct equation *equation, const char *const *letters)
{
    static const char *const relations[] = {[EQUATION_EQUALS] = " = ",
                                            [EQUATION_LESS] = " < ",
                                            [EQUATION_LESS_EQUAL] = " <= ",
                                            [EQUATION_GREATER] = " > ",
                                            [EQUATION_GREATER_EQUAL] = " >= "};
    char *text = NULL;
    size_t length = 0;
    struct printer p = {equation, letters, open_memstream(&text, &length)};
    print_node(&p, equation->left, SUM);
    fputs(relations[equation->relation], p.out);
    print_node(&p, equation->right, SUM);
    fclose(p.out);
    return text;
}
