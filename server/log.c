/* SPDX-License-Identifier: MIT */
/* Each line is one write(), so that lines of several threads and of the worker do not mix. */
#include "log.h"

#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static const char *const names[] = {"error", "warning", "info", "debug"};
static atomic_int threshold = LEVEL_INFO;

bool log_set_level(const char *name)
{
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcmp(names[i], name) == 0) {
            atomic_store(&threshold, (int)i);
            return true;
        }
    }
    return false;
}

/* What clients send may end up in a line; it must stay one line. */
static void blank_controls(char *text)
{
    for (; *text; text++) {
        if ((unsigned char)*text < ' ' || *text == 0x7f) {
            *text = ' ';
        }
    }
}

void log_line(enum log_level level, const char *component, const char *format, ...)
{
    char line[1024], stamp[40];
    struct timespec now;
    struct tm parts;
    va_list arguments;

    if ((int)level > atomic_load(&threshold)) {
        return;
    }
    clock_gettime(CLOCK_REALTIME, &now);
    gmtime_r(&now.tv_sec, &parts);
    strftime(stamp, sizeof stamp, "%Y-%m-%dT%H:%M:%S", &parts);
    const int length = snprintf(line, sizeof line, "%s.%03ldZ %s %s: ", stamp,
                                now.tv_nsec / 1000000, names[level], component);
    va_start(arguments, format);
    vsnprintf(line + length, sizeof line - (size_t)length - 1, format, arguments);
    va_end(arguments);
    blank_controls(line);
    size_t end = strlen(line);
    line[end++] = '\n';
    if (write(STDERR_FILENO, line, end) < 0) {
        return; /* nowhere left to complain */
    }
}
