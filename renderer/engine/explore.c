/* SPDX-License-Identifier: MIT */
/* Cubes that are made before any ray asks, for devices that make none themselves: the largest ones
 * by one thread, and what is in each of those by any. */

#define EXPLORED_NEAR 0.5f       /* half of the smallest, as a part of the distance to surfaces */
#define EXPLORED_SHORT 24        /* such a tape is not made shorter, */
#define EXPLORED_PART 512        /* nor one of such a part of a long program */
#define EXPLORED_PARTS 16        /* of what is of interest: larger cubes are made anyway */
#define EXPLORED_PIECES 64       /* at least so many cubes are shared among threads */
#define EXPLORED_CUBES (1 << 20) /* with more cubes than so many, */
#define EXPLORED_WORDS (1 << 25) /* or words of tapes, there are no smaller ones */

/* The first cubes of a piece: what is around the one that is explored, of which only the length of
 * its tape is asked for, and that one, with its tape. */
enum { AROUND, HEAD, INSIDE };

struct expedition {
    const struct engine_program *program;
    const float *params;
    const struct engine_extent *extent;
    float mask;
    uint32_t enough;            /* operations of a tape that is not made shorter */
    atomic_size_t cubes, words; /* that were made */
    bool shares;                /* these are too many: each piece gets its share */
    atomic_bool limited;        /* some are not made, because they would be too many */
    struct cells *cells;        /* the largest ones, */
    size_t *heads, count;       /* of which these are explored, */
    struct cells *pieces;       /* each in cubes of its own */
};

/* Whether its tape, or its parent's, is much shorter than that of the cube around. */
static bool gets_shorter(const struct cells *cells, const struct cell *cell)
{
    for (int i = 0; i < 2 && cell->parent >= 0; i++) {
        const struct cell *parent = &cells->at[cell->parent];
        if (8 * (uint64_t)cell->count < 7 * (uint64_t)parent->count) {
            return true;
        }
        cell = parent;
    }
    return cell->parent < 0;
}

static bool has_room(struct expedition *e, const struct cells *cells)
{
    const bool has = e->shares ? cells->count < EXPLORED_CUBES / e->count &&
                                     cells->used < EXPLORED_WORDS / e->count + cells->at[0].count
                               : atomic_load(&e->cubes) < EXPLORED_CUBES &&
                                     atomic_load(&e->words) < EXPLORED_WORDS;

    if (!has) {
        atomic_store(&e->limited, true);
    }
    return has;
}

/* Whether smaller cubes would be worth it. */
static bool is_worth_exploring(struct expedition *e, const struct cells *cells,
                               const struct cell *cell)
{
    return cell->count > e->enough && cell->bits > 0 && cell->half > e->extent->least &&
           cell->half > EXPLORED_NEAR * fabsf(cell->distance) &&
           (cell->half > e->extent->scale / EXPLORED_PARTS || gets_shorter(cells, cell)) &&
           has_room(e, cells);
}

/* Makes the last tape as long as its place. */
static void end_tape(struct cells *cells, size_t first, uint32_t count)
{
    int number;
    const size_t end = first + explored_size(count, &number);

    tape_room(cells, end - cells->used);
    memset(cells->tapes + cells->used, 0, (end - cells->used) * sizeof *cells->tapes);
    cells->used = end;
}

/* A tape of its own, behind all others. */
static void add_tape(struct cells *cells, struct cell *cell, const uint32_t *words, uint32_t count)
{
    cell->tape = (uint32_t)cells->used;
    cell->count = count;
    tape_room(cells, count);
    memcpy(cells->tapes + cells->used, words, count * sizeof *words);
    cells->used += count;
    end_tape(cells, cell->tape, count);
}

/* Eight cubes, with words of tapes. */
static void count_new(struct expedition *e, size_t words)
{
    atomic_fetch_add(&e->cubes, CUBE_CHILDREN);
    atomic_fetch_add(&e->words, words);
}

/* Its children with their tapes. What they leave out is forgotten. */
static void explore_one(struct expedition *e, struct lanes *c, struct siblings *siblings, size_t at)
{
    struct cells *cells = c->cells;
    const size_t used = cells->used;

    cells->drops_used = 0;
    cell_split(c, (int32_t)at, e->mask);
    make_siblings(c, &cells->at[at], 0xff, siblings);
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        struct cell *child = &cells->at[cells->at[at].children + k];
        child->made = true;
        if (siblings->own >> k & 1) {
            add_tape(cells, child, siblings->tapes[k], siblings->counts[k]);
        }
    }
    count_new(e, cells->used - used);
}

/* The cubes from one on, whose children follow them. */
static void explore_all(struct expedition *e, struct lanes *c, size_t at)
{
    struct siblings siblings = {0};

    for (; at < c->cells->count; at++) {
        if (is_worth_exploring(e, c->cells, &c->cells->at[at])) {
            explore_one(e, c, &siblings, at);
        }
    }
    siblings_finish(&siblings);
}

