/* SPDX-License-Identifier: MIT */
/* Strings the calls of a field program together as straight-line GLSL. No GL here. */
#include "shader.h"

#include <stdio.h>
#include <stdlib.h>

#include "shader_calls.h"

/* The numbers of strings that #line gives to users' code. */
enum { FIRST_CODE = 1000, FIRST_SHADER = 2000 };

/* What two distances make. */
static void write_both(const struct shader_writer *w, const struct field_instruction *in)
{
    if (!in->seen) {
        shader_write_call(w, in, "");
        return;
    }
    fprintf(w->out, "sided(");
    shader_write_call(w, in, "");
    fprintf(w->out, ", ");
    shader_write_distance(w, in->a);
    fprintf(w->out, ", ");
    shader_write_distance(w, in->b);
    fprintf(w->out, ", ");
    shader_write_number(w, in->seen);
    fprintf(w->out, ")");
}

/* The share of the second in that. */
static void write_share(const struct shader_writer *w, const struct field_instruction *in)
{
    fprintf(w->out, in->seen ? "sided_share(" : "");
    shader_write_call(w, in, "_share");
    if (in->seen) {
        fprintf(w->out, ", ");
        shader_write_number(w, in->seen);
        fprintf(w->out, ")");
    }
}

static void write_mixed(struct shader_writer *w, uint16_t slot)
{
    if (!w->mixed[slot]) {
        fprintf(w->out,
                w->field->shader_count > 0 ? "m%u = mixture(h%u, o%u);\n" : "m%u = mixture(h%u);\n",
                slot, slot, slot);
        w->mixed[slot] = true;
    }
}

/* Both mixed, or one of both chosen. */
static void write_surfaces(struct shader_writer *w, const struct field_instruction *in)
{
    const bool objects = w->field->shader_count > 0;
    const bool mixed = in->sdf->soft || w->mixed[in->a] || w->mixed[in->b];

    if (mixed) {
        write_mixed(w, in->a);
    } else if (objects) {
        fprintf(w->out, "o%u = ", in->a);
        write_share(w, in);
        fprintf(w->out, " > 0.5 ? o%u : o%u;\n", in->b, in->a);
    }
    fprintf(w->out, mixed ? "m%u = blend(" : "h%u = choose(", in->a);
    write_both(w, in);
    fprintf(w->out, ", ");
    write_share(w, in);
    fprintf(w->out, mixed ? ", m%u, " : ", h%u, ", in->a);
    fprintf(w->out, w->mixed[in->b] ? "m%u" : "h%u", in->b);
    if (mixed && objects && !w->mixed[in->b]) {
        fprintf(w->out, ", o%u", in->b);
    }
    fprintf(w->out, ");\n");
}

static void write_combine(struct shader_writer *w, const struct field_instruction *in)
{
    if (w->surface) {
        write_surfaces(w, in);
    } else {
        fprintf(w->out, "d%u = ", in->a);
        write_both(w, in);
        fprintf(w->out, ";\n");
    }
}

static void write_change(const struct shader_writer *w, const struct field_instruction *in)
{
    shader_write_distance(w, in->a);
    fprintf(w->out, " = ");
    shader_write_call(w, in, "");
    fprintf(w->out, ";\n");
}

static void write_after(const struct shader_writer *w, const struct field_instruction *in)
{
    shader_write_distance(w, in->a);
    fprintf(w->out, " = max(%s_after(", in->type->glsl);
    shader_write_distance(w, in->a);
    fprintf(w->out, ", p%u", in->point);
    shader_write_vec4s(w, in->params, in->sdf->domain->vec4s);
    fprintf(w->out, "), ");
    shader_write_number(w, in->seen);
    fprintf(w->out, ");\n");
}

/* Which kind of surface a cell gives is known only at the end, so both kinds start empty. The loop
 * ends whatever the buffer holds: a program is warmed up with zeros, for which the count is not a
 * number, and a loop without an end hangs a GPU. */
static void write_loop(const struct shader_writer *w, const struct field_instruction *in,
                       size_t name)
{
    fprintf(w->out, "vec3 first%zu = ", name);
    shader_write_domain_call(w, in, "_first", "");
    fprintf(w->out, "vec3 last%zu = ", name);
    shader_write_domain_call(w, in, "_last", "");
    if (w->surface) {
        fprintf(w->out, "h%u = vec3(FAR, 0.0, 0.0);\nm%u = mixture_far();\n", in->a, in->a);
    } else {
        fprintf(w->out, "d%u = FAR;\n", in->a);
    }
    fprintf(w->out,
            "vec3 cell%zu = first%zu;\n"
            "for (int left%zu = min(int(cell_count(first%zu, last%zu)), %d); left%zu > 0; "
            "left%zu--) {\np%u = ",
            name, name, name, name, name, SDF_REPEAT_CELLS_MAX, name, name, in->out);
    char cell[32];
    snprintf(cell, sizeof cell, ", cell%zu", name);
    shader_write_domain_call(w, in, "_cell", cell);
}

