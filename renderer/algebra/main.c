/* SPDX-License-Identifier: MIT */
/* fieldcast-algebra X Y Z: the equation of a parametric surface and its certificate as JSON, or
 * {"error": {kind, place, line, column, message}}. A program of its own: FLINT ends the process
 * when memory is short, and no other program links it. server/algebra.h starts it, within limits.
 */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "certificate.h"
#include "coefficients.h"
#include "degree.h"
#include "protocol/equation.h"
#include "protocol/json.h"

struct result {
    struct patch_degrees degrees;
    fmpz_mpoly_ctx_t space;
    fmpz_mpoly_t equation;
    int primes;
    bool irreducible;
};

static bool implicitize(const struct patch *patch, struct result *out, struct error *err)
{
    flint_rand_t random;
    flint_randinit(random);
    bool ok = patch_find_degrees(patch, random, &out->degrees, err) &&
              patch_find_equation(patch, out->degrees.surface, random, out->equation, out->space,
                                  &out->primes, err);
    flint_randclear(random);
    if (ok && !certificate_is_zero(patch, out->equation, out->space)) {
        ok = error_set(err, ERROR_INTERNAL, "", "the equation that was found is not exact");
    }
    out->irreducible = ok && certificate_is_irreducible(out->equation, out->space);
    return ok;
}

static cJSON *certificate(const struct result *result, const char *const texts[3])
{
    const double seconds = (double)clock() / CLOCKS_PER_SEC;
    cJSON *json = cJSON_CreateObject();
    cJSON_AddStringToObject(json, "method", "nullspace");
    cJSON_AddItemToObject(json, "parametric", cJSON_CreateStringArray(texts, 3));
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
    cJSON_AddNumberToObject(json, "primes", result->primes);
    cJSON_AddNumberToObject(json, "cpu_ms", (double)(long)(seconds * 1000));
    cJSON_AddStringToObject(json, "library", "flint " FLINT_VERSION);
    return json;
}

/* What the language of equations says of this text, "" where it can be drawn. */
static void check_drawable(const char *text, cJSON *json)
{
    static const char *const none[] = {NULL};
    struct equation_errors errors = {0};
    struct equation *equation =
        strlen(text) <= LIMIT_EQUATION_BYTES ? equation_read(text, none, &errors) : NULL;
    cJSON_AddBoolToObject(json, "drawable", equation != NULL);
    if (!equation) {
        cJSON_AddStringToObject(
            json, "why", errors.count ? errors.list[0].message : "more text than equation_bytes");
    }
    free(equation);
}

static cJSON *answer(const struct result *result, const char *const texts[3])
{
    static const char *axes[] = {"x", "y", "z"};
    char *equation = fmpz_mpoly_get_str_pretty(result->equation, axes, result->space);
    cJSON *json = cJSON_CreateObject();
    cJSON_AddStringToObject(json, "equation", equation);
    cJSON_AddItemToObject(json, "certificate", certificate(result, texts));
    check_drawable(equation, json);
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

static cJSON *find_equation(const char *const texts[3])
{
    struct error err = {0};
    struct patch patch;
    struct result result = {0};
    if (!patch_read(&patch, texts, &err)) {
        return answer_error(&err);
    }
    fmpz_mpoly_ctx_init(result.space, 3, ORD_DEGLEX);
    fmpz_mpoly_init(result.equation, result.space);
    cJSON *json = implicitize(&patch, &result, &err) ? answer(&result, texts) : answer_error(&err);
    fmpz_mpoly_clear(result.equation, result.space);
    fmpz_mpoly_ctx_clear(result.space);
    patch_clear(&patch);
    return json;
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fputs("usage: fieldcast-algebra X Y Z\n", stderr);
        return 2;
    }
    const char *const texts[] = {argv[1], argv[2], argv[3]};
    cJSON *json = find_equation(texts);
    char *text = json_print(json, false);
    puts(text);
    free(text);
    cJSON_Delete(json);
    flint_cleanup_master();
    return 0;
}
