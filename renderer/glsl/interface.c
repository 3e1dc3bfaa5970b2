/* SPDX-License-Identifier: MIT */
#include "interface.h"

#include "protocol/picture.h"

#define CONSTANT(name, ...) {#name, name},
#define MEMBER(type, name) "    " #type " " #name ";\n"
#define ARG(name) "    int " #name ";\n"

/* clang-format off */
static const struct {
    const char *name;
    int value;
} constants[] = {
    SKY_KINDS(CONSTANT) SHADOW_KINDS(CONSTANT) DENSITY_KINDS(CONSTANT) TONE_MAPS(CONSTANT)
    LIGHT_KINDS(CONSTANT) VOLUME_KINDS(CONSTANT) SURFACE_MODELS(CONSTANT) FRAME_EFFECTS(CONSTANT)
    PASS_MODES(CONSTANT) CLEAR_PHASES(CONSTANT) OUTPUTS(CONSTANT)
    UNIFORM_BLOCKS(CONSTANT) STORAGE_BLOCKS(CONSTANT) TEXTURE_UNITS(CONSTANT)
    FIELD_IMAGES(CONSTANT) COMMON_IMAGES(CONSTANT) SAMPLE_TEXTURES(CONSTANT)
    CONSTANT(LIMIT_LIGHTS) CONSTANT(LIMIT_VOLUMES)
    CONSTANT(GROUP_SIDE) CONSTANT(GROUP_SIZE) CONSTANT(BLOCK_BITS) CONSTANT(BLOCK_SIDE)
    CONSTANT(STACK_DEPTH) CONSTANT(MIRROR_LEVELS) CONSTANT(ARGS_LOCATION)
    CONSTANT(STEPS_WHITE) CONSTANT(STEPS_COLORS)
};

static const char structs[] =
    "struct Light {\n" LIGHT_MEMBERS(MEMBER) "};\n"
    "struct Volume {\n" VOLUME_MEMBERS(MEMBER) "};\n"
    "struct Dispatch {\n" DISPATCH_MEMBERS(MEMBER) "};\n"
    "struct SampleArgs {\n" SAMPLE_ARGS(ARG) "};\n"
    "struct ClearArgs {\n" CLEAR_ARGS(ARG) "};\n"
    "struct ShadeArgs {\n" SHADE_ARGS(ARG) "};\n"
    "struct GatherArgs {\n" GATHER_ARGS(ARG) "};\n"
    "struct ListingArgs {\n" LISTING_ARGS(ARG) "};\n"
    "struct ResolveArgs {\n" RESOLVE_ARGS(ARG) "};\n"
    "struct TraceArgs {\n" TRACE_ARGS(ARG) "};\n"
    "layout(std140, binding = BINDING_FRAME) uniform Frame {\n" FRAME_MEMBERS(MEMBER)
    "    Light lights[LIMIT_LIGHTS];\n"
    "    Volume volumes[LIMIT_VOLUMES];\n"
    "} frame;\n"
    "layout(location = 0) uniform Dispatch dispatch;\n";
/* clang-format on */

void interface_write(FILE *out)
{
    for (size_t i = 0; i < sizeof constants / sizeof constants[0]; i++) {
        fprintf(out, "#define %s %d\n", constants[i].name, constants[i].value);
    }
    fprintf(out, "vec3 steps_color_at(int i)\n{\n    return ");
    for (int i = 0; i < STEPS_COLORS; i++) {
        const unsigned char *c = steps_colors[i];
        if (i < STEPS_COLORS - 1) {
            fprintf(out, "i == %d ? ", i);
        }
        fprintf(out, "vec3(%d.0, %d.0, %d.0) / 255.0", c[0], c[1], c[2]);
        fprintf(out, i < STEPS_COLORS - 1 ? " : " : ";\n}\n");
    }
    fputs(structs, out);
}
