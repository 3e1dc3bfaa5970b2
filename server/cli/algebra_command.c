/* SPDX-License-Identifier: MIT */
#include "algebra_command.h"

#include <stdio.h>
#include <stdlib.h>

#include "command.h"
#include "protocol/json.h"

int algebra_command_run(bool (*ask)(struct algebra *algebra, const void *question, cJSON **out,
                                    struct error *err),
                        const void *question)
{
    struct error err = {0};
    cJSON *answer = NULL;
    struct algebra *algebra = algebra_create(&err);
    const bool ok = algebra && ask(algebra, question, &answer, &err);

    if (algebra) {
        algebra_stop(algebra);
        algebra_destroy(algebra);
    }
    if (!ok) {
        error_print(&err, stderr);
        return EXIT_FAILED;
    }
    char *text = json_print(answer, true);
    puts(text);
    free(text);
    cJSON_Delete(answer);
    return EXIT_OK;
}
