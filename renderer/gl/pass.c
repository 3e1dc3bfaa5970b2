/* SPDX-License-Identifier: MIT */
/* Puts texts together, compiles, links, and reads drivers' logs. */
#include "pass.h"

#include <stdlib.h>
#include <string.h>

#include "layouts.h"
#include "protocol/memory.h"

enum { LOG_BYTES = 4096 };

/* Reads "3:12(5): error: text" (Mesa) or "3(12) : error C1: text" (NVIDIA). */
static bool read_place(const char *line, int *out_source, int *out_line, const char **out_text)
{
    char *end;
    const long source = strtol(line, &end, 10);
    const char *text;
    long number;

    if (end == line || (*end != ':' && *end != '(')) {
        return false;
    }
    number = strtol(end + 1, &end, 10);
    text = strchr(end, ':');
    if (!text) {
        return false;
    }
    *out_source = (int)source;
    *out_line = (int)number;
    *out_text = text + 1 + strspn(text + 1, " ");
    return true;
}

/* The first error of a log, with its place; a whole log where none can be told apart. */
static bool refuse(struct error *err, const struct shader_text *shader, const char *log)
{
    const char *first = strstr(log, "error");
    const char *line = first ? first : log;
    const char *text;
    char place[160] = "";
    int source, number;

    while (line > log && line[-1] != '\n') {
        line--;
    }
    text = line;
    if (shader && read_place(line, &source, &number, &text) && source >= 0 &&
        source < shader->count) {
        snprintf(place, sizeof place, "%s:%d", shader->names[source], number);
    }
    return error_set(err, ERROR_COMPILE, place, "%.*s", (int)strcspn(text, "\n"), text);
}

static GLuint compile(const struct gl *gl, GLenum stage, const struct shader_text *text,
                      struct error *err)
{
    const GLuint shader = gl->CreateShader(stage);
    GLint ok = 0;

    gl->ShaderSource(shader, 1, (const char *const *)&text->text, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        char log[LOG_BYTES] = "";
        gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
        refuse(err, text, log);
        gl->DeleteShader(shader);
        return 0;
    }
    return shader;
}

static bool link(const struct gl *gl, GLuint program, struct error *err)
{
    GLint ok = 0;

    gl->LinkProgram(program);
    gl->GetProgramiv(program, GL_LINK_STATUS, &ok);
    if (!ok) {
        char log[LOG_BYTES] = "";
        gl->GetProgramInfoLog(program, sizeof log, NULL, log);
        return refuse(err, NULL, log);
    }
    return true;
}

/* Compiles one stage and gives it to the program. */
static bool attach(const struct gl *gl, GLuint program, GLenum stage,
                   const struct shader_text *text, struct error *err)
{
    const GLuint shader = compile(gl, stage, text, err);

    if (shader) {
        gl->AttachShader(program, shader);
        gl->DeleteShader(shader); /* when the program goes */
    }
    return shader != 0;
}

static bool compose(struct shader_text *out_text, const struct gl *gl,
                    const struct pass_source *source, struct error *err)
{
    const char *defines = source->defines ? source->defines : "";
    const char *version = gl->has_compute ? "430 core\n#define PRECISE precise" : "330 core";
    const size_t head_size = strlen(defines) + 64;
    char *head = memory_alloc(1, head_size);

    snprintf(head, head_size, "#version %s\n%s", version, defines);
    const bool ok = include_resolve(out_text, head, source->file, source->own, err);
    free(head);
    return ok;
}

/* The members of a struct with a location have those that follow it (OpenGL 4.3, 4.4.3). */
static bool build_compute(struct pass *pass, const struct gl *gl, const struct shader_text *text,
                          struct error *err)
{
    for (int i = 0; i < LOCATION_COUNT; i++) {
        pass->locations[i] = i;
    }
    return attach(gl, pass->program, GL_COMPUTE_SHADER, text, err) && link(gl, pass->program, err);
}

static bool build_fragment(struct pass *pass, const struct gl *gl, struct shader_text *text,
                           struct error *err)
{
    const struct pass_source full = {.file = "full.glsl"};
    char *whole = memory_text(text->text);
    struct shader_text vertex = {0};

    layouts_leave_out(text->text);
    const bool ok = compose(&vertex, gl, &full, err) &&
                    attach(gl, pass->program, GL_VERTEX_SHADER, &vertex, err) &&
                    attach(gl, pass->program, GL_FRAGMENT_SHADER, text, err) &&
                    link(gl, pass->program, err);
    if (ok) {
        layouts_set(gl, pass->program, whole, pass->locations);
    }
    include_finish(&vertex);
    free(whole);
    return ok;
}

bool pass_init(struct pass *out_pass, const struct gl *gl, const struct pass_source *source,
               struct error *err)
{
    struct pass pass = {0};
    struct shader_text text;

    if (!compose(&text, gl, source, err)) {
        return false;
    }
    pass.program = gl->CreateProgram();
    const bool ok = source->compute ? build_compute(&pass, gl, &text, err)
                                    : build_fragment(&pass, gl, &text, err);
    include_finish(&text);
    if (!ok) {
        pass_finish(&pass, gl);
        return false;
    }
    *out_pass = pass;
    return true;
}

void pass_finish(struct pass *pass, const struct gl *gl)
{
    if (pass->program) {
        gl->DeleteProgram(pass->program);
    }
    *pass = (struct pass){0};
}

/* What a program does not use is passed over. */
static void use(const struct pass *pass, const struct gl *gl, const struct dispatch_args *dispatch,
                struct pass_args args)
{
    const GLint *own = pass->locations + DISPATCH_LOCATION;

    gl->UseProgram(pass->program);
    gl->Uniform2i(own[0], dispatch->x, dispatch->y);
    gl->Uniform1i(own[1], (GLint)dispatch->mode);
    gl->Uniform1i(own[2], 0);
    for (int i = 0; i < args.count; i++) {
        gl->Uniform1i(pass->locations[ARGS_LOCATION + i], args.values[i]);
    }
}

static GLuint parts(int length, int part)
{
    return (GLuint)((length + part - 1) / part);
}

void pass_draw(const struct pass *pass, const struct gl *gl, const struct dispatch_args *dispatch,
               struct pass_args args)
{
    use(pass, gl, dispatch, args);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

/* Blocks lie where they do in the whole picture, so a tile may touch one more than it is long. */
void pass_compute(const struct pass *pass, const struct gl *gl,
                  const struct dispatch_args *dispatch, struct pass_args args)
{
    const int more = dispatch->mode == PASS_COARSE ? BLOCK_SIDE : 0;
    const int side = dispatch->mode == PASS_COARSE ? GROUP_SIDE * BLOCK_SIDE : GROUP_SIDE;

    use(pass, gl, dispatch, args);
    if (dispatch->mode == PASS_LIST) {
        gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_LIST, dispatch->list);
        gl->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, dispatch->list);
        gl->DispatchComputeIndirect(0);
    } else {
        gl->DispatchCompute(parts(dispatch->width + more, side),
                            parts(dispatch->height + more, side), 1);
    }
    gl->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                      GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                      GL_BUFFER_UPDATE_BARRIER_BIT);
}
