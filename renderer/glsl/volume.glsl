/* SPDX-License-Identifier: MIT */
/* Smoke, clouds and banks of fog: the light that they add along a ray, and the part that they let
 * through. Light is scattered once on its way from a lamp to the eye. */

#include "field_map.glsl"
#include "lights.glsl"
#include "noise.glsl"
#include "ray.glsl"
#include "section.glsl"
#include "sky.glsl"

/* Takes a part of a lamp's light from the surface at the ray's end: volume_sink.glsl. */
void dim_visibility(int light, float part);

/* What is at one place; all but the density is for each unit of it. */
struct Smoke {
    float density;
    vec3 color, emission;
    float anisotropy;
};

/* Where a ray is inside of a volume: entry and exit; exit < entry where it misses it. */
vec2 volume_span(Volume volume, vec3 origin, vec3 direction)
{
    vec3 local = origin - volume.center;
    if (volume.kind == VOLUME_BOX) {
        return box_span(-volume.extent, volume.extent, local, direction);
    }
    /* In lengths of the radii it is the unit ball. */
    vec3 place = local / volume.extent, scaled = direction / volume.extent;
    float part = 1.0 / dot(scaled, scaled), middle = -dot(place, scaled) * part;
    vec3 aside = place + middle * scaled;
    float half_way = (1.0 - dot(aside, aside)) * part;
    return half_way > 0.0 ? middle + vec2(-1.0, 1.0) * sqrt(half_way) : vec2(1.0, -1.0);
}

/* How far inside of it a place is, `local` to its centre. Of an ellipsoid: true at the rim (Quilez:
 * ellipsoid SDF, 2008) and in the middle, and between them something between. */
float volume_rim(Volume volume, vec3 local)
{
    if (volume.kind == VOLUME_BOX) {
        vec3 sides = volume.extent - abs(local);
        return min(sides.x, min(sides.y, sides.z));
    }
    vec3 radii = volume.extent, place = local / radii;
    float k = length(place), slope = length(place / radii);
    float smallest = min(radii.x, min(radii.y, radii.z));
    return (1.0 - k) * (slope > 0.0 ? mix(smallest, k / slope, min(k, 1.0)) : smallest);
}

/* Sum of octaves, each with twice the frequency and half of the height of the one before, and
 * turned against it, so that the noise's cubes are not seen. */
float waves_at(vec3 p, int octaves, uint seed)
{
    const mat3 turned = mat3(2.0, 2.0, -1.0, -1.0, 2.0, 2.0, 2.0, -1.0, 2.0) / 3.0;
    float height = 1.0, sum = 0.0;
    p = turned * p;
    for (int i = 0; i < octaves; i++) {
        sum += height * noise_value(p, seed + uint(i));
        height *= 0.5;
        p = 2.0 * turned * p + 0.37;
    }
    return sum;
}

/* Density at p, which is d from the scene. */
float volume_density(Volume volume, vec3 p, float d)
{
    vec3 local = p - volume.center;
    float rim = volume_rim(volume, local);
    float density = volume.density * smoothstep(0.0, max(volume.falloff, 1e-6), rim);
    int source = volume.source;
    int octaves = source == DENSITY_NOISE && rim > 0.0 ? volume.octaves : 0;
    float waves = waves_at(local * volume.frequency, octaves, uint(volume.seed));
    float part = source == DENSITY_NOISE   ? smoothstep(0.0, 0.6, waves - volume.threshold)
                 : source == DENSITY_FIELD ? exp(-max(d, 0.0) / volume.reach)
                                           : 1.0;
    return density * part;
}

/* Where volumes overlap, their densities add up. */
Smoke smoke_at(vec3 p, float d)
{
    Smoke sum = Smoke(0.0, vec3(0.0), vec3(0.0), 0.0);
    for (int i = zero; i < frame.volume_count; i++) {
        float density = volume_density(frame.volumes[i], p, d);
        sum.density += density;
        sum.color += density * frame.volumes[i].color;
        sum.emission += density * frame.volumes[i].emission;
        sum.anisotropy += density * frame.volumes[i].anisotropy;
    }
    float part = 1.0 / max(sum.density, 1e-20);
    return Smoke(sum.density, part * sum.color, part * sum.emission, part * sum.anisotropy);
}

