/* SPDX-License-Identifier: MIT */
/* What a surface throws back of the light that comes to it. A light of colour L makes a white matt
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

/* All that a mirror of microfacets throws back of even surroundings, for light from the angle of
 * cosine c: x of what is mirrored at normal incidence, plus y of what is at a grazing angle; z is
 * lost between the facets; all three add up to 1. Our own fits of rational functions to integrals
 * of the formula below, within 0.015 from a roughness of 0.3 up, 0.03 below; after Karis
 * (Physically based shading on mobile, 2014). */
vec3 mirror_albedo(float rough, float c)
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
vec3 mirror_mean(float rough)
{
    float r = clamp(rough, 0.1, 1.0), a = r * r;
    float lost = a * (0.19334 + a * (0.26172 + 2.3639 * a)) / (1.0 + a * (5.4901 * a - 1.742));
    float edge = max(0.05063 + r * (-0.03659 + r * (-0.104 + 0.09405 * r)), 0.0);
    return vec3(1.0 - lost - edge, edge, lost);
}

/* What is the same for all lights on a standard surface. Light that facets throw to one another
 * comes out after all (Kulla and Conty: Revisiting physically based shading at Imageworks,
 * SIGGRAPH 2017 course), and what the mirror leaves is spread by the body of the surface in the
 * same manner: all is the same for light that goes the other way, and none is lost. */
struct Facets {
    vec3 f0;
    float most; /* mirrored at a grazing angle */
    float rough;
    vec3 again;  /* share of light lost between facets that comes out */
    vec3 spread; /* share of light past the mirror that comes out */
    vec3 left;   /* mean of light past the mirror */
    float lost;  /* mean of light lost between facets */
};

/* Part of the light from an angle that comes back from the facets: at once, and in all. */
struct Mirror {
    vec3 once, all;
    float lost; /* between facets */
};

Mirror mirror_at(Facets f, float c)
{
    vec3 e = mirror_albedo(f.rough, c);
    vec3 once = f.f0 * e.x + f.most * e.y;
    return Mirror(once, once + f.again * e.z, e.z);
}

Facets facets(Surface s)
{
    float most = mirror_most(s.specular);
    vec3 e = mirror_mean(s.gloss), mean = (20.0 * s.specular + most) / 21.0;
    vec3 again = mean * mean * (1.0 - e.z) / (1.0 - mean * e.z);
    vec3 left = 1.0 - (s.specular * e.x + most * e.y + again * e.z);
    return Facets(s.specular, most, s.gloss, again, s.diffuse * (1.0 - s.transmission),
                  max(left, 1e-3), e.z);
}

/* GGX with the height-correlated shadowing of Smith (Heitz: Understanding the masking-shadowing
 * function in microfacet-based BRDFs, 2014) and Schlick's mirror, times pi. */
vec3 facets_mirror(Surface s, vec3 n, vec3 view, vec3 towards)
{
    vec3 sum = view + towards, halfway = sum / max(length(sum), 1e-6);
    float nl = max(dot(n, towards), 1e-4), nv = max(dot(n, view), 1e-4);
    float nh = clamp(dot(n, halfway), 0.0, 1.0);
    float a = max(s.gloss * s.gloss, 0.002), a2 = a * a, rest = 1.0 - a2;
    float d = a / (1.0 - nh * nh * rest);
    float v = 0.5 / (nl * sqrt(nv * nv * rest + a2) + nv * sqrt(nl * nl * rest + a2));
    return d * d * v * fresnel(s.specular, dot(view, halfway));
}

vec3 facets_reflected(Surface s, vec3 n, vec3 view, vec3 towards)
{
    Facets f = facets(s);
    Mirror to = mirror_at(f, dot(n, view)), from = mirror_at(f, dot(n, towards));
    vec3 again = f.again * (to.lost * from.lost / f.lost);
    vec3 body = f.spread * (1.0 - to.all) * (1.0 - from.all) / f.left;
    return facets_mirror(s, n, view, towards) + again + body;
}

/* --- all models --- */

/* Schlick's mirror of phong and blinn: without reflectivity there is none at any angle. */
vec3 varnish(Surface s, float c)
{
    float least = s.reflectivity, most = min(25.0 * least, 1.0);
    return vec3(least + (most - least) * grazing(c));
}

/* Part of the light along the mirrored direction that reaches the eye. */
vec3 mirror_part(Surface s, vec3 n, vec3 view)
{
    float c = max(dot(n, view), 0.0);
    return s.model == MODEL_STANDARD ? mirror_at(facets(s), c).once : varnish(s, c);
}

/* Phong's and Blinn's, times pi: the highlight by the halfway vector or the reflected one. */
vec3 shiny_reflected(Surface s, vec3 n, vec3 view, vec3 towards)
{
    vec3 sum = view + towards;
    float halfway = dot(n, sum) / max(length(sum), 1e-6);
    float mirrored = dot(reflect(-view, n), towards);
    float bright = max(s.model == MODEL_PHONG ? halfway : mirrored, 1e-6);
    vec3 body = s.diffuse * (1.0 - s.transmission) * (1.0 - varnish(s, max(dot(n, view), 0.0)));
    return body + 2.0 * s.specular * pow(bright, s.gloss);
}

/* Part of a light's colour that goes from `towards` to `view`, both away from the surface: the
 * distribution function times the cosine. */
vec3 reflected(Surface s, vec3 n, vec3 view, vec3 towards)
{
    vec3 times_pi = s.model == MODEL_STANDARD ? facets_reflected(s, n, view, towards)
                                              : shiny_reflected(s, n, view, towards);
    return times_pi * (max(dot(n, towards), 0.0) / PI);
}

/* Occlusion of a bright surface is lightened by what its surroundings throw back at it (Jimenez,
 * Wu, Pesce, Jarabo: Practical real-time strategies for accurate indirect occlusion, 2016). */
vec3 opened(float open, vec3 albedo)
{
    vec3 a = 2.0404 * albedo - 0.3324, b = 0.6417 - 4.7951 * albedo, c = 2.7552 * albedo + 0.6903;
    return max(vec3(open), ((open * a + b) * open + c) * open);
}

/* Occlusion of a mirror image: less of a narrow one seen head-on (Lagarde and de Rousiers: Moving
 * Frostbite to physically based rendering, SIGGRAPH 2014 course). */
float mirror_opened(float open, float c, float rough)
{
    return clamp(pow(c + open, exp2(-16.0 * rough - 1.0)) - 1.0 + open, 0.0, 1.0);
}

/* Light of the environment that a surface throws to `view`. `open`: part of it that is not
 * occluded; `mirrored`: what is seen in the mirror image, of which rays bring the part `traced`. */
vec3 surroundings(Surface s, vec3 n, vec3 view, float open, vec3 irradiance, vec3 mirrored,
                  float traced)
{
    bool standard = s.model == MODEL_STANDARD;
    float c = max(dot(n, view), 0.0);
    Mirror m = mirror_at(facets(s), c);
    vec3 part = standard ? m.once : varnish(s, c);
    vec3 body = s.diffuse * (1.0 - s.transmission);
    vec3 matt = standard ? m.all - m.once + body * (1.0 - m.all) : s.ambient * body * (1.0 - part);
    float seen = (1.0 - traced) * mirror_opened(open, c, roughness(s));
    return matt * opened(open, s.diffuse) * irradiance + part * mirrored * seen;
}
