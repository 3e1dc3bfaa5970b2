/* SPDX-License-Identifier: MIT */
/* The interpreter of field programs, and what the generated C asks for. */
#include <stdlib.h>

#include "engine_internal.h"
#include "protocol/memory.h"
#include "seen.h"

/* --- the field --- */

typedef vf shape_function(struct lanes *c, vb m, const vf *p);
typedef vf combine_function(struct lanes *c, vb m, vf a, vf b);
typedef vf change_function(struct lanes *c, vb m, vf d);
typedef void map_function(struct lanes *c, vb m, const vf *p, vf *out);
typedef void cell_function(struct lanes *c, vb m, const vf *p, const vf *cell, vf *out);
typedef vf after_function(struct lanes *c, vb m, vf d, const vf *p);

#define CALL(type, function) ((type *)(function))

#include "code.c"

enum { MIXTURE = SPMD_Mixture, OPEN_MAX = LIMIT_NODE_DEPTH };
/* Children that a vector asks about at a time, a bit for each. */
enum { ASKED = (1 << (LANES < CUBE_CHILDREN ? LANES : CUBE_CHILDREN)) - 1 };

struct open {
    vb before;
    vf first[3], last[3], cell[3], left;
};

/* A thread has one, as large as the deepest field needs: to make room for each run took longer than
 * short runs. */
struct machine {
    struct lanes *c;
    vb m;
    vf p[FIELD_SLOTS_MAX][3];
    vf d[FIELD_SLOTS_MAX];
    vf (*mixtures)[MIXTURE]; /* NULL: distances alone */
    /* NULL, or which operand each operation of the tape may leave out where `radius` around its
     * point is all that is asked for: the first in bit `child` and on, a bit for each lane, the
     * second in bit 8 + `child` and on. */
    uint16_t *drops, dropping;       /* and all of them in one */
    struct checkpoints *checkpoints; /* of that tape, or NULL */
    float radius;
    vf loose[FIELD_SLOTS_MAX]; /* so much more than the way to them distances there may differ */
    int child;
    struct open open[OPEN_MAX];
    int depth;
    vf room[FIELD_SLOTS_MAX][MIXTURE]; /* for mixtures */
};

/* For vectors. */
static void *aligned_room(size_t bytes)
{
    void *room = aligned_alloc(64, (bytes + 63) / 64 * 64);

    if (!room) {
        abort();
    }
    return room;
}

static void place(const float *n, const vf p[3], vf out[3])
{
    for (int i = 0; i < 3; i++, n += 4) {
        out[i] = n[0] * p[0] + n[1] * p[1] + n[2] * p[2] + n[3];
    }
}

static void select_all(vb m, const vf *from, vf *to, int count)
{
    for (int i = 0; i < count; i++) {
        to[i] = vf_select(m, from[i], to[i]);
    }
}

/* Around the point, of one whose distance is v->d[in->a]. */
static vf looseness(const struct machine *v, const struct operation *in)
{
    if (!in->unsteady) {
        return vf_zero;
    }
    const float *cut = v->c->own + 4 * (FIELD_MATRIX_VEC4S + FIELD_HEAD_VEC4S);
    const vf loose = vf_all(cut[FIELD_LOOSE]);
    return vf_select(v->d[in->a] - v->radius > cut[FIELD_UNSTEADY], loose, loose + cut[FIELD_JUMP]);
}

static const struct operation_kind *kind_of(const struct machine *v, const struct operation *in)
{
    return &v->c->program->kinds[in->kind];
}

static void run_empty(struct machine *v, uint16_t slot)
{
    v->d[slot] = vf_all(FIELD_FAR);
    v->loose[slot] = vf_zero;
    if (v->mixtures) {
        spmd_mixture_far(v->c, v->m, v->mixtures[slot]);
    }
}

static void run_shape(struct machine *v, const struct operation *in)
{
    struct lanes *c = v->c;
    const struct operation_kind *kind = kind_of(v, in);
    const float *head = c->own + 4 * FIELD_MATRIX_VEC4S;
    const vf *const p = v->p[in->point];

    v->d[in->a] = kind->code ? run_code(c, v->m, kind->code, p)
                             : CALL(shape_function, kind->function)(c, v->m, p);
    if (v->drops) {
        v->loose[in->a] = looseness(v, in);
    }
    if (v->mixtures) {
        vf local[3];
        place(c->own, p, local);
        spmd_alone(c, v->m, v->d[in->a], vf_all(head[FIELD_LEAF]), vf_all(head[FIELD_SLOT]), local,
                   v->mixtures[in->a]);
    }
}

