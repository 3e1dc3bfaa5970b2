/* SPDX-License-Identifier: MIT */
/* The code of shaders of the registry. */
#include "shades.h"

#include <stddef.h>
#include <string.h>

static const struct shade table[] = {
    {"normals", true, "vec3 shade(FragmentProperties at) { return 0.5 + 0.5 * at.world_normal; }"},
    {"checker", false,
     "vec3 shade(FragmentProperties at)\n"
     "{\n"
     "    return mix(color1, color2, checker(at.object_position / scale));\n"
     "}"},
};

const struct shade *shade_find(const char *shader)
{
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        if (strcmp(table[i].shader, shader) == 0) {
            return &table[i];
        }
    }
    return NULL;
}
