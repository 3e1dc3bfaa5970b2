/* SPDX-License-Identifier: MIT */
/* The numbers of the field: P(i) is vec4 number i, out of a uniform block or of a texture.
 *
 * PARAMS_PRELOAD(X), where it is defined, lists those that map() reads. They are then copied to
 * variables before anything is marched: llvmpipe would fetch a number anew at each use, which took
 * 70 % of a picture. GPUs have constants at hand and no registers to spare.
 *
 * PARAMS_SHARED, where it is defined, is how many of them a work group fetches together: from
 * shared memory the same number comes to all lanes at once, from a texture to one after another. */

#include "interface.glsl"

#ifdef PARAMS_IN_TEXTURE
layout(binding = UNIT_PARAMS) uniform sampler2D params;
#define P_ANY(i) texelFetch(params, ivec2((i) % PARAMS_ROW, (i) / PARAMS_ROW), 0)
#else
layout(std140, binding = BINDING_PARAMS) uniform Params {
    vec4 params[PARAMS_COUNT];
};
#define P_ANY(i) params[i]
#endif

/* What a shape reads of its own block, from a constant on. */
#define P_FROM(i) P_ANY(i)

#ifdef PARAMS_PRELOAD
vec4 preloaded[PARAMS_PRELOADED];

#ifdef PARAMS_SHARED
shared vec4 fetched[PARAMS_SHARED];

void fetch()
{
    for (uint i = gl_LocalInvocationIndex; i < uint(PARAMS_SHARED); i += uint(GROUP_SIZE)) {
        fetched[i] = P_ANY(int(i));
    }
    barrier();
}
#define PRELOADED(i) (i < PARAMS_SHARED ? fetched[min(i, PARAMS_SHARED - 1)] : P_ANY(i))
#else
void fetch() {}
#define PRELOADED(i) P_ANY(i)
#endif

/* Before anything else: all of a group take part. */
void preload()
{
    fetch();
#define COPY(i) preloaded[i] = PRELOADED(i);
    PARAMS_PRELOAD(COPY)
#undef COPY
}
#define P(i) preloaded[i]
#else
void preload() {}
#define P(i) P_ANY(i)
#endif
