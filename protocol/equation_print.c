/* SPDX-License-Identifier: MIT */
/* Equations as text, with as few parentheses as the grammar allows. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "equation.h"
#include "memory.h"

/* How tightly a node holds together. */
enum level { SUM, PRODUCT, SIGN, POWER, ATOM };

struct printer {
    const struct equation *equation;
    const char *const *letters;
    char *text;
    size_t length, room;
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

static void put(struct printer *p, const char *text)
{
    const size_t length = strlen(text);

    if (p->room < p->length + length + 1) {
        p->room = 2 * (p->length + length + 1);
        p->text = memory_resize(p->text, p->room, 1);
    }
    memcpy(p->text + p->length, text, length + 1);
    p->length += length;
}

static void print_node(struct printer *p, uint16_t index, enum level least);

static void print_number(struct printer *p, double value)
{
    char text[32];

    snprintf(text, sizeof text, "%.15g", value);
    if (strtod(text, NULL) != value) {
        snprintf(text, sizeof text, "%.17g", value);
    }
    put(p, text);
}

static void print_two(struct printer *p, const struct equation_node *node, enum level level,
                      const char *sign)
{
    print_node(p, node->args[0], level);
    put(p, sign);
    print_node(p, node->args[1], level + 1);
}

static void print_bare(struct printer *p, const struct equation_node *node)
{
    static const char *const axes[] = {"x", "y", "z"};

    switch ((enum equation_op)node->op) {
    case EQUATION_NUMBER:
        print_number(p, node->value);
        break;
    case EQUATION_CONSTANT:
        put(p, equation_constants[node->which].name);
        break;
    case EQUATION_AXIS:
        put(p, axes[node->which]);
        break;
    case EQUATION_LETTER:
        put(p, p->letters[node->which]);
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
        put(p, "-");
        print_node(p, node->args[0], SIGN);
        break;
    case EQUATION_POWER:
        print_node(p, node->args[0], ATOM);
        put(p, "^");
        print_node(p, node->args[1], SIGN);
        break;
    case EQUATION_WHOLE:
        print_node(p, node->args[0], ATOM);
        put(p, "^");
        print_number(p, node->value);
        break;
    case EQUATION_CALL:
        put(p, equation_functions[node->which].name);
        put(p, "(");
        for (int i = 0; i < equation_arguments(node); i++) {
            put(p, i > 0 ? ", " : "");
            print_node(p, node->args[i], SUM);
        }
        put(p, ")");
        break;
    }
}

static void print_node(struct printer *p, uint16_t index, enum level least)
{
    const struct equation_node *node = &p->equation->nodes[index];
    const bool bare = level_of(node) >= least;

    put(p, bare ? "" : "(");
    print_bare(p, node);
    put(p, bare ? "" : ")");
}

char *equation_print(const struct equation *equation, const char *const *letters)
{
    static const char *const relations[] = {[EQUATION_EQUALS] = " = ",
                                            [EQUATION_LESS] = " < ",
                                            [EQUATION_LESS_EQUAL] = " <= ",
                                            [EQUATION_GREATER] = " > ",
                                            [EQUATION_GREATER_EQUAL] = " >= "};
    struct printer p = {.equation = equation, .letters = letters};

    print_node(&p, equation->left, SUM);
    put(&p, relations[equation->relation]);
    print_node(&p, equation->right, SUM);
    return p.text;
}
