/* SPDX-License-Identifier: MIT */
/* fieldcast check: are these documents right, and can they be drawn? */
#include "command.h"
#include "local_render.h"
#include "renderer/renderer.h"

/* What is wrong at a place of the document in the file. */
static void print_at(const char *file, const struct error *err, FILE *out)
{
    fprintf(out, "%s: ", file);
    error_print(err, out);
}

static bool check(const char *name)
{
    struct error err = {0}, warning = {0};
    struct scene *scene = scene_open(name, &err);
    bool ok = scene && renderer_check(scene, &warning, &err);
    if (!scene) {
        error_print(&err, stdout);
    } else if (!ok) {
        print_at(name, &err, stdout);
    } else if (warning.kind != ERROR_NONE) {
        fputs("fieldcast: warning: ", stderr);
        print_at(name, &warning, stderr);
    }
    scene_destroy(scene);
    return ok;
}

int command_check(const struct options *options)
{
    int status = EXIT_OK;
    for (int i = 0; i < options->operand_count; i++) {
        status = check(options->operands[i]) ? status : EXIT_FAILED;
    }
    return status;
}
