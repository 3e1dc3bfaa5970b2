/* SPDX-License-Identifier: MIT */
/* What is at the point where a ray has met something. */

#include "field_surface.glsl"
#include "mixture.glsl"

/* What a ray finds that meets nothing. */
Surface surface_nothing()
{
    Mixture nothing = mixture_far();
    Surface s = surface_begin(nothing);
    s.id = 0u;
    return s;
}

/* A case for each of GEOMETRY_SOURCES (interface.h). `s` begins as surface_nothing(). */
void surface_of(int source, vec3 p, Shading at, inout Surface s)
{
    if (source == GEOMETRY_FIELD) {
        surface(p, at, s);
    }
}
