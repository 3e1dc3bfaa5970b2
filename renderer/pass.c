/* SPDX-License-Identifier: MIT */
/* Puts texts together, compiles, links, and reads drivers' logs. */
#include "pass.h"

#include <stdlib.h>
#include <string.h>

#include "glsl.h"
#include "protocol/limits.h"
#include "protocol/memory.h"

enum { SOURCES_MAX = 32, LOG_BYTES = 4096 };

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

static bool link(const struct gl *gl, GLuint program, GLuint vertex, GLuint fragment,
                 struct error *err)
{
    GLint ok = 0;

    gl->AttachShader(program, vertex);
    gl->AttachShader(program, fragment);
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

bool pass_init(struct pass *out_pass, const struct gl *gl, const struct pass_source *source,
               struct error *err)
{
    static const char *const vertex_files[] = {"full.glsl", NULL};
    const struct pass_source vertex_source = {"", vertex_files, NULL, NULL};
    struct texts *vertex_texts = memory_alloc(1, sizeof *vertex_texts);
    struct texts *fragment_texts = memory_alloc(1, sizeof *fragment_texts);
    const size_t head_size = strlen(source->defines) + 64;
    char *head = memory_alloc(1, head_size);
    struct pass pass = {0};
    GLuint vertex = 0, fragment = 0;
    bool ok = false;

    snprintf(head, head_size, "#version 430 core\n#define LIGHTS_MAX %d\n%s", LIMIT_LIGHTS,
             source->defines);
    if (!collect(vertex_texts, head, &vertex_source, err) ||
        !collect(fragment_texts, head, source, err)) {
        goto end;
    }
    vertex = compile(gl, GL_VERTEX_SHADER, vertex_texts, err);
    fragment = vertex ? compile(gl, GL_FRAGMENT_SHADER, fragment_texts, err) : 0;
    if (!fragment) {
        goto end;
    }
    pass.program = gl->CreateProgram();
    ok = link(gl, pass.program, vertex, fragment, err);
    if (ok) {
        pass.tile = gl->GetUniformLocation(pass.program, "tile");
        *out_pass = pass;
    } else {
        gl->DeleteProgram(pass.program);
    }
end:
    if (vertex) {
        gl->DeleteShader(vertex);
    }
    if (fragment) {
        gl->DeleteShader(fragment);
    }
    free(head);
    free(vertex_texts);
    free(fragment_texts);
    return ok;
}

void pass_finish(struct pass *pass, const struct gl *gl)
{
    if (pass->program) {
        gl->DeleteProgram(pass->program);
    }
    *pass = (struct pass){0};
}

void pass_draw(const struct pass *pass, const struct gl *gl, int tile_x, int tile_y)
{
    gl->UseProgram(pass->program);
    if (pass->tile >= 0) {
        gl->Uniform4i(pass->tile, tile_x, tile_y, 0, 0);
    }
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}
