/* SPDX-License-Identifier: MIT */
/* fieldcast implicitize: the equation of a parametric surface. */
#include <stdlib.h>

#include "command.h"
#include "protocol/json.h"
#include "server/algebra.h"

static bool implicitize(enum surface_method method, const char *const texts[3], struct error *err)
{
    cJSON *answer = NULL;
    struct algebra *algebra = algebra_create(err);
    if (!algebra) {
        return false;
    }
    const bool ok = algebra_implicitize(algebra, method, texts, &answer, err);
    algebra_stop(algebra);
    algebra_destroy(algebra);
    if (ok) {
        char *text = json_print(answer, true);
        puts(text);
        free(text);
        cJSON_Delete(answer);
    }
    return ok;
}

int command_implicitize(const struct options *options)
{
    struct error err = {0};
    if (options->operand_count != 3) {
        fputs("fieldcast: implicitize takes three expressions: X Y Z\n", stderr);
        return EXIT_USAGE;
    }
    const char *const texts[] = {options->operands[0], options->operands[1], options->operands[2]};
    const enum surface_method method =
        (enum surface_method)options->values[OPTION_METHOD].number[0];
    if (!implicitize(method, texts, &err)) {
        error_print(&err, stderr);
        return EXIT_FAILED;
    }
    return EXIT_OK;
}
