/* SPDX-License-Identifier: MIT */
/* fieldcast implicitize: the equation of a parametric surface. */
#include <stdio.h>
#include <unistd.h>

#include "algebra_command.h"
#include "command.h"

static cJSON *asked_by(const struct options *options)
{
    cJSON *asked = cJSON_CreateObject();

    for (int i = 0; i < SURFACE_PARTS; i++) {
        cJSON_AddStringToObject(asked, surface_names[i], options->operands[i]);
    }
    for (int i = OPTION_RANGE_S; i <= OPTION_RANGE_V; i++) {
        const struct option_value *value = &options->values[i];
        if (value->source != SOURCE_NONE) {
            cJSON_AddItemToObject(asked, surface_names[SURFACE_PARTS + i - OPTION_RANGE_S],
                                  cJSON_CreateDoubleArray(value->number, 2));
        }
    }
    if (options->values[OPTION_SIZE].source != SOURCE_NONE) {
        cJSON_AddItemToObject(asked, "size",
                              cJSON_CreateDoubleArray(options->values[OPTION_SIZE].number, 3));
    }
    cJSON_AddStringToObject(asked, "method", option_text(options, OPTION_METHOD));
    return asked;
}

/* "0.81 s: prime 5: 305 bits"; what is no step is left out. */
static void print_step(void *data, const char *line)
{
    cJSON *step = cJSON_Parse(line);
    const cJSON *ms = cJSON_GetObjectItemCaseSensitive(step, "ms");
    const cJSON *text = cJSON_GetObjectItemCaseSensitive(step, "text");

    (void)data;
    if (cJSON_IsNumber(ms) && cJSON_IsString(text)) {
        fprintf(stderr, "%.2f s: %s\n", ms->valuedouble / 1000, text->valuestring);
    }
    cJSON_Delete(step);
}

/* Somebody who looks on is told the steps in any case. */
static bool ask(struct algebra *algebra, const void *question, cJSON **out, struct error *err)
{
    const struct options *options = question;
    const bool steps = options->values[OPTION_STEPS].number[0] != 0 || isatty(STDERR_FILENO);
    cJSON *json = asked_by(options);
    struct record asked;

    record_init(&asked, &surface_question_type);
    const bool ok = surface_question_read(&asked, json, err) &&
                    algebra_ask(algebra, &asked, steps ? print_step : NULL, NULL, out, err);
    record_finish(&asked);
    cJSON_Delete(json);
    return ok;
}

int command_implicitize(const struct options *options)
{
    return algebra_command_run(ask, options);
}
