/* SPDX-License-Identifier: MIT */
/* Light on its way through clear things: straight on, dimmed and coloured by each surface and by
 * what is between them. Solid things on the way are shadow.glsl's. Its rays have textures of their
 * own: what is read is of the sample's own ray in CLEAR_AIM, then of the one to the light. */

#include "gbuffer_load.glsl"
#include "group.glsl"
#include "lights.glsl"
#include "list.glsl"
#include "optics.glsl"
#include "ray_load.glsl"

layout(location = ARGS_LOCATION) uniform ClearArgs args;
layout(rgba32f, binding = IMAGE_RAY_FROM) uniform image2D out_ray_from;
layout(rgba32f, binding = IMAGE_RAY_ALONG) uniform image2D out_ray_along;
layout(rgba32f, binding = IMAGE_WEIGHT) uniform image2D weights; /* w: length left */
layout(rgba16f, binding = IMAGE_MEDIUM) uniform image2D media;
layout(rgba16f, binding = IMAGE_SEEN) uniform image2DArray seen;

void send(ivec2 here, Ray ray, vec4 weight, vec3 medium)
{
    imageStore(out_ray_from, here, ray_from(ray));
    imageStore(out_ray_along, here, ray_along(ray));
    imageStore(weights, here, weight);
    imageStore(media, here, vec4(medium, 0.0));
    list_add(here);
}

/* Towards the light, where something clear may be between. A place within something clear is
 * left as the ray that came to it was. */
void aim(ivec2 here, Ray ray, vec4 g)
{
    float t = abs(g.w);
    Light light = frame.lights[args.light];
    vec3 p = ray.origin + ray.direction * (t < INFINITY ? t : 0.0);
    Incoming in_light = incoming(light, p);
    vec2 span = box_span(frame.clear_min, frame.clear_max, p, in_light.direction);
    vec3 arrives = imageLoad(seen, ivec3(here, args.light)).rgb;
    bool painted = surface_load(here).painted;
    bool leaving = ray.inside && g.w > 0.0 && !painted;
    bool crossed = span.y > max(span.x, 0.0) && span.x < in_light.reach;
    if (t < INFINITY && crossed && !leaving && dot(g.xyz, in_light.direction) > 0.0 &&
        any(greaterThan(arrives, vec3(0.0))) && light.shadow != SHADOW_NONE) {
        float off = 2.0 * footprint(ray, t);
        Ray next = Ray(p + g.xyz * off, in_light.direction, ray.way + t, ray.inside, 0.0);
        send(here, next, vec4(1.0, 1.0, 1.0, in_light.reach), vec3(0.0));
    }
}

/* Through what the ray met, or to its end. */
void pass_on(ivec2 here, Ray ray, vec4 g)
{
    Surface s = surface_load(here);
    vec4 weight = imageLoad(weights, here);
    vec3 medium = imageLoad(media, here).rgb;
    float t = abs(g.w), left = weight.w;
    bool leaving = ray.inside && g.w > 0.0;
    bool reached = t < left && t < INFINITY;
    bool through_it = reached && !s.painted && (leaving || s.transmission > 0.0);
    float c = max(-dot(ray.direction, g.xyz), 0.0);

    weight.rgb *= exp(-medium * (ray.inside ? min(min(t, left), frame.max_distance) : 0.0));
    if (reached && s.painted) { /* shadow.glsl sees no side of what is clear */
        weight.rgb = vec3(0.0);
    }
    if (through_it) {
        float mirror = interface_mirror(s.ior, c, false); /* it is not bent: c is the one outside */
        weight.rgb *= leaving ? vec3(1.0 - mirror) : (1.0 - mirror) * s.transmission * dye(s);
    }
    if (through_it && args.phase == CLEAR_STEP) {
        vec3 p = ray.origin + ray.direction * t;
        Ray next = Ray(p, ray.direction, ray.way, !leaving, start_behind(ray, t, -max(c, 0.02)));
        send(here, next, vec4(weight.rgb, left - t), leaving ? vec3(0.0) : s.absorption);
    } else {
        vec4 arrives = imageLoad(seen, ivec3(here, args.light));
        imageStore(seen, ivec3(here, args.light), vec4(arrives.rgb * weight.rgb, arrives.a));
    }
}

void main()
{
    ivec2 here = group_place();
    if (here.x < 0) {
        return;
    }
    Ray ray = ray_load(here);
    vec4 g = texelFetch(geometry, here, 0);
    if (args.phase == CLEAR_AIM) {
        aim(here, ray, g);
    } else {
        pass_on(here, ray, g);
    }
}
