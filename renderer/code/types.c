/* SPDX-License-Identifier: MIT */
/* The table of names, and questions about types. */
#include "types.h"

#include <stdio.h>
#include <string.h>

/* The first name of a type is the one that GLSL knows. */
static const struct {
    const char *name;
    struct type type;
} names[] = {
    /* clang-format off */
    {"void", {BASE_VOID, 1, 1, 0}},
    {"float", {BASE_FLOAT, 1, 1, 0}}, {"half", {BASE_FLOAT, 1, 1, 0}},
    {"float1", {BASE_FLOAT, 1, 1, 0}},
    {"vec2", {BASE_FLOAT, 2, 1, 0}}, {"float2", {BASE_FLOAT, 2, 1, 0}},
    {"half2", {BASE_FLOAT, 2, 1, 0}},
    {"vec3", {BASE_FLOAT, 3, 1, 0}}, {"float3", {BASE_FLOAT, 3, 1, 0}},
    {"half3", {BASE_FLOAT, 3, 1, 0}},
    {"vec4", {BASE_FLOAT, 4, 1, 0}}, {"float4", {BASE_FLOAT, 4, 1, 0}},
    {"half4", {BASE_FLOAT, 4, 1, 0}},
    {"int", {BASE_INT, 1, 1, 0}}, {"int1", {BASE_INT, 1, 1, 0}},
    {"ivec2", {BASE_INT, 2, 1, 0}}, {"int2", {BASE_INT, 2, 1, 0}},
    {"ivec3", {BASE_INT, 3, 1, 0}}, {"int3", {BASE_INT, 3, 1, 0}},
    {"ivec4", {BASE_INT, 4, 1, 0}}, {"int4", {BASE_INT, 4, 1, 0}},
    {"uint", {BASE_UINT, 1, 1, 0}}, {"uint1", {BASE_UINT, 1, 1, 0}},
    {"uvec2", {BASE_UINT, 2, 1, 0}}, {"uint2", {BASE_UINT, 2, 1, 0}},
    {"uvec3", {BASE_UINT, 3, 1, 0}}, {"uint3", {BASE_UINT, 3, 1, 0}},
    {"uvec4", {BASE_UINT, 4, 1, 0}}, {"uint4", {BASE_UINT, 4, 1, 0}},
    {"bool", {BASE_BOOL, 1, 1, 0}}, {"bool1", {BASE_BOOL, 1, 1, 0}},
    {"bvec2", {BASE_BOOL, 2, 1, 0}}, {"bool2", {BASE_BOOL, 2, 1, 0}},
    {"bvec3", {BASE_BOOL, 3, 1, 0}}, {"bool3", {BASE_BOOL, 3, 1, 0}},
    {"bvec4", {BASE_BOOL, 4, 1, 0}}, {"bool4", {BASE_BOOL, 4, 1, 0}},
    {"mat2", {BASE_FLOAT, 2, 2, 0}}, {"mat2x2", {BASE_FLOAT, 2, 2, 0}},
    {"float2x2", {BASE_FLOAT, 2, 2, 0}}, {"half2x2", {BASE_FLOAT, 2, 2, 0}},
    {"mat3", {BASE_FLOAT, 3, 3, 0}}, {"mat3x3", {BASE_FLOAT, 3, 3, 0}},
    {"float3x3", {BASE_FLOAT, 3, 3, 0}}, {"half3x3", {BASE_FLOAT, 3, 3, 0}},
    {"mat4", {BASE_FLOAT, 4, 4, 0}}, {"mat4x4", {BASE_FLOAT, 4, 4, 0}},
    {"float4x4", {BASE_FLOAT, 4, 4, 0}}, {"half4x4", {BASE_FLOAT, 4, 4, 0}},
    {"Primitive3D", {BASE_PRIMITIVE, 1, 1, 0}},
    {"FragmentProperties", {BASE_FRAGMENT, 1, 1, 0}},
    {"Surface", {BASE_SURFACE, 1, 1, 0}},
    /* clang-format on */
};
enum { NAMES = sizeof names / sizeof names[0] };

