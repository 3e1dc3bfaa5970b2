/* SPDX-License-Identifier: MIT */
/* How far from p nothing is. The engine has its own, which need not look at the whole field where
 * `exact` is false (renderer/engine/cells.c). */

#include "field_map.glsl"

float field_bound(vec3 p, bool exact)
{
    return map(p);
}
