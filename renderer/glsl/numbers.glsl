/* SPDX-License-Identifier: MIT */
/* The numbers of the field: N(i) is vec4 number i, out of a uniform block or of a texture.
 *
 * NUMBERS_PRELOAD(X), where it is defined, lists those that map() reads. They are then copied to
 * variables before anything is marched: llvmpipe would fetch a number anew at each use, which took
 * 70 % of a picture. GPUs have constants at hand and no registers to spare.
 *
 * NUMBERS_SHARED, where it is defined, is how many of them a work group fetches together: from
 * shared memory the same number comes to all lanes at once, from a texture to one after another. */

#include "interface.glsl"

#ifdef NUMBERS_IN_TEXTURE
layout(binding = UNIT_NUMBERS) uniform sampler2D numbers;
#define N_ANY(i) texelFetch(numbers, ivec2((i) % NUMBERS_ROW, (i) / NUMBERS_ROW), 0)
#else
layout(std140, binding = BINDING_NUMBERS) uniform Numbers {
    vec4 numbers[NUMBERS_COUNT];
};
#define N_ANY(i) numbers[i]
#endif

/* What a shape reads of its own block, from a constant on. */
#define N_FROM(i) N_ANY(i)

#ifdef NUMBERS_PRELOAD
vec4 preloaded[NUMBERS_PRELOADED];

#ifdef NUMBERS_SHARED
shared vec4 fetched[NUMBERS_SHARED];

void fetch()
{
    for (uint i = gl_LocalInvocationIndex; i < uint(NUMBERS_SHARED); i += uint(GROUP_SIZE)) {
        fetched[i] = N_ANY(int(i));
    }
    barrier();
}
#define PRELOADED(i) (i < NUMBERS_SHARED ? fetched[min(i, NUMBERS_SHARED - 1)] : N_ANY(i))
#else
void fetch() {}
#define PRELOADED(i) N_ANY(i)
#endif

/* Before anything else: all of a group take part. */
void preload()
{
    fetch();
#define COPY(i) preloaded[i] = PRELOADED(i);
    NUMBERS_PRELOAD(COPY)
#undef COPY
}
#define N(i) preloaded[i]
#else
void preload() {}
#define N(i) N_ANY(i)
#endif
