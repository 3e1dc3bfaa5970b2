/* SPDX-License-Identifier: MIT */
/* Which squares of the last picture are right after an edit (seen.h). */

/* A vector of points and the distances there; lanes of those around which a cube has changed. */
static vb read_value(struct lanes *c, const struct noted_value *value, uint32_t edit, vf *p, vf *d)
{
    const int32_t at = (int32_t)(value->cube & ((1 << NOTED_SPACE) - 1));
    vb changed = vb_zero;

    for (int lane = 0; lane < LANES; lane++) {
        const float *point = value->points[lane < value->count ? lane : 0];
        for (int i = 0; i < 3; i++) {
            p[i][lane] = point[i];
        }
        (*d)[lane] = point[3];
    }
    c->cells = &c->spaces[value->cube >> NOTED_SPACE & 3];
    const struct spots spots = spots_of(c->cells, p);
    for (int lane = 0; lane < value->count; lane++) {
        const int32_t least = smallest_around(c, at, &spots, lane);
        changed[lane] = c->cells->news[least].run > edit ? -1 : 0;
    }
    return changed;
}

/* Whether the field still is what it was at the points. */
static bool is_same_value(struct lanes *c, const struct noted_value *value, uint32_t edit)
{
    vf p[3], d;
    const vb m = read_value(c, value, edit, p, &d);
    bool same = true;

    if (lanes_any(m)) {
        c->field_mask_0 = vf_all(value->mask);
        const vf now = spmd_map(c, m, p);
        for (int lane = 0; lane < LANES; lane++) {
            const float here = now[lane], noted = d[lane];
            same = same && (!m[lane] || memcmp(&here, &noted, sizeof here) == 0);
        }
    }
    return same;
}

/* What a ray needs of cubes, and of values in them. */
static bool is_right_still(struct lanes *c, const struct seen_square *square)
{
    const char *const end = square->values + square->bytes_of_values;
    const struct noted_value *value;
    bool right = !square->stale && square->times == cubes_times(c->spaces);

    for (size_t i = 0; i < square->count && right; i++) {
        right = !seen_has_changed(c->spaces, square->used[i], square->edit);
    }
    for (const char *at = square->values; at < end && right; at += noted_value_bytes(value)) {
        value = (const void *)at;
        right = !seen_has_changed(c->spaces, value->cube | NOTED_RUN, square->edit) ||
                (is_same_value(c, value, square->edit) &&
                 square->times == cubes_times(c->spaces)); /* they may be too many */
    }
    return right;
}

/* Those that the hand's thread drew, by its cubes. */
static void verify_squares(struct hand *hand)
{
    const struct engine_canvas *canvas = hand->canvas;
    const uint32_t edit = canvas->cubes->edit;
    struct seen_square *square;
    size_t at = 0;

    hand->lanes.noted = NULL;
    while ((square = seen_next(canvas->seen, &at))) {
        if (square->thread == hand->number && square->edit != edit) {
            square->stale = !is_right_still(&hand->lanes, square);
            square->edit = edit;
        }
    }
}
