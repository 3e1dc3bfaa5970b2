/* SPDX-License-Identifier: MIT */
/* Space in cubes, each with a tape: the operations that matter within it. A cube's tape is made of
 * its parent's when a ray comes there; all eight of a parent at once, a lane for each. What a tape
 * leaves out changes no bit of the field in the cube, so cubes may be any, and each thread has its
 * own. Cubes are those of a grid, by whose whole numbers they are found. */

#define LOOSE 1.1f             /* of its half: the points of a vector need not be in one cube */
#define CELL_PIXELS 8          /* half of the smallest, in footprints; */
#define CELL_PIXELS_LONG 2     /* with a tape of more than BOUND_TAPE */
#define CELL_NEAR 0.15f        /* half of the smallest, as a part of the distance to a surface */
#define CELL_SHORT 3           /* such a tape is not made shorter */
#define CELL_RUN 4             /* operations that take as long as it does to begin a tape */
#define WORN_RUN 256           /* a cube that has run so many operations has smaller ones, */
#define WORN_TAPE 24           /* if its tape is as long as this */
#define CELL_LIMIT (1 << 20)   /* with more cubes, */
#define TAPES_LIMIT (1 << 26)  /* or words of tapes and drops, of all threads, all are made anew */
#define TAPE_STEPS 128         /* the least tape that has room to grow is twice as long */
#define WASTED_LIMIT (1 << 21) /* words of tapes that are not used, which are let be */
#define BOUND_NEAR 2           /* a cube is far from surfaces that are so many of its halves away */
#define VALUE_LEAST 12         /* of so many operations, what a tape gives is noted; */
#define VALUE_MOST 24          /* of so many in a field of four times as many */
/* Of the root's side: as many as a float has. Place 0, 0, 0 is a third of the way along each axis
 * of the grid, and so a third or two thirds of the way through each cube around it. In the middle
 * of the grid, a scene would lie in eight cubes of every size. */
#define GRID_BITS TAPE_GRID_BITS
#define GRID_ORIGIN TAPE_ORIGIN

static struct cell *cell_add(struct cells *cells)
{
    if (cells->count == cells->capacity) {
        cells->capacity = cells->capacity ? 2 * cells->capacity : 1024;
        cells->at = memory_resize(cells->at, cells->capacity, sizeof *cells->at);
        cells->news = memory_resize(cells->news, cells->capacity, sizeof *cells->news);
    }
    cells->news[cells->count] = (struct cell_news){0, 0};
    return &cells->at[cells->count++];
}

/* What a tape of so many words takes. Long ones have room to grow after an edit. */
static size_t tape_words(size_t count)
{
    size_t step = 1;

    while (count > 2 * TAPE_STEPS * step) {
        step *= 2;
    }
    return (count + step - 1) / step * step;
}

/* For that many words. */
static void tape_room(struct cells *cells, size_t count)
{
    if (cells->room - cells->used < count) {
        cells->room += cells->room / 2 + count;
        cells->tapes = memory_resize(cells->tapes, cells->room, sizeof *cells->tapes);
    }
}

/* The tape of all operations, which the root has. */
static uint32_t add_whole_tape(struct cells *cells, size_t count)
{
    const size_t at = cells->used;

    tape_room(cells, count);
    for (size_t i = 0; i < count; i++) {
        cells->tapes[cells->used++] = (uint32_t)i;
    }
    return (uint32_t)at;
}

/* That a tape of so many words may have. With narrow vectors children are looked at by parts: there
 * are none. */
static size_t checkpoints_in(size_t count)
{
    const size_t words = tape_words(count);

    return words < CHECKPOINT_TAPE || LANES < CUBE_CHILDREN ? 0 : words / CHECKPOINT_WORDS;
}

/* What it takes among the drops. */
static size_t drops_words(size_t count)
{
    return tape_words(count) +
           checkpoints_in(count) * (sizeof(struct checkpoint) / sizeof(uint16_t));
}

/* The index of those of a tape of so many words, all 0. */
static uint32_t drops_add(struct cells *cells, size_t count)
{
    const size_t at = cells->drops_used, words = drops_words(count);

    if (cells->drops_room - at < words) {
        cells->drops_room = 2 * (cells->drops_room + words);
        cells->drops = memory_resize(cells->drops, cells->drops_room, sizeof *cells->drops);
    }
    memset(cells->drops + at, 0, words * sizeof *cells->drops);
    cells->drops_used += words;
    return (uint32_t)at;
}

