/* SPDX-License-Identifier: MIT */
/* The environment: what a ray that hits nothing sees, and the light that comes from there. */

/* From the ground's colour below through the horizon's to the zenith's. */
vec3 sky_gradient(vec3 direction)
{
    float y = direction.y;
    vec3 above = mix(horizon.rgb, zenith.rgb, 1.0 - pow(1.0 - clamp(y, 0.0, 1.0), 2.5));
    vec3 below = mix(horizon.rgb, ground.rgb, smoothstep(0.0, 0.25, -y));
    return y >= 0.0 ? above : below;
}

/* Around the first directional light: a disc with a soft rim, and a glow that whitens the sky. */
vec3 sky_sun(vec3 direction)
{
    vec3 sum = vec3(0.0);
    for (int i = zero; i < modes.x; i++) {
        if (int(lights[i].place.w) == LIGHT_DIRECTIONAL) {
            float c = max(dot(direction, lights[i].place.xyz), 0.0);
            float glow = 0.06 * pow(c, 24.0) + 0.12 * pow(c, 350.0);
            float disc = smoothstep(0.99965, 0.99985, c);
            sum = lights[i].color.rgb * (glow + 4.0 * disc);
            break;
        }
    }
    return sum;
}

vec3 sky(vec3 direction)
{
    return modes.y == SKY_GRADIENT ? sky_gradient(direction) + sky_sun(direction) : zenith.rgb;
}

/* Light from the half of the environment around n, without the sun. */
vec3 sky_ambient(vec3 n)
{
    vec3 top = mix(horizon.rgb, zenith.rgb, 0.5);
    vec3 bottom = mix(horizon.rgb, ground.rgb, 0.75);
    return horizon.w * (modes.y == SKY_GRADIENT ? mix(bottom, top, 0.5 + 0.5 * n.y) : zenith.rgb);
}
