/* SPDX-License-Identifier: MIT */
/* What happens to light where two media meet. */

/* How near to a grazing angle, 1, an angle is (Schlick: An inexpensive BRDF model for
 * physically-based rendering, 1994); `cosine` of it to the normal, in the thinner medium. */
float grazing(float cosine)
{
    float x = clamp(1.0 - cosine, 0.0, 1.0), x2 = x * x;
    return x2 * x2 * x;
}

/* Part of the light that is reflected at a grazing angle, f0 head-on: of what hardly reflects
 * head-on it is not all (Lagarde and de Rousiers: Moving Frostbite to physically based rendering,
 * SIGGRAPH 2014 course). So a medium that is none, of index 1, reflects nothing. */
float fresnel_f90(vec3 f0)
{
    return min(50.0 * max(f0.r, max(f0.g, f0.b)), 1.0);
}

/* Part of the light that is reflected at an angle. */
vec3 fresnel(vec3 f0, float cosine)
{
    return mix(f0, vec3(fresnel_f90(f0)), grazing(cosine));
}

/* Snell: the direction of a ray behind a surface, n towards where it comes from; `ratio` of the
 * indices of refraction, before to behind. False where all of it is reflected. */
bool refract_ray(vec3 direction, vec3 n, float ratio, out vec3 refracted)
{
    float c = clamp(-dot(direction, n), 0.0, 1.0);
    float k = 1.0 - ratio * ratio * (1.0 - c * c);
    refracted = normalize(ratio * direction + (ratio * c - sqrt(max(k, 0.0))) * n);
    return k > 0.0;
}

/* The same where a ray goes into a transmissive medium, or out of it. */
float fresnel_dielectric(float ior, float c, bool inside)
{
    float r = (ior - 1.0) / (ior + 1.0);
    float thin = inside ? sqrt(max(1.0 - ior * ior * (1.0 - c * c), 0.0)) : c;
    return fresnel(vec3(r * r), thin).x;
}