/* All that rays reach: their last step may lead as far again as they go. A power of two, so that
 * the cubes' middles are exact. */
static float root_half(const struct frame_uniforms *frame)
{
    float reach = frame->max_distance;
    int exponent;

    for (int i = 0; i < 3; i++) {
        reach = f_max(reach, 2.0f * fabsf(frame->camera.eye[i]));
    }
    frexpf(4.0f * reach, &exponent);
    return ldexpf(1.0f, exponent);
}

static struct trunk_cube *trunk_of(const struct lanes *c, float half)
{
    struct trunk *trunk = c->cells->trunk;

    return trunk ? trunk_root(trunk, (int)(c->cells - c->spaces), half) : NULL;
}

/* For a picture. Those of another one stay while the root is as large. */
static void cells_begin(struct lanes *c)
{
    struct cells *cells = c->cells;
    const float half = root_half(c->frame);

    cells->last = cells->bound_last = 0;
    if (cells->count && cells->at[0].half == half) {
        cells->at[0].picture = c->picture;
        return;
    }
    cells->count = 0;
    cells->used = cells->drops_used = cells->wasted = 0;
    cells->times++;
    const uint32_t tape = add_whole_tape(cells, c->program->count);
    struct cell *root = cell_add(cells);
    *root = (struct cell){.bits = GRID_BITS,
                          .half = half,
                          .tape = tape,
                          .count = (uint32_t)c->program->count,
                          .parent = -1,
                          .trunk = trunk_of(c, half),
                          .made = true,
                          .splits = c->program->count > CELL_SHORT,
                          .picture = c->picture};
    cells->grid = (float)(1 << (GRID_BITS - 1)) / root->half;
    for (int i = 0; i < 3; i++) {
        root->centre[i] = (float)((1 << (GRID_BITS - 1)) - GRID_ORIGIN) / cells->grid;
    }
}

/* Where they are too many they are made anew. Not while one of them is used. */
static void cells_limit(struct lanes *c)
{
    struct cells *cells = c->cells;
    const size_t words = cells->used + cells->drops_used / 2;

    if (cells->count > CELL_LIMIT || words > TAPES_LIMIT / (size_t)c->threads) {
        cells->count = 0;
        cells_begin(c);
    }
}

/* The lanes whose points the tape holds for. */
static vb cell_lanes(const struct cell *cell, vb m, const vf *p)
{
    const float reach = LOOSE * cell->half;

    return m & (vf_abs(p[0] - cell->centre[0]) <= reach) &
           (vf_abs(p[1] - cell->centre[1]) <= reach) & (vf_abs(p[2] - cell->centre[2]) <= reach);
}

/* Points on the grid; `in`: those that the root has. Each is in one child of its cube. */
struct spots {
    vi at[3];
    vb in;
};

static struct spots spots_of(const struct cells *cells, const vf *p)
{
    struct spots s = {.in = vb_all(true)};

    for (int i = 0; i < 3; i++) {
        const vf at = vf_floor(p[i] * cells->grid) + (float)GRID_ORIGIN;
        const vb in = (at >= 0.0f) & (at < (float)(1 << GRID_BITS));
        s.at[i] = vi_of_f(vf_select(in, at, vf_zero));
        s.in &= in;
    }
    return s;
}

/* Those that are in the cube. */
static vb cell_holds(const struct cell *cell, vb m, const struct spots *s)
{
    const vi apart =
        (s->at[0] ^ cell->corner[0]) | (s->at[1] ^ cell->corner[1]) | (s->at[2] ^ cell->corner[2]);

    return m & s->in & (apart < 1 << cell->bits);
}

static bool cell_has(const struct cell *cell, const struct spots *s, int lane)
{
    const int apart = (s->at[0][lane] ^ cell->corner[0]) | (s->at[1][lane] ^ cell->corner[1]) |
                      (s->at[2][lane] ^ cell->corner[2]);

    return apart < 1 << cell->bits;
}

/* How a tape takes the second operand alone. What cuts is outside of what it cuts; but where the
 * first operand is hidden, the second is the result. */