static void write_loop_end(struct shader_writer *w, const struct field_instruction *in, size_t name)
{
    if (w->surface) {
        const char *kind = w->mixed[in->b] ? "m" : "h";
        const char *distance = w->mixed[in->b] ? "d" : "x";
        const bool objects = !w->mixed[in->b] && w->field->shader_count > 0;
        fprintf(w->out, "if (%s%u.%s < %s%u.%s) {\n%s%u = %s%u;\n", kind, in->b, distance, kind,
                in->a, distance, kind, in->a, kind, in->b);
        fprintf(w->out, objects ? "o%u = o%u;\n}\n" : "}\n", in->a, in->b);
        w->mixed[in->a] = w->mixed[in->b];
    } else {
        fprintf(w->out, "d%u = min(d%u, d%u);\n", in->a, in->a, in->b);
    }
    fprintf(w->out, "cell%zu = cell_next(cell%zu, first%zu, last%zu);\n}\n", name, name, name,
            name);
}

static void write_empty(struct shader_writer *w, uint16_t slot)
{
    fprintf(w->out, w->surface ? "h%u = vec3(FAR, 0.0, 0.0);\n" : "d%u = FAR;\n", slot);
    w->mixed[slot] = false;
}

/* A loop of at most one round: llvmpipe, which runs both sides of every branch, runs the loops
 * inside of it but once when no lane is there. */
static void write_guard(const struct shader_writer *w, const struct field_instruction *in,
                        size_t name)
{
    if (!w->surface) {
        fprintf(w->out,
                "float g%zu = guard(p%u, P(%u), P(%u));\n"
                "for (int k%zu = guard_rounds(g%zu, d%u); k%zu > 0; k%zu--) {\n",
                name, in->point, in->params, in->params + 1, name, name, in->a, name, name);
    }
}

static void write_guard_end(const struct shader_writer *w, const struct field_instruction *in,
                            size_t name)
{
    if (!w->surface) {
        fprintf(w->out, "d%u = guarded(d%u, g%zu);\n}\n", in->a, in->a, name);
    }
}

static void write_instructions(struct shader_writer *w)
{
    size_t loops[3 * LIMIT_NODE_DEPTH]; /* names of the loops and guards that are open */
    int depth = 0;

    for (size_t i = 0; i < w->field->instruction_count; i++) {
        const struct field_instruction *in = &w->field->instructions[i];
        switch (in->op) {
        case FIELD_EMPTY:
            write_empty(w, in->a);
            break;
        case FIELD_SHAPE:
            shader_write_shape(w, in);
            break;
        case FIELD_COMBINE:
            write_combine(w, in);
            break;
        case FIELD_DISTANCE:
            write_change(w, in);
            break;
        case FIELD_TRANSFORM:
            fprintf(w->out, "p%u = ", in->out);
            shader_write_local(w, in);
            fprintf(w->out, ";\n");
            break;
        case FIELD_WARP:
            fprintf(w->out, "p%u = ", in->out);
            shader_write_domain_call(w, in, "", "");
            break;
        case FIELD_AFTER:
            write_after(w, in);
            break;
        case FIELD_LOOP:
            loops[depth++] = i;
            write_loop(w, in, i);
            break;
        case FIELD_LOOP_END:
            write_loop_end(w, in, loops[--depth]);
            break;
        case FIELD_GUARD:
            loops[depth++] = i;
            write_guard(w, in, i);
            break;
        case FIELD_GUARD_END:
            write_guard_end(w, in, loops[--depth]);
            break;
        }
    }
}

static void write_slots(const struct shader_writer *w, const char *type, const char *name,
                        int first, int count)
{
    for (int i = first; i < count; i++) {
        fprintf(w->out, "%s %s%d;\n", type, name, i);
    }
}

/* What the material in a slot is by its shader. */
static void write_apply_shader(const struct shader_writer *w)
{
    const struct field *field = w->field;

    fprintf(w->out,
            "void apply_shader(Shading at, float slot, inout MaterialValues values)\n{\n"
            "int i = %zu + %zu * int(slot);\n"
            "int shader = int(values.emission.w);\nbool unlit = values.ambient.w > 0.5;\n",
            field->material_base, field->material_stride);
    for (size_t i = 0; i < field->shader_count; i++) {
        const bool whole = code_gives_surface(field->shaders[i].code);
        fprintf(w->out, "if (shader == %zu) {\nmaterial_set_%s(values, shade_%zu(at", i + 1,
                whole ? "surface" : "color", i);
        shader_write_places(w, &field->shaders[i], "P_ANY(i + ", FIELD_MATERIAL_VEC4S);
        fprintf(w->out, whole ? "), unlit);\n}\n" : ").rgb, unlit);\n}\n");
    }
    fprintf(w->out, "}\n");
}

