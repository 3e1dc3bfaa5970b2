/* SPDX-License-Identifier: MIT */
/* Vectors of LANES numbers, and what the C that renderer/spmd writes calls of them.
 *
 * Every function is made of operations that each round once, in a fixed order, so that all widths
 * give the same bits; nothing is contracted to fused operations (-ffp-contract=off).
 *
 * A mask (vb) has all bits of a lane set, or none. */
#ifndef RENDERER_LANES_H
#define RENDERER_LANES_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define LANES_VECTOR __attribute__((vector_size(4 * LANES)))
typedef float vf LANES_VECTOR;
typedef int32_t vi LANES_VECTOR;
typedef uint32_t vu LANES_VECTOR;
typedef vi vb;

#define LANES_INLINE static inline __attribute__((always_inline, unused))

static const vf vf_zero __attribute__((unused)) = {0};
static const vi vi_zero __attribute__((unused)) = {0};
static const vu vu_zero __attribute__((unused)) = {0};
static const vb vb_zero __attribute__((unused)) = {0};

/* Of each lane, its number. */
static const vi lanes_number __attribute__((unused)) = {
    0, 1, 2,  3,
#if LANES >= 8
    4, 5, 6,  7,
#endif
#if LANES >= 16
    8, 9, 10, 11, 12, 13, 14, 15,
#endif
};

LANES_INLINE vf vf_all(float x)
{
    return vf_zero + x;
}
LANES_INLINE vi vi_all(int x)
{
    return vi_zero + x;
}
LANES_INLINE vu vu_all(unsigned x)
{
    return vu_zero + x;
}
LANES_INLINE vb vb_all(bool x)
{
    return vi_zero - (int)x;
}

LANES_INLINE vb vb_select(vb m, vb a, vb b)
{
    return (a & m) | (b & ~m);
}
LANES_INLINE vi vi_select(vb m, vi a, vi b)
{
    return (a & m) | (b & ~m);
}
LANES_INLINE vu vu_select(vb m, vu a, vu b)
{
    return (vu)vi_select(m, (vi)a, (vi)b);
}
LANES_INLINE vf vf_select(vb m, vf a, vf b)
{
    return (vf)vi_select(m, (vi)a, (vi)b);
}

#if defined __AVX512F__ && LANES == 16
#include <immintrin.h>
LANES_INLINE bool lanes_any(vb m)
{
    return _mm512_test_epi32_mask((__m512i)m, (__m512i)m) != 0;
}
LANES_INLINE vf vf_min(vf a, vf b)
{
    return (vf)_mm512_min_ps((__m512)b, (__m512)a);
}
LANES_INLINE vf vf_max(vf a, vf b)
{
    return (vf)_mm512_max_ps((__m512)b, (__m512)a);
}
LANES_INLINE vf vf_sqrt(vf x)
{
    return (vf)_mm512_sqrt_ps((__m512)x);
}
LANES_INLINE vf vf_floor(vf x)
{
    return (vf)_mm512_roundscale_ps((__m512)x, 9);
}
LANES_INLINE vf vf_trunc(vf x)
{
    return (vf)_mm512_roundscale_ps((__m512)x, 11);
}
#elif defined __AVX__ && LANES == 8
#include <immintrin.h>
LANES_INLINE bool lanes_any(vb m)
{
    return !_mm256_testz_si256((__m256i)m, (__m256i)m);
}
LANES_INLINE vf vf_min(vf a, vf b)
{
    return (vf)_mm256_min_ps((__m256)b, (__m256)a);
}
LANES_INLINE vf vf_max(vf a, vf b)
{
    return (vf)_mm256_max_ps((__m256)b, (__m256)a);
}
LANES_INLINE vf vf_sqrt(vf x)
{
    return (vf)_mm256_sqrt_ps((__m256)x);
}
LANES_INLINE vf vf_floor(vf x)
{
    return (vf)_mm256_floor_ps((__m256)x);
}
LANES_INLINE vf vf_trunc(vf x)
{
    return (vf)_mm256_round_ps((__m256)x, 3);
}
#else
LANES_INLINE bool lanes_any(vb m)
{
    int any = 0;
    for (int i = 0; i < LANES; i++) {
        any |= m[i];
    }
    return any != 0;
}
LANES_INLINE vf vf_min(vf a, vf b)
{
    return vf_select(b < a, b, a);
}
LANES_INLINE vf vf_max(vf a, vf b)
{
    return vf_select(a < b, b, a);
}
LANES_INLINE vf vf_sqrt(vf x)
{
    for (int i = 0; i < LANES; i++) {
        x[i] = sqrtf(x[i]);
    }
    return x;
}
/* What is above 2^23 is whole. */
LANES_INLINE vf vf_trunc(vf x)
{
    vf size = (vf)((vi)x & 0x7fffffff),
       whole = __builtin_convertvector(
           __builtin_convertvector(vf_select(size < 8388608.0f, x, vf_zero), vi), vf);
    whole = (vf)((vi)whole | ((vi)x & (int)0x80000000));
    return vf_select(size < 8388608.0f, whole, x);
}
LANES_INLINE vf vf_floor(vf x)
{
    vf whole = vf_trunc(x);
    return vf_select(whole > x, whole - 1.0f, whole);
}
#endif

