/* SPDX-License-Identifier: MIT */
/* A recursive descent through the text, one character at a time, counting lines and columns. */
#include "text.h"

#include <math.h>
#include <search.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/limits.h"
#include "protocol/memory.h"
#include "protocol/utf8.h"

enum { NOTES_MAX = 100 }; /* nobody reads more */

struct reader {
    const char *path;
    const char *text;
    size_t length, at;
    int line, column;
    int depth;
    size_t values;
    cJSON *notes;
    struct error *err;
};

static bool fail(struct reader *reader, int line, int column, const char *message)
{
    return error_set_at(reader->err, ERROR_SYNTAX, reader->path, line, column, "%s", message);
}

static void note(struct reader *reader, int line, int column, const char *what)
{
    char text[512];

    if (cJSON_GetArraySize(reader->notes) >= NOTES_MAX) {
        return;
    }
    snprintf(text, sizeof text, "%s:%d:%d: %s", reader->path, line, column, what);
    cJSON_AddItemToArray(reader->notes, cJSON_CreateString(text));
}

static int peek(const struct reader *reader)
{
    return reader->at < reader->length ? (unsigned char)reader->text[reader->at] : -1;
}

static int take(struct reader *reader)
{
    const int c = peek(reader);

    reader->at++;
    if (c == '\n') {
        reader->line++;
        reader->column = 1;
    } else if ((c & 0xc0) != 0x80) {
        reader->column++;
    }
    return c;
}

static void skip_space(struct reader *reader)
{
    for (int c = peek(reader); c == ' ' || c == '\t' || c == '\n' || c == '\r'; c = peek(reader)) {
        take(reader);
    }
}

static bool fail_expected(struct reader *reader, const char *what)
{
    char message[128], shown[8];
    const int c = peek(reader);

    if (c < 0) {
        snprintf(message, sizeof message, "the file ends here, expected %s", what);
    } else if (c < ' ') {
        snprintf(message, sizeof message, "expected %s, not a control character", what);
    } else {
        const char *at = reader->text + reader->at;
        snprintf(shown, sizeof shown, "%.*s", (int)utf8_sequence(at, reader->length - reader->at),
                 at);
        snprintf(message, sizeof message, "expected %s, not '%s'", what, shown);
    }
    return fail(reader, reader->line, reader->column, message);
}

static struct import_value *value_create(const struct reader *reader)
{
    struct import_value *value = memory_alloc(1, sizeof *value);

    value->line = reader->line;
    value->column = reader->column;
    return value;
}

static void leave(void *member)
{
    (void)member;
}

void import_value_destroy(struct import_value *value)
{
    while (value) {
        struct import_value *next = value->next;

        tdestroy(value->names, leave);
        import_value_destroy(value->first);
        free(value->text);
        free(value->name);
        free(value);
        value = next;
    }
}

const struct import_value *import_member(const struct import_value *object, const char *name)
{
    const struct import_value *member = object->kind == IMPORT_OBJECT ? object->first : NULL;

    while (member && strcmp(member->name, name) != 0) {
        member = member->next;
    }
    return member;
}

/* --- texts --- */

/* Four hexadecimal digits; -1 where they are not. */
static int32_t take_hex(struct reader *reader)
{
    int32_t code = 0;

    for (int i = 0; i < 4; i++) {
        const int c = peek(reader);
        const int digit = c >= '0' && c <= '9'   ? c - '0'
                          : c >= 'a' && c <= 'f' ? c - 'a' + 10
                          : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                                 : -1;
        if (digit < 0) {
            return -1;
        }
        code = code * 16 + digit;
        take(reader);
    }
    return code;
}

/* Behind \u; the bytes go to `out`. 0: not a character. */
static size_t take_unicode(struct reader *reader, char *out)
{
    int32_t code = take_hex(reader);

    if (code >= 0xd800 && code < 0xdc00 && take(reader) == '\\' && take(reader) == 'u') {
        const int32_t low = take_hex(reader);
        code =
            low >= 0xdc00 && low < 0xe000 ? 0x10000 + ((code - 0xd800) << 10) + low - 0xdc00 : -1;
    }
    return code <= 0 || (code >= 0xd800 && code < 0xe000) ? 0 : utf8_put(out, (unsigned long)code);
}

/* Behind the backslash; the bytes go to `out`. 0: no escape of JSON. */
static size_t take_escape(struct reader *reader, char *out)
{
    static const char names[] = "\"\\/bfnrt", meanings[] = "\"\\/\b\f\n\r\t";
    const int c = take(reader);
    const char *at = c > 0 ? strchr(names, c) : NULL;

    if (c == 'u') {
        return take_unicode(reader, out);
    }
    *out = at ? meanings[at - names] : '\0';
    return at ? 1 : 0;
}

