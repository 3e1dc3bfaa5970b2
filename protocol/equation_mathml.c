/* SPDX-License-Identifier: MIT */
#include "equation_mathml.h"

#include <string.h>

#include "mathml.h"

#define TIMES "\u2062" /* invisible */
#define DOT "\u22c5"
#define APPLIES "\u2061" /* a function to what follows; invisible */
#define ELLIPSIS "<mo>\u22ef</mo>"
#define THIN "0.17em"

/* How tightly a node holds together as it is typeset: a fraction is a factor like any product, and
 * a leading minus sign stands alone at the beginning of a sum. */
enum level { SUM, SIGNED, PRODUCT, POWER, ATOM };

struct typesetter {
    const struct equation_mathml *m;
    struct mathml to;
    int letter_count;
    int left;   /* nodes that are still shown */
    bool small; /* within an exponent */
};

enum {
    PARTS = 128,
    SLACK = 64, /* nodes by which a term may go beyond the bound */
};

/* Terms of a sum, or factors of a product. */
struct parts {
    struct part {
        uint16_t node;
        bool minus; /* a term that is subtracted */
        bool told;  /* the minus sign that a factor begins with stands already */
    } list[PARTS];
    int count;
    bool more; /* there are others, which are not in the list */
};

static const struct equation_node *node_at(const struct typesetter *t, uint16_t index)
{
    return &t->m->equation->nodes[index];
}

static const char *name_of(const struct typesetter *t, const struct equation_node *node)
{
    return node->op == EQUATION_AXIS ? equation_axes[node->which]
           : node->which < t->letter_count
               ? t->m->letters[node->which]
               : t->m->definitions->list[node->which - t->letter_count].name;
}

/* --- what a node is --- */

static const struct equation_function *called(const struct equation_node *node)
{
    return node->op == EQUATION_CALL ? &equation_functions[node->which] : NULL;
}

static bool is_by_name(const struct equation_node *node)
{
    return called(node) && called(node)->notation == EQUATION_CALLED;
}

/* sin x, and its powers: what follows would seem to be part of the argument. */
static bool is_function(const struct typesetter *t, const struct equation_node *node)
{
    const bool raised = node->op == EQUATION_WHOLE && node->value >= 2;
    const struct equation_node *base = raised ? node_at(t, node->args[0]) : node;

    return is_by_name(base) && called(base)->arguments == 1;
}

/* A name of several letters, such as "far". */
static bool is_word(const struct typesetter *t, const struct equation_node *node)
{
    return node->op == EQUATION_LETTER && mathml_is_word(name_of(t, node));
}

static bool is_sum(const struct equation_node *node)
{
    return node->op == EQUATION_ADD || node->op == EQUATION_SUBTRACT;
}

/* Whether it begins with a minus sign that may stand before the whole of it. */
static bool is_negative(const struct typesetter *t, const struct equation_node *node)
{
    while (node->op == EQUATION_MULTIPLY || node->op == EQUATION_DIVIDE) {
        node = node_at(t, node->args[0]);
    }
    return node->op == EQUATION_NEGATE;
}

static bool is_large_number(const struct equation_node *node)
{
    char text[32];

    equation_number_text(node->value, text);
    return node->op == EQUATION_NUMBER && strchr(text, 'e');
}

static enum level level_of(const struct typesetter *t, const struct equation_node *node)
{
    if (is_sum(node)) {
        return SUM;
    }
    if (is_negative(t, node)) {
        return SIGNED;
    }
    switch ((enum equation_op)node->op) {
    case EQUATION_NUMBER:
        return is_large_number(node) ? PRODUCT : ATOM;
    case EQUATION_MULTIPLY:
    case EQUATION_DIVIDE:
        return PRODUCT;
    case EQUATION_POWER:
    case EQUATION_WHOLE:
        return POWER;
    case EQUATION_CALL:
        return called(node)->notation == EQUATION_FENCED || called(node)->arguments > 1 ? ATOM
                                                                                        : POWER;
    default:
        return ATOM;
    }
}

/* Whether parentheses around it have to be taller than a line: it has a fraction. */
static bool is_tall(const struct typesetter *t, const struct equation_node *node)
{
    const bool is_power =
        node->op == EQUATION_POWER || (called(node) && called(node)->notation == EQUATION_RAISED);

    if (node->op == EQUATION_DIVIDE) {
        return !t->small;
    }
    for (int i = 0; i < equation_arguments(node) - is_power; i++) {
        if (is_tall(t, node_at(t, node->args[i]))) {
            return true;
        }
    }
    return false;
}

