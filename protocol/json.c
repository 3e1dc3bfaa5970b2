/* SPDX-License-Identifier: MIT */
/* Strict reading of JSON: the pre-scan, then cJSON. Writing is json_print.c. */
#include "json.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "limits.h"
#include "memory.h"
#include "utf8.h"

/* I-JSON (RFC 7493): whole numbers beyond this are not exact in a double. */
#define NUMBER_MAX 9007199254740991.0

enum {
    SMALL_NUMBER_CHARACTERS = 16, /* in front of the point: fewer are within that */
    FEW_KEYS = 8,                 /* are compared each with each: that is quicker than sorting */
};

struct key {
    size_t name, length; /* in scan.names, decoded */
    size_t at;           /* in the text */
};

/* Keys of all objects that are open: each object's own are at the end while it is read. */
struct scan {
    const unsigned char *text;
    size_t length, at;
    size_t values;
    struct key *keys;
    size_t key_count, key_capacity;
    char *names;
    size_t name_length, name_capacity;
    bool keep_name; /* the string read now is a key */
    bool printed;   /* by json_print */
    struct error *err;
};

static bool fail_at(struct scan *scan, size_t at, enum error_kind kind, const char *message)
{
    size_t line = 1, column = 1;
    char place[64];

    for (size_t i = 0; i < at && i < scan->length; i++) {
        if (scan->text[i] == '\n') {
            line++;
            column = 1;
        } else if ((scan->text[i] & 0xc0) != 0x80) {
            column++;
        }
    }
    snprintf(place, sizeof place, "line %zu, column %zu", line, column);
    return error_set(scan->err, kind, place, "%s", message);
}

static bool fail_limit(struct scan *scan, size_t at, const char *what, long limit)
{
    char message[128];

    snprintf(message, sizeof message, "%s above the maximum %ld", what, limit);
    return fail_at(scan, at, ERROR_LIMIT, message);
}

static int peek(const struct scan *scan)
{
    return scan->at < scan->length ? scan->text[scan->at] : -1;
}

static void skip_space(struct scan *scan)
{
    for (int c = peek(scan); c == ' ' || c == '\t' || c == '\n' || c == '\r'; c = peek(scan)) {
        scan->at++;
    }
}

static bool fail_expected(struct scan *scan, const char *what)
{
    char message[128];
    const int c = peek(scan);

    if (c < 0) {
        snprintf(message, sizeof message, "the text ends, expected %s", what);
    } else if (c > 0x20 && c < 0x7f) {
        snprintf(message, sizeof message, "expected %s, not '%c'", what, c);
    } else {
        snprintf(message, sizeof message, "expected %s, not byte 0x%02x", what, c);
    }
    return fail_at(scan, scan->at, ERROR_SYNTAX, message);
}

/* --- strings --- */

static void keep_byte(struct scan *scan, unsigned byte)
{
    if (!scan->keep_name) {
        return;
    }
    if (scan->name_length == scan->name_capacity) {
        scan->name_capacity = scan->name_capacity ? 2 * scan->name_capacity : 256;
        scan->names = memory_resize(scan->names, scan->name_capacity, 1);
    }
    scan->names[scan->name_length++] = (char)byte;
}

static void keep_code(struct scan *scan, uint32_t code)
{
    char bytes[4];
    const size_t count = utf8_put(bytes, code);

    for (size_t i = 0; i < count; i++) {
        keep_byte(scan, (unsigned char)bytes[i]);
    }
}

/* Four hexadecimal digits at `at`; -1 where they are not. */
static int32_t hex4(const struct scan *scan, size_t at)
{
    int32_t code = 0;

    for (size_t i = at; i < at + 4; i++) {
        const int c = i < scan->length ? scan->text[i] : -1;
        const int digit = c >= '0' && c <= '9'   ? c - '0'
                          : c >= 'a' && c <= 'f' ? c - 'a' + 10
                          : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                                 : -1;
        if (digit < 0) {
            return -1;
        }
        code = code * 16 + digit;
    }
    return code;
}