/* Behind the first quote. Line breaks become \n, whatever they are in the file. */
static bool read_text(struct reader *reader, struct import_value *value)
{
    size_t used = 0, room = 64;

    value->kind = IMPORT_TEXT;
    value->text = memory_alloc(room, 1);
    for (;;) {
        const int line = reader->line, column = reader->column;
        const int c = take(reader);
        size_t bytes = 1;

        if (room < used + 8) {
            room *= 2;
            value->text = memory_resize(value->text, room, 1);
        }
        if (c < 0) {
            return fail(reader, value->line, value->column,
                        "the text that begins here does not end: its second \" is missing");
        }
        if (c == '"') {
            value->text[used] = '\0';
            return true;
        }
        if (c == '\\') {
            bytes = take_escape(reader, value->text + used);
        } else if (c == '\r') {
            bytes = peek(reader) != '\n';
            value->text[used] = '\n';
        } else {
            value->text[used] = (char)c;
            bytes = c >= ' ' || c == '\n' || c == '\t';
        }
        if (bytes == 0 && c != '\r') {
            return fail(reader, line, column,
                        c == '\\' ? "no escape of JSON" : "a control character in a text");
        }
        used += bytes;
        if (used > LIMIT_JSON_STRING_BYTES) {
            return fail(reader, value->line, value->column, "this text is too long");
        }
    }
}

/* --- numbers and words --- */

static size_t take_digits(struct reader *reader)
{
    size_t count = 0;

    while (peek(reader) >= '0' && peek(reader) <= '9') {
        take(reader);
        count++;
    }
    return count;
}

static bool read_number(struct reader *reader, struct import_value *value)
{
    const size_t start = reader->at;
    char copy[LIMIT_JSON_NUMBER_BYTES + 1];
    bool ok = true;

    value->kind = IMPORT_NUMBER;
    if (peek(reader) == '-') {
        take(reader);
    }
    const bool zero = peek(reader) == '0';
    const size_t digits = take_digits(reader);
    ok = digits > 0 && !(zero && digits > 1);
    if (peek(reader) == '.') {
        take(reader);
        ok = take_digits(reader) > 0 && ok;
    }
    if (peek(reader) == 'e' || peek(reader) == 'E') {
        take(reader);
        if (peek(reader) == '+' || peek(reader) == '-') {
            take(reader);
        }
        ok = take_digits(reader) > 0 && ok;
    }
    if (!ok || reader->at - start > LIMIT_JSON_NUMBER_BYTES) {
        return fail(reader, value->line, value->column,
                    ok ? "this number is too long" : "expected a number as 1, -0.5 or 2e3");
    }
    memcpy(copy, reader->text + start, reader->at - start);
    copy[reader->at - start] = '\0';
    value->number = strtod(copy, NULL);
    return isfinite(value->number) ||
           fail(reader, value->line, value->column, "this number is too large");
}

static bool read_word(struct reader *reader, struct import_value *value)
{
    static const struct {
        const char *word;
        enum import_kind kind;
        double number;
    } words[] = {{"true", IMPORT_BOOL, 1}, {"false", IMPORT_BOOL, 0}, {"null", IMPORT_NULL, 0}};

    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        const size_t length = strlen(words[i].word);

        if (reader->length - reader->at >= length &&
            memcmp(reader->text + reader->at, words[i].word, length) == 0) {
            value->kind = words[i].kind;
            value->number = words[i].number;
            reader->at += length;
            reader->column += (int)length;
            return true;
        }
    }
    return fail_expected(reader, "a value");
}

/* --- lists and objects --- */

static struct import_value *read_value(struct reader *reader);

static int compare_members(const void *a, const void *b)
{
    const struct import_value *one = a, *other = b;

    return strcmp(one->name, other->name);
}

static bool add_member(struct reader *reader, struct import_value *object,
                       struct import_value *member)
{
    if (*(struct import_value **)tsearch(member, &object->names, compare_members) != member) {
        const int line = member->line, column = member->column;

        import_value_destroy(member);
        return fail(reader, line, column, "a member of this name stands in the object already");
    }
    *(object->last ? &object->last->next : &object->first) = member;
    object->last = member;
    object->count++;
    return object->count <= LIMIT_JSON_KEYS ||
           fail(reader, member->line, member->column, "the object has too many members");
}

/* Of a member whose name was read as `name`; takes it. */
static bool read_rest_of_member(struct reader *reader, struct import_value *object,
                                struct import_value *name)
{
    struct import_value *value = NULL;

    skip_space(reader);
    if (peek(reader) != ':') {
        fail_expected(reader, "':' after the name of a member");
    } else {
        take(reader);
        value = read_value(reader);
    }
    if (value) {
        value->name = name->text;
        name->text = NULL;
    }
    import_value_destroy(name);
    return value && add_member(reader, object, value);
}

