/* SPDX-License-Identifier: MIT */
/* What is known of a surface besides its distance, and how it mixes. */

#include "code.glsl"
#include "field_mask.glsl"
#include "surface.glsl"

/* Where surfaces are only chosen, never mixed, they are vec3(distance, leaf, material slot). A
 * Mixture knows of its four strongest materials where they lie in the table and how much they
 * count, the strongest first; their numbers are read once, at the end. */
struct Mixture {
    float d, leaf, weight; /* of the leaf */
    vec4 slots, shares;
#ifdef USER_SHADERS
    vec3 place_x, place_y, place_z, place_w; /* the point in the space of each one's shape */
#endif
};

/* A point in the space of the shape is handed along only where there are shaders. */
#ifdef USER_SHADERS
#define AND_PLACE(place) , place
#define AND_PLACES , vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0)
#else
#define AND_PLACE(place)
#define AND_PLACES
#endif

/* Of one material. */
Mixture mixture(vec3 h AND_PLACE(vec3 o))
{
    Mixture m = Mixture(h.x, h.y, 1.0, vec4(h.z), vec4(1.0, 0.0, 0.0, 0.0) AND_PLACES);
#ifdef USER_SHADERS
    m.place_x = o;
#endif
    return m;
}

/* Nothing. */
Mixture mixture_far()
{
    return mixture(vec3(FAR, 0.0, 0.0) AND_PLACE(vec3(0.0)));
}

/* One of two, by the share of b, with the distance of the result. */
vec3 choose(float d, float share, vec3 a, vec3 b)
{
    return vec3(d, share > 0.5 ? b.yz : a.yz);
}

#define EXCHANGE(type, a, b)                                                                       \
    {                                                                                              \
        type before = a;                                                                           \
        a = outgrown ? b : a;                                                                      \
        b = outgrown ? before : b;                                                                 \
    }
#ifdef USER_SHADERS
#define EXCHANGE_PLACES(a, b) EXCHANGE(vec3, a, b)
#else
#define EXCHANGE_PLACES(a, b)
#endif
/* The material in `from` goes before the one that it has outgrown. */
#define RISE(to, from, to_place, from_place)                                                       \
    {                                                                                              \
        bool outgrown = m.shares.from > m.shares.to;                                               \
        EXCHANGE(float, m.shares.to, m.shares.from)                                                \
        EXCHANGE(float, m.slots.to, m.slots.from)                                                  \
        EXCHANGE_PLACES(m.to_place, m.from_place)                                                  \
    }

/* Takes a material in, in the place of the weakest if it is new. */
void add(inout Mixture m, float slot, float share AND_PLACE(vec3 place))
{
    vec4 same = vec4(equal(m.slots, vec4(slot))) * vec4(greaterThan(m.shares, vec4(0.0)));
    bool known = dot(same, vec4(1.0)) > 0.0, enters = !known && share > m.shares.w;
#ifdef USER_SHADERS
    m.place_x = same.x * share > m.shares.x ? place : m.place_x;
    m.place_y = same.y * share > m.shares.y ? place : m.place_y;
    m.place_z = same.z * share > m.shares.z ? place : m.place_z;
    m.place_w = enters || same.w * share > m.shares.w ? place : m.place_w;
#endif
    m.shares += same * share;
    m.shares.w = enters ? share : m.shares.w;
    m.slots.w = enters ? slot : m.slots.w;
    RISE(z, w, place_z, place_w)
    RISE(y, z, place_y, place_z)
    RISE(x, y, place_x, place_y)
}

/* What is left of a beside a part of another. */
Mixture mixture_beside(float d, float share, Mixture a, float leaf, float weight)
{
    float wa = a.weight * (1.0 - share), wb = weight * share;
    a.d = d;
    a.leaf = wb > wa ? leaf : a.leaf;
    a.weight = max(wa, wb);
    a.shares *= 1.0 - share;
    return a;
}

/* Both, by the share of b, with the distance of the result. */
Mixture blend(float d, float share, Mixture a, vec3 b AND_PLACE(vec3 o))
{
    Mixture m = mixture_beside(d, share, a, b.y, 1.0);
    add(m, b.z, share AND_PLACE(o));
    return m;
}

