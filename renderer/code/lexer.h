/* SPDX-License-Identifier: MIT */
/* Users' code as a list of tokens. What the language has not, and people often write, is refused
 * here with the word for what it has instead. */
#ifndef RENDERER_CODE_LEXER_H
#define RENDERER_CODE_LEXER_H

#include "protocol/error.h"
#include "types.h"

/* X(NAME, "text"): marks, none behind one that it starts with. */
#define LEXER_MARKS(X)                                                                             \
    X(SHIFT_LEFT_SET, "<<=")                                                                       \
    X(SHIFT_RIGHT_SET, ">>=")                                                                      \
    X(SHIFT_LEFT, "<<")                                                                            \
    X(SHIFT_RIGHT, ">>")                                                                           \
    X(INCREMENT, "++")                                                                             \
    X(DECREMENT, "--")                                                                             \
    X(ADD_SET, "+=")                                                                               \
    X(SUBTRACT_SET, "-=")                                                                          \
    X(MULTIPLY_SET, "*=")                                                                          \
    X(DIVIDE_SET, "/=")                                                                            \
    X(REMAINDER_SET, "%=")                                                                         \
    X(BIT_AND_SET, "&=")                                                                           \
    X(BIT_OR_SET, "|=")                                                                            \
    X(BIT_XOR_SET, "^=")                                                                           \
    X(AND, "&&")                                                                                   \
    X(OR, "||")                                                                                    \
    X(XOR, "^^")                                                                                   \
    X(LESS_EQUAL, "<=")                                                                            \
    X(GREATER_EQUAL, ">=")                                                                         \
    X(EQUAL, "==")                                                                                 \
    X(UNEQUAL, "!=")                                                                               \
    X(LESS, "<")                                                                                   \
    X(GREATER, ">")                                                                                \
    X(SET, "=")                                                                                    \
    X(ADD, "+")                                                                                    \
    X(SUBTRACT, "-")                                                                               \
    X(MULTIPLY, "*")                                                                               \
    X(DIVIDE, "/")                                                                                 \
    X(REMAINDER, "%")                                                                              \
    X(BIT_AND, "&")                                                                                \
    X(BIT_OR, "|")                                                                                 \
    X(BIT_XOR, "^")                                                                                \
    X(NOT, "!")                                                                                    \
    X(INVERT, "~")                                                                                 \
    X(QUESTION, "?")                                                                               \
    X(COLON, ":")                                                                                  \
    X(COMMA, ",")                                                                                  \
    X(SEMICOLON, ";")                                                                              \
    X(DOT, ".")                                                                                    \
    X(OPEN, "(")                                                                                   \
    X(CLOSE, ")")                                                                                  \
    X(OPEN_BRACKET, "[")                                                                           \
    X(CLOSE_BRACKET, "]")                                                                          \
    X(OPEN_BRACE, "{")                                                                             \
    X(CLOSE_BRACE, "}")

#define LEXER_WORDS(X)                                                                             \
    X(CONST, "const")                                                                              \
    X(STATIC, "static")                                                                            \
    X(INLINE, "inline")                                                                            \
    X(IN, "in")                                                                                    \
    X(OUT, "out")                                                                                  \
    X(INOUT, "inout")                                                                              \
    X(IF, "if")                                                                                    \
    X(ELSE, "else")                                                                                \
    X(FOR, "for")                                                                                  \
    X(RETURN, "return")                                                                            \
    X(BREAK, "break")                                                                              \
    X(CONTINUE, "continue")                                                                        \
    X(TRUE, "true")                                                                                \
    X(FALSE, "false")                                                                              \
    X(PRECISION, "precision")                                                                      \
    X(HIGHP, "highp")                                                                              \
    X(MEDIUMP, "mediump")                                                                          \
    X(LOWP, "lowp")

enum token_kind {
#define X(NAME, text) TOKEN_##NAME,
    LEXER_MARKS(X) LEXER_WORDS(X)
#undef X
        TOKEN_NAME,
    TOKEN_TYPE,
    TOKEN_NUMBER,
    TOKEN_END,
    TOKEN_BAD, /* no token: lexer_read's error says why; nothing follows */
};

struct at {
    int line, column; /* from 1; columns count code points */
};

struct token {
    enum token_kind kind;
    struct at at;
    const char *text; /* in the code */
    int length;
    struct type type; /* TOKEN_TYPE, TOKEN_NUMBER */
    double number;
};

/* All tokens, the last of which is END or BAD. Caller frees. `whole`: no word is refused. */
struct token *lexer_read(const char *text, bool whole, struct error *err);
/* "while", or NULL for kinds without a text of their own. */
const char *lexer_text(enum token_kind kind);

#endif