/* What a function is applied to without parentheses: x, 2x, x/2. */
static bool is_simple(const struct typesetter *t, const struct equation_node *node)
{
    if (node->op != EQUATION_MULTIPLY && (node->op != EQUATION_DIVIDE || t->small)) {
        return equation_arguments(node) == 0 && !is_large_number(node);
    }
    return equation_arguments(node_at(t, node->args[0])) == 0 &&
           equation_arguments(node_at(t, node->args[1])) == 0 &&
           is_simple(t, node_at(t, node->args[0])) && is_simple(t, node_at(t, node->args[1]));
}

/* --- sums, products, fractions --- */

static void put_node(struct typesetter *t, uint16_t index, enum level least);
static void put_bare(struct typesetter *t, uint16_t index);
static void put_call(struct typesetter *t, const struct equation_node *node, const char *exponent,
                     bool is_followed);
static bool put_raised_function(struct typesetter *t, const struct equation_node *node,
                                bool is_followed);
static void put_fraction(struct typesetter *t, const struct equation_node *node, bool told);
static void put_signed(struct typesetter *t, uint16_t index);

static void add_part(struct parts *parts, struct part part)
{
    if (parts->count < PARTS) {
        parts->list[parts->count++] = part;
    } else {
        parts->more = true;
    }
}

/* a + (b + c) is a + b + c. */
static void gather_terms(const struct typesetter *t, uint16_t index, struct parts *out)
{
    const struct equation_node *node = node_at(t, index);

    if (!is_sum(node)) {
        add_part(out, (struct part){.node = index});
        return;
    }
    gather_terms(t, node->args[0], out);
    const bool minus = node->op == EQUATION_SUBTRACT;
    uint16_t first = node->args[1];
    while (is_sum(node_at(t, first))) {
        first = node_at(t, first)->args[0];
    }
    if (out->more) {
        return;
    }
    if (minus || is_negative(t, node_at(t, first))) {
        add_part(out, (struct part){.node = node->args[1], .minus = minus});
    } else {
        gather_terms(t, node->args[1], out);
    }
}

static void gather_factors(const struct typesetter *t, struct part part, struct parts *out)
{
    const struct equation_node *node = node_at(t, part.node);

    if (node->op == EQUATION_NEGATE && part.told) {
        gather_factors(t, (struct part){.node = node->args[0]}, out);
    } else if (node->op == EQUATION_MULTIPLY && (part.told || !is_negative(t, node))) {
        gather_factors(t, (struct part){.node = node->args[0], .told = part.told}, out);
        if (!out->more) {
            gather_factors(t, (struct part){.node = node->args[1]}, out);
        }
    } else {
        add_part(out, part);
    }
}

/* The minus sign of the first term needs no parentheses. */
static void put_terms(struct typesetter *t, uint16_t index)
{
    struct parts terms = {.count = 0};

    gather_terms(t, index, &terms);
    for (int i = 0; i < terms.count; i++) {
        const struct part *term = &terms.list[i];
        if (i > 0) {
            mathml_break(&t->to);
            mathml_infix(&t->to, term->minus ? MATHML_MINUS : "+");
        }
        if (i > 0 && t->left <= 0) {
            mathml_put(&t->to, ELLIPSIS);
            return;
        }
        put_node(t, term->node, i > 0 ? PRODUCT : SIGNED);
    }
    if (terms.more) {
        mathml_break(&t->to);
        mathml_infix(&t->to, "+");
        mathml_put(&t->to, ELLIPSIS);
    }
}

static void put_factor(struct typesetter *t, struct part factor, bool is_followed)
{
    const struct equation_node *node = node_at(t, factor.node);

    if (node->op == EQUATION_DIVIDE) {
        put_fraction(t, node, factor.told);
    } else if (is_by_name(node)) {
        put_call(t, node, NULL, is_followed);
    } else if (!put_raised_function(t, node, is_followed)) {
        put_node(t, factor.node, PRODUCT);
    }
}

