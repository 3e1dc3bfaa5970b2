/* SPDX-License-Identifier: MIT */
/* What of each light, and of the environment's, comes to a place of a surface. What light goes
 * through casts no shadow here: transmission_pass.glsl colours its light. */

#include "field_bound.glsl"
#include "lights.glsl"
#include "section.glsl"

/* Where answers go (shadow_sink.glsl, sample_sink.glsl): the part of the environment's light,
 * then that of each light, with the former beside it. */
void store_ambient_visibility(float ambient_visibility);
void store_visibility(int light, float visibility, float ambient_visibility);

/* A ray on its way to a light. */
struct ShadowRay {
    float far, footprint; /* its end; what counts as nothing */
    float k;              /* sharpness of the shadow */
    float x;              /* where the distance is wanted next */
    float at, radius;     /* the last place on its way, and the distance there */
    float ahead;          /* the step that is tried */
    float slope;          /* of the distance, for a hard shadow */
    vec2 a, b, c;         /* for a soft one: (1, distance) / way at the last three places */
    bool refined;         /* x lies behind `at` */
    float visibility;     /* part of the light so far */
};

/* As if the surface were flat where the ray begins, `lift` above it. */
ShadowRay shadow_ray_begin(float near, float far, float footprint, float k, float lambert,
                           float lift)
{
    vec2 flat_there = vec2(0.0, lambert), higher = vec2(1.0, lift) / near;
    return ShadowRay(far, footprint, k, near, near, 0.0, 0.0, -1.0, flat_there + 4.0 * higher,
                     flat_there + 3.0 * higher, flat_there + 2.0 * higher, false, 1.0);
}

/* Sphere tracing with stretched steps, as in march.glsl. False at the end. */
bool hard_step(inout ShadowRay s, float d)
{
    bool back = s.ahead > s.radius + abs(d);
    s.slope = back ? -1.0 : s.ahead > 0.0 ? mix(s.slope, (d - s.radius) / s.ahead, 0.3) : s.slope;
    s.at = back ? s.at : s.x;
    s.radius = back ? s.radius : d;
    s.visibility = s.at <= s.far && s.radius < 0.05 * s.footprint ? 0.0 : 1.0;
    s.ahead = max(back ? s.radius : s.radius * max(1.0, 2.0 / (1.0 - s.slope)), 0.5 * s.footprint);
    s.x = s.at + s.ahead;
    return s.visibility > 0.0 && s.at <= s.far;
}

/* Out of steps: as if all went on as it went. */
float hard_end(ShadowRay s)
{
    return s.at <= s.far && s.radius + s.slope * (s.far - s.at) < 0.0 ? 0.0 : s.visibility;
}

/* Where lines through two places before and two behind meet: xy of each is (1, distance) / way, in
 * which anything straight is a line. Past an edge of the field the least ratio is right there, past
 * anything round close to it. FAR up where they do not meet between. */
vec2 turning_point(vec2 a, vec2 b, vec2 c, vec2 d)
{
    float fall = (b.y - a.y) / (b.x - a.x), rise = (d.y - c.y) / (d.x - c.x);
    float closing = fall - rise;
    float x = b.x + (b.y - c.y + rise * (c.x - b.x)) / min(-closing, -1e-9);
    return vec2(x, closing > 0.0 && x < b.x && x > c.x ? b.y + fall * (x - b.x) : FAR);
}

/* An estimate of the distance that is so much more than the bound is not believed: it counts as so
 * much, and steps do not rely on it. Functions may have walls that their slope tells nothing of. */
#define BELIEVED 5.0

/* The part seen of a light's disc follows from the least ratio of distance to way (Quilez: Soft
 * shadows in raymarched SDFs, 2010): from 1 / k on, all of it. It is dark within the hard shadow,
 * so that nothing thin lets light through. Between two samples the ratio may be less than at both,
 * which showed as rings: where it seems to turn the ray looks again. Steps are by d, which may be
 * but a bound of the distance; `known` is what is known of the distance. False at the end. */
bool soft_step(inout ShadowRay s, float d, float known)
{
    vec2 now = vec2(1.0, known) / s.x, turn = turning_point(s.a, s.b, s.c, now);
    bool inside = s.x <= s.far;
    s.visibility = inside ? min(s.visibility, s.k * now.y) : s.visibility;
    bool dark = inside && (d < 0.05 * s.footprint || s.visibility < 0.01);
    bool back = !s.refined && s.k * turn.y < 0.99 * s.visibility && turn.x * s.far > 1.0;

    s.visibility = dark ? 0.0 : s.visibility;
    if (!s.refined) {
        /* Finer than the disc where it matters; things much smaller do not. */
        float disc = s.x / s.k, coarse = 0.3 + 30.0 * s.footprint / (s.x + 30.0 * s.footprint);
        float leap = known < BELIEVED * d ? coarse * disc : 0.0;
        s.ahead = max(d * clamp(0.25 * d / disc, 0.5, 1.0), max(0.5 * s.footprint, leap));
        s.a = s.b;
        s.b = s.c;
        s.c = now;
    }
    bool on = !dark && (s.at <= s.far || back);
    float next = s.at + s.ahead;
    next = s.at < s.far ? min(next, s.far) : next;
    s.x = back ? 1.0 / turn.x : next;
    s.at = back ? s.at : next;
    s.refined = back;
    return on;
}

