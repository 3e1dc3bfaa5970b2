/* SPDX-License-Identifier: MIT */
/* Expressions, by precedence. */
#include "parser.h"

#include <string.h>

static struct expr *parse_unary(struct parser *parser);

/* Sets the depth from what hangs below; NULL where it is too much. */
static struct expr *deepen(struct parser *parser, struct expr *expr)
{
    const struct expr *below[] = {expr->a, expr->b, expr->c};
    int depth = 0;

    for (size_t i = 0; i < sizeof below / sizeof below[0]; i++) {
        depth = below[i] && below[i]->depth >= depth ? below[i]->depth + 1 : depth;
    }
    for (const struct expr *arg = expr->args; arg; arg = arg->next) {
        depth = arg->depth >= depth ? arg->depth + 1 : depth;
    }
    if (depth >= TREE_DEPTH) {
        tree_fail_limit(parser->tree, expr->at, "operations in a row", TREE_DEPTH,
                        "4 times code_depth; give names to parts of it");
        return NULL;
    }
    expr->depth = (uint8_t)depth;
    return expr;
}

static struct expr *node(struct parser *parser, enum expr_kind kind, struct at at)
{
    return tree_expr(parser->tree, kind, at);
}

static bool parse_arguments(struct parser *parser, struct expr *call, enum token_kind end)
{
    struct expr **last = &call->args;

    if (!parser_enter(parser)) {
        return false;
    }
    while (parser->token->kind != end || call->args) {
        struct expr *arg = parser_value(parser);
        if (!arg) {
            return false;
        }
        *last = arg;
        last = &arg->next;
        call->arg_count++;
        if (!parser_take(parser, TOKEN_COMMA)) {
            break;
        }
        if (end == TOKEN_CLOSE_BRACE && parser->token->kind == end) {
            break; /* {1, 2,} */
        }
    }
    parser_leave(parser);
    return parser_expect(parser, end, end == TOKEN_CLOSE ? "after the arguments" : "at the end");
}

static struct expr *parse_literal(struct parser *parser, struct type type, double number)
{
    struct expr *expr = node(parser, EXPR_LITERAL, parser->token->at);
    double *value = tree_alloc(parser->tree, sizeof *value);

    *value = number;
    expr->value = value;
    expr->type = type;
    parser->token++;
    return expr;
}

static struct expr *parse_name(struct parser *parser)
{
    const struct token *token = parser->token++;
    const bool call = parser_take(parser, TOKEN_OPEN);
    struct expr *expr = node(parser, call ? EXPR_CALL : EXPR_VARIABLE, token->at);

    expr->name = tree_name(parser->tree, token->text, token->length);
    if (call && !parse_arguments(parser, expr, TOKEN_CLOSE)) {
        return NULL;
    }
    return deepen(parser, expr);
}

/* vec3(1), float[2](1, 2), float[](1, 2) */
static struct expr *parse_construct(struct parser *parser)
{
    struct expr *expr = node(parser, EXPR_CONSTRUCT, parser->token->at);

    expr->type = parser->token->type;
    parser->token++;
    if (parser_take(parser, TOKEN_OPEN_BRACKET)) {
        expr->array = true;
        if (parser->token->kind != TOKEN_CLOSE_BRACKET && !(expr->a = parser_value(parser))) {
            return NULL;
        }
        if (!parser_expect(parser, TOKEN_CLOSE_BRACKET, "after the length")) {
            return NULL;
        }
    }
    if (!parser_expect(parser, TOKEN_OPEN, "after the type") ||
        !parse_arguments(parser, expr, TOKEN_CLOSE)) {
        return NULL;
    }
    return deepen(parser, expr);
}

/* (float3)x of HLSL is float3(x). */
static struct expr *parse_cast(struct parser *parser)
{
    struct expr *expr = node(parser, EXPR_CONSTRUCT, parser->token->at);

    expr->type = parser->token[1].type;
    parser->token += 3;
    if (!parser_enter(parser) || !(expr->args = parse_unary(parser))) {
        return NULL;
    }
    parser_leave(parser);
    expr->arg_count = 1;
    return deepen(parser, expr);
}

static struct expr *parse_group(struct parser *parser)
{
    struct expr *expr;

    if (parser->token[1].kind == TOKEN_TYPE && parser->token[2].kind == TOKEN_CLOSE) {
        return parse_cast(parser);
    }
    parser->token++;
    if (!parser_enter(parser) || !(expr = parser_expression(parser))) {
        return NULL;
    }
    parser_leave(parser);
    return parser_expect(parser, TOKEN_CLOSE, "to match the (") ? expr : NULL;
}

