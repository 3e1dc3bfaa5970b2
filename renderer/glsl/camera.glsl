/* SPDX-License-Identifier: MIT */
/* Rays through pixels. Every number comes from whole pixel coordinates, so that a ray does not
 * depend on the tile it is drawn in. */

struct Ray {
    vec3 origin;
    vec3 direction; /* of length 1 */
};

/* Where in its pixel a sample lies, in 0..1. With n x n samples: one in each cell of an n x n grid
 * and one in each of the n^2 columns and rows (Chiu, Shirley, Wang: Multi-jittered sampling,
 * Graphics Gems IV, 1994, the canonical arrangement): edges near the axes get n^2 shades. */
vec2 sample_place(ivec2 cell, int n)
{
    vec2 fine = (vec2(cell.y, n - 1 - cell.x) + 0.5) / float(n);
    return (vec2(cell) + fine) / float(n);
}

/* The ray of a sample; `at` counts samples from the left top of the picture. */
Ray camera_ray(ivec2 at)
{
    int n = size.z;
    ivec2 pixel = at / n;
    vec2 place = (vec2(pixel) + sample_place(at - pixel * n, n)) / vec2(size.xy);
    vec3 aside = right.xyz * (2.0 * place.x - 1.0) + up.xyz * (1.0 - 2.0 * place.y);
    if (eye.w > 0.5) {
        return Ray(eye.xyz + aside, forward.xyz);
    }
    return Ray(eye.xyz, normalize(forward.xyz + aside));
}

/* Radius of a pixel's footprint at distance t along its ray. */
float footprint(float t)
{
    return forward.w * (eye.w > 0.5 ? 1.0 : t);
}
