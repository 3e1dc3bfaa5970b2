/* SPDX-License-Identifier: MIT */
#include "shader_calls.h"

#include "renderer/sdf/patches.h"
#include "renderer/sdf/polynomial.h"

static void write_params(const struct shader_writer *w, const struct field_instruction *in,
                         uint32_t vec4, int used)
{
    struct param_slot places[SDF_PARAMS_MAX];
    const struct param *params = in->type->record.params;
    int choice = 0;

    field_layout(params, used, places);
    for (size_t i = 0; params[i].name; i++) {
        choice += params[i].type == PARAM_ENUM;
    }
    for (size_t i = 0; params[i].name; i++) {
        if (params[i].type == PARAM_ENUM) {
            fprintf(w->out, ", %u", in->choices >> (8 * --choice) & 0xff);
        } else if (places[i].vec4 >= 0) {
            fprintf(w->out, ", P(%u).%.*s", vec4 + (uint32_t)places[i].vec4, places[i].count,
                    &"xyzw"[places[i].component]);
        }
    }
}

void shader_write_places(const struct shader_writer *w, const struct field_code *code,
                         const char *base, uint32_t first)
{
    for (int i = 0; i < code->place_count; i++) {
        const struct param_slot *place = &code->places[i];
        const uint32_t vec4 = first + (uint32_t)place->vec4;
        fprintf(w->out, ", %s%u).%.*s", base, vec4, place->count, &"xyzw"[place->component]);
    }
}

void shader_write_vec4s(const struct shader_writer *w, uint32_t first, int count)
{
    for (int i = 0; i < count; i++) {
        fprintf(w->out, ", P(%u)", first + (uint32_t)i);
    }
}

void shader_write_distance(const struct shader_writer *w, uint16_t slot)
{
    if (!w->surface) {
        fprintf(w->out, "d%u", slot);
    } else {
        fprintf(w->out, w->mixed[slot] ? "m%u.d" : "h%u.x", slot);
    }
}

void shader_write_local(const struct shader_writer *w, const struct field_instruction *in)
{
    fprintf(w->out, "local(p%u", in->point);
    shader_write_vec4s(w, in->params, FIELD_MATRIX_VEC4S);
    fprintf(w->out, ")");
}

void shader_write_code_point(const struct shader_writer *w, const struct field_instruction *in)
{
    fprintf(w->out, "within(");
    shader_write_local(w, in);
    fprintf(w->out, ", P(%u))", in->params + FIELD_MATRIX_VEC4S + FIELD_HEAD_VEC4S);
}

/* Its answer, cut by its box; without a field that is d. */
static void write_code(const struct shader_writer *w, const struct field_instruction *in)
{
    const uint32_t head = in->params + FIELD_MATRIX_VEC4S, cut = head + FIELD_HEAD_VEC4S;

    fprintf(w->out, "unless_away(cut(");
    if (w->field->codes) {
        fprintf(w->out, "user_%u(", in->choices);
        shader_write_code_point(w, in);
        shader_write_places(w, &w->field->codes[in->choices], "P(", cut + FIELD_CUT_VEC4S);
    } else {
        fprintf(w->out, "code_distance(d");
    }
    fprintf(w->out, ") * P(%u).x, ", head);
    shader_write_local(w, in);
    fprintf(w->out, ", P(%u)), P(%u).x)", cut, head + 1);
}

void shader_write_shape(struct shader_writer *w, const struct field_instruction *in)
{
    const uint32_t head = in->params + FIELD_MATRIX_VEC4S;

    if (w->surface && w->field->shader_count > 0) {
        fprintf(w->out, "o%u = ", in->a);
        shader_write_local(w, in);
        fprintf(w->out, ";\n");
    }
    fprintf(w->out, w->surface ? "h%u = vec3(masked(" : "d%u = masked(", in->a);
    if (in->choices == FIELD_POLYNOMIAL || in->choices == FIELD_PATCHES) {
        fprintf(w->out, in->choices == FIELD_PATCHES ? "patches(" : "polynomial(");
        shader_write_local(w, in);
        fprintf(w->out, ", %u) * P(%u).x", head + FIELD_HEAD_VEC4S + FIELD_CUT_VEC4S, head);
    } else if (in->sdf) {
        fprintf(w->out, "%s(", in->type->glsl);
        shader_write_local(w, in);
        fprintf(w->out, in->type->kind == KIND_FLAT ? ".xy" : "");
        write_params(w, in, head, FIELD_HEAD_NUMBERS);
        fprintf(w->out, ") * P(%u).x", head);
    } else {
        write_code(w, in);
    }
    fprintf(w->out, ", P(%u).w, P(%u).x)", head, head + 1);
    if (w->surface) {
        fprintf(w->out, ", P(%u).yz)", head);
    }
    fprintf(w->out, ";\n");
    w->mixed[in->a] = false;
}

void shader_write_call(const struct shader_writer *w, const struct field_instruction *in,
                       const char *suffix)
{
    fprintf(w->out, "%s%s(", in->type->glsl, suffix);
    shader_write_distance(w, in->a);
    if (in->op == FIELD_COMBINE) {
        fprintf(w->out, ", ");
        shader_write_distance(w, in->b);
    }
    write_params(w, in, in->params, 0);
    fprintf(w->out, ")");
}

void shader_write_number(const struct shader_writer *w, uint32_t index)
{
    fprintf(w->out, "P(%u).%c", index / 4, "xyzw"[index % 4]);
}

void shader_write_domain_call(const struct shader_writer *w, const struct field_instruction *in,
                              const char *suffix, const char *extra)
{
    fprintf(w->out, "%s%s(p%u%s", in->type->glsl, suffix, in->point, extra);
    shader_write_vec4s(w, in->params, in->sdf->domain->vec4s);
    fprintf(w->out, ");\n");
}

void shader_write_codes(const struct shader_writer *w, const struct field_code *codes, size_t count,
                        const char *prefix, int first_source)
{
    for (size_t i = 0; i < count; i++) {
        char name[32];
        snprintf(name, sizeof name, "%s_%zu", prefix, i);
        code_write(codes[i].code, name, first_source + (int)i, w->out);
    }
}