/* {1, 2, 3} as an initial value. */
static struct expr *parse_list(struct parser *parser)
{
    struct expr *expr = node(parser, EXPR_CONSTRUCT, parser->token->at);

    expr->list = true;
    parser->token++;
    return parse_arguments(parser, expr, TOKEN_CLOSE_BRACE) ? deepen(parser, expr) : NULL;
}

static struct expr *parse_primary(struct parser *parser)
{
    const struct token *token = parser->token;

    switch (token->kind) {
    case TOKEN_NUMBER:
        return parse_literal(parser, token->type, token->number);
    case TOKEN_TRUE:
    case TOKEN_FALSE:
        return parse_literal(parser, type_vector(BASE_BOOL, 1), token->kind == TOKEN_TRUE);
    case TOKEN_NAME:
        return parse_name(parser);
    case TOKEN_TYPE:
        return parse_construct(parser);
    case TOKEN_OPEN:
        return parse_group(parser);
    case TOKEN_OPEN_BRACE:
        return parse_list(parser);
    default:
        parser_unexpected(parser, "a value");
        return NULL;
    }
}

static struct expr *parse_index(struct parser *parser, struct expr *of, struct at at)
{
    struct expr *expr = node(parser, EXPR_INDEX, at);

    expr->a = of;
    if (!parser_enter(parser) || !(expr->b = parser_expression(parser))) {
        return NULL;
    }
    parser_leave(parser);
    return parser_expect(parser, TOKEN_CLOSE_BRACKET, "to match the [") ? expr : NULL;
}

static struct expr *parse_member(struct parser *parser, struct expr *of)
{
    const struct token *token = parser->token;

    if (token->kind != TOKEN_NAME) {
        parser_unexpected(parser, "the name of a member after the .");
        return NULL;
    }
    parser->token++;
    if (parser->token->kind == TOKEN_OPEN) {
        tree_fail(parser->tree, token->at, "values have no functions of their own: .%.*s()",
                  token->length < 40 ? token->length : 40, token->text);
        return NULL;
    }
    struct expr *expr = node(parser, EXPR_MEMBER, token->at);
    expr->a = of;
    expr->name = tree_name(parser->tree, token->text, token->length);
    return expr;
}

static struct expr *parse_postfix(struct parser *parser)
{
    struct expr *expr = parse_primary(parser);

    while (expr) {
        struct at at = parser->token->at;
        const enum token_kind kind = parser->token->kind;
        if (parser_take(parser, TOKEN_OPEN_BRACKET)) {
            expr = parse_index(parser, expr, at);
        } else if (parser_take(parser, TOKEN_DOT)) {
            expr = parse_member(parser, expr);
        } else if (parser_take(parser, TOKEN_INCREMENT) || parser_take(parser, TOKEN_DECREMENT)) {
            struct expr *step = node(parser, EXPR_STEP, at);
            step->a = expr;
            step->op = kind == TOKEN_INCREMENT ? OP_ADD : OP_SUBTRACT;
            step->postfix = true;
            expr = step;
        } else {
            break;
        }
        expr = expr ? deepen(parser, expr) : NULL;
    }
    return expr;
}

static struct expr *parse_unary(struct parser *parser)
{
    static const struct {
        enum token_kind token;
        enum expr_kind kind;
        enum op op;
    } prefixes[] = {
        {TOKEN_ADD, EXPR_UNARY, OP_PLUS},     {TOKEN_SUBTRACT, EXPR_UNARY, OP_MINUS},
        {TOKEN_NOT, EXPR_UNARY, OP_NOT},      {TOKEN_INVERT, EXPR_UNARY, OP_INVERT},
        {TOKEN_INCREMENT, EXPR_STEP, OP_ADD}, {TOKEN_DECREMENT, EXPR_STEP, OP_SUBTRACT},
    };
    for (size_t i = 0; i < sizeof prefixes / sizeof prefixes[0]; i++) {
        if (parser->token->kind == prefixes[i].token) {
            struct expr *expr = node(parser, prefixes[i].kind, parser->token->at);
            expr->op = prefixes[i].op;
            parser->token++;
            if (!parser_enter(parser) || !(expr->a = parse_unary(parser))) {
                return NULL;
            }
            parser_leave(parser);
            return deepen(parser, expr);
        }
    }
    return parse_postfix(parser);
}

