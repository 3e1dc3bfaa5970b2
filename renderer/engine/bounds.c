/* SPDX-License-Identifier: MIT */
/* Far from surfaces the distance in the middle of a cube bounds the field, so that no tape runs. */

/* If a cube is far from all surfaces, its children are. */
static bool cell_is_far(const struct cell *cell)
{
    return fabsf(cell->distance) > BOUND_NEAR * cell->half;
}

/* Whether a lower bound of the distance is worth having: its tape, which then is not made, would
 * not be much shorter than its parent's. */
static bool cell_bounds(const struct cells *cells, const struct cell *cell)
{
    return cell_is_far(cell) && cell->parent >= 0 && cells->at[cell->parent].count > BOUND_TAPE;
}

/* No point of the cube is nearer to a surface than the middle is, less its way there. */
static vf cell_bound(const struct cell *cell, const vf *p)
{
    vf square = vf_zero;

    for (int i = 0; i < 3; i++) {
        const vf way = p[i] - cell->centre[i];
        square += way * way;
    }
    const vf bound = fabsf(cell->distance) - vf_sqrt(square);
    return cell->distance < 0.0f ? -bound : bound;
}

/* Whether no cube in it is ever asked for a bound: where it is far, it gives one itself. */
static bool cell_ends(const struct cell *cell)
{
    return !cell->splits || cell->count <= BOUND_TAPE || cell_is_far(cell);
}

/* The largest cube that bounds the field at a lane's point, or else the largest around it in which
 * none does. Which one it is depends on the point alone, so pictures do not depend on cubes. */
static const struct cell *bound_at(struct lanes *c, const struct spots *s, int lane)
{
    struct cells *cells = c->cells;
    int32_t at = cell_around(cells, cells->bound_last, s, lane);

    while (at > 0 && cell_ends(&cells->at[cells->at[at].parent])) {
        at = cells->at[at].parent;
    }
    while (s->in[lane] && !cell_bounds(cells, &cells->at[at]) && !cell_ends(cell_ready(c, at))) {
        at = child_at(c, at, s, lane);
    }
    cells->bound_last = at;
    if (c->noted) {
        note(c, at)->found |= c->noted->squares;
    }
    return &cells->at[at];
}
