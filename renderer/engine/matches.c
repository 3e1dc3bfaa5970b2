/* SPDX-License-Identifier: MIT */
#include "matches.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

/* --- what makes operations the same --- */

/* Numbers of an operation, in pieces: what lies between them tells nothing of distances. */
struct piece {
    const float *at;
    size_t count;
};
enum { PIECES = 4 };

/* All but the leaf, the slot of the material, and where a list of points begins. */
static size_t pieces_of_shape(const struct matches_side *side, size_t index,
                              struct piece out[PIECES])
{
    const struct extent own = side->program->extents[index];
    const struct points_list list = changes_points_of(side->program, index, side->params);
    const float *at = side->params + 4 * (size_t)own.first,
                *end = side->params + 4 * (size_t)own.end, *head = at + 4 * FIELD_MATRIX_VEC4S,
                *rest = head + FIELD_TRANSMISSIVE;
    size_t count = 0;

    out[count++] = (struct piece){at, (size_t)(head + FIELD_SCALE + 1 - at)};
    if (list.place > 0) {
        const float *place = side->params + list.place;
        out[count++] = (struct piece){rest, (size_t)(place - rest)};
        out[count++] = (struct piece){side->params + 4 * (size_t)list.extent.first,
                                      4 * (size_t)(list.extent.end - list.extent.first)};
        rest = place + 1;
    }
    out[count++] = (struct piece){rest, (size_t)(end - rest)};
    return count;
}

static size_t pieces_of(const struct matches_side *side, size_t index, struct piece out[PIECES])
{
    const struct extent own = side->program->extents[index];

    if (side->program->operations[index].op == FIELD_SHAPE) {
        return pieces_of_shape(side, index, out);
    }
    out[0] =
        (struct piece){side->params + 4 * (size_t)own.first, 4 * (size_t)(own.end - own.first)};
    return 1;
}

static float seen_of(const struct matches_side *side, size_t index)
{
    const uint32_t seen = side->program->operations[index].seen;

    return seen ? side->params[seen] : 0.0f;
}

static bool is_same_kind(const struct matches_side *a, const struct operation *x,
                         const struct matches_side *b, const struct operation *y)
{
    const struct operation_kind *p = &a->program->kinds[x->kind], *q = &b->program->kinds[y->kind];

    if (p->op != q->op || p->type != q->type || !p->code != !q->code) {
        return false;
    }
    return p->code ? a->program->field->codes[p->choices].hash ==
                         b->program->field->codes[q->choices].hash
                   : p->choices == q->choices;
}

static bool is_same_operation(const struct operation *x, const struct operation *y)
{
    return x->op == y->op && x->mixes == y->mixes && x->prunes == y->prunes && x->a == y->a &&
           x->b == y->b && x->point == y->point && x->out == y->out && x->length == y->length;
}

/* But for its numbers. */
static bool is_like(const struct matches_side *a, size_t i, const struct matches_side *b, size_t j)
{
    const struct operation *x = &a->program->operations[i], *y = &b->program->operations[j];

    return is_same_operation(x, y) && is_same_kind(a, x, b, y);
}

static bool is_same(const struct matches_side *a, size_t i, const struct matches_side *b, size_t j)
{
    struct piece p[PIECES], q[PIECES];

    if (!is_like(a, i, b, j) || seen_of(a, i) != seen_of(b, j)) {
        return false;
    }
    const size_t count = pieces_of(a, i, p);
    if (pieces_of(b, j, q) != count) {
        return false;
    }
    for (size_t k = 0; k < count; k++) {
        if (p[k].count != q[k].count ||
            memcmp(p[k].at, q[k].at, p[k].count * sizeof *p[k].at) != 0) {
            return false;
        }
    }
    return true;
}

/* Of the numbers (FNV-1a, over whole floats). */
static uint64_t hash_of(const struct matches_side *side, size_t index)
{
    struct piece pieces[PIECES];
    const size_t count = pieces_of(side, index, pieces);
    uint64_t hash = UINT64_C(0xcbf29ce484222325);

    for (size_t k = 0; k < count; k++) {
        for (size_t i = 0; i < pieces[k].count; i++) {
            uint32_t bits;
            memcpy(&bits, &pieces[k].at[i], sizeof bits);
            hash = (hash ^ bits) * UINT64_C(0x100000001b3);
        }
    }
    return hash;
}

/* --- finding them --- */

struct search {
    struct matches_side before, after;
    struct matches *out;
    uint32_t *was; /* of each operation after: its index before, or MATCH_NONE */
};

typedef bool likeness(const struct matches_side *a, size_t i, const struct matches_side *b,
                      size_t j);

static bool match_by(struct search *s, likeness *is_alike, size_t before, size_t after)
{
    const bool found = before < s->before.program->count && after < s->after.program->count &&
                       s->out->now[before] == MATCH_NONE && s->was[after] == MATCH_NONE &&
                       is_alike(&s->before, before, &s->after, after);

    if (found) {
        s->out->now[before] = (uint32_t)after;
        s->was[after] = (uint32_t)before;
    }
    return found;
}