static uint32_t second_alone(const struct lanes *c, const struct operation *in)
{
    const bool one_is_hidden = in->seen && c->params[in->seen] != 0.0f;

    return in->rule == SDF_FIRST && !one_is_hidden ? TAPE_NEGATE : TAPE_MOVE;
}

/* The tape of one child, from behind: only what a result is made of. */
static void make_tape(struct lanes *c, const struct cell *parent, int number, struct cell *child)
{
    struct cells *cells = c->cells;
    const struct operation *operations = c->program->operations;
    bool distance[FIELD_SLOTS_MAX] = {true}, point[FIELD_SLOTS_MAX] = {false};

    child->made = true;
    if (!(parent->dropping >> number & 0x101)) {
        return; /* it has its parent's */
    }
    tape_room(cells, tape_words(parent->count));
    const uint32_t *from = cell_tape(cells, parent);
    const uint16_t *drops = cell_drops(cells, parent);
    uint32_t *const to = cells->tapes + cells->used;
    uint32_t *at = to + parent->count;
    for (uint32_t i = parent->count; i-- > 0;) {
        const uint32_t word = from[i];
        const struct operation *in = &operations[word & TAPE_INDEX];
        const bool makes_point = in->op == FIELD_TRANSFORM || in->op == FIELD_WARP;
        uint32_t kept = word;
        if (makes_point ? !point[in->out] : !distance[in->a]) {
            i -= in->op == FIELD_LOOP_END ? in->length : 0;
            continue;
        }
        if (makes_point) {
            point[in->out] = false;
            point[in->point] = true;
        } else if (in->op == FIELD_COMBINE && (word & ~(uint32_t)TAPE_INDEX)) {
            distance[in->a] = false;
            distance[in->b] = true;
        } else if (in->op == FIELD_COMBINE && drops[i] >> (8 + number) & 1) {
            continue;
        } else if (in->op == FIELD_COMBINE) {
            const bool first = drops[i] >> number & 1;
            distance[in->a] = !first;
            distance[in->b] = true;
            kept |= first ? second_alone(c, in) : 0;
        } else if (in->op == FIELD_SHAPE || in->op == FIELD_EMPTY) {
            distance[in->a] = false;
            point[in->point] |= in->op == FIELD_SHAPE;
        } else if (in->op == FIELD_AFTER) {
            point[in->point] = true;
        } else if (in->op == FIELD_LOOP_END) { /* whole */
            const struct operation *begin = in - in->length;
            at -= in->length;
            memcpy(at, from + i + 1 - in->length, in->length * sizeof *at);
            i -= in->length;
            kept = from[i];
            distance[begin->a] = false;
            point[begin->point] = true;
        }
        *--at = kept;
    }
    child->tape = (uint32_t)cells->used;
    child->words = NULL;
    child->owns = true;
    child->count = (uint32_t)(to + parent->count - at);
    memmove(to, at, child->count * sizeof *at);
    cells->used += tape_words(child->count);
}

/* The same, made by the first thread that comes there. */
static void share_tape(struct lanes *c, const struct cell *parent, int number, struct cell *child)
{
    struct cells *cells = c->cells;
    struct trunk_tape *shared = &parent->trunk->tapes[number];

    if (trunk_take(cells->trunk, &shared->state)) {
        const size_t used = cells->used;
        make_tape(c, parent, number, child);
        trunk_put(cells->trunk, shared, cells->used > used ? cells->tapes + child->tape : NULL,
                  child->count);
        cells->used = used;
        trunk_tell(cells->trunk, &shared->state);
    }
    child->owns = false;
    if (shared->words) {
        child->words = shared->words;
        child->count = shared->count;
    }
    child->trunk = shared->cube;
    child->made = true;
}

/* Of the part of the field that a lane is to see; answers which of these see the same. */
static vb choose_space(struct lanes *c, vb m, int lane)
{
    if (c->frame->has_transmissive) {
        const float mask = c->field_mask_0[lane];
        c->cells = &c->spaces[mask == 0.0f ? 0 : mask > 0.0f ? 1 : 2];
        m &= c->field_mask_0 == mask;
    }
    cells_limit(c);
    return m;
}

/* Runs a cube's tape for what its children leave out. `past`: NULL, or as it was before an edit.
 * False: the distances in their middles are those of then. */
