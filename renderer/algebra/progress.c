/* SPDX-License-Identifier: MIT */
#include "progress.h"

#include <cjson/cJSON.h>
#include <stdarg.h>
#include <stdlib.h>

#include "protocol/json.h"

static const char *const step_names[] = {
    [PROGRESS_DEGREE] = "degree",     [PROGRESS_SUPPORT] = "support",
    [PROGRESS_PRIME] = "prime",       [PROGRESS_PAIRS] = "pairs",
    [PROGRESS_EXACT] = "exact",       [PROGRESS_IRREDUCIBLE] = "irreducible",
    [PROGRESS_COVERAGE] = "coverage",
};

void progress_init(struct progress *progress, FILE *out)
{
    progress->out = out;
    clock_gettime(CLOCK_MONOTONIC, &progress->start);
}

void progress_tell(const struct progress *progress, enum progress_step step, long count,
                   const char *format, ...)
{
    cJSON *json = cJSON_CreateObject();
    struct timespec now;
    char text[160];
    va_list arguments;

    clock_gettime(CLOCK_MONOTONIC, &now);
    const double ms = (double)(now.tv_sec - progress->start.tv_sec) * 1e3 +
                      (double)(now.tv_nsec - progress->start.tv_nsec) / 1e6;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    cJSON_AddStringToObject(json, "step", step_names[step]);
    cJSON_AddNumberToObject(json, "count", (double)count);
    cJSON_AddNumberToObject(json, "ms", (double)(long)ms);
    cJSON_AddStringToObject(json, "text", text);
    char *line = json_print(json, false);
    fprintf(progress->out, "%s\n", line);
    fflush(progress->out);
    free(line);
    cJSON_Delete(json);
}
