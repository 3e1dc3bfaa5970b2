/* SPDX-License-Identifier: MIT */
/* Explored cubes after an edit of numbers. They become those that would be explored of the new
 * numbers: from the root down, where a survey has found other children, or a tape is another one
 * now, children are looked at again; some come, some go. */

struct revision {
    struct renewal renewal; /* what has_changed() asks for */
    struct expedition *expedition;
    struct explored *explored;
    uint8_t *findings; /* of the survey */
    struct siblings siblings;
};

/* A cube as it was: the place of its tape, and whether another tape is its own now. `near`: of so
 * many generations from it on, gets_shorter() may answer something else. */
struct prior {
    uint32_t tape;
    bool other;
    int near;
};

enum { GENERATIONS = 2 };

static struct cell *explored_cell(const struct revision *r, int32_t at)
{
    return &r->explored->cells.at[at];
}

/* --- some go --- */

/* Those whose tapes are their own leave them. `tape`: that of the cube, as it was. */
static void leave_children(struct revision *r, int32_t at, uint32_t tape)
{
    struct cell *cell = explored_cell(r, at);

    for (int k = 0; cell->children && k < CUBE_CHILDREN; k++) {
        struct cell *child = explored_cell(r, cell->children + k);
        leave_children(r, cell->children + k, child->tape);
        if (child->tape != tape) {
            explored_free_tape(r->explored, child->tape, child->count);
        }
    }
    if (cell->children) {
        explored_free_children(r->explored, cell);
    }
}

/* --- some come --- */

/* The tape that was made last for a child, in a free place of its size, if there is one. */
static void put_tape(struct revision *r, struct cell *child, int number)
{
    struct explored *explored = r->explored;
    const uint32_t *words = r->siblings.tapes[number];
    const uint32_t count = r->siblings.counts[number];

    if (explored_take_place(explored, count, &child->tape)) {
        child->count = count;
        memcpy(explored->cells.tapes + child->tape, words, count * sizeof *words);
    } else {
        add_tape(&explored->cells, child, words, count);
    }
    explored_mark_words(explored, child->tape, count);
}

static void explore_below(struct revision *r, int32_t at)
{
    struct explored *explored = r->explored;
    struct lanes *c = r->renewal.c;

    const size_t used = explored->cells.used;

    explored->cells.drops_used = 0;
    cell_split(c, at, r->expedition->mask);
    explored_put_children(explored, explored_cell(r, at));
    make_siblings(c, explored_cell(r, at), 0xff, &r->siblings);
    const int32_t children = explored_cell(r, at)->children;
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        explored_cell(r, children + k)->made = true;
        if (r->siblings.own >> k & 1) {
            put_tape(r, explored_cell(r, children + k), k);
        }
        explored_mark_cube(explored, (size_t)(children + k));
    }
    count_new(r->expedition, explored->cells.used - used);
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        if (is_worth_exploring(r->expedition, &explored->cells, explored_cell(r, children + k))) {
            explore_below(r, children + k);
        }
    }
    explored_mark_cube(explored, (size_t)at);
}

/* --- some become others --- */

/* A child's tape, of what it leaves out of its parent's now; false: it is the one that it had. */
static bool follow_parent(struct revision *r, struct cell *parent, int number, struct prior past)
{
    struct explored *explored = r->explored;
    struct cell *child = explored_cell(r, parent->children + number);
    const bool shared = child->tape == past.tape, own = r->siblings.own >> number & 1;

    if (own && !shared && sibling_is_same(&r->siblings, &explored->cells, parent, number)) {
        return false;
    }
    if (!shared) {
        explored_free_tape(explored, child->tape, child->count);
    }
    if (own) {
        put_tape(r, child, number);
        return true;
    }
    child->tape = parent->tape;
    child->count = parent->count;
    return past.other || !shared;
}

static void explore_cell_again(struct revision *r, int32_t at, struct prior past);

static void explore_children_again(struct revision *r, int32_t at, struct prior past)
{
    struct cells *cells = &r->explored->cells;
    struct cell *cell = explored_cell(r, at), before[CUBE_CHILDREN];
    const int32_t children = cell->children;

    memcpy(before, cells->at + children, sizeof before);
    look_anew(r->renewal.c, at, r->expedition->mask);
    make_siblings(r->renewal.c, cell, 0xff, &r->siblings);
    struct prior priors[CUBE_CHILDREN];
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        priors[k].other = follow_parent(r, cell, k, past);
    }
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        const struct cell *child = explored_cell(r, children + k);
        priors[k].tape = before[k].tape;
        priors[k].near = child->count != before[k].count ? GENERATIONS : past.near - 1;
        if (child->tape != before[k].tape || child->count != before[k].count ||
            memcmp(&child->distance, &before[k].distance, sizeof child->distance) != 0) {
            explored_mark_cube(r->explored, (size_t)(children + k));
        }
    }
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        explore_cell_again(r, children + k, priors[k]);
    }
}

/* What is below a cube whose own tape and distance are known. */
static void explore_cell_again(struct revision *r, int32_t at, struct prior past)
{
    struct cell *cell = explored_cell(r, at);
    const int32_t children = cell->children;

    if (!is_worth_exploring(r->expedition, &r->explored->cells, cell)) {
        leave_children(r, at, past.tape);
        if (children) {
            explored_mark_cube(r->explored, (size_t)at);
        }
    } else if (!children) {
        explore_below(r, at);
    } else if (past.other || r->findings[at] == SURVEY_OTHER) {
        explore_children_again(r, at, past);
    } else if (past.near > 0 || r->findings[at] == SURVEY_SAME) {
        for (int k = 0; k < CUBE_CHILDREN; k++) {
            const uint32_t tape = explored_cell(r, children + k)->tape;
            explore_cell_again(r, children + k, (struct prior){tape, false, past.near - 1});
        }
    }
}

static void explore_again(const struct engine_program *program, const float *params,
                          const struct engine_extent *extent, float mask, const uint8_t *changed,
                          struct explored *explored)
{
    struct looker *looker = looker_create(program, params, extent->reach);
    struct lanes *c = &looker->lanes;
    struct expedition e = expedition_of(program, params, extent, mask);
    struct revision r = {
        .renewal = {.c = c, .changed = changed}, .expedition = &e, .explored = explored};

    c->cells = &explored->cells;
    r.findings = survey(&r.renewal, &e, &explored->cells);
    atomic_store(&e.cubes, explored->cells.count);
    atomic_store(&e.words, explored->cells.used - explored->free_words);
    explore_cell_again(&r, 0, (struct prior){.tape = explored->cells.at[0].tape});
    siblings_finish(&r.siblings);
    free(r.findings);
    explored->limited = atomic_load(&e.limited);
    looker_destroy(looker);
}
