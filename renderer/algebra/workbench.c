/* SPDX-License-Identifier: MIT */
#include "workbench.h"

#include <stdlib.h>
#include <time.h>

#include "ideal.h"
#include "protocol/json.h"
#include "protocol/memory.h"

enum { STEPS_TOLD = 2000, STEPS_APART = 100, TEXT_BYTES = 4096 };

/* --- texts --- */

struct names {
    const char *const *letters;
    const struct ring *ring;
};

/* As JSON text; a long polynomial is cut off, with its number of terms. */
static cJSON *print(const struct polynomial *f, const struct names *names)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    polynomial_print(f, names->letters, names->ring, out);
    fclose(out);
    if (length > TEXT_BYTES) {
        size_t end = TEXT_BYTES;
        while (end > 0 && text[end] != ' ') {
            end--;
        }
        snprintf(text + end, length - end, " ...");
    }
    cJSON *json = cJSON_CreateString(text);
    free(text);
    return json;
}

static cJSON *print_leading(const struct polynomial *f, const struct names *names)
{
    char text[256];
    exponents a;
    FILE *out = fmemopen(text, sizeof text, "w");

    polynomial_exponents(f, 0, names->ring, a);
    monomial_print(a, names->letters, names->ring->order.letters, out);
    fclose(out);
    return cJSON_CreateString(text);
}

/* {"text", "leading", "terms", "degree"} */
static cJSON *describe(const struct polynomial *f, const struct names *names)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddItemToObject(json, "text", print(f, names));
    cJSON_AddItemToObject(json, "leading", print_leading(f, names));
    cJSON_AddNumberToObject(json, "terms", (double)polynomial_terms(f, names->ring));
    cJSON_AddNumberToObject(json, "degree", (double)polynomial_degree(f, names->ring));
    return json;
}

cJSON *workbench_counts(const struct groebner_counts *counts)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddNumberToObject(json, "made", (double)counts->pairs);
    for (int i = 0; i < PAIR_OUTCOMES; i++) {
        cJSON_AddNumberToObject(json, outcome_names[i], (double)counts->of[i]);
    }
    cJSON_AddNumberToObject(json, "divisions", (double)counts->divisions);
    cJSON_AddNumberToObject(json, "degree", (double)counts->degree);
    return json;
}

/* --- steps --- */

struct telling {
    FILE *out;
    const struct names *names;
    int steps;
};

static void tell(void *data, const struct groebner *g, const struct groebner_step *step)
{
    struct telling *telling = data;
    const bool added = step->outcome == PAIR_ADDED;

    if (telling->steps++ >= STEPS_TOLD && telling->steps % STEPS_APART) {
        return;
    }
    cJSON *json = cJSON_CreateObject();
    cJSON_AddItemToObject(json, "pair", cJSON_CreateIntArray((const int[]){step->i, step->j}, 2));
    cJSON_AddStringToObject(json, "outcome", outcome_names[step->outcome]);
    cJSON_AddNumberToObject(json, "degree", (double)step->degree);
    cJSON_AddNumberToObject(json, "sugar", (double)step->sugar);
    cJSON_AddNumberToObject(json, "divisions", (double)step->divisions);
    cJSON_AddNumberToObject(json, "waiting", (double)step->waiting);
    if (added) {
        const struct polynomial *f = &g->elements[step->element];
        cJSON_AddNumberToObject(json, "element", step->element);
        cJSON_AddItemToObject(json, "leading", print_leading(f, telling->names));
        cJSON_AddNumberToObject(json, "terms", (double)polynomial_terms(f, g->ring));
    }
    char *text = json_print(json, false);
    fprintf(telling->out, "%s\n", text);
    fflush(telling->out);
    free(text);
    cJSON_Delete(json);
}

/* --- the answer --- */

static cJSON *list_elements(const struct groebner *g, int without, const struct names *names)
{
    cJSON *list = cJSON_CreateArray();

    for (int i = 0; i < g->count; i++) {
        if (groebner_is_free(g, i, without)) {
            cJSON_AddItemToArray(list, describe(&g->elements[i], names));
        }
    }
    return list;
}

static void add_division(cJSON *json, const struct ideal *ideal, const struct groebner *g,
                         const struct names *names)
{
    struct polynomial f;
    struct division division;
    const struct polynomial **divisors = memory_alloc((size_t)g->count + 1, sizeof(void *));

    for (int i = 0; i < g->count; i++) {
        divisors[i] = &g->elements[i];
    }
    polynomial_init(&f, g->ring);
    polynomial_set(&f, ideal->dividend, ideal->plain, g->ring);
    division_init(&division, g->count, g->ring);
    polynomial_divide(&division, &f, divisors, g->ring);
    fmpz_mul(division.scale, division.scale, ideal->denominator);
    char *scale = fmpz_get_str(NULL, 10, division.scale);
    cJSON_AddStringToObject(json, "scale", scale);
    cJSON *quotients = cJSON_AddArrayToObject(json, "quotients");
    for (int i = 0; i < g->count; i++) {
        cJSON_AddItemToArray(quotients, print(&division.quotients[i], names));
    }
    cJSON_AddItemToObject(json, "rest", print(&division.rest, names));
    flint_free(scale);
    division_clear(&division, g->ring);
    polynomial_clear(&f, g->ring);
    free(divisors);
}

static cJSON *answer(const struct ideal *ideal, const struct groebner *g, const struct names *names)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddItemToObject(json, "letters",
                          cJSON_CreateStringArray(ideal->letters, ideal->order.letters));
    cJSON_AddItemToObject(json, "basis", list_elements(g, 0, names));
    if (ideal->order.eliminate) {
        cJSON_AddItemToObject(json, "elimination", list_elements(g, ideal->order.eliminate, names));
    }
    if (ideal->divides) {
        add_division(json, ideal, g, names);
    }
    cJSON_AddItemToObject(json, "counts", workbench_counts(&g->counts));
    cJSON_AddNumberToObject(json, "cpu_ms", (double)clock() * 1000 / CLOCKS_PER_SEC);
    return json;
}

static void add_generators(const struct ideal *ideal, struct groebner *g)
{
    struct polynomial f;

    polynomial_init(&f, g->ring);
    for (int i = 0; i < ideal->count; i++) {
        polynomial_set(&f, ideal->generators[i], ideal->plain, g->ring);
        groebner_add(g, &f);
    }
    polynomial_clear(&f, g->ring);
}

static struct groebner_params read_params(const struct record *asked)
{
    const enum criteria criteria = (enum criteria)record_number(asked, "criteria");

    return (struct groebner_params){
        .strategy = (enum pair_strategy)record_number(asked, "strategy"),
        .coprime = criteria == CRITERIA_BOTH || criteria == CRITERIA_COPRIME,
        .chain = criteria == CRITERIA_BOTH || criteria == CRITERIA_CHAIN};
}

cJSON *workbench_basis(const struct record *asked, FILE *steps, struct error *err)
{
    struct ideal ideal;
    struct ring ring;
    struct groebner g;

    if (!ideal_read(&ideal, asked, err)) {
        return NULL;
    }
    ring_init(&ring, &ideal.order, ideal.prime);
    groebner_init(&g, &ring);
    add_generators(&ideal, &g);
    const struct names names = {ideal.letters, &ring};
    struct telling telling = {steps, &names, 0};
    const struct groebner_params params = read_params(asked);
    groebner_complete(&g, &params, tell, &telling);
    groebner_reduce(&g);
    cJSON *json = answer(&ideal, &g, &names);
    groebner_clear(&g);
    ring_clear(&ring);
    ideal_clear(&ideal);
    return json;
}
