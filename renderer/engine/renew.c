/* SPDX-License-Identifier: MIT */
/* Cubes after an edit, of numbers or of more (matches.h). A tape is right as long as the same
 * operations matter in its cube, so only what may matter elsewhere now is looked at again: from the
 * root down, the children of each cube whose tape holds an operation that has changed, or is
 * another tape now. What is below others stays as it is. Cubes become what they would be if they
 * were made anew. */

enum { GROWN = 4 }; /* a tape that becomes so many times as long: new cubes cost less */

struct renewal {
    struct lanes *c;
    const uint8_t *changed;        /* of each operation */
    const struct matches *matches; /* NULL: tapes hold the indices that there are now */
    uint32_t edit;                 /* its number */
    float mask;                    /* of the space */
    uint16_t *drops; /* what children left out before, while they are looked at again */
    struct checkpoint *checkpoints; /* of then */
    size_t room, checkpoint_room;
    struct siblings siblings; /* tapes of the children of the cube that is renewed */
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
static bool word_has_changed(const struct renewal *r, uint32_t word)
{
    return !(word & (TAPE_MOVE | TAPE_NEGATE)) && r->changed[word & TAPE_INDEX];
}

/* How many words of a tape come before the first that has changed; `most`: look no further. */
static uint32_t count_before(const struct renewal *r, const struct cell *cell, uint32_t most)
{
    const uint32_t *tape = cell_tape(r->c->cells, cell);
    uint32_t i = 0;

    while (i < most && !word_has_changed(r, tape[i])) {
        i++;
    }
    return i;
}

/* How many come behind the last one. */
static uint32_t count_behind(const struct renewal *r, const struct cell *cell, uint32_t most)
{
    const uint32_t *end = cell_tape(r->c->cells, cell) + cell->count;
    uint32_t i = 0;

    while (i < most && !word_has_changed(r, end[-1 - (int64_t)i])) {
        i++;
    }
    return i;
}

static bool has_changed(const struct renewal *r, const struct cell *cell)
{
    return count_before(r, cell, cell->count) < cell->count;
}

/* A cube as it was: its tape, whether that is another one now, whether its words are written over,
 * and whether bound_at() may come there by another way. */
struct past {
    bool other, lost, led;
    uint32_t count;
    uint32_t first, last; /* words at either end that are those of the tape now */
};

/* Of two tapes. */
static void count_same(const uint32_t *before, uint32_t before_count, const uint32_t *now,
                       uint32_t count, struct past *out)
{
    const uint32_t most = before_count < count ? before_count : count;

    out->first = out->last = 0;
    while (out->first < most && before[out->first] == now[out->first]) {
        out->first++;
    }
    before += before_count;
    now += count;
    while (out->first + out->last < most &&
           before[-1 - (int64_t)out->last] == now[-1 - (int64_t)out->last]) {
        out->last++;
    }
}

/* The words of a cube's own tape: in the place that it had where they fit. */
static void set_tape(struct cells *cells, struct cell *cell, const struct cell *before,
                     const uint32_t *words, struct past *own)
{
    const size_t had = before->owns ? tape_words(before->count) : 0;
    const size_t takes = tape_words(cell->count);

    cell->words = NULL;
    cell->owns = true;
    if (takes <= had) {
        cell->tape = before->tape;
        cells->wasted += had - takes;
        own->lost = true;
    } else {
        tape_room(cells, takes);
        cell->tape = (uint32_t)cells->used;
        cells->used += takes;
        cells->wasted += had;
    }
    memcpy(cells->tapes + cell->tape, words, cell->count * sizeof *words);
}

/* The cube's tape of its parent's; false: it is the one that it had. `own->lost`: of its parent's
 * words, then of its own. */
static bool make_again(struct renewal *r, int32_t at, const struct cell *before, struct past *own)
{
    struct cells *cells = r->c->cells;
    struct cell *cell = &cells->at[at];
    const struct cell *parent = &cells->at[cell->parent];
    const int number = (int)(at - parent->children);
    const bool owns = r->siblings.own >> number & 1;
    const uint32_t *words = owns ? r->siblings.tapes[number] : cell_tape(cells, parent);
    const uint32_t count = owns ? r->siblings.counts[number] : parent->count;

    if (cell->made && !own->lost) {
        count_same(cell_tape(cells, before), before->count, words, count, own);
    }
    if (cell->made && own->first == count && count == before->count) {
        own->last = count;
        return false;
    }
    cell->count = count;
    if (cell->made && owns) {
        set_tape(cells, cell, before, words, own);
        return true;
    }
    cells->wasted += before->owns ? tape_words(before->count) : 0;
    cell->tape = parent->tape;
    cell->words = parent->words;
    cell->owns = false;
    return true;
}

/* How a child's tape is another one than before. `parent`: how its parent's is. `same`: that is
 * not, and the child leaves out of it what it did. */
static struct past renew_tape(struct renewal *r, int32_t at, const struct cell *before,
                              struct past parent, bool same)
{
    struct past own = {.lost = parent.lost && !before->owns && !before->words,
                       .count = before->count};

