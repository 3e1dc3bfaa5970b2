/* SPDX-License-Identifier: MIT */
/* What users' code calls (renderer/code/builtins.h): as GLSL's own, but with a meaning for every
 * argument. */

#include "jets.glsl"
#include "noise.glsl"

#define CODE_TINY 1e-30
#define CODE_WALL 0.015625 /* how far the walls of patterns are beyond whole numbers */
#define CODE_OCTAVES 8

/* Distances and colours beyond these are none: the FAR of glsl/field_mask.glsl, and half floats. */
#define CODE_FAR 1e9
#define CODE_BRIGHT 65504.0

/* One shape of floats; `none` is 1 in the components where something would be divided by 0. Some
 * drivers' own asin() has four digits, their atan() seven. */
#define CODE_FLOATS(T)                                                                             \
    T code_nonzero(T x) { return x + CODE_TINY * step(abs(x), T(0.0)); }                           \
    T code_sqrt(T x) { return sqrt(max(x, 0.0)); }                                                 \
    T code_inversesqrt(T x) { return inversesqrt(max(x, CODE_TINY)); }                             \
    T code_pow(T x, T y) { return pow(max(abs(x), CODE_TINY * step(y, T(0.0))), y); }              \
    T code_log(T x) { return log(max(x, CODE_TINY)); }                                             \
    T code_log2(T x) { return log2(max(x, CODE_TINY)); }                                           \
    T code_leg(T x) { return sqrt(max((1.0 - x) * (1.0 + x), 0.0)); }                              \
    T code_asin(T x) { return atan(clamp(x, -1.0, 1.0), code_leg(x)); }                            \
    T code_acos(T x) { return atan(code_leg(x), clamp(x, -1.0, 1.0)); }                            \
    T code_acosh(T x) { return acosh(max(x, 1.0)); }                                               \
    T code_atanh(T x) { return atanh(clamp(x, -0.9999, 0.9999)); }                                 \
    T code_atan(T y, T x) { return atan(y, x + step(abs(x) + abs(y), T(0.0))); }                   \
    T code_between_walls(T x) { return x - CODE_WALL * sign(x - 0.5); }                            \
    T code_stripes(T x) { return step(0.5, fract(x - CODE_WALL * sign(x - 0.25))); }               \
    T code_saturate(T x) { return clamp(x, 0.0, 1.0); }                                            \
    T code_normalize(T x) { return x * inversesqrt(max(dot(x, x), CODE_TINY)); }                   \
    T code_mod(T x, T y)                                                                           \
    {                                                                                              \
        T none = step(abs(y), T(0.0));                                                             \
        return x - y * floor(x / (y + none));                                                      \
    }                                                                                              \
    T code_fmod(T x, T y)                                                                          \
    {                                                                                              \
        T none = step(abs(y), T(0.0));                                                             \
        return x - y * trunc(x / (y + none));                                                      \
    }                                                                                              \
    T code_smoothstep(T low, T high, T x)                                                          \
    {                                                                                              \
        T none = step(abs(high - low), T(0.0));                                                    \
        T t = clamp((x - low) / (high - low + none), 0.0, 1.0);                                    \
        return mix(t * t * (3.0 - 2.0 * t), step(low, x), none);                                   \
    }
CODE_FLOATS(float)
CODE_FLOATS(vec2)
CODE_FLOATS(vec3)
CODE_FLOATS(vec4)

/* Whole numbers: a / 0 is 0, and -2147483648 / -1 is itself, which some processors cannot do. */
#define CODE_INTS(T)                                                                               \
    T code_div(T a, T b)                                                                           \
    {                                                                                              \
        T none = 1 - abs(sign(b)), minus = 1 - abs(sign(b + 1));                                   \
        return (1 - none) * (1 - 2 * minus) * (a / (b + none + 2 * minus));                        \
    }                                                                                              \
    T code_rem(T a, T b) { return a - b * code_div(a, b); }
CODE_INTS(int)
CODE_INTS(ivec2)
CODE_INTS(ivec3)
CODE_INTS(ivec4)

#define CODE_UINTS(T)                                                                              \
    T code_div(T a, T b)                                                                           \
    {                                                                                              \
        T some = min(b, T(1u));                                                                    \
        return some * (a / (b + (1u - some)));                                                     \
    }                                                                                              \
    T code_rem(T a, T b) { return a - b * code_div(a, b); }
