/* SPDX-License-Identifier: MIT */
/* Everything in one fragment shader, from the camera on: the other way to the picture, to compare
 * the passes with. Without smoke, and without colours of light through clear things. turn.x: which
 * sample; turn.y: rays after the first. */

layout(rgba32f, binding = 4) writeonly uniform image2D totals;

void main()
{
    preload();
    ivec2 here = ivec2(gl_FragCoord.xy);
    Ray ray = camera_sample(tile.xy + here, turn.x);
    vec4 weight = vec4(1.0, 1.0, 1.0, 0.0), total = vec4(0.0);
    vec3 medium = vec3(0.0);

    has_next = true;
    for (int i = zero; i <= turn.y && has_next; i++) {
        Hit found = march(ray, i == 0 ? bounds_min.w : 0.0, 0.0, size.w);
        float t = found.hit ? found.t : 0.0;
        vec3 p = ray.origin + ray.direction * t;
        Surface s;
        through = found.solid ? FAR : ray.inside ? -FAR : 0.0;
        surface(p, Shading(p, vec3(0.0), found.normal, ray.direction, t), s);
        look(p, found.normal, footprint(ray, t), found.hit);
        has_next = false;
        vec4 g = vec4(found.normal, found.solid ? -max(found.t, 1e-30) : found.t);
        add_light(here, ray, g, s, seen_open, vec4(0.0, 0.0, 0.0, 1.0), i == 0, i == turn.y, weight,
                  medium, total);
        ray = ray_of(next_ray.from, next_ray.along);
        weight = next_ray.weight;
        medium = next_ray.medium.rgb;
    }
    imageStore(totals, here, total);
}