static bool read_member(struct reader *reader, struct import_value *object)
{
    if (peek(reader) != '"') {
        return fail_expected(reader, "the name of a member in quotes");
    }
    struct import_value *name = read_value(reader);
    return name && read_rest_of_member(reader, object, name);
}

/* What may stand between two members or elements: a comma, or nothing before `start`. */
static bool take_comma(struct reader *reader, const char *start, const char *wanted)
{
    const int c = peek(reader);

    if (c == ',') {
        take(reader);
        skip_space(reader);
        return true;
    }
    if (c > 0 && strchr(start, c)) {
        note(reader, reader->line, reader->column, "read as if there were a ',' before this");
        return true;
    }
    return fail_expected(reader, wanted);
}

/* The members behind '{', or behind a member, up to and with '}'. */
static bool read_members(struct reader *reader, struct import_value *object, bool after_one)
{
    skip_space(reader);
    while (peek(reader) != '}') {
        if (after_one && !take_comma(reader, "\"", "',' or '}'")) {
            return false;
        }
        if (!read_member(reader, object)) {
            return false;
        }
        after_one = true;
        skip_space(reader);
    }
    take(reader);
    return true;
}

/* "name": in a list: `*last` holds the name, and the object before it goes on. */
static bool continue_object(struct reader *reader, struct import_value *list,
                            struct import_value *object, struct import_value **last)
{
    struct import_value *name = *last;

    *last = NULL;
    list->count--;
    if (!object || object->kind != IMPORT_OBJECT) {
        import_value_destroy(name);
        return fail_expected(reader, "',' or ']'");
    }
    note(reader, name->line, name->column,
         "read as a member of the object before it, whose '}' comes too early");
    return read_rest_of_member(reader, object, name) && read_members(reader, object, true);
}

static bool read_elements(struct reader *reader, struct import_value *list)
{
    struct import_value **last = &list->first, **before = NULL;

    skip_space(reader);
    while (peek(reader) != ']') {
        if (*last && !take_comma(reader, "\"{[-0123456789tfn", "',' or ']'")) {
            return false;
        }
        if (*last) {
            before = last;
            last = &(*last)->next;
        }
        *last = read_value(reader);
        if (!*last) {
            return false;
        }
        list->count++;
        skip_space(reader);
        if (peek(reader) == ':' && (*last)->kind == IMPORT_TEXT) {
            if (!continue_object(reader, list, before ? *before : NULL, last)) {
                return false;
            }
            skip_space(reader);
            last = before;
        }
    }
    take(reader);
    return true;
}

static bool read_nested(struct reader *reader, struct import_value *value)
{
    bool ok;

    if (++reader->depth > LIMIT_JSON_DEPTH) {
        return fail(reader, value->line, value->column, "nested too deeply");
    }
    if (take(reader) == '{') {
        value->kind = IMPORT_OBJECT;
        ok = read_members(reader, value, false);
    } else {
        value->kind = IMPORT_LIST;
        ok = read_elements(reader, value);
    }
    reader->depth--;
    return ok;
}

static struct import_value *read_value(struct reader *reader)
{
    struct import_value *value;
    bool ok;

    skip_space(reader);
    value = value_create(reader);
    const int c = peek(reader);
    if (++reader->values > LIMIT_JSON_VALUES) {
        ok = fail(reader, value->line, value->column, "too many values");
    } else if (c == '"') {
        take(reader);
        ok = read_text(reader, value);
    } else if (c == '{' || c == '[') {
        ok = read_nested(reader, value);
    } else if (c == '-' || (c >= '0' && c <= '9')) {
        ok = read_number(reader, value);
    } else {
        ok = read_word(reader, value);
    }
    if (!ok) {
        import_value_destroy(value);
        return NULL;
    }
    return value;
}

static bool check_utf8(struct reader *reader)
{
    while (reader->at < reader->length) {
        const size_t bytes = utf8_sequence(reader->text + reader->at, reader->length - reader->at);
        if (bytes == 0) {
            return fail(reader, reader->line, reader->column, "not UTF-8");
        }
        for (size_t i = 0; i < bytes; i++) {
            take(reader);
        }
    }
    reader->at = 0;
    reader->line = reader->column = 1;
    return true;
}

struct import_value *import_text_read(const char *path, const char *text, size_t length,
                                      cJSON *notes, struct error *err)
{
    struct reader reader = {.path = path,
                            .text = text,
                            .length = length,
                            .line = 1,
                            .column = 1,
                            .notes = notes,
                            .err = err};
    struct import_value *value;

    if (!check_utf8(&reader)) {
        return NULL;
    }
    skip_space(&reader);
    if (peek(&reader) != '{') {
        fail_expected(&reader, "an object, which begins with '{'");
        return NULL;
    }
    value = read_value(&reader);
    skip_space(&reader);
    if (value && reader.at < reader.length) {
        fail_expected(&reader, "the end of the file");
        import_value_destroy(value);
        return NULL;
    }
    return value;
}