    if (same) {
        own.first = own.last = before->count;
    } else {
        own.other = make_again(r, at, before, &own);
    }
    return own;
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

/* All below a cube that will have new children. These are renewed no more: to squares that used
 * them they have changed, whatever the edit. */
static void forget_below(struct cells *cells, int32_t at)
{
    const int32_t children = cells->at[at].children;

    for (int k = 0; children && k < 8; k++) {
        cells->news[children + k] = (struct cell_news){UINT32_MAX, UINT32_MAX};
        forget_below(cells, children + k);
    }
}

static void renew_children(struct renewal *r, int32_t at, struct past past);

/* `before`: as it was. */
static void renew_cell(struct renewal *r, int32_t at, const struct cell *before, struct past parent,
                       struct past own)
{
    struct cells *cells = r->c->cells;
    struct cell *cell = &cells->at[at];
    const bool run = cell->made && (own.other || has_changed(r, cell));
    const struct answers now = answers_of(cell, cells->at[cell->parent].count);

    own.led = parent.led || answers_differ(now, answers_of(before, parent.count));

    if (run || !cell->made) { /* its tape is not made yet, but is another one */
        cells->news[at].run = r->edit;
    }
    if (own.led || (now.bounds && memcmp(&cell->distance, &before->distance, sizeof(float)) != 0)) {
        cells->news[at].found = r->edit;
    }
    if (cell->children && run && cell->count > GROWN * before->count) {
        forget_below(cells, at);
        cell->children = 0;
    }
    if (!cell->children && run) {
        cell->trunk = NULL; /* what is shared was of other numbers */
    } else if (cell->children && run) {
        renew_children(r, at, own);
    } else if (cell->children && own.led) {
        tell_below(r, at);
    }
}

/* New ones, of its thread alone. */
static void own_drops(struct cells *cells, struct cell *cell)
{
    cell->drops = drops_add(cells, cell->count);
    cell->trunk = NULL;
}

/* What is known of the tape that a cube had, taken aside: its drops will be written over. */
static struct tape_past take_past(struct renewal *r, const struct cell *cell, struct past past)
{
    const uint16_t *drops = cell_drops(r->c->cells, cell);
    const size_t most = checkpoints_in(past.count);
    size_t count = 0;

    if (past.count > r->room) {
        r->room = 2 * past.count;
        r->drops = memory_resize(r->drops, r->room, sizeof *r->drops);
    }
    if (most > r->checkpoint_room) {
        r->checkpoint_room = 2 * most;
        r->checkpoints = memory_resize(r->checkpoints, r->checkpoint_room, sizeof *r->checkpoints);
    }
    memcpy(r->drops, drops, past.count * sizeof *drops);
    if (most > 0) {
        memcpy(r->checkpoints, drops + tape_words(past.count), most * sizeof *r->checkpoints);
    }
    while (count < most && r->checkpoints[count].at > 0) {
        count++;
    }
    return (struct tape_past){.count = past.count,
                              .first = count_before(r, cell, past.first),
                              .last = count_behind(r, cell, past.last),
                              .drops = r->drops,
                              .checkpoints = r->checkpoints,
                              .checkpoint_count = count};
}

/* Of what is left out; with `others`, of where these differ. */
static uint16_t union_of(const uint16_t *drops, const uint16_t *others, size_t count)
{
    const size_t at_once = sizeof(uint64_t) / sizeof(uint16_t);
    uint64_t all = 0;
    size_t i = 0;

    for (; i + at_once <= count; i += at_once) {
        uint64_t a, b = 0;
        memcpy(&a, drops + i, sizeof a);
        if (others) {
            memcpy(&b, others + i, sizeof b);
        }
        all |= a ^ b;
    }
    for (; i < count; i++) {
        all |= others ? drops[i] ^ others[i] : drops[i];
    }
    return (uint16_t)(all | all >> 16 | all >> 32 | all >> 48);
}

/* Bits of children that take the second operand of an operation that has changed: it may be negated
 * now, or no more. */
static uint16_t unlike(const struct renewal *r, const struct cell *cell,
                       const struct tape_past *past)
{
    const uint32_t *tape = cell_tape(r->c->cells, cell);
    const uint16_t *drops = cell_drops(r->c->cells, cell);
    uint16_t bits = 0;

    for (uint32_t i = past->first; i + past->last < cell->count; i++) {
        bits |= word_has_changed(r, tape[i]) ? drops[i] & 0xff : 0;
    }
    return bits;
}

/* Bits of children that leave out other operands than before, as in `drops`, where the tape is the
 * same. */
static uint16_t look_again(struct renewal *r, int32_t at, struct past past)
{
    struct cells *cells = r->c->cells;
    struct cell *cell = &cells->at[at];
    const struct tape_past known = take_past(r, cell, past);
    const bool outgrown = tape_words(cell->count) > tape_words(past.count);

    if (cell->trunk || outgrown) {
        cells->wasted += cell->trunk ? 0 : drops_words(past.count) / 2; /* a word for two */
        own_drops(cells, cell);
    }
    memset(cell_drops(cells, cell), 0, drops_words(cell->count) * sizeof *r->drops);
    look_at_children(r->c, at, r->mask, &known);
    const uint16_t *drops = cell_drops(cells, cell);
    cell->dropping = union_of(drops, NULL, cell->count);
    return past.other ? 0 : union_of(drops, known.drops, cell->count) | unlike(r, cell, &known);
}

static void renew_children(struct renewal *r, int32_t at, struct past past)
{
    struct cells *cells = r->c->cells;
    struct cell before[CUBE_CHILDREN];
    struct past own[CUBE_CHILDREN];
    unsigned wanted = 0;

    memcpy(before, cells->at + cells->at[at].children, sizeof before);
    const uint16_t changed = look_again(r, at, past);
    const unsigned others = past.other ? 0xff : (changed | changed >> 8) & 0xff;
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        wanted |= before[k].made ? others & 1u << k : 0;
    }
    make_siblings(r->c, &cells->at[at], wanted, &r->siblings);
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        own[k] = renew_tape(r, cells->at[at].children + k, &before[k], past, !(others >> k & 1));
    }
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        renew_cell(r, cells->at[at].children + k, &before[k], past, own[k]);
    }
}

