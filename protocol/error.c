/* SPDX-License-Identifier: MIT */
/* Filling and showing a struct error. */
#include "error.h"

#include <stdarg.h>
#include <string.h>

/* A cut in the middle of a UTF-8 sequence would make the message unusable as JSON. */
static void trim_cut_sequence(char *text)
{
    size_t length = strlen(text), start = length;
    while (start > 0 && ((unsigned char)text[start - 1] & 0xc0) == 0x80) {
        start--;
    }
    if (start == 0) {
        return;
    }
    unsigned char lead = (unsigned char)text[start - 1];
    size_t need = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc0 ? 1 : 0;
    if (length - start < need) {
        text[start - 1] = '\0';
    }
}

bool error_set(struct error *err, enum error_kind kind, const char *place, const char *format, ...)
{
    if (!err) {
        return false;
    }
    char text[sizeof err->message]; /* the arguments may point into err itself */
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    trim_cut_sequence(text);
    err->kind = kind;
    if (place != err->place) {
        snprintf(err->place, sizeof err->place, "%s", place ? place : "");
        trim_cut_sequence(err->place);
    }
    memcpy(err->message, text, sizeof text);
    return false;
}

void error_print(const struct error *err, FILE *out)
{
    fprintf(out, "%s%s%s\n", err->place, *err->place ? ": " : "", err->message);
}

const char *error_kind_name(enum error_kind kind)
{
    static const char *const names[] = {
#define X(name, wire, status) [ERROR_##name] = wire,
        ERROR_KINDS(X)
#undef X
    };
    return names[kind];
}

int error_kind_status(enum error_kind kind)
{
    static const int statuses[] = {
#define X(name, wire, status) [ERROR_##name] = status,
        ERROR_KINDS(X)
#undef X
    };
    return statuses[kind];
}
