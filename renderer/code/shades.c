/* SPDX-License-Identifier: MIT */
/* The code of shaders of the registry. */
#include "shades.h"

#include <stddef.h>
#include <string.h>

static const struct shade table[] = {
    {"normals", true, NULL,
     "vec3 shade(FragmentProperties at) { return 0.5 + 0.5 * at.world_normal; }"},
    {"checker", false, NULL,
     "vec3 shade(FragmentProperties at)\n"
     "{\n"
     "    return mix(color1, color2, checker(at.object_position / scale));\n"
     "}"},
    {"map", false, "function",
     "Surface shade(FragmentProperties at)\n"
     "{\n"
     "    vec4 found = function_at(at.object_position);\n"
     "    float value = slope ? length(found.xyz) : found.w;\n"
     "    float range = to - from;\n"
     "    float share = clamp((value - from) / (range == 0.0 ? 1e-9 : range), 0.0, 1.0);\n"
     "    vec3 color = share < 0.5 ? mix(low, middle, 2.0 * share)\n"
     "                             : mix(middle, high, 2.0 * share - 1.0);\n"
     "    float spacing = lines > 0 ? range / float(lines) : 1.0;\n"
     "    float turn = value / (spacing == 0.0 ? 1e-9 : spacing);\n"
     "    float line = 1.0 - smoothstep(0.02, 0.05, abs(fract(turn + 0.5) - 0.5));\n"
     "    Surface surface = Surface(color * (lines > 0 ? 1.0 - 0.8 * line : 1.0));\n"
     "    surface.roughness = roughness;\n"
     "    return surface;\n"
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
