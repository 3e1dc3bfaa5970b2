/* SPDX-License-Identifier: MIT */
/* Pictures of environments as shaders read them, and what a tile has of its pixels. */

static vi within(vi x, int n)
{
    x = vi_select(x < 0, vi_zero, x);
    return vi_select(x >= n, vi_all(n - 1), x);
}

/* The remainder, 0 <= x < n. */
static vi around(vi x, int n)
{
    if (!lanes_any((x < 0) | (x >= n))) {
        return x;
    }
    x -= vi_of_f(vf_floor(vf_of_i(x) / (float)n)) * n;
    x = vi_select(x < 0, x + n, x);
    x = vi_select(x >= n, x - n, x);
    return within(x, n); /* of what is no number, too */
}

/* Texels of one level, of four halves each. It goes around, and ends at the poles. */
static void texels(const uint16_t *from, int width, int height, vb m, vi x, vi y, vf out[4])
{
    const vi at = 2 * (within(y, height) * width + around(x, width));

    for (int k = 0; k < 4; k += 2) {
        const vu two = (vu)lanes_gather(from + k, at, m);
        out[k] = (vf)((two & 0xffffu) << 13) * 0x1p112f; /* as half_value() does */
        out[k + 1] = (vf)((two >> 16) << 13) * 0x1p112f;
    }
}

static vf mix(vf a, vf b, vf part)
{
    return a * (1 - part) + b * part;
}

static void sample_level(const struct engine_map *map, int level, vb m, vf u, vf v, vf out[4])
{
    const uint16_t *from = map->texels[level];
    const int width = engine_map_side(map->width, level);
    const int height = engine_map_side(map->height, level);
    const vf x = u * (float)width - 0.5f, y = v * (float)height - 0.5f;
    const vf left = vf_floor(x), top = vf_floor(y), s = x - left, t = y - top;
    const vi column = vi_of_f(left), row = vi_of_f(top);
    vf above[2][4], below[2][4];

    for (int i = 0; i < 2; i++) {
        texels(from, width, height, m, column + i, row, above[i]);
        texels(from, width, height, m, column + i, row + 1, below[i]);
    }
    for (int k = 0; k < 4; k++) {
        out[k] = mix(mix(above[0][k], above[1][k], s), mix(below[0][k], below[1][k], s), t);
    }
}

static const struct engine_map *sky_of(const struct lanes *c, int unit)
{
    return c->maps[unit == UNIT_ENVIRONMENT_MAP ? 0 : unit == UNIT_SPECULAR_MAP ? 1 : 2];
}

static void lanes_texture(struct lanes *c, int unit, vb m, vf u, vf v, vf level, vf out[4])
{
    const struct engine_map *map = sky_of(c, unit);

    /* What is no number is the first level. */
    const vf at = vf_min(vf_max(vf_zero, level), vf_all((float)(map->levels - 1)));
    const vi first = vi_of_f(at);
    const vf part = at - vf_of_i(first);
    for (int k = 0; k < 4; k++) {
        out[k] = vf_zero;
    }
    while (lanes_any(m)) {
        const int level = first[lanes_first(m)];
        const vb same = m & (first == level), between = same & (part > 0);
        vf here[4], next[4];
        sample_level(map, level, same, u, v, here);
        if (lanes_any(between)) {
            sample_level(map, level + 1, between, u, v, next);
            for (int k = 0; k < 4; k++) {
                here[k] = vf_select(between, mix(here[k], next[k], part), here[k]);
            }
        }
        for (int k = 0; k < 4; k++) {
            out[k] = vf_select(same, here[k], out[k]);
        }
        m &= ~same;
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
    const int width = unit == UNIT_COUNTED ? 2 : 4;
    (void)level;

    for (int k = 0; k < 4; k++) {
        out[k] = k < width ? lanes_gather(from, (y * c->tile.side + x) * width + k, m) : vf_zero;
    }
}
