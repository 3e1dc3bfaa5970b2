/* SPDX-License-Identifier: MIT */
/* The numbers of the field: N(i) is vec4 number i. NUMBERS_COUNT is set by the shape; what does not
 * fit in a uniform block comes from a texture.
 *
 * NUMBERS_PRELOAD(X), where it is defined, lists those that map() reads. They are then copied to
 * variables before anything is marched: llvmpipe reads a uniform anew at each use, through a bounds
 * check, which took 70 % of a picture. GPUs have constants at hand and no registers to spare. */

#ifdef NUMBERS_IN_TEXTURE
layout(binding = 3) uniform samplerBuffer numbers;
#define N_ANY(i) texelFetch(numbers, i)
#else
layout(std140, binding = 1) uniform Numbers {
    vec4 numbers[NUMBERS_COUNT];
};
#define N_ANY(i) numbers[i]
#endif

#ifdef NUMBERS_PRELOAD
vec4 preloaded[NUMBERS_PRELOADED];

void preload()
{
#define COPY(i) preloaded[i] = N_ANY(i);
    NUMBERS_PRELOAD(COPY)
#undef COPY
}
#define N(i) preloaded[i]
#else
void preload() {}
#define N(i) N_ANY(i)
#endif
