/* SPDX-License-Identifier: MIT */
/* A whole sample of a pixel, from the camera to its light, where one program does all: a fragment
 * shader, or the engine. VOLUMES: there may be some. OPAQUE: light goes through nothing. */

#include "camera.glsl"
#include "march.glsl"
#include "outputs.glsl"
#include "sample_sink.glsl"
#include "secondary_rays.glsl"
#include "shadow.glsl"
#include "surface_of.glsl"
#include "transmission.glsl"
#include "visibility_mean.glsl"
#ifdef VOLUMES
#include "volume.glsl"
#endif

/* Where a ray ends: normal and distance as march_pass.glsl leaves them, and what is there. */
void find(Ray ray, float start, out Hit found, out vec4 g, out Surface s)
{
    found = march(ray, start, 0.0, frame.max_steps);
    float t = found.hit ? found.t : 0.0;
    vec3 p = ray.origin + ray.direction * t;
    g = vec4(found.hit ? found.normal : vec3(0.0), found.opaque ? -max(found.t, 1e-30) : found.t);
    field_mask = found.opaque ? FAR : ray.inside ? -FAR : 0.0;
    s = surface_nothing();
    if (found.hit) {
        surface_of(found.source, p, Shading(p, vec3(0.0), found.normal, ray.direction, t), s);
    }
}

#ifndef OPAQUE
/* What comes to a light's ray through transmissive objects, `depth` surfaces at most. */
void transmit_light(int light, Ray ray, vec4 g, bool opaque_cut, int depth)
{
    Beam beam;
    bool goes = beam_begin(frame.lights[light], ray, g, opaque_cut, stored_visibility[light], beam);
    for (int i = 0; i < depth && goes; i++) {
        Hit found;
        vec4 there;
        Surface s;
        find(beam.ray, 0.0, found, there, s);
        goes = beam_pass(beam, there, s);
    }
    stored_visibility[light] *= beam.transmittance;
}
#endif

/* Sample `index` of a pixel, with all rays that follow, `rays` at most: its light and coverage, and
 * what its first ray met, which is free up to `start`, and where the last one ended. `depth`: of
 * surfaces between what is met and a light. `shadows`, `lights`: whether shadows are wanted, and
 * light. How many rays followed. */
int trace(ivec2 pixel, float start, int index, int rays, int depth, bool shadows, bool lights,
          out vec4 total, out vec4 geometry_of, out Met met)
{
    Ray ray = camera_sample(pixel, index);
    vec4 throughput = vec4(1.0, 1.0, 1.0, 0.0);
    vec3 absorption = vec3(0.0);
    float part = fract(pixel_noise(pixel) + 0.61803399 * float(index));

    int count = 0;
    total = vec4(0.0);
    has_next = true;
    for (int i = 0; i <= rays && has_next; i++) {
        Hit found;
        vec4 g, smoke = vec4(0.0, 0.0, 0.0, 1.0);
        Surface s;
        find(ray, i == 0 && camera.lens_radius == 0.0 ? start : 0.0, found, g, s);
        vec3 p = ray.origin + ray.direction * (found.hit ? found.t : 0.0);
        if (shadows) {
            trace_visibility(p, found.normal, pixel_footprint(ray, found.hit ? found.t : 0.0),
                             found.hit);
#ifndef OPAQUE
            for (int light = 0; light < frame.light_count && depth > 0; light++) {
                transmit_light(light, ray, g, s.opaque_cut, depth);
            }
#endif
        }
        geometry_of = g; /* of the last ray, so that edges in mirrors are edges */
        if (i == 0) {
            met = Met(found.hit, g.xyz, g.w, p, float(found.steps), s,
                      shadows ? visibility_mean(pixel) : vec3(1.0),
                      shadows ? stored_ambient_visibility : 1.0);
        }
        has_next = false;
        if (lights) {
#ifdef VOLUMES
            if (frame.volume_count > 0) {
                smoke = inscattering(ray, found.t, part);
            }
#endif
            shade_ray(pixel, ray, g, found.curvature, s, stored_ambient_visibility, smoke, i == 0,
                      i == rays, throughput, absorption, total);
        }
        ray = ray_of(next_ray.origin, next_ray.direction);
        throughput = next_ray.throughput;
        absorption = next_ray.absorption.rgb;
        count += has_next ? 1 : 0;
    }
    return count;
}
