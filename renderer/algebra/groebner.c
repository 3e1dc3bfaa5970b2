/* SPDX-License-Identifier: MIT */
#include "groebner.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

const char *const outcome_names[PAIR_OUTCOMES] = {"coprime", "chain", "zero", "added"};

struct pair {
    int i, j; /* i < j */
    ulong sugar, degree;
    exponents multiple; /* the least common one of the leading monomials */
};

void groebner_init(struct groebner *g, const struct ring *ring)
{
    *g = (struct groebner){.ring = ring};
}

void groebner_clear(struct groebner *g)
{
    for (int i = 0; i < g->count; i++) {
        polynomial_clear(&g->elements[i], g->ring);
    }
    free(g->elements);
    free(g->sugar);
    free(g->pairs);
    free(g->waits);
}

/* --- monomials --- */

static void leading(const struct groebner *g, int element, exponents out)
{
    polynomial_exponents(&g->elements[element], 0, g->ring, out);
}

static ulong degree_of(const struct groebner *g, const ulong *a)
{
    ulong sum = 0;

    for (int i = 0; i < g->ring->order.letters; i++) {
        sum += a[i];
    }
    return sum;
}

static bool divides(const struct groebner *g, const ulong *a, const ulong *b)
{
    for (int i = 0; i < g->ring->order.letters; i++) {
        if (a[i] > b[i]) {
            return false;
        }
    }
    return true;
}

bool groebner_is_free(const struct groebner *g, int element, int letters)
{
    const struct polynomial *f = &g->elements[element];

    for (slong n = 0; n < polynomial_terms(f, g->ring); n++) {
        exponents a;
        polynomial_exponents(f, n, g->ring, a);
        for (int i = 0; i < letters; i++) {
            if (a[i] > 0) {
                return false;
            }
        }
    }
    return true;
}

/* --- elements --- */

static void append(struct groebner *g, struct polynomial *f, ulong sugar)
{
    const size_t room = (size_t)g->count + 1;

    g->elements = memory_resize(g->elements, room, sizeof *g->elements);
    g->sugar = memory_resize(g->sugar, room, sizeof *g->sugar);
    polynomial_init(&g->elements[g->count], g->ring);
    polynomial_swap(&g->elements[g->count], f, g->ring);
    g->sugar[g->count++] = sugar;
}

void groebner_add(struct groebner *g, struct polynomial *f)
{
    if (polynomial_terms(f, g->ring) > 0) {
        polynomial_normalize(f, g->ring);
        append(g, f, polynomial_degree(f, g->ring));
    }
}

/* The elements whose leading monomial is no multiple of another's: enough to divide by. The caller
 * frees the list. */
static const struct polynomial **list_divisors(const struct groebner *g, int without,
                                               int *out_count)
{
    const struct polynomial **list =
        memory_alloc((size_t)g->count + 1, sizeof(struct polynomial *));

    *out_count = 0;
    for (int i = 0; i < g->count; i++) {
        exponents a, b;
        bool needed = i != without;
        leading(g, i, a);
        for (int k = 0; needed && k < g->count; k++) {
            leading(g, k, b);
            /* Of two equal ones the first. */
            needed = k == i || k == without || !divides(g, b, a) || (divides(g, a, b) && i < k);
        }
        if (needed) {
            list[(*out_count)++] = &g->elements[i];
        }
    }
    return list;
}

/* Each product of a quotient and a divisor has the sugar of both, and the rest the greatest. */
static ulong add_sugar(const struct groebner *g, const struct division *division,
                       const struct polynomial *const *divisors, ulong sugar)
{
    for (int i = 0; i < division->count; i++) {
        if (polynomial_terms(&division->quotients[i], g->ring) > 0) {
            const ulong own = polynomial_degree(&division->quotients[i], g->ring) +
                              g->sugar[divisors[i] - g->elements];
            sugar = own > sugar ? own : sugar;
        }
    }
    return sugar;
}