static bool run_for_drops(struct machine *v, const struct cells *cells, const struct cell *cell,
                          const struct tape_past *past)
{
    const uint32_t *tape = cell_tape(cells, cell);
    struct checkpoints checkpoints = {.room = v->drops + tape_words(cell->count),
                                      .most = checkpoints_in(cell->count),
                                      .note = CHECKPOINT_WORDS,
                                      .ended = cell->count};
    uint32_t begun = 0;

    v->checkpoints = checkpoints.most > 0 ? &checkpoints : NULL;
    if (past && v->checkpoints) {
        checkpoints.shift = cell->count - past->count;
        checkpoints.same = cell->count - past->last;
        begun = begin_again(v, tape, past);
    }
    find_due(&checkpoints);
    run_from(v, tape, begun, cell->count);
    if (past && v->checkpoints) {
        take_the_rest(v, past, begun, cell->count);
    }
    return checkpoints.ended == cell->count;
}

/* What each child can leave out, and the distances in their middles. `mask`: of who asks. */
static void look_at_children(struct lanes *c, int32_t index, float mask,
                             const struct tape_past *past)
{
    struct machine *const v = c->machine;
    const vf asked = c->field_mask_0;
    const vb estimates = c->field_estimates_0;
    const struct cell parent = c->cells->at[index];

    c->field_mask_0 = vf_all(mask);
    c->field_estimates_0 = vb_all(false);
    for (int first = 0; first < 8; first += LANES) {
        vf centre[3] = {0};
        for (int k = 0; k < LANES; k++) {
            for (int i = 0; i < 3; i++) {
                centre[i][k] = c->cells->at[parent.children + first + (k & 7)].centre[i];
            }
        }
        machine_of(v, c, vb_all(true), centre);
        v->drops = cell_drops(c->cells, &parent);
        v->child = first;
        v->dropping = 0;
        v->radius = LOOSE * 0.5f * parent.half * 1.7320508f;
        const bool whole = run_for_drops(v, c->cells, &parent, past);
        c->cells->at[index].dropping |= v->dropping;
        for (int k = 0; whole && k < LANES && first + k < 8; k++) {
            c->cells->at[parent.children + first + k].distance = v->d[0][k];
        }
    }
    c->field_mask_0 = asked;
    c->field_estimates_0 = estimates;
}

/* The same, by the first thread that comes there. */
static void share_children(struct lanes *c, int32_t index, float mask)
{
    struct trunk *trunk = c->cells->trunk;
    struct cell *cell = &c->cells->at[index], *children = &c->cells->at[cell->children];
    struct trunk_cube *shared = cell->trunk;

    if (trunk_take(trunk, &shared->state)) {
        trunk_drops(trunk, shared, drops_words(cell->count));
        look_at_children(c, index, mask, NULL);
        shared->dropping = cell->dropping;
        for (int k = 0; k < CUBE_CHILDREN; k++) {
            shared->distances[k] = children[k].distance;
        }
        trunk_tell(trunk, &shared->state);
    }
    cell->dropping = shared->dropping;
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        children[k].distance = shared->distances[k];
    }
}

static void add_children(struct cells *cells, int32_t index)
{
    const int32_t children = (int32_t)cells->count;
    const struct cell parent = cells->at[index];
    const float half = 0.5f * parent.half;
    const uint8_t bits = parent.bits - 1;

    cells->at[index].children = children;
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        struct cell *child = cell_add(cells);
        *child = (struct cell){.bits = bits,
                               .half = half,
                               .tape = parent.tape,
                               .words = parent.words,
                               .count = parent.count,
                               .parent = index};
        for (int i = 0; i < 3; i++) {
            const bool upper = k >> i & 1;
            child->centre[i] = parent.centre[i] + (upper ? half : -half);
            child->corner[i] = parent.corner[i] + (upper << bits);
        }
        cells->news[children + k] = cells->news[index]; /* it may be other than before that */
    }
}

static void cell_split(struct lanes *c, int32_t index, float mask)
{
    add_children(c->cells, index);
    struct cell *cell = &c->cells->at[index];
    if (cell->trunk) {
        share_children(c, index, mask);
    } else {
        cell->drops = drops_add(c->cells, cell->count);
        look_at_children(c, index, mask, NULL);
    }
}