/* The first sign of a factor decides what stands before it, the last what stands behind it. */
enum look { DIGITS, LETTER, WORD, FUNCTION, FRACTION, PARENTHESES, BARS };

static enum look look_of(const struct typesetter *t, uint16_t factor)
{
    const struct equation_node *node = node_at(t, factor);

    if (node->op == EQUATION_DIVIDE) {
        return FRACTION;
    }
    if (is_function(t, node) || is_by_name(node)) {
        return FUNCTION;
    }
    if (level_of(t, node) < PRODUCT) {
        return PARENTHESES;
    }
    if (node->op == EQUATION_WHOLE || node->op == EQUATION_POWER) {
        const struct equation_node *base = node_at(t, node->args[0]);
        return level_of(t, base) < ATOM ? PARENTHESES : look_of(t, node->args[0]);
    }
    if (called(node) && called(node)->notation == EQUATION_FENCED) {
        return BARS;
    }
    return node->op == EQUATION_NUMBER ? DIGITS : is_word(t, node) ? WORD : LETTER;
}

static void put_times(struct typesetter *t, enum look before, enum look after)
{
    const bool apart = before == FUNCTION || before == WORD || before == FRACTION ||
                       after == FUNCTION || after == WORD || (before == BARS && after == BARS);

    if (after == DIGITS || after == FRACTION) {
        mathml_infix(&t->to, DOT);
    } else {
        mathml_put(&t->to, "<mo form=\"infix\" lspace=\"0\" rspace=\"");
        mathml_put(&t->to, apart ? THIN : "0");
        mathml_put(&t->to, "\">" TIMES "</mo>");
    }
}

static void put_factors(struct typesetter *t, struct part product)
{
    struct parts factors = {.count = 0};

    gather_factors(t, product, &factors);
    for (int i = 0; i < factors.count; i++) {
        const struct part *factor = &factors.list[i];
        const enum look look = look_of(t, factor->node);
        if (i > 0 && look == PARENTHESES) {
            mathml_break(&t->to);
        }
        if (i > 0) {
            put_times(t, look_of(t, factors.list[i - 1].node), look);
        }
        if (i > 0 && t->left <= -SLACK) {
            mathml_put(&t->to, ELLIPSIS);
            return;
        }
        const bool is_last = i + 1 == factors.count;
        put_factor(t, *factor, !is_last && look_of(t, factors.list[i + 1].node) != FUNCTION);
    }
    if (factors.more) {
        put_times(t, LETTER, LETTER);
        mathml_put(&t->to, ELLIPSIS);
    }
}

static void put_fraction(struct typesetter *t, const struct equation_node *node, bool told)
{
    mathml_open(&t->to, "mfrac");
    mathml_open(&t->to, "mrow");
    if (told) {
        put_signed(t, node->args[0]);
    } else {
        put_node(t, node->args[0], SUM);
    }
    mathml_close(&t->to, "mrow");
    mathml_open(&t->to, "mrow");
    put_node(t, node->args[1], SUM);
    mathml_close(&t->to, "mrow");
    mathml_close(&t->to, "mfrac");
}

/* x/2, by a stroke, where a fraction would be too small. */
static bool put_stroke(struct typesetter *t, const struct equation_node *node, bool told)
{
    const struct equation_node *above = node_at(t, node->args[0]);
    const bool fits = t->small && node->op == EQUATION_DIVIDE && above->op != EQUATION_DIVIDE &&
                      (told || level_of(t, above) >= PRODUCT) &&
                      level_of(t, node_at(t, node->args[1])) >= POWER;

    if (fits && told) {
        put_signed(t, node->args[0]);
    } else if (fits) {
        put_node(t, node->args[0], PRODUCT);
    }
    if (fits) {
        mathml_put(&t->to, "<mo form=\"infix\" lspace=\"0\" rspace=\"0\">/</mo>");
        put_node(t, node->args[1], POWER);
    }
    return fits;
}

/* What begins with a minus sign that stands already. */
static void put_signed(struct typesetter *t, uint16_t index)
{
    const struct equation_node *node = node_at(t, index);

    if (node->op == EQUATION_MULTIPLY) {
        put_factors(t, (struct part){.node = index, .told = true});
    } else if (node->op == EQUATION_NEGATE) {
        put_node(t, node->args[0], PRODUCT);
    } else if (!put_stroke(t, node, true)) {
        put_fraction(t, node, true);
    }
}

