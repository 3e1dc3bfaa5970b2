/* SPDX-License-Identifier: MIT */
/* From tokens to a tree: what goes where, not what it means. */
#ifndef RENDERER_CODE_PARSER_H
#define RENDERER_CODE_PARSER_H

#include "tree.h"

struct parser {
    struct tree *tree;
    struct token *token;     /* the current one */
    const struct error *bad; /* why the last token is BAD */
    int depth;
    struct stmt **last_top; /* where the next one of tree->top goes */
    bool samplers_known;    /* of the whole language */
};

/* Reads the whole text into tree->top; false: the tree's error says why. */
bool parser_read(struct tree *tree, const char *text);

/* --- between the files of the parser --- */

/* NULL: failed. With and without the comma operator. */
struct expr *parser_expression(struct parser *parser);
struct expr *parser_value(struct parser *parser);
/* Takes the token if it is of this kind. */
bool parser_take(struct parser *parser, enum token_kind kind);
/* The same, and fails if it is not. */
bool parser_expect(struct parser *parser, enum token_kind kind, const char *where);
/* "expected a value, not ;"; false. */
bool parser_unexpected(struct parser *parser, const char *expected);
/* float a = 1, b[2]; the type is read already, `model` has it. NULL: failed. */
struct stmt *parser_declarators(struct parser *parser, struct variable *model);
struct stmt *parser_statement(struct parser *parser);
/* What the whole language has more of, if it is there: then true, or false and `*ok` is. */
bool parser_whole_top(struct parser *parser, bool *ok);
bool parser_is_word(const struct parser *parser, const char *word);
/* while (...) ...: a STMT_FOR without a start. */
struct stmt *parser_while(struct parser *parser);
/* One level down; false: too deep. */
bool parser_enter(struct parser *parser);
void parser_leave(struct parser *parser);

#endif
