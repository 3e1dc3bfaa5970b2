/* SPDX-License-Identifier: MIT */
/* Functions, declarations and statements. */
#include "parser.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/suggest.h"

bool parser_enter(struct parser *parser)
{
    if (++parser->depth > LIMIT_CODE_DEPTH && !parser->tree->whole) {
        return tree_fail_limit(parser->tree, parser->token->at, "nesting", LIMIT_CODE_DEPTH,
                               "code_depth");
    }
    return true;
}

void parser_leave(struct parser *parser)
{
    parser->depth--;
}

static bool is_bad(struct parser *parser)
{
    if (parser->token->kind == TOKEN_BAD && parser->tree->err) {
        *parser->tree->err = *parser->bad;
    }
    return parser->token->kind == TOKEN_BAD;
}

bool parser_unexpected(struct parser *parser, const char *expected)
{
    const struct token *token = parser->token;

    if (is_bad(parser)) {
        return false;
    }
    if (token->kind == TOKEN_END) {
        return tree_fail(parser->tree, token->at, "the text ends; expected %s", expected);
    }
    return tree_fail(parser->tree, token->at, "expected %s, not %.*s", expected,
                     token->length < 40 ? token->length : 40, token->text);
}

bool parser_take(struct parser *parser, enum token_kind kind)
{
    const bool same = parser->token->kind == kind;

    parser->token += same;
    return same;
}

bool parser_expect(struct parser *parser, enum token_kind kind, const char *where)
{
    char expected[80];

    if (parser_take(parser, kind)) {
        return true;
    }
    snprintf(expected, sizeof expected, "%s %s", lexer_text(kind), where);
    return parser_unexpected(parser, expected);
}

static struct stmt *statement(struct parser *parser, enum stmt_kind kind)
{
    struct stmt *stmt = tree_alloc(parser->tree, sizeof *stmt);

    stmt->kind = kind;
    stmt->at = parser->token->at;
    return stmt;
}

/* --- declarations --- */

struct qualifiers {
    bool is_const, is_static;
};

static struct qualifiers take_qualifiers(struct parser *parser)
{
    struct qualifiers seen = {false, false};

    for (;; parser->token++) {
        switch (parser->token->kind) {
        case TOKEN_CONST:
            seen.is_const = true;
            break;
        case TOKEN_STATIC:
            seen.is_static = true;
            break;
        case TOKEN_INLINE:
        case TOKEN_HIGHP:
        case TOKEN_MEDIUMP:
        case TOKEN_LOWP:
            break;
        default:
            return seen;
        }
    }
}

/* A name where none can be: a type or a word of the language was meant. */
static bool unknown_word(struct parser *parser, const struct token *token)
{
    char text[41], hint[80];

    snprintf(text, sizeof text, "%.*s", token->length < 40 ? token->length : 40, token->text);
    struct suggestion suggestion = {.text = text};
    for (size_t i = 0; type_name_at(i); i++) {
        suggest_consider(&suggestion, type_name_at(i));
    }
    for (int kind = TOKEN_CONST; lexer_text((enum token_kind)kind); kind++) {
        suggest_consider(&suggestion, lexer_text((enum token_kind)kind));
    }
    return tree_fail(parser->tree, token->at, "there is no type %s%s", text,
                     suggest_hint(&suggestion, hint, sizeof hint));
}

static bool expect_type(struct parser *parser, struct type *out)
{
    if (parser->token->kind == TOKEN_NAME) {
        return unknown_word(parser, parser->token);
    }
    if (parser->token->kind != TOKEN_TYPE) {
        return parser_unexpected(parser, "a type");
    }
    *out = parser->token->type;
    parser->token++;
    return true;
}

/* [3] or [], after the type or after the name. */
static bool parse_length(struct parser *parser, struct variable *variable)
{
    struct at at = parser->token->at;

    if (!parser_take(parser, TOKEN_OPEN_BRACKET)) {
        return true;
    }
    if (variable->length || variable->unsized) {
        return tree_fail(parser->tree, at, "an array has one index; compute it from two");
    }
    variable->unsized = parser->token->kind == TOKEN_CLOSE_BRACKET;
    if (!variable->unsized && !(variable->length = parser_value(parser))) {
        return false;
    }
    return parser_expect(parser, TOKEN_CLOSE_BRACKET, "after the length") &&
           parse_length(parser, variable);
}

