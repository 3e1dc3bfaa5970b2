/* SPDX-License-Identifier: MIT */
#include "layouts.h"

#include <stdio.h>
#include <string.h>

enum { NAME_BYTES = 48, LONG_BYTES = 2 * NAME_BYTES };

/* A declaration: layout(binding = UNIT_MASK) uniform sampler2D mask; */
struct layout {
    enum layout_kind { LAYOUT_TEXTURE, LAYOUT_BLOCK, LAYOUT_STRUCT } kind;
    const char *from, *end; /* what is left out of the text */
    char place[NAME_BYTES], type[NAME_BYTES], name[NAME_BYTES];
};

static const char *next_line(const char *line)
{
    const char *end = strchr(line, '\n');

    return end ? end + 1 : line + strlen(line);
}

static bool read_layout(const char *line, struct layout *out)
{
    const char *close = strchr(line, ')');

    *out = (struct layout){.kind = LAYOUT_BLOCK};
    if (sscanf(line, "layout(std140, binding = %47[A-Z0-9_]) uniform %47[A-Za-z_] {", out->place,
               out->name) == 2) {
        out->from = strchr(line, ',');
        out->end = close;
        return true;
    }
    out->from = line;
    out->end = close ? close + 1 : line;
    out->kind = LAYOUT_TEXTURE;
    if (sscanf(line, "layout(binding = %47[A-Z0-9_]) uniform %47[A-Za-z0-9] %47[a-z0-9_]",
               out->place, out->type, out->name) == 3) {
        return true;
    }
    out->kind = LAYOUT_STRUCT;
    return sscanf(line, "layout(location = %47[A-Z0-9_]) uniform %47[A-Za-z] %47[a-z_]", out->place,
                  out->type, out->name) == 3;
}

void layouts_leave_out(char *text)
{
    struct layout layout;

    for (const char *line = text; *line; line = next_line(line)) {
        if (read_layout(line, &layout)) {
            memset(text + (layout.from - text), ' ', (size_t)(layout.end - layout.from));
        }
    }
}

/* Members of a struct with a location have it and those that follow. */
static void find_members(const struct gl *gl, GLuint program, const char *text,
                         const struct layout *layout, GLint out_locations[LOCATION_COUNT])
{
    char head[LONG_BYTES], member[NAME_BYTES], name[LONG_BYTES];
    int at = interface_place(layout->place);

    snprintf(head, sizeof head, "struct %s {\n", layout->type);
    const char *line = strstr(text, head);
    for (line = line ? next_line(line) : ""; sscanf(line, " %*[a-z0-9] %47[a-z_];", member) == 1;
         line = next_line(line)) {
        snprintf(name, sizeof name, "%s.%s", layout->name, member);
        out_locations[at++] = gl->GetUniformLocation(program, name);
    }
}

static void set_block(const struct gl *gl, GLuint program, const struct layout *layout)
{
    const GLuint block = gl->GetUniformBlockIndex(program, layout->name);

    if (block != GL_INVALID_INDEX) {
        gl->UniformBlockBinding(program, block, (GLuint)interface_place(layout->place));
    }
}

void layouts_set(const struct gl *gl, GLuint program, const char *text,
                 GLint out_locations[LOCATION_COUNT])
{
    struct layout layout;

    for (int i = 0; i < LOCATION_COUNT; i++) {
        out_locations[i] = -1;
    }
    gl->UseProgram(program);
    for (const char *line = text; *line; line = next_line(line)) {
        if (!read_layout(line, &layout)) {
            continue;
        }
        if (layout.kind == LAYOUT_TEXTURE) {
            gl->Uniform1i(gl->GetUniformLocation(program, layout.name),
                          interface_place(layout.place));
        } else if (layout.kind == LAYOUT_BLOCK) {
            set_block(gl, program, &layout);
        } else {
            find_members(gl, program, text, &layout, out_locations);
        }
    }
}