/* --- powers --- */

static void put_exponent(struct typesetter *t, uint16_t index)
{
    const bool outside = t->small;

    mathml_open(&t->to, "mrow");
    t->small = true;
    put_node(t, index, SUM);
    t->small = outside;
    mathml_close(&t->to, "mrow");
}

static void put_raised_by(struct typesetter *t, const struct equation_node *node)
{
    if (node->op == EQUATION_WHOLE) {
        mathml_whole(&t->to, node->value);
    } else {
        put_exponent(t, node->args[1]);
    }
}

/* As a printer sets them: at the height that the closing sign has, whatever is in between. */
static void put_power_of_parentheses(struct typesetter *t, const struct equation_node *node)
{
    mathml_open(&t->to, "mrow");
    mathml_fence(&t->to, "prefix", "(", false);
    mathml_open(&t->to, "mrow");
    put_bare(t, node->args[0]);
    mathml_close(&t->to, "mrow");
    mathml_open(&t->to, "msup");
    mathml_fence(&t->to, "postfix", ")", false);
    put_raised_by(t, node);
    mathml_close(&t->to, "msup");
    mathml_close(&t->to, "mrow");
}

static void put_power(struct typesetter *t, const struct equation_node *node)
{
    const struct equation_node *base = node_at(t, node->args[0]);

    if (level_of(t, base) < ATOM && !is_tall(t, base)) {
        put_power_of_parentheses(t, node);
        return;
    }
    mathml_open(&t->to, "msup");
    mathml_open(&t->to, "mrow");
    put_node(t, node->args[0], ATOM);
    mathml_close(&t->to, "mrow");
    put_raised_by(t, node);
    mathml_close(&t->to, "msup");
}

/* sin^2 x; false: it is written otherwise. */
static bool put_raised_function(struct typesetter *t, const struct equation_node *node,
                                bool is_followed)
{
    char exponent[32];

    if (node->op != EQUATION_WHOLE || !is_function(t, node)) {
        return false;
    }
    equation_number_text(node->value, exponent);
    put_call(t, node_at(t, node->args[0]), exponent, is_followed);
    return true;
}

/* --- calls --- */

static void put_arguments(struct typesetter *t, const struct equation_node *node, const char *left,
                          const char *right)
{
    bool tall = false;

    for (int i = 0; i < equation_arguments(node); i++) {
        tall = tall || is_tall(t, node_at(t, node->args[i]));
    }
    mathml_open(&t->to, "mrow");
    mathml_fence(&t->to, "prefix", left, tall);
    for (int i = 0; i < equation_arguments(node); i++) {
        mathml_put(&t->to, i > 0 ? "<mo separator=\"true\">,</mo>" : "");
        mathml_open(&t->to, "mrow");
        put_node(t, node->args[i], SUM);
        mathml_close(&t->to, "mrow");
    }
    mathml_fence(&t->to, "postfix", right, tall);
    mathml_close(&t->to, "mrow");
}

static void put_function_name(struct typesetter *t, const struct equation_function *function,
                              const char *exponent)
{
    const char *name = function->sign ? function->sign : function->name;

    if (exponent) {
        mathml_open(&t->to, "msup");
    }
    mathml_element(&t->to, "mi", name);
    if (exponent) {
        mathml_element(&t->to, "mn", exponent);
        mathml_close(&t->to, "msup");
    }
    mathml_put(&t->to, "<mo>" APPLIES "</mo>");
}

static void put_call(struct typesetter *t, const struct equation_node *node, const char *exponent,
                     bool is_followed)
{
    const bool bare =
        equation_arguments(node) == 1 && !is_followed && is_simple(t, node_at(t, node->args[0]));

    put_function_name(t, called(node), exponent);
    if (bare) {
        mathml_thin_space(&t->to);
        put_node(t, node->args[0], PRODUCT);
    } else {
        put_arguments(t, node, "(", ")");
    }
}

static void put_root(struct typesetter *t, const struct equation_node *node)
{
    const char *degree = called(node)->sign;

    mathml_open(&t->to, degree ? "mroot" : "msqrt");
    mathml_open(&t->to, "mrow");
    put_node(t, node->args[0], SUM);
    mathml_close(&t->to, "mrow");
    if (degree) {
        mathml_element(&t->to, "mn", degree);
    }
    mathml_close(&t->to, degree ? "mroot" : "msqrt");
}

