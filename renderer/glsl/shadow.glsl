/* SPDX-License-Identifier: MIT */
/* What of each light, and of the environment's, comes to a place of a surface. Whoever includes
 * this says where answers go: OPEN(part of the environment's light), before all SEEN(light, vec4
 * part). Things that light goes through throw no shadow here: clear_pass.glsl colours their light.
 */

#define OCCLUSION_STRENGTH 0.9

/* Where lines through two places before and two behind meet: xy of each is (1 / way, distance / way),
 * in which anything straight is a line. Past an edge of the field the least ratio is right there,
 * past anything round close to it. Beyond all where they do not meet between. */
vec2 turning_point(vec2 a, vec2 b, vec2 c, vec2 d)
{
    float fall = (b.y - a.y) / (b.x - a.x), rise = (d.y - c.y) / (d.x - c.x);
    float bend = fall - rise;
    float x = b.x + (b.y - c.y + rise * (c.x - b.x)) / min(-bend, -1e-9);
    return vec2(x, bend > 0.0 && x < b.x && x > c.x ? b.y + fall * (x - b.x) : FAR);
}

/* Distance of occlusion sample i, 0 and up: dense near the surface. */
float occlusion_place(int i, float start)
{
    float x = float(i + 1) / float(max(effects.x, 1));
    return start + ground.w * x * x;
}

/* In a loop of one round for occlusion and one for each light, so that map() stands in the program
 * once.
 *
 * Occlusion: how much less than the distance from the surface the field is along the normal (Evans:
 * Fast approximations for global illumination on dynamic scenes, SIGGRAPH 2006).
 *
 * Shadow: sphere tracing to the light. A soft one follows from the least ratio of distance to way
 * (Quilez: Soft shadows in raymarched SDFs, 2010): of 1 / sharpness and more, all of the light's
 * disc is free. It is dark within the hard one, so that nothing thin lets light through. A ray that
 * runs out of steps is taken to go on as it went. */
void look(vec3 p, vec3 n, float print, bool hit)
{
    float near = 2.0 * print, lift = 1.5 * print, open = 1.0;

    through = FAR;
    for (int round = zero - 1; round < modes.x; round++) {
        bool outward = round < 0;
        Light light = lights[max(round, 0)];
        Incoming ray_in = incoming(light, p);
        int kind = (effects.z & EFFECT_SHADOWS) != 0 ? int(light.extent.z) : SHADOW_NONE;
        float lambert = dot(n, ray_in.direction), k = kind == SHADOW_SOFT ? light.color.w : FAR;
        vec3 along = outward ? n : ray_in.direction;
        vec3 base = outward ? p : p + n * lift;
        float far = min(min(ray_in.reach - light.extent.x, bounds_max.w), bounds_span(base, along).y);
        bool lit = lambert > 0.0 && any(greaterThan(ray_in.color, vec3(0.0)));
        int steps = outward ? effects.x : lit && kind != SHADOW_NONE && far > near ? modes.w : 0;
        float x = outward ? occlusion_place(0, near) : near;
        float dark = 0.0, weight = 1.0, weights = 0.0;
        float least = 1.0, stride = 0.0, at = x;
        /* As if the surface were flat where the ray begins. */
        vec2 seen0 = vec2(4.0, lambert * near + 4.0 * lift) / near;
        vec2 seen1 = vec2(3.0, lambert * near + 3.0 * lift) / near;
        vec2 seen2 = vec2(2.0, lambert * near + 2.0 * lift) / near;
        bool again = false;

        steps = hit ? steps : 0;
        for (int i = zero; i < steps; i++) {
            float d = map(base + along * x);
            dark += weight * clamp(1.0 - d / x, 0.0, 1.0);
            weights += weight;
            weight *= 0.75;

            vec2 seen = vec2(1.0, d) / x, turn = turning_point(seen0, seen1, seen2, seen);
            least = x > far ? least : min(least, k * seen.y);
            bool blocked = x <= far && (d < 0.05 * print || least < 0.01);
            least = blocked ? 0.0 : least;
            bool back = !again && !outward && k * turn.y < 0.99 * least && turn.x * far > 1.0;
            if (!outward && (blocked || (at > far && !back))) {
                break;
            }
            if (!again) {
                stride = max(d * clamp(0.25 * k * seen.y, 0.5, 1.0), 0.5 * print);
                seen0 = seen1;
                seen1 = seen2;
                seen2 = seen;
            }
            float next = at < far ? min(at + stride, far) : at + stride;
            next = outward ? occlusion_place(i + 1, near) : next;
            x = back ? 1.0 / turn.x : next;
            at = back ? at : x;
            again = back;
        }
        float shade = lit ? least * least * (3.0 - 2.0 * least) : 0.0;
        if (outward) {
            open = 1.0 - OCCLUSION_STRENGTH * dark / max(weights, 1.0);
            OPEN(open);
        } else {
            SEEN(round, vec4(vec3(shade), open));
        }
    }
}
