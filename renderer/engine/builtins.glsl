/* SPDX-License-Identifier: MIT */
/* Functions of GLSL's own that users' code can call and renderer/spmd does not know, by those that
 * it does (GLSL 4.30, chapter 8). */

float radians(float x) { return x * 0.01745329252; }
float degrees(float x) { return x * 57.29577951; }

/* Near 0 the difference of exponentials has no digits left: there the series stands for it. */
float sinh(float x)
{
    float x2 = x * x;
    return abs(x) < 0.5 ? x * (1.0 + x2 * (1.0 / 6.0 + x2 * (1.0 / 120.0 + x2 * (1.0 / 5040.0))))
                        : 0.5 * (exp(x) - exp(-x));
}
float cosh(float x) { return 0.5 * (exp(x) + exp(-x)); }
float tanh(float x)
{
    float y = clamp(x, -10.0, 10.0);
    return sinh(y) / cosh(y);
}
/* Above 1e9, x * x + 1 is x * x, and may be too large for a float. */
float asinh(float x)
{
    float y = abs(x);
    return sign(x) * (y < 1e9 ? log(y + sqrt(y * y + 1.0)) : log(y) + 0.6931471806);
}
float acosh(float x)
{
    return x < 1e9 ? log(x + sqrt((x - 1.0) * (x + 1.0))) : log(x) + 0.6931471806;
}
float atanh(float x) { return 0.5 * log((1.0 + x) / (1.0 - x)); }

float roundEven(float x) { return round(x); }
bool isnan(float x) { return x != x; }
bool isinf(float x) { return abs(x) > 3.402823e38; }

bool not(bool a) { return !a; }
bool notEqual(float a, float b) { return a != b; }
bool notEqual(int a, int b) { return a != b; }
bool notEqual(uint a, uint b) { return a != b; }
bool notEqual(bool a, bool b) { return a != b; }

#define VECTORS(T)                                                                                 \
    T faceforward(T n, T i, T of) { return n * (dot(of, i) < 0.0 ? 1.0 : -1.0); }                  \
    T refract(T i, T n, float eta)                                                                 \
    {                                                                                              \
        float along = dot(n, i), k = 1.0 - eta * eta * (1.0 - along * along);                      \
        return k < 0.0 ? T(0.0) : eta * i - (eta * along + sqrt(k)) * n;                           \
    }
VECTORS(float)
VECTORS(vec2)
VECTORS(vec3)
VECTORS(vec4)

float matrixCompMult(float a, float b) { return a * b; }

mat2 outerProduct(vec2 c, vec2 r) { return mat2(c * r.x, c * r.y); }
mat3 outerProduct(vec3 c, vec3 r) { return mat3(c * r.x, c * r.y, c * r.z); }
mat4 outerProduct(vec4 c, vec4 r) { return mat4(c * r.x, c * r.y, c * r.z, c * r.w); }

mat2 transpose(mat2 m) { return mat2(m[0].x, m[1].x, m[0].y, m[1].y); }
mat3 transpose(mat3 m)
{
    return mat3(m[0].x, m[1].x, m[2].x, m[0].y, m[1].y, m[2].y, m[0].z, m[1].z, m[2].z);
}
mat4 transpose(mat4 m)
{
    return mat4(m[0].x, m[1].x, m[2].x, m[3].x, m[0].y, m[1].y, m[2].y, m[3].y, m[0].z, m[1].z,
                m[2].z, m[3].z, m[0].w, m[1].w, m[2].w, m[3].w);
}

float determinant(mat2 m) { return m[0].x * m[1].y - m[1].x * m[0].y; }
float determinant(mat3 m) { return dot(m[0], cross(m[1], m[2])); }

/* The vector at right angles to three others, as long as the volume between them. */
vec4 across(vec4 a, vec4 b, vec4 c)
{
    return vec4(dot(a.yzw, cross(b.yzw, c.yzw)), -dot(a.xzw, cross(b.xzw, c.xzw)),
                dot(a.xyw, cross(b.xyw, c.xyw)), -dot(a.xyz, cross(b.xyz, c.xyz)));
}
float determinant(mat4 m) { return dot(m[0], across(m[1], m[2], m[3])); }

/* Rows of the inverse are at right angles to all columns but one. */
mat2 inverse(mat2 m)
{
    float by = 1.0 / determinant(m);
    return mat2(m[1].y * by, -m[0].y * by, -m[1].x * by, m[0].x * by);
}
mat3 inverse(mat3 m)
{
    float by = 1.0 / determinant(m);
    return transpose(mat3(cross(m[1], m[2]) * by, cross(m[2], m[0]) * by, cross(m[0], m[1]) * by));
}
mat4 inverse(mat4 m)
{
    float by = 1.0 / determinant(m);
    return transpose(mat4(across(m[1], m[2], m[3]) * by, -across(m[0], m[2], m[3]) * by,
                          across(m[0], m[1], m[3]) * by, -across(m[0], m[1], m[2]) * by));
}
