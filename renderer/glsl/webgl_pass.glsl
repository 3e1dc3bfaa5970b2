/* SPDX-License-Identifier: MIT */
/* A whole picture by one fragment shader of WebGL 2, without textures or buffers. SAMPLES of each
 * pixel, RAYS of each sample after the first, TRANSMISSION_DEPTH surfaces between what is met and a
 * light; the camera looks at TARGET. */

#include "sample.glsl"
#include "screen.glsl"
#include "sums.glsl"

uniform vec2 resolution; /* of the picture, in pixels */
/* Radians around the target, radians above, and how much nearer, e to the power of it; 0: the
 * scene's own view. */
uniform vec3 orbit;

out vec4 out_color;

vec3 turn(vec3 v, vec3 axis, float angle)
{
    float c = cos(angle);
    return v * c + cross(axis, v) * sin(angle) + axis * dot(axis, v) * (1.0 - c);
}

vec3 orbited(vec3 v, vec3 right)
{
    return turn(turn(v, right, -orbit.y), vec3(0.0, 1.0, 0.0), orbit.x);
}

void place_camera()
{
    vec3 right = normalize(camera.right);
    float nearer = exp(-orbit.z);
    bool parallel = camera.orthographic != 0;
    float half_height = length(camera.up) * (parallel ? nearer : 1.0);
    camera.eye = TARGET + orbited(camera.eye - TARGET, right) * (parallel ? 1.0 : nearer);
    camera.forward = orbited(camera.forward, right);
    camera.up = half_height * orbited(normalize(camera.up), right);
    camera.right = half_height * resolution.x / resolution.y * orbited(right, right);
    camera.pixel_radius = half_height / resolution.y;
    camera.size = ivec2(resolution);
}

void main()
{
    zero = min(int(resolution.x), 0); /* which no compiler knows */
    preload();
    place_camera();
    ivec2 pixel = ivec2(gl_FragCoord.x, resolution.y - gl_FragCoord.y);
    vec4 sum = vec4(0.0);
    vec2 count = vec2(0.0);
    for (int i = zero; i < SAMPLES; i++) {
        vec4 total, g, light;
        vec2 one;
        Met met;
        stack_set_count(pixel, 0);
        trace(pixel, 0.0, i, RAYS, TRANSMISSION_DEPTH, true, true, total, g, met);
        sample_sums(total, light, one);
        sum += light;
        count += one;
    }
    out_color = pixel_color(sums_mean(sum, count), pixel);
}
