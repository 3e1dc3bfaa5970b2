/* SPDX-License-Identifier: MIT */
/* Pictures of an environment, texel by texel. */

typedef void map_texel(struct lanes *c, vb m, const vf *here, const vf *size, int level, vf *out);

static void plain_texel(struct lanes *c, vb m, const vf *here, const vf *size, int level, vf *out)
{
    (void)level;
    spmd_environment_sky(c, m, here, size, out);
}

static void irradiance_texel(struct lanes *c, vb m, const vf *here, const vf *size, int level,
                             vf *out)
{
    (void)level;
    spmd_environment_irradiance(c, m, here, size, out);
}

static void make_level(struct lanes *c, struct engine_map *map, int level, map_texel *texel)
{
    const int width = engine_map_side(map->width, level);
    const int height = engine_map_side(map->height, level);
    const vf size[2] = {(vf)vi_all(width), (vf)vi_all(height)};
    const int columns = map->column ? 1 : width, count = columns * height;
    uint16_t *to = map->texels[level];

    for (int first = 0; first < count; first += LANES) {
        const vi at = first + lanes_number;
        const vf here[2] = {(vf)(at % columns), (vf)(at / columns)};
        vf color[3];
        texel(c, at < count, here, size, level, color);
        for (int i = 0; i < LANES && first + i < count; i++, to += 4 * (width / columns)) {
            for (int k = 0; k < 4; k++) {
                to[k] = half_of(k < 3 ? color[k][i] : 1);
            }
        }
    }
}

static void make_map(const struct frame_uniforms *frame, struct engine_map maps[ENGINE_MAPS],
                     int number, int level)
{
    static map_texel *const texels[ENGINE_MAPS] = {plain_texel, spmd_environment_prefilter,
                                                   irradiance_texel};
    static const struct dispatch_block no_dispatch;
    const struct engine_map *const all[ENGINE_MAPS] = {&maps[0], &maps[1], &maps[2]};
    struct lanes c = {.frame = frame, .dispatch = &no_dispatch, .maps = all};

    make_level(&c, &maps[number], level, texels[number]);
}
