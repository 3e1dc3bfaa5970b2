/* SPDX-License-Identifier: MIT */
/* Cubes after an edit of numbers. A tape is right as long as the same operations matter in its
 * cube, so only what may matter elsewhere now is looked at again: from the root down, the children
 * of each cube whose tape holds an operation that has changed, or is another tape now. What is
 * below others stays as it is. Cubes become what they would be if they were made anew. */

struct renewal {
    struct lanes *c;
    const uint8_t *changed; /* of each operation */
    uint32_t edit;          /* its number */
    float mask;             /* of the space */
    uint16_t *drops;        /* what children left out before, while they are looked at again */
    size_t room;
};

/* What bound_at() and is_worth_splitting() ask of a cube. */
struct answers {
    bool bounds, ends, is_short, wide;
};

static struct answers answers_of(const struct cell *cell, uint32_t parent_count)
{
    return (struct answers){cell_is_far(cell) && parent_count > BOUND_TAPE,
                            cell->count <= BOUND_TAPE, cell->count <= CELL_SHORT,
                            cell->half > CELL_NEAR * fabsf(cell->distance)};
}

static bool answers_differ(struct answers a, struct answers b)
{
    return a.bounds != b.bounds || a.ends != b.ends || a.is_short != b.is_short || a.wide != b.wide;
}

/* Who takes the second operand alone does not ask the operation's numbers. */
static bool has_changed(const struct renewal *r, const struct cell *cell)
{
    const uint32_t *tape = cell_tape(r->c->cells, cell);
    bool any = false;

    for (uint32_t i = 0; i < cell->count && !any; i++) {
        any = !(tape[i] & (TAPE_MOVE | TAPE_NEGATE)) && r->changed[tape[i] & TAPE_INDEX];
    }
    return any;
}

/* A cube as it was: its tape, whether that is another one now, and whether bound_at() may come
 * there by another way. */
struct past {
    bool other, led;
    uint32_t tape, count;
};

/* The cube's tape of its parent's; false: it is the one that it had. `same`: as far as that goes
 * by its parent. */
static bool make_again(struct renewal *r, int32_t at, struct past past, bool same)
{
    struct cells *cells = r->c->cells;
    struct cell *cell = &cells->at[at];
    const struct cell *parent = &cells->at[cell->parent];
    const struct cell before = *cell;
    const size_t used = cells->used;

    if (same) {
        return false;
    }
    cell->tape = parent->tape;
    cell->words = parent->words;
    cell->count = parent->count;
    if (!cell->made) {
        return true;
    }
    make_tape(r->c, parent, (int)(at - parent->children), cell);
    if (cell->count == before.count && memcmp(cell_tape(cells, cell), cell_tape(cells, &before),
                                              cell->count * sizeof *cells->tapes) == 0) {
        cells->used = used;
        cell->tape = before.tape;
        cell->words = before.words;
        return false;
    }
    /* Not its parent's, nor one that is shared. */
    cells->wasted += before.words || before.tape == past.tape ? 0 : before.count;
    return true;
}

/* All below a cube in which bound_at() may take another way. */
static void tell_below(struct renewal *r, int32_t at)
{
    struct cells *cells = r->c->cells;
    const int32_t children = cells->at[at].children;

    cells->news[at].found = r->edit;
    for (int k = 0; children && k < 8; k++) {
        tell_below(r, children + k);
    }
}

static void renew_children(struct renewal *r, int32_t at, struct past past);