/* Level by level, until so many cubes of one are worth exploring that threads can share them. */
static void explore_largest(struct expedition *e, struct lanes *c)
{
    struct siblings siblings = {0};
    size_t first = 0, end = 0;

    do {
        for (size_t i = 0; i < e->count; i++) {
            explore_one(e, c, &siblings, e->heads[i]);
        }
        first = end;
        end = c->cells->count;
        e->count = 0;
        e->heads = memory_resize(e->heads, end - first + 1, sizeof *e->heads);
        for (size_t i = first; i < end; i++) {
            if (is_worth_exploring(e, c->cells, &c->cells->at[i])) {
                e->heads[e->count++] = i;
            }
        }
    } while (e->count > 0 && e->count < EXPLORED_PIECES);
    siblings_finish(&siblings);
}

static void begin_piece(const struct cells *cells, const struct cell *cell, struct cells *out)
{
    *out = (struct cells){.grid = cells->grid};
    tape_room(out, cell->count);
    memcpy(out->tapes, cells->tapes + cell->tape, cell->count * sizeof *out->tapes);
    out->used = cell->count;
    end_tape(out, 0, cell->count);
    struct cell *around = cell_add(out);
    *around = cells->at[cell->parent < 0 ? 0 : cell->parent];
    around->parent = around->parent < 0 ? -1 : AROUND;
    struct cell *head = cell_add(out);
    *head = *cell;
    head->tape = 0;
    head->parent = cell->parent < 0 ? -1 : AROUND;
}

static void explore_pieces(struct crew *crew)
{
    struct expedition *e = crew->expedition;
    struct looker *looker = looker_create(e->program, e->params, e->extent->reach);
    struct lanes *c = &looker->lanes;
    size_t i;

    while ((i = (size_t)atomic_fetch_add(&crew->next, 1)) < e->count) {
        begin_piece(e->cells, &e->cells->at[e->heads[i]], &e->pieces[i]);
        c->cells = &e->pieces[i];
        explore_all(e, c, HEAD);
    }
    looker_destroy(looker);
}

/* What was made in a piece follows the cubes and the words that there are. */
static void add_piece(struct cells *cells, size_t at, const struct cells *piece)
{
    const struct cell *head = &piece->at[HEAD];
    const int32_t behind = (int32_t)cells->count - INSIDE;
    const uint32_t tape = cells->at[at].tape;
    int number;
    const uint32_t own = explored_size(head->count, &number);
    const uint32_t words = (uint32_t)cells->used - own;

    cells->at[at].children = head->children ? head->children + behind : 0;
    for (size_t i = INSIDE; i < piece->count; i++) {
        struct cell *cell = cell_add(cells);
        *cell = piece->at[i];
        cell->parent = cell->parent == HEAD ? (int32_t)at : cell->parent + behind;
        cell->children += cell->children ? behind : 0;
        cell->tape = cell->tape < own ? tape : cell->tape + words;
    }
    tape_room(cells, piece->used - own);
    memcpy(cells->tapes + cells->used, piece->tapes + own,
           (piece->used - own) * sizeof *piece->tapes);
    cells->used += piece->used - own;
}

static void finish_piece(struct cells *piece)
{
    struct cells spaces[ENGINE_SPACES] = {*piece};

    cells_finish(spaces);
}

static void explore_shared(struct expedition *e)
{
    struct crew crew = {.task = explore_pieces, .expedition = e};

    find_threads(&crew, e->program);
    run_crew(&crew, crew.threads);
}

/* Where all pieces would be too large, which of them were explored how far depends on threads. */
static void share(struct expedition *e)
{
    e->pieces = memory_alloc(e->count, sizeof *e->pieces);
    explore_shared(e);
    if (atomic_load(&e->limited)) {
        for (size_t i = 0; i < e->count; i++) {
            finish_piece(&e->pieces[i]);
        }
        e->shares = true;
        explore_shared(e);
    }
    for (size_t i = 0; i < e->count; i++) {
        add_piece(e->cells, e->heads[i], &e->pieces[i]);
        finish_piece(&e->pieces[i]);
    }
    free(e->pieces);
}

static struct expedition expedition_of(const struct engine_program *program, const float *params,
                                       const struct engine_extent *extent, float mask)
{
    return (struct expedition){.program = program,
                               .params = params,
                               .extent = extent,
                               .mask = mask,
                               .enough = EXPLORED_SHORT + (uint32_t)program->count / EXPLORED_PART};
}

static void explore(const struct engine_program *program, const float *params,
                    const struct engine_extent *extent, float mask, struct explored *out)
{
    struct looker *looker = looker_create(program, params, extent->reach);
    struct lanes *c = &looker->lanes;
    struct expedition e = expedition_of(program, params, extent, mask);

    e.cells = c->cells;
    end_tape(c->cells, 0, (uint32_t)program->count);
    explore_largest(&e, c);
    if (e.count > 0) {
        share(&e);
    }
    free(e.heads);
    *out = (struct explored){.cells = *c->cells, .limited = atomic_load(&e.limited)};
    memset(c->cells, 0, sizeof *c->cells);
    looker_destroy(looker);
}
