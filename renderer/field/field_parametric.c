/* SPDX-License-Identifier: MIT */
/* Parametric surfaces: from a node to numbers, of which the last few are kept. */
#include "field_parametric.h"

#include <assert.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "renderer/sdf/patches.h"

enum { KEPT = 8 };

bool parametric_source_of(const struct node *node, struct parametric_source *out)
{
    const struct record *params = &node->params;
    struct error err;

    *out = (struct parametric_source){.json = cJSON_Parse(record_text(params, "surface"))};
    if (!out->json || !surface_read(&out->surface, out->json, "", &err) || !out->surface.parts[0]) {
        cJSON_Delete(out->json);
        return false;
    }
    for (int i = 0; equation_letters[i]; i++) {
        out->letters[i] = record_number(params, equation_letters[i]);
    }
    out->levels = PATCHES_LEVELS_MIN + (int)record_number(params, "detail");
    return true;
}

/* --- those that are kept --- */

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static struct parametric_numbers *kept[KEPT];
static uint64_t uses;

static void unuse(struct parametric_numbers *surface)
{
    if (surface && --surface->users == 0) {
        free((double *)surface->numbers);
        free(surface->key);
        free(surface);
    }
}

void parametric_release(struct parametric_numbers *surface)
{
    pthread_mutex_lock(&lock);
    unuse(surface);
    pthread_mutex_unlock(&lock);
}

/* The caller is one more user. */
static struct parametric_numbers *recall(const char *key)
{
    struct parametric_numbers *found = NULL;

    pthread_mutex_lock(&lock);
    for (int i = 0; i < KEPT && !found; i++) {
        found = kept[i] && strcmp(kept[i]->key, key) == 0 ? kept[i] : NULL;
    }
    if (found) {
        found->users++;
        found->used = ++uses;
    }
    pthread_mutex_unlock(&lock);
    return found;
}

/* In the place of the one that was not asked for the longest. */
static void keep(struct parametric_numbers *surface)
{
    int oldest = 0;

    pthread_mutex_lock(&lock);
    for (int i = 0; i < KEPT; i++) {
        const uint64_t used = kept[i] ? kept[i]->used : 0;
        oldest = used < (kept[oldest] ? kept[oldest]->used : 0) ? i : oldest;
    }
    unuse(kept[oldest]);
    kept[oldest] = surface;
    surface->users++;
    surface->used = ++uses;
    pthread_mutex_unlock(&lock);
}

/* All that the numbers depend on. The caller frees it. */
static char *make_key(const struct node *node, const struct parametric_source *from)
{
    char *key = NULL;
    size_t length;
    FILE *out = open_memstream(&key, &length);

    if (!out) {
        abort();
    }
    fprintf(out, "%s %d %a", record_text(&node->params, "surface"), from->levels,
            record_number(&node->params, "thickness"));
    for (int i = 0; i < EQUATION_LETTERS; i++) {
        fprintf(out, " %a", from->letters[i]);
    }
    fclose(out);
    return key;
}

/* --- made --- */

static void fail_part(struct builder *b, const struct node *node, int part,
                      const struct equation_errors *errors)
{
    struct error err = {0};
    char place[ERROR_PLACE_BYTES];

    snprintf(place, sizeof place, "/nodes/%s/params/surface/%s", node->id, surface_names[part]);
    equation_errors_tell(errors, ERROR_COMPILE, "", &err);
    builder_fail(b, &err, place);
}

static bool check_operations(struct builder *b, const struct node *node,
                             const struct surface_reading *reading)
{
    struct error err = {0};
    char place[ERROR_PLACE_BYTES];
    size_t count = 0;

    for (int i = 0; i < SURFACE_PARTS; i++) {
        count += reading->parts[i]->count;
    }
    if (count > LIMIT_EQUATION_OPERATIONS) {
        snprintf(place, sizeof place, "/nodes/%s/params/surface", node->id);
        error_set(&err, ERROR_LIMIT, "",
                  "%zu different operations are above the maximum %d (equation_operations)", count,
                  LIMIT_EQUATION_OPERATIONS);
        builder_fail(b, &err, place);
    }
    return count <= LIMIT_EQUATION_OPERATIONS;
}

/* The reading is finished. */
static struct parametric_numbers *make(const struct node *node,
                                       const struct parametric_source *from,
                                       struct surface_reading *reading, const char *key)
{
    struct parametric_numbers *made = memory_alloc(1, sizeof *made);
    const int across = patches_points(from->levels);
    const size_t rows = patches_rows(from->levels);
    double *points = memory_alloc(3 * (size_t)across * (size_t)across, sizeof *points);
    double *numbers = memory_alloc(4 * rows, sizeof *numbers);

    surface_points(reading, from->letters, across, points);
    surface_reading_finish(reading);
    const struct bounds box =
        patches_write(from->levels, record_number(&node->params, "thickness"), points, numbers);
    free(points);
    *made = (struct parametric_numbers){
        .numbers = numbers, .rows = rows, .box = box, .key = memory_text(key), .users = 1};
    return made;
}

static struct parametric_numbers *read_and_make(struct builder *b, const struct node *node,
                                                const struct parametric_source *from,
                                                const char *key)
{
    struct surface_reading reading;
    struct equation_errors errors;
    int part;

    if (!surface_reading_init(&reading, &from->surface, &part, &errors)) {
        fail_part(b, node, part, &errors);
        return NULL;
    }
    if (!check_operations(b, node, &reading)) {
        surface_reading_finish(&reading);
        return NULL;
    }
    struct parametric_numbers *made = make(node, from, &reading, key);
    keep(made);
    return made;
}

/* All surfaces of a field have so many numbers at most. One that is patched has what it had. */
static bool take_rows(struct builder *b, const struct node *node, int levels)
{
    struct error err = {0};
    char place[ERROR_PLACE_BYTES];

    b->surface_rows += b->again ? 0 : patches_rows(levels);
    if (b->surface_rows <= LIMIT_SURFACE_ROWS) {
        return true;
    }
    snprintf(place, sizeof place, "/nodes/%s/params/detail", node->id);
    error_set(&err, ERROR_LIMIT, "",
              "the parametric surfaces up to here take %zu vectors of four numbers, above the "
              "maximum %d (surface_rows); %zu are of this one",
              b->surface_rows, LIMIT_SURFACE_ROWS, patches_rows(levels));
    builder_fail(b, &err, place);
    return false;
}

struct parametric_numbers *parametric_numbers_of(struct builder *b, const struct node *node)
{
    struct parametric_numbers *numbers = NULL;
    struct parametric_source from;

    if (b->failed || !parametric_source_of(node, &from)) {
        return NULL;
    }
    if (take_rows(b, node, from.levels)) {
        char *key = make_key(node, &from);
        numbers = recall(key);
        numbers = numbers ? numbers : read_and_make(b, node, &from, key);
        free(key);
    }
    cJSON_Delete(from.json);
    return numbers;
}