/* `before`: as it was. `same`: its parent's tape and what it leaves out of that are. */
static void renew_cell(struct renewal *r, int32_t at, const struct cell *before, struct past parent,
                       bool same)
{
    struct cells *cells = r->c->cells;
    struct cell *cell = &cells->at[at];
    const bool other = make_again(r, at, parent, same),
               run = cell->made && (other || has_changed(r, cell));
    const struct answers now = answers_of(cell, cells->at[cell->parent].count);
    const bool led = parent.led || answers_differ(now, answers_of(before, parent.count));

    if (run || !cell->made) { /* its tape is not made yet, but is another one */
        cells->news[at].run = r->edit;
    }
    if (led || (now.bounds && memcmp(&cell->distance, &before->distance, sizeof(float)) != 0)) {
        cells->news[at].found = r->edit;
    }
    if (cell->children && run) {
        renew_children(r, at, (struct past){other, led, before->tape, before->count});
    } else if (cell->children && led) {
        tell_below(r, at);
    }
}

/* New ones, of its thread alone. */
static void own_drops(struct cells *cells, struct cell *cell)
{
    cell->drops = drops_add(cells, cell->count);
    cell->trunk = NULL;
}

/* Bits of children that leave out other operands than before, as in `drops`. */
static uint16_t look_again(struct renewal *r, int32_t at)
{
    struct cells *cells = r->c->cells;
    struct cell *cell = &cells->at[at];
    const size_t bytes = cell->count * sizeof *r->drops;
    uint16_t changed = 0;

    if (cell->count > r->room) {
        r->room = 2 * cell->count;
        r->drops = memory_resize(r->drops, r->room, sizeof *r->drops);
    }
    memcpy(r->drops, cell_drops(cells, cell), bytes);
    if (cell->trunk) {
        own_drops(cells, cell);
    }
    uint16_t *drops = cell_drops(cells, cell);
    memset(drops, 0, bytes);
    cell->dropping = 0;
    look_at_children(r->c, at, r->mask);
    for (size_t i = 0; i < cell->count; i++) {
        changed |= r->drops[i] ^ drops[i];
    }
    return changed;
}

static void renew_children(struct renewal *r, int32_t at, struct past past)
{
    struct cells *cells = r->c->cells;
    struct cell *cell = &cells->at[at], before[8];

    memcpy(before, cells->at + cell->children, sizeof before);
    if (cell->count > past.count) {
        own_drops(cells, cell);
    }
    const uint16_t changed = look_again(r, at);
    for (int k = 0; k < 8; k++) {
        const bool same = !past.other && !(changed >> k & 0x101);
        renew_cell(r, cells->at[at].children + k, &before[k], past, same);
    }
}

/* Those of one thread and one space. Where most tapes are no longer used, all are made anew when a
 * ray comes. */
static void renew_cells(struct renewal *r)
{
    struct cells *cells = r->c->cells;

    if (cells->count == 0) {
        return;
    }
    if (cells->wasted > WASTED_LIMIT && 2 * cells->wasted > cells->used) {
        cells->count = 0;
        cells->times++;
        return;
    }
    cells->news[0].run = r->edit;
    if (cells->at[0].children) {
        renew_children(r, 0, (struct past){false, false, cells->at[0].tape, cells->at[0].count});
    }
    for (size_t i = 0; i < cells->count; i++) { /* what is shared was of other numbers */
        cells->at[i].trunk = cells->at[i].children ? cells->at[i].trunk : NULL;
    }
}

static void renew_spaces(struct engine_program *program, struct cells *spaces, const float *params,
                         const uint8_t *changed, uint32_t edit)
{
    static const float masks[ENGINE_SPACES] = {0.0f, FIELD_FAR, -FIELD_FAR};
    struct lanes *c = aligned_room(sizeof *c);
    struct renewal r = {.c = c, .changed = changed, .edit = edit};

    memset(c, 0, sizeof *c);
    c->program = program;
    c->params = params;
    c->frames = frames_create(program);
    c->machine = aligned_room(sizeof *c->machine);
    c->spaces = spaces;
    for (int i = 0; i < ENGINE_SPACES; i++) {
        c->cells = &spaces[i];
        r.mask = masks[i];
        renew_cells(&r);
    }
    free(r.drops);
    frames_destroy(program, c->frames);
    free(c->machine);
    free(c);
}
