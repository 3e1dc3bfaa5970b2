/* SPDX-License-Identifier: MIT */
/* Operations on mixtures for interpreters of a field, where each slot has one. */

#include "mixture.glsl"

Mixture mixed(float d, float share, Mixture a, Mixture b)
{
    return blend(d, share, a, b);
}

/* Both sides of an operation that never mixes. */
Mixture chosen(float d, float share, Mixture a, Mixture b)
{
    Mixture m = a;
    if (share > 0.5) {
        m = b;
    }
    m.d = d;
    return m;
}

/* Of a shape with this point in its space. */
Mixture alone(float d, float leaf, float slot, vec3 place)
{
    return mixture(vec3(d, leaf, slot) AND_PLACE(place));
}