/* The rest of `f` by the others, into `f`, and its sugar, unless that is NULL; the steps that it
 * took. */
static slong reduce(const struct groebner *g, struct polynomial *f, int without, ulong *sugar)
{
    struct division division;
    int count;
    const struct polynomial **divisors = list_divisors(g, without, &count);

    division_init(&division, count, g->ring);
    polynomial_divide(&division, f, divisors, g->ring);
    polynomial_swap(f, &division.rest, g->ring);
    polynomial_normalize(f, g->ring);
    const slong steps = division_steps(&division, g->ring);
    if (sugar) {
        *sugar = add_sugar(g, &division, divisors, *sugar);
    }
    division_clear(&division, g->ring);
    free(divisors);
    return steps;
}

/* --- pairs --- */

/* Of elements i < j in a list of all pairs. */
static size_t index_of(int i, int j)
{
    return (size_t)j * (size_t)(j - 1) / 2 + (size_t)i;
}

static bool waits(const struct groebner *g, int i, int j)
{
    return g->waits[i < j ? index_of(i, j) : index_of(j, i)];
}

static struct pair make_pair(const struct groebner *g, int i, int j)
{
    struct pair pair = {.i = i, .j = j};
    exponents a, b;

    leading(g, i, a);
    leading(g, j, b);
    for (int k = 0; k < g->ring->order.letters; k++) {
        pair.multiple[k] = a[k] > b[k] ? a[k] : b[k];
    }
    pair.degree = degree_of(g, pair.multiple);
    const ulong left = g->sugar[i] - degree_of(g, a), right = g->sugar[j] - degree_of(g, b);
    pair.sugar = pair.degree + (left > right ? left : right);
    return pair;
}

static bool comes_first(const struct groebner *g, enum pair_strategy strategy, const struct pair *a,
                        const struct pair *b)
{
    if (strategy == STRATEGY_SUGAR && a->sugar != b->sugar) {
        return a->sugar < b->sugar;
    }
    const int order =
        strategy == STRATEGY_FIRST ? 0 : order_compare(&g->ring->order, a->multiple, b->multiple);
    return order ? order < 0 : a->j != b->j ? a->j < b->j : a->i < b->i;
}

static void add_pair(struct groebner *g, enum pair_strategy strategy, const struct pair *pair)
{
    size_t from = 0, to = g->waiting;

    while (from < to) {
        const size_t middle = (from + to) / 2;
        if (comes_first(g, strategy, pair, &g->pairs[middle])) {
            from = middle + 1;
        } else {
            to = middle;
        }
    }
    g->pairs = memory_one_more(g->pairs, g->waiting, sizeof *g->pairs);
    memmove(&g->pairs[from + 1], &g->pairs[from], (g->waiting - from) * sizeof *g->pairs);
    g->pairs[from] = *pair;
    g->waiting++;
    g->waits[index_of(pair->i, pair->j)] = 1;
    g->counts.pairs++;
}

/* With all elements in front of it. */
static void add_pairs(struct groebner *g, enum pair_strategy strategy, int element)
{
    g->waits = memory_resize(g->waits, index_of(0, element + 1) + 1, 1);
    for (int i = 0; i < element; i++) {
        const struct pair pair = make_pair(g, i, element);
        add_pair(g, strategy, &pair);
    }
}

/* --- criteria --- */

static bool is_coprime(const struct groebner *g, const struct pair *pair)
{
    exponents a, b;

    leading(g, pair->i, a);
    leading(g, pair->j, b);
    return pair->degree == degree_of(g, a) + degree_of(g, b);
}

static bool has_chain(const struct groebner *g, const struct pair *pair)
{
    for (int k = 0; k < g->count; k++) {
        exponents a;
        leading(g, k, a);
        if (k != pair->i && k != pair->j && divides(g, a, pair->multiple) &&
            !waits(g, pair->i, k) && !waits(g, pair->j, k)) {
            return true;
        }
    }
    return false;
}

