/* SPDX-License-Identifier: MIT */
/* What pixels are made of (seen.h): the cubes that a part of a picture uses, and what long tapes
 * gave there. */

/* A cube is listed where a part of the picture uses it for the first time. */
static struct cell *note(struct lanes *c, int32_t at)
{
    struct cell *cell = &c->cells->at[at];

    if (cell->part != c->noted->part) {
        cell->part = c->noted->part;
        cell->run = cell->found = 0;
        noted_add(c->noted, (uint32_t)(c->cells - c->spaces), (uint32_t)at);
    }
    return cell;
}

/* The smallest cube that there is around a point of a lane, from one on. */
static int32_t smallest_around(struct lanes *c, int32_t at, const struct spots *s, int lane)
{
    while (s->in[lane] && cell_has(&c->cells->at[at], s, lane) && c->cells->at[at].children) {
        at = child_at(c, at, s, lane);
    }
    return at;
}

/* The tape of each cube around a point gives the same there. So the smallest stands for a larger
 * one, which lanes share: it depends on less. */
static void note_run(struct lanes *c, const struct cell *run, vb m, const vf *p)
{
    const int32_t at = (int32_t)(run - c->cells->at);

    if (!run->children) {
        note(c, at)->run |= c->noted->squares;
        return;
    }
    const struct spots spots = spots_of(c->cells, p);
    for (int lane = 0; lane < LANES; lane++) {
        const int32_t least = m[lane] ? smallest_around(c, at, &spots, lane) : at;
        if (m[lane]) {
            cell_ready(c, least);
            note(c, least)->run |= c->noted->squares;
        }
    }
}

/* Values take memory, and so time: those of tapes of 12 to 24 operations take a tenth of a picture
 * of 1,000 shapes, and spare nothing after an edit. Of ten shapes such a tape is all there is. */
static bool is_long(const struct lanes *c, const struct cell *run)
{
    const size_t quarter = c->program->count / 4;

    return run->count >= (quarter < VALUE_LEAST  ? VALUE_LEAST
                          : quarter > VALUE_MOST ? VALUE_MOST
                                                 : quarter);
}

/* A long tape has operations that matter elsewhere in the cube alone. What it gave is noted
 * instead, and asked for again after an edit; estimates are not. */
static void note_value(struct lanes *c, const struct cell *run, vb m, const vf *p, vf d)
{
    struct noted *noted = c->noted;

    if (!is_long(c, run) || noted->value_bytes > NOTED_VALUES ||
        lanes_any(m & c->field_estimates_0)) {
        note_run(c, run, m, p);
        return;
    }
    struct noted_value *value = noted_value_add(noted, lanes_count(m));
    value->cube = noted_word((uint32_t)(c->cells - c->spaces), (uint32_t)(run - c->cells->at));
    value->squares = noted->squares;
    value->mask = c->frame->has_transmissive ? c->field_mask_0[lanes_first(m)] : 0.0f;
    float(*to)[4] = value->points;
    for (int i = 0; i < LANES; i++) {
        if (m[i]) {
            (*to)[0] = p[0][i];
            (*to)[1] = p[1][i];
            (*to)[2] = p[2][i];
            (*to++)[3] = d[i];
        }
    }
}
