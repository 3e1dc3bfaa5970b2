/* SPDX-License-Identifier: MIT */
/* Points in, distances and surfaces out, through a fragment shader. */
#include "probe.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "renderer/field/shader.h"
#include "renderer/glsl.h"

enum { UNIT_POINTS = 0, UNIT_NUMBERS = 1, LOG_BYTES = 4096 };

static const char *glsl_text(const char *name)
{
    for (const struct glsl_file *file = glsl_files; file->name; file++) {
        if (strcmp(file->name, name) == 0) {
            return file->text;
        }
    }
    abort();
}

bool probe_init(struct probe *probe, struct error *err)
{
    static const GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                         GL_COLOR_ATTACHMENT2, GL_COLOR_ATTACHMENT3,
                                         GL_COLOR_ATTACHMENT4};
    const struct renderer_params params = {.device_index = -1};
    *probe = (struct probe){0};
    if (!egl_init(&probe->egl, &params, err)) {
        return false;
    }
    if (!gl_load(&probe->gl, err)) {
        egl_finish(&probe->egl);
        return false;
    }
    const struct gl *gl = &probe->gl;
    gl->GenVertexArrays(1, &probe->vertex_array);
    gl->BindVertexArray(probe->vertex_array);
    gl->GenTextures(5, probe->targets);
    gl->GenFramebuffers(1, &probe->framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, probe->framebuffer);
    for (int i = 0; i < 5; i++) {
        gl->BindTexture(GL_TEXTURE_2D, probe->targets[i]);
        gl->TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, PROBE_SIDE, PROBE_SIDE);
        gl->FramebufferTexture2D(GL_FRAMEBUFFER, attachments[i], GL_TEXTURE_2D, probe->targets[i],
                                 0);
    }
    gl->DrawBuffers(5, attachments);
    gl->Viewport(0, 0, PROBE_SIDE, PROBE_SIDE);
    gl->GenBuffers(2, probe->buffers);
    gl->GenTextures(2, probe->views);
    return gl_check(gl, "probe", err);
}

void probe_finish(struct probe *probe)
{
    const struct gl *gl = &probe->gl;
    gl->DeleteTextures(5, probe->targets);
    gl->DeleteTextures(2, probe->views);
    gl->DeleteBuffers(2, probe->buffers);
    gl->DeleteFramebuffers(1, &probe->framebuffer);
    gl->DeleteVertexArrays(1, &probe->vertex_array);
    egl_finish(&probe->egl);
}

static GLuint compile(const struct gl *gl, GLenum stage, const char *const *texts, int count,
                      struct error *err)
{
    GLuint shader = gl->CreateShader(stage);
    GLint ok = 0;
    gl->ShaderSource(shader, count, texts, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        char log[LOG_BYTES] = "";
        gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
        error_set(err, ERROR_COMPILE, "", "%.300s", log);
        gl->DeleteShader(shader);
        return 0;
    }
    return shader;
}

static GLuint link_program(const struct gl *gl, GLuint vertex, GLuint fragment, struct error *err)
{
    GLuint program = gl->CreateProgram();
    GLint ok = 0;
    gl->AttachShader(program, vertex);
    gl->AttachShader(program, fragment);
    gl->LinkProgram(program);
    gl->GetProgramiv(program, GL_LINK_STATUS, &ok);
    if (!ok) {
        char log[LOG_BYTES] = "";
        gl->GetProgramInfoLog(program, sizeof log, NULL, log);
        error_set(err, ERROR_COMPILE, "", "%.300s", log);
        gl->DeleteProgram(program);
        return 0;
    }
    return program;
}

static const char head_block[] =
    "layout(std140, binding = 1) uniform Numbers { vec4 numbers[COUNT]; };\n"
    "#define N(i) numbers[i]\n#define N_ANY(i) numbers[i]\n";
static const char head_texture[] = "layout(binding = 1) uniform samplerBuffer numbers;\n"
                                   "#define N(i) texelFetch(numbers, i)\n"
                                   "#define N_ANY(i) texelFetch(numbers, i)\n";
static const char main_text[] =
    "layout(binding = 0) uniform samplerBuffer points;\n"
    "layout(location = 0) out vec4 o0;\nlayout(location = 1) out vec4 o1;\n"
    "layout(location = 2) out vec4 o2;\nlayout(location = 3) out vec4 o3;\n"
    "layout(location = 4) out vec4 o4;\n"
    "void main()\n{\n"
    "int i = int(gl_FragCoord.y) * SIDE + int(gl_FragCoord.x);\n"
    "vec3 p = vec3(texelFetch(points, 3 * i).r, texelFetch(points, 3 * i + 1).r,\n"
    "              texelFetch(points, 3 * i + 2).r);\n"
    "Surface s;\nsurface(p, Shading(p, p, p, p, 0.0), s);\n"
    "o0 = vec4(map(p), float(s.id), 0.0, 0.0);\n"
    "o1 = vec4(s.diffuse, s.shininess);\no2 = vec4(s.specular, 0.0);\n"
    "o3 = vec4(s.emission, 0.0);\no4 = vec4(s.ambient, 0.0);\n}\n";