static bool scan_unicode_escape(struct scan *scan)
{
    const size_t start = scan->at - 1; /* the backslash */
    int32_t code = hex4(scan, scan->at + 1);

    if (code < 0) {
        return fail_at(scan, start, ERROR_SYNTAX, "expected four hexadecimal digits after \\u");
    }
    if (code == 0) {
        return fail_at(scan, start, ERROR_SYNTAX, "\\u0000 is not allowed");
    }
    scan->at += 5;
    if (code >= 0xd800 && code < 0xe000) {
        const bool pair = code < 0xdc00 && scan->at + 1 < scan->length &&
                          scan->text[scan->at] == '\\' && scan->text[scan->at + 1] == 'u';
        const int32_t low = pair ? hex4(scan, scan->at + 2) : -1;
        if (low < 0xdc00 || low >= 0xe000) {
            return fail_at(scan, start, ERROR_SYNTAX, "half of a surrogate pair");
        }
        code = 0x10000 + (code - 0xd800) * 0x400 + (low - 0xdc00);
        scan->at += 6;
    }
    keep_code(scan, (uint32_t)code);
    return true;
}

static bool scan_escape(struct scan *scan)
{
    static const char names[] = "\"\\/bfnrt", meanings[] = "\"\\/\b\f\n\r\t";

    scan->at++;
    const int c = peek(scan);
    if (c == 'u') {
        return scan_unicode_escape(scan);
    }
    const char *name = c > 0 ? strchr(names, c) : NULL;
    if (!name) {
        return fail_at(scan, scan->at - 1, ERROR_SYNTAX, "unknown escape");
    }
    keep_byte(scan, (unsigned char)meanings[name - names]);
    scan->at++;
    return true;
}

static bool scan_utf8(struct scan *scan)
{
    const size_t count =
        utf8_sequence((const char *)scan->text + scan->at, scan->length - scan->at);

    if (count == 0) {
        return fail_at(scan, scan->at, ERROR_SYNTAX, "not UTF-8");
    }
    for (size_t i = 0; i < count; i++) {
        keep_byte(scan, scan->text[scan->at++]);
    }
    return true;
}

static bool scan_string(struct scan *scan)
{
    const size_t start = scan->at++;

    for (;;) {
        const int c = peek(scan);
        if (scan->at - start - 1 > LIMIT_JSON_STRING_BYTES) {
            return fail_limit(scan, start, "bytes of a string", LIMIT_JSON_STRING_BYTES);
        }
        if (c == '"') {
            scan->at++;
            return true;
        }
        if (c < 0) {
            return fail_at(scan, start, ERROR_SYNTAX, "the string does not end");
        }
        if (c < 0x20) {
            return fail_at(scan, scan->at, ERROR_SYNTAX, "control character in a string");
        }
        if (c == '\\') {
            if (!scan_escape(scan)) {
                return false;
            }
        } else if (c >= 0x80) {
            if (!scan_utf8(scan)) {
                return false;
            }
        } else {
            keep_byte(scan, (unsigned)c);
            scan->at++;
        }
    }
}

/* --- numbers and words --- */

static bool scan_digits(struct scan *scan)
{
    if (peek(scan) < '0' || peek(scan) > '9') {
        return fail_expected(scan, "a digit");
    }
    while (peek(scan) >= '0' && peek(scan) <= '9') {
        scan->at++;
    }
    return true;
}

static bool check_magnitude(struct scan *scan, size_t start, size_t length)
{
    char text[LIMIT_JSON_NUMBER_BYTES + 1], message[128];

    memcpy(text, scan->text + start, length);
    text[length] = '\0';
    if (fabs(strtod(text, NULL)) > NUMBER_MAX) {
        snprintf(message, sizeof message, "%s is beyond the greatest magnitude %.0f", text,
                 NUMBER_MAX);
        return fail_at(scan, start, ERROR_LIMIT, message);
    }
    return true;
}

