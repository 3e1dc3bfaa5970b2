/* SPDX-License-Identifier: MIT */
/* Orders of monomials by their axioms, division by its identity, bases by Buchberger's theorem: all
 * S-polynomials reduce to 0, whatever the order of generators, the strategy and the criteria. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/algebra/groebner.h"
#include "renderer/algebra/ideal.h"

enum { LETTERS = 4, ROUNDS = 1000, SMALL_PRIME = 32003 };

static uint64_t seed = 1;

static ulong below(ulong limit)
{
    seed = seed * 6364136223846793005U + 1442695040888963407U;
    return (ulong)(seed >> 33) % limit;
}

/* --- orders --- */

static const struct order_params orders[] = {
    {ORDER_LEX, LETTERS, 0, {0}},          {ORDER_GRLEX, LETTERS, 0, {0}},
    {ORDER_GREVLEX, LETTERS, 0, {0}},      {ORDER_GREVLEX, LETTERS, 2, {0}},
    {ORDER_GRLEX, LETTERS, 1, {0}},        {ORDER_LEX, LETTERS, 3, {0}},
    {ORDER_LEX, LETTERS, 0, {3, 1, 2, 5}}, {ORDER_GREVLEX, LETTERS, 2, {1, 1, 3, 3}},
};
enum { ORDERS = sizeof orders / sizeof orders[0] };

static void random_monomial(exponents out)
{
    memset(out, 0, LIMIT_GROEBNER_LETTERS * sizeof *out);
    for (int i = 0; i < LETTERS; i++) {
        out[i] = below(3) ? below(6) : 0;
    }
}

static void check_axioms(const struct order *order)
{
    exponents a, b, c, left = {0}, right = {0}, one = {0};

    random_monomial(a);
    random_monomial(b);
    random_monomial(c);
    for (int i = 0; i < LETTERS; i++) {
        left[i] = a[i] + c[i];
        right[i] = b[i] + c[i];
    }
    const int ab = order_compare(order, a, b), bc = order_compare(order, b, c);
    assert_int_equal(ab, -order_compare(order, b, a));
    assert_int_equal(ab == 0, memcmp(a, b, sizeof a) == 0);
    assert_int_equal(ab, order_compare(order, left, right));
    assert_true(order_compare(order, one, a) <= 0);
    assert_true(ab > 0 || bc > 0 || order_compare(order, a, c) <= 0);
}

static void orders_are_admissible(void **state)
{
    (void)state;
    for (int i = 0; i < ORDERS; i++) {
        struct order order;
        order_make(&order, &orders[i]);
        for (int n = 0; n < ROUNDS; n++) {
            check_axioms(&order);
        }
    }
}

/* The definitions themselves, without a matrix. */
static int compare_by_definition(enum order_kind kind, const exponents a, const exponents b)
{
    ulong left = 0, right = 0;

    for (int i = 0; i < LETTERS; i++) {
        left += a[i];
        right += b[i];
    }
    if (kind != ORDER_LEX && left != right) {
        return left < right ? -1 : 1;
    }
    for (int i = 0; kind != ORDER_GREVLEX && i < LETTERS; i++) {
        if (a[i] != b[i]) {
            return a[i] < b[i] ? -1 : 1;
        }
    }
    for (int i = LETTERS - 1; kind == ORDER_GREVLEX && i >= 0; i--) {
        if (a[i] != b[i]) {
            return a[i] > b[i] ? -1 : 1;
        }
    }
    return 0;
}

static void orders_are_those_of_their_names(void **state)
{
    (void)state;
    for (int kind = 0; order_names[kind]; kind++) {
        struct order order;
        order_make(&order, &(struct order_params){(enum order_kind)kind, LETTERS, 0, {0}});
        for (int n = 0; n < ROUNDS; n++) {
            exponents a, b;
            random_monomial(a);
            random_monomial(b);
            assert_int_equal(order_compare(&order, a, b),
                             compare_by_definition((enum order_kind)kind, a, b));
        }
    }
}

static void letters_that_are_eliminated_are_above(void **state)
{
    (void)state;
    for (int i = 0; i < ORDERS; i++) {
        struct order order;
        order_make(&order, &orders[i]);
        for (int n = 0; n < ROUNDS && !orders[i].weights[0]; n++) {
            exponents a, b;
            random_monomial(a);
            random_monomial(b);
            memset(b, 0, (size_t)orders[i].eliminate * sizeof b[0]);
            ulong eliminated = 0;
            for (int k = 0; k < orders[i].eliminate; k++) {
                eliminated += a[k];
            }
            assert_true(!eliminated || order_compare(&order, a, b) > 0);
        }
    }
}

