/* SPDX-License-Identifier: MIT */
/* Filling and showing a struct error. */
#include "error.h"

#include <stdarg.h>
#include <string.h>

#include "utf8.h"

enum { PLACE_MEMBER_BYTES = 64 }; /* that are shown of one */

static void replace_malformed(char *text)
{
    size_t left = strlen(text);

    while (left > 0) {
        size_t count = utf8_sequence(text, left);
        if (count == 0) {
            *text = '?';
            count = 1;
        }
        text += count;
        left -= count;
    }
}

static bool __attribute__((format(printf, 4, 0)))
fill(struct error *err, enum error_kind kind, const char *place, const char *format, va_list args)
{
    char text[sizeof err->message]; /* the arguments may point into err itself */

    vsnprintf(text, sizeof text, format, args);
    replace_malformed(text);
    err->kind = kind;
    if (place != err->place) {
        snprintf(err->place, sizeof err->place, "%s", place ? place : "");
        replace_malformed(err->place);
    }
    memcpy(err->message, text, strlen(text) + 1);
    err->line = err->column = 0;
    err->measured_ms = err->limit_ms = err->retry_ms = err->position = 0;
    return false;
}

bool error_set(struct error *err, enum error_kind kind, const char *place, const char *format, ...)
{
    if (err) {
        va_list args;
        va_start(args, format);
        fill(err, kind, place, format, args);
        va_end(args);
    }
    return false;
}

bool error_set_at(struct error *err, enum error_kind kind, const char *place, int line, int column,
                  const char *format, ...)
{
    if (err) {
        va_list args;
        va_start(args, format);
        fill(err, kind, place, format, args);
        va_end(args);
        err->line = line;
        err->column = column;
    }
    return false;
}

bool error_set_slow(struct error *err, const char *place, const char *what, int measured_ms,
                    int limit_ms)
{
    if (err) {
        error_set(err, ERROR_TOO_SLOW, place, "%s over %.3g s of processor time (limit %.3g s)",
                  what, measured_ms / 1000.0, limit_ms / 1000.0);
        err->measured_ms = measured_ms;
        err->limit_ms = limit_ms;
    }
    return false;
}

const char *error_place(char *out, const char *place, const char *member)
{
    static const char cut[] = "...";
    char joined[ERROR_PLACE_BYTES + PLACE_MEMBER_BYTES + 1];
    const size_t before = strnlen(place, ERROR_PLACE_BYTES - 1);
    const size_t own = strnlen(member, PLACE_MEMBER_BYTES), length = before + 1 + own;

    memcpy(joined, place, before);
    joined[before] = '/';
    memcpy(joined + before + 1, member, own);
    joined[length] = '\0';
    if (length < ERROR_PLACE_BYTES) {
        memcpy(out, joined, length + 1);
    } else {
        const size_t kept = ERROR_PLACE_BYTES - sizeof cut;
        memcpy(out, cut, sizeof cut - 1);
        memcpy(out + sizeof cut - 1, joined + length - kept, kept + 1);
    }
    return out;
}

void error_print(const struct error *err, FILE *out)
{
    char at[40] = "";

    if (err->line > 0) {
        snprintf(at, sizeof at, ":%d:%d", err->line, err->column);
    }
    fprintf(out, "%s%s%s%s\n", err->place, at, *err->place || *at ? ": " : "", err->message);
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
