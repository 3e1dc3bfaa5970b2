/* SPDX-License-Identifier: MIT */
/* What the light of a sample's ray adds to the sample, and which rays it goes on with. */

#include "fog.glsl"
#include "shade.glsl"

/* The rays of a sample that wait, and the one that it goes on with: stack.glsl or
 * sample_sink.glsl. */
int stack_count(ivec2 here);
void stack_set_count(ivec2 here, int count);
void stack_put(ivec2 here, int i, QueuedRay ray);
QueuedRay stack_get(ivec2 here, int i);
void set_ray(ivec2 here, QueuedRay ray);

/* A ray from the surface on: reflected a little off it, transmitted along its own line. */
QueuedRay spawn_ray(Ray ray, vec3 p, vec3 n, vec3 direction, bool inside, float t, vec4 throughput,
                    vec3 absorption)
{
    float c = dot(n, direction);
    vec3 origin = c < 0.0 ? p : p + n * (2.0 * pixel_footprint(ray, t));
    Ray next =
        Ray(origin, direction, ray.distance + t, inside, c < 0.0 ? start_behind(ray, t, c) : 0.0);
    return QueuedRay(pack_ray_origin(next), pack_ray_direction(next), throughput,
                     vec4(absorption, 0.0));
}

/* What stands for a ray that is not followed. */
vec3 environment_estimate(QueuedRay ray)
{
    return ray.throughput.rgb * sky_specular(ray.direction.xyz, 0.0, cone_spread(ray.throughput.w));
}

/* The sample's next ray: one of those wanted here, else one that waited. `last`: none is followed.
 * The light that stands for those that are not. */
vec3 select_next_ray(ivec2 here, QueuedRay reflection, bool has_reflection, QueuedRay transmission,
                     bool has_transmission, bool first, bool last)
{
    int count = first ? 0 : stack_count(here);
    bool own = has_reflection || has_transmission, both = has_reflection && has_transmission;
    bool room = count < STACK_DEPTH && !last;
    QueuedRay next = reflection;
    vec3 estimate = vec3(0.0);

    if (has_transmission) {
        next = transmission;
    }
    if (both && room) {
        stack_put(here, count, reflection);
        count++;
    } else if (both) {
        estimate = environment_estimate(reflection);
    }
    if (last) {
        estimate += own ? environment_estimate(next) : vec3(0.0);
        for (int i = count; i > 0; i--) {
            estimate += environment_estimate(stack_get(here, i - 1));
        }
        count = 0;
    } else if (own) {
        set_ray(here, next);
    } else if (count > 0) {
        count--;
        set_ray(here, stack_get(here, count));
    }
    stack_set_count(here, count);
    return estimate;
}

/* `g`, `curvature`: normal and distance, and curvature, as march_pass.glsl left them;
 * `ambient_visibility`: how little is in the way of the environment's light; `smoke`: light added
 * on the way, and the part let through. Where the ray is the first, `total` is nothing. */
void shade_ray(ivec2 here, Ray ray, vec4 g, float curvature, Surface s, float ambient_visibility,
               vec4 smoke, bool first, bool last, vec4 throughput, vec3 absorption,
               inout vec4 total)
{
    float t = abs(g.w);
    bool hit = t < INFINITY, opaque = g.w < 0.0 || s.opaque_cut;
    float distance = hit ? t : frame.max_distance;
    bool leaving = hit && ray.inside && !opaque;
    vec3 n = hit ? g.xyz : vec3(0.0, 1.0, 0.0);
    vec3 p = ray.origin + ray.direction * (hit ? t : 0.0);

    throughput.rgb *= exp(-absorption * (ray.inside ? distance : 0.0));
    int depth = first ? 0 : cone_depth(throughput.w);
    float spread = first ? eye_spread() : cone_spread(throughput.w);
    bool deeper = hit && !last && depth < frame.ray_depth;
    bool empty = first && !hit && (frame.effects & EFFECT_TRANSPARENT) != 0;
    Lobes w = scatter(ray, n, s, leaving, throughput.rgb, deeper);
    spread_lobes(w, ray, n, s, leaving, spread, curvature * cone_width(ray, hit ? t : 0.0, spread));
    vec3 environment = sky(ray.direction, spread);
    vec3 light = hit     ? surface_light(ray, p, n, s, w, leaving, ambient_visibility, here)
                 : empty ? vec3(0.0)
                         : environment;
    /* What is far fades into the sky, so that endless ground has no edge. */
    float far = hit ? smoothstep(0.15, 1.0, (ray.distance + t) / frame.max_distance) : 0.0;
    vec4 air = ray.inside ? vec4(0.0, 0.0, 0.0, 1.0) : fog(ray, hit ? t : INFINITY);
    light = (mix(light, environment, far) * air.a + air.rgb) * smoke.a + smoke.rgb;

    total.rgb += throughput.rgb * light;
    total.w = first ? (hit ? 1.0 : 1.0 - air.a * smoke.a) : total.w;
#ifndef PLAIN
    if (frame.ray_depth > 0) {
        vec3 kept = throughput.rgb * ((1.0 - far) * air.a * smoke.a);
        float sharp = leaving ? 1.0 : reflection_sharpness(s);
        float rough = leaving || s.model != MODEL_STANDARD ? 0.0 : s.gloss;
        float reflected_cone = cone_pack(depth + 1, rough_spread(w.reflected_spread, rough));
        float transmitted_cone = cone_pack(depth + 1, w.transmitted_spread);
        QueuedRay reflection =
            spawn_ray(ray, p, n, w.reflected, ray.inside, t,
                      vec4(kept * w.reflection * sharp, reflected_cone), absorption);
        QueuedRay transmission = spawn_ray(ray, p, n, w.transmitted, !leaving, t,
                                           vec4(kept * w.transmission, transmitted_cone),
                                           leaving ? vec3(0.0) : s.absorption);
        total.rgb += select_next_ray(here, reflection, hit && w.reflection_ray, transmission,
                                     hit && w.transmission_ray, first, last);
    }
#endif
}