/* Whether smaller cubes would be worth it. */
static bool is_worth_splitting(const struct lanes *c, const struct cell *cell)
{
    float square = 0;

    if (cell->count <= CELL_SHORT || cell->bits == 0) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        const float way = cell->centre[i] - c->frame->camera.eye[i];
        square += way * way;
    }
    const float way = f_max(sqrtf(square) - 1.7320508f * cell->half, 0.0f);
    const float print =
        c->frame->camera.pixel_radius * (c->frame->camera.orthographic ? 1.0f : way);
    const float pixels = cell->count > BOUND_TAPE ? CELL_PIXELS_LONG : CELL_PIXELS;
    return cell->half > f_max(2.0f * pixels * print, CELL_NEAR * fabsf(cell->distance));
}

/* With its tape. */
static struct cell *cell_ready(struct lanes *c, int32_t at)
{
    struct cell *cell = &c->cells->at[at];

    if (!cell->made) {
        const struct cell *parent = &c->cells->at[cell->parent];
        (parent->trunk ? share_tape : make_tape)(c, parent, (int)(at - parent->children), cell);
    }
    if (cell->picture != c->picture) {
        cell->splits = is_worth_splitting(c, cell);
        cell->picture = c->picture;
    }
    return cell;
}

static bool has_smaller(const struct cell *cell)
{
    return cell->splits || cell->worn;
}

/* Counts an evaluation. Where a tape was run often, smaller cubes are made for the next ones: they
 * cost about as much as these runs did. Not where the cube's own tape is hardly shorter than its
 * parent's. */
static void use(struct cells *cells, int32_t at)
{
    struct cell *cell = &cells->at[at];

    if (has_smaller(cell) || cell->count < WORN_TAPE || cell->bits == 0 ||
        ++cell->uses * cell->count < WORN_RUN) {
        return;
    }
    const struct cell *parent = &cells->at[cell->parent];
    cell->worn = parent->splits || 8 * (uint64_t)cell->count < 7 * (uint64_t)parent->count;
}

/* The child, of a cube that splits, that a lane is in. */
static int32_t child_at(struct lanes *c, int32_t at, const struct spots *s, int lane)
{
    if (!c->cells->at[at].children) {
        cell_split(c, at, c->field_mask_0[lane]);
    }
    const struct cell *cell = &c->cells->at[at];
    const int bit = cell->bits - 1;
    return cell->children + ((s->at[0][lane] >> bit & 1) | (s->at[1][lane] >> bit & 1) << 1 |
                             (s->at[2][lane] >> bit & 1) << 2);
}

/* The smallest cube around this one that a lane is in. */
static int32_t cell_around(const struct cells *cells, int32_t last, const struct spots *s, int lane)
{
    int32_t at = s->in[lane] ? last : 0;

    while (at > 0 && !cell_has(&cells->at[at], s, lane)) {
        at = cells->at[at].parent;
    }
    return at;
}

/* A cube for one of these lanes, and those that it holds: of the cubes around that lane, the one
 * whose tape takes the least for each lane in it. The root holds everything. */
static const struct cell *cell_at(struct lanes *c, vb m, const vf *p, int lane, vb *out_lanes)
{
    m = choose_space(c, m, lane);
    struct cells *cells = c->cells;
    vb held = cell_lanes(&cells->at[cells->last], m, p);
    const struct cell *last = cell_ready(c, cells->last);
    if (!lanes_any(m & ~held) && !has_smaller(last)) {
        use(cells, cells->last);
        *out_lanes = held;
        return last;
    }
    const struct spots spots = spots_of(cells, p);
    int32_t at = cell_around(cells, cells->last, &spots, lane), best = at;
    held = at > 0 ? cell_lanes(&cells->at[at], m, p) : m;
    /* What a tape takes, and how many lanes share it, of the best. */
    uint64_t least = cell_ready(c, at)->count + CELL_RUN, sharing = lanes_count(held);
    *out_lanes = held;
    while (has_smaller(&cells->at[at]) && spots.in[lane]) {
        at = child_at(c, at, &spots, lane);
        held = cell_lanes(&cells->at[at], held, p);
        const uint64_t takes = cell_ready(c, at)->count + CELL_RUN, lanes = lanes_count(held);
        if (takes * sharing <= least * lanes) {
            best = at;
            least = takes;
            sharing = lanes;
            *out_lanes = held;
        }
    }
    cells->last = best;
    use(cells, best);
    return &cells->at[best];
}
