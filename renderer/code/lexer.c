/* SPDX-License-Identifier: MIT */
/* From characters to tokens. */
#include "lexer.h"

#include <ctype.h>
#include <errno.h>
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

struct lexer {
    const char *next;
    struct at at;
    struct token *tokens;
    size_t count, capacity;
    struct error *err;
    bool whole;
};

static const char *const texts[] = {
#define X(NAME, text) text,
    LEXER_MARKS(X) LEXER_WORDS(X)
#undef X
};
enum { TEXTS = sizeof texts / sizeof texts[0], MARKS = TOKEN_CONST };

/* Words that the language has not; a star stands for any rest. */
static const struct {
    const char *word, *advice;
} refused[] = {
    {"while", "write for (int i = 0; i < 64; i++) with a constant bound, and break"},
    {"do", "write for (int i = 0; i < 64; i++) with a constant bound, and break"},
    {"switch", "write if and else"},
    {"case", "write if and else"},
    {"default", "write if and else"},
    {"goto", "write if, for, break and return"},
    {"discard", "code cannot leave out a point; return a large distance, or a colour"},
    {"struct", "pass values by themselves; only Primitive3D and FragmentProperties are known"},
    {"class", "write functions"},
    {"interface", "write functions"},
    {"template", "write functions"},
    {"typedef", "write the type itself"},
    {"enum", "write const int"},
    {"namespace", "write functions"},
    {"uniform", "declare parameters with the code; they are variables in it"},
    {"varying", "declare parameters with the code; they are variables in it"},
    {"attribute", "declare parameters with the code; they are variables in it"},
    {"buffer", "declare parameters with the code; they are variables in it"},
    {"shared", "write const, or a variable in the function"},
    {"layout", "declare parameters with the code; they are variables in it"},
    {"cbuffer", "declare parameters with the code; they are variables in it"},
    {"register", "declare parameters with the code; they are variables in it"},
    {"double", "write float"},
    {"dvec*", "write vec2, vec3 or vec4"},
    {"dmat*", "write mat2, mat3 or mat4"},
    {"unsigned", "write uint"},
    {"long", "write int"},
    {"short", "write int"},
    {"char", "write int"},
    {"mat2x*", "only square matrices are: mat2, mat3, mat4"},
    {"mat3x*", "only square matrices are: mat2, mat3, mat4"},
    {"mat4x*", "only square matrices are: mat2, mat3, mat4"},
    {"float2x*", "only square matrices are: float2x2, float3x3, float4x4"},
    {"float3x*", "only square matrices are: float2x2, float3x3, float4x4"},
    {"float4x*", "only square matrices are: float2x2, float3x3, float4x4"},
    {"sampler*", "there are no textures; compute the value"},
    {"isampler*", "there are no textures; compute the value"},
    {"usampler*", "there are no textures; compute the value"},
    {"image2D", "there are no images; compute the value"},
    {"Texture2D", "there are no textures; compute the value"},
    {"SamplerState", "there are no textures; compute the value"},
    {"gl_*", "code sees nothing of the driver; use the parameters of the function"},
};

const char *lexer_text(enum token_kind kind)
{
    return (size_t)kind < TEXTS ? texts[kind] : NULL;
}

static bool is_word(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

static void advance(struct lexer *lexer, size_t count)
{
    for (; count > 0; count--, lexer->next++) {
        if (*lexer->next == '\n') {
            lexer->at.line++;
            lexer->at.column = 1;
        } else if (((unsigned char)*lexer->next & 0xc0) != 0x80) {
            lexer->at.column++;
        }
    }
}

static struct token *add(struct lexer *lexer, enum token_kind kind, size_t length)
{
    if (lexer->count == lexer->capacity) {
        lexer->capacity = lexer->capacity > 0 ? 2 * lexer->capacity : 256;
        lexer->tokens = memory_resize(lexer->tokens, lexer->capacity, sizeof *lexer->tokens);
    }
    struct token *token = &lexer->tokens[lexer->count++];
    *token =
        (struct token){.kind = kind, .at = lexer->at, .text = lexer->next, .length = (int)length};
    advance(lexer, length);
    return token;
}

#define FAIL(lexer, ...)                                                                           \
    error_set_at((lexer)->err, ERROR_COMPILE, "", (lexer)->at.line, (lexer)->at.column, __VA_ARGS__)

static bool skip_comment(struct lexer *lexer)
{
    const char *end = strstr(lexer->next + 2, "*/");

    if (!end) {
        return FAIL(lexer, "the comment that begins here has no end: */ is missing");
    }
    advance(lexer, (size_t)(end + 2 - lexer->next));
    return true;
}

static bool skip_blank(struct lexer *lexer)
{
    for (;;) {
        const char *text = lexer->next;
        if (*text == ' ' || *text == '\t' || *text == '\n' || *text == '\r') {
            advance(lexer, 1);
        } else if (text[0] == '/' && text[1] == '/') {
            advance(lexer, strcspn(text, "\n"));
        } else if (text[0] == '/' && text[1] == '*') {
            if (!skip_comment(lexer)) {
                return false;
            }
        } else {
            return true;
        }
    }
}

static bool matches(const char *pattern, const char *text, size_t length)
{
    const size_t fixed = strcspn(pattern, "*");

    return strncmp(pattern, text, fixed < length ? fixed : length) == 0 &&
           (pattern[fixed] == '*' ? length >= fixed : length == fixed);
}

static bool check_word(struct lexer *lexer, const char *text, size_t length)
{
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        if (matches(refused[i].word, text, length)) {
            return FAIL(lexer, "%.*s is not known here: %s", (int)(length < 40 ? length : 40), text,
                        refused[i].advice);
        }
    }
    for (size_t i = 0; i + 1 < length; i++) {
        if (text[i] == '_' && text[i + 1] == '_') {
            return FAIL(lexer, "a name has no two underscores in a row");
        }
    }
    return true;
}

