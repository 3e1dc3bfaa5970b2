/* SPDX-License-Identifier: MIT */
/* What GLSL has more of than users' code: structs, blocks, textures, while. */
#include <string.h>

#include "parser.h"

bool parser_is_word(const struct parser *parser, const char *word)
{
    const struct token *token = parser->token;

    return token->kind == TOKEN_NAME && (size_t)token->length == strlen(word) &&
           memcmp(token->text, word, (size_t)token->length) == 0;
}

static bool same_text(const struct token *a, const struct token *b)
{
    return a->length == b->length && memcmp(a->text, b->text, (size_t)a->length) == 0;
}

/* From here on the word is a type, but for members of its name. */
static void make_type(const struct token *word, struct token *from, struct type type)
{
    for (struct token *token = from; token->kind != TOKEN_END && token->kind != TOKEN_BAD;
         token++) {
        if ((token->kind == TOKEN_NAME || token->kind == TOKEN_TYPE) && same_text(token, word) &&
            token[-1].kind != TOKEN_DOT) {
            token->kind = TOKEN_TYPE;
            token->type = type;
        }
    }
}

/* { float a, b; vec3 c; } */
static struct variable *parse_members(struct parser *parser)
{
    struct variable *members = NULL, **last = &members;

    if (!parser_expect(parser, TOKEN_OPEN_BRACE, "before the members")) {
        return NULL;
    }
    while (!parser_take(parser, TOKEN_CLOSE_BRACE)) {
        struct variable model = {.type = parser->token->type};
        if (!parser_expect(parser, TOKEN_TYPE, "of a member")) {
            return NULL;
        }
        const struct stmt *group = parser_declarators(parser, &model);
        for (const struct stmt *one = group ? group->body : NULL; one; one = one->next) {
            *last = one->variable;
            last = &one->variable->next;
        }
        if (!group) {
            return NULL;
        }
    }
    return members;
}

static struct type add_struct(struct tree *tree, const struct token *name, struct variable *members)
{
    struct tree_struct *one = &tree->structs[tree->struct_count];

    one->name = tree_name(tree, name->text, name->length);
    one->members = members;
    return (struct type){BASE_STRUCT, (uint8_t)tree->struct_count++, 1, 0};
}

static bool parse_struct(struct parser *parser)
{
    const struct token *name = ++parser->token;

    parser->token++;
    struct variable *members = parse_members(parser);
    if (!members || parser->tree->struct_count == TREE_STRUCTS) {
        return false;
    }
    make_type(name, parser->token, add_struct(parser->tree, name, members));
    return parser_expect(parser, TOKEN_SEMICOLON, "after the struct");
}

/* layout(binding = 3): 3, or 0. */
static int parse_layout(struct parser *parser)
{
    int binding = 0;

    while (!parser_take(parser, TOKEN_CLOSE)) {
        if (parser_is_word(parser, "binding")) {
            binding = (int)parser->token[2].number;
        }
        parser->token++;
    }
    return binding;
}

/* uniform sampler2D a;   uniform Frame {...} frame; */
static bool parse_uniform(struct parser *parser, int binding)
{
    const struct token *word = ++parser->token;
    struct type type = word->type;

    parser->token++;
    if (word->kind == TOKEN_NAME) {
        struct variable *members = parse_members(parser);
        if (!members) {
            return false;
        }
        type = add_struct(parser->tree, word, members);
    }
    struct stmt *stmt = tree_alloc(parser->tree, sizeof *stmt);
    const struct token *name = parser->token++;
    stmt->kind = STMT_DECLARE;
    stmt->variable = tree_variable(parser->tree, tree_name(parser->tree, name->text, name->length),
                                   type, name->at);
    stmt->variable->storage = STORAGE_UNIFORM;
    stmt->variable->number = binding;
    *parser->last_top = stmt;
    parser->last_top = &stmt->next;
    return parser_expect(parser, TOKEN_SEMICOLON, "after the declaration");
}

bool parser_whole_top(struct parser *parser, bool *ok)
{
    static const char sampler[] = "sampler2D";
    static const struct token word = {.text = sampler, .length = sizeof sampler - 1};
    int binding = 0;

    if (!parser->samplers_known) {
        parser->samplers_known = true;
        make_type(&word, parser->token + 1, (struct type){BASE_SAMPLER, 1, 1, 0});
    }
    if (parser_is_word(parser, "struct")) {
        *ok = parse_struct(parser);
        return true;
    }
    if (parser_is_word(parser, "layout")) {
        parser->token += 2;
        binding = parse_layout(parser);
    }
    if (parser_is_word(parser, "uniform")) {
        *ok = parse_uniform(parser, binding);
        return true;
    }
    return false;
}

struct stmt *parser_while(struct parser *parser)
{
    struct stmt *stmt = tree_alloc(parser->tree, sizeof *stmt);

    stmt->kind = STMT_FOR;
    stmt->at = parser->token->at;
    stmt->other = tree_alloc(parser->tree, sizeof *stmt->other);
    parser->token++;
    return parser_expect(parser, TOKEN_OPEN, "after while") &&
                   (stmt->expr = parser_expression(parser)) &&
                   parser_expect(parser, TOKEN_CLOSE, "after the condition") &&
                   (stmt->body = parser_statement(parser))
               ? stmt
               : NULL;
}