/* What is known of the volumes along a ray after a way of `at`. */
struct Crossing {
    float next;  /* where it enters or leaves one next; INFINITY: nowhere */
    float last;  /* where it leaves the last one */
    float whole; /* way in all of them together, up to `far` */
    bool inside; /* of any at `at` */
};

Crossing crossing(vec3 origin, vec3 direction, float at, float far)
{
    Crossing c = Crossing(INFINITY, 0.0, 0.0, false);
    for (int i = zero; i < frame.volume_count; i++) {
        vec2 span = volume_span(frame.volumes[i], origin, direction);
        bool inside = span.x <= at && at < span.y;
        float edge = inside ? span.y : span.x;
        c.next = span.x < span.y && edge > at ? min(c.next, edge) : c.next;
        c.last = span.x < span.y ? max(c.last, span.y) : c.last;
        c.whole += max(min(span.y, far) - max(span.x, at), 0.0);
        c.inside = c.inside || inside;
    }
    return c;
}

/* Part of the light that is scattered to where its way is bent by an angle (Henyey and Greenstein:
 * Diffuse radiation in the galaxy, 1941). In the unit of lamps: a white diffuse surface that faces
 * one has its colour. */
float phase(float cosine, float g)
{
    return 0.25 * (1.0 - g * g) * pow(max(1.0 + g * g - 2.0 * g * cosine, 1e-6), -1.5);
}

/* The way from a place towards a lamp. */
struct Walk {
    float first, last; /* all smoke is between these */
    float end;         /* no farther on is anything that keeps the light off */
    float longest;     /* step in smoke */
    float sharpness;   /* of the scene's shadow; 0: none is looked for */
};

/* How sharp a lamp's shadows are in the air; 0: it casts none. */
float shadow_sharpness(Light light)
{
    int kind = (frame.effects & EFFECT_SHADOWS) != 0 ? light.shadow : SHADOW_NONE;
    return kind == SHADOW_NONE ? 0.0 : kind == SHADOW_HARD ? 100.0 : light.sharpness;
}

Walk walk_towards(Light light, Incoming lamp, vec3 p, bool on_surface)
{
    float sharpness = on_surface ? 0.0 : shadow_sharpness(light);
    Crossing smoke = crossing(p, lamp.direction, 0.0, 0.0);
    float last = min(smoke.last, lamp.reach), first = smoke.inside ? 0.0 : min(smoke.next, last);
    /* Just inside of the rim the density is that of the inside. */
    float sliver = 1e-4 * (last - first);
    float free = min(bounds_span(p, lamp.direction).y, frame.max_distance);

    Walk walk;
    walk.first = smoke.inside ? 0.0 : first + sliver;
    walk.last = last - sliver;
    walk.end = sharpness > 0.0 ? max(min(free, lamp.reach - light.radius), walk.last) : walk.last;
    int steps = on_surface ? 3 * frame.volume_light_steps - 2 : frame.volume_light_steps;
    walk.longest = (walk.last - walk.first) / float(max(steps, 1));
    walk.sharpness = sharpness;
    return walk;
}

/* The light of all lamps that is scattered at p into `view`, for a colour of 1, and what is there.
 * On a surface instead, dim_visibility() is told what comes through the smoke.
 *
 * Each lamp is a walk towards it, whose first step tells what is at p. In smoke its steps are
 * volume_light_steps parts of the way there, or as much less as the scene is near: three times as
 * many in all. On a surface, where there is but one walk, all of them serve the smoke. */
