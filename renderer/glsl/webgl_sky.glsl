/* SPDX-License-Identifier: MIT */
/* The maps of an environment without a picture, where there are no textures: columns, because each
 * part of it is the same all around an axis. `sky_column` from straight up to straight down,
 * `sun_column` from SUN to its opposite: SPECULAR_ROWS for the first roughness, half as many for
 * each further one, then IRRADIANCE_ROWS. */

#include "constants.glsl"

/* `cosine`: of the angle to the axis. */
#define COLUMN(column, first, count, cosine)                                                       \
    float at = acos(clamp(cosine, -1.0, 1.0)) / PI * float(count - 1);                             \
    int i = min(int(at), count - 2);                                                               \
    return mix(column[first + i], column[first + i + 1], at - float(i));

vec3 sky_part(int first, int count, float cosine)
{
    COLUMN(sky_column, first, count, cosine)
}

#ifdef SUN
vec3 sun_part(int first, int count, float cosine)
{
    COLUMN(sun_column, first, count, cosine)
}
#else
#define SUN vec3(0.0)
#define SUN_COLOR vec3(0.0)
#define sun_part(first, count, cosine) vec3(0.0)
#endif

vec3 sky_map(vec3 d, int first, int count)
{
    return sky_part(first, count, d.y) + SUN_COLOR * sun_part(first, count, dot(d, SUN));
}

vec3 sample_specular_map(vec3 d, float level)
{
    int count = SPECULAR_ROWS >> int(level);
    return sky_map(d, 2 * (SPECULAR_ROWS - count), count);
}

vec3 sample_irradiance_map(vec3 n)
{
    return sky_map(n, 2 * SPECULAR_ROWS - (SPECULAR_ROWS >> (SPECULAR_LEVELS - 1)),
                   IRRADIANCE_ROWS);
}
