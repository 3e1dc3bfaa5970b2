/* SPDX-License-Identifier: MIT */
/* fieldcast check: are these documents right? */
#include "command.h"
#include "drawing.h"

int command_check(const struct options *options)
{
    int status = EXIT_OK;
    for (int i = 0; i < options->operand_count; i++) {
        struct error err = {0};
        struct scene *scene = scene_open(options->operands[i], &err);
        if (!scene) {
            error_print(&err, stdout);
            status = EXIT_FAILED;
        }
        scene_destroy(scene);
    }
    return status;
}