Mixture blend(float d, float share, Mixture a, Mixture b)
{
    Mixture m = mixture_beside(d, share, a, b.leaf, b.weight);
    b.shares *= share;
    add(m, b.slots.x, b.shares.x AND_PLACE(b.place_x));
    add(m, b.slots.y, b.shares.y AND_PLACE(b.place_y));
    add(m, b.slots.z, b.shares.z AND_PLACE(b.place_z));
    add(m, b.slots.w, b.shares.w AND_PLACE(b.place_w));
    return m;
}

/* A mixture becomes a surface material by material. Before the first: all shares make up 1. */
Surface surface_begin(inout Mixture m)
{
    float sum = dot(m.shares, vec4(1.0));
    m.shares = sum > 0.0 ? m.shares / sum : vec4(1.0, 0.0, 0.0, 0.0);
    m.weight = 0.0;
    return Surface(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, 0.0, -1,
                   false, uint(m.leaf));
}

/* Parts of a slot: its shape cuts something (renderer/field/field.h). */
#define CUTS_TRANSMISSIVE 0.25
#define CUTS_OPAQUE 0.5

/* A material's numbers as surface_add takes them, which its shader changes. */
struct MaterialValues {
    vec4 diffuse_gloss, specular, emission, ambient, optics, absorption;
};

#ifdef USER_SHADERS
/* With the colour that a shader gives. */
void material_set_color(inout MaterialValues values, vec3 color, bool unlit)
{
    values.diffuse_gloss.rgb += unlit ? vec3(0.0) : color;
    values.emission.rgb += unlit ? color : vec3(0.0);
}

/* All of it is what a shader says. What may be transmissive always is a little, so that light on
 * its way to other things finds it. In C: field_put_surface. */
void material_set_surface(inout MaterialValues values, CodeSurface c, bool unlit)
{
    if (unlit) {
        values.emission.rgb += c.color + c.emission;
        return;
    }
    float r = (c.ior - 1.0) / (c.ior + 1.0),
          min_transmission = values.optics.y > 0.0 ? 1.0 / 255.0 : 0.0;
    vec3 specular = mix(vec3(max(r * r, c.reflectivity)), c.color, c.metallic);
    float reflectivity = max(specular.r, max(specular.g, specular.b));
    values.diffuse_gloss = vec4(c.color * (1.0 - c.metallic), c.roughness);
    values.specular = vec4(specular, 0.0);
    values.emission = vec4(c.emission, 0.0);
    values.ambient = vec4(1.0);
    values.optics =
        vec4(reflectivity, max(c.transmission, min_transmission), c.ior, float(MODEL_STANDARD));
    values.absorption = vec4(c.absorption, 0.0);
}
#endif

/* Adds the strongest material, of these numbers. The model is that of the first; gloss, which means
 * another thing in each model, is the mean of those that share it, and m.weight is their part. */
void surface_add(inout Surface s, inout Mixture m, MaterialValues values)
{
    float share = m.shares.x, cuts = fract(m.slots.x);
    int model = int(values.optics.w);
    float goes_through = cuts == CUTS_OPAQUE ? 0.0 : values.optics.y;
    s.opaque_cut = s.model < 0 ? cuts == CUTS_TRANSMISSIVE && goes_through == 0.0 : s.opaque_cut;
    s.model = s.model < 0 ? model : s.model;
    if (model == s.model) {
        m.weight += share;
        s.gloss = mix(s.gloss, values.diffuse_gloss.w, share / m.weight);
    }
    s.diffuse += share * values.diffuse_gloss.rgb;
    s.specular += share * values.specular.rgb;
    s.emission += share * values.emission.rgb;
    s.ambient += share * values.ambient.rgb;
    s.reflectivity += share * values.optics.x;
    s.transmission += share * goes_through;
    s.ior += share * values.optics.z;
    s.absorption += share * values.absorption.rgb;
}

/* Leaves the strongest material behind. */
void mixture_next(inout Mixture m)
{
    m.slots = m.slots.yzwx;
    m.shares = vec4(m.shares.yzw, 0.0);
#ifdef USER_SHADERS
    m.place_x = m.place_y;
    m.place_y = m.place_z;
    m.place_z = m.place_w;
#endif
}