static void match(struct search *s, size_t before, size_t after)
{
    if (match_by(s, is_same, before, after)) {
        s->out->changed[after] = 0;
        s->out->fresh--;
    }
}

/* What stands beside the same operations is often the same too, from both ends on. */
static void match_beside(struct search *s)
{
    const size_t before = s->before.program->count, after = s->after.program->count;

    match(s, 0, 0);
    for (size_t i = 1; i < after; i++) {
        if (s->was[i - 1] != MATCH_NONE) {
            match(s, s->was[i - 1] + 1, i);
        }
    }
    if (before > 0 && after > 0) {
        match(s, before - 1, after - 1);
    }
    for (size_t i = after; i-- > 1;) {
        if (s->was[i] != MATCH_NONE && s->was[i] > 0) {
            match(s, s->was[i] - 1, i - 1);
        }
    }
}

struct hashed {
    uint64_t hash;
    uint32_t index;
};

static int ascending(const void *a, const void *b)
{
    const struct hashed *x = a, *y = b;

    return x->hash != y->hash ? (x->hash > y->hash) - (x->hash < y->hash)
                              : (x->index > y->index) - (x->index < y->index);
}

/* The shapes that are not matched, by their hashes. The caller frees them. */
static struct hashed *hash_left(const struct matches_side *side, const uint32_t *matched,
                                size_t *out_count)
{
    struct hashed *left = memory_alloc(side->program->count + 1, sizeof *left);
    size_t count = 0;

    for (size_t i = 0; i < side->program->count; i++) {
        if (matched[i] == MATCH_NONE && side->program->operations[i].op == FIELD_SHAPE) {
            left[count++] = (struct hashed){hash_of(side, i), (uint32_t)i};
        }
    }
    qsort(left, count, sizeof *left, ascending);
    *out_count = count;
    return left;
}

/* Shapes of the same numbers, wherever they stand: of several places that were edited, what lies
 * between them. */
static void match_shapes(struct search *s)
{
    size_t before_count, after_count, k = 0;
    struct hashed *before = hash_left(&s->before, s->out->now, &before_count);
    struct hashed *after = hash_left(&s->after, s->was, &after_count);

    for (size_t i = 0; i < after_count; i++) {
        while (k < before_count && before[k].hash < after[i].hash) {
            k++;
        }
        if (k < before_count && before[k].hash == after[i].hash) {
            match(s, before[k++].index, after[i].index);
        }
    }
    free(before);
    free(after);
}

/* Of others that stand beside the same, those with other numbers. They stay `changed`. */
static void match_changed(struct search *s)
{
    for (size_t i = 1; i < s->after.program->count; i++) {
        if (s->was[i - 1] != MATCH_NONE) {
            match_by(s, is_like, s->was[i - 1] + 1, i);
        }
    }
}

static bool is_renumbered(const struct search *s)
{
    bool any = false;

    for (size_t i = 0; i < s->after.program->count && !any; i++) {
        const struct operation *to = &s->after.program->operations[i];
        if (to->op == FIELD_SHAPE && !s->out->changed[i]) {
            const struct operation *from = &s->before.program->operations[s->was[i]];
            const float *a = s->before.params + 4 * ((size_t)from->params + FIELD_MATRIX_VEC4S);
            const float *b = s->after.params + 4 * ((size_t)to->params + FIELD_MATRIX_VEC4S);
            any = a[FIELD_LEAF] != b[FIELD_LEAF] || a[FIELD_SLOT] != b[FIELD_SLOT];
        }
    }
    return any;
}

static uint32_t *none(size_t count)
{
    uint32_t *indices = memory_alloc(count + 1, sizeof *indices);

    for (size_t i = 0; i < count; i++) {
        indices[i] = MATCH_NONE;
    }
    return indices;
}

void matches_find(const struct matches_side *before, const struct matches_side *after,
                  struct matches *out)
{
    const size_t count = after->program->count;

    *out = (struct matches){.now = none(before->program->count),
                            .before = before->program->count,
                            .changed = memory_alloc(count + 1, 1),
                            .fresh = count};
    memset(out->changed, 1, count);
    struct search s = {*before, *after, out, none(count)};

    match_beside(&s);
    match_shapes(&s);
    match_beside(&s);
    out->renumbered = is_renumbered(&s);
    match_changed(&s);
    while (out->first < out->before && out->now[out->first] == out->first) {
        out->first++;
    }
    free(s.was);
}

void matches_finish(struct matches *matches)
{
    free(matches->now);
    free(matches->changed);
    *matches = (struct matches){0};
}

bool matches_rename(const struct matches *matches, uint32_t *words, size_t count)
{
    bool any = false;

    for (size_t i = 0; i < count; i++) {
        const uint32_t index = words[i] & TAPE_INDEX;
        if (index >= matches->first) {
            words[i] = (words[i] & ~(uint32_t)TAPE_INDEX) |
                       (index < matches->before ? matches->now[index] : MATCH_NONE);
            any = true;
        }
    }
    return any;
}