vec3 scattered(vec3 p, vec3 view, bool on_surface, out Smoke here)
{
    vec3 sum = vec3(0.0);
    here = Smoke(1.0, vec3(0.0), vec3(0.0), 0.0);
    for (int i = zero; i < max(frame.light_count, 1) && (on_surface || here.density > 0.0); i++) {
        Incoming lamp = incoming(frame.lights[i], p);
        Walk walk = walk_towards(frame.lights[i], lamp, p, on_surface);
        float end = i < frame.light_count ? walk.end : -1.0;
        float at = 0.0, smoky = 0.0, gone = 0.0, depth = 0.0, before = 0.0, visibility = 1.0;

        for (int k = zero; k <= 3 * frame.volume_light_steps; k++) {
            field_mask = k == 0 ? 0.0 : FAR;
            vec3 place = p + lamp.direction * at;
            float d = section_cut(map(place), place);
            Smoke smoke = smoke_at(place, d);
            if (k == 0) {
                here = smoke;
            } else {
                depth += 0.5 * smoky * (before + smoke.density);
                gone += smoky;
                visibility = walk.sharpness > 0.0 ? min(visibility, walk.sharpness * d / at) : 1.0;
            }
            if (at >= end || visibility < 0.004 || !(on_surface || here.density > 0.0)) {
                break;
            }
            bool in_smoke = at >= walk.first && at < walk.last;
            float room = in_smoke ? min(walk.longest, walk.last - at)
                                  : (at < walk.first ? walk.first : end) - at;
            float stride = walk.sharpness > 0.0 ? min(max(d, 0.1 * walk.longest), room) : room;
            smoky = in_smoke ? stride : 0.0;
            before = smoke.density;
            at += stride;
        }
        /* Out of steps, as close to a surface: as if all went on as it went. */
        float left = exp(-depth * (gone > 0.0 ? (walk.last - walk.first) / gone : 1.0));
        visibility = max(visibility, 0.0);
        if (on_surface && i < frame.light_count && shadow_sharpness(frame.lights[i]) > 0.0) {
            dim_visibility(i, left);
        }
        sum += i < frame.light_count
                   ? lamp.color * left * visibility * visibility * (3.0 - 2.0 * visibility) *
                         phase(dot(view, lamp.direction), here.anisotropy)
                   : vec3(0.0);
    }
    field_mask = 0.0;
    return sum;
}

/* The environment's light from everywhere. */
vec3 sky_mean()
{
    vec3 x = vec3(1.0, 0.0, 0.0);
    vec3 sum = sky_irradiance(x) + sky_irradiance(-x) + sky_irradiance(x.yxy) +
               sky_irradiance(-x.yxy) + sky_irradiance(x.yyx) + sky_irradiance(-x.yyx);
    return sum / 6.0;
}

/* Light added before distance t, and the part of the light from there that is let through. The ray
 * goes by slabs, none of them across the rim of a volume, the first `part` as long as the others;
 * each is taken to be everywhere as it is in its middle, and summed up in closed form (Hillaire:
 * Physically based and unified volumetric rendering in Frostbite, SIGGRAPH 2015 course). Then the
 * light on the surface at t is dimmed. */
vec4 inscattering(Ray ray, float t, float part)
{
    bool hit = t < INFINITY;
    float far = ray.inside ? 0.0 : min(t, frame.max_distance), left = 1.0;
    vec3 sum = vec3(0.0), around = sky_mean();
    Crossing first = crossing(ray.origin, ray.direction, 0.0, far);
    float stride = first.whole / float(max(frame.volume_steps, 1));
    float at = first.inside ? 0.0 : first.next, tick = at + part * stride;

    for (int i = zero; i <= frame.volume_steps + 3 * frame.volume_count && (at < far || hit); i++) {
        Crossing c = crossing(ray.origin, ray.direction, at, far);
        bool on_surface = at >= far, ticks = c.inside && tick < min(c.next, far);
        float end = ticks ? tick : min(c.next, far);
        float slab = c.inside && !on_surface ? end - at : 0.0;
        vec3 p = ray.origin + ray.direction * (on_surface ? t : at + 0.5 * slab);
        Smoke here;
        vec3 light = scattered(p, ray.direction, on_surface, here);

        float met = 1.0 - exp(-here.density * slab);
        sum += left * met * (here.color * (light + around) + here.emission);
        left *= 1.0 - met;
        tick = ticks ? tick + stride : c.inside ? tick : end + part * stride;
        at = end;
        if (on_surface || left < 0.002) {
            break;
        }
    }
    return vec4(sum, left);
}
