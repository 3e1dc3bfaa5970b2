/* SPDX-License-Identifier: MIT */
/* Light on its way through transmissive objects: straight on, dimmed and coloured by each surface
 * and by what is between them. Opaque objects on the way are shadow.glsl's. */

#include "lights.glsl"
#include "optics.glsl"
#include "ray.glsl"
#include "surface.glsl"

/* A ray on its way to a light. */
struct Beam {
    Ray ray;
    vec3 transmittance; /* part of the light that is left */
    float distance;     /* to the light */
    vec3 absorption;    /* of what it is in */
};

/* Towards the light, where something transmissive may be between; `arrives`: the part that comes
 * past opaque objects. `g`: normal and distance, as march_pass.glsl leaves them. A place within
 * something transmissive is left as the ray that came to it was. */
bool beam_begin(Light light, Ray ray, vec4 g, bool opaque_cut, vec3 arrives, out Beam beam)
{
    float t = abs(g.w);
    vec3 p = ray.origin + ray.direction * (t < INFINITY ? t : 0.0);
    Incoming in_light = incoming(light, p);
    vec2 span = box_span(frame.transmissive_min, frame.transmissive_max, p, in_light.direction);
    bool leaving = ray.inside && g.w > 0.0 && !opaque_cut;
    bool crossed = span.y > max(span.x, 0.0) && span.x < in_light.reach;
    float off = 2.0 * pixel_footprint(ray, t);
    Ray to = Ray(p + g.xyz * off, in_light.direction, ray.distance + t, ray.inside, 0.0);
    beam = Beam(to, vec3(1.0), in_light.reach, vec3(0.0));
    return t < INFINITY && crossed && !leaving && dot(g.xyz, in_light.direction) > 0.0 &&
           any(greaterThan(arrives, vec3(0.0))) && light.shadow != SHADOW_NONE;
}

/* Through what the beam met, at `g`, or to its end: then false. */
bool beam_pass(inout Beam beam, vec4 g, Surface s)
{
    Ray ray = beam.ray;
    float t = abs(g.w), distance = beam.distance;
    bool leaving = ray.inside && g.w > 0.0;
    bool reached = t < distance && t < INFINITY;
    bool goes = reached && !s.opaque_cut && (leaving || s.transmission > 0.0);
    float c = max(-dot(ray.direction, g.xyz), 0.0);

    beam.transmittance *=
        exp(-beam.absorption * (ray.inside ? min(min(t, distance), frame.max_distance) : 0.0));
    if (reached && s.opaque_cut) { /* shadow.glsl sees no side of what is transmissive */
        beam.transmittance = vec3(0.0);
    }
    if (goes) {
        float reflected =
            fresnel_dielectric(s.ior, c, false); /* it is not refracted: c is the one outside */
        beam.transmittance *= leaving ? vec3(1.0 - reflected)
                                      : (1.0 - reflected) * s.transmission * transmission_tint(s);
        vec3 p = ray.origin + ray.direction * t;
        beam.ray =
            Ray(p, ray.direction, ray.distance, !leaving, start_behind(ray, t, -max(c, 0.02)));
        beam.distance = distance - t;
        beam.absorption = leaving ? vec3(0.0) : s.absorption;
    }
    return goes;
}
