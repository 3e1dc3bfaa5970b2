/* SPDX-License-Identifier: MIT */
/* Rays through pixels. Every number comes from whole pixel coordinates, so that a ray does not
 * depend on the tile it is drawn in. */

#include "frame.glsl"
#include "radical_inverse.glsl"
#include "ray.glsl"

/* The pinhole's ray through a place of the picture, in pixels from its left top. */
Ray camera_ray(vec2 at)
{
    vec2 place = at / vec2(camera.size);
    vec3 aside = camera.right * (2.0 * place.x - 1.0) + camera.up * (1.0 - 2.0 * place.y);
    if (camera.orthographic != 0) {
        return Ray(camera.eye + aside, camera.forward, 0.0, false, 0.0);
    }
    return Ray(camera.eye, normalize(camera.forward + aside), 0.0, false, 0.0);
}

/* Radius of a block's cone in footprints, which are half a pixel: from the block's middle to its
 * corners. */
#define BLOCK_CONE 11.5

/* The ray in the middle of BLOCK_SIDE x BLOCK_SIDE pixels. */
Ray block_ray(ivec2 block)
{
    return camera_ray(vec2(block * BLOCK_SIDE + BLOCK_SIDE / 2));
}

/* Where in its pixel sample i lies, in 0..1: the first in the middle, the others so that any number
 * of them is spread evenly, also along each axis (Roberts: The unreasonable effectiveness of
 * quasirandom sequences, 2018). */
vec2 sample_place(int i)
{
    return fract(0.5 + float(i) * vec2(0.7548776662, 0.5698402910));
}

/* In 0..1, from the place in the picture alone (Jimenez: Next generation post processing in Call of
 * Duty: Advanced Warfare, SIGGRAPH 2014). */
float pixel_noise(ivec2 pixel)
{
    return fract(52.9829189 * fract(dot(vec2(pixel), vec2(0.06711056, 0.00583715))));
}

/* A place on the lens, a disc of radius 1: by the golden angle, turned for each pixel. Radii jump
 * to and fro (van der Corput), so that the first few of many are spread over the whole lens. */
vec2 lens_place(ivec2 pixel, int i, int count)
{
    float part = radical_inverse(i);
    float r = sqrt(part + 0.5 / float(count));
    float angle = 2.39996323 * float(i) + 6.2831853 * pixel_noise(pixel);
    return r * vec2(cos(angle), sin(angle));
}

/* The ray of a sample of a pixel. What lies at the distance in focus, along the view, is hit at the
 * same place from everywhere on the lens. */
Ray camera_sample(ivec2 pixel, int i)
{
    Ray ray = camera_ray(vec2(pixel) + sample_place(i));
    if (camera.lens_radius > 0.0) {
        float distance = camera.focus_distance / dot(ray.direction, camera.forward);
        vec3 sharp = ray.origin + ray.direction * distance;
        vec2 lens = camera.lens_radius * lens_place(pixel, i, frame.samples);
        ray.origin += normalize(camera.right) * lens.x + normalize(camera.up) * lens.y;
        ray.direction = normalize(sharp - ray.origin);
    }
    return ray;
}