/* A bit for each. */
LANES_INLINE uint32_t lanes_bits(vb m)
{
#if defined __AVX512F__ && LANES == 16
    return _mm512_test_epi32_mask((__m512i)m, (__m512i)m);
#elif defined __AVX__ && LANES == 8
    return (uint32_t)_mm256_movemask_ps((__m256)m);
#else
    uint32_t bits = 0;
    for (int i = 0; i < LANES; i++) {
        bits |= (uint32_t)(m[i] & 1) << i;
    }
    return bits;
#endif
}
/* The first that is on; the last where none is. */
LANES_INLINE int lanes_first(vb m)
{
    return __builtin_ctz(lanes_bits(m) | 1u << (LANES - 1));
}
LANES_INLINE uint32_t lanes_count(vb m)
{
    return (uint32_t)__builtin_popcount(lanes_bits(m));
}
/* The least of them; any where some are no numbers. */
LANES_INLINE float lanes_least(vf x)
{
#if defined __AVX512F__ && LANES == 16
    return _mm512_reduce_min_ps((__m512)x);
#else
    float least = x[0];
    for (int i = 1; i < LANES; i++) {
        least = x[i] < least ? x[i] : least;
    }
    return least;
#endif
}

LANES_INLINE vf vf_ceil(vf x)
{
    return -vf_floor(-x);
}
LANES_INLINE vf vf_abs(vf x);
/* To the nearest even one of two as near: beyond 2^22 all are whole. */
LANES_INLINE vf vf_round(vf x)
{
    vf whole = (x + 12582912.0f) - 12582912.0f;
    return vf_select(vf_abs(x) < 4194304.0f, whole, x);
}
LANES_INLINE vf vf_abs(vf x)
{
    return (vf)((vi)x & 0x7fffffff);
}
LANES_INLINE vf vf_sign(vf x)
{
    return (vf)((vi)vf_all(1.0f) & (x > 0.0f)) - (vf)((vi)vf_all(1.0f) & (x < 0.0f));
}
LANES_INLINE vf vf_fract(vf x)
{
    return x - vf_floor(x);
}
LANES_INLINE vf vf_clamp(vf x, vf low, vf high)
{
    return vf_min(vf_max(x, low), high);
}
LANES_INLINE vf vf_mix(vf a, vf b, vf t)
{
    return a * (1.0f - t) + b * t;
}
LANES_INLINE vf vf_step(vf edge, vf x)
{
    return (vf)((vi)vf_all(1.0f) & ~(x < edge));
}
LANES_INLINE vf vf_smoothstep(vf low, vf high, vf x)
{
    vf t = vf_clamp((x - low) / (high - low), vf_zero, vf_all(1.0f));
    return t * t * (3.0f - 2.0f * t);
}
LANES_INLINE vf vf_mod(vf x, vf y)
{
    return x - y * vf_floor(x / y);
}
LANES_INLINE vf vf_inversesqrt(vf x)
{
    return 1.0f / vf_sqrt(x);
}

