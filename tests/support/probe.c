/* SPDX-License-Identifier: MIT */
/* Points in, distances and surfaces out, through a compute shader. */
#include "probe.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "renderer/field/shader.h"
#include "renderer/gl/pass.h"

enum { POINTS, NUMBERS, ANSWERS, GROUP = 64, ANSWER_VEC4S = 1 + FIELD_MATERIAL_VEC4S };

bool probe_init(struct probe *probe, struct error *err)
{
    const struct device_params params = {.index = -1};

    *probe = (struct probe){0};
    if (!egl_init(&probe->egl, &params, err)) {
        return false;
    }
    if (!gl_load(&probe->gl, err)) {
        egl_finish(&probe->egl);
        return false;
    }
    probe->gl.GenBuffers(3, probe->buffers);
    probe->gl.GenTextures(2, probe->views);
    return gl_check(&probe->gl, "probe", err);
}

void probe_finish(struct probe *probe)
{
    probe->gl.DeleteTextures(2, probe->views);
    probe->gl.DeleteBuffers(3, probe->buffers);
    egl_finish(&probe->egl);
}

/* --- the text --- */

static const char head_block[] =
    "layout(std140, binding = 1) uniform Numbers { vec4 numbers[COUNT]; };\n"
    "#define AT(i) numbers[i]\n";
static const char head_texture[] = "layout(binding = 1) uniform samplerBuffer numbers;\n"
                                   "#define AT(i) texelFetch(numbers, i)\n";
static const char head_access[] = "int first_number;\n"
                                  "#define P_ANY(i) AT(first_number + (i))\n"
                                  "#define P_FROM(i) P_ANY(i)\n"
                                  "#define P(i) AT(FIRST + (i))\n";
static const char head[] =
    "#include \"field.glsl\"\n#include \"mixture.glsl\"\n"
    "#define zero 0\nlayout(local_size_x = GROUP) in;\n"
    "layout(binding = 0) uniform samplerBuffer points;\n"
    "layout(std430, binding = 0) writeonly buffer Answers { vec4 answers[]; };\n";

/* The functions of one field, with its place in the list at the end of their names. */
static void write_field(FILE *out, const struct field *field, size_t index, size_t first,
                        bool surface)
{
    static const char *const names[] = {"map", "surface"};

    for (size_t i = 0; i < 2; i++) {
        fprintf(out, "#undef %s\n#define %s %s_%zu\n", names[i], names[i], names[i], index);
    }
    fprintf(out, "#undef FIRST\n#define FIRST %zu\n", first);
    char *map = shader_map(field), *at_hit = surface ? shader_surface(field) : memory_text("");
    fprintf(out, "%s%s", map, at_hit);
    free(map);
    free(at_hit);
}

static void write_question(FILE *out, size_t index, size_t first, bool surface)
{
    fprintf(out, "first_number = %zu;\nanswers[at] = vec4(map_%zu(p), 0.0, 0.0, 0.0);\n", first,
            index);
    if (surface) {
        fprintf(out,
                "surface_%zu(p, Shading(p, p, p, p, 0.0), s);\nanswers[at].y = float(s.id);\n"
                "answers[at + 1u] = vec4(s.diffuse, s.gloss);\n"
                "answers[at + 2u] = vec4(s.specular, 0.0);\n"
                "answers[at + 3u] = vec4(s.emission, 0.0);\n"
                "answers[at + 4u] = vec4(s.ambient, 0.0);\n"
                "answers[at + 5u] = vec4(s.reflectivity, s.transmission, s.ior, s.model);\n"
                "answers[at + 6u] = vec4(s.absorption, 0.0);\n",
                index);
    }
    fprintf(out, "at += %du * count;\n", ANSWER_VEC4S);
}

static char *program_text(struct field *const *fields, size_t count, bool surface, float field_mask)
{
    char *text;
    size_t length, numbers;
    FILE *out = open_memstream(&text, &length);

    if (!out) {
        abort();
    }
    fputs(head, out);
    numbers = 0;
    for (size_t i = 0; i < count; i++) {
        write_field(out, fields[i], i, numbers, surface);
        numbers += fields[i]->vec4_count;
    }
    fprintf(out,
            "void main()\n{\nint i = int(gl_GlobalInvocationID.x);\n"
            "uint count = gl_NumWorkGroups.x * uint(GROUP);\n"
            "uint at = %du * uint(i);\nSurface s;\n"
            "vec3 p = vec3(texelFetch(points, 3 * i).r, texelFetch(points, 3 * i + 1).r,\n"
            "              texelFetch(points, 3 * i + 2).r);\n"
            "field_mask = float(%.9g);\n",
            ANSWER_VEC4S, (double)field_mask);
    numbers = 0;
    for (size_t i = 0; i < count; i++) {
        write_question(out, i, numbers, surface);
        numbers += fields[i]->vec4_count;
    }
    fprintf(out, "}\n");
    fclose(out);
    return text;
}

