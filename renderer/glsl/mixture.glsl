/* SPDX-License-Identifier: MIT */
/* What is known of a surface besides its distance, and how it mixes. */

/* Empty space is this far away. */
const float FAR = 1e9;

/* Which shapes map() and surface() see. 0: all; FAR: those that light goes through are away; -FAR:
 * those that it does not go through are. */
float through = 0.0;

/* The distance of a shape that may be away; `clear` is the fourth number of its head. */
float hidden(float d, float clear)
{
    return d + max(clear * through, 0.0);
}

/* Where surfaces are only chosen, never mixed, they are vec3(distance, leaf, material slot); a
 * Mixture has the materials' numbers, as they lie in the table, and the weight of its leaf. */
struct Mixture {
    float d, leaf, weight;
    vec4 diffuse_gloss, specular, emission, ambient;
    vec4 optics; /* reflectivity, transmission, index of refraction, model */
    vec4 absorption;
#ifdef USER_SHADERS
    /* Where the strongest two shaders apply: point in the shape's space, share. */
    vec4 first, second;
    vec2 slots; /* their materials */
#endif
};

#ifdef USER_SHADERS
#define NO_SHADERS , vec4(0.0), vec4(0.0), vec2(0.0)
#else
#define NO_SHADERS
#endif

/* Nothing. */
Mixture mixture_far()
{
    return Mixture(FAR, 0.0, 1.0, vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0),
                   vec4(0.0) NO_SHADERS);
}

/* One of two, by the share of b, with the distance of the result. */
vec3 choose(float d, float share, vec3 a, vec3 b)
{
    return vec3(d, share > 0.5 ? b.yz : a.yz);
}

#ifdef USER_SHADERS
/* Keeps the strongest two shaders; the same material counts as one. */
void add_shader(inout Mixture m, vec4 place, float slot)
{
    bool one = place.w > 0.0 && m.first.w > 0.0 && slot == m.slots.x;
    bool two = place.w > 0.0 && m.second.w > 0.0 && slot == m.slots.y && !one;
    if (one) {
        m.first = vec4(place.w > m.first.w ? place.xyz : m.first.xyz, m.first.w + place.w);
    }
    if (two) {
        m.second = vec4(place.w > m.second.w ? place.xyz : m.second.xyz, m.second.w + place.w);
    }
    if (!one && !two && place.w > m.second.w) {
        m.second = place;
        m.slots.y = slot;
    }
    if (m.second.w > m.first.w) {
        vec4 before = m.first;
        m.first = m.second;
        m.second = before;
        m.slots = m.slots.yx;
    }
}
#endif

/* Both, by the share of b, with the distance of the result. The model is that of the leaf, and so
 * is gloss where it means different things. */
Mixture blend(float d, float share, Mixture a, Mixture b)
{
    float wa = a.weight * (1.0 - share), wb = b.weight * share;
    bool most = wb > wa;
    Mixture m = Mixture(
        d, most ? b.leaf : a.leaf, max(wa, wb), mix(a.diffuse_gloss, b.diffuse_gloss, share),
        mix(a.specular, b.specular, share), mix(a.emission, b.emission, share),
        mix(a.ambient, b.ambient, share), mix(a.optics, b.optics, share),
        mix(a.absorption, b.absorption, share) NO_SHADERS);
    m.optics.w = most ? b.optics.w : a.optics.w;
    if (a.optics.w != b.optics.w) {
        m.diffuse_gloss.w = most ? b.diffuse_gloss.w : a.diffuse_gloss.w;
    }
#ifdef USER_SHADERS
    add_shader(m, vec4(a.first.xyz, a.first.w * (1.0 - share)), a.slots.x);
    add_shader(m, vec4(a.second.xyz, a.second.w * (1.0 - share)), a.slots.y);
    add_shader(m, vec4(b.first.xyz, b.first.w * share), b.slots.x);
    add_shader(m, vec4(b.second.xyz, b.second.w * share), b.slots.y);
#endif
    return m;
}
