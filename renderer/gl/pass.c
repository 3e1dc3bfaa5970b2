/* SPDX-License-Identifier: MIT */
/* Puts texts together, compiles, links, and reads drivers' logs. */
#include "pass.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/limits.h"
#include "protocol/memory.h"
#include "renderer/glsl.h"

enum { SOURCES_MAX = 48, LOG_BYTES = 4096 };

/* Texts of one shader; their index is the number that `#line` gives them. */
struct texts {
    const char *names[SOURCES_MAX];
    const char *pieces[2 * SOURCES_MAX]; /* a #line in front of each text */
    char lines[SOURCES_MAX][24];
    int count;
};

static const char *file_text(const char *name)
{
    for (const struct glsl_file *file = glsl_files; file->name; file++) {
        if (strcmp(file->name, name) == 0) {
            return file->text;
        }
    }
    return NULL;
}

/* `line` false: the text starts with #version, which nothing may precede. */
static void add_text(struct texts *texts, const char *name, const char *text, bool line)
{
    const int i = texts->count++;

    texts->names[i] = name;
    if (line) {
        snprintf(texts->lines[i], sizeof texts->lines[i], "\n#line 1 %d\n", i);
    }
    texts->pieces[(size_t)2 * i] = texts->lines[i];
    texts->pieces[(size_t)2 * i + 1] = text;
}

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
static bool refuse(struct error *err, const struct texts *texts, const char *log)
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
    if (texts && read_place(line, &source, &number, &text) && source >= 0 &&
        source < texts->count) {
        snprintf(place, sizeof place, "%s:%d", texts->names[source], number);
    }
    return error_set(err, ERROR_COMPILE, place, "%.*s", (int)strcspn(text, "\n"), text);
}

static GLuint compile(const struct gl *gl, GLenum stage, const struct texts *texts,
                      struct error *err)
{
    const GLuint shader = gl->CreateShader(stage);
    GLint ok = 0;

    gl->ShaderSource(shader, 2 * texts->count, texts->pieces, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        char log[LOG_BYTES] = "";
        gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
        refuse(err, texts, log);
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

static bool collect(struct texts *texts, const char *head, const struct pass_source *source,
                    struct error *err)
{
    add_text(texts, "prelude", head, false);
    for (const char *const *name = source->files; *name; name++) {
        const char *text = strcmp(*name, "map") == 0       ? source->map
                           : strcmp(*name, "surface") == 0 ? source->surface
                                                           : file_text(*name);

        if (!text || texts->count == SOURCES_MAX) {
            return error_set(err, ERROR_INTERNAL, *name, "no such shader text");
        }
        add_text(texts, *name, text, true);
    }
    return true;
}

/* Compiles one stage and gives it to the program. */
static bool attach(const struct gl *gl, GLuint program, GLenum stage, const char *head,
                   const struct pass_source *source, struct error *err)
{
    struct texts *texts = memory_alloc(1, sizeof *texts);
    GLuint shader = 0;

    if (collect(texts, head, source, err)) {
        shader = compile(gl, stage, texts, err);
    }
    if (shader) {
        gl->AttachShader(program, shader);
        gl->DeleteShader(shader); /* when the program goes */
    }
    free(texts);
    return shader != 0;
}

bool pass_init(struct pass *out_pass, const struct gl *gl, const struct pass_source *source,
               struct error *err)
{
    static const char *const vertex_files[] = {"full.glsl", NULL};
    const struct pass_source vertex = {.defines = "", .files = vertex_files};
    const size_t head_size = strlen(source->defines) + 128;
    char *head = memory_alloc(1, head_size);
    struct pass pass = {.program = gl->CreateProgram()};
    bool ok;

    snprintf(head, head_size,
             "#version 430 core\n#define LIGHTS_MAX %d\n#define VOLUMES_MAX %d\n"
             "#define STACK_DEPTH %d\n%s",
             LIMIT_LIGHTS, LIMIT_VOLUMES, STACK_DEPTH, source->defines);
    ok = (source->compute || attach(gl, pass.program, GL_VERTEX_SHADER, head, &vertex, err)) &&
         attach(gl, pass.program, source->compute ? GL_COMPUTE_SHADER : GL_FRAGMENT_SHADER, head,
                source, err) &&
         link(gl, pass.program, err);
    free(head);
    if (!ok) {
        pass_finish(&pass, gl);
        return false;
    }
    pass.tile = gl->GetUniformLocation(pass.program, "tile");
    pass.turn = gl->GetUniformLocation(pass.program, "turn");
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

static void use(const struct pass *pass, const struct gl *gl, const struct pass_place *place)
{
    gl->UseProgram(pass->program);
    if (pass->tile >= 0) {
        gl->Uniform4i(pass->tile, place->x, place->y, 0, (GLint)place->mode);
    }
    if (pass->turn >= 0) {
        gl->Uniform4i(pass->turn, place->turn[0], place->turn[1], place->turn[2], place->turn[3]);
    }
}

static GLuint parts(int length, int part)
{
    return (GLuint)((length + part - 1) / part);
}

void pass_draw(const struct pass *pass, const struct gl *gl, const struct pass_place *place)
{
    use(pass, gl, place);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

/* Blocks lie where they do in the whole picture, so a tile may touch one more than it is long. */
void pass_compute(const struct pass *pass, const struct gl *gl, const struct pass_place *place)
{
    const int more = place->mode == PASS_COARSE ? BLOCK_SIDE : 0;
    const int side = place->mode == PASS_COARSE ? GROUP_SIDE * BLOCK_SIDE : GROUP_SIDE;

    use(pass, gl, place);
    if (place->mode == PASS_LIST) {
        gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_LIST, place->list);
        gl->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, place->list);
        gl->DispatchComputeIndirect(0);
    } else {
        gl->DispatchCompute(parts(place->width + more, side), parts(place->height + more, side), 1);
    }
    gl->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                      GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                      GL_BUFFER_UPDATE_BARRIER_BIT);
}
