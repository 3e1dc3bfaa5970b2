/* SPDX-License-Identifier: MIT */
/* The environment: what a ray that hits nothing sees, and the light that comes from there. */

#include "frame.glsl"
#include "sky_maps.glsl"

/* From the ground's colour below through the horizon's to the zenith's. */
vec3 sky_gradient(vec3 direction)
{
    float y = direction.y;
    vec3 above = mix(frame.horizon, frame.zenith, 1.0 - pow(1.0 - clamp(y, 0.0, 1.0), 2.5));
    vec3 below = mix(frame.horizon, frame.ground, smoothstep(0.0, 0.25, -y));
    return y >= 0.0 ? above : below;
}

/* Around the first directional light: a glow that whitens the sky, and `disc` times the sun. */
vec3 sky_sun(vec3 direction, float disc)
{
    vec3 sum = vec3(0.0);
    for (int i = zero; i < frame.light_count; i++) {
        if (frame.lights[i].kind == LIGHT_DIRECTIONAL) {
            float c = max(dot(direction, frame.lights[i].position), 0.0);
            float glow = 0.06 * pow(c, 24.0) + 0.12 * pow(c, 350.0);
            sum = frame.lights[i].color * (glow + 4.0 * disc * smoothstep(0.99965, 0.99985, c));
            break;
        }
    }
    return sum;
}

/* Where there is no picture. */
vec3 sky_plain(vec3 direction, float disc)
{
    vec3 sun = (frame.effects & EFFECT_SUN) != 0 ? sky_sun(direction, disc) : vec3(0.0);
    return frame.sky_kind == SKY_GRADIENT ? sky_gradient(direction) + sun : frame.zenith;
}

/* From what is seen to what is in the picture, which may be turned. */
vec3 sky_rotated(vec3 d)
{
    vec2 turn = frame.sky_rotation;
    return vec3(turn.x * d.x - turn.y * d.z, d.y, turn.y * d.x + turn.x * d.z);
}

/* Without the sun's disc; `blur`: over about this angle, where there is a picture. */
vec3 sky_blurred(vec3 direction, float blur)
{
    if (frame.sky_kind != SKY_IMAGE) {
        return sky_plain(direction, 0.0);
    }
    return frame.sky_brightness * sample_environment_map(sky_rotated(direction), blur);
}

/* What a ray sees that hits nothing. */
vec3 sky(vec3 direction, float spread)
{
    return frame.sky_kind == SKY_IMAGE ? sky_blurred(direction, spread) : sky_plain(direction, 1.0);
}

/* Light that falls on a diffuse surface, over pi. */
vec3 sky_irradiance(vec3 n)
{
    return frame.ambient * frame.sky_brightness * sample_irradiance_map(sky_rotated(n));
}

/* Spread of a cone that something rough reflected: ray.glsl. */
float rough_spread(float spread, float roughness)
{
    float lobe = 2.0 * roughness * roughness;
    return (spread < 0.0 ? -1.0 : 1.0) * length(vec2(spread, lobe));
}

/* What a surface reflects that looks along `direction`, by a cone of `spread`. */
vec3 sky_specular(vec3 direction, float roughness, float spread)
{
    float level = clamp(roughness, 0.0, 1.0) * float(SPECULAR_LEVELS) - 1.0;
    float low = max(floor(level), 0.0), high = min(low + 1.0, float(SPECULAR_LEVELS - 1));
    vec3 rotated = sky_rotated(direction);
    vec3 sharp = sky_blurred(direction, rough_spread(spread, roughness));
    vec3 a = frame.sky_brightness * sample_specular_map(rotated, low);
    vec3 b = frame.sky_brightness * sample_specular_map(rotated, high);
    return frame.ambient * (level < 0.0 ? mix(sharp, a, level + 1.0) : mix(a, b, level - low));
}
