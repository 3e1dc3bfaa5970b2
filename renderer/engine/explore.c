/* SPDX-License-Identifier: MIT */
/* Cubes that are made before any ray asks, for devices that make none themselves: the largest ones
 * by one thread, and what is in each of those by any. */

#define EXPLORED_NEAR 0.5f       /* half of the smallest, as a part of the distance to surfaces */
#define EXPLORED_SHORT 24        /* such a tape is not made shorter, */
#define EXPLORED_PART 512        /* nor one of such a part of a long program */
#define EXPLORED_PARTS 16        /* of what is of interest: larger cubes are made anyway */
#define EXPLORED_PIECES 64       /* at least so many cubes are shared among threads */
#define EXPLORED_CUBES (1 << 20) /* with more cubes than each one's share of so many, */
#define EXPLORED_WORDS (1 << 25) /* or words of tapes, there are no smaller ones */

struct expedition {
    const struct engine_program *program;
    const float *params;
    const struct engine_extent *extent;
    float mask;
    uint32_t enough; /* operations of a tape that is not made shorter */
    size_t most_cubes, most_words;
    struct cells *cells;  /* the largest ones, */
    size_t *heads, count; /* of which these are explored, */
    struct cells *pieces; /* each in cubes of its own */
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

/* Whether smaller cubes would be worth it. */
static bool is_worth_exploring(const struct expedition *e, const struct cells *cells,
                               const struct cell *cell)
{
    return cell->count > e->enough && cell->bits > 0 && cell->half > e->extent->least &&
           cell->half > EXPLORED_NEAR * fabsf(cell->distance) && cells->count < e->most_cubes &&
           cells->used < e->most_words + cells->at[0].count &&
           (cell->half > e->extent->scale / EXPLORED_PARTS || gets_shorter(cells, cell));
}

static bool is_worthy(const struct expedition *e, struct lanes *c, size_t at)
{
    struct cell *cell = &c->cells->at[at];

    if (!cell->made) {
        const struct cell *parent = &c->cells->at[cell->parent];
        make_tape(c, parent, (int)((int32_t)at - parent->children), cell);
    }
    return is_worth_exploring(e, c->cells, cell);
}

/* The cubes from one on, whose children follow them. */
static void explore_all(const struct expedition *e, struct lanes *c, size_t at)
{
    for (; at < c->cells->count; at++) {
        if (is_worthy(e, c, at)) {
            cell_split(c, (int32_t)at, e->mask);
        }
    }
}

/* Level by level, until so many cubes of one are worth exploring that threads can share them. */
static void explore_largest(struct expedition *e, struct lanes *c)
{
    size_t first = 0, end = 0;

    do {
        for (size_t i = 0; i < e->count; i++) {
            cell_split(c, (int32_t)e->heads[i], e->mask);
        }
        first = end;
        end = c->cells->count;
        e->count = 0;
        e->heads = memory_resize(e->heads, end - first + 1, sizeof *e->heads);
        for (size_t i = first; i < end; i++) {
            if (is_worthy(e, c, i)) {
                e->heads[e->count++] = i;
            }
        }
    } while (e->count > 0 && e->count < EXPLORED_PIECES);
}

/* A cube with its tape becomes one that is in no other. */
static void begin_piece(const struct cells *cells, const struct cell *cell, struct cells *out)
{
    *out = (struct cells){.grid = cells->grid};
    tape_room(out, cell->count);
    memcpy(out->tapes, cells->tapes + cell->tape, cell->count * sizeof *out->tapes);
    out->used = cell->count;
    struct cell *root = cell_add(out);
    *root = *cell;
    root->tape = 0;
    root->parent = -1;
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
        explore_all(e, c, 0);
    }
    looker_destroy(looker);
}

/* What was made in a piece follows the cubes that there are. */
static void add_piece(struct cells *cells, size_t at, const struct cells *piece)
{
    const int32_t behind = (int32_t)cells->count - 1;
    const uint32_t words = (uint32_t)cells->used;

    cells->at[at].children = piece->at[0].children ? piece->at[0].children + behind : 0;
    for (size_t i = 1; i < piece->count; i++) {
        struct cell *cell = cell_add(cells);
        *cell = piece->at[i];
        cell->children += cell->children ? behind : 0;
        cell->tape += words;
    }
    tape_room(cells, piece->used);
    memcpy(cells->tapes + words, piece->tapes, piece->used * sizeof *piece->tapes);
    cells->used += piece->used;
}

static void finish_piece(struct cells *piece)
{
    struct cells spaces[ENGINE_SPACES] = {*piece};

    cells_finish(spaces);
}

static void share(struct expedition *e)
{
    struct crew crew = {.task = explore_pieces, .expedition = e};

    e->pieces = memory_alloc(e->count, sizeof *e->pieces);
    e->most_cubes = EXPLORED_CUBES / e->count;
    e->most_words = EXPLORED_WORDS / e->count;
    find_threads(&crew, e->program);
    run_crew(&crew, crew.threads);
    for (size_t i = 0; i < e->count; i++) {
        add_piece(e->cells, e->heads[i], &e->pieces[i]);
        finish_piece(&e->pieces[i]);
    }
    free(e->pieces);
}

static void explore(const struct engine_program *program, const float *params,
                    const struct engine_extent *extent, float mask, struct cells *out)
{
    struct looker *looker = looker_create(program, params, extent->reach);
    struct lanes *c = &looker->lanes;
    struct expedition e = {.program = program,
                           .params = params,
                           .extent = extent,
                           .mask = mask,
                           .enough = EXPLORED_SHORT + (uint32_t)program->count / EXPLORED_PART,
                           .most_cubes = EXPLORED_CUBES,
                           .most_words = EXPLORED_WORDS,
                           .cells = c->cells};

    explore_largest(&e, c);
    if (e.count > 0) {
        share(&e);
    }
    free(e.heads);
    *out = *c->cells;
    memset(c->cells, 0, sizeof *c->cells);
    looker_destroy(looker);
}
