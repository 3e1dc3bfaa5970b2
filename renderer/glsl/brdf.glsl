/* SPDX-License-Identifier: MIT */
/* What a surface reflects of the light that comes to it. A light of colour L makes a white diffuse
 * surface facing it as bright as L / pi; surroundings as bright as 1 everywhere make it 1. */

#include "constants.glsl"
#include "optics.glsl"
#include "surface.glsl"

/* Of a standard surface; of others, that of a highlight as wide as theirs. */
float roughness(Surface s)
{
    return s.model == MODEL_STANDARD ? s.gloss : pow(2.0 / (s.gloss + 2.0), 0.25);
}

/* --- microfacets --- */

/* All that microfacets reflect of even surroundings, for light from the angle of
 * cosine c: x of what is reflected at normal incidence, plus y of what is at a grazing angle; z is
 * lost between the facets; all three add up to 1. Our own fits of rational functions to integrals
 * of the formula below, within 0.015 from a roughness of 0.3 up, 0.03 below; after Karis
 * (Physically based shading on mobile, 2014). */
vec3 specular_albedo(float rough, float c)
{
    float r = clamp(rough, 0.1, 1.0), a = r * r, x = clamp(c, 0.01, 1.0);
    float bump = a * x * (0.073052 + a * (1.7537 * a - 0.29411) +
                          x * (a * (0.98381 + 0.14804 * a) - 0.037169));
    float width = a * (0.0027657 + a * (0.18168 + 0.1288 * a)) +
                  x * (0.007347 + a * (3.7472 * a - 0.21661) + x * (0.17754 - 1.3041 * a + x));
    float lost = clamp(bump / width, 0.0, 0.9);
    float edge = (1.0 - x) * (1.0 - x) * max(0.9466 - 0.54223 * r - 0.91749 * x, 0.0) /
                 (1.0 + r * (10.977 * r - 0.11951 - 12.428 * x) + x * (0.057869 + 12.147 * x));
    return vec3(1.0 - lost - edge, edge, lost);
}

/* Its mean over directions, by the cosine. */
vec3 specular_albedo_mean(float rough)
{
    float r = clamp(rough, 0.1, 1.0), a = r * r;
    float lost = a * (0.19334 + a * (0.26172 + 2.3639 * a)) / (1.0 + a * (5.4901 * a - 1.742));
    float edge = max(0.05063 + r * (-0.03659 + r * (-0.104 + 0.09405 * r)), 0.0);
    return vec3(1.0 - lost - edge, edge, lost);
}

/* What is the same for all lights on a standard surface. Light that facets reflect to one another
 * comes out after all (Kulla and Conty: Revisiting physically based shading at Imageworks,
 * SIGGRAPH 2017 course), and what the facets leave is spread by the body of the surface in the
 * same manner: all is the same for light that goes the other way, and none is lost. */
struct Microfacets {
    vec3 f0;
    float f90; /* reflected at a grazing angle */
    float rough;
    vec3 multi_bounce; /* share of light lost between facets that comes out */
    vec3 spread;       /* share of light past the facets that comes out */
    vec3 left;         /* mean of light past the facets */
    float lost;        /* mean of light lost between facets */
};

/* Part of the light from an angle that comes back from the facets: at once, and in all. */
struct DirectionalAlbedo {
    vec3 single_bounce, all;
    float lost; /* between facets */
};

DirectionalAlbedo directional_albedo(Microfacets f, float c)
{
    vec3 e = specular_albedo(f.rough, c);
    vec3 single_bounce = f.f0 * e.x + f.f90 * e.y;
    return DirectionalAlbedo(single_bounce, single_bounce + f.multi_bounce * e.z, e.z);
}

Microfacets microfacets(Surface s)
{
    float f90 = fresnel_f90(s.specular);
    vec3 e = specular_albedo_mean(s.gloss), mean = (20.0 * s.specular + f90) / 21.0;
    vec3 multi_bounce = mean * mean * (1.0 - e.z) / (1.0 - mean * e.z);
    vec3 left = 1.0 - (s.specular * e.x + f90 * e.y + multi_bounce * e.z);
    return Microfacets(s.specular, f90, s.gloss, multi_bounce, s.diffuse * (1.0 - s.transmission),
                       max(left, 1e-3), e.z);
}

/* GGX with the height-correlated shadowing of Smith (Heitz: Understanding the masking-shadowing
 * function in microfacet-based BRDFs, 2014) and Schlick's reflectance, times pi. */
vec3 microfacet_specular(Surface s, vec3 n, vec3 view, vec3 towards)
{
    vec3 sum = view + towards, halfway = sum / max(length(sum), 1e-6);
    float nl = max(dot(n, towards), 1e-4), nv = max(dot(n, view), 1e-4);
    float nh = clamp(dot(n, halfway), 0.0, 1.0);
    float a = max(s.gloss * s.gloss, 0.002), a2 = a * a, rest = 1.0 - a2;
    float d = a / (1.0 - nh * nh * rest);
    float v = 0.5 / (nl * sqrt(nv * nv * rest + a2) + nv * sqrt(nl * nl * rest + a2));
    return d * d * v * fresnel(s.specular, dot(view, halfway));
}