LANES_INLINE vi vi_sign(vi x)
{
    return (x < 0) - (x > 0);
}
LANES_INLINE vi vi_min(vi a, vi b)
{
    return vi_select(b < a, b, a);
}
LANES_INLINE vi vi_max(vi a, vi b)
{
    return vi_select(a < b, b, a);
}
LANES_INLINE vi vi_abs(vi x)
{
    return vi_max(x, -x);
}
LANES_INLINE vi vi_clamp(vi x, vi low, vi high)
{
    return vi_min(vi_max(x, low), high);
}
LANES_INLINE vu vu_min(vu a, vu b)
{
    return vu_select(b < a, b, a);
}
LANES_INLINE vu vu_max(vu a, vu b)
{
    return vu_select(a < b, b, a);
}

LANES_INLINE vf vf_of_i(vi x)
{
    return __builtin_convertvector(x, vf);
}
/* By halves, so that the sign plays no part. */
LANES_INLINE vf vf_of_u(vu x)
{
    return __builtin_convertvector((vi)(x >> 16), vf) * 65536.0f +
           __builtin_convertvector((vi)(x & 0xffffu), vf);
}
LANES_INLINE vf vf_of_b(vb x)
{
    return (vf)((vi)vf_all(1.0f) & x);
}
LANES_INLINE vi vi_of_f(vf x)
{
    return __builtin_convertvector(x, vi);
}
LANES_INLINE vi vi_of_u(vu x)
{
    return (vi)x;
}
LANES_INLINE vi vi_of_b(vb x)
{
    return x & 1;
}
LANES_INLINE vu vu_of_i(vi x)
{
    return (vu)x;
}
LANES_INLINE vu vu_of_b(vb x)
{
    return (vu)(x & 1);
}
/* Up to 2^31. */
LANES_INLINE vu vu_of_f(vf x)
{
    return (vu) __builtin_convertvector(x, vi);
}
LANES_INLINE vb vb_of_i(vi x)
{
    return x != 0;
}