static bool scan_number(struct scan *scan)
{
    const size_t start = scan->at;

    scan->at += peek(scan) == '-';
    if (peek(scan) == '0') {
        scan->at++;
        if (peek(scan) >= '0' && peek(scan) <= '9') {
            return fail_at(scan, start, ERROR_SYNTAX, "a number starts with 0");
        }
    } else if (!scan_digits(scan)) {
        return false;
    }
    bool small = scan->at - start < SMALL_NUMBER_CHARACTERS;
    if (peek(scan) == '.') {
        scan->at++;
        if (!scan_digits(scan)) {
            return false;
        }
    }
    if (peek(scan) == 'e' || peek(scan) == 'E') {
        small = false;
        scan->at++;
        scan->at += peek(scan) == '+' || peek(scan) == '-';
        if (!scan_digits(scan)) {
            return false;
        }
    }
    const size_t length = scan->at - start;
    if (length > LIMIT_JSON_NUMBER_BYTES) {
        return fail_limit(scan, start, "characters of a number", LIMIT_JSON_NUMBER_BYTES);
    }
    return small || check_magnitude(scan, start, length);
}

static bool scan_word(struct scan *scan, const char *word)
{
    const size_t length = strlen(word);

    if (scan->length - scan->at < length || memcmp(scan->text + scan->at, word, length) != 0) {
        return fail_expected(scan, "a value");
    }
    scan->at += length;
    return true;
}

/* --- objects and arrays --- */

static bool scan_value(struct scan *scan, int depth);

static bool scan_array(struct scan *scan, int depth)
{
    scan->at++;
    skip_space(scan);
    if (peek(scan) == ']') {
        scan->at++;
        return true;
    }
    for (;;) {
        if (!scan_value(scan, depth)) {
            return false;
        }
        skip_space(scan);
        if (peek(scan) == ']') {
            scan->at++;
            return true;
        }
        if (peek(scan) != ',') {
            return fail_expected(scan, "',' or ']'");
        }
        scan->at++;
    }
}

static bool scan_key(struct scan *scan)
{
    skip_space(scan);
    if (peek(scan) != '"') {
        return fail_expected(scan, "a member's name");
    }
    if (scan->key_count == scan->key_capacity) {
        scan->key_capacity = scan->key_capacity ? 2 * scan->key_capacity : 64;
        scan->keys = memory_resize(scan->keys, scan->key_capacity, sizeof *scan->keys);
    }
    struct key *key = &scan->keys[scan->key_count++];
    *key = (struct key){.name = scan->name_length, .at = scan->at};
    scan->keep_name = true;
    if (!scan_string(scan)) {
        return false;
    }
    scan->keep_name = false;
    key->length = scan->name_length - key->name;
    skip_space(scan);
    if (peek(scan) != ':') {
        return fail_expected(scan, "':'");
    }
    scan->at++;
    return true;
}

static int compare_names(const struct key *a, const struct key *b, const char *names)
{
    if (a->length != b->length) {
        return a->length < b->length ? -1 : 1;
    }
    return a->length == 0 ? 0 : memcmp(names + a->name, names + b->name, a->length);
}

static int compare_keys(const void *a, const void *b, void *names)
{
    const struct key *x = a, *y = b;
    const int order = compare_names(x, y, names);

    return order ? order : x->at < y->at ? -1 : 1;
}

static bool all_differ(const struct key *keys, size_t count, const char *names)
{
    for (size_t i = 1; i < count; i++) {
        for (size_t j = 0; j < i; j++) {
            if (compare_names(&keys[i], &keys[j], names) == 0) {
                return false;
            }
        }
    }
    return true;
}

