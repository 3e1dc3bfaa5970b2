/* SPDX-License-Identifier: MIT */
/* What the light of a sample's ray adds to the sample, and which rays it goes on with. */

#include "fog.glsl"
#include "shade.glsl"

/* The rays of a sample that wait, and the one that it goes on with: stack.glsl or
 * sample_store.glsl. */
int stack_count(ivec2 here);
void stack_set_count(ivec2 here, int count);
void stack_put(ivec2 here, int i, Waiting ray);
Waiting stack_get(ivec2 here, int i);
void ray_go(ivec2 here, Waiting ray);

/* A ray from the surface on: mirrored a little off it, on the way through along its own line. */
Waiting ray_on(Ray ray, vec3 p, vec3 n, vec3 direction, bool inside, float t, vec4 weight,
               vec3 medium)
{
    float c = dot(n, direction);
    vec3 origin = c < 0.0 ? p : p + n * (2.0 * footprint(ray, t));
    Ray next = Ray(origin, direction, ray.way + t, inside, c < 0.0 ? start_behind(ray, t, c) : 0.0);
    return Waiting(ray_from(next), ray_along(next), weight, vec4(medium, 0.0));
}

/* What stands for a ray that is not followed. */
vec3 guess(Waiting ray)
{
    return ray.weight.rgb * sky_mirrored(ray.along.xyz, 0.0, cone_spread(ray.weight.w));
}

/* The sample's next ray: one of those wanted here, else one that waited. `last`: none is followed.
 * The light that stands for those that are not. */
vec3 go_on(ivec2 here, Waiting mirror, bool has_mirror, Waiting passing, bool has_passing,
           bool first, bool last)
{
    int count = first ? 0 : stack_count(here);
    bool own = has_mirror || has_passing, both = has_mirror && has_passing;
    bool room = count < STACK_DEPTH && !last;
    Waiting next = mirror;
    vec3 guessed = vec3(0.0);

    if (has_passing) {
        next = passing;
    }
    if (both && room) {
        stack_put(here, count, mirror);
        count++;
    } else if (both) {
        guessed = guess(mirror);
    }
    if (last) {
        guessed += own ? guess(next) : vec3(0.0);
        for (; count > 0; count--) {
            guessed += guess(stack_get(here, count - 1));
        }
    } else if (own) {
        ray_go(here, next);
    } else if (count > 0) {
        count--;
        ray_go(here, stack_get(here, count));
    }
    stack_set_count(here, count);
    return guessed;
}

/* `g`, `curve`: normal and distance, and curvature, as march_pass.glsl left them; `open`: how
 * little is in the way of the environment's light; `smoke`: light added on the way, and the part
 * let through. Where the ray is the first, `total` is nothing. */
void add_light(ivec2 here, Ray ray, vec4 g, float curve, Surface s, float open, vec4 smoke,
               bool first, bool last, vec4 weight, vec3 medium, inout vec4 total)
{
    float t = abs(g.w);
    bool hit = t < INFINITY, solid = g.w < 0.0 || s.painted;
    float way = hit ? t : frame.max_distance;
    bool leaving = hit && ray.inside && !solid;
    vec3 n = hit ? g.xyz : vec3(0.0, 1.0, 0.0);
    vec3 p = ray.origin + ray.direction * (hit ? t : 0.0);

    weight.rgb *= exp(-medium * (ray.inside ? way : 0.0));
    int depth = first ? 0 : cone_depth(weight.w);
    float spread = first ? eye_spread() : cone_spread(weight.w);
    bool deeper = hit && !last && depth < frame.ray_depth;
    bool empty = first && !hit && (frame.effects & EFFECT_TRANSPARENT) != 0;
    Ways w = ways_at(ray, n, s, leaving, weight.rgb, deeper);
    spread_ways(w, ray, n, s, leaving, spread, curve * cone_width(ray, hit ? t : 0.0, spread));
    vec3 around = sky(ray.direction, spread);
    vec3 light = hit ? surface_light(ray, p, n, s, w, leaving, open, here)
                     : empty ? vec3(0.0) : around;
    /* What is far fades into the sky, so that endless ground has no edge. */
    float far = hit ? smoothstep(0.15, 1.0, (ray.way + t) / frame.max_distance) : 0.0;
    vec4 air = ray.inside ? vec4(0.0, 0.0, 0.0, 1.0) : fog(ray, hit ? t : INFINITY);
    light = (mix(light, around, far) * air.a + air.rgb) * smoke.a + smoke.rgb;

    total.rgb += weight.rgb * light;
    total.w = first ? (hit ? 1.0 : 1.0 - air.a * smoke.a) : total.w;
#ifndef PLAIN
    if (frame.ray_depth > 0) {
        vec3 kept = weight.rgb * ((1.0 - far) * air.a * smoke.a);
        float sharp = leaving ? 1.0 : mirror_sharpness(s);
        float rough = leaving || s.model != MODEL_STANDARD ? 0.0 : s.gloss;
        float mirrored = cone_pack(depth + 1, rough_spread(w.mirrored_spread, rough));
        float passed = cone_pack(depth + 1, w.passed_spread);
        Waiting mirror = ray_on(ray, p, n, w.mirrored, ray.inside, t,
                                vec4(kept * w.mirror * sharp, mirrored), medium);
        Waiting passing = ray_on(ray, p, n, w.passed, !leaving, t, vec4(kept * w.passing, passed),
                                 leaving ? vec3(0.0) : s.absorption);
        total.rgb += go_on(here, mirror, hit && w.mirror_ray, passing, hit && w.passing_ray, first,
                           last);
    }
#endif
}
