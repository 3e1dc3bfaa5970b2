/* SPDX-License-Identifier: MIT */
/* What a surface throws back of the light that comes to it. A light of colour L makes a white matt
 * surface facing it as bright as L / pi; surroundings as bright as 1 everywhere make it 1. */

#define PI 3.14159265

/* Of a standard surface; of others, that of a highlight as wide as theirs. */
float roughness(Surface s)
{
    return s.model == MODEL_STANDARD ? s.gloss : pow(2.0 / (s.gloss + 2.0), 0.25);
}

/* --- microfacets --- */

/* All that a rough mirror throws back of even surroundings: x for what is mirrored at normal
 * incidence, plus y (Karis: Physically based shading on mobile, 2014). */
vec2 mirror_albedo(float rough, float c)
{
    vec4 r = rough * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * c)) * r.x + r.y;
    return vec2(-1.04, 1.04) * a + r.zw;
}

/* Its mean over the directions of even light. */
vec2 mirror_mean(float rough)
{
    return mirror_albedo(rough, 0.67);
}

/* What is the same for all lights on a standard surface. Light that facets throw to one another
 * comes out after all (Kulla and Conty: Revisiting physically based shading at Imageworks,
 * SIGGRAPH 2017 course), and what the mirror leaves is spread by the body of the surface. */
struct Facets {
    vec3 f0;
    float rough;
    vec3 again;  /* share of light lost between facets that comes out */
    vec3 spread; /* share of light past the mirror that comes out */
    float lost;  /* mean of what is lost between facets */
};

/* Part of light from a direction that the mirror throws back: at once, and in all. */
void mirror_shares(Facets f, float c, out vec3 once, out vec3 all, out float lost)
{
    vec2 e = mirror_albedo(f.rough, c);
    lost = max(1.0 - e.x - e.y, 0.0);
    once = f.f0 * e.x + e.y;
    all = once + f.again * lost;
}

Facets facets(Surface s)
{
    Facets f;
    vec2 e = mirror_mean(s.gloss);
    vec3 mean = (20.0 * s.specular + 1.0) / 21.0;
    f.f0 = s.specular;
    f.rough = s.gloss;
    f.lost = max(1.0 - e.x - e.y, 1e-4);
    f.again = mean * mean * (1.0 - f.lost) / (1.0 - mean * f.lost);
    vec3 left = 1.0 - (s.specular * e.x + e.y + f.again * f.lost);
    f.spread = s.diffuse * (1.0 - s.transmission) / max(left, 1e-3);
    return f;
}

/* GGX with the height-correlated shadowing of Smith (Heitz: Understanding the masking-shadowing
 * function in microfacet-based BRDFs, 2014), Schlick's mirror. */
vec3 facets_reflected(Surface s, vec3 n, vec3 view, vec3 towards)
{
    Facets f = facets(s);
    vec3 halfway = normalize(view + towards), once, all_l, all_v;
    float nl = max(dot(n, towards), 0.0), nv = max(dot(n, view), 1e-3);
    float nh = max(dot(n, halfway), 0.0), lost_l, lost_v;
    float a = max(s.gloss * s.gloss, 0.002), a2 = a * a;
    float d = a / (1.0 - nh * nh * (1.0 - a2));
    float v = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
    mirror_shares(f, nl, once, all_l, lost_l);
    mirror_shares(f, nv, once, all_v, lost_v);
    vec3 mirror = d * d * v * fresnel(s.specular, dot(view, halfway));
    vec3 again = f.again * lost_l * lost_v / f.lost;
    return (mirror + again + f.spread * (1.0 - all_l) * (1.0 - all_v)) * (nl / PI);
}

/* --- all models --- */

/* Schlick's mirror of phong and blinn: without reflectivity there is none at any angle. */
vec3 varnish(Surface s, float c)
{
    float least = s.reflectivity, most = min(25.0 * least, 1.0);
    return vec3(least + (most - least) * fresnel(vec3(0.0), c).x);
}

/* Part of the light along the mirrored direction that reaches the eye. */
vec3 mirror_part(Surface s, vec3 n, vec3 view)
{
    float c = max(dot(n, view), 0.0);
    vec2 e = mirror_albedo(s.gloss, c);
    return s.model == MODEL_STANDARD ? s.specular * e.x + e.y : varnish(s, c);
}

/* Part of a light's colour that goes from `towards` to `view`, both away from the surface: its
 * reflectance distribution times the cosine. */
vec3 reflected(Surface s, vec3 n, vec3 view, vec3 towards)
{
    float lambert = max(dot(n, towards), 0.0);
    float bright = s.model == MODEL_PHONG ? dot(n, normalize(towards + view))
                                          : dot(reflect(-view, n), towards);
    vec3 body = s.diffuse * (1.0 - s.transmission) * (1.0 - varnish(s, max(dot(n, view), 0.0)));
    vec3 shiny = body + 2.0 * s.specular * pow(max(bright, 1e-4), s.gloss);
    return s.model == MODEL_STANDARD ? facets_reflected(s, n, view, towards) : shiny * (lambert / PI);
}

/* Occlusion of a bright surface is lightened by what its surroundings throw back at it (Jimenez,
 * Wu, Pesce, Jarabo: Practical real-time strategies for accurate indirect occlusion, 2016). */
vec3 opened(float open, vec3 albedo)
{
    vec3 a = 2.0404 * albedo - 0.3324, b = 0.6417 - 4.7951 * albedo, c = 2.7552 * albedo + 0.6903;
    return max(vec3(open), ((open * a + b) * open + c) * open);
}

/* Light of the environment that a surface throws to `view`. `open`: part of it that is not occluded;
 * `mirrored`: what is seen in the mirror image, of which rays bring the part `traced`. */
vec3 surroundings(Surface s, vec3 n, vec3 view, float open, vec3 irradiance, vec3 mirrored,
                  float traced)
{
    float c = max(dot(n, view), 0.0), lost;
    Facets f = facets(s);
    vec3 once, all;
    mirror_shares(f, c, once, all, lost);
    bool standard = s.model == MODEL_STANDARD;
    vec3 part = mirror_part(s, n, view);
    vec3 body = s.diffuse * (1.0 - s.transmission);
    body *= standard ? 1.0 - all : s.ambient * (1.0 - part);
    vec3 matt = (body + (standard ? all - once : vec3(0.0))) * irradiance;
    return matt * opened(open, s.diffuse) + part * mirrored * (1.0 - traced) * open;
}
