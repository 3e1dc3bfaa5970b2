/* SPDX-License-Identifier: MIT */
/* fieldcast implicitize: the equation of a parametric surface. */
#include "algebra_command.h"
#include "command.h"

static bool ask(struct algebra *algebra, const void *question, cJSON **out, struct error *err)
{
    const struct options *options = question;
    const char *const texts[] = {options->operands[0], options->operands[1], options->operands[2]};

    return algebra_implicitize(
        algebra, (enum surface_method)options->values[OPTION_METHOD].number[0], texts, out, err);
}

int command_implicitize(const struct options *options)
{
    return algebra_command_run(ask, options);
}
