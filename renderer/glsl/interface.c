/* SPDX-License-Identifier: MIT */
#include "interface.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/picture.h"

#define CONSTANT(name, ...) {#name, name},
#define MEMBER(type, name) "    " #type " " #name ";\n"
#define ARG(name) "    int " #name ";\n"

struct constant {
    const char *name;
    int value;
};

/* clang-format off */
static const struct constant kinds[] = {
    SKY_KINDS(CONSTANT) SHADOW_KINDS(CONSTANT) DENSITY_KINDS(CONSTANT) TONE_MAPS(CONSTANT)
    LIGHT_KINDS(CONSTANT) VOLUME_KINDS(CONSTANT) SURFACE_MODELS(CONSTANT) FRAME_EFFECTS(CONSTANT)
    TAPE_NUMBERS(CONSTANT) TAPE_OPS(CONSTANT)
    GEOMETRY_SOURCES(CONSTANT) PASS_MODES(CONSTANT) TRANSMISSION_PHASES(CONSTANT) OUTPUTS(CONSTANT)
    CONSTANT(BLOCK_BITS) CONSTANT(BLOCK_SIDE) CONSTANT(PARAMS_ROW) CONSTANT(STACK_DEPTH)
    CONSTANT(SPECULAR_LEVELS)
    CONSTANT(STEPS_WHITE) CONSTANT(STEPS_COLORS)
    {0},
};

/* Of a program that is a part of ours. */
static const struct constant places[] = {
    UNIFORM_BLOCKS(CONSTANT) STORAGE_BLOCKS(CONSTANT) TEXTURE_UNITS(CONSTANT)
    FIELD_IMAGES(CONSTANT) STATIC_IMAGES(CONSTANT) SAMPLE_TEXTURES(CONSTANT)
    CONSTANT(GROUP_SIDE) CONSTANT(GROUP_SIZE)
    CONSTANT(DISPATCH_LOCATION) CONSTANT(ARGS_LOCATION)
    {0},
};

static const char structs[] =
    "struct Light {\n" LIGHT_MEMBERS(MEMBER) "};\n"
    "struct Volume {\n" VOLUME_MEMBERS(MEMBER) "};\n"
    "struct Camera {\n" CAMERA_MEMBERS(MEMBER) "};\n"
    "struct Dispatch {\n" DISPATCH_MEMBERS(MEMBER) "};\n";

static const char args[] =
    "struct SampleArgs {\n" SAMPLE_ARGS(ARG) "};\n"
    "struct TransmissionArgs {\n" TRANSMISSION_ARGS(ARG) "};\n"
    "struct ShadeArgs {\n" SHADE_ARGS(ARG) "};\n"
    "struct AccumulateArgs {\n" ACCUMULATE_ARGS(ARG) "};\n"
    "struct ListingArgs {\n" LISTING_ARGS(ARG) "};\n"
    "struct ResolveArgs {\n" RESOLVE_ARGS(ARG) "};\n"
    "struct TraceArgs {\n" TRACE_ARGS(ARG) "};\n";

static const char frame[] =
    FRAME_MEMBERS(MEMBER)
    "    Light lights[LIMIT_LIGHTS];\n"
    "    Volume volumes[LIMIT_VOLUMES];\n";
/* clang-format on */

/* --- layout --- */

/* What std140 asks: a member lies at a multiple of its alignment, a struct's size and alignment are
 * multiples of 16 bytes. C puts no bytes between members beyond those. */
enum {
    STD140_ROW = 16,
    STD140_float = 4,
    STD140_int = 4,
    STD140_vec2 = 8,
    STD140_ivec2 = 8,
    STD140_vec3 = 16,
    UNIFORM_BLOCK_BYTES = 16384 /* that every driver allows: MAX_UNIFORM_BLOCK_SIZE */
};

