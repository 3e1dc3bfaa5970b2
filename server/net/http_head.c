/* SPDX-License-Identifier: MIT */
#include "http_head.h"

#include <string.h>
#include <strings.h>

struct field_rule {
    const char *name;
    bool list; /* several lines are one list */
};

static const struct field_rule rules[HEAD_FIELD_COUNT] = {
    [HEAD_HOST] = {"Host", false},
    [HEAD_ORIGIN] = {"Origin", false},
    [HEAD_AUTHORIZATION] = {"Authorization", false},
    [HEAD_CONTENT_LENGTH] = {"Content-Length", false},
    [HEAD_TRANSFER_ENCODING] = {"Transfer-Encoding", false},
    [HEAD_CONNECTION] = {"Connection", true},
    [HEAD_UPGRADE] = {"Upgrade", true},
    [HEAD_WS_VERSION] = {"Sec-WebSocket-Version", false},
    [HEAD_WS_KEY] = {"Sec-WebSocket-Key", false},
    [HEAD_WS_PROTOCOL] = {"Sec-WebSocket-Protocol", true},
};

static bool refuse(struct http_head_fault *fault, int status, const char *message)
{
    fault->status = status;
    fault->message = message;
    return false;
}

static bool is_digits(const char *text)
{
    return *text && strspn(text, "0123456789") == strlen(text);
}

static bool is_token_char(char c)
{
    return c > ' ' && c < 0x7f && !strchr("\"(),/:;<=>?@[\\]{}", c);
}

static bool is_token(const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        if (!is_token_char(text[i])) {
            return false;
        }
    }
    return length > 0;
}

long http_head_end(const char *bytes, size_t length, size_t seen)
{
    const size_t from = seen > 3 ? seen - 3 : 0;

    for (size_t i = from; i < length; i++) {
        if (bytes[i] == 0 || (bytes[i] == '\n' && (i == 0 || bytes[i - 1] != '\r')) ||
            (bytes[i] == '\r' && i + 1 < length && bytes[i + 1] != '\n')) {
            return -1;
        }
        if (bytes[i] == '\n' && i >= 3 && bytes[i - 2] == '\n') {
            return (long)i + 1;
        }
    }
    return 0;
}

static char *keep(struct http_head *head, const char *text, size_t length)
{
    char *copy = head->text + head->used;

    memcpy(copy, text, length);
    copy[length] = '\0';
    head->used += length + 1;
    return copy;
}

static bool read_version(const char *text, size_t length, struct http_head *head,
                         struct http_head_fault *fault)
{
    if (length != 8 || strncmp(text, "HTTP/", 5) != 0 || text[6] != '.' || text[5] < '0' ||
        text[5] > '9' || text[7] < '0' || text[7] > '9') {
        return refuse(fault, 400, "the request line does not end with HTTP/1.1");
    }
    if (text[5] != '1') {
        return refuse(fault, 505, "only HTTP/1.0 and HTTP/1.1 are spoken here");
    }
    head->minor = text[7] - '0';
    return true;
}

static bool read_request_line(const char *line, size_t length, struct http_head *head,
                              struct http_head_fault *fault)
{
    const char *first = memchr(line, ' ', length);
    const char *last = memrchr(line, ' ', length);

    if (!first || first == last || !is_token(line, (size_t)(first - line)) || first - line > 32) {
        return refuse(fault, 400, "the request line is not METHOD TARGET VERSION");
    }
    for (const char *c = first + 1; c < last; c++) {
        if (*c <= ' ' || *c >= 0x7f || *c == '#') {
            return refuse(fault, 400, "the request target holds a character that none may hold");
        }
    }
    if (first + 1 == last) {
        return refuse(fault, 400, "the request target is empty");
    }
    head->method = keep(head, line, (size_t)(first - line));
    head->target = keep(head, first + 1, (size_t)(last - first - 1));
    if (*head->target != '/' && strncasecmp(head->target, "http://", 7) != 0 &&
        strcmp(head->target, "*") != 0) {
        return refuse(fault, 400, "the request target is neither a path nor an http address");
    }
    return read_version(last + 1, length - (size_t)(last + 1 - line), head, fault);
}

static bool is_name(const char *name, size_t length, const char *wanted)
{
    return strlen(wanted) == length && strncasecmp(name, wanted, length) == 0;
}

/* White space behind a value is no part of it; but libmicrohttpd takes it for one, and where bodies
 * end must not depend on that. */
static bool is_framing(const char *name, size_t length)
{
    return is_name(name, length, rules[HEAD_CONTENT_LENGTH].name) ||
           is_name(name, length, rules[HEAD_TRANSFER_ENCODING].name);
}

bool http_head_field_check(const char *name, size_t name_length, const char *value,
                           size_t value_length, struct http_head_fault *fault)
{
    if (!is_token(name, name_length)) {
        return refuse(fault, 400, "a header name holds a character that none may hold");
    }
    for (size_t i = 0; i < value_length; i++) {
        const unsigned char c = (unsigned char)value[i];

        if ((c < ' ' && c != '\t') || c == 0x7f) {
            return refuse(fault, 400, "a header value holds a control character");
        }
    }
    if (value_length && strchr(" \t", value[value_length - 1]) && is_framing(name, name_length)) {
        return refuse(fault, 400, "white space follows a length or a transfer coding");
    }
    return true;
}