vec3 microfacet_brdf(Surface s, vec3 n, vec3 view, vec3 towards)
{
    Microfacets f = microfacets(s);
    DirectionalAlbedo to_eye = directional_albedo(f, dot(n, view)),
                      to_light = directional_albedo(f, dot(n, towards));
    vec3 multi_bounce = f.multi_bounce * (to_eye.lost * to_light.lost / f.lost);
    vec3 body = f.spread * (1.0 - to_eye.all) * (1.0 - to_light.all) / f.left;
    return microfacet_specular(s, n, view, towards) + multi_bounce + body;
}

/* --- all models --- */

/* Schlick's reflectance of phong and blinn: without reflectivity there is none at any angle. */
vec3 coat_fresnel(Surface s, float c)
{
    float f0 = s.reflectivity, f90 = min(25.0 * f0, 1.0);
    return vec3(f0 + (f90 - f0) * grazing(c));
}

/* Part of the light along the reflected direction that reaches the eye. */
vec3 specular_reflectance(Surface s, vec3 n, vec3 view)
{
    float c = max(dot(n, view), 0.0);
    return s.model == MODEL_STANDARD ? directional_albedo(microfacets(s), c).single_bounce
                                     : coat_fresnel(s, c);
}

/* Phong's and Blinn's, times pi: the highlight by the halfway vector or the reflected one. */
vec3 blinn_phong_brdf(Surface s, vec3 n, vec3 view, vec3 towards)
{
    vec3 sum = view + towards;
    float halfway = dot(n, sum) / max(length(sum), 1e-6);
    float reflected = dot(reflect(-view, n), towards);
    float bright = max(s.model == MODEL_PHONG ? halfway : reflected, 1e-6);
    vec3 body =
        s.diffuse * (1.0 - s.transmission) * (1.0 - coat_fresnel(s, max(dot(n, view), 0.0)));
    return body + 2.0 * s.specular * pow(bright, s.gloss);
}

/* Part of a light's colour that goes from `towards` to `view`, both away from the surface: the
 * distribution function times the cosine. */
vec3 brdf_times_cosine(Surface s, vec3 n, vec3 view, vec3 towards)
{
    vec3 times_pi = s.model == MODEL_STANDARD ? microfacet_brdf(s, n, view, towards)
                                              : blinn_phong_brdf(s, n, view, towards);
    return times_pi * (max(dot(n, towards), 0.0) / PI);
}

/* Occlusion of a bright surface is lightened by what its surroundings reflect at it (Jimenez,
 * Wu, Pesce, Jarabo: Practical real-time strategies for accurate indirect occlusion, 2016). */
vec3 multibounce_visibility(float ambient_visibility, vec3 albedo)
{
    vec3 a = 2.0404 * albedo - 0.3324, b = 0.6417 - 4.7951 * albedo, c = 2.7552 * albedo + 0.6903;
    return max(vec3(ambient_visibility),
               ((ambient_visibility * a + b) * ambient_visibility + c) * ambient_visibility);
}

/* Occlusion of a reflection: less of a narrow one seen head-on (Lagarde and de Rousiers: Moving
 * Frostbite to physically based rendering, SIGGRAPH 2014 course). */
float specular_visibility(float ambient_visibility, float c, float rough)
{
    return clamp(pow(c + ambient_visibility, exp2(-16.0 * rough - 1.0)) - 1.0 + ambient_visibility,
                 0.0, 1.0);
}

/* Light of the environment that a surface reflects to `view`. `ambient_visibility`: part of it that
 * is not occluded; `reflected`: what is seen in the reflection, of which rays bring the part
 * `traced`. */
vec3 environment_light(Surface s, vec3 n, vec3 view, float ambient_visibility, vec3 irradiance,
                       vec3 reflected, float traced)
{
    bool standard = s.model == MODEL_STANDARD;
    float c = max(dot(n, view), 0.0);
    DirectionalAlbedo m = directional_albedo(microfacets(s), c);
    vec3 part = standard ? m.single_bounce : coat_fresnel(s, c);
    vec3 body = s.diffuse * (1.0 - s.transmission);
    vec3 diffuse =
        standard ? m.all - m.single_bounce + body * (1.0 - m.all) : s.ambient * body * (1.0 - part);
    float visibility = (1.0 - traced) * specular_visibility(ambient_visibility, c, roughness(s));
    return diffuse * multibounce_visibility(ambient_visibility, s.diffuse) * irradiance +
           part * reflected * visibility;
}
