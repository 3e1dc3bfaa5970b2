/* SPDX-License-Identifier: MIT */
/* Which explored cubes an edit of numbers has made others, asked by all threads at once: each one
 * is looked at as if its own tape stayed as it is. Of most it does, and their children too. */

enum { SURVEY_UNTOUCHED, SURVEY_SAME, SURVEY_OTHER };

struct survey {
    const struct renewal *renewal; /* for has_changed() */
    struct expedition *expedition;
    struct cells *cells;
    uint8_t *findings; /* of each cube: whether its tape holds what has changed, and what its
                          children are then */
    uint32_t *cubes;   /* those that are looked at, */
    size_t count, room;
};

static void survey_list(struct survey *s, int32_t at)
{
    const struct cell *cell = &s->cells->at[at];

    if (!cell->children || !has_changed(s->renewal, cell)) {
        return;
    }
    if (s->count == s->room) {
        s->room = 2 * s->room + 64;
        s->cubes = memory_resize(s->cubes, s->room, sizeof *s->cubes);
    }
    s->cubes[s->count++] = (uint32_t)at;
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        survey_list(s, cell->children + k);
    }
}

static bool sibling_is_same(const struct siblings *siblings, const struct cells *cells,
                            const struct cell *parent, int number)
{
    const struct cell *child = &cells->at[parent->children + number];
    const bool own = siblings->own >> number & 1, has_own = child->tape != parent->tape;

    return own == has_own && (!own || (child->count == siblings->counts[number] &&
                                       memcmp(cells->tapes + child->tape, siblings->tapes[number],
                                              child->count * sizeof *cells->tapes) == 0));
}

/* What the children leave out of a cube's tape, and their distances, are asked for anew. */
static void look_anew(struct lanes *c, int32_t at, float mask)
{
    struct cell *cell = &c->cells->at[at];

    c->cells->drops_used = 0;
    cell->drops = drops_add(c->cells, cell->count);
    cell->dropping = 0;
    look_at_children(c, at, mask, NULL);
}

/* Its children stay as they are. */
static bool survey_one(struct survey *s, struct lanes *c, struct siblings *siblings, int32_t at)
{
    struct cell *cell = &c->cells->at[at], *children = &c->cells->at[cell->children];
    bool same = true;
    float before[CUBE_CHILDREN];

    for (int k = 0; k < CUBE_CHILDREN; k++) {
        before[k] = children[k].distance;
    }
    look_anew(c, at, s->expedition->mask);
    make_siblings(c, cell, 0xff, siblings);
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        same = same && sibling_is_same(siblings, c->cells, cell, k) &&
               memcmp(&children[k].distance, &before[k], sizeof before[k]) == 0;
        children[k].distance = before[k];
    }
    return same;
}

/* Threads share all but what children leave out. */
static void survey_some(struct crew *crew)
{
    struct survey *s = crew->survey;
    const struct expedition *e = s->expedition;
    struct looker *looker = looker_create(e->program, e->params, e->extent->reach);
    struct lanes *c = &looker->lanes;
    struct cells view = *s->cells;
    struct siblings siblings = {0};
    size_t i;

    view.drops = NULL;
    view.drops_room = view.drops_used = 0;
    c->cells = &view;
    while ((i = (size_t)atomic_fetch_add(&crew->next, 1)) < s->count) {
        const uint32_t at = s->cubes[i];
        s->findings[at] = survey_one(s, c, &siblings, (int32_t)at) ? SURVEY_SAME : SURVEY_OTHER;
    }
    free(view.drops);
    siblings_finish(&siblings);
    looker_destroy(looker);
}

/* The caller frees the findings. */
static uint8_t *survey(const struct renewal *renewal, struct expedition *e, struct cells *cells)
{
    struct survey s = {.renewal = renewal, .expedition = e, .cells = cells};
    struct crew crew = {.task = survey_some, .survey = &s};

    s.findings = memory_alloc(cells->count, sizeof *s.findings);
    survey_list(&s, 0);
    find_threads(&crew, e->program);
    run_crew(&crew, smaller(crew.threads, (int)s.count));
    free(s.cubes);
    return s.findings;
}
