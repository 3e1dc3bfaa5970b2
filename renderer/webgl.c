/* SPDX-License-Identifier: MIT */
/* A picture as the text of one shader: the shaders' own files, with texts in place of those that
 * read textures and buffers. All numbers are constants, the field is not interpreted, nothing is
 * pruned, and no texture is read. */
#include <stdlib.h>

#include "renderer.h"
#include "renderer/draw/environment.h"
#include "renderer/engine/engine.h"
#include "renderer/field/shader.h"
#include "renderer/glsl/include.h"
#include "renderer/glsl/reach.h"
#include "renderer/image/half.h"
#include "snapshot.h"

/* A text that is being written. */
struct text {
    char *bytes;
    size_t length;
    FILE *out;
};

static void text_begin(struct text *text)
{
    *text = (struct text){0};
    text->out = open_memstream(&text->bytes, &text->length);
    if (!text->out) {
        abort();
    }
}

static char *text_end(struct text *text)
{
    if (fclose(text->out) != 0) {
        abort();
    }
    return text->bytes;
}

static char *write_interface(const struct frame_uniforms *frame)
{
    struct text text;

    text_begin(&text);
    interface_write_constant(text.out, frame);
    return text_end(&text);
}

static char *write_params(const struct field *field)
{
    struct text text;

    text_begin(&text);
    fputs("#define P(i) params[i]\n#define P_ANY(i) params[i]\n#define P_FROM(i) params[i]\n"
          "void preload() {}\n"
          "const vec4 params[] = vec4[](\n    ",
          text.out);
    for (size_t i = 0; i < field->vec4_count; i++) {
        interface_write_floats(text.out, "vec4", field->params + 4 * i, 4);
        fputs(i + 1 < field->vec4_count ? ",\n    " : ");\n", text.out);
    }
    return text_end(&text);
}

/* --- the environment's maps --- */

/* What a directional light makes of a black sky. */
static struct frame_uniforms sun_alone(const struct frame_uniforms *frame)
{
    struct frame_uniforms block = {
        .sky_kind = SKY_GRADIENT, .effects = EFFECT_SUN, .light_count = 1};

    block.max_steps = frame->max_steps;
    block.lights[0] =
        (struct frame_light){.kind = LIGHT_DIRECTIONAL, .position = {0, 1, 0}, .color = {1, 1, 1}};
    return block;
}

/* A column of a map that is the same all around: `count` rows. */
static void write_column(FILE *out, const struct engine_map *map, int level, bool last)
{
    const int width = engine_map_side(map->width, level);
    const int height = engine_map_side(map->height, level);

    for (int y = 0; y < height; y++) {
        const uint16_t *texel = map->texels[level] + (size_t)4 * (size_t)y * (size_t)width;
        const float color[3] = {half_value(texel[0]), half_value(texel[1]), half_value(texel[2])};

        fputs("    ", out);
        interface_write_floats(out, "vec3", color, 3);
        fputs(last && y == height - 1 ? ");\n" : ",\n", out);
    }
}

/* The specular map for each roughness, then the irradiance. */
static void write_columns(FILE *out, const char *name, const struct frame_uniforms *frame)
{
    struct engine_map maps[ENGINE_MAPS];

    engine_maps_make_columns(frame, maps);
    fprintf(out,
            "#define SPECULAR_ROWS %d\n#define IRRADIANCE_ROWS %d\nconst vec3 %s[] = vec3[](\n",
            maps[1].height, maps[2].height, name);
    for (int level = 0; level < SPECULAR_LEVELS; level++) {
        write_column(out, &maps[1], level, false);
    }
    write_column(out, &maps[2], 0, true);
    engine_maps_finish(maps);
}

static const struct frame_light *sun_of(const struct frame_uniforms *frame)
{
    for (int i = 0; i < frame->light_count && (frame->effects & EFFECT_SUN); i++) {
        if (frame->lights[i].kind == LIGHT_DIRECTIONAL) {
            return &frame->lights[i];
        }
    }
    return NULL;
}

/* A gradient is the same all around the vertical, the sun's glow around its direction, and so are
 * their means over lobes: a column of each is enough. */
static void write_gradient(FILE *out, const struct frame_uniforms *frame)
{
    const struct frame_light *sun = sun_of(frame);
    struct frame_uniforms plain = *frame;

    plain.effects &= ~EFFECT_SUN;
    write_columns(out, "sky_column", &plain);
    if (sun) {
        const struct frame_uniforms alone = sun_alone(frame);
        write_columns(out, "sun_column", &alone);
        fputs("#define SUN ", out);
        interface_write_floats(out, "vec3", sun->position, 3);
        fputs("\n#define SUN_COLOR ", out);
        interface_write_floats(out, "vec3", sun->color, 3);
        fputs("\n", out);
    }
    fputs("#include \"webgl_sky.glsl\"\n", out);
}

