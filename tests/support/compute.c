/* SPDX-License-Identifier: MIT */
#include "compute.h"

#include <stdlib.h>
#include <string.h>

#include "renderer/glsl.h"

enum { LOG_BYTES = 4096 };

const char *compute_file(const char *name)
{
    for (const struct glsl_file *file = glsl_files; file->name; file++) {
        if (strcmp(file->name, name) == 0) {
            return file->text;
        }
    }
    abort();
}

GLuint compute_link(const struct gl *gl, const char *const *texts, int count, struct error *err)
{
    GLuint shader = gl->CreateShader(GL_COMPUTE_SHADER), program = gl->CreateProgram();
    GLint ok = 0;
    char log[LOG_BYTES] = "";
    gl->ShaderSource(shader, count, texts, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) {
        gl->AttachShader(program, shader);
        gl->LinkProgram(program);
        gl->GetProgramiv(program, GL_LINK_STATUS, &ok);
        gl->GetProgramInfoLog(program, sizeof log, NULL, log);
    } else {
        gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    }
    gl->DeleteShader(shader);
    if (!ok) {
        error_set(err, ERROR_COMPILE, "", "%.300s", log);
        gl->DeleteProgram(program);
        return 0;
    }
    return program;
}
