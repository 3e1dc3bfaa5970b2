/* SPDX-License-Identifier: MIT */
/* Points in, values of users' code out, through a compute shader. */
#include "code_gpu.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/limits.h"
#include "renderer/gl/pass.h"

enum { GROUP = 64, NUMBERS = 4 * LIMIT_DECLARED };

bool code_gpu_init(struct code_gpu *gpu, struct error *err)
{
    const struct device_params params = {.index = -1};

    *gpu = (struct code_gpu){0};
    if (!egl_init(&gpu->egl, &params, err)) {
        return false;
    }
    if (!gl_load(&gpu->gl, err)) {
        egl_finish(&gpu->egl);
        return false;
    }
    gpu->gl.GenBuffers(3, gpu->buffers);
    return gl_check(&gpu->gl, "buffers", err);
}

void code_gpu_finish(struct code_gpu *gpu)
{
    gpu->gl.DeleteBuffers(3, gpu->buffers);
    egl_finish(&gpu->egl);
}

struct code_shading code_gpu_shading(const double p[3])
{
    return (struct code_shading){{p[0], p[1], p[2]},
                                 {p[0] / 2, p[1] / 2, p[2] / 2},
                                 {p[1], p[2], p[0]},
                                 {-p[2], -p[0], -p[1]},
                                 p[0] + 8};
}

static const char head[] =
    "#include \"code.glsl\"\n#include \"surface.glsl\"\n"
    "#define GROUP %d\n#define POINTS %d\n"
    "#define zero 0\nlayout(local_size_x = GROUP) in;\n"
    "layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };\n"
    "layout(std430, binding = 1) readonly buffer Numbers { float numbers[]; };\n"
    "layout(std430, binding = 2) writeonly buffer Values { vec4 values[]; };\n";
/* Four numbers of all that a Surface holds: code_gpu_digest. */
static const char digest[] =
    "vec4 digest(float x) { return vec4(x); }\nvec4 digest(vec4 x) { return x; }\n"
    "vec4 digest(CodeSurface s)\n{\nvec3 w = vec3(1.0, 3.0, 7.0);\n"
    "return vec4(dot(s.color, w), dot(vec3(s.metallic, s.roughness, s.reflectivity), w),\n"
    "dot(vec3(s.transmission, s.ior, dot(s.emission, w) * 0.01), w), dot(s.absorption, w));\n}\n";
static const char body[] =
    "void main()\n{\nuint i = gl_GlobalInvocationID.x;\nvec3 p = points[i].xyz;\n"
    "Shading s = Shading(p, p * 0.5, p.yzx, -p.zxy, p.x + 8.0);\n";

static void write_arguments(FILE *out, const struct param *params)
{
    static const char *const names[] = {"", "float", "vec2", "vec3", "vec4"};
    int next = 0;

    for (; params->name; params++) {
        const int count = param_components(params->type);
        fprintf(out, ", %s(", names[count]);
        for (int i = 0; i < count; i++) {
            fprintf(out, "%snumbers[%d]", i > 0 ? ", " : "", next++);
        }
        fputc(')', out);
    }
}

static char *write_program(const struct code_gpu_job *jobs, size_t count)
{
    char *text = NULL, name[32];
    size_t length;
    FILE *out = open_memstream(&text, &length);

    if (!out) {
        abort();
    }
    fprintf(out, head, GROUP, CODE_GPU_POINTS);
    for (size_t i = 0; i < count; i++) {
        snprintf(name, sizeof name, "job_%zu", i);
        code_write(jobs[i].code, name, 1000 + (int)i, out);
    }
    fprintf(out, "%s%s", digest, body);
    for (size_t i = 0; i < count; i++) {
        fprintf(out, "values[%zu * POINTS + i] = digest(job_%zu(%s", i, i,
                jobs[i].use == CODE_SHADE ? "s" : "p");
        write_arguments(out, jobs[i].params);
        fprintf(out, "));\n");
    }
    fprintf(out, "}\n");
    if (fclose(out) != 0) {
        abort();
    }
    return text;
}

static double weighed(double a, double b, double c)
{
    return a + 3 * b + 7 * c;
}

void code_gpu_digest(const struct code_surface *s, double out[4])
{
    const double emission = weighed(s->emission[0], s->emission[1], s->emission[2]) * 0.01;

    out[0] = weighed(s->color[0], s->color[1], s->color[2]);
    out[1] = weighed(s->metallic, s->roughness, s->reflectivity);
    out[2] = weighed(s->transmission, s->ior, emission);
    out[3] = weighed(s->absorption[0], s->absorption[1], s->absorption[2]);
}

static void set_buffer(const struct code_gpu *gpu, GLuint binding, const void *data, size_t bytes)
{
    const struct gl *gl = &gpu->gl;

    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, gpu->buffers[binding]);
    gl->BufferData(GL_SHADER_STORAGE_BUFFER, (GLsizeiptr)bytes, data, GL_STREAM_DRAW);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, gpu->buffers[binding]);
}

bool code_gpu_run(struct code_gpu *gpu, const struct code_gpu_job *jobs, size_t count,
                  const float (*points)[4], const float *numbers, float (*out)[4],
                  struct error *err)
{
    const struct gl *gl = &gpu->gl;
    const size_t bytes = count * CODE_GPU_POINTS * sizeof *out;
    char *text = write_program(jobs, count);
    const struct glsl_file own[] = {{"jobs.glsl", text}, {NULL, NULL}};
    struct pass pass;
    const bool ok = pass_init(&pass, gl, &(struct pass_source){true, NULL, "jobs.glsl", own}, err);

    free(text);
    if (!ok) {
        return false;
    }
    set_buffer(gpu, 0, points, CODE_GPU_POINTS * sizeof *points);
    set_buffer(gpu, 1, numbers, NUMBERS * sizeof *numbers);
    set_buffer(gpu, 2, NULL, bytes);
    gl->UseProgram(pass.program);
    gl->DispatchCompute(CODE_GPU_POINTS / GROUP, 1, 1);
    gl->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    void *values =
        gl->MapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, (GLsizeiptr)bytes, GL_MAP_READ_BIT);
    if (values) {
        memcpy(out, values, bytes);
        gl->UnmapBuffer(GL_SHADER_STORAGE_BUFFER);
    }
    pass_finish(&pass, gl);
    return gl_check(gl, "running code", err);
}
