/* SPDX-License-Identifier: MIT */
/* Light on its way through clear things: straight on, dimmed and coloured by each surface and by
 * what is between them. Solid things on the way are shadow.glsl's. */

#include "lights.glsl"
#include "optics.glsl"
#include "ray.glsl"
#include "surface.glsl"

/* A ray on its way to a light. */
struct Beam {
    Ray ray;
    vec3 weight; /* part of the light that is left */
    float left;  /* way to the light */
    vec3 medium; /* absorption of what it is in */
};

/* Towards the light, where something clear may be between; `arrives`: the part that comes past
 * solid things. `g`: normal and distance, as march_pass.glsl leaves them. A place within something
 * clear is left as the ray that came to it was. */
bool beam_begin(Light light, Ray ray, vec4 g, bool painted, vec3 arrives, out Beam beam)
{
    float t = abs(g.w);
    vec3 p = ray.origin + ray.direction * (t < INFINITY ? t : 0.0);
    Incoming in_light = incoming(light, p);
    vec2 span = box_span(frame.clear_min, frame.clear_max, p, in_light.direction);
    bool leaving = ray.inside && g.w > 0.0 && !painted;
    bool crossed = span.y > max(span.x, 0.0) && span.x < in_light.reach;
    float off = 2.0 * footprint(ray, t);
    Ray to = Ray(p + g.xyz * off, in_light.direction, ray.way + t, ray.inside, 0.0);
    beam = Beam(to, vec3(1.0), in_light.reach, vec3(0.0));
    return t < INFINITY && crossed && !leaving && dot(g.xyz, in_light.direction) > 0.0 &&
           any(greaterThan(arrives, vec3(0.0))) && light.shadow != SHADOW_NONE;
}

/* Through what the beam met, at `g`, or to its end: then false. */
bool beam_pass(inout Beam beam, vec4 g, Surface s)
{
    Ray ray = beam.ray;
    float t = abs(g.w), left = beam.left;
    bool leaving = ray.inside && g.w > 0.0;
    bool reached = t < left && t < INFINITY;
    bool goes = reached && !s.painted && (leaving || s.transmission > 0.0);
    float c = max(-dot(ray.direction, g.xyz), 0.0);

    beam.weight *= exp(-beam.medium * (ray.inside ? min(min(t, left), frame.max_distance) : 0.0));
    if (reached && s.painted) { /* shadow.glsl sees no side of what is clear */
        beam.weight = vec3(0.0);
    }
    if (goes) {
        float mirror = interface_mirror(s.ior, c, false); /* it is not bent: c is the one outside */
        beam.weight *= leaving ? vec3(1.0 - mirror) : (1.0 - mirror) * s.transmission * dye(s);
        vec3 p = ray.origin + ray.direction * t;
        beam.ray = Ray(p, ray.direction, ray.way, !leaving, start_behind(ray, t, -max(c, 0.02)));
        beam.left = left - t;
        beam.medium = leaving ? vec3(0.0) : s.absorption;
    }
    return goes;
}
