/* SPDX-License-Identifier: MIT */
/* The environment: what a ray that hits nothing sees, and the light that comes from there.
 *
 * It lies in pictures by longitude and latitude: the middle looks along -Z, +X is right of it, the
 * first row is straight up. In those that environment.glsl makes, first and last row are the poles
 * themselves, so that nothing is pinched there. */

#include "frame.glsl"

/* What is around the scene; what mirrors show of it, mip level i for the roughness
 * (i + 1) / MIRROR_LEVELS; and its irradiance / pi. */
layout(binding = UNIT_PANORAMA) uniform sampler2D sky_picture;
layout(binding = UNIT_MIRRORED) uniform sampler2D sky_mirror;
layout(binding = UNIT_IRRADIANCE) uniform sampler2D sky_matt;

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
vec3 sky_turned(vec3 d)
{
    vec2 turn = frame.sky_turn;
    return vec3(turn.x * d.x - turn.y * d.z, d.y, turn.y * d.x + turn.x * d.z);
}

/* Longitude and latitude, 0 to 1. */
vec2 sky_place(vec3 d)
{
    float side = abs(d.x) + abs(d.z) > 0.0 ? atan(d.x, -d.z) : 0.0;
    return vec2(0.5 + side / (2.0 * PI), acos(clamp(d.y, -1.0, 1.0)) / PI);
}

/* One mip level of a picture with a row at each pole. Its size is not asked of the driver: llvmpipe
 * would answer all lanes for the level of the first. */
vec3 sky_made(sampler2D made, vec3 d, float level)
{
    vec2 place = sky_place(d);
    float rows = float(max(textureSize(made, 0).y >> int(level), 1));
    return textureLod(made, vec2(place.x, (place.y * (rows - 1.0) + 0.5) / rows), level).rgb;
}

/* Without the sun's disc; `blur`: over about this angle, where there is a picture. */
vec3 sky_blurred(vec3 direction, float blur)
{
    if (frame.sky_kind != SKY_IMAGE) {
        return sky_plain(direction, 0.0);
    }
    float texel = PI / float(textureSize(sky_picture, 0).y);
    vec2 place = sky_place(sky_turned(direction));
    float level = log2(max(abs(blur) / texel, 1.0));
    return frame.sky_brightness * textureLod(sky_picture, place, level).rgb;
}

/* What a ray sees that hits nothing. */
vec3 sky(vec3 direction, float spread)
{
    return frame.sky_kind == SKY_IMAGE ? sky_blurred(direction, spread) : sky_plain(direction, 1.0);
}

/* Light that falls on a matt surface, over pi. */
vec3 sky_irradiance(vec3 n)
{
    return frame.ambient * frame.sky_brightness * sky_made(sky_matt, sky_turned(n), 0.0);
}

/* Spread of a cone that something rough mirrored: ray.glsl. */
float rough_spread(float spread, float roughness)
{
    float lobe = 2.0 * roughness * roughness;
    return (spread < 0.0 ? -1.0 : 1.0) * length(vec2(spread, lobe));
}

/* What a surface mirrors that looks along `direction`, by a cone of `spread`. */
vec3 sky_mirrored(vec3 direction, float roughness, float spread)
{
    float level = clamp(roughness, 0.0, 1.0) * float(MIRROR_LEVELS) - 1.0;
    float low = max(floor(level), 0.0), high = min(low + 1.0, float(MIRROR_LEVELS - 1));
    vec3 turned = sky_turned(direction);
    vec3 sharp = sky_blurred(direction, rough_spread(spread, roughness));
    vec3 a = frame.sky_brightness * sky_made(sky_mirror, turned, low);
    vec3 b = frame.sky_brightness * sky_made(sky_mirror, turned, high);
    return frame.ambient * (level < 0.0 ? mix(sharp, a, level + 1.0) : mix(a, b, level - low));
}