/* The name and what follows it; `model` has the type and what stood behind that. */
static struct stmt *parse_declarator(struct parser *parser, const struct variable *model)
{
    struct stmt *stmt = statement(parser, STMT_DECLARE);
    const struct token *token = parser->token;

    if (token->kind != TOKEN_NAME) {
        parser_unexpected(parser, "a name for the variable");
        return NULL;
    }
    parser->token++;
    struct name *name = tree_name(parser->tree, token->text, token->length);
    struct variable *variable = tree_variable(parser->tree, name, model->type, token->at);
    variable->length = model->length;
    variable->unsized = model->unsized;
    variable->read_only = model->read_only;
    stmt->variable = variable;
    if (!parse_length(parser, variable) ||
        (parser_take(parser, TOKEN_SET) && !(stmt->expr = parser_value(parser)))) {
        return NULL;
    }
    return stmt;
}

/* float a = 1, b[2]; the type is read already. */
struct stmt *parser_declarators(struct parser *parser, struct variable *model)
{
    struct stmt *block = statement(parser, STMT_DECLARE), **last = &block->body;

    do {
        struct stmt *one = parse_declarator(parser, model);
        if (!one) {
            return NULL;
        }
        *last = one;
        last = &one->next;
    } while (parser_take(parser, TOKEN_COMMA));
    return parser_expect(parser, TOKEN_SEMICOLON, "after the declaration") ? block : NULL;
}

static struct stmt *parse_declaration(struct parser *parser)
{
    struct qualifiers seen = take_qualifiers(parser);
    struct variable model = {.read_only = seen.is_const};

    if (!expect_type(parser, &model.type) || !parse_length(parser, &model)) {
        return NULL;
    }
    if (parser->token->kind == TOKEN_NAME && parser->token[1].kind == TOKEN_OPEN) {
        tree_fail(parser->tree, parser->token->at, "a function cannot be inside another one");
        return NULL;
    }
    return parser_declarators(parser, &model);
}

/* --- statements --- */

static bool starts_declaration(const struct parser *parser)
{
    switch (parser->token->kind) {
    case TOKEN_CONST:
    case TOKEN_STATIC:
    case TOKEN_HIGHP:
    case TOKEN_MEDIUMP:
    case TOKEN_LOWP:
        return true;
    case TOKEN_TYPE:
        return parser->token[1].kind != TOKEN_OPEN;
    case TOKEN_NAME: /* of a type that is not known */
        return parser->token[1].kind == TOKEN_NAME;
    default:
        return false;
    }
}

static struct stmt *parse_block(struct parser *parser)
{
    struct stmt *block = statement(parser, STMT_BLOCK), **last = &block->body;

    if (!parser_expect(parser, TOKEN_OPEN_BRACE, "before the statements") ||
        !parser_enter(parser)) {
        return NULL;
    }
    while (!parser_take(parser, TOKEN_CLOSE_BRACE)) {
        if (parser->token->kind == TOKEN_END) {
            parser_unexpected(parser, "} to match the {");
            return NULL;
        }
        struct stmt *stmt = parser_statement(parser);
        if (!stmt) {
            return NULL;
        }
        *last = stmt;
        last = &stmt->next;
    }
    parser_leave(parser);
    return block;
}

static struct stmt *parse_if(struct parser *parser)
{
    struct stmt *stmt = statement(parser, STMT_IF);

    parser->token++;
    if (!parser_enter(parser) || !parser_expect(parser, TOKEN_OPEN, "after if") ||
        !(stmt->expr = parser_expression(parser)) ||
        !parser_expect(parser, TOKEN_CLOSE, "after the condition") ||
        !(stmt->body = parser_statement(parser))) {
        return NULL;
    }
    if (parser_take(parser, TOKEN_ELSE) && !(stmt->other = parser_statement(parser))) {
        return NULL;
    }
    parser_leave(parser);
    return stmt;
}

