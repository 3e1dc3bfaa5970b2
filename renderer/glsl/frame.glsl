/* SPDX-License-Identifier: MIT */
/* What is the same for a whole picture, filled in by frame.c; and where the current tile lies. */

#define INFINITY uintBitsToFloat(0x7f800000u)
#define LIGHT_DIRECTIONAL 0
#define LIGHT_POINT 1
#define SHADOW_NONE 0
#define SHADOW_HARD 1
#define SKY_GRADIENT 0

struct Light {
    vec4 place;  /* xyz: direction towards the light, or position; w: LIGHT_... */
    vec4 color;  /* rgb times intensity; w: sharpness of the soft shadow */
    vec4 extent; /* x: radius, y: range (0: none), z: SHADOW_... */
};

layout(std140, binding = 0) uniform Frame {
    vec4 eye;        /* w: 0 perspective, 1 orthographic */
    vec4 forward;    /* w: radius of a pixel: per unit of distance, or absolute if orthographic */
    vec4 right;      /* half the width of the picture, at distance 1 if perspective */
    vec4 up;         /* half its height */
    vec4 bounds_min; /* nothing is outside of these; w: least distance along a ray */
    vec4 bounds_max; /* w: greatest distance along a ray */
    vec4 zenith;     /* w: exposure factor */
    vec4 horizon;    /* w: intensity of ambient light */
    vec4 ground;     /* w: reach of ambient occlusion */
    ivec4 size;      /* width, height in pixels; samples per axis; steps of a ray */
    ivec4 modes;     /* lights; SKY_...; tone map; steps of a shadow ray */
    Light lights[LIGHTS_MAX];
};

/* xy: first pixel of the tile; z: always 0, so that loops starting there are not unrolled; w: 1 for
 * the coarse run of march.glsl. */
uniform ivec4 tile;
#define zero tile.z

/* Where a ray is inside the bounds: entry and exit; exit < entry where it misses them. */
vec2 bounds_span(vec3 origin, vec3 direction)
{
    vec3 inverse = 1.0 / direction;
    vec3 a = (bounds_min.xyz - origin) * inverse;
    vec3 b = (bounds_max.xyz - origin) * inverse;
    vec3 near = min(a, b), far = max(a, b);
    return vec2(max(near.x, max(near.y, near.z)), min(far.x, min(far.y, far.z)));
}
