/* SPDX-License-Identifier: MIT */
/* What is the same for a whole picture, filled in by frame.c; and where the current tile lies. */

#define INFINITY uintBitsToFloat(0x7f800000u)
#define LIGHT_DIRECTIONAL 0
#define LIGHT_POINT 1
#define LIGHT_SPOT 2
#define SHADOW_NONE 0
#define SHADOW_HARD 1
#define SHADOW_SOFT 2
#define SKY_GRADIENT 0
#define SKY_SOLID 1
#define SKY_IMAGE 2
#define VOLUME_BOX 0
#define VOLUME_ELLIPSOID 1
#define DENSITY_CONSTANT 0
#define DENSITY_NOISE 1
#define DENSITY_FIELD 2

/* Bits of effects.z. */
#define EFFECT_SHADOWS 1
#define EFFECT_REFLECTIONS 2
#define EFFECT_REFRACTIONS 4
#define EFFECT_SUN 8
#define EFFECT_TRANSPARENT 16

struct Light {
    vec4 place;  /* xyz: direction towards the light, or position; w: LIGHT_... */
    vec4 color;  /* rgb times intensity; w: sharpness of the soft shadow */
    vec4 extent; /* x: radius, y: range (0: none), z: SHADOW_..., w: cosine of a cone's rim */
    vec4 axis;   /* xyz: direction of a cone, of length 1; w: cosine where light begins to fade */
};

struct Volume {
    vec4 place;    /* xyz: centre; w: VOLUME_... */
    vec4 extent;   /* xyz: half lengths, or radii; w: falloff */
    vec4 color;    /* w: density */
    vec4 emission; /* w: anisotropy */
    vec4 noise;    /* frequency, octaves, seed, height of waves above which they fill it */
    vec4 source;   /* x: DENSITY_..., y: reach */
};

layout(std140, binding = 0) uniform Frame {
    vec4 eye;        /* w: 0 perspective, 1 orthographic */
    vec4 forward;    /* w: radius of a pixel: per unit of distance, or absolute if orthographic */
    vec4 right;      /* half the picture's width, at distance 1 if perspective; w: lens radius */
    vec4 up;         /* half its height; w: distance in focus */
    vec4 bounds_min; /* nothing is outside of these; w: least distance along a ray */
    vec4 bounds_max; /* w: greatest distance along a ray */
    vec4 clear_min;  /* what light goes through is inside of these; w: 1 where there is any */
    vec4 clear_max;  /* w: what a mirrored or broken ray adds at least */
    vec4 zenith;     /* w: exposure factor */
    vec4 horizon;    /* w: intensity of ambient light */
    vec4 ground;     /* w: reach of ambient occlusion */
    vec4 panorama;   /* cosine, sine of the picture's turn; brightness; strength of occlusion */
    vec4 fog_color;  /* w: density */
    vec4 fog_shape;  /* x: 1 / height of thinning, 0: none; y: base; z, w: unused */
    ivec4 size;      /* width, height in pixels; samples per axis; steps of a ray */
    ivec4 modes;     /* lights; SKY_...; tone map; steps of a shadow ray */
    ivec4 effects;   /* samples of occlusion; depth of rays; EFFECT_... bits; volumes */
    ivec4 counts;    /* steps through a volume; of light in it; samples of a pixel; clear depth */
    Light lights[LIGHTS_MAX];
    Volume volumes[VOLUMES_MAX];
};

/* xy: first pixel of the tile; z: always 0, so that loops starting there are not unrolled; w: which
 * samples the pass is for, a PASS_... */
uniform ivec4 tile;
#define zero tile.z
#define PASS_TILE 0   /* all of the tile's */
#define PASS_COARSE 1 /* one for each block: march alone */
#define PASS_LIST 2   /* those of a list: group.glsl */

/* Four numbers of the pass; each says at its head what they are. */
uniform ivec4 turn;

/* Where a ray is inside of a box: entry and exit; exit < entry where it misses it. */
vec2 box_span(vec3 low, vec3 high, vec3 origin, vec3 direction)
{
    /* Along a side, and on it, 0 times infinity would be no number. */
    vec3 inverse = 1.0 / mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
    vec3 a = (low - origin) * inverse;
    vec3 b = (high - origin) * inverse;
    vec3 near = min(a, b), far = max(a, b);
    return vec2(max(near.x, max(near.y, near.z)), min(far.x, min(far.y, far.z)));
}

vec2 bounds_span(vec3 origin, vec3 direction)
{
    return box_span(bounds_min.xyz, bounds_max.xyz, origin, direction);
}