static bool store_field(struct http_head *head, const char *name, size_t name_length,
                        const char *value, size_t value_length, struct http_head_fault *fault)
{
    for (int i = 0; i < HEAD_FIELD_COUNT; i++) {
        if (!is_name(name, name_length, rules[i].name)) {
            continue;
        }
        const size_t before = head->field[i] ? strlen(head->field[i]) + 2 : 0;
        if (before && !rules[i].list) {
            return refuse(fault, 400, "a header that may come once comes twice");
        }
        if (head->used + before + value_length + 1 > sizeof head->text) {
            return refuse(fault, 431, "a list header comes too often");
        }
        char *joined = head->text + head->used;
        if (before) {
            keep(head, head->field[i], before - 2);
            head->used--;
            keep(head, ", ", 2);
            head->used--;
        }
        keep(head, value, value_length);
        head->field[i] = joined;
        return true;
    }
    return true;
}

static bool read_field(const char *line, size_t length, struct http_head *head,
                       struct http_head_fault *fault)
{
    const char *colon = memchr(line, ':', length);

    if (*line == ' ' || *line == '\t') {
        return refuse(fault, 400, "a header is folded over lines");
    }
    if (!colon) {
        return refuse(fault, 400, "a header line has no colon");
    }
    const char *value = colon + 1, *end = line + length;
    while (value < end && (*value == ' ' || *value == '\t')) {
        value++;
    }
    const size_t name_length = (size_t)(colon - line);
    if (!http_head_field_check(line, name_length, value, (size_t)(end - value), fault)) {
        return false;
    }
    while (end > value && (end[-1] == ' ' || end[-1] == '\t')) {
        end--;
    }
    return store_field(head, line, name_length, value, (size_t)(end - value), fault);
}

/* uri-host [":" port] without user information (RFC 9110, 7.2). */
static bool is_authority(const char *host)
{
    return *host && strspn(host, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                 "-._~%!$&'()*+;=:[]") == strlen(host);
}

bool http_head_framing_check(const char *host, const char *content_length,
                             const char *transfer_encoding, int minor,
                             struct http_head_fault *fault)
{
    if (!host && minor >= 1) {
        return refuse(fault, 400, "the Host header is missing");
    }
    if (host && !is_authority(host)) {
        return refuse(fault, 400, "the Host header is not a host and port");
    }
    if (content_length && (!is_digits(content_length) || strlen(content_length) > 18)) {
        return refuse(fault, 400, "Content-Length is not a number");
    }
    if (transfer_encoding && content_length) {
        return refuse(fault, 400, "both Content-Length and Transfer-Encoding are given");
    }
    if (transfer_encoding && (minor < 1 || strcasecmp(transfer_encoding, "chunked") != 0)) {
        return refuse(fault, 400, "the only transfer coding known is chunked, in HTTP/1.1");
    }
    return true;
}

bool http_head_read(const char *bytes, size_t length, struct http_head *out,
                    struct http_head_fault *fault)
{
    const char *line = bytes, *end = bytes + length;
    bool first = true;

    memset(out->field, 0, sizeof out->field);
    out->method = out->target = NULL;
    out->used = 0;
    out->length = length;
    if (length > LIMIT_HEAD_BYTES) {
        return refuse(fault, 431, "the request head is too long");
    }
    for (const char *next; line < end; line = next) {
        const char *stop = memmem(line, (size_t)(end - line), "\r\n", 2);

        if (!stop) {
            return refuse(fault, 400, "a line does not end with CR LF");
        }
        next = stop + 2;
        if (stop == line) {
            break;
        }
        const size_t size = (size_t)(stop - line);
        if (!(first ? read_request_line(line, size, out, fault)
                    : read_field(line, size, out, fault))) {
            return false;
        }
        first = false;
    }
    if (first) {
        return refuse(fault, 400, "the request is empty");
    }
    return http_head_framing_check(out->field[HEAD_HOST], out->field[HEAD_CONTENT_LENGTH],
                                   out->field[HEAD_TRANSFER_ENCODING], out->minor, fault);
}

bool http_head_list_has(const char *list, const char *token)
{
    const size_t wanted = strlen(token);

    while (list && *list) {
        list += strspn(list, ", \t");
        const size_t length = strcspn(list, ",");
        size_t used = length;

        while (used && (list[used - 1] == ' ' || list[used - 1] == '\t')) {
            used--;
        }
        if (used == wanted && strncasecmp(list, token, wanted) == 0) {
            return true;
        }
        list += length;
    }
    return false;
}

static bool is_key(const char *key)
{
    /* 16 bytes in base64. */
    return key && strlen(key) == 24 && strcmp(key + 22, "==") == 0 &&
           strspn(key, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/") == 22;
}

bool http_head_is_upgrade(const struct http_head *head, const char *subprotocol)
{
    const char *const *field = (const char *const *)head->field;

    return strcmp(head->method, "GET") == 0 && head->minor == 1 && field[HEAD_UPGRADE] &&
           strcasecmp(field[HEAD_UPGRADE], "websocket") == 0 &&
           http_head_list_has(field[HEAD_CONNECTION], "upgrade") && field[HEAD_WS_VERSION] &&
           strcmp(field[HEAD_WS_VERSION], "13") == 0 && is_key(field[HEAD_WS_KEY]) &&
           http_head_list_has(field[HEAD_WS_PROTOCOL], subprotocol) &&
           !field[HEAD_CONTENT_LENGTH] && !field[HEAD_TRANSFER_ENCODING];
}