/* --- polynomials --- */

/* Terms with random coefficients, in FLINT's own ring of the letters. */
static void random_polynomial(fmpz_mpoly_t out, const fmpz_mpoly_ctx_t plain, int terms)
{
    fmpz_mpoly_zero(out, plain);
    for (int n = 0; n < terms; n++) {
        exponents a;
        random_monomial(a);
        fmpz_mpoly_push_term_si_ui(out, (slong)below(19) - 9, a, plain);
    }
    fmpz_mpoly_sort_terms(out, plain);
    fmpz_mpoly_combine_like_terms(out, plain);
}

static void set_random(struct polynomial *out, const struct ring *ring, int terms)
{
    fmpz_mpoly_ctx_t plain;
    fmpz_mpoly_t f;

    fmpz_mpoly_ctx_init(plain, LETTERS, ORD_LEX);
    fmpz_mpoly_init(f, plain);
    do {
        random_polynomial(f, plain, terms);
        polynomial_set(out, f, plain, ring);
    } while (polynomial_terms(out, ring) == 0);
    fmpz_mpoly_clear(f, plain);
    fmpz_mpoly_ctx_clear(plain);
}

static void terms_fall(const struct polynomial *f, const struct ring *ring)
{
    for (slong n = 1; n < polynomial_terms(f, ring); n++) {
        exponents a, b;
        polynomial_exponents(f, n - 1, ring, a);
        polynomial_exponents(f, n, ring, b);
        assert_true(order_compare(&ring->order, a, b) > 0);
    }
}

static bool is_multiple(const exponents a, const exponents b)
{
    for (int i = 0; i < LETTERS; i++) {
        if (a[i] < b[i]) {
            return false;
        }
    }
    return true;
}

static void rest_is_reduced(const struct polynomial *rest, const struct polynomial *divisor,
                            const struct ring *ring)
{
    exponents leading;

    polynomial_exponents(divisor, 0, ring, leading);
    for (slong n = 0; n < polynomial_terms(rest, ring); n++) {
        exponents a;
        polynomial_exponents(rest, n, ring, a);
        assert_false(is_multiple(a, leading));
    }
}

/* scale f - quotients * divisors - rest */
static void identity_holds(const struct division *d, const struct polynomial *f,
                           const struct polynomial *const *divisors, const struct ring *ring)
{
    struct polynomial sum;
    nmod_mpoly_t residue;
    fmpz_mpoly_t whole;

    polynomial_init(&sum, ring);
    nmod_mpoly_init(residue, ring->residues);
    fmpz_mpoly_init(whole, ring->whole);
    fmpz_mpoly_scalar_mul_fmpz(sum.whole, f->whole, d->scale, ring->whole);
    nmod_mpoly_set(sum.residues, f->residues, ring->residues);
    for (int i = 0; i < d->count; i++) {
        fmpz_mpoly_mul(whole, d->quotients[i].whole, divisors[i]->whole, ring->whole);
        fmpz_mpoly_sub(sum.whole, sum.whole, whole, ring->whole);
        nmod_mpoly_mul(residue, d->quotients[i].residues, divisors[i]->residues, ring->residues);
        nmod_mpoly_sub(sum.residues, sum.residues, residue, ring->residues);
    }
    assert_true(fmpz_mpoly_equal(sum.whole, d->rest.whole, ring->whole));
    assert_true(nmod_mpoly_equal(sum.residues, d->rest.residues, ring->residues));
    nmod_mpoly_clear(residue, ring->residues);
    fmpz_mpoly_clear(whole, ring->whole);
    polynomial_clear(&sum, ring);
}

static void divide_once(const struct ring *ring)
{
    struct polynomial f, g[2];
    struct division division;
    const struct polynomial *divisors[] = {&g[0], &g[1]};

    polynomial_init(&f, ring), polynomial_init(&g[0], ring), polynomial_init(&g[1], ring);
    set_random(&f, ring, 8), set_random(&g[0], ring, 3), set_random(&g[1], ring, 3);
    terms_fall(&f, ring);
    division_init(&division, 2, ring);
    polynomial_divide(&division, &f, divisors, ring);
    identity_holds(&division, &f, divisors, ring);
    rest_is_reduced(&division.rest, &g[0], ring);
    rest_is_reduced(&division.rest, &g[1], ring);
    division_clear(&division, ring);
    polynomial_clear(&f, ring), polynomial_clear(&g[0], ring), polynomial_clear(&g[1], ring);
}