static bool read_word(struct lexer *lexer)
{
    const char *text = lexer->next;
    size_t length = 0;
    struct type type;

    while (is_word(text[length])) {
        length++;
    }
    for (size_t i = MARKS; i < TEXTS; i++) {
        if (strncmp(texts[i], text, length) == 0 && texts[i][length] == '\0') {
            add(lexer, (enum token_kind)i, length);
            return true;
        }
    }
    if (type_find(text, length, &type)) {
        add(lexer, TOKEN_TYPE, length)->type = type;
        return true;
    }
    if (!lexer->whole && !check_word(lexer, text, length)) {
        return false;
    }
    add(lexer, TOKEN_NAME, length);
    return true;
}

static bool add_number(struct lexer *lexer, size_t length, enum base base, double number)
{
    if (is_word(lexer->next[length]) || lexer->next[length] == '.') {
        size_t whole = length;
        while (is_word(lexer->next[whole]) || lexer->next[whole] == '.') {
            whole++;
        }
        return FAIL(lexer, "%.*s is not a number", (int)(whole < 40 ? whole : 40), lexer->next);
    }
    struct token *token = add(lexer, TOKEN_NUMBER, length);
    token->type = type_vector(base, 1);
    token->number = number;
    return true;
}

/* Decimal, octal after 0, hexadecimal after 0x; u at the end makes it unsigned. */
static bool read_whole(struct lexer *lexer)
{
    const char *text = lexer->next;
    const bool hex = text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
    char *end;

    errno = 0;
    const unsigned long long number = strtoull(text, &end, 0);
    const bool plain = !hex && text[0] != '0';
    const bool is_unsigned = *end == 'u' || *end == 'U';
    const double most = plain && !is_unsigned ? 2147483647.0 : 4294967295.0;
    if (errno == ERANGE || (double)number > most) {
        return FAIL(lexer, "this number is above the maximum %.0f of %s", most,
                    is_unsigned ? "uint" : "int");
    }
    /* Like GLSL: the bits of a hexadecimal or octal number, whatever its sign is then. */
    double value = (double)number;
    if (!is_unsigned && value > 2147483647.0) {
        value -= 4294967296.0;
    }
    return add_number(lexer, (size_t)(end - text) + is_unsigned, is_unsigned ? BASE_UINT : BASE_INT,
                      value);
}

static bool read_number(struct lexer *lexer)
{
    const char *text = lexer->next;
    size_t length = strspn(text, "0123456789");
    bool whole = true;

    if (text[0] == '0' && (text[1] == 'x' || text[1] == 'X')) {
        return read_whole(lexer);
    }
    if (text[length] == '.') {
        whole = false;
        length++;
        length += strspn(text + length, "0123456789");
    }
    if (text[length] == 'e' || text[length] == 'E') {
        const size_t sign = text[length + 1] == '+' || text[length + 1] == '-';
        const size_t digits = strspn(text + length + 1 + sign, "0123456789");
        if (digits > 0) {
            whole = false;
            length += 1 + sign + digits;
        }
    }
    const bool suffix = text[length] != '\0' && strchr("fFhH", text[length]);
    if (whole && !suffix) {
        return read_whole(lexer);
    }
    const double number = strtod(text, NULL);
    if (number > (double)FLT_MAX) {
        return FAIL(lexer, "this number is above the maximum %g of float", (double)FLT_MAX);
    }
    return add_number(lexer, length + suffix, BASE_FLOAT, number);
}

static bool refuse_character(struct lexer *lexer)
{
    const unsigned char c = (unsigned char)*lexer->next;

    if (c == '#') {
        return FAIL(lexer, "there is no preprocessor: for #define write const float NAME = ...;");
    }
    if (c == '"' || c == '\'') {
        return FAIL(lexer, "there are no texts here, only numbers");
    }
    if (c > 0x20 && c < 0x7f) {
        return FAIL(lexer, "the character %c has no meaning here", c);
    }
    return FAIL(lexer, "a character that has no meaning outside of comments");
}

static bool read_mark(struct lexer *lexer)
{
    for (size_t i = 0; i < MARKS; i++) {
        const size_t length = strlen(texts[i]);
        if (strncmp(texts[i], lexer->next, length) == 0) {
            add(lexer, (enum token_kind)i, length);
            return true;
        }
    }
    return refuse_character(lexer);
}

static bool read_token(struct lexer *lexer)
{
    const char *text = lexer->next;

    if (isdigit((unsigned char)*text) || (*text == '.' && isdigit((unsigned char)text[1]))) {
        return read_number(lexer);
    }
    return is_word(*text) ? read_word(lexer) : read_mark(lexer);
}

struct token *lexer_read(const char *text, bool whole, struct error *err)
{
    struct lexer lexer = {.next = text, .at = {1, 1}, .err = err, .whole = whole};
    bool ok = skip_blank(&lexer);

    while (ok && *lexer.next) {
        ok = read_token(&lexer) && skip_blank(&lexer);
    }
    add(&lexer, ok ? TOKEN_END : TOKEN_BAD, 0);
    return lexer.tokens;
}