#define AT(owner, type, name)                                                                      \
    _Static_assert(offsetof(struct owner, name) % STD140_##type == 0, #owner "." #name);
#define LIGHT_AT(type, name) AT(frame_light, type, name)
#define VOLUME_AT(type, name) AT(frame_volume, type, name)
#define CAMERA_AT(type, name) AT(frame_camera, type, name)
#define FRAME_AT(type, name) AT(frame_uniforms, type, name)
#define ROWS(owner)                                                                                \
    _Static_assert(_Alignof(struct owner) == STD140_ROW, #owner " begins with no vec3");           \
    _Static_assert(sizeof(struct owner) % STD140_ROW == 0, #owner " does not fill its rows");
#define COUNTED(...) +1
#define INTEGERS(list) (sizeof(int32_t) * (0 list(COUNTED)))
#define ARGS_FIT(owner, list)                                                                      \
    _Static_assert(sizeof(struct owner) == INTEGERS(list), #owner " is no array of integers");     \
    _Static_assert(ARGS_LOCATION + (0 list(COUNTED)) <= LOCATION_COUNT, #owner " is too large");

/* clang-format off */
LIGHT_MEMBERS(LIGHT_AT)
VOLUME_MEMBERS(VOLUME_AT)
CAMERA_MEMBERS(CAMERA_AT)
FRAME_MEMBERS(FRAME_AT)
ROWS(frame_light)
ROWS(frame_volume)
ROWS(frame_camera)
ROWS(frame_uniforms)
ARGS_FIT(sample_args, SAMPLE_ARGS)
ARGS_FIT(transmission_args, TRANSMISSION_ARGS)
ARGS_FIT(shade_args, SHADE_ARGS)
ARGS_FIT(accumulate_args, ACCUMULATE_ARGS)
ARGS_FIT(listing_args, LISTING_ARGS)
ARGS_FIT(resolve_args, RESOLVE_ARGS)
ARGS_FIT(trace_args, TRACE_ARGS)
/* clang-format on */
_Static_assert(offsetof(struct frame_uniforms, lights) % STD140_ROW == 0, "lights");
_Static_assert(offsetof(struct frame_uniforms, volumes) % STD140_ROW == 0, "volumes");
_Static_assert(sizeof(struct frame_uniforms) <= UNIFORM_BLOCK_BYTES, "too large for some drivers");
_Static_assert(DISPATCH_LOCATION + (0 DISPATCH_MEMBERS(COUNTED)) <= ARGS_LOCATION,
               "members of the dispatch have the locations of args");

/* --- text --- */

static void write_constants(FILE *out, const struct constant *rows)
{
    for (; rows->name; rows++) {
        fprintf(out, "#define %s %d\n", rows->name, rows->value);
    }
}

int interface_place(const char *name)
{
    for (const struct constant *row = places; row->name; row++) {
        if (strcmp(row->name, name) == 0) {
            return row->value;
        }
    }
    return -1;
}

/* What both kinds of programs know. */
static void write_common(FILE *out, int lights, int volumes)
{
    write_constants(out, kinds);
    fprintf(out, "#define LIMIT_LIGHTS %d\n#define LIMIT_VOLUMES %d\n", lights, volumes);
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

void interface_write(FILE *out)
{
    write_common(out, LIMIT_LIGHTS, LIMIT_VOLUMES);
    write_constants(out, places);
    fprintf(out,
            "%slayout(std140, binding = BINDING_FRAME) uniform Frame {\n    Camera camera;\n%s} "
            "frame;\n"
            "#define camera frame.camera\n"
            "layout(location = DISPATCH_LOCATION) uniform Dispatch dispatch;\n",
            args, frame);
}

/* --- as constants --- */

void interface_write_float(FILE *out, float value)
{
    char text[32];
    int digits = FLT_DIG;

    if (isinf(value)) {
        fputs(value > 0 ? "INFINITY" : "-INFINITY", out);
        return;
    }
    do {
        snprintf(text, sizeof text, "%.*g", digits, (double)value);
    } while (strtof(text, NULL) != value && ++digits <= FLT_DECIMAL_DIG);
    fprintf(out, "%s%s", text, strpbrk(text, ".e") ? "" : ".0");
}

void interface_write_floats(FILE *out, const char *type, const float *values, int count)
{
    fprintf(out, "%s(", type);
    for (int i = 0; i < count; i++) {
        interface_write_float(out, values[i]);
        fputs(i + 1 < count ? ", " : ")", out);
    }
}

#define WRITE_float(value) interface_write_float(out, value);
#define WRITE_vec2(value) interface_write_floats(out, "vec2", value, 2);
#define WRITE_vec3(value) interface_write_floats(out, "vec3", value, 3);
#define WRITE_int(value) fprintf(out, "%d", value);
#define WRITE_ivec2(value) fprintf(out, "ivec2(%d, %d)", (value)[0], (value)[1]);
#define WRITE_MEMBER(type, name)                                                                   \
    fputs(first ? "" : ", ", out);                                                                 \
    first = false;                                                                                 \
    WRITE_##type(row->name)
/* A line for each. */
#define WRITE_NAMED(type, name)                                                                    \
    fputs("    ", out);                                                                            \
    WRITE_##type(row->name) fputs(", /* " #name " */\n", out);

static void write_light(FILE *out, const struct frame_light *row)
{
    bool first = true;

    fputs("Light(", out);
    LIGHT_MEMBERS(WRITE_MEMBER)
    fputs(")", out);
}

static void write_volume(FILE *out, const struct frame_volume *row)
{
    bool first = true;

    fputs("Volume(", out);
    VOLUME_MEMBERS(WRITE_MEMBER)
    fputs(")", out);
}

static void write_camera(FILE *out, const struct frame_camera *row)
{
    bool first = true;

    fputs("Camera camera = Camera(", out);
    CAMERA_MEMBERS(WRITE_MEMBER)
    fputs(");\n", out);
}

static int at_least_one(int count)
{
    return count > 0 ? count : 1;
}

void interface_write_constant(FILE *out, const struct frame_uniforms *row)
{
    const int lights = at_least_one(row->light_count), volumes = at_least_one(row->volume_count);

    write_common(out, lights, volumes);
    fprintf(out, "struct Frame {\n%s};\nconst Frame frame = Frame(\n", frame);
    FRAME_MEMBERS(WRITE_NAMED)
    fputs("    Light[](", out);
    for (int i = 0; i < lights; i++) {
        fputs(i > 0 ? ",\n            " : "", out);
        write_light(out, &row->lights[i]);
    }
    fputs("),\n    Volume[](", out);
    for (int i = 0; i < volumes; i++) {
        fputs(i > 0 ? ",\n             " : "", out);
        write_volume(out, &row->volumes[i]);
    }
    fputs("));\n", out);
    write_camera(out, &row->camera);
    fputs("Dispatch dispatch = Dispatch(ivec2(0), PASS_TILE, 0);\n", out);
}