static struct stmt *parse_value_statement(struct parser *parser, enum token_kind end,
                                          const char *where)
{
    struct stmt *stmt = statement(parser, STMT_EXPR);
    const struct token *first = parser->token;

    if (first->kind == TOKEN_NAME && first[1].kind == TOKEN_NUMBER) { /* retrun 1.0; */
        unknown_word(parser, first);
        return NULL;
    }
    stmt->expr = parser_expression(parser);
    return stmt->expr && parser_expect(parser, end, where) ? stmt : NULL;
}

static struct stmt *parse_for_start(struct parser *parser)
{
    if (starts_declaration(parser)) {
        return parse_declaration(parser);
    }
    if (parser->token->kind == TOKEN_SEMICOLON) {
        struct stmt *stmt = statement(parser, STMT_EMPTY);
        parser->token++;
        return stmt;
    }
    return parse_value_statement(parser, TOKEN_SEMICOLON, "after the start of the loop");
}

static struct stmt *parse_for(struct parser *parser)
{
    struct stmt *stmt = statement(parser, STMT_FOR);

    parser->token++;
    if (!parser_enter(parser) || !parser_expect(parser, TOKEN_OPEN, "after for") ||
        !(stmt->other = parse_for_start(parser))) {
        return NULL;
    }
    if (parser->token->kind != TOKEN_SEMICOLON && !(stmt->expr = parser_expression(parser))) {
        return NULL;
    }
    if (!parser_expect(parser, TOKEN_SEMICOLON, "after the condition of the loop")) {
        return NULL;
    }
    if (parser->token->kind != TOKEN_CLOSE && !(stmt->advance = parser_expression(parser))) {
        return NULL;
    }
    if (!parser_expect(parser, TOKEN_CLOSE, "after the step of the loop") ||
        !(stmt->body = parser_statement(parser))) {
        return NULL;
    }
    parser_leave(parser);
    return stmt;
}

static struct stmt *parse_jump(struct parser *parser, enum stmt_kind kind, const char *where)
{
    struct stmt *stmt = statement(parser, kind);

    parser->token++;
    if (kind == STMT_RETURN && parser->token->kind != TOKEN_SEMICOLON &&
        !(stmt->expr = parser_expression(parser))) {
        return NULL;
    }
    return parser_expect(parser, TOKEN_SEMICOLON, where) ? stmt : NULL;
}

/* [unroll] and [unroll(8)] of HLSL, which change nothing. */
static bool skip_attribute(struct parser *parser)
{
    if (!parser_take(parser, TOKEN_OPEN_BRACKET)) {
        return true;
    }
    bool ok = parser_take(parser, TOKEN_NAME);
    if (ok && parser_take(parser, TOKEN_OPEN)) {
        ok = parser_take(parser, TOKEN_NUMBER) && parser_take(parser, TOKEN_CLOSE);
    }
    return ok ? parser_expect(parser, TOKEN_CLOSE_BRACKET, "after the attribute")
              : parser_unexpected(parser, "an attribute such as [unroll]");
}

struct stmt *parser_statement(struct parser *parser)
{
    if (!skip_attribute(parser)) {
        return NULL;
    }
    switch (parser->token->kind) {
    case TOKEN_OPEN_BRACE:
        return parse_block(parser);
    case TOKEN_SEMICOLON: {
        struct stmt *stmt = statement(parser, STMT_EMPTY);
        parser->token++;
        return stmt;
    }
    case TOKEN_IF:
        return parse_if(parser);
    case TOKEN_FOR:
        return parse_for(parser);
    case TOKEN_RETURN:
        return parse_jump(parser, STMT_RETURN, "after return");
    case TOKEN_BREAK:
        return parse_jump(parser, STMT_BREAK, "after break");
    case TOKEN_CONTINUE:
        return parse_jump(parser, STMT_CONTINUE, "after continue");
    default:
        if (parser_is_word(parser, "while")) {
            return parser_while(parser);
        }
        return starts_declaration(parser)
                   ? parse_declaration(parser)
                   : parse_value_statement(parser, TOKEN_SEMICOLON, "after the statement");
    }
}

/* --- functions --- */

static struct variable *parse_parameter(struct parser *parser)
{
    struct variable model = {.direction = DIRECTION_IN};
    bool ends = false;