static void run_operands(struct machine *v, const struct operation *in)
{
    struct lanes *c = v->c;
    const struct operation_kind *kind = kind_of(v, in);
    const vf a = v->d[in->a], b = v->d[in->b];
    const float side = in->seen ? c->params[in->seen] : 0.0f;
    const vf d = side == 0.0f  ? CALL(combine_function, kind->function)(c, v->m, a, b)
                 : side > 0.0f ? b
                               : a;

    v->d[in->a] = d;
    if (v->mixtures) {
        vf *const ma = v->mixtures[in->a], *const mb = v->mixtures[in->b], out[MIXTURE];
        vf share = side == 0.0f ? CALL(combine_function, kind->share)(c, v->m, a, b)
                                : vf_all(side > 0.0f ? 1.0f : 0.0f);
        if (in->mixes) {
            spmd_mixed(c, v->m, d, share, ma, mb, out);
        } else {
            spmd_chosen(c, v->m, d, share, ma, mb, out);
        }
        memcpy(ma, out, sizeof out);
    }
}

static void run_combine(struct machine *v, const struct operation *in)
{
    const bool alone = in->lesser && !v->mixtures;

    if (alone && (!in->seen || v->c->params[in->seen] == 0.0f)) {
        v->d[in->a] = vf_min(v->d[in->a], v->d[in->b]);
    } else {
        run_operands(v, in);
    }
}

/* Whether one operand is so far from the other that it cannot matter within the radius: both have
 * slopes of at most 1, but for what is loose (Barbier et al.: Lipschitz pruning, Computer Graphics
 * Forum 2025). */
static void record(struct machine *v, const struct operation *in, size_t at)
{
    const vf loose[2] = {v->loose[in->a], v->loose[in->b]};

    v->loose[in->a] = vf_max(loose[0], loose[1]);
    if (!in->prunes) {
        return;
    }
    const double n[2] = {v->c->own[0], in->kernel};
    const vf a = in->rule == SDF_ALL     ? -v->d[in->a]
                 : in->rule == SDF_FIRST ? -v->d[in->a]
                                         : v->d[in->a];
    const vf b = in->rule == SDF_ALL ? -v->d[in->b] : v->d[in->b];
    const vf far = 2.0f * v->radius + loose[0] + loose[1] + (float)kind_of(v, in)->reach(n) +
                   1e-5f * (vf_abs(a) + vf_abs(b));
    uint32_t first = lanes_bits(a - b > far), second = lanes_bits(b - a > far);
    if (in->seen && v->c->params[in->seen] != 0.0f) {
        first = v->c->params[in->seen] > 0.0f ? ASKED : 0;
        second = ~first;
    }
    const uint32_t drops = (first & ASKED) << v->child | (second & ASKED) << (8 + v->child);
    v->drops[at] |= (uint16_t)drops;
    v->dropping |= (uint16_t)drops;
}

static void set_distance(struct machine *v, uint16_t slot, vf d)
{
    v->d[slot] = d;
    if (v->mixtures) {
        v->mixtures[slot][0] = d;
    }
}

/* Answers where to go on. */
static size_t run_loop(struct machine *v, const struct operation *in, size_t at)
{
    struct lanes *c = v->c;
    const struct operation_kind *kind = kind_of(v, in);
    struct open *open = &v->open[v->depth++];

    CALL(map_function, kind->function)(c, v->m, v->p[in->point], open->first);
    CALL(map_function, kind->share)(c, v->m, v->p[in->point], open->last);
    memcpy(open->cell, open->first, sizeof open->cell);
    open->before = v->m;
    open->left = spmd_cell_count(c, v->m, open->first, open->last);
    run_empty(v, in->a);
    v->loose[in->a] = vf_all(kind->partial ? c->own[kind->partial] * (float)FIELD_FAR : 0.0f);
    v->m &= open->left > 0.0f;
    if (!lanes_any(v->m)) {
        v->m = open->before;
        v->depth--;
        return at + in->length + 1;
    }
    CALL(cell_function, kind->cell)(c, v->m, v->p[in->point], open->cell, v->p[in->out]);
    return at + 1;
}

