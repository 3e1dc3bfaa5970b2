/* SPDX-License-Identifier: MIT */
/* fieldcast-algebra implicitize ASKED: a line of JSON for each step (progress.h), then the equation
 * of a parametric surface and its certificate, or {"error": {kind, place, line, column, message}}.
 * ASKED is JSON of surface_question_type. With ranges also how much of the implicit surface the
 * patch covers (coverage.h), and the patch alone as a node (trim.h).
 * fieldcast-algebra verify PARAMS: {"verdict", "reason"} of the parameters of an `implicit`, which
 * are JSON; with "coverage" where it is verified.
 * fieldcast-algebra groebner ASKED: a line of JSON for each step, then the basis (workbench.h).
 * A program of its own: FLINT ends the process when memory is short, and no other program links it.
 * server/algebra.h starts it, within limits. */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "certificate.h"
#include "coefficients.h"
#include "coverage.h"
#include "degree.h"
#include "eliminate.h"
#include "progress.h"
#include "protocol/equation.h"
#include "protocol/json.h"
#include "protocol/nodes.h"
#include "trim.h"
#include "verify.h"
#include "workbench.h"

struct question {
    struct progress progress;
    const struct record *asked; /* surface_question_type */
    const char *texts[SURFACE_PARTS];
    cJSON *parametric;
    struct surface surface; /* that, where it has ranges */
    bool ranged;
};

struct result {
    const char *method; /* of surface_methods */
    struct patch_degrees degrees;
    fmpz_mpoly_ctx_t space;
    fmpz_mpoly_t equation;
    int primes;                    /* of the null space; else 0 */
    struct groebner_counts counts; /* of a basis */
    bool irreducible;
};

static bool find(const struct patch *patch, const struct progress *progress, flint_rand_t random,
                 struct result *out, struct error *err)
{
    if (strcmp(out->method, surface_methods[SURFACE_BY_GROEBNER]) == 0) {
        return eliminate_homogeneous(patch, progress, out->equation, out->space, &out->counts, err);
    }
    if (strcmp(out->method, surface_methods[SURFACE_BY_SATURATION]) == 0) {
        return eliminate_saturated(patch, progress, out->equation, out->space, &out->counts, err);
    }
    if (strcmp(out->method, surface_methods[SURFACE_BY_RESULTANT]) == 0) {
        return eliminate_resultant(patch, out->equation, out->space, err);
    }
    return patch_find_equation(patch, out->degrees.surface, random, progress, out->equation,
                               out->space, &out->primes, err);
}

static bool find_degrees(const struct patch *patch, const struct progress *progress,
                         flint_rand_t random, struct patch_degrees *out, struct error *err)
{
    if (!patch_find_degrees(patch, random, out, err)) {
        return false;
    }
    progress_tell(progress, PROGRESS_DEGREE, out->surface, "degree %ld, map degree %ld",
                  out->surface, out->map);
    return true;
}

/* The proof, whatever found it. */
static bool prove(const struct patch *patch, const struct progress *progress, struct result *out,
                  struct error *err)
{
    if (fmpz_mpoly_total_degree_si(out->equation, out->space) != out->degrees.surface ||
        !certificate_is_zero(patch, out->equation, out->space)) {
        return error_set(err, ERROR_INTERNAL, "", "the equation that was found is not exact");
    }
    progress_tell(progress, PROGRESS_EXACT, fmpz_mpoly_length(out->equation, out->space),
                  "exact: the parts put into it give 0");
    out->irreducible = certificate_is_irreducible(out->equation, out->space);
    progress_tell(progress, PROGRESS_IRREDUCIBLE, out->irreducible, "%s",
                  out->irreducible ? "irreducible" : "not known to be irreducible");
    return true;
}

static bool implicitize(const struct patch *patch, const struct progress *progress,
                        struct result *out, struct error *err)
{
    flint_rand_t random;

    flint_randinit(random);
    const bool ok = find_degrees(patch, progress, random, &out->degrees, err) &&
                    find(patch, progress, random, out, err);
    flint_randclear(random);
    make_primitive(out->equation); /* the same by each method */
    return ok && prove(patch, progress, out, err);
}

static cJSON *letters(const struct patch *patch)
{
    cJSON *list = cJSON_CreateArray();

    for (int i = 0; i < SURFACE_LETTERS; i++) {
        if (patch->uses[i]) {
            cJSON_AddItemToArray(list, cJSON_CreateString(surface_names[SURFACE_PARTS + i]));
        }
    }
    return list;
}

