/* SPDX-License-Identifier: MIT */
/* fieldcast shader: what does the driver get of this scene? And a scene as a shader of its own. */
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "local_render.h"
#include "protocol/picture.h"
#include "renderer/renderer.h"
#include "server/embedded.h"

static void put_escaped(const char *text)
{
    for (; *text != '\0'; text++) {
        switch (*text) {
        case '&':
            fputs("&amp;", stdout);
            break;
        case '<':
            fputs("&lt;", stdout);
            break;
        default:
            putchar(*text);
        }
    }
}

/* The page's text has a line for each that is put in: its title, and the shader. */
static void put_page(const struct scene *scene, const char *shader)
{
    static const char title[] = "{TITLE}", program[] = "{SHADER}";
    const char *page = (const char *)templates_find("webgl")->bytes;
    const char *first = strstr(page, title), *second = strstr(first, program);
    const char *name = record_text(&scene->info, "name");

    fwrite(page, 1, (size_t)(first - page), stdout);
    put_escaped(*name ? name : "fieldcast");
    first += sizeof title - 1;
    fwrite(first, 1, (size_t)(second - first), stdout);
    fputs(shader, stdout);
    fputs(second + sizeof program - 1, stdout);
}

int command_shader(const struct options *options)
{
    const bool page = option_flag(options, OPTION_PAGE);
    const bool webgl = page || option_flag(options, OPTION_WEBGL);
    const char *level = option_text(options, OPTION_LEVEL);
    struct error err = {0};
    struct scene *scene = scene_open(options->operands[0], &err);
    char *text = NULL;

    if (scene && webgl) {
        text = renderer_webgl(scene, level ? option_int(options, OPTION_LEVEL) : -1, &err);
    } else if (scene) {
        text = renderer_shader(scene, (size_t)option_int(options, OPTION_PASS),
                               (enum render_programs)option_int(options, OPTION_PROGRAMS), &err);
    }
    if (text && page) {
        put_page(scene, text);
    } else if (text) {
        fputs(text, stdout);
    } else {
        error_print(&err, stderr);
    }
    free(text);
    scene_destroy(scene);
    return text ? EXIT_OK : EXIT_FAILED;
}