    while (!ends) {
        model.read_only |= take_qualifiers(parser).is_const;
        if (parser_take(parser, TOKEN_OUT)) {
            model.direction = DIRECTION_OUT;
        } else if (parser_take(parser, TOKEN_INOUT)) {
            model.direction = DIRECTION_INOUT;
        } else {
            ends = !parser_take(parser, TOKEN_IN);
        }
    }
    const struct token *token = parser->token;
    if (!expect_type(parser, &model.type) || !parse_length(parser, &model)) {
        return NULL;
    }
    struct name *name = NULL;
    if (parser->token->kind == TOKEN_NAME) {
        token = parser->token++;
        name = tree_name(parser->tree, token->text, token->length);
    }
    struct variable *variable = tree_variable(parser->tree, name, model.type, token->at);
    variable->storage = STORAGE_PARAMETER;
    variable->direction = model.direction;
    variable->read_only = model.read_only;
    variable->length = model.length;
    variable->unsized = model.unsized;
    return parse_length(parser, variable) ? variable : NULL;
}

static bool parse_parameters(struct parser *parser, struct function *function)
{
    struct variable **last = &function->parameters;
    const struct token *token = parser->token;

    if (token->kind == TOKEN_TYPE && token->type.base == BASE_VOID &&
        token[1].kind == TOKEN_CLOSE) {
        parser->token++;
    }
    while (parser->token->kind != TOKEN_CLOSE || function->parameters) {
        struct variable *parameter = parse_parameter(parser);
        if (!parameter) {
            return false;
        }
        *last = parameter;
        last = &parameter->next;
        function->parameter_count++;
        if (!parser_take(parser, TOKEN_COMMA)) {
            break;
        }
    }
    return parser_expect(parser, TOKEN_CLOSE, "after the parameters");
}

static struct stmt *parse_function(struct parser *parser, struct type result)
{
    struct stmt *stmt = statement(parser, STMT_FUNCTION);
    struct function *function = tree_alloc(parser->tree, sizeof *function);
    const struct token *token = parser->token;

    function->name = tree_name(parser->tree, token->text, token->length);
    function->at = token->at;
    function->result = result;
    stmt->function = function;
    parser->token += 2; /* the name and ( */
    if (!parse_parameters(parser, function)) {
        return NULL;
    }
    if (parser_take(parser, TOKEN_SEMICOLON)) {
        return stmt;
    }
    if (parser->token->kind != TOKEN_OPEN_BRACE) {
        parser_unexpected(parser, "{ before the body of the function");
        return NULL;
    }
    function->body = parse_block(parser);
    return function->body ? stmt : NULL;
}

/* A function, or constants. */
static struct stmt *parse_top(struct parser *parser)
{
    struct qualifiers seen = take_qualifiers(parser);
    struct variable model = {.read_only = seen.is_const};

    if (!expect_type(parser, &model.type) || !parse_length(parser, &model)) {
        return NULL;
    }
    if (parser->token->kind == TOKEN_NAME && parser->token[1].kind == TOKEN_OPEN) {
        if (model.length || model.unsized) {
            tree_fail(parser->tree, parser->token->at,
                      "a function cannot return an array; give it an out parameter");
            return NULL;
        }
        return parse_function(parser, model.type);
    }
    return parser_declarators(parser, &model);
}

/* precision highp float; */
static bool parse_precision(struct parser *parser)
{
    struct type type;

    parser->token++;
    take_qualifiers(parser);
    return expect_type(parser, &type) &&
           parser_expect(parser, TOKEN_SEMICOLON, "after the precision");
}

bool parser_read(struct tree *tree, const char *text)
{
    struct error bad = {0};
    struct token *tokens = lexer_read(text, tree->whole, &bad);
    struct parser parser = {.tree = tree, .token = tokens, .bad = &bad};
    bool ok = true;

    parser.last_top = &tree->top;
    while (ok && parser.token->kind != TOKEN_END) {
        if (parser_take(&parser, TOKEN_SEMICOLON)) {
            continue;
        }
        if (parser.token->kind == TOKEN_PRECISION) {
            ok = parse_precision(&parser);
            continue;
        }
        if (tree->whole && parser_whole_top(&parser, &ok)) {
            continue;
        }
        struct stmt *stmt = parse_top(&parser);
        ok = stmt != NULL;
        if (ok) {
            *parser.last_top = stmt;
            parser.last_top = &stmt->next;
        }
    }
    free(tokens);
    return ok;
}
