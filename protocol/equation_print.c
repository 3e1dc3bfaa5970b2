/* SPDX-License-Identifier: MIT */
/* Equations as text, with as few parentheses as the grammar allows. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "equation_internal.h"
#include "memory.h"

/* How tightly a node holds together. */
enum level { SUM, PRODUCT, SIGN, POWER, ATOM };

struct printer {
    const struct equation *equation;
    const char *const *letters;
    struct equation_text out;
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

void equation_put(struct equation_text *out, const char *text)
{
    const size_t length = strlen(text);

    if (out->room < out->length + length + 1) {
        out->room = 2 * (out->length + length + 1);
        out->text = memory_resize(out->text, out->room, 1);
    }
    memcpy(out->text + out->length, text, length + 1);
    out->length += length;
}

void equation_number_text(double value, char out[32])
{
    snprintf(out, 32, "%.15g", value);
    if (strtod(out, NULL) != value) {
        snprintf(out, 32, "%.17g", value);
    }
}

static void put(struct printer *p, const char *text)
{
    equation_put(&p->out, text);
}

static void print_node(struct printer *p, uint16_t index, enum level least);

static void print_number(struct printer *p, double value)
{
    char text[32];

    equation_number_text(value, text);
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
    switch ((enum equation_op)node->op) {
    case EQUATION_NUMBER:
        print_number(p, node->value);
        break;
    case EQUATION_CONSTANT:
        put(p, equation_constants[node->which].name);
        break;
    case EQUATION_AXIS:
        put(p, equation_axes[node->which]);
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
    struct printer p = {.equation = equation, .letters = letters};

    print_node(&p, equation->left, SUM);
    put(&p, " ");
    put(&p, equation_relations[equation->relation].text);
    put(&p, " ");
    print_node(&p, equation->right, SUM);
    return p.out.text;
}