static cJSON *certificate(const struct result *result, const struct patch *patch,
                          const char *const texts[SURFACE_PARTS])
{
    const double seconds = (double)clock() / CLOCKS_PER_SEC;
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "method", result->method);
    cJSON_AddItemToObject(json, "parametric", cJSON_CreateStringArray(texts, 3));
    cJSON_AddItemToObject(json, "letters", letters(patch));
    cJSON_AddNumberToObject(json, "degree", (double)result->degrees.surface);
    cJSON_AddNumberToObject(json, "terms",
                            (double)fmpz_mpoly_length(result->equation, result->space));
    cJSON_AddNumberToObject(json, "coefficient_bits",
                            (double)labs(fmpz_mpoly_max_bits(result->equation)));
    cJSON_AddNumberToObject(json, "map_degree", (double)result->degrees.map);
    cJSON_AddNumberToObject(json, "base_point_degree", (double)result->degrees.base);
    cJSON_AddNumberToObject(json, "rank", 2);
    cJSON_AddStringToObject(json, "identity", "exact");
    cJSON_AddBoolToObject(json, "irreducible", result->irreducible);
    if (result->primes) {
        cJSON_AddNumberToObject(json, "primes", result->primes);
    }
    if (result->counts.pairs) {
        cJSON_AddItemToObject(json, "pairs", workbench_counts(&result->counts));
    }
    cJSON_AddNumberToObject(json, "cpu_ms", (double)(long)(seconds * 1000));
    cJSON_AddStringToObject(json, "library", "flint " FLINT_VERSION);
    return json;
}

/* What the language of equations says of this text, "" where it can be drawn. */
static void check_drawable(const char *text, cJSON *json)
{
    struct equation_errors errors = {0};
    struct equation *equation = strlen(text) <= LIMIT_EQUATION_BYTES
                                    ? equation_read(text, equation_letters, &errors)
                                    : NULL;

    cJSON_AddBoolToObject(json, "drawable", equation != NULL);
    if (!equation) {
        cJSON_AddStringToObject(
            json, "why", errors.count ? errors.list[0].message : "more text than equation_bytes");
    }
    free(equation);
}

/* What ranges add: how much of the implicit surface the patch covers, and the patch alone. */
static void answer_ranges(const struct result *result, const struct question *question,
                          const char *equation, cJSON *json)
{
    const double *asked = record_vector(question->asked, "size");
    double size[3];
    struct equation_clip clip = {.ball = false};
    struct coverage coverage;

    coverage_size(&question->surface, size);
    for (int i = 0; i < 3; i++) {
        size[i] = asked[i] > 0 ? asked[i] : size[i];
        clip.half[i] = size[i] / 2;
    }
    coverage_measure(result->equation, result->space, &question->surface, &clip, &coverage);
    progress_tell(&question->progress, PROGRESS_COVERAGE, coverage.points,
                  "%d of %d points covered", coverage.covered, coverage.points);
    cJSON *told = coverage_answer(&coverage);
    cJSON_AddItemToObject(told, "size", cJSON_CreateDoubleArray(size, 3));
    cJSON_AddItemToObject(json, "coverage", told);
    if (cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(json, "drawable"))) {
        cJSON_AddItemToObject(json, "trimmed", trim_node(equation, question->parametric, size));
    }
}

static cJSON *answer(const struct result *result, const struct patch *patch,
                     const struct question *question)
{
    static const char *axes[] = {"x", "y", "z"};
    char *equation = fmpz_mpoly_get_str_pretty(result->equation, axes, result->space);
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "equation", equation);
    cJSON_AddItemToObject(json, "certificate", certificate(result, patch, question->texts));
    check_drawable(equation, json);
    if (question->ranged) {
        answer_ranges(result, question, equation, json);
    }
    flint_free(equation);
    return json;
}

static cJSON *answer_error(const struct error *err)
{
    cJSON *json = cJSON_CreateObject();
    cJSON *members = cJSON_AddObjectToObject(json, "error");

    cJSON_AddNumberToObject(members, "kind", err->kind);
    cJSON_AddStringToObject(members, "place", err->place);
    cJSON_AddNumberToObject(members, "line", err->line);
    cJSON_AddNumberToObject(members, "column", err->column);
    cJSON_AddStringToObject(members, "message", err->message);
    return json;
}

/* Each letter that the parts are in has to have a range. */
static bool check_ranges(const struct question *question, const struct patch *patch,
                         struct error *err)
{
    for (int i = 0; question->ranged && i < SURFACE_LETTERS; i++) {
        if (patch->uses[i] && !question->surface.ranges[i].set) {
            return error_set(err, ERROR_INVALID, surface_names[SURFACE_PARTS + i],
                             "has no range, but another letter has");
        }
    }
    return true;
}

