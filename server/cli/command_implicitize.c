/* SPDX-License-Identifier: MIT */
/* fieldcast implicitize: the equation of a parametric surface. */
#include "algebra_command.h"
#include "command.h"

static void add_options(cJSON *asked, const struct options *options)
{
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
}

static bool ask(struct algebra *algebra, const void *question, cJSON **out, struct error *err)
{
    const struct options *options = question;
    cJSON *asked = cJSON_CreateObject();

    for (int i = 0; i < SURFACE_PARTS; i++) {
        cJSON_AddStringToObject(asked, surface_names[i], options->operands[i]);
    }
    add_options(asked, options);
    const bool ok = algebra_implicitize(algebra, asked, out, err);
    cJSON_Delete(asked);
    return ok;
}

int command_implicitize(const struct options *options)
{
    return algebra_command_run(ask, options);
}
