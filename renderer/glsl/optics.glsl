/* SPDX-License-Identifier: MIT */
/* What happens to light where two media meet. */

/* Schlick: An inexpensive BRDF model for physically-based rendering, 1994; `cosine` of the angle to
 * the normal, in the thinner medium. */
vec3 fresnel(vec3 f0, float cosine)
{
    float x = clamp(1.0 - cosine, 0.0, 1.0), x2 = x * x;
    return f0 + (1.0 - f0) * (x2 * x2 * x);
}

/* Snell: the direction of a ray behind a surface, n towards where it comes from; `ratio` of the
 * indices of refraction, before to behind. False where all of it is mirrored. */
bool bend(vec3 direction, vec3 n, float ratio, out vec3 bent)
{
    float c = clamp(-dot(direction, n), 0.0, 1.0);
    float k = 1.0 - ratio * ratio * (1.0 - c * c);
    bent = normalize(ratio * direction + (ratio * c - sqrt(max(k, 0.0))) * n);
    return k > 0.0;
}

/* Part of the light that is mirrored where a ray goes into a clear medium, or out of it. What
 * hardly mirrors head-on does not at a grazing angle either (Lagarde and de Rousiers: Moving
 * Frostbite to physically based rendering, 2014). */
float interface_mirror(float ior, float c, bool inside)
{
    float r = (ior - 1.0) / (ior + 1.0), f0 = r * r;
    float thin = inside ? sqrt(max(1.0 - ior * ior * (1.0 - c * c), 0.0)) : c;
    return min(fresnel(vec3(f0), thin).x, 50.0 * f0);
}