static size_t run_loop_end(struct machine *v, const struct operation *in, size_t at)
{
    struct lanes *c = v->c;
    struct open *open = &v->open[v->depth - 1];
    const vb nearer = v->m & (v->d[in->b] < v->d[in->a]);
    vf next[3];

    v->d[in->a] = vf_select(nearer, v->d[in->b], v->d[in->a]);
    if (v->mixtures) {
        select_all(nearer, v->mixtures[in->b], v->mixtures[in->a], MIXTURE);
    }
    spmd_cell_next(c, v->m, open->cell, open->first, open->last, next);
    memcpy(open->cell, next, sizeof next);
    open->left = open->left - 1.0f;
    v->m &= open->left > 0.0f;
    if (lanes_any(v->m)) {
        const struct operation *begin = in - in->length;
        c->own = c->params + 4 * (size_t)begin->params;
        CALL(cell_function, kind_of(v, begin)->cell)
        (c, v->m, v->p[begin->point], open->cell, v->p[begin->out]);
        return at - in->length + 1;
    }
    v->m = open->before;
    v->depth--;
    return at + 1;
}

/* One operand alone. */
static void run_move(struct machine *v, const struct operation *in, bool negated)
{
    const vf d = v->d[in->b];

    v->d[in->a] = negated ? -d : d;
    v->loose[in->a] = v->drops ? v->loose[in->b] : vf_zero;
    if (v->mixtures) {
        memcpy(v->mixtures[in->a], v->mixtures[in->b], sizeof v->mixtures[0]);
        v->mixtures[in->a][0] = v->d[in->a];
    }
}

#include "checkpoints.c"

/* From word i on. */
static void run_from(struct machine *v, const uint32_t *tape, size_t i, size_t count)
{
    struct lanes *c = v->c;
    const struct engine_program *program = c->program;

    while (i < count) {
        const uint32_t word = tape[i];
        const struct operation *in = &program->operations[word & TAPE_INDEX];
        if (word & (TAPE_MOVE | TAPE_NEGATE)) {
            run_move(v, in, (word & TAPE_NEGATE) != 0);
            i++;
            continue;
        }
        void (*const function)(void) = kind_of(v, in)->function;
        c->own = c->params + 4 * (size_t)in->params;
        switch (in->op) {
        case FIELD_EMPTY:
            run_empty(v, in->a);
            break;
        case FIELD_SHAPE:
            run_shape(v, in);
            break;
        case FIELD_COMBINE:
            if (v->drops) {
                record(v, in, i);
            }
            run_combine(v, in);
            if (v->drops && in->a == 0 && knows_the_rest(v, (uint32_t)i + 1)) {
                return;
            }
            break;
        case FIELD_DISTANCE:
            set_distance(v, in->a, CALL(change_function, function)(c, v->m, v->d[in->a]));
            break;
        case FIELD_TRANSFORM:
        case FIELD_WARP:
            run_point(v, in);
            break;
        case FIELD_AFTER:
            set_distance(
                v, in->a,
                vf_max(CALL(after_function, function)(c, v->m, v->d[in->a], v->p[in->point]),
                       vf_all(c->params[in->seen])));
            break;
        case FIELD_LOOP:
            i = run_loop(v, in, i);
            continue;
        case FIELD_LOOP_END:
            i = run_loop_end(v, in, i);
            continue;
        default:
            break;
        }
        i++;
    }
}

static void run(struct machine *v, const uint32_t *tape, size_t count)
{
    run_from(v, tape, 0, count);
}

static struct machine *machine_of(struct machine *v, struct lanes *c, vb m, const vf *p)
{
    v->c = c;
    v->m = m;
    v->mixtures = NULL;
    v->drops = NULL;
    v->checkpoints = NULL;
    v->depth = 0;
    memcpy(v->p[0], p, sizeof v->p[0]);
    return v;
}

#include "cells.c"

#include "notes.c"

#include "bounds.c"

