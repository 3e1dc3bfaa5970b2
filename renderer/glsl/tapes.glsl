/* SPDX-License-Identifier: MIT */
/* A field as data: operations, and cubes of space with the operations that matter in each
 * (TAPE_NUMBERS in interface.h has the layout). An operation's numbers begin at vec4 `own`. */

#include "params.glsl"

layout(binding = UNIT_TAPES) uniform usampler2D tapes;
#define TAPE_TEXEL(i) texelFetch(tapes, ivec2((i) & (TAPES_ROW - 1), (i) >> TAPES_ROW_BITS), 0)

int own = 0;
/* The first of them, read once for whichever kernel runs: how many is known by the operation. */
vec4 ahead[TAPE_AHEAD];

#undef P
#undef P_FROM
#define P(i) ((i) < TAPE_AHEAD ? ahead[min(int(i), TAPE_AHEAD - 1)] : P_ANY(own + int(i)))
#define P_FROM(i) P_ANY(own + int(i))

#include "field.glsl"
#include "mixture.glsl"