static void division_leaves_no_multiple(void **state)
{
    (void)state;
    for (int i = 0; i < ORDERS; i++) {
        for (int n = 0; n < 40; n++) {
            struct ring ring;
            ring_init(&ring, &orders[i], n % 2 ? SMALL_PRIME : 0);
            divide_once(&ring);
            ring_clear(&ring);
        }
    }
}

/* --- bases --- */

/* Cyclic roots, Katsura's magnets, Whitney's umbrella, the example of 2.8 in the book, 1 in
 * disguise, and one that makes pairs which the second criterion leaves out. */
static const char *const ideals[] = {
    "a+b+c\na*b+b*c+c*a\na*b*c-1",
    "a+2*b+2*c-1\na^2+2*b^2+2*c^2-a\n2*a*b+2*b*c-b",
    "x-s*t\ny-s\nz-t^2",
    "x^2+y^2+z^2-1\nx^2+z^2-y\nx-z",
    "x^2*y-1\nx*y^2-x\nx^3-y\nx-2",
    "x^2*y-z^2\nx*y^2-z\ny^3-x*z\nx*z^2-y",
};
enum { IDEALS = sizeof ideals / sizeof ideals[0] };

struct making {
    struct ideal ideal;
    struct ring ring;
    struct groebner g;
};

/* What sugar is: the degree that it would have with a letter more that makes all homogeneous. */
static void no_sugar_is_below_the_degree(void *data, const struct groebner *g,
                                         const struct groebner_step *step)
{
    (void)data;
    assert_true(step->sugar >= step->degree && step->sugar < 1000);
    if (step->outcome == PAIR_ADDED) {
        assert_true(g->sugar[step->element] >=
                    polynomial_degree(&g->elements[step->element], g->ring));
    }
}

/* `turn`: the generator that comes first. */
static void make_basis(struct making *m, const char *text, enum order_kind kind, ulong prime,
                       int turn, const struct groebner_params *params)
{
    struct record asked;
    struct error err = {0};
    struct polynomial f;

    record_init(&asked, &ideal_type);
    record_put_text(&asked, "generators", text);
    record_put(&asked, "order", kind);
    record_put(&asked, "prime", (double)prime);
    assert_true(ideal_read(&m->ideal, &asked, &err));
    record_finish(&asked);
    ring_init(&m->ring, &m->ideal.order, m->ideal.prime);
    groebner_init(&m->g, &m->ring);
    polynomial_init(&f, &m->ring);
    for (int i = 0; i < m->ideal.count; i++) {
        polynomial_set(&f, m->ideal.generators[(i + turn) % m->ideal.count], m->ideal.plain,
                       &m->ring);
        groebner_add(&m->g, &f);
    }
    polynomial_clear(&f, &m->ring);
    groebner_complete(&m->g, params, no_sugar_is_below_the_degree, NULL);
    groebner_reduce(&m->g);
}

static void making_clear(struct making *m)
{
    groebner_clear(&m->g);
    ring_clear(&m->ring);
    ideal_clear(&m->ideal);
}

/* The caller frees it. */
static char *print_basis(const struct making *m)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    for (int i = 0; i < m->g.count; i++) {
        polynomial_print(&m->g.elements[i], m->ideal.letters, &m->ring, out);
        fputc('\n', out);
    }
    fclose(out);
    return text;
}

static char *basis_of(const char *text, enum order_kind kind, int turn,
                      const struct groebner_params *params, struct groebner_counts *out_counts)
{
    struct making m;

    make_basis(&m, text, kind, 0, turn, params);
    assert_true(groebner_is_basis(&m.g));
    *out_counts = m.g.counts;
    char *printed = print_basis(&m);
    making_clear(&m);
    return printed;
}

static size_t divided(const struct groebner_counts *counts)
{
    return counts->of[PAIR_ZERO] + counts->of[PAIR_ADDED];
}

static void same_by_all_roads(const char *text, enum order_kind kind)
{
    struct groebner_counts counts, all;
    char *expected = basis_of(text, kind, 0, &(struct groebner_params){0}, &all);

    for (int road = 0; road < 12; road++) {
        const struct groebner_params params = {.strategy = (enum pair_strategy)(road % 3),
                                               .coprime = road / 3 % 2 != 0,
                                               .chain = road / 6 != 0};
        char *found = basis_of(text, kind, road, &params, &counts);
        assert_string_equal(found, expected);
        assert_true(params.coprime || counts.of[PAIR_COPRIME] == 0);
        assert_true(params.chain || counts.of[PAIR_CHAIN] == 0);
        assert_int_equal(counts.pairs,
                         divided(&counts) + counts.of[PAIR_COPRIME] + counts.of[PAIR_CHAIN]);
        free(found);
    }
    free(expected);
}