CODE_UINTS(uint)
CODE_UINTS(uvec2)
CODE_UINTS(uvec3)
CODE_UINTS(uvec4)

/* Floats to whole numbers, into what these hold. */
#define CODE_WHOLE(T, I, U)                                                                        \
    I code_int(T x) { return I(clamp(x, -2147483520.0, 2147483520.0)); }                           \
    U code_uint(T x) { return U(clamp(x, 0.0, 4294967040.0)); }
CODE_WHOLE(float, int, uint)
CODE_WHOLE(vec2, ivec2, uvec2)
CODE_WHOLE(vec3, ivec3, uvec3)
CODE_WHOLE(vec4, ivec4, uvec4)

/* The inverse is nothing where a matrix has none. */
#define CODE_MATRIX(T, COLUMNS)                                                                    \
    T code_inverse(T m)                                                                            \
    {                                                                                              \
        if (determinant(m) == 0.0) {                                                               \
            return T(0.0);                                                                         \
        }                                                                                          \
        return inverse(m);                                                                         \
    }                                                                                              \
    T code_nonzero(T m)                                                                            \
    {                                                                                              \
        for (int i = 0; i < COLUMNS; i++) {                                                        \
            m[i] = code_nonzero(m[i]);                                                             \
        }                                                                                          \
        return m;                                                                                  \
    }
CODE_MATRIX(mat2, 2)
CODE_MATRIX(mat3, 3)
CODE_MATRIX(mat4, 4)

/* Octaves of value noise. */
float code_fbm(vec3 p, int octaves)
{
    return noise_octaves(p, clamp(octaves, 0, CODE_OCTAVES), 0u);
}

/* A number for each cell, by chance. */
float code_hash(vec3 p)
{
    vec3 cell = code_mod(floor(code_between_walls(p)), vec3(65536.0));
    return 0.5 + 0.5 * noise_lattice(uvec3(cell), 0u);
}

/* 0 and 1 by turns. */
float code_checker(vec3 p)
{
    return code_mod(dot(floor(code_between_walls(p)), vec3(1.0)), 2.0);
}

/* The weights of three patterns. */
vec3 code_triplanar(vec3 n)
{
    vec3 x = abs(n);
    x /= max(max(x.x, CODE_TINY), max(x.y, x.z));
    x = x * x * x * x + CODE_TINY;
    return x / dot(x, vec3(1.0));
}

/* A number, whatever the code of a user gave. */
float code_distance(float d)
{
    return abs(d) < CODE_FAR ? d : CODE_FAR;
}

/* A colour; magenta where there is none. */
vec4 code_color(vec4 c)
{
    if (all(lessThan(abs(c), vec4(CODE_FAR)))) {
        return clamp(c, vec4(0.0), vec4(vec3(CODE_BRIGHT), 1.0));
    }
    return vec4(1.0, 0.0, 1.0, 1.0);
}

/* What a shader says of a point: Surface of renderer/code/types.c, in its order. */
struct CodeSurface {
    vec3 color;
    float metallic, roughness, reflectivity, transmission, ior;
    vec3 emission, absorption;
};

/* Within its limits; magenta where something is no number. */
CodeSurface code_surface(CodeSurface s)
{
    vec4 a = vec4(s.color, s.metallic), b = vec4(s.emission, s.roughness);
    vec4 c = vec4(s.absorption, s.ior), d = vec4(s.reflectivity, s.transmission, 0.0, 0.0);
    vec4 far = vec4(CODE_FAR);
    if (!(all(lessThan(abs(a), far)) && all(lessThan(abs(b), far)) &&
          all(lessThan(abs(c), far)) && all(lessThan(abs(d), far)))) {
        return CodeSurface(vec3(1.0, 0.0, 1.0), 0.0, 0.5, 0.0, 0.0, 1.5, vec3(0.0), vec3(0.0));
    }
    return CodeSurface(clamp(s.color, 0.0, CODE_BRIGHT), clamp(s.metallic, 0.0, 1.0),
                       clamp(s.roughness, 0.0, 1.0), clamp(s.reflectivity, 0.0, 1.0),
                       clamp(s.transmission, 0.0, 1.0), clamp(s.ior, 1.0, 4.0),
                       clamp(s.emission, 0.0, CODE_BRIGHT), clamp(s.absorption, 0.0, 65000.0));
}