static void put_any_call(struct typesetter *t, const struct equation_node *node)
{
    const struct equation_function *function = called(node);

    switch (function->notation) {
    case EQUATION_CALLED:
        put_call(t, node, NULL, false);
        break;
    case EQUATION_ROOT:
        put_root(t, node);
        break;
    case EQUATION_RAISED:
        mathml_open(&t->to, "msup");
        mathml_element(&t->to, "mi", function->sign);
        put_exponent(t, node->args[0]);
        mathml_close(&t->to, "msup");
        break;
    case EQUATION_FENCED:
        put_arguments(t, node, function->sign, function->close);
        break;
    }
}

/* --- nodes --- */

static void put_operation(struct typesetter *t, uint16_t index)
{
    const struct equation_node *node = node_at(t, index);

    switch ((enum equation_op)node->op) {
    case EQUATION_ADD:
    case EQUATION_SUBTRACT:
        put_terms(t, index);
        break;
    case EQUATION_MULTIPLY:
        put_factors(t, (struct part){.node = index});
        break;
    case EQUATION_DIVIDE:
        if (!put_stroke(t, node, false)) {
            put_fraction(t, node, false);
        }
        break;
    case EQUATION_CALL:
        put_any_call(t, node);
        break;
    default:
        if (!put_raised_function(t, node, false)) {
            put_power(t, node);
        }
    }
}

static void put_leaf(struct typesetter *t, const struct equation_node *node)
{
    if (node->op == EQUATION_NUMBER) {
        mathml_number(&t->to, node->value);
    } else if (node->op == EQUATION_CONSTANT) {
        mathml_element(&t->to, "mi", equation_constants[node->which].sign);
    } else {
        mathml_name(&t->to, name_of(t, node));
    }
}

static void put_bare(struct typesetter *t, uint16_t index)
{
    const struct equation_node *node = node_at(t, index);

    t->left--;
    if (equation_arguments(node) == 0) {
        put_leaf(t, node);
    } else if (t->left <= -SLACK) {
        mathml_put(&t->to, ELLIPSIS);
    } else if (!is_sum(node) && is_negative(t, node)) {
        mathml_minus(&t->to);
        put_signed(t, index);
    } else {
        put_operation(t, index);
    }
}

static void put_node(struct typesetter *t, uint16_t index, enum level least)
{
    const struct equation_node *node = node_at(t, index);

    if (level_of(t, node) >= least) {
        put_bare(t, index);
        return;
    }
    const bool tall = is_tall(t, node);
    mathml_open(&t->to, "mrow");
    mathml_fence(&t->to, "prefix", "(", tall);
    mathml_open(&t->to, "mrow");
    put_bare(t, index);
    mathml_close(&t->to, "mrow");
    mathml_fence(&t->to, "postfix", ")", tall);
    mathml_close(&t->to, "mrow");
}

/* --- lines --- */

static void begin(struct typesetter *t, const struct equation_mathml *m)
{
    *t = (struct typesetter){.m = m, .left = LIMIT_TYPESET_NODES};
    while (m->letters[t->letter_count]) {
        t->letter_count++;
    }
    mathml_put(&t->to,
               "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" displaystyle=\"true\"><mrow>");
}

static char *end(struct typesetter *t)
{
    mathml_put(&t->to, "</mrow></math>");
    return t->to.out.text;
}

char *equation_mathml_definition(const struct equation_mathml *m, int which)
{
    struct typesetter t;

    begin(&t, m);
    mathml_name(&t.to, m->definitions->list[which].name);
    mathml_infix(&t.to, "\u2254");
    put_node(&t, m->definitions->list[which].node, SUM);
    return end(&t);
}

char *equation_mathml_expression(const struct equation_mathml *m)
{
    struct typesetter t;

    begin(&t, m);
    put_node(&t, m->equation->left, SUM);
    return end(&t);
}

char *equation_mathml(const struct equation_mathml *m)
{
    const struct equation *equation = m->equation;
    struct typesetter t;

    begin(&t, m);
    put_node(&t, equation->left, SUM);
    mathml_break(&t.to);
    mathml_infix(&t.to, equation_relations[equation->relation].typeset);
    put_node(&t, equation->right, SUM);
    return end(&t);
}
