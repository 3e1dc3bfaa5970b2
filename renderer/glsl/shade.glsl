/* SPDX-License-Identifier: MIT */
/* Light at the end of a ray, out of what the passes before found; knows nothing of the field.
 * PLAIN: nothing mirrors, and light goes through nothing. */

#include "brdf.glsl"
#include "lights.glsl"
#include "ray.glsl"
#include "sky.glsl"

/* Part of a light's colour that arrives: visibility_load.glsl or sample_store.glsl. */
vec3 visibility_of(ivec2 here, int light);

/* How much of a mirror image rays bring: rough surfaces blur it, so the environment's will do. */
float mirror_sharpness(Surface s)
{
    return s.model == MODEL_STANDARD ? 1.0 - smoothstep(0.15, 0.5, s.gloss)
                                     : step(1e-4, s.reflectivity);
}

/* The ways by which light may have come to a surface and on along the ray: mirrored, and passing
 * through. */
struct Ways {
    vec3 mirrored, passed;        /* directions */
    vec3 mirror, passing;         /* what light from there counts */
    bool mirror_ray, passing_ray; /* whether rays bring it, else the environment stands in */
    float mirrored_spread, passed_spread; /* of the cones along them */
};

/* The cone that leaves a curved surface: its normals differ by `turn` over the cone's width. The
 * mean of the change across the plane of incidence and along it; of a way through, across it. */
void spread_ways(inout Ways w, Ray ray, vec3 n, Surface s, bool leaving, float spread, float turn)
{
    float ratio = leaving ? s.ior : 1.0 / s.ior, c = dot(n, ray.direction);
    w.mirrored_spread = spread + 2.0 * turn;
    w.passed_spread = ratio * spread + (dot(n, w.passed) - ratio * c) * turn;
}

/* `leaving`: the surface is the way out for a ray inside. `weight` is the ray's. */
Ways ways_at(Ray ray, vec3 n, Surface s, bool leaving, vec3 weight, bool deeper)
{
    vec3 view = -ray.direction;
    Ways w;
    w.mirrored = reflect(ray.direction, n);
    bool goes = bend(ray.direction, n, leaving ? s.ior : 1.0 / s.ior, w.passed);
    float inner = goes ? interface_mirror(s.ior, max(dot(n, view), 0.0), true) : 1.0;
    vec3 outer = mirror_part(s, n, view);
    float left = 1.0 - max(outer.x, max(outer.y, outer.z));
    w.mirror = leaving ? vec3(inner) : outer;
    w.passing = leaving ? vec3(1.0 - inner) : left * s.transmission * dye(s);

    vec3 least = vec3(deeper ? frame.min_throughput : INFINITY);
    float sharp = leaving ? 1.0 : mirror_sharpness(s);
    w.mirror_ray = (frame.effects & EFFECT_REFLECTIONS) != 0 &&
                   any(greaterThan(weight * w.mirror * sharp, least));
    w.passing_ray = (frame.effects & EFFECT_REFRACTIONS) != 0 &&
                    any(greaterThan(weight * w.passing, least));
    return w;
}

/* Light that a surface throws along the ray, but for what rays will bring. */
vec3 surface_light(Ray ray, vec3 p, vec3 n, Surface s, Ways w, bool leaving, float open, ivec2 here)
{
    vec3 view = -ray.direction;
#ifdef PLAIN
    vec3 passed = vec3(0.0), around = vec3(0.0);
    float traced = 0.0;
#else
    vec3 passed = w.passing * sky_mirrored(ray.direction, 0.0, w.passed_spread);
    passed = w.passing_ray ? vec3(0.0) : passed;
    float traced = w.mirror_ray ? (leaving ? 1.0 : mirror_sharpness(s)) : 0.0;
    vec3 around = sky_mirrored(w.mirrored, leaving ? 0.0 : roughness(s), w.mirrored_spread);
#endif
    vec3 sum = s.emission + surroundings(s, n, view, open, sky_irradiance(n), around, traced);

    for (int i = zero; i < frame.light_count; i++) {
        Incoming light = incoming(frame.lights[i], p);
        sum += light.color * reflected(s, n, view, light.direction) * visibility_of(here, i);
    }
    return passed + (leaving ? w.mirror * around * (1.0 - traced) : sum);
}
