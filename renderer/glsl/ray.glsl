/* SPDX-License-Identifier: MIT */
/* A ray, and how wide the pixel is that it is for. */

#include "frame.glsl"

struct Ray {
    vec3 origin;
    vec3 direction; /* of length 1 */
    float distance; /* from the eye to the origin */
    bool inside;    /* of something that light goes through */
    float start;    /* nothing that light goes through is met before: it comes out of its surface */
};

/* A ray that is to be followed later. */
struct QueuedRay {
    vec4 origin;     /* origin, distance */
    vec4 direction;  /* direction, start; below 0 outside */
    vec4 throughput; /* what its light counts; w: cone_pack() */
    vec4 absorption; /* rgb: where it is */
};

Ray ray_of(vec4 origin, vec4 direction)
{
    return Ray(origin.xyz, direction.xyz, origin.w, direction.w > 0.0, abs(direction.w));
}

vec4 pack_ray_origin(Ray ray)
{
    return vec4(ray.origin, ray.distance);
}

vec4 pack_ray_direction(Ray ray)
{
    return vec4(ray.direction, ray.inside ? max(ray.start, 1e-30) : -ray.start);
}

/* Radius of a pixel's footprint at distance t along the ray. */
float pixel_footprint(Ray ray, float t)
{
    return camera.pixel_radius * (camera.orthographic != 0 ? 1.0 : ray.distance + t);
}

/* A ray stands for a cone: `spread` is how much wider it gets, in diameter, over a unit of way;
 * below 0 it narrows (Akenine-Moeller et al.: Texture level of detail strategies for real-time ray
 * tracing, Ray Tracing Gems, 2019, ch. 20). That of the eye's rays is a pixel's. */
float eye_spread()
{
    return camera.orthographic != 0 ? 0.0 : 2.0 * camera.pixel_radius;
}

/* Diameter of the cone at t, as if it had been the eye's until the ray's origin. */
float cone_width(Ray ray, float t, float spread)
{
    return 2.0 * pixel_footprint(ray, t) + (spread - eye_spread()) * t;
}

/* How often a ray was reflected or refracted, and its spread, in one number. */
float cone_pack(int depth, float spread)
{
    return float(depth) + 0.5 + 0.4 * clamp(spread, -1.0, 1.0);
}

int cone_depth(float word)
{
    return int(word);
}

float cone_spread(float word)
{
    return (fract(word) - 0.5) / 0.4;
}

/* Where a ray looks for other transmissive objects, that came by `ray` to a surface at t and goes
 * through it along a direction whose cosine to the normal is c, less than 0: not far behind, for it
 * may be thin, and within its rounding. */
float start_behind(Ray ray, float t, float c)
{
    return pixel_footprint(ray, t) * min(-0.75 / c, 3.0);
}