static char *write_maps(const struct frame_uniforms *frame)
{
    static const char one_color[] =
        "vec3 sample_specular_map(vec3 d, float level)\n{\n"
        "    return frame.zenith;\n}\n"
        "vec3 sample_irradiance_map(vec3 n)\n{\n    return frame.zenith;\n}\n";
    struct text text;

    text_begin(&text);
    fputs("vec3 sample_environment_map(vec3 d, float blur)\n{\n    return frame.zenith;\n}\n",
          text.out);
    if (frame->sky_kind == SKY_GRADIENT) {
        write_gradient(text.out, frame);
    } else {
        fputs(one_color, text.out);
    }
    return text_end(&text);
}

/* --- the whole text --- */

static void define_if(FILE *out, const char *name, bool wanted)
{
    if (wanted) {
        fprintf(out, "#define %s\n", name);
    }
}

static char *write_head(const struct field *field, const struct frame_uniforms *frame,
                        const struct render_settings *settings, const double target[3])
{
    struct text text;

    const int transmission_depth = frame->has_transmissive ? settings->transmission_depth : 0;

    text_begin(&text);
    fputs("#version 300 es\nprecision highp float;\nprecision highp int;\n\n"
          "/* A picture of a scene of fieldcast. Draw one triangle over all pixels, after setting\n"
          " * `resolution`; `orbit` may stay 0. */\n",
          text.out);
    fprintf(text.out, "#define SAMPLES %d\n#define RAYS %d\n#define TRANSMISSION_DEPTH %d\n",
            settings->samples, settings->rays, transmission_depth);
    define_if(text.out, "OPAQUE", transmission_depth == 0);
    define_if(text.out, "PLAIN", !settings->reflective);
    define_if(text.out, "USER_SHADERS", field->shader_count > 0);
    define_if(text.out, "VOLUMES", settings->volumes);
    fputs("#define TARGET ", text.out);
    interface_write_floats(
        text.out, "vec3", (const float[]){(float)target[0], (float)target[1], (float)target[2]}, 3);
    fputs("\n", text.out);
    return text_end(&text);
}

/* `target`: what the camera turns around. NULL and `err` where a file is missing. */
static char *write_text(const struct field *field, const struct frame_uniforms *frame,
                        const struct render_settings *settings, const double target[3],
                        struct error *err)
{
    char *head = write_head(field, frame, settings, target), *map = shader_map(field);
    char *surface = shader_surface(field), *params = write_params(field);
    char *interface = write_interface(frame), *maps = write_maps(frame);
    const struct glsl_file own[] = {
        {"field_map.glsl", map}, {"field_surface.glsl", surface}, {"params.glsl", params},
        {"sky_maps.glsl", maps}, {"interface.glsl", interface},   {NULL, NULL},
    };
    struct shader_text whole;
    struct text text;
    const bool ok = include_resolve(&whole, head, "webgl_pass.glsl", own, err);

    if (ok) {
        text_begin(&text);
        glsl_write_reached(text.out, whole.text);
        include_finish(&whole);
    }
    free(head);
    free(map);
    free(surface);
    free(params);
    free(interface);
    free(maps);
    return ok ? text_end(&text) : NULL;
}

/* The text holds all numbers, and compilers of browsers take so many. */
static bool has_room(const struct field *field, struct error *err)
{
    for (size_t i = 0; i < field->instruction_count; i++) {
        if (field->instructions[i].choices == FIELD_PATCHES) {
            return error_set(err, ERROR_LIMIT, "",
                             "the patches of a parametric surface are too many numbers for the "
                             "text of a shader");
        }
    }
    return true;
}

char *renderer_webgl(const struct scene *scene, int level, struct error *err)
{
    struct field *field = field_compile(scene, err);
    struct error warning;
    char *text = NULL;

    if (field && has_room(field, err) && field_try(field, &warning, err)) {
        const struct scene_bounds extent =
            snapshot_bounds(&(struct geometry){.field = field}, &scene->camera, false);
        /* Of any size: the shader is told which. */
        const struct camera camera = camera_from_record(&scene->camera, 1, 1);
        struct frame_uniforms frame;
        struct render_settings settings;

        frame_uniforms_set_scene(&frame, scene, &extent);
        frame_uniforms_set_camera(&frame, &camera, 1, 1);
        if (frame.sky_kind == SKY_IMAGE) {
            environment_leave_out(&frame);
        }
        render_settings_make(&settings, &frame, &scene->render,
                             &(struct settings_request){.level = level, .transparent = 0}, &extent);
        text = write_text(field, &frame, &settings, record_vector(&scene->camera, "target"), err);
    }
    field_unref(field);
    return text;
}
