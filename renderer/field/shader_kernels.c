/* SPDX-License-Identifier: MIT */
/* GLSL of single instructions, for interpreters. */
#include "renderer/sdf/patches.h"
#include "renderer/sdf/polynomial.h"
#include "shader.h"
#include "shader_calls.h"

static const struct sdf *find_sdf(const struct node_type *type)
{
    return type->kind == KIND_EQUATION  ? &sdf_polynomial
           : type->kind == KIND_SURFACE ? &sdf_patches
                                        : sdf_find(type);
}

bool shader_has_kernel(const struct node_type *type, enum shader_kernel kernel)
{
    const struct sdf *sdf = find_sdf(type);
    const struct sdf_domain *domain = sdf ? sdf->domain : NULL;

    switch (kernel) {
    case KERNEL_SHAPE:
        return sdf && sdf->shape;
    case KERNEL_COMBINE:
    case KERNEL_SHARE:
        return sdf && sdf->combine;
    case KERNEL_CHANGE:
        return sdf && sdf->change;
    case KERNEL_MAP:
        return domain && domain->map;
    case KERNEL_AFTER:
        return domain && domain->after;
    default:
        return domain && domain->range;
    }
}

void shader_code_kernel(FILE *out, const char *name, const struct field *field, uint32_t code)
{
    const struct field_instruction in = {.op = FIELD_SHAPE, .choices = code};
    struct shader_writer w = {.out = out, .field = field};

    fprintf(out, "float %s(vec3 p0)\n{\nfloat ", name);
    shader_write_shape(&w, &in);
    fprintf(out, "return d0;\n}\n");
}

void shader_code_kernels(FILE *out)
{
    const struct field none = {0};
    const struct field_instruction in = {.op = FIELD_SHAPE};
    struct shader_writer w = {.out = out, .field = &none};

    fprintf(out, "vec3 kernel_code_point(vec3 p0)\n{\nreturn ");
    shader_write_code_point(&w, &in);
    fprintf(out, ";\n}\nfloat kernel_code_shape(float d, vec3 p0)\n{\nfloat ");
    shader_write_shape(&w, &in);
    fprintf(out, "return d0;\n}\n");
}

void shader_kernel(FILE *out, const char *name, const struct node_type *type, uint32_t choices,
                   enum shader_kernel kernel)
{
    static const struct {
        const char *result, *parameters, *suffix;
    } rows[] = {
        [KERNEL_SHAPE] = {"float", "vec3 p0", ""},
        [KERNEL_COMBINE] = {"float", "float d0, float d1", ""},
        [KERNEL_SHARE] = {"float", "float d0, float d1", "_share"},
        [KERNEL_CHANGE] = {"float", "float d0", ""},
        [KERNEL_MAP] = {"vec3", "vec3 p0", ""},
        [KERNEL_FIRST] = {"vec3", "vec3 p0", "_first"},
        [KERNEL_LAST] = {"vec3", "vec3 p0", "_last"},
        [KERNEL_CELL] = {"vec3", "vec3 p0, vec3 cell", "_cell"},
        [KERNEL_AFTER] = {"float", "float d0, vec3 p0", "_after"},
    };
    const struct field none = {0};
    const struct sdf *sdf = find_sdf(type);
    struct field_instruction in = {.type = type, .sdf = sdf, .b = 1, .choices = choices};
    struct shader_writer w = {.out = out, .field = &none};
    in.op = kernel == KERNEL_COMBINE || kernel == KERNEL_SHARE ? FIELD_COMBINE : FIELD_DISTANCE;
    fprintf(out, "%s %s(%s)\n{\n", rows[kernel].result, name, rows[kernel].parameters);
    if (kernel == KERNEL_SHAPE) {
        fprintf(out, "float ");
        shader_write_shape(&w, &in);
        fprintf(out, "return d0;\n}\n");
        return;
    }
    fprintf(out, "return ");
    if (kernel < KERNEL_MAP) {
        shader_write_call(&w, &in, rows[kernel].suffix);
        fprintf(out, ";\n");
    } else if (kernel == KERNEL_AFTER) {
        fprintf(out, "%s_after(d0, p0", type->glsl);
        shader_write_vec4s(&w, 0, in.sdf->domain->vec4s);
        fprintf(out, ");\n");
    } else {
        shader_write_domain_call(&w, &in, rows[kernel].suffix,
                                 kernel == KERNEL_CELL ? ", cell" : "");
    }
    fprintf(out, "}\n");
}