/* 0: not between two values. The larger binds first. */
static int precedence(enum token_kind kind, enum op *out)
{
    static const struct {
        enum token_kind token;
        enum op op;
        int precedence;
    } rows[] = {
        {TOKEN_OR, OP_OR, 1},
        {TOKEN_XOR, OP_XOR, 2},
        {TOKEN_AND, OP_AND, 3},
        {TOKEN_BIT_OR, OP_BIT_OR, 4},
        {TOKEN_BIT_XOR, OP_BIT_XOR, 5},
        {TOKEN_BIT_AND, OP_BIT_AND, 6},
        {TOKEN_EQUAL, OP_EQUAL, 7},
        {TOKEN_UNEQUAL, OP_UNEQUAL, 7},
        {TOKEN_LESS, OP_LESS, 8},
        {TOKEN_GREATER, OP_GREATER, 8},
        {TOKEN_LESS_EQUAL, OP_LESS_EQUAL, 8},
        {TOKEN_GREATER_EQUAL, OP_GREATER_EQUAL, 8},
        {TOKEN_SHIFT_LEFT, OP_SHIFT_LEFT, 9},
        {TOKEN_SHIFT_RIGHT, OP_SHIFT_RIGHT, 9},
        {TOKEN_ADD, OP_ADD, 10},
        {TOKEN_SUBTRACT, OP_SUBTRACT, 10},
        {TOKEN_MULTIPLY, OP_MULTIPLY, 11},
        {TOKEN_DIVIDE, OP_DIVIDE, 11},
        {TOKEN_REMAINDER, OP_REMAINDER, 11},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (rows[i].token == kind) {
            *out = rows[i].op;
            return rows[i].precedence;
        }
    }
    return 0;
}

/* Operators that bind at least so closely. */
static struct expr *parse_binary(struct parser *parser, int least)
{
    struct expr *left = parse_unary(parser);

    while (left) {
        enum op op = OP_NONE;
        const int binds = precedence(parser->token->kind, &op);
        if (binds < least || binds == 0) {
            break;
        }
        struct expr *expr = node(parser, EXPR_BINARY, parser->token->at);
        parser->token++;
        expr->op = op;
        expr->a = left;
        expr->b = parse_binary(parser, binds + 1);
        left = expr->b ? deepen(parser, expr) : NULL;
    }
    return left;
}

static struct expr *parse_choice(struct parser *parser, struct expr *condition, struct at at)
{
    struct expr *expr = node(parser, EXPR_CHOICE, at);

    expr->a = condition;
    if (!parser_enter(parser) || !(expr->b = parser_value(parser)) ||
        !parser_expect(parser, TOKEN_COLON, "between the two values of ?") ||
        !(expr->c = parser_value(parser))) {
        return NULL;
    }
    parser_leave(parser);
    return deepen(parser, expr);
}

static bool assigns(enum token_kind kind, enum op *out)
{
    static const struct {
        enum token_kind token;
        enum op op;
    } rows[] = {
        {TOKEN_SET, OP_NONE},
        {TOKEN_ADD_SET, OP_ADD},
        {TOKEN_SUBTRACT_SET, OP_SUBTRACT},
        {TOKEN_MULTIPLY_SET, OP_MULTIPLY},
        {TOKEN_DIVIDE_SET, OP_DIVIDE},
        {TOKEN_REMAINDER_SET, OP_REMAINDER},
        {TOKEN_SHIFT_LEFT_SET, OP_SHIFT_LEFT},
        {TOKEN_SHIFT_RIGHT_SET, OP_SHIFT_RIGHT},
        {TOKEN_BIT_AND_SET, OP_BIT_AND},
        {TOKEN_BIT_OR_SET, OP_BIT_OR},
        {TOKEN_BIT_XOR_SET, OP_BIT_XOR},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (rows[i].token == kind) {
            *out = rows[i].op;
            return true;
        }
    }
    return false;
}

struct expr *parser_value(struct parser *parser)
{
    struct expr *left = parse_binary(parser, 1);
    struct at at = parser->token->at;
    enum op op = OP_NONE;

    if (left && parser_take(parser, TOKEN_QUESTION)) {
        return parse_choice(parser, left, at);
    }
    if (!left || !assigns(parser->token->kind, &op)) {
        return left;
    }
    parser->token++;
    struct expr *expr = node(parser, EXPR_ASSIGN, at);
    expr->op = op;
    expr->a = left;
    if (!parser_enter(parser) || !(expr->b = parser_value(parser))) {
        return NULL;
    }
    parser_leave(parser);
    return deepen(parser, expr);
}

struct expr *parser_expression(struct parser *parser)
{
    struct expr *left = parser_value(parser);

    while (left && parser->token->kind == TOKEN_COMMA) {
        struct expr *expr = node(parser, EXPR_COMMA, parser->token->at);
        parser->token++;
        expr->a = left;
        expr->b = parser_value(parser);
        left = expr->b ? deepen(parser, expr) : NULL;
    }
    return left;
}