/* Sorting needs no good hash: nobody can choose keys that make it slow. */
static bool check_duplicates(struct scan *scan, size_t first)
{
    struct key *keys = scan->keys + first;
    const size_t count = scan->key_count - first;

    if (count <= FEW_KEYS && all_differ(keys, count, scan->names)) {
        return true;
    }
    qsort_r(keys, count, sizeof *keys, compare_keys, scan->names);
    for (size_t i = 1; i < count; i++) {
        if (compare_names(&keys[i - 1], &keys[i], scan->names) == 0) {
            const int shown = keys[i].length < 64 ? (int)keys[i].length : 64;
            char message[128];
            snprintf(message, sizeof message, "duplicate member \"%.*s\"", shown,
                     shown ? scan->names + keys[i].name : "");
            return fail_at(scan, keys[i].at, ERROR_SYNTAX, message);
        }
    }
    return true;
}

static bool scan_members(struct scan *scan, int depth, size_t first)
{
    for (;;) {
        if (scan->key_count - first == LIMIT_JSON_KEYS) {
            return fail_limit(scan, scan->at, "members of an object", LIMIT_JSON_KEYS);
        }
        if (!scan_key(scan) || !scan_value(scan, depth)) {
            return false;
        }
        skip_space(scan);
        if (peek(scan) == '}') {
            scan->at++;
            return true;
        }
        if (peek(scan) != ',') {
            return fail_expected(scan, "',' or '}'");
        }
        scan->at++;
    }
}

static bool scan_object(struct scan *scan, int depth)
{
    const size_t first = scan->key_count, names = scan->name_length;

    scan->at++;
    skip_space(scan);
    if (peek(scan) == '}') {
        scan->at++;
        return true;
    }
    if (!scan_members(scan, depth, first) || !check_duplicates(scan, first)) {
        return false;
    }
    scan->key_count = first;
    scan->name_length = names;
    return true;
}

static bool scan_value(struct scan *scan, int depth)
{
    skip_space(scan);
    if (++scan->values > LIMIT_JSON_VALUES && !scan->printed) {
        return fail_limit(scan, scan->at, "values", LIMIT_JSON_VALUES);
    }
    const int c = peek(scan);
    if ((c == '{' || c == '[') && depth == LIMIT_JSON_DEPTH) {
        return fail_limit(scan, scan->at, "levels of nesting", LIMIT_JSON_DEPTH);
    }
    switch (c) {
    case '{':
        return scan_object(scan, depth + 1);
    case '[':
        return scan_array(scan, depth + 1);
    case '"':
        return scan_string(scan);
    case 't':
        return scan_word(scan, "true");
    case 'f':
        return scan_word(scan, "false");
    case 'n':
        return scan_word(scan, "null");
    default:
        if (c == '-' || (c >= '0' && c <= '9')) {
            return scan_number(scan);
        }
        return fail_expected(scan, "a value");
    }
}

static bool scan_text(struct scan *scan)
{
    if (!scan_value(scan, 0)) {
        return false;
    }
    skip_space(scan);
    return scan->at == scan->length || fail_expected(scan, "nothing more");
}

/* Takes what the scan has allocated. */
static cJSON *parse(struct scan *scan)
{
    const bool ok = scan_text(scan);

    free(scan->keys);
    free(scan->names);
    if (!ok) {
        return NULL;
    }
    cJSON *json = cJSON_ParseWithLengthOpts((const char *)scan->text, scan->length, NULL, false);
    if (!json) {
        error_set(scan->err, ERROR_INTERNAL, "",
                  "the JSON parser refused what the pre-scan accepted");
    }
    return json;
}

cJSON *json_parse(const char *text, size_t length, struct error *err)
{
    struct scan scan = {.text = (const unsigned char *)text, .length = length, .err = err};

    if (length > LIMIT_DOCUMENT_BYTES) {
        error_set(err, ERROR_TOO_LARGE, "", "%zu bytes are above the maximum %d", length,
                  LIMIT_DOCUMENT_BYTES);
        return NULL;
    }
    return parse(&scan);
}

cJSON *json_parse_printed(const char *text, size_t length, struct error *err)
{
    struct scan scan = {
        .text = (const unsigned char *)text, .length = length, .printed = true, .err = err};

    return parse(&scan);
}