/* Occlusion is the mean over u from 0 to 1 of how much less than t the field is at
 * t = reach * u * u along the normal, as a part of t (Evans: Fast approximations for global
 * illumination on dynamic scenes, SIGGRAPH 2006; his sum over places, as an integral). Each sample
 * stands for an equal part of u, at its mean t. Places nearer than `start` would be within the
 * surface's rounding. */
float occlusion_place(int i, float start)
{
    float n = float(max(frame.occlusion_samples, 1)), x = float(i);
    return max(start, frame.occlusion_reach * (x * (x + 1.0) + 1.0 / 3.0) / (n * n));
}

/* A straight way from a place. */
struct Sight {
    vec3 origin, direction; /* direction, of length 1 */
    float near, far;        /* what is not between does not count */
    float footprint;        /* so much is as good as nothing */
    float sharpness;        /* of a soft shadow */
    float lambert, lift;    /* cosine to the surface's normal, and the place's height over it */
};

/* Of a sight whose openness is asked for, along a normal. Where the field is but a bound of the
 * distance, it rises by less than the way from the surface: that is looked at first, next to the
 * surface, and what rises like that further on is as open as can be. */
#define SIGHT_OPEN (-1)

/* The part that is seen along it: of a light by the kind of its shadow, or of the environment.
 * What else a ray may meet has to be looked at here too, and in march(). */
float visible(Sight sight, int kind, int steps)
{
    ShadowRay s = shadow_ray_begin(sight.near, sight.far, sight.footprint, sight.sharpness,
                                   sight.lambert, sight.lift);
    float x = kind == SIGHT_OPEN ? occlusion_place(0, sight.near) : sight.near, dark = 0.0;
    float bound = 0.0;
    bool estimates = (frame.effects & EFFECT_ESTIMATES) != 0 && kind != SHADOW_HARD;
    bool risen = kind == SIGHT_OPEN && steps > 0 && (frame.effects & EFFECT_RISE) != 0;
    float rise = 1.0;

    x = risen ? 2.0 * sight.near : x;
    for (int i = zero - (risen ? 1 : 0); i < steps; i++) {
        vec3 p = sight.origin + sight.direction * x;
        /* From there on nothing gets darker. */
        float enough = kind == SIGHT_OPEN    ? x
                       : kind == SHADOW_HARD ? 0.0
                                             : s.visibility * x / s.k;
        float d = section_cut(field_bound(p, x, enough), p);
        if (field_waits(d)) {
            i--;
            continue;
        }
        /* What would darken is looked at again. */
        if (estimates && !field_estimates && d > 0.0 &&
            d < x * (kind == SIGHT_OPEN ? 1.0 : 1.0 / s.k)) {
            bound = d;
            field_estimates = true;
            i--;
            continue;
        }
        d = field_estimates ? clamp(d, bound, BELIEVED * bound) : d;
        bound = field_estimates ? bound : d;
        field_estimates = false;
        if (kind == SIGHT_OPEN) {
            rise = i < 0 ? clamp(d / x, 0.1, 1.0) : rise;
            dark += i < 0 ? 0.0 : clamp(1.0 - d / (rise * x), 0.0, 1.0);
            x = occlusion_place(i + 1, sight.near);
        } else {
            bool on = kind == SHADOW_HARD ? hard_step(s, d) : soft_step(s, bound, d);
            x = s.x;
            if (!on) {
                break;
            }
        }
    }
    float ambient_visibility =
        max(1.0 - frame.occlusion_strength * dark / float(max(steps, 1)), 0.0);
    return kind == SIGHT_OPEN    ? ambient_visibility
           : kind == SHADOW_HARD ? hard_end(s)
                                 : s.visibility;
}

/* In a loop of one round for occlusion and one for each light, so that map() stands in the program
 * once. The rays of soft shadows go on beyond the bounds, as far as these may still cover a part of
 * the disc. */
void trace_visibility(vec3 p, vec3 n, float footprint, bool hit)
{
    float near = 2.0 * footprint, lift = 1.5 * footprint, ambient_visibility = 1.0;

    field_mask = FAR;
    for (int round = zero - 1; round < frame.light_count; round++) {
        bool outward = round < 0;
        Light light = frame.lights[max(round, 0)];
        Incoming comes = incoming(light, p);
        int kind = (frame.effects & EFFECT_SHADOWS) != 0 ? light.shadow : SHADOW_NONE;
        float lambert = dot(n, comes.direction);
        vec3 direction = outward ? n : comes.direction, base = outward ? p : p + n * lift;
        float room = kind == SHADOW_SOFT ? bounds_span(base, direction).y / light.sharpness : 0.0;
        float leaves =
            box_span(frame.bounds_min - room, frame.bounds_max + room, base, direction).y;
        float far = min(min(comes.reach - light.radius, leaves), frame.max_distance);
        bool lit = lambert > 0.0 && any(greaterThan(comes.color, vec3(0.0)));
        bool traced = lit && kind != SHADOW_NONE && far > near;
        int steps = outward ? frame.occlusion_samples : traced ? frame.shadow_steps : 0;
        Sight sight = Sight(base, direction, near, far, footprint, light.sharpness, lambert, lift);

        float visibility = visible(sight, outward ? SIGHT_OPEN : kind, hit ? steps : 0);
        if (outward) {
            ambient_visibility = visibility;
            store_ambient_visibility(ambient_visibility);
        } else {
            visibility = kind == SHADOW_NONE ? 1.0
                         : lit               ? visibility * visibility * (3.0 - 2.0 * visibility)
                                             : 0.0;
            store_visibility(round, visibility, ambient_visibility);
        }
    }
}
