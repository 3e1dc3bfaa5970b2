/* SPDX-License-Identifier: MIT */
/* fieldcast shader: what does the driver get of this scene? */
#include <stdlib.h>

#include "command.h"
#include "local_render.h"
#include "renderer/renderer.h"

int command_shader(const struct options *options)
{
    struct error err = {0};
    struct scene *scene = scene_open(options->operands[0], &err);
    char *text =
        scene ? renderer_shader(scene, (size_t)option_int(options, OPTION_PASS), &err) : NULL;

    if (text) {
        fputs(text, stdout);
    } else {
        error_print(&err, stderr);
    }
    free(text);
    scene_destroy(scene);
    return text && fflush(stdout) == 0 ? EXIT_OK : EXIT_FAILED;
}
