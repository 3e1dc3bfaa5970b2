/* SPDX-License-Identifier: MIT */
/* The tapes of all eight children of a cube at once: what is asked for each operation is asked for
 * all of them, by a bit for each. make_tape() says the same of one child. */

struct siblings {
    uint32_t *words;
    size_t room;
    uint32_t *tapes[CUBE_CHILDREN], counts[CUBE_CHILDREN];
    unsigned own; /* bits of those wanted who leave something out; others have their parent's */
};

/* What is asked for, from behind: bits of the children that need a distance, or a point. */
struct needs {
    uint8_t distance[FIELD_SLOTS_MAX], point[FIELD_SLOTS_MAX];
};

static void siblings_add(struct siblings *siblings, unsigned children, uint32_t word)
{
    for (; children; children &= children - 1) {
        *--siblings->tapes[__builtin_ctz(children)] = word;
    }
}

/* Both operands, or what is left of them. */
static void siblings_combine(const struct lanes *c, struct siblings *siblings, struct needs *needs,
                             uint32_t word, uint16_t drops)
{
    const struct operation *in = &c->program->operations[word];
    const unsigned need = needs->distance[in->a], both = need & ~(unsigned)(drops >> 8),
                   second = both & drops;

    needs->distance[in->a] &= (uint8_t)~second;
    needs->distance[in->b] |= (uint8_t)both;
    siblings_add(siblings, both & ~second, word);
    siblings_add(siblings, second, word | second_alone(c, in));
}

/* Whole. `from`: its last word; answers how many are before that. */
static uint32_t siblings_loop(struct siblings *siblings, struct needs *needs,
                              const struct operation *in, const uint32_t *from)
{
    const struct operation *begin = in - in->length;
    const unsigned need = needs->distance[in->a];

    for (uint32_t k = 0; k <= in->length; k++) {
        siblings_add(siblings, need, *(from - k));
    }
    needs->distance[begin->a] &= (uint8_t)~need;
    needs->point[begin->point] |= (uint8_t)need;
    return in->length;
}

static void siblings_begin(struct siblings *siblings, const struct cell *parent, unsigned wanted)
{
    const size_t room = (size_t)CUBE_CHILDREN * parent->count;

    if (siblings->room < room) {
        siblings->room = room;
        siblings->words = memory_resize(siblings->words, room, sizeof *siblings->words);
    }
    siblings->own = (parent->dropping | parent->dropping >> 8) & wanted;
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        siblings->tapes[k] = siblings->words + (size_t)(k + 1) * parent->count;
    }
}

static void siblings_end(struct siblings *siblings, const struct cell *parent)
{
    for (int k = 0; k < CUBE_CHILDREN; k++) {
        const uint32_t *end = siblings->words + (size_t)(k + 1) * parent->count;
        siblings->counts[k] = (uint32_t)(end - siblings->tapes[k]);
    }
}

/* `wanted`: a bit for each. */
static void make_siblings(const struct lanes *c, const struct cell *parent, unsigned wanted,
                          struct siblings *siblings)
{
    const struct operation *operations = c->program->operations;
    const uint32_t *from = cell_tape(c->cells, parent);
    const uint16_t *drops = cell_drops(c->cells, parent);
    struct needs needs = {{0}, {0}};

    siblings_begin(siblings, parent, wanted);
    needs.distance[0] = (uint8_t)siblings->own;
    for (uint32_t i = siblings->own ? parent->count : 0; i-- > 0;) {
        const uint32_t word = from[i];
        const struct operation *in = &operations[word & TAPE_INDEX];
        const bool makes_point = in->op == FIELD_TRANSFORM || in->op == FIELD_WARP;
        const unsigned need = makes_point ? needs.point[in->out] : needs.distance[in->a];
        if (!need) {
            i -= in->op == FIELD_LOOP_END ? in->length : 0;
        } else if (in->op == FIELD_LOOP_END) {
            i -= siblings_loop(siblings, &needs, in, from + i);
        } else if (in->op == FIELD_COMBINE && !(word & ~(uint32_t)TAPE_INDEX)) {
            siblings_combine(c, siblings, &needs, word, drops[i]);
        } else {
            if (makes_point) {
                needs.point[in->out] = 0;
            } else if (in->op != FIELD_DISTANCE && in->op != FIELD_AFTER) {
                needs.distance[in->a] = 0;
            }
            if (in->op == FIELD_COMBINE) {
                needs.distance[in->b] |= (uint8_t)need;
            } else if (makes_point || in->op == FIELD_SHAPE || in->op == FIELD_AFTER) {
                needs.point[in->point] |= (uint8_t)need;
            }
            siblings_add(siblings, need, word);
        }
    }
    siblings_end(siblings, parent);
}

static void siblings_finish(struct siblings *siblings)
{
    free(siblings->words);
}