/* --- the program --- */

static char *make_defines(struct field *const *fields, size_t count)
{
    size_t numbers = 0;
    bool shaders = false;
    char *text;

    for (size_t i = 0; i < count; i++) {
        numbers += fields[i]->vec4_count;
        shaders = shaders || fields[i]->shader_count > 0;
    }
    if (asprintf(&text, "#define GROUP %d\n#define COUNT %zu\n%s", GROUP, numbers,
                 shaders ? "#define USER_SHADERS\n" : "") < 0) {
        abort();
    }
    return text;
}

bool probe_program_init(struct probe_program *program, const struct probe *probe,
                        struct field *const *fields, size_t count, bool surface, bool in_block,
                        struct error *err)
{
    char *defines = make_defines(fields, count), *numbers;
    char *text = program_text(fields, count, surface, probe->field_mask);
    struct pass pass = {0};

    if (asprintf(&numbers, "%s%s", in_block ? head_block : head_texture, head_access) < 0) {
        abort();
    }
    const struct glsl_file own[] = {{"probe.glsl", text}, {"params.glsl", numbers}, {NULL, NULL}};
    const struct pass_source source = {true, defines, "probe.glsl", own};
    const bool ok = pass_init(&pass, &probe->gl, &source, err);
    *program = (struct probe_program){.program = pass.program, .surface = surface};
    free(numbers);
    free(text);
    free(defines);
    return ok;
}

void probe_program_finish(struct probe_program *program, const struct probe *probe)
{
    probe->gl.DeleteProgram(program->program);
    program->program = 0;
}

/* --- a run --- */

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

static void set_numbers(const struct probe *probe, struct field *const *fields, size_t count)
{
    size_t vec4s = 0;

    for (size_t i = 0; i < count; i++) {
        vec4s += fields[i]->vec4_count;
    }
    float *all = memory_alloc(vec4s, 4 * sizeof *all), *to = all;
    for (size_t i = 0; i < count; i++) {
        memcpy(to, fields[i]->params, fields[i]->vec4_count * 4 * sizeof *all);
        to += 4 * fields[i]->vec4_count;
    }
    set_buffer(probe, NUMBERS, GL_RGBA32F, all, vec4s * 4 * sizeof *all);
    probe->gl.BindBufferBase(GL_UNIFORM_BUFFER, 1, probe->buffers[NUMBERS]);
    free(all);
}

static void read_answer(const float *from, bool surface, struct probe_answer *out)
{
    *out = (struct probe_answer){.distance = from[0]};
    if (surface) {
        out->leaf = (uint32_t)from[1];
        memcpy(out->material, from + 4, sizeof out->material);
    }
}

void probe_run(const struct probe *probe, const struct probe_program *program,
               struct field *const *fields, size_t count, const float (*points)[3],
               size_t point_count, struct probe_answer *out)
{
    const struct gl *gl = &probe->gl;
    const size_t groups = (point_count + GROUP - 1) / GROUP, all = groups * GROUP;
    const size_t bytes = count * all * ANSWER_VEC4S * 4 * sizeof(float);

    float(*padded)[3] = memory_alloc(all, sizeof *padded);
    memcpy(padded, points, point_count * sizeof *points);
    set_buffer(probe, POINTS, GL_R32F, padded, all * sizeof *padded);
    free(padded);
    set_numbers(probe, fields, count);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, probe->buffers[ANSWERS]);
    gl->BufferData(GL_SHADER_STORAGE_BUFFER, (GLsizeiptr)bytes, NULL, GL_STREAM_READ);
    gl->UseProgram(program->program);
    gl->DispatchCompute((GLuint)groups, 1, 1);
    gl->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const float *answers =
        gl->MapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, (GLsizeiptr)bytes, GL_MAP_READ_BIT);
    for (size_t i = 0; i < count * point_count; i++) {
        const size_t at = i / point_count * all + i % point_count;
        read_answer(answers + at * ANSWER_VEC4S * 4, program->surface, &out[i]);
    }
    gl->UnmapBuffer(GL_SHADER_STORAGE_BUFFER);
}

bool probe_agrees(const struct field *field, const float point[3],
                  const struct probe_answer *answer)
{
    const double p[3] = {point[0], point[1], point[2]};

    for (int corner = -1; corner < 8; corner++) {
        double q[3];
        for (int j = 0; j < 3; j++) {
            q[j] = p[j] + (corner < 0 ? 0 : (corner >> j & 1) ? 1e-4 : -1e-4);
        }
        struct field_surface want = field_surface(field, q, NULL);
        bool same = want.number == answer->leaf;
        for (int j = 0; j < FIELD_MATERIAL_NUMBERS; j++) {
            /* Blends as narrow as 0.15 change by 1/(2k) per unit; the numbers are up to 4. */
            same = same && fabs(want.material[j] - answer->material[j]) <= 0.01;
        }
        if (same) {
            return true;
        }
    }
    return false;
}