/* --- the algorithm --- */

static enum pair_outcome divide_pair(struct groebner *g, const struct pair *pair,
                                     struct groebner_step *step)
{
    struct polynomial s;

    polynomial_init(&s, g->ring);
    polynomial_s(&s, &g->elements[pair->i], &g->elements[pair->j], g->ring);
    ulong sugar = pair->sugar;
    step->divisions = reduce(g, &s, -1, &sugar);
    const bool added = polynomial_terms(&s, g->ring) > 0;
    if (added) {
        step->element = g->count;
        append(g, &s, sugar);
    }
    polynomial_clear(&s, g->ring);
    g->counts.divisions += step->divisions;
    g->counts.degree = pair->degree > g->counts.degree ? pair->degree : g->counts.degree;
    return added ? PAIR_ADDED : PAIR_ZERO;
}

static struct groebner_step take_pair(struct groebner *g, const struct groebner_params *params)
{
    const struct pair pair = g->pairs[--g->waiting];
    struct groebner_step step = {pair.i, pair.j, .degree = pair.degree, .sugar = pair.sugar};

    g->waits[index_of(pair.i, pair.j)] = 0;
    step.outcome = params->coprime && is_coprime(g, &pair) ? PAIR_COPRIME
                   : params->chain && has_chain(g, &pair)  ? PAIR_CHAIN
                                                           : divide_pair(g, &pair, &step);
    g->counts.of[step.outcome]++;
    if (step.outcome == PAIR_ADDED) {
        add_pairs(g, params->strategy, step.element);
    }
    step.waiting = g->waiting;
    return step;
}

void groebner_complete(struct groebner *g, const struct groebner_params *params,
                       void (*tell)(void *data, const struct groebner *g,
                                    const struct groebner_step *step),
                       void *data)
{
    bool found = false;

    for (int i = 0; i < g->count; i++) {
        add_pairs(g, params->strategy, i);
        found |= params->until && groebner_is_free(g, i, params->until);
    }
    while (g->waiting && !found) {
        const struct groebner_step step = take_pair(g, params);
        found = params->until && step.outcome == PAIR_ADDED &&
                groebner_is_free(g, step.element, params->until);
        if (tell) {
            tell(data, g, &step);
        }
    }
}

/* --- bases --- */

/* Keeps the elements that are enough to divide by: a minimal basis. */
static void keep_minimal(struct groebner *g)
{
    int count;
    const struct polynomial **list = list_divisors(g, -1, &count);

    for (int i = 0; i < count; i++) {
        polynomial_swap(&g->elements[i], &g->elements[list[i] - g->elements], g->ring);
    }
    for (int i = count; i < g->count; i++) {
        polynomial_clear(&g->elements[i], g->ring);
    }
    g->count = count;
    free(list);
}

static void sort(struct groebner *g)
{
    for (int i = 1; i < g->count; i++) {
        for (int k = i; k > 0; k--) {
            exponents a, b;
            leading(g, k - 1, a);
            leading(g, k, b);
            if (order_compare(&g->ring->order, a, b) > 0) {
                polynomial_swap(&g->elements[k - 1], &g->elements[k], g->ring);
            }
        }
    }
}

void groebner_reduce(struct groebner *g)
{
    keep_minimal(g);
    for (int i = 0; i < g->count; i++) {
        reduce(g, &g->elements[i], i, NULL);
    }
    sort(g);
}

bool groebner_is_basis(const struct groebner *g)
{
    struct polynomial s;
    bool basis = true;

    polynomial_init(&s, g->ring);
    for (int j = 0; j < g->count; j++) {
        for (int i = 0; basis && i < j; i++) {
            polynomial_s(&s, &g->elements[i], &g->elements[j], g->ring);
            reduce(g, &s, -1, NULL);
            basis = polynomial_terms(&s, g->ring) == 0;
        }
    }
    polynomial_clear(&s, g->ring);
    return basis;
}
