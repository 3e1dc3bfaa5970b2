/* SPDX-License-Identifier: MIT */
/* The numbers of the field. NUMBERS_COUNT is set by the shape; what does not fit in a uniform block
 * comes from a texture. */

#ifdef NUMBERS_IN_TEXTURE
layout(binding = 3) uniform samplerBuffer numbers;
#define N(i) texelFetch(numbers, i)
#else
layout(std140, binding = 1) uniform Numbers {
    vec4 numbers[NUMBERS_COUNT];
};
#define N(i) numbers[i]
#endif