static const char no_surface[] = "void surface(vec3 p, Shading at, out Surface s)\n{\n"
                                 "s.id = 0u;\ns.shininess = 0.0;\ns.diffuse = s.specular ="
                                 " s.emission = s.ambient = vec3(0.0);\n}\n";

bool probe_program_init(struct probe_program *program, const struct probe *probe,
                        const struct field *field, bool surface, bool in_texture, struct error *err)
{
    const struct gl *gl = &probe->gl;
    static const char version[] = "#version 430 core\n";
    char head[128];
    snprintf(head, sizeof head, "#define SIDE %d\n#define COUNT %zu\n%s", PROBE_SIDE,
             field->vec4_count, field->shader_count > 0 ? "#define USER_SHADERS\n" : "");
    char *map = shader_map(field);
    char *surface_text = surface ? shader_surface(field) : memory_text(no_surface);
    const char *const vertex_texts[] = {version, glsl_text("full.glsl")};
    static const char *const files[] = {FIELD_GLSL_FILES};
    enum { FILES = sizeof files / sizeof files[0], BEFORE = 4, ALL = BEFORE + FILES + 3 };
    const char *texts[ALL] = {version, head, in_texture ? head_texture : head_block,
                              glsl_text("surface.glsl")};
    for (int i = 0; i < FILES; i++) {
        texts[BEFORE + i] = glsl_text(files[i]);
    }
    texts[ALL - 3] = map, texts[ALL - 2] = surface_text, texts[ALL - 1] = main_text;
    GLuint vertex = compile(gl, GL_VERTEX_SHADER, vertex_texts, 2, err);
    GLuint fragment = vertex ? compile(gl, GL_FRAGMENT_SHADER, texts, ALL, err) : 0;
    program->program = fragment ? link_program(gl, vertex, fragment, err) : 0;
    gl->DeleteShader(vertex);
    gl->DeleteShader(fragment);
    free(map);
    free(surface_text);
    return program->program != 0;
}

void probe_program_finish(struct probe_program *program, const struct probe *probe)
{
    probe->gl.DeleteProgram(program->program);
    program->program = 0;
}

static void set_buffer(const struct probe *probe, int unit, GLenum format, const void *data,
                       size_t bytes)
{
    const struct gl *gl = &probe->gl;
    gl->BindBuffer(GL_TEXTURE_BUFFER, probe->buffers[unit]);
    gl->BufferData(GL_TEXTURE_BUFFER, (GLsizeiptr)bytes, data, GL_STREAM_DRAW);
    gl->ActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    gl->BindTexture(GL_TEXTURE_BUFFER, probe->views[unit]);
    gl->TexBuffer(GL_TEXTURE_BUFFER, format, probe->buffers[unit]);
}

static void read_target(const struct probe *probe, int target, float *pixels)
{
    probe->gl.ReadBuffer(GL_COLOR_ATTACHMENT0 + (GLenum)target);
    probe->gl.ReadPixels(0, 0, PROBE_SIDE, PROBE_SIDE, GL_RGBA, GL_FLOAT, pixels);
}

void probe_run(const struct probe *probe, const struct probe_program *program,
               const struct field *field, const float (*points)[3], size_t count, int repeat,
               struct probe_answer *out)
{
    const struct gl *gl = &probe->gl;
    float *all = memory_alloc(PROBE_POINTS_MAX, 3 * sizeof(float));
    memcpy(all, points, count * sizeof *points);
    set_buffer(probe, UNIT_POINTS, GL_R32F, all, PROBE_POINTS_MAX * sizeof *points);
    free(all);
    set_buffer(probe, UNIT_NUMBERS, GL_RGBA32F, field->numbers,
               field->vec4_count * 4 * sizeof(float));
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 1, probe->buffers[UNIT_NUMBERS]);
    gl->UseProgram(program->program);
    for (int i = 0; i < 1 + repeat; i++) {
        gl->DrawArrays(GL_TRIANGLES, 0, 3);
    }
    float *pixels = memory_alloc(PROBE_POINTS_MAX, 4 * sizeof(float));
    for (int target = 0; target < 5 && out; target++) {
        read_target(probe, target, pixels);
        for (size_t i = 0; i < count; i++) {
            if (target == 0) {
                out[i].distance = pixels[4 * i];
                out[i].leaf = (uint32_t)pixels[4 * i + 1];
            } else {
                memcpy(out[i].material + 4 * (target - 1), pixels + 4 * i, 4 * sizeof(float));
            }
        }
    }
    gl->Finish();
    free(pixels);
}
