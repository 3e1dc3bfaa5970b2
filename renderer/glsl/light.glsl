/* SPDX-License-Identifier: MIT */
/* Third pass: light on what march.glsl and matter.glsl found. Blinn-Phong, shadows, ambient
 * occlusion, sky. */

layout(binding = 0) uniform sampler2D geometry;
layout(binding = 1) uniform usampler2D matter;
layout(binding = 2) uniform usampler2D more;

#define PI 3.14159265
#define OCCLUSION_SAMPLES 5
#define OCCLUSION_STRENGTH 0.9

layout(rgba32f, binding = 3) writeonly uniform image2D out_radiance;

struct Incoming {
    vec3 direction; /* towards the light */
    vec3 color;
    float reach; /* distance to the light */
};

Incoming incoming(Light light, vec3 p)
{
    if (int(light.place.w) == LIGHT_DIRECTIONAL) {
        return Incoming(light.place.xyz, light.color.rgb, 1e9);
    }
    vec3 away = light.place.xyz - p;
    float r2 = max(dot(away, away), 1e-12), r = sqrt(r2);
    float fall = 1.0 / max(r2, light.extent.x * light.extent.x);
    if (light.extent.y > 0.0) {
        float x = r2 / (light.extent.y * light.extent.y);
        float window = clamp(1.0 - x * x, 0.0, 1.0);
        fall *= window * window;
    }
    return Incoming(away / r, light.color.rgb * fall, r);
}

/* Distance of occlusion sample i, 0 and up: dense near the surface. */
float occlusion_place(int i, float start)
{
    float x = float(i + 1) / float(OCCLUSION_SAMPLES);
    return start + ground.w * x * x;
}

/* Occlusion of a bright surface is lightened by what its surroundings throw back at it (Jimenez,
 * Wu, Pesce, Jarabo: Practical real-time strategies for accurate indirect occlusion, 2016). */
vec3 opened(float open, vec3 albedo)
{
    vec3 a = 2.0404 * albedo - 0.3324, b = 0.6417 - 4.7951 * albedo, c = 2.7552 * albedo + 0.6903;
    return max(vec3(open), ((open * a + b) * open + c) * open);
}

/* Blinn-Phong for one light. */
vec3 reflected(Surface s, vec3 n, vec3 view, vec3 towards)
{
    vec3 halfway = normalize(towards + view);
    return (s.diffuse + 2.0 * s.specular * pow(max(dot(n, halfway), 0.0), s.shininess)) / PI;
}

/* In a loop of one round for occlusion and one for each light, so that map() stands in the program
 * once.
 *
 * Occlusion: how much less than the distance from the surface the field is along the normal (Evans:
 * Fast approximations for global illumination on dynamic scenes, SIGGRAPH 2006).
 *
 * Shadow: the penumbra of a light of angular size 1/k follows from the least ratio of distance to
 * length along the ray, taken between steps, where the spheres of two steps meet (Aaltonen:
 * GPU-based clay simulation and ray-tracing tech in Claybook, GDC 2018; here for strides of any
 * length). */
vec3 lit(Ray ray, float t, vec3 n, Surface s, bool hit)
{
    float print = footprint(t);
    vec3 p = ray.origin + ray.direction * t;
    vec3 from = p + n * (1.5 * print);
    vec3 ambient = s.ambient * s.diffuse * sky_ambient(n);
    vec3 sum = s.emission;

    for (int round = zero - 1; round < modes.x; round++) {
        bool open = round < 0;
        Light light = lights[max(round, 0)];
        Incoming ray_in = incoming(light, p);
        int kind = int(light.extent.z);
        float lambert = dot(n, ray_in.direction);
        vec3 along = open ? n : ray_in.direction;
        vec3 base = open ? p : from;
        float far = min(ray_in.reach - light.extent.x, bounds_span(from, along).y);
        float near = 2.0 * print, k = light.color.w;
        int steps = kind == SHADOW_NONE || lambert <= 0.0 ? 0 : modes.w;
        float x = open ? occlusion_place(0, near) : near;
        float shade = 1.0, before = FAR, stride = 1e-6, dark = 0.0, weight = 1.0, weights = 0.0;

        steps = hit ? (open ? OCCLUSION_SAMPLES : steps) : 0;
        for (int i = zero; i < steps; i++) {
            float d = map(base + along * x);
            dark += weight * clamp(1.0 - d / x, 0.0, 1.0);
            weights += weight;
            weight *= 0.75;

            /* Least ratio since the last place: at most that of its ends, at least that of a corner
             * which both spheres touch, y from the last place. The mean shows no bands. */
            float y = (before * before - d * d + stride * stride) / (2.0 * stride);
            float nearest = y <= 0.0 ? before : y < stride ? sqrt(before * before - y * y) : d;
            float last = max(x - stride, 0.5 * near);
            float ratio = min(before / last, d / x) + nearest / (last + clamp(y, 0.0, stride));
            shade = min(shade, 0.5 * k * ratio);
            before = d;
            if (!open && (d < 0.05 * print || shade < 0.004 || x > far)) {
                shade = x > far ? shade : 0.0;
                break;
            }
            stride = max(k * d < x ? 0.7 * d : d, 0.5 * print);
            x = open ? occlusion_place(i + 1, near) : x + stride;
        }
        shade = clamp(shade, 0.0, 1.0);
        shade = kind == SHADOW_HARD ? step(0.02, shade) : shade * shade * (3.0 - 2.0 * shade);
        vec3 direct = ray_in.color * reflected(s, n, -ray.direction, ray_in.direction);
        float sky = 1.0 - OCCLUSION_STRENGTH * dark / max(weights, 1.0);
        sum += open ? ambient * opened(sky, s.diffuse)
                    : direct * (max(lambert, 0.0) * (kind == SHADOW_NONE ? 1.0 : shade));
    }
    return sum;
}

void main()
{
    preload();
    ivec2 here = group_place();
    vec4 g = texelFetch(geometry, here, 0);
    Surface s = surface_unpack(texelFetch(matter, here, 0), texelFetch(more, here, 0));
    Ray ray = camera_ray(tile.xy * size.z + here);
    bool hit = g.w < INFINITY;
    float t = hit ? g.w : 0.0;
    vec3 around = sky(ray.direction);
    vec3 color = lit(ray, t, hit ? g.xyz : vec3(0.0, 1.0, 0.0), s, hit);

    /* What is far fades into the sky, so that endless ground has no edge. */
    color = mix(color, around, smoothstep(0.15, 1.0, t / bounds_max.w));
    imageStore(out_radiance, here, vec4(hit ? color : around, 1.0));
}
