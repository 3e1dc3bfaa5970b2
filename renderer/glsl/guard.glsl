/* SPDX-License-Identifier: MIT */
/* Looking at the box of a subtree before looking at the subtree. */

/* Distance to a box, 0 inside: (centre, scale), (half, unused). */
float guard(vec3 p, vec4 centre, vec4 box)
{
    return length(max(abs(p - centre.xyz) - box.xyz, 0.0)) * centre.w;
}

/* How often the subtree is run: not at all where its box is farther than what is known to be. */
int guard_rounds(float g, float d)
{
    return g == 0.0 || g < d ? 1 : 0;
}

/* The distance with the subtree in it, which is no nearer than its box. */
float guarded(float d, float g)
{
    return g > 0.0 ? max(d, g) : d;
}
