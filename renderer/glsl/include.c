/* SPDX-License-Identifier: MIT */
#include "include.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "interface.h"

enum { NAME_BYTES = 64 };

struct resolver {
    FILE *out;
    const struct glsl_file *own;
    const struct glsl_file *interface; /* a list of one */
    struct shader_text *shader;
    struct error *err;
};

static char *make_interface(void)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    if (!out) {
        abort();
    }
    interface_write(out);
    if (fclose(out) != 0) {
        abort();
    }
    return text;
}

static const struct glsl_file *row_of(const struct glsl_file *files, const char *name)
{
    for (; files && files->name; files++) {
        if (strcmp(files->name, name) == 0) {
            return files;
        }
    }
    return NULL;
}

static const struct glsl_file *find(const struct resolver *r, const char *name)
{
    const struct glsl_file *lists[] = {r->own, r->interface, glsl_files};
    const struct glsl_file *row = NULL;

    for (size_t i = 0; i < sizeof lists / sizeof lists[0] && !row; i++) {
        row = row_of(lists[i], name);
    }
    return row;
}

static bool is_known(const struct shader_text *shader, const char *name)
{
    for (int i = 0; i < shader->count; i++) {
        if (strcmp(shader->names[i], name) == 0) {
            return true;
        }
    }
    return false;
}

/* The name that a line includes; false: it is no such line. */
static bool read_include(const char *line, char out_name[NAME_BYTES])
{
    return sscanf(line, "#include \"%63[^\"\n]\"", out_name) == 1;
}

static bool write_file(struct resolver *r, const char *name)
{
    struct shader_text *shader = r->shader;
    const struct glsl_file *file = find(r, name);
    const int own = shader->count;
    char other[NAME_BYTES];
    size_t length;

    if (!file || own == INCLUDE_FILES_MAX) {
        return error_set(r->err, ERROR_INTERNAL, name, "no such text, or more than %d in a shader",
                         INCLUDE_FILES_MAX);
    }
    shader->names[shader->count++] = file->name;
    fprintf(r->out, "\n#line 1 %d\n", own);
    const char *line = file->text;
    for (int number = 1; *line; number++, line += length + (line[length] == '\n')) {
        length = strcspn(line, "\n");
        if (!read_include(line, other)) {
            fprintf(r->out, "%.*s\n", (int)length, line);
        } else if (is_known(shader, other)) {
            fputc('\n', r->out);
        } else if (!write_file(r, other)) {
            return false;
        } else {
            fprintf(r->out, "\n#line %d %d\n", number + 1, own);
        }
    }
    return true;
}

bool include_resolve(struct shader_text *out, const char *head, const char *name,
                     const struct glsl_file *own, struct error *err)
{
    char *text = make_interface();
    const struct glsl_file interface[] = {{"interface.glsl", text}, {NULL, NULL}};
    struct resolver r = {.own = own, .interface = interface, .shader = out, .err = err};
    size_t length = 0;

    *out = (struct shader_text){0};
    r.out = open_memstream(&out->text, &length);
    if (!r.out) {
        abort();
    }
    fputs(head, r.out);
    const bool ok = write_file(&r, name);
    if (fclose(r.out) != 0) {
        abort();
    }
    free(text);
    if (!ok) {
        include_finish(out);
    }
    return ok;
}

void include_finish(struct shader_text *text)
{
    free(text->text);
    *text = (struct shader_text){0};
}