LANES_INLINE vu vu_bitfieldReverse(vu x)
{
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

/* --- functions by polynomials: Cephes Mathematical Library 2.8, single precision (Moshier,
 * netlib.org/cephes: sinf.c, expf.c, logf.c, atanf.c, asinf.c); errors are a few units in the last
 * place --- */

/* 2^n for whole n from -126 to 127. */
LANES_INLINE vf lanes_power_of_two(vi n)
{
    return (vf)((n + 127) << 23);
}

LANES_INLINE vf vf_exp2(vf x)
{
    vf y = vf_clamp(x, vf_all(-126.0f), vf_all(127.999f));
    vf whole = vf_floor(y + 0.5f), t = y - whole;
    vf p = 1.535336188319500e-4f * t + 1.339887440266574e-3f;
    p = p * t + 9.618437357674640e-3f;
    p = p * t + 5.550332471162809e-2f;
    p = p * t + 2.402264791363012e-1f;
    p = p * t + 6.931472028550421e-1f;
    p = p * t + 1.0f;
    /* In two steps: 2^128 alone is none. */
    vf value = p * lanes_power_of_two(vi_of_f(whole) - 1) * 2.0f;
    value = vf_select(x < -126.0f, vf_zero, value);
    value = vf_select(x >= 128.0f, vf_all(INFINITY), value);
    return vf_select(x == x, value, x);
}

LANES_INLINE vf vf_exp(vf x)
{
    vf whole = vf_floor(x * 1.44269504088896341f + 0.5f);
    whole = vf_clamp(whole, vf_all(-150.0f), vf_all(150.0f));
    vf t = x - whole * 0.693359375f;
    t = t + whole * 2.12194440e-4f;
    vf p = 1.9875691500e-4f * t + 1.3981999507e-3f;
    p = p * t + 8.3334519073e-3f;
    p = p * t + 4.1665795894e-2f;
    p = p * t + 1.6666665459e-1f;
    p = p * t + 5.0000001201e-1f;
    p = p * t * t + t + 1.0f;
    vi n = vi_of_f(vf_clamp(whole, vf_all(-126.0f), vf_all(127.0f)));
    vf value = p * lanes_power_of_two(n);
    value = vf_select(x < -87.3f, vf_zero, value);
    return vf_select(x > 88.7f, vf_all(INFINITY), value);
}

/* Of the mantissa's part from sqrt(1/2) to sqrt(2), the natural logarithm; `*out_exponent`. */
LANES_INLINE vf lanes_log_parts(vf x, vf *out_exponent, vf *out_mantissa)
{
    vi bits = (vi)x, exponent = ((bits >> 23) & 255) - 126;
    vf mantissa = (vf)((bits & 0x007fffff) | 0x3f000000);
    vb low = mantissa < 0.707106781186547524f;
    vf n = vf_of_i(exponent + low), t = mantissa + vf_select(low, mantissa, vf_zero) - 1.0f;
    vf z = t * t;
    vf p = 7.0376836292e-2f * t - 1.1514610310e-1f;
    p = p * t + 1.1676998740e-1f;
    p = p * t - 1.2420140846e-1f;
    p = p * t + 1.4249322787e-1f;
    p = p * t - 1.6668057665e-1f;
    p = p * t + 2.0000714765e-1f;
    p = p * t - 2.4999993993e-1f;
    p = p * t + 3.3333331174e-1f;
    *out_exponent = n;
    *out_mantissa = t;
    return p * t * z - 0.5f * z;
}

/* Of 0 and less -infinity; infinity of itself. */
LANES_INLINE vf lanes_log_ends(vf x, vf value)
{
    value = vf_select(x < 1.17549435e-38f, vf_all(-INFINITY), value);
    return vf_select(x < INFINITY, value, x);
}

LANES_INLINE vf vf_log(vf x)
{
    vf n, t, rest = lanes_log_parts(x, &n, &t);
    return lanes_log_ends(x, (rest + n * -2.12194440e-4f) + t + n * 0.693359375f);
}

LANES_INLINE vf vf_log2(vf x)
{
    vf n, t, rest = lanes_log_parts(x, &n, &t);
    vf value = rest * 0.44269504088896340735992f;
    value = value + t * 0.44269504088896340735992f;
    value = value + rest;
    value = value + t;
    return lanes_log_ends(x, value + n);
}

LANES_INLINE vf vf_pow(vf x, vf y)
{
    vf value = vf_exp2(y * vf_log2(x));
    return vf_select((x == 0.0f) & (y > 0.0f), vf_zero, value);
}

/* Sine and cosine of an angle below 8192. */
LANES_INLINE void lanes_sincos(vf x, vf *out_sin, vf *out_cos)
{
    vf size = vf_abs(x);
    vi octant = vi_of_f(size * 1.27323954473516f);
    octant = (octant + 1) & ~1;
    vf n = vf_of_i(octant);
    vf t = ((size - n * 0.78515625f) - n * 2.4187564849853515625e-4f) - n * 3.77489497744594108e-8f;
    vf z = t * t;
    vf c =
        ((2.443315711809948e-5f * z - 1.388731625493765e-3f) * z + 4.166664568298827e-2f) * z * z -
        0.5f * z + 1.0f;
    vf s = ((-1.9515295891e-4f * z + 8.3321608736e-3f) * z - 1.6666654611e-1f) * z * t + t;
    vb swapped = (octant & 2) != 0;
    vi sin_sign = ((octant & 4) << 29) ^ ((vi)x & (int)0x80000000);
    vi cos_sign = ((octant + 2) & 4) << 29;
    *out_sin = (vf)((vi)vf_select(swapped, c, s) ^ sin_sign);
    *out_cos = (vf)((vi)vf_select(swapped, s, c) ^ cos_sign);
}

LANES_INLINE vf vf_sin(vf x)
{
    vf s, c;
    lanes_sincos(x, &s, &c);
    return s;
}
LANES_INLINE vf vf_cos(vf x)
{
    vf s, c;
    lanes_sincos(x, &s, &c);
    return c;
}
LANES_INLINE vf vf_tan(vf x)
{
    vf s, c;
    lanes_sincos(x, &s, &c);
    return s / c;
}

/* From 0 on. */
LANES_INLINE vf lanes_atan_of(vf x)
{
    vb large = x > 2.414213562373095f, middle = (x > 0.4142135623730950f) & ~large;
    vf y = vf_select(large, vf_all(1.570796326794896619f),
                     vf_select(middle, vf_all(0.785398163397448310f), vf_zero));
    vf t = vf_select(large, -1.0f / x, vf_select(middle, (x - 1.0f) / (x + 1.0f), x));
    vf z = t * t;
    vf p = 8.05374449538e-2f * z - 1.38776856032e-1f;
    p = p * z + 1.99777106478e-1f;
    p = p * z - 3.33329491539e-1f;
    return y + (p * z * t + t);
}

LANES_INLINE vf vf_atan(vf x)
{
    return (vf)((vi)lanes_atan_of(vf_abs(x)) | ((vi)x & (int)0x80000000));
}

LANES_INLINE vf vf_atan2(vf y, vf x)
{
    vf ax = vf_abs(x), ay = vf_abs(y);
    vf angle = lanes_atan_of(vf_min(ax, ay) / vf_max(vf_max(ax, ay), vf_all(1e-37f)));
    angle = vf_select(ay > ax, 1.570796326794896619f - angle, angle);
    angle = vf_select(x < 0.0f, 3.141592653589793238f - angle, angle);
    return (vf)((vi)angle | ((vi)y & (int)0x80000000));
}

LANES_INLINE vf vf_asin(vf x)
{
    vf a = vf_abs(x);
    vb high = a > 0.5f;
    vf z = vf_select(high, 0.5f * (1.0f - a), a * a), t = vf_select(high, vf_sqrt(z), a);
    vf p = 4.2163199048e-2f * z + 2.4181311049e-2f;
    p = p * z + 4.5470025998e-2f;
    p = p * z + 7.4953002686e-2f;
    p = p * z + 1.6666752422e-1f;
    vf value = p * z * t + t;
    value = vf_select(high, 1.570796326794896619f - (value + value), value);
    return (vf)((vi)value | ((vi)x & (int)0x80000000));
}
LANES_INLINE vf vf_acos(vf x)
{
    return 1.570796326794896619f - vf_asin(x);
}

/* --- one number for all lanes: the same bits --- */

LANES_INLINE float f_of_i(int x)
{
    return (float)x;
}
LANES_INLINE float f_of_u(unsigned x)
{
    return (float)x;
}
LANES_INLINE float f_of_b(bool x)
{
    return x ? 1.0f : 0.0f;
}
LANES_INLINE int i_of_f(float x)
{
    return (int)x;
}
LANES_INLINE int i_of_u(unsigned x)
{
    return (int)x;
}
LANES_INLINE int i_of_b(bool x)
{
    return x;
}
LANES_INLINE unsigned u_of_i(int x)
{
    return (unsigned)x;
}
LANES_INLINE unsigned u_of_f(float x)
{
    return (unsigned)(int)x;
}
LANES_INLINE float f_min(float a, float b)
{
    return b < a ? b : a;
}
LANES_INLINE float f_max(float a, float b)
{
    return a < b ? b : a;
}
LANES_INLINE float f_abs(float x)
{
    return fabsf(x);
}
LANES_INLINE float f_clamp(float x, float low, float high)
{
    return f_min(f_max(x, low), high);
}
LANES_INLINE float f_sqrt(float x)
{
    return sqrtf(x);
}
LANES_INLINE float f_inversesqrt(float x)
{
    return 1.0f / sqrtf(x);
}
LANES_INLINE float f_floor(float x)
{
    return floorf(x);
}
LANES_INLINE float f_round(float x)
{
    return vf_round(vf_all(x))[0];
}
LANES_INLINE float f_trunc(float x)
{
    return truncf(x);
}
LANES_INLINE float f_ceil(float x)
{
    return ceilf(x);
}
LANES_INLINE float f_fract(float x)
{
    return x - floorf(x);
}
LANES_INLINE float f_mix(float a, float b, float t)
{
    return a * (1.0f - t) + b * t;
}
LANES_INLINE float f_step(float edge, float x)
{
    return x < edge ? 0.0f : 1.0f;
}
LANES_INLINE float f_sign(float x)
{
    return (float)(x > 0.0f) - (float)(x < 0.0f);
}
LANES_INLINE int i_min(int a, int b)
{
    return b < a ? b : a;
}
LANES_INLINE int i_max(int a, int b)
{
    return a < b ? b : a;
}
LANES_INLINE int i_abs(int a)
{
    return a < 0 ? -a : a;
}
LANES_INLINE int i_clamp(int x, int low, int high)
{
    return i_min(i_max(x, low), high);
}
LANES_INLINE unsigned u_bitfieldReverse(unsigned x)
{
    return vu_bitfieldReverse(vu_all(x))[0];
}
LANES_INLINE unsigned u_min(unsigned a, unsigned b)
{
    return b < a ? b : a;
}
LANES_INLINE unsigned u_max(unsigned a, unsigned b)
{
    return a < b ? b : a;
}
#define LANES_SINGLE(name)                                                                         \
    LANES_INLINE float f_##name(float x)                                                           \
    {                                                                                              \
        return vf_##name(vf_all(x))[0];                                                            \
    }
LANES_SINGLE(exp)
LANES_SINGLE(exp2)
LANES_SINGLE(log)
LANES_SINGLE(log2)
LANES_SINGLE(sin)
LANES_SINGLE(cos)
LANES_SINGLE(tan)
LANES_SINGLE(asin)
LANES_SINGLE(acos)
LANES_SINGLE(atan)
LANES_INLINE float f_pow(float x, float y)
{
    return vf_pow(vf_all(x), vf_all(y))[0];
}
LANES_INLINE float f_atan2(float y, float x)
{
    return vf_atan2(vf_all(y), vf_all(x))[0];
}
LANES_INLINE float f_smoothstep(float low, float high, float x)
{
    return vf_smoothstep(vf_all(low), vf_all(high), vf_all(x))[0];
}
LANES_INLINE float f_mod(float x, float y)
{
    return x - y * floorf(x / y);
}
LANES_INLINE float float_of_bits(unsigned bits)
{
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}
LANES_INLINE unsigned unsigned_of_bits(float x)
{
    unsigned bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* --- memory --- */

/* Where the mask is off: 0. */
LANES_INLINE vf lanes_gather(const void *from, vi at, vb m)
{
#if defined __AVX512F__ && LANES == 16
    return (vf)_mm512_mask_i32gather_ps(_mm512_setzero_ps(), _mm512_movepi32_mask((__m512i)m),
                                        (__m512i)at, from, 4);
#elif defined __AVX2__ && LANES == 8
    return (vf)_mm256_mask_i32gather_ps(_mm256_setzero_ps(), from, (__m256i)at, (__m256)m, 4);
#else
    vf out = vf_zero;
    for (int i = 0; i < LANES; i++) {
        if (m[i]) {
            float x;
            memcpy(&x, (const char *)from + 4 * (ptrdiff_t)at[i], sizeof x);
            out[i] = x;
        }
    }
    return out;
#endif
}
/* Each lane's own element of an array of vectors. */
LANES_INLINE vf lanes_pick(const vf *from, vi at, vb m)
{
    vf out = vf_zero;
    for (int i = 0; i < LANES; i++) {
        out[i] = m[i] ? from[at[i]][i] : 0.0f;
    }
    return out;
}
LANES_INLINE void lanes_put(vf *to, vi at, vf x, vb m)
{
    for (int i = 0; i < LANES; i++) {
        if (m[i]) {
            to[at[i]][i] = x[i];
        }
    }
}

#endif
