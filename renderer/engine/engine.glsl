/* SPDX-License-Identifier: MIT */
/* What the engine runs for a vector of samples: functions of the shaders, from camera to pixel. */

#include "camera.glsl"
#include "field_surface.glsl"
#include "forward_store.glsl"
#include "kernels.glsl"
#include "march.glsl"
#include "mixture.glsl"
#include "paths.glsl"
#include "pixel.glsl"
#include "shadow.glsl"

/* Where the materials lie among the numbers. */
layout(binding = BINDING_NUMBERS) uniform Scene {
    int material_base;
    int material_stride;
} scene;

/* What the mixture is made of. */
void paint(Mixture m, out Surface s)
{
    s = surface_begin(m);
    while (m.shares.x > 0.0) {
        int i = scene.material_base + scene.material_stride * int(m.slots.x);
        surface_add(s, m, Paint(N_ANY(i), N_ANY(i + 1), N_ANY(i + 2), N_ANY(i + 3), N_ANY(i + 4),
                                N_ANY(i + 5)));
        mixture_next(m);
    }
}

/* Sample `index` of a pixel, with all rays that follow: its light and coverage; normal and distance
 * of what its first ray met. */
void trace(ivec2 pixel, int index, int rays, out vec4 total, out vec4 geometry_of)
{
    Ray ray = camera_sample(pixel, index);
    vec4 weight = vec4(1.0, 1.0, 1.0, 0.0);
    vec3 medium = vec3(0.0);

    total = vec4(0.0);
    has_next = true;
    for (int i = 0; i <= rays && has_next; i++) {
        Hit found = march(ray, 0.0, 0.0, frame.max_steps);
        float t = found.hit ? found.t : 0.0;
        vec3 p = ray.origin + ray.direction * t;
        vec4 g = vec4(found.hit ? found.normal : vec3(0.0),
                      found.solid ? -max(found.t, 1e-30) : found.t);
        Surface s;
        if (i == 0) {
            geometry_of = g;
        }
        through = found.solid ? FAR : ray.inside ? -FAR : 0.0;
        surface(p, Shading(p, vec3(0.0), found.normal, ray.direction, t), s);
        look(p, found.normal, footprint(ray, t), found.hit);
        has_next = false;
        add_light(pixel, ray, g, found.curvature, s, seen_open, vec4(0.0, 0.0, 0.0, 1.0), i == 0,
                  i == rays, weight, medium, total);
        ray = ray_of(next_ray.from, next_ray.along);
        weight = next_ray.weight;
        medium = next_ray.medium.rgb;
    }
}

vec3 shown(vec3 light)
{
    return tone_map(light * frame.exposure);
}

bool is_edge(ivec2 here)
{
    return edge_at(here) >= 1.0 || contrast_at(here) > 0.06;
}

Mixture mixed(float d, float share, Mixture a, Mixture b)
{
    return blend(d, share, a, b);
}

/* Both sides of an operation that never mixes. */
Mixture chosen(float d, float share, Mixture a, Mixture b)
{
    Mixture m = a;
    if (share > 0.5) {
        m = b;
    }
    m.d = d;
    return m;
}

Mixture alone(float d, float leaf, float slot)
{
    return mixture(vec3(d, leaf, slot));
}
