/* SPDX-License-Identifier: MIT */
/* Pictures of an environment, texel by texel. */

typedef void sky_texel(struct lanes *c, vb m, const vf *here, const vf *size, int level, vf *out);

static void plain_texel(struct lanes *c, vb m, const vf *here, const vf *size, int level, vf *out)
{
    (void)level;
    spmd_environment_sky(c, m, here, size, out);
}

static void matt_texel(struct lanes *c, vb m, const vf *here, const vf *size, int level, vf *out)
{
    (void)level;
    spmd_environment_matt(c, m, here, size, out);
}

static void make_level(struct lanes *c, struct engine_sky *sky, int level, sky_texel *texel)
{
    const int width = engine_sky_side(sky->width, level);
    const int height = engine_sky_side(sky->height, level);
    const vf size[2] = {(vf)vi_all(width), (vf)vi_all(height)};
    uint16_t *to = sky->texels[level];
    for (int first = 0; first < width * height; first += LANES) {
        const vi at = first + lanes_number;
        const vf here[2] = {(vf)(at % width), (vf)(at / width)};
        vf color[3];
        texel(c, at < width * height, here, size, level, color);
        for (int i = 0; i < LANES && first + i < width * height; i++, to += 4) {
            for (int k = 0; k < 4; k++) {
                to[k] = half_of(k < 3 ? color[k][i] : 1);
            }
        }
    }
}

static void make_sky(const struct frame_block *frame, struct engine_sky skies[ENGINE_SKIES],
                     int number, int level)
{
    static sky_texel *const texels[ENGINE_SKIES] = {plain_texel, spmd_environment_mirror,
                                                    matt_texel};
    static const struct dispatch_block no_dispatch;
    const struct engine_sky *const all[ENGINE_SKIES] = {&skies[0], &skies[1], &skies[2]};
    struct lanes c = {.frame = frame, .dispatch = &no_dispatch, .skies = all};
    make_level(&c, &skies[number], level, texels[number]);
}
