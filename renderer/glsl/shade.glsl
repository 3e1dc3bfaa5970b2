/* SPDX-License-Identifier: MIT */
/* Light at the end of a ray, out of what the passes before found; knows nothing of the field.
 * PLAIN: nothing reflects, and light goes through nothing. */

#include "brdf.glsl"
#include "lights.glsl"
#include "ray.glsl"
#include "sky.glsl"

/* Part of a light's colour that arrives: visibility_load.glsl or sample_sink.glsl. */
vec3 visibility_of(ivec2 here, int light);

/* How much of a reflection rays bring: rough surfaces blur it, so the environment's will do. */
float reflection_sharpness(Surface s)
{
    return s.model == MODEL_STANDARD ? 1.0 - smoothstep(0.15, 0.5, s.gloss)
                                     : step(1e-4, s.reflectivity);
}

/* The ways by which light may have come to a surface and on along the ray: mirrored, and passing
 * through. */
struct Lobes {
    vec3 reflected, transmitted;                /* directions */
    vec3 reflection, transmission;              /* what light from there counts */
    bool reflection_ray, transmission_ray;      /* brought by rays, not by the environment */
    float reflected_spread, transmitted_spread; /* of the cones along them */
};

/* The cone that leaves a curved surface: its normals differ by `turn` over the cone's width. The
 * mean of the change across the plane of incidence and along it; of a way through, across it. */
void spread_lobes(inout Lobes w, Ray ray, vec3 n, Surface s, bool leaving, float spread, float turn)
{
    float ratio = leaving ? s.ior : 1.0 / s.ior, c = dot(n, ray.direction);
    w.reflected_spread = spread + 2.0 * turn;
    w.transmitted_spread = ratio * spread + (dot(n, w.transmitted) - ratio * c) * turn;
}

/* `leaving`: the surface is the way out for a ray inside. `throughput` is the ray's. */
Lobes scatter(Ray ray, vec3 n, Surface s, bool leaving, vec3 throughput, bool deeper)
{
    vec3 view = -ray.direction;
    Lobes w;
    w.reflected = reflect(ray.direction, n);
    bool goes = refract_ray(ray.direction, n, leaving ? s.ior : 1.0 / s.ior, w.transmitted);
    float inner = goes ? fresnel_dielectric(s.ior, max(dot(n, view), 0.0), true) : 1.0;
    vec3 outer = specular_reflectance(s, n, view);
    float left = 1.0 - max(outer.x, max(outer.y, outer.z));
    w.reflection = leaving ? vec3(inner) : outer;
    w.transmission = leaving ? vec3(1.0 - inner) : left * s.transmission * transmission_tint(s);

    vec3 min_throughput = vec3(deeper ? frame.min_throughput : INFINITY);
    float sharp = leaving ? 1.0 : reflection_sharpness(s);
    w.reflection_ray = (frame.effects & EFFECT_REFLECTIONS) != 0 &&
                       any(greaterThan(throughput * w.reflection * sharp, min_throughput));
    w.transmission_ray = (frame.effects & EFFECT_REFRACTIONS) != 0 &&
                         any(greaterThan(throughput * w.transmission, min_throughput));
    return w;
}

/* Light that a surface sends along the ray, but for what rays will bring. */
vec3 surface_light(Ray ray, vec3 p, vec3 n, Surface s, Lobes w, bool leaving,
                   float ambient_visibility, ivec2 here)
{
    vec3 view = -ray.direction;
#ifdef PLAIN
    vec3 transmitted = vec3(0.0), environment = vec3(0.0);
    float traced = 0.0;
#else
    vec3 transmitted = w.transmission * sky_specular(ray.direction, 0.0, w.transmitted_spread);
    transmitted = w.transmission_ray ? vec3(0.0) : transmitted;
    float traced = w.reflection_ray ? (leaving ? 1.0 : reflection_sharpness(s)) : 0.0;
    vec3 environment = sky_specular(w.reflected, leaving ? 0.0 : roughness(s), w.reflected_spread);
#endif
    vec3 sum = s.emission + environment_light(s, n, view, ambient_visibility, sky_irradiance(n),
                                              environment, traced);

    for (int i = zero; i < frame.light_count; i++) {
        Incoming light = incoming(frame.lights[i], p);
        sum +=
            light.color * brdf_times_cosine(s, n, view, light.direction) * visibility_of(here, i);
    }
    return transmitted + (leaving ? w.reflection * environment * (1.0 - traced) : sum);
}