/* As struct CodeSurface and code_surface() of glsl/code.glsl; protocol/README.md says what they
 * are. */
const struct surface_member surface_members[SURFACE_MEMBERS] = {
    {"color", 3, 0, 0, 65504},    {"metallic", 1, 3, 0, 1},        {"roughness", 1, 4, 0, 1},
    {"reflectivity", 1, 5, 0, 1}, {"transmission", 1, 6, 0, 1},    {"ior", 1, 7, 1, 4},
    {"emission", 3, 8, 0, 65504}, {"absorption", 3, 11, 0, 65000},
};
const double surface_defaults[SURFACE_NUMBERS] = {0.8, 0.8, 0.8, 0, 0.5, 0, 0,
                                                  1.5, 0,   0,   0, 0,   0, 0};

bool type_find(const char *text, size_t length, struct type *out)
{
    for (size_t i = 0; i < NAMES; i++) {
        if (strncmp(names[i].name, text, length) == 0 && names[i].name[length] == '\0') {
            *out = names[i].type;
            return true;
        }
    }
    return false;
}

const char *type_name(struct type type, char out[TYPE_NAME_BYTES])
{
    const char *name = "?";
    int count = type.count;

    type.count = 0;
    for (size_t i = NAMES; i-- > 0;) {
        if (type_equal(names[i].type, type)) {
            name = names[i].name;
        }
    }
    if (count > 0) {
        snprintf(out, TYPE_NAME_BYTES, "%s[%d]", name, count);
    } else {
        snprintf(out, TYPE_NAME_BYTES, "%s", name);
    }
    return out;
}

const char *type_name_at(size_t index)
{
    return index < NAMES ? names[index].name : NULL;
}

struct type type_vector(enum base base, int rows)
{
    return (struct type){(uint8_t)base, (uint8_t)rows, 1, 0};
}

struct type type_matrix(int size)
{
    return (struct type){BASE_FLOAT, (uint8_t)size, (uint8_t)size, 0};
}

struct type type_element(struct type type)
{
    if (type.count > 0) {
        type.count = 0;
    } else if (type.columns > 1) {
        type.columns = 1;
    } else {
        type.rows = 1;
    }
    return type;
}

int type_elements(struct type type)
{
    return type.count > 0 ? type.count : type.columns > 1 ? type.columns : type.rows;
}

bool type_equal(struct type a, struct type b)
{
    return a.base == b.base && a.rows == b.rows && a.columns == b.columns && a.count == b.count;
}

int type_components(struct type type)
{
    if (type.base == BASE_VOID || type_is_handle(type)) {
        return 0;
    }
    if (type.base == BASE_SURFACE) {
        return SURFACE_NUMBERS;
    }
    return type.rows * type.columns * (type.count > 0 ? type.count : 1);
}

bool type_is_scalar(struct type type)
{
    return type_components(type) == 1 && type.count == 0;
}

bool type_is_vector(struct type type)
{
    return type.rows > 1 && type.columns == 1 && type.count == 0;
}

bool type_is_matrix(struct type type)
{
    return type.columns > 1 && type.count == 0;
}

bool type_is_handle(struct type type)
{
    return type.base == BASE_PRIMITIVE || type.base == BASE_FRAGMENT;
}

bool type_is_surface(struct type type)
{
    return type.base == BASE_SURFACE;
}

bool type_is_number(struct type type)
{
    return type.count == 0 && (type.base == BASE_FLOAT || type_is_integer(type));
}

bool type_is_integer(struct type type)
{
    return type.count == 0 && (type.base == BASE_INT || type.base == BASE_UINT);
}

bool type_is(struct type type, enum base base)
{
    return type_is_scalar(type) && type.base == base;
}
