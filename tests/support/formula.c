/* SPDX-License-Identifier: MIT */
#include "formula.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "renderer/gl/egl.h"
#include "renderer/gl/pass.h"

enum { GROUP = 8 };

static struct egl egl;
static struct gl gl_functions;

static const char tail[] = "\nlayout(local_size_x = 8) in;\n"
                           "struct Row { vec4 a, b, c, answer; };\n"
                           "layout(std430, binding = 0) buffer Rows { Row rows[]; };\n"
                           "void main()\n{\n"
                           "    uint i = gl_GlobalInvocationID.x;\n"
                           "    if (i < uint(rows.length())) {\n"
                           "        rows[i].answer = ask(rows[i].a, rows[i].b, rows[i].c);\n"
                           "    }\n}\n";

/* For `field_surface.glsl`. */
static const char surface[] =
    "#include \"mixture.glsl\"\n"
    "void surface(vec3 p, Shading at, out Surface s)\n{\n"
    "    Mixture m = mixture(vec3(0.0, 1.0, 0.0));\n    s = surface_begin(m);\n}\n";

int formula_start(void **state)
{
    const struct device_params params = {.index = -1};
    struct error err = {0};

    (void)state;
    if (!egl_init(&egl, &params, &err) || !gl_load(&gl_functions, &err)) {
        error_print(&err, stderr);
        return -1;
    }
    return 0;
}

int formula_end(void **state)
{
    (void)state;
    egl_finish(&egl);
    return 0;
}

const struct gl *formula_gl(void)
{
    return &gl_functions;
}

void formula_run(const char *text, struct formula_row *rows, size_t count)
{
    const struct gl *gl = &gl_functions;
    const GLsizeiptr bytes = (GLsizeiptr)(count * sizeof *rows);
    struct error err = {0};
    struct pass pass;
    char *whole;
    GLuint buffer;

    assert_true(asprintf(&whole, "%s%s", text, tail) > 0);
    const struct glsl_file own[] = {
        {"ask.glsl", whole}, {"field_surface.glsl", surface}, {NULL, NULL}};
    if (!pass_init(&pass, gl, &(struct pass_source){true, NULL, "ask.glsl", own}, &err)) {
        fail_msg("%s: %s", err.place, err.message);
    }
    free(whole);
    gl->GenBuffers(1, &buffer);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    gl->BufferData(GL_SHADER_STORAGE_BUFFER, bytes, rows, GL_STREAM_READ);
    gl->UseProgram(pass.program);
    gl->DispatchCompute((GLuint)((count + GROUP - 1) / GROUP), 1, 1);
    gl->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const struct formula_row *answers =
        gl->MapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, bytes, GL_MAP_READ_BIT);
    assert_non_null(answers);
    for (size_t i = 0; i < count; i++) {
        rows[i] = answers[i];
    }
    gl->UnmapBuffer(GL_SHADER_STORAGE_BUFFER);
    gl->DeleteBuffers(1, &buffer);
    pass_finish(&pass, gl);
}