static cJSON *find_equation(const struct question *question)
{
    struct error err = {0};
    struct patch patch;
    struct result result = {.method =
                                surface_methods[(int)record_number(question->asked, "method")]};

    if (!patch_read(&patch, question->texts, &err)) {
        return answer_error(&err);
    }
    fmpz_mpoly_ctx_init(result.space, 3, ORD_DEGLEX);
    fmpz_mpoly_init(result.equation, result.space);
    cJSON *json = check_ranges(question, &patch, &err) &&
                          implicitize(&patch, &question->progress, &result, &err)
                      ? answer(&result, &patch, question)
                      : answer_error(&err);
    fmpz_mpoly_clear(result.equation, result.space);
    fmpz_mpoly_ctx_clear(result.space);
    patch_clear(&patch);
    return json;
}

static bool read_ranges(struct question *out, struct error *err)
{
    for (int i = SURFACE_PARTS; i < SURFACE_MEMBERS; i++) {
        out->ranged = out->ranged || record_is_set(out->asked, surface_names[i]);
    }
    const bool ok = !out->ranged || surface_read(&out->surface, out->parametric, "", err);
    if (!ok && err->place[0] == '/') { /* as those of texts */
        memmove(err->place, err->place + 1, strlen(err->place));
    }
    return ok;
}

static cJSON *implicitize_asked(const char *text)
{
    struct error err = {0};
    struct record asked;
    struct question question = {.asked = &asked};
    cJSON *json = json_parse(text, strlen(text), &err);

    progress_init(&question.progress, stdout);
    record_init(&asked, &surface_question_type);
    bool ok = json && surface_question_read(&asked, json, &err);
    for (int i = 0; ok && i < SURFACE_PARTS; i++) {
        question.texts[i] = record_text(&asked, surface_names[i]);
    }
    question.parametric = surface_question_json(&asked);
    ok = ok && read_ranges(&question, &err);
    cJSON *answer = ok ? find_equation(&question) : answer_error(&err);
    cJSON_Delete(question.parametric);
    record_finish(&asked);
    cJSON_Delete(json);
    return answer;
}

/* --- proofs --- */

static cJSON *answer_verdict(const struct verdict *verdict)
{
    char *reason = NULL;
    size_t length;
    FILE *out = open_memstream(&reason, &length);

    error_print(&verdict->reason, out);
    fclose(out);
    reason[strcspn(reason, "\n")] = '\0';
    cJSON *json = cJSON_CreateObject();
    cJSON_AddStringToObject(json, "verdict", surface_verdicts[verdict->verdict]);
    cJSON_AddStringToObject(json, "reason", reason);
    free(reason);
    if (verdict->verdict == SURFACE_VERIFIED) {
        cJSON_AddItemToObject(json, "coverage", coverage_answer(&verdict->coverage));
    }
    return json;
}

static cJSON *verify_params(const char *text)
{
    struct error err = {0};
    struct record params;
    struct verdict verdict;
    cJSON *json = json_parse(text, strlen(text), &err), *answer;

    record_init(&params, &node_type_find("implicit")->record);
    if (json && record_read(&params, json, "", &err)) {
        verify(&params, &verdict);
        answer = answer_verdict(&verdict);
    } else {
        answer = answer_error(&err);
    }
    record_finish(&params);
    cJSON_Delete(json);
    return answer;
}

/* --- bases --- */

static cJSON *find_basis(const char *text)
{
    struct error err = {0};
    struct record asked;
    cJSON *json = json_parse(text, strlen(text), &err), *answer = NULL;

    record_init(&asked, &ideal_type);
    if (json && record_read(&asked, json, "", &err)) {
        answer = workbench_basis(&asked, stdout, &err);
    }
    record_finish(&asked);
    cJSON_Delete(json);
    return answer ? answer : answer_error(&err);
}

int main(int argc, char **argv)
{
    cJSON *json;

    if (argc == 3 && strcmp(argv[1], "implicitize") == 0) {
        json = implicitize_asked(argv[2]);
    } else if (argc == 3 && strcmp(argv[1], "verify") == 0) {
        json = verify_params(argv[2]);
    } else if (argc == 3 && strcmp(argv[1], "groebner") == 0) {
        json = find_basis(argv[2]);
    } else {
        fputs("usage: fieldcast-algebra implicitize ASKED | verify PARAMS | groebner ASKED\n",
              stderr);
        return 2;
    }
    char *text = json_print(json, false);
    puts(text);
    free(text);
    cJSON_Delete(json);
    flint_cleanup_master();
    return 0;
}
