/* SPDX-License-Identifier: MIT */
#include "ideal.h"

#include <ctype.h>
#include <flint/ulong_extras.h>
#include <stdlib.h>
#include <string.h>

#include "expression.h"
#include "protocol/memory.h"

/* --- letters --- */

static bool is_name_part(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

/* The next name at or behind `at`; NULL: there is none. The e of 1e3 is none. */
static const char *next_name(const char *at, size_t *out_length)
{
    double number;

    while (*at && (!is_name_part(*at) || isdigit((unsigned char)*at))) {
        if (!equation_number(at, &number, &at)) {
            at++;
        }
    }
    *out_length = 0;
    while (is_name_part(at[*out_length])) {
        ++*out_length;
    }
    return *at ? at : NULL;
}

/* x, y and z come behind all others. */
static int compare_names(const void *a, const void *b)
{
    const char *const *left = a, *const *right = b;
    const bool last[] = {strchr("xyz", **left) && !(*left)[1],
                         strchr("xyz", **right) && !(*right)[1]};
    return last[0] != last[1] ? (int)last[0] - (int)last[1] : strcmp(*left, *right);
}

static bool is_letter(const struct ideal *ideal, const char *name)
{
    for (int i = 0; ideal->letters[i]; i++) {
        if (strcmp(ideal->letters[i], name) == 0) {
            return true;
        }
    }
    return false;
}

static bool is_defined_at(const char *name, size_t length)
{
    const char *behind = name + length + strspn(name + length, " \t");

    return strncmp(behind, ":=", 2) == 0;
}

/* By this line of the text, up to here. */
static bool is_defined(const char *text, const char *name, size_t length)
{
    const char *line = name;
    size_t other;

    while (line > text && line[-1] != '\n') {
        line--;
    }
    for (const char *at = line; (at = next_name(at, &other)) && at <= name; at += other) {
        if (other == length && memcmp(at, name, length) == 0 && is_defined_at(at, length)) {
            return true;
        }
    }
    return false;
}

/* A longer name than one letter before a parenthesis is a function. */
static bool is_function(const char *name, size_t length)
{
    return name[length] == '(' && length > 1;
}

/* The names in the text that neither stand for something else nor are functions. */
static bool add_letters(struct ideal *out, const char *text, struct error *err)
{
    size_t length, used = 0;

    out->names = memory_alloc(strlen(text) + 2, 1);
    for (const char *at = text; (at = next_name(at, &length)); at += length) {
        char *name = out->names + used;
        memcpy(name, at, length);
        name[length] = '\0';
        if (is_letter(out, name) || is_function(at, length) || is_defined(text, at, length)) {
            continue;
        }
        if (out->order.letters == LIMIT_GROEBNER_LETTERS) {
            return error_set(err, ERROR_LIMIT, "/letters",
                             "more than %d letters (groebner_letters)", LIMIT_GROEBNER_LETTERS);
        }
        out->letters[out->order.letters++] = name;
        used += length + 1;
    }
    return out->order.letters > 0 ||
           error_set(err, ERROR_INVALID, "/letters", "an ideal needs a letter");
}

static bool read_letters(struct ideal *out, const struct record *asked, struct error *err)
{
    if (record_text(asked, "letters")[0]) {
        return add_letters(out, record_text(asked, "letters"), err);
    }
    if (!add_letters(out, record_text(asked, "generators"), err)) {
        return false;
    }
    qsort(out->letters, (size_t)out->order.letters, sizeof out->letters[0], compare_names);
    return true;
}

static bool read_weights(struct ideal *out, const char *text, struct error *err)
{
    int count = 0;

    for (const char *at = text + strspn(text, " "); *at; count++) {
        char *end;
        const unsigned long weight = strtoul(at, &end, 10);
        if (!isdigit((unsigned char)*at) || weight > LIMIT_PARAMETRIC_DEGREE ||
            count == out->order.letters) {
            return error_set(err, ERROR_INVALID, "/weights",
                             "weights are %d whole numbers up to %d, one for each letter",
                             out->order.letters, LIMIT_PARAMETRIC_DEGREE);
        }
        out->order.weights[count] = (unsigned)weight;
        at = end + strspn(end, " ");
    }
    return count == 0 || count == out->order.letters ||
           error_set(err, ERROR_INVALID, "/weights", "%d weights for %d letters", count,
                     out->order.letters);
}

static bool read_order(struct ideal *out, const struct record *asked, struct error *err)
{
    out->order.kind = (enum order_kind)record_number(asked, "order");
    out->order.eliminate = (int)record_number(asked, "eliminate");
    out->prime = (ulong)record_number(asked, "prime");
    if (out->prime && !n_is_prime(out->prime)) {
        return error_set(err, ERROR_INVALID, "/prime", "%lu is no prime", out->prime);
    }
    if (out->order.eliminate > out->order.letters) {
        return error_set(err, ERROR_INVALID, "/eliminate", "%d of %d letters", out->order.eliminate,
                         out->order.letters);
    }
    return read_weights(out, record_text(asked, "weights"), err);
}

/* --- polynomials --- */

static bool fail_at(struct error *err, const char *place)
{
    snprintf(err->place, sizeof err->place, "%s", place);
    return false;
}

static bool fail_in_line(struct error *err, int line)
{
    err->line = line;
    err->column = 1;
    return false;
}

struct reading {
    const struct ideal *ideal;
    struct error *err;
};

static bool leaf(void *data, const struct equation_node *node, struct fraction *out)
{
    const struct reading *r = data;

    if (node->op != EQUATION_LETTER) {
        return expression_refuse(node, r->err);
    }
    fmpz_mpoly_gen(out->over, node->which, r->ideal->plain);
    return true;
}

static bool check_prime(const struct ideal *ideal, const fmpz_t denominator, struct error *err)
{
    return !ideal->prime || fmpz_fdiv_ui(denominator, ideal->prime) != 0 ||
           error_set(err, ERROR_INVALID, "", "a denominator is 0 modulo %lu", ideal->prime);
}

static bool subtract_sides(const struct reading *r, const struct equation *equation,
                           fmpz_mpoly_t out, fmpz_t out_denominator)
{
    const fmpz_mpoly_ctx_struct *ring = r->ideal->plain;
    const struct expression e = {equation, ring, leaf, (void *)r, r->err};
    struct fraction left, right;

    fraction_init(&left, ring), fraction_init(&right, ring);
    bool ok = expression_value(&e, equation->left, &left) &&
              expression_value(&e, equation->right, &right);
    if (ok) {
        fraction_negate(&right, &right, ring);
        ok = fraction_add(&left, &left, &right, ring, r->err);
    }
    if (ok && !fmpz_mpoly_is_fmpz(left.under, ring)) {
        ok = error_set(r->err, ERROR_INVALID, "",
                       "a fraction is no polynomial: multiply by its denominator");
    }
    if (ok) {
        fmpz_mpoly_get_fmpz(out_denominator, left.under, ring);
        ok = check_prime(r->ideal, out_denominator, r->err);
    }
    fmpz_mpoly_swap(out, left.over, ring);
    fraction_clear(&left, ring), fraction_clear(&right, ring);
    return ok;
}

/* `line`: where the polynomial stands in the text. Its value is `out` / `out_denominator`. */
static bool read_polynomial(const struct ideal *ideal, const char *text, int line, fmpz_mpoly_t out,
                            fmpz_t out_denominator, struct error *err)
{
    struct equation_errors errors = {0};
    struct reading r = {ideal, err};

    if (!expression_check_digits(text, "", err)) {
        return fail_in_line(err, line);
    }
    struct equation *equation = equation_read_relation(text, ideal->letters, &errors);

    if (!equation) {
        return equation_errors_tell(&errors, ERROR_INVALID, "", err);
    }
    const bool ok = equation->relation == EQUATION_EQUALS
                        ? subtract_sides(&r, equation, out, out_denominator)
                        : error_set(err, ERROR_INVALID, "", "an inequality is no polynomial");
    free(equation);
    return ok || fail_in_line(err, line);
}

static bool add_generator(struct ideal *out, const char *text, int line, struct error *err)
{
    if (out->count == LIMIT_GROEBNER_GENERATORS) {
        return error_set(err, ERROR_LIMIT, "", "more than %d polynomials (groebner_generators)",
                         LIMIT_GROEBNER_GENERATORS);
    }
    fmpz_t denominator; /* a multiple generates the same */
    fmpz_init(denominator);
    fmpz_mpoly_init(out->generators[out->count], out->plain);
    const bool ok =
        read_polynomial(out, text, line, out->generators[out->count++], denominator, err);
    fmpz_clear(denominator);
    return ok;
}

/* Each line of the text that is not empty. Those in front of it become spaces, so that errors tell
 * lines of the whole. */
static bool read_generators(struct ideal *out, const char *all, struct error *err)
{
    char *text = memory_text(all);
    bool ok = true;
    int line = 1;

    for (char *at = text; ok && *at; line++) {
        const size_t length = strcspn(at, "\n");
        const bool last = at[length] == '\0';
        at[length] = '\0';
        ok = strspn(at, " \t\r") == length || add_generator(out, text, line, err);
        memset(at, ' ', length);
        at[length] = last ? '\0' : '\n';
        at += length + !last;
    }
    free(text);
    ok = ok && (out->count > 0 || error_set(err, ERROR_INVALID, "", "no polynomial is given"));
    return ok || fail_at(err, "/generators");
}

static bool read_dividend(struct ideal *out, const char *text, struct error *err)
{
    out->divides = text[0] != '\0';
    return !out->divides || read_polynomial(out, text, 1, out->dividend, out->denominator, err) ||
           fail_at(err, "/divide");
}

bool ideal_read(struct ideal *out, const struct record *asked, struct error *err)
{
    memset(out, 0, sizeof *out);
    if (!read_letters(out, asked, err) || !read_order(out, asked, err)) {
        free(out->names);
        return false;
    }
    fmpz_mpoly_ctx_init(out->plain, out->order.letters, ORD_LEX);
    fmpz_mpoly_init(out->dividend, out->plain);
    fmpz_init(out->denominator);
    if (!read_generators(out, record_text(asked, "generators"), err) ||
        !read_dividend(out, record_text(asked, "divide"), err)) {
        ideal_clear(out);
        return false;
    }
    return true;
}

void ideal_clear(struct ideal *ideal)
{
    for (int i = 0; i < ideal->count; i++) {
        fmpz_mpoly_clear(ideal->generators[i], ideal->plain);
    }
    fmpz_mpoly_clear(ideal->dividend, ideal->plain);
    fmpz_clear(ideal->denominator);
    fmpz_mpoly_ctx_clear(ideal->plain);
    free(ideal->names);
}