static void bases_are_the_same_by_all_roads(void **state)
{
    (void)state;
    for (int i = 0; i < IDEALS; i++) {
        for (int kind = 0; order_names[kind]; kind++) {
            same_by_all_roads(ideals[i], (enum order_kind)kind);
        }
    }
}

static void each_criterion_saves_divisions(void **state)
{
    size_t saved[2] = {0};
    (void)state;

    for (int i = 0; i < IDEALS; i++) {
        struct groebner_counts none, one;
        free(basis_of(ideals[i], ORDER_GREVLEX, 0, &(struct groebner_params){0}, &none));
        for (int k = 0; k < 2; k++) {
            free(basis_of(ideals[i], ORDER_GREVLEX, 0,
                          &(struct groebner_params){.coprime = k == 0, .chain = k == 1}, &one));
            assert_true(divided(&one) <= divided(&none));
            saved[k] += divided(&none) - divided(&one);
        }
    }
    assert_true(saved[0] > 0 && saved[1] > 0);
}

/* Reduction modulo a prime that divides no coefficient on the way is a homomorphism. */
static void bases_modulo_a_prime_are_those_of_the_rationals(void **state)
{
    (void)state;
    for (int i = 0; i < IDEALS; i++) {
        struct making rational, modular;
        const struct groebner_params params = {.coprime = true, .chain = true};
        make_basis(&rational, ideals[i], ORDER_GREVLEX, 0, 0, &params);
        make_basis(&modular, ideals[i], ORDER_GREVLEX, SMALL_PRIME, 0, &params);
        assert_int_equal(rational.g.count, modular.g.count);
        for (int n = 0; n < rational.g.count; n++) {
            struct polynomial residue;
            fmpz_mpoly_t plain;
            fmpz_mpoly_init(plain, rational.ideal.plain);
            polynomial_init(&residue, &modular.ring);
            polynomial_get(plain, rational.ideal.plain, &rational.g.elements[n], &rational.ring);
            polynomial_set(&residue, plain, modular.ideal.plain, &modular.ring);
            polynomial_normalize(&residue, &modular.ring);
            assert_true(nmod_mpoly_equal(residue.residues, modular.g.elements[n].residues,
                                         modular.ring.residues));
            polynomial_clear(&residue, &modular.ring);
            fmpz_mpoly_clear(plain, rational.ideal.plain);
        }
        making_clear(&rational);
        making_clear(&modular);
    }
}

/* Cox, Little, O'Shea, 2.8, example 2. */
static void a_basis_of_the_book(void **state)
{
    struct groebner_counts counts;
    (void)state;
    char *text = basis_of(ideals[3], ORDER_LEX, 0, &(struct groebner_params){0}, &counts);

    assert_string_equal(text, "4*z^4 + 2*z^2 - 1\ny - 2*z^2\nx - z\n");
    free(text);
}

/* Not numbers, names that the line defines, or functions. */
static void letters_are_those_of_the_generators(void **state)
{
    static const struct {
        const char *generators, *letters;
    } rows[] = {{"1e3*x - 2.5E1y + .5e-1*z", "x y z"},
                {"0x - y", "x y"},
                {"r := x^2 + y^2; r^2 - r*z", "x y z"},
                {"r := x^2; r - y\nr2 := y; r - r2", "r x y"},
                {"x(y + 1) - a(b)", "a b x y"},
                {"x(y + 1) = x", "x y"},
                {"_a1 - x2", "_a1 x2"}};
    (void)state;

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct ideal ideal;
        struct record asked;
        struct error err = {0};
        char found[64] = "";
        record_init(&asked, &ideal_type);
        record_put_text(&asked, "generators", rows[i].generators);
        assert_true(ideal_read(&ideal, &asked, &err));
        for (int k = 0; ideal.letters[k]; k++) {
            const size_t used = strlen(found);
            snprintf(found + used, sizeof found - used, "%s%s", used ? " " : "", ideal.letters[k]);
        }
        assert_string_equal(found, rows[i].letters);
        ideal_clear(&ideal);
        record_finish(&asked);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orders_are_admissible),
        cmocka_unit_test(orders_are_those_of_their_names),
        cmocka_unit_test(letters_that_are_eliminated_are_above),
        cmocka_unit_test(division_leaves_no_multiple),
        cmocka_unit_test(bases_are_the_same_by_all_roads),
        cmocka_unit_test(each_criterion_saves_divisions),
        cmocka_unit_test(bases_modulo_a_prime_are_those_of_the_rationals),
        cmocka_unit_test(a_basis_of_the_book),
        cmocka_unit_test(letters_are_those_of_the_generators),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