/* Room of tapes and drops with those alone that cubes have. */
static void compact(struct cells *cells)
{
    const struct cells old = *cells;
    uint32_t *before = memory_alloc(cells->count, sizeof *before);

    cells->tapes = NULL;
    cells->drops = NULL;
    cells->used = cells->room = cells->wasted = cells->drops_used = cells->drops_room = 0;
    for (size_t i = 0; i < cells->count; i++) { /* parents first */
        struct cell *cell = &cells->at[i];
        const struct cell *parent = cell->parent < 0 ? NULL : &cells->at[cell->parent];
        before[i] = cell->tape;
        if (parent && cell->tape == before[cell->parent] && cell->words == parent->words) {
            cell->tape = parent->tape;
        } else if (!cell->words) {
            tape_room(cells, tape_words(cell->count));
            memcpy(cells->tapes + cells->used, old.tapes + cell->tape,
                   cell->count * sizeof *cells->tapes);
            cell->tape = (uint32_t)cells->used;
            cell->owns = true;
            cells->used += tape_words(cell->count);
        }
        if (cell->children && !cell->trunk) {
            const uint32_t drops = cell->drops;
            cell->drops = drops_add(cells, cell->count);
            memcpy(cells->drops + cell->drops, old.drops + drops,
                   drops_words(cell->count) * sizeof *cells->drops);
        }
    }
    free(before);
    free(old.tapes);
    free(old.drops);
}

/* The root of another program has the tape of all operations of it. Answers what it was. */
static struct past renew_root(struct renewal *r)
{
    struct cells *cells = r->c->cells;
    struct cell *root = &cells->at[0];
    const uint32_t count = (uint32_t)r->c->program->count;
    const size_t used = cells->used;
    struct past past = {.count = root->count};
    const uint32_t tape = add_whole_tape(cells, count);

    count_same(cell_tape(cells, root), root->count, cells->tapes + tape, count, &past);
    past.other = past.first < count || count != root->count;
    if (past.other) {
        root->tape = tape;
        root->count = count;
        root->splits = count > CELL_SHORT;
        cells->wasted += past.count;
    } else {
        past.last = count;
        cells->used = used;
    }
    return past;
}

/* Those of one thread and one space. */
static void renew_cells(struct renewal *r)
{
    struct cells *cells = r->c->cells;

    if (cells->count == 0) {
        return;
    }
    if (cells->wasted > WASTED_LIMIT && 2 * cells->wasted > cells->used) {
        compact(cells);
    }
    if (r->matches && matches_move(r->matches)) { /* tapes with one that is gone are made again */
        matches_rename(r->matches, cells->tapes, cells->used);
    }
    cells->news[0].run = r->edit;
    const struct past past = renew_root(r);
    if (cells->at[0].children) {
        renew_children(r, 0, past);
    } else {
        cells->at[0].trunk = NULL;
    }
}

/* Those of one thread. `r` has what has changed. */
static void renew_spaces(struct renewal r, struct engine_program *program, struct cells *spaces,
                         const float *params)
{
    static const float masks[ENGINE_SPACES] = {0.0f, FIELD_FAR, -FIELD_FAR};
    struct lanes *c = aligned_room(sizeof *c);

    r.c = c;
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
    free(r.checkpoints);
    siblings_finish(&r.siblings);
    frames_destroy(program, c->frames);
    free(c->machine);
    free(c);
}
