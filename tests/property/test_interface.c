/* SPDX-License-Identifier: MIT */
/* C and GLSL mean the same: members of the uniform block lie where the driver reads them, and every
 * row of lights, volumes and sources of hits has its kind on both sides. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <EGL/egl.h>
#include <cmocka.h>

#include "protocol/nodes.h"
#include "protocol/scene.h"
#include "renderer/draw/frame_uniforms.h"
#include "renderer/gl/pass.h"
#include "tests/support/formula.h"
#include "tests/support/json_text.h"

/* --- places --- */

struct member {
    const char *name; /* as the driver calls it */
    size_t offset;    /* of the struct in C */
};

#define FRAME_ROW(type, member) {"Frame." #member, offsetof(struct frame_uniforms, member)},
#define CAMERA_ROW(type, member)                                                                   \
    {"Frame.camera." #member, offsetof(struct frame_uniforms, camera.member)},
#define LIGHT_ROW(type, member)                                                                    \
    {"Frame.lights[0]." #member, offsetof(struct frame_uniforms, lights[0].member)},               \
        {"Frame.lights[3]." #member, offsetof(struct frame_uniforms, lights[3].member)},
#define VOLUME_ROW(type, member)                                                                   \
    {"Frame.volumes[0]." #member, offsetof(struct frame_uniforms, volumes[0].member)},             \
        {"Frame.volumes[1]." #member, offsetof(struct frame_uniforms, volumes[1].member)},

static const struct member members[] = {CAMERA_MEMBERS(CAMERA_ROW) FRAME_MEMBERS(FRAME_ROW)
                                            LIGHT_MEMBERS(LIGHT_ROW) VOLUME_MEMBERS(VOLUME_ROW)};

static GLint driver_offset(GLuint program, const char *name)
{
    const PFNGLGETUNIFORMINDICESPROC indices =
        (PFNGLGETUNIFORMINDICESPROC)eglGetProcAddress("glGetUniformIndices");
    const PFNGLGETACTIVEUNIFORMSIVPROC ask =
        (PFNGLGETACTIVEUNIFORMSIVPROC)eglGetProcAddress("glGetActiveUniformsiv");
    GLuint index = GL_INVALID_INDEX;
    GLint offset = -1;

    indices(program, 1, &name, &index);
    if (index == GL_INVALID_INDEX) {
        fail_msg("the driver knows no %s", name);
    }
    ask(program, 1, &index, GL_UNIFORM_OFFSET, &offset);
    return offset;
}

static void members_lie_where_the_driver_reads_them(void **state)
{
    static const char text[] = "#include \"frame.glsl\"\n"
                               "layout(local_size_x = 1) in;\n"
                               "layout(std430, binding = 0) buffer Out { float answer; };\n"
                               "void main()\n{\n    answer = frame.exposure;\n}\n";
    const struct glsl_file own[] = {{"layout.glsl", text}, {NULL, NULL}};
    struct pass pass;
    struct error err = {0};

    (void)state;
    if (!pass_init(&pass, formula_gl(), &(struct pass_source){true, NULL, "layout.glsl", own},
                   &err)) {
        fail_msg("%s: %s", err.place, err.message);
    }
    for (size_t i = 0; i < sizeof members / sizeof members[0]; i++) {
        const GLint offset = driver_offset(pass.program, members[i].name);
        if (offset != (GLint)members[i].offset) {
            fail_msg("%s lies at %zu in C, at %d in the driver", members[i].name, members[i].offset,
                     offset);
        }
    }
    pass_finish(&pass, formula_gl());
}

/* --- rows --- */

/* A scene with one resource of a type. */
static struct frame_uniforms block_of(const char *list, const char *type)
{
    char text[256];
    struct frame_uniforms block;

    snprintf(text, sizeof text,
             "{'format': 'fieldcast/1', '%s': [{'type': '%s'}], 'root': {'type': 'sphere'}}", list,
             type);
    struct scene *scene = json_text_valid_scene(text);
    frame_uniforms_set_scene(&block, scene, &(struct scene_bounds){.scale = 1});
    scene_destroy(scene);
    return block;
}

/* Right in front of each light, where whatever kind it is gives light. */
static void every_type_of_light_gives_light(void **state)
{
    static const char ask[] = "#include \"lights.glsl\"\n"
                              "vec4 ask(vec4 a, vec4 b, vec4 c)\n{\n"
                              "    Light light;\n"
                              "    light.position = a.xyz;\n    light.kind = int(a.w);\n"
                              "    light.color = vec3(1.0);\n    light.radius = 0.1;\n"
                              "    light.range = 0.0;\n    light.axis = b.xyz;\n"
                              "    light.rim_cosine = c.x;\n    light.fade_cosine = c.y;\n"
                              "    return vec4(incoming(light, a.xyz + b.xyz).color, 0.0);\n}\n";
    size_t count = 0;

    (void)state;
    for (; light_types[count].name; count++) {
        const struct frame_uniforms block = block_of("lights", light_types[count].name);
        const struct frame_light *light = &block.lights[0];
        struct formula_row row = {.b = {0, -1, 0}, .c = {light->rim_cosine, light->fade_cosine}};

        assert_int_equal(block.light_count, 1);
        assert_int_equal(light->kind, count);
        memcpy(row.a, light->position, sizeof light->position);
        row.a[3] = (float)light->kind;
        formula_run(ask, &row, 1);
        if (row.out[0] != 1) {
            fail_msg("a %s light gives %g at the distance 1", light_types[count].name, row.out[0]);
        }
    }
    assert_int_equal(count, LIGHT_KIND_COUNT);
}

static void every_type_of_volume_has_its_extent(void **state)
{
    size_t count = 0;

    (void)state;
    for (; volume_types[count].name; count++) {
        const struct frame_uniforms block = block_of("volumes", volume_types[count].name);

        assert_int_equal(block.volume_count, 1);
        assert_int_equal(block.volumes[0].kind,
                         count == VOLUME_BOX ? VOLUME_BOX : VOLUME_ELLIPSOID);
        assert_true(block.volumes[0].extent[0] > 0);
    }
    assert_int_equal(count, VOLUME_KIND_COUNT);
}

#define SOURCE_ROW(source) {.a = {source}},

/* Carried beside the most steps that a ray may take. */
static void every_source_of_hits_has_a_surface(void **state)
{
    static const char ask[] =
        "#include \"gbuffer.glsl\"\n#include \"surface_of.glsl\"\n"
        "vec4 ask(vec4 a, vec4 b, vec4 c)\n{\n"
        "    Surface s = surface_nothing();\n    float word = steps_pack(65535, int(a.x));\n"
        "    surface_of(steps_source(word), b.xyz,\n"
        "               Shading(b.xyz, vec3(0.0), c.xyz, c.xyz, 0.0), s);\n"
        "    return vec4(float(s.id), float(steps_source(word)), float(steps_count(word)), 0.0);\n"
        "}\n";
    struct formula_row rows[] = {GEOMETRY_SOURCES(SOURCE_ROW)};
    const size_t count = sizeof rows / sizeof rows[0];

    (void)state;
    formula_run(ask, rows, count);
    for (size_t i = 0; i < count; i++) {
        assert_true(rows[i].out[0] > 0);
        assert_true(rows[i].out[1] == rows[i].a[0]);
        assert_true(rows[i].out[2] == 65535);
    }
}

/* --- texts --- */

/* A file with main() around it, and what it leaves to the pass that includes it. */
static void write_alone(const char *name, char *out, size_t size)
{
    static const char store[] = "#include \"sample_sink.glsl\"\n";
    static const char place[] = "int material_place(float slot) { return 0; }\n";
    static const char kernels[] = "float shape_of(int kind, vec3 p) { return 0.0; }\n"
                                  "float combine_of(int kind, float a, float b) { return a; }\n"
                                  "float share_of(int kind, float a, float b) { return a; }\n"
                                  "float change_of(int kind, float d) { return d; }\n"
                                  "vec3 warp_of(int kind, vec3 p) { return p; }\n"
                                  "float after_of(int kind, float d, vec3 p) { return d; }\n"
                                  "vec3 first_of(int kind, vec3 p) { return p; }\n"
                                  "vec3 last_of(int kind, vec3 p) { return p; }\n"
                                  "vec3 cell_of(int kind, vec3 p, vec3 cell) { return p; }\n";

    const struct {
        const char *name, *rest;
    } rows[] = {{"materials.glsl", place},       {"tapes_run.glsl", kernels},
                {"tapes_surface.glsl", kernels}, {"secondary_rays.glsl", store},
                {"shade.glsl", store},           {"shadow.glsl", store},
                {"visibility_mean.glsl", store}, {"volume.glsl", store}};
    const char *rest = "";

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        rest = strcmp(name, rows[i].name) == 0 ? rows[i].rest : rest;
    }
    snprintf(out, size, "#include \"%s\"\n%svoid main() {}\n", name, rest);
}

static void each_file_is_whole_by_itself(void **state)
{
    static const char map[] = "#include \"field.glsl\"\nfloat map(vec3 p) { return 0.0; }\n";
    static const char defines[] = "#define PARAMS_COUNT 1\n#define TAPE_POINTS 1\n"
                                  "#define TAPE_DISTANCES 1\n#define TAPE_LOOPS 1\n"
                                  "#define TAPE_CELLS 1\n";
    static const char surface[] =
        "#include \"mixture.glsl\"\nvoid surface(vec3 p, Shading at, out Surface s) {}\n";

    (void)state;
    for (const struct glsl_file *file = glsl_files; file->name; file++) {
        char text[1024];
        const bool pass = strstr(file->name, "_pass.glsl");
        const bool main =
            pass || strcmp(file->name, "resolve.glsl") == 0 || strcmp(file->name, "full.glsl") == 0;
        const bool browser = strstr(file->name, "webgl_"); /* another language: e2e/webgl */
        write_alone(file->name, text, sizeof text);
        const struct glsl_file own[] = {{"field_map.glsl", map},
                                        {"field_surface.glsl", surface},
                                        {"alone.glsl", text},
                                        {NULL, NULL}};
        const struct pass_source source = {false, defines, "alone.glsl", own};
        struct pass linked;
        struct error err = {0};

        if (!main && !browser && !strstr(file->name, "group.glsl") &&
            !pass_init(&linked, formula_gl(), &source, &err)) {
            fail_msg("%s alone: %s: %s", file->name, err.place, err.message);
        }
        pass_finish(&linked, formula_gl());
    }
}

static void an_unknown_file_is_told(void **state)
{
    const struct glsl_file own[] = {{"a.glsl", "#include \"nowhere.glsl\"\n"}, {NULL, NULL}};
    struct shader_text text;
    struct error err = {0};

    (void)state;
    assert_false(include_resolve(&text, "", "a.glsl", own, &err));
    assert_string_equal(err.place, "nowhere.glsl");
}

static void lines_keep_their_numbers(void **state)
{
    const struct glsl_file own[] = {
        {"a.glsl", "one\n#include \"b.glsl\"\n#include \"b.glsl\"\nfour\n"},
        {"b.glsl", "first\n"},
        {NULL, NULL}};
    struct shader_text text;
    struct error err = {0};

    (void)state;
    assert_true(include_resolve(&text, "head\n", "a.glsl", own, &err));
    assert_string_equal(text.text,
                        "head\n\n#line 1 0\none\n\n#line 1 1\nfirst\n\n#line 3 0\n\nfour\n");
    assert_int_equal(text.count, 2);
    assert_string_equal(text.names[1], "b.glsl");
    include_finish(&text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(members_lie_where_the_driver_reads_them),
        cmocka_unit_test(every_type_of_light_gives_light),
        cmocka_unit_test(every_type_of_volume_has_its_extent),
        cmocka_unit_test(every_source_of_hits_has_a_surface),
        cmocka_unit_test(each_file_is_whole_by_itself),
        cmocka_unit_test(an_unknown_file_is_told),
        cmocka_unit_test(lines_keep_their_numbers),
    };

    return cmocka_run_group_tests(tests, formula_start, formula_end);
}