/* The same functions serve map and surface, in one program or in two. */
static void write_functions(const struct shader_writer *w)
{
    fprintf(w->out, "#ifndef USER_FUNCTIONS\n#define USER_FUNCTIONS\n");
    shader_write_codes(w, w->field->codes, w->field->code_count, "user", FIRST_CODE);
    fprintf(w->out, "#endif\n");
}

/* Materials are read here alone, and each shader stands here alone. */
static void write_materials(const struct shader_writer *w)
{
    fprintf(w->out,
            "s = surface_begin(m0);\nfor (int left = 4; left > 0 && m0.shares.x > 0.0; left--) {\n"
            "int i = %zu + %zu * int(m0.slots.x);\n"
            "MaterialValues values = MaterialValues(P_ANY(i), P_ANY(i + 1), P_ANY(i + 2),\n"
            "P_ANY(i + 3), P_ANY(i + 4), P_ANY(i + 5));\n",
            w->field->material_base, w->field->material_stride);
    if (w->field->shader_count > 0) {
        fputs("at.object_position = m0.place_x;\n"
              "apply_shader(at, m0.slots.x, values);\n",
              w->out);
    }
    fputs("surface_add(s, m0, values);\nmixture_next(m0);\n}\n", w->out);
}

static void write_map(struct shader_writer *w)
{
    fputs("#include \"field.glsl\"\n", w->out);
    write_functions(w);
    fprintf(w->out, "float map(vec3 p0)\n{\n");
    write_slots(w, "vec3", "p", 1, w->field->point_slots);
    write_slots(w, "float", "d", 0, w->field->distance_slots);
    write_instructions(w);
    fprintf(w->out, "return d0;\n}\n");
}

static void write_surface(struct shader_writer *w)
{
    const struct field *field = w->field;

    fputs("#include \"field.glsl\"\n#include \"mixture.glsl\"\n", w->out);
    write_functions(w);
    shader_write_codes(w, field->shaders, field->shader_count, "shade", FIRST_SHADER);
    if (field->shader_count > 0) {
        write_apply_shader(w);
    }
    fprintf(w->out, "void surface(vec3 p0, Shading at, out Surface s)\n{\n");
    write_slots(w, "vec3", "p", 1, field->point_slots);
    write_slots(w, "vec3", "h", 0, field->distance_slots);
    write_slots(w, "vec3", "o", 0, field->shader_count > 0 ? field->distance_slots : 0);
    write_slots(w, "Mixture", "m", 0, field->distance_slots);
    write_instructions(w);
    write_mixed(w, 0);
    write_materials(w);
    fprintf(w->out, "}\n");
}

static char *write_text(const struct field *field, bool surface)
{
    char *text = NULL;
    size_t length = 0;
    struct shader_writer w = {.field = field, .surface = surface};

    w.out = open_memstream(&text, &length);
    if (!w.out) {
        abort();
    }
    if (surface) {
        write_surface(&w);
    } else {
        write_map(&w);
    }
    if (fclose(w.out) != 0) {
        abort();
    }
    return text;
}

char *shader_map(const struct field *field)
{
    return write_text(field, false);
}

char *shader_surface(const struct field *field)
{
    return write_text(field, true);
}

void shader_functions(FILE *out, const struct field *field)
{
    const struct shader_writer w = {.out = out, .field = field};

    write_functions(&w);
}

void shader_ask(FILE *out, const struct field *field)
{
    const struct shader_writer w = {.out = out, .field = field};

    if (field->shader_count == 0) {
        return;
    }
    shader_write_codes(&w, field->shaders, field->shader_count, "shade", FIRST_SHADER);
    fputs("int ask_shader(int shader, int material, Shading at, out vec4 color, out CodeSurface s)"
          "\n{\n",
          out);
    for (size_t i = 0; i < field->shader_count; i++) {
        const bool whole = code_gives_surface(field->shaders[i].code);
        fprintf(out, "if (shader == %zu) {\n%s = shade_%zu(at", i + 1, whole ? "s" : "color", i);
        shader_write_places(&w, &field->shaders[i], "P_ANY(material + ", FIELD_MATERIAL_VEC4S);
        fprintf(out, ");\nreturn %d;\n}\n", whole ? 2 : 1);
    }
    fputs("return 0;\n}\n", out);
}