static vf run_in(struct lanes *c, const struct cell *cell, vb m, const vf *p)
{
    struct machine *const v = machine_of(c->machine, c, m, p);

    run(v, cell_tape(c->cells, cell), cell->count);
    const vf d = v->d[0];
    if (c->noted) {
        note_value(c, cell, m, p, d);
    }
    return d;
}

static vf spmd_map(struct lanes *c, vb m, const vf *p)
{
    vf d = vf_zero;

    while (lanes_any(m)) {
        vb held;
        const struct cell *cell = cell_at(c, m, p, lanes_first(m), &held);
        d = vf_select(held, run_in(c, cell, held, p), d);
        m &= ~held;
    }
    return d;
}

#define WAITING 3e38f /* the distance of a ray that got no answer */

static int nearest_lane(vb m, vf distance)
{
    return lanes_first(m & ~(distance > lanes_least(vf_select(m, distance, vf_all(WAITING)))));
}

/* One cube's: of the ray that is least far. Others wait until it is where they are, and share its
 * tapes from there. */
static vf turn(struct lanes *c, vb m, const vf *p, vf distance, vf d)
{
    vb held;
    const struct cell *cell = cell_at(c, m, p, nearest_lane(m, distance), &held);

    return vf_select(held, run_in(c, cell, held, p), d);
}

/* A ray that waits asks for the same point again: that there is no bound is known by then. */
static vf spmd_field_bound(struct lanes *c, vb m, const vf *p, vf distance, vf enough)
{
    vf d = vf_all(WAITING);

    if (c->program->count <= BOUND_TAPE) {
        return spmd_map(c, m, p);
    }
    vb ask = m & ~c->waiting & (enough < (float)FIELD_FAR);
    const struct spots spots = spots_of(&c->spaces[0], p); /* the same in all spaces */
    while (lanes_any(ask)) {
        const int first = lanes_first(ask);
        const vb same = choose_space(c, ask, first);
        const struct cell *cell = bound_at(c, &spots, first);
        const vb held = cell_holds(cell, same, &spots) | (lanes_number == first);
        if (cell_bounds(c->cells, cell)) {
            const vf bound = cell_bound(cell, p);
            const vb answered = held & (vf_abs(bound) >= enough);
            d = vf_select(answered, bound, d);
            m &= ~answered;
        }
        ask &= ~held;
    }
    d = lanes_any(m) ? turn(c, m, p, distance, d) : d;
    c->waiting = m & (d == WAITING);
    return d;
}

static vb spmd_field_waits(struct lanes *c, vb m, vf d)
{
    (void)c;
    return m & (d == WAITING);
}

enum { MIXTURE_SLOTS = 3, MIXTURE_MATERIALS = 4 }; /* of a Mixture: glsl/mixture.glsl */

static void note_materials(struct lanes *c, vb m, const vf *mixture)
{
    struct material_set set = {{0}};

    for (int k = MIXTURE_SLOTS; k < MIXTURE_SLOTS + MIXTURE_MATERIALS; k++) {
        for (int i = 0; i < LANES; i++) {
            material_set_add(&set, m[i] ? (unsigned)mixture[k][i] : 0);
        }
    }
    for (int i = 0; i < SQUARES * SQUARES; i++) {
        for (int k = 0; k < MATERIAL_SET / 64 && (c->noted->squares >> i & 1); k++) {
            c->noted->materials[i].bits[k] |= set.bits[k];
        }
    }
}

static void spmd_surface(struct lanes *c, vb m, const vf *p, const vf *at, vf *out)
{
    struct machine *const v = c->machine;
    vf whole[MIXTURE] = {0};
    vb left = m;

    while (lanes_any(left)) {
        vb held;
        const struct cell *cell = cell_at(c, left, p, lanes_first(left), &held);
        machine_of(v, c, held, p)->mixtures = v->room;
        run(v, cell_tape(c->cells, cell), cell->count);
        select_all(held, v->room[0], whole, MIXTURE);
        if (c->noted) {
            note_run(c, cell, held, p);
        }
        left &= ~held;
    }
    if (c->noted) {
        note_materials(c, m, whole);
    }
    spmd_mix_materials(c, m, whole, at, out);
}
