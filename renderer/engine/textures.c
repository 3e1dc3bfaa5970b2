/* SPDX-License-Identifier: MIT */
/* Pictures of environments as shaders read them, and what a tile has of its pixels. */

typedef float texel4 __attribute__((vector_size(16)));
typedef uint32_t bits4 __attribute__((vector_size(16)));
typedef uint16_t halves4 __attribute__((vector_size(8), aligned(2)));

/* Of one level. It goes around, and ends at the poles. */
static texel4 texel(const uint16_t *texels, int width, int height, int x, int y)
{
    x = x >= 0 && x < width ? x : ((x % width) + width) % width;
    y = y < 0 ? 0 : y >= height ? height - 1 : y;
    const halves4 halves = *(const halves4 *)(texels + 4 * ((size_t)y * (size_t)width + (size_t)x));
    const bits4 bits = __builtin_convertvector(halves, bits4) << 13;
    return (texel4)bits * 0x1p112f; /* as half_value() does */
}

static texel4 mix4(texel4 a, texel4 b, float part)
{
    return a * (1 - part) + b * part;
}

static texel4 sample_level(const struct engine_sky *sky, int level, float u, float v)
{
    const uint16_t *texels = sky->texels[level];
    const int width = sky->width >> level > 1 ? sky->width >> level : 1;
    const int height = sky->height >> level > 1 ? sky->height >> level : 1;
    const float x = u * (float)width - 0.5f, y = v * (float)height - 0.5f;
    const int left = (int)floorf(x), top = (int)floorf(y);
    const float s = x - (float)left, t = y - (float)top;
    return mix4(mix4(texel(texels, width, height, left, top),
                     texel(texels, width, height, left + 1, top), s),
                mix4(texel(texels, width, height, left, top + 1),
                     texel(texels, width, height, left + 1, top + 1), s),
                t);
}

static const struct engine_sky *sky_of(const struct lanes *c, int unit)
{
    return c->skies[unit == UNIT_PANORAMA ? 0 : unit == UNIT_MIRRORED ? 1 : 2];
}

static void lanes_texture(struct lanes *c, int unit, vb m, vf u, vf v, vf level, vf out[4])
{
    const struct engine_sky *sky = sky_of(c, unit);
    /* What is no number is the first level. */
    const vf at = vf_min(vf_max(vf_zero, level), vf_all((float)(sky->levels - 1)));
    for (int k = 0; k < 4; k++) {
        out[k] = vf_zero;
    }
    for (int i = 0; i < LANES; i++) {
        if (!m[i]) {
            continue;
        }
        const int first = (int)at[i];
        const float part = at[i] - (float)first;
        texel4 color = sample_level(sky, first, u[i], v[i]);
        if (part > 0) {
            color = mix4(color, sample_level(sky, first + 1, u[i], v[i]), part);
        }
        for (int k = 0; k < 4; k++) {
            out[k][i] = color[k];
        }
    }
}

static int lanes_texture_size(struct lanes *c, int unit, int i)
{
    return i == 0 ? sky_of(c, unit)->width : sky_of(c, unit)->height;
}

static void lanes_texel(struct lanes *c, int unit, vb m, vi x, vi y, vi level, vf out[4])
{
    const float *from = unit == UNIT_GEOMETRY ? c->tile.geometry
                        : unit == UNIT_PIXELS ? c->tile.pixels
                                              : c->tile.counted;
    const int width = unit == UNIT_COUNTED ? 1 : 4;
    (void)level;
    for (int k = 0; k < 4; k++) {
        out[k] = k < width ? lanes_gather(from, (y * c->tile.side + x) * width + k, m) : vf_zero;
    }
}
