/* SPDX-License-Identifier: MIT */
/* Half floats (IEEE 754, binary16) of light: finite, 0 or above. */
#ifndef RENDERER_HALF_H
#define RENDERER_HALF_H

#include <math.h>
#include <stdint.h>
#include <string.h>

static const float half_most = 65504;

/* The nearest half, an even one where two are as near. More than the most becomes the most. */
static inline uint16_t half_of(float value)
{
    uint32_t bits;

    value = fminf(value, half_most);
    if (value < 0x1p-14f) {
        return (uint16_t)lrintf(value * 0x1p24f); /* below the least normal one */
    }
    memcpy(&bits, &value, sizeof bits);
    bits += 0xfff + (bits >> 13 & 1);
    return (uint16_t)((bits - (112u << 23)) >> 13);
}

/* Exponents count from -15 in a half, from -127 in a float. */
static inline float half_value(uint16_t half)
{
    const uint32_t bits = (uint32_t)half << 13;
    float value;

    memcpy(&value, &bits, sizeof value);
    return value * 0x1p112f;
}

#endif
