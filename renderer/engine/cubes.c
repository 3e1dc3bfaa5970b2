/* SPDX-License-Identifier: MIT */
#include "cubes.h"

#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "matches.h"
#include "protocol/memory.h"

enum { KEPT = 4 }; /* at most */
/* Of programs of one scene fewer operations are others. */
enum { OTHER_PART = 4 };
/* Cubes take at most these parts of the memory there is, and of what the process may take. */
enum { MEMORY_PART = 8, ALLOWED_PART = 4 };

struct kept {
    struct cubes *cubes;            /* NULL: nothing is here */
    struct engine_program *program; /* counted */
    size_t bytes;
};

struct engine_cubes {
    struct kept kept[KEPT]; /* the last one first */
    uint32_t pictures;      /* that began */
};

struct engine_cubes *engine_cubes_create(void)
{
    return memory_alloc(1, sizeof(struct engine_cubes));
}

/* All but what threads share. */
static void forget_own(struct cubes *cubes)
{
    for (int i = 0; i < ENGINE_THREADS; i++) {
        cells_finish(cubes->of[i]);
        noted_finish(&cubes->noted[i]);
        cubes->noted[i] = (struct noted){0};
        for (int k = 0; k < ENGINE_SPACES; k++) {
            cubes->of[i][k] = (struct cells){.trunk = cubes->trunk};
        }
    }
    seen_finish(&cubes->seen);
}

static void cubes_destroy(struct cubes *cubes)
{
    if (cubes) {
        forget_own(cubes);
        trunk_destroy(cubes->trunk);
        free(cubes->params);
    }
    free(cubes);
}

static void drop(struct kept *kept)
{
    cubes_destroy(kept->cubes);
    engine_program_destroy(kept->program);
    *kept = (struct kept){0};
}

void engine_cubes_forget(struct engine_cubes *cubes)
{
    for (int i = 0; i < KEPT; i++) {
        drop(&cubes->kept[i]);
    }
}

void engine_cubes_destroy(struct engine_cubes *cubes)
{
    if (cubes) {
        engine_cubes_forget(cubes);
        free(cubes);
    }
}

/* --- numbers --- */

static size_t numbers_bytes(const struct engine_program *program)
{
    return 4 * program->field->vec4_count * sizeof(float);
}

/* To other numbers of the same program, where few operations have others. */
static bool change(struct cubes *cubes, struct engine_program *program, const float *params)
{
    struct material_set materials = {{0}};
    uint8_t *changed = changes_of_operations(program, cubes->params, params);
    const size_t count = changed ? changes_count(program, changed) : 0;

    if (!changed || changes_are_many(program, count)) {
        free(changed);
        return false;
    }
    cubes->edit++;
    changes_of_materials(program->field, cubes->params, program->field, params, &materials);
    seen_repaint(&cubes->seen, &materials);
    if (count > 0) {
        if (cubes->trunk) {
            trunk_end(cubes->trunk);
        }
        program->width->renew(program, cubes, params, changed, NULL);
    }
    free(changed);
    memcpy(cubes->params, params, numbers_bytes(program));
    return true;
}

/* --- another program --- */

/* Whether so few operations are in one alone that they are of the same scene. */
static bool are_near(size_t fresh, const struct engine_program *before,
                     const struct engine_program *after)
{
    const size_t lost = before->count + fresh - after->count;

    return fresh <= after->count / OTHER_PART && lost <= before->count / OTHER_PART;
}

/* Squares of pictures stay where nothing in them has another number, and rays step as before. */
static void keep_seen(struct cubes *cubes, const struct engine_program *before,
                      const struct engine_picture *picture, bool renumbered)
{
    const struct engine_program *after = picture->program;
    const bool same_steps = (before->count > BOUND_TAPE) == (after->count > BOUND_TAPE);
    struct material_set materials = {{0}};

    if (!renumbered && same_steps &&
        changes_of_materials(before->field, cubes->params, picture->program->field, picture->params,
                             &materials)) {
        seen_repaint(&cubes->seen, &materials);
    } else {
        seen_finish(&cubes->seen);
    }
}

/* After an edit of more than numbers, where few operations are new. */
static bool follow(struct kept *one, const struct engine_picture *picture)
{
    struct engine_program *program = picture->program;
    const struct matches_side before = {one->program, one->cubes->params};
    const struct matches_side after = {program, picture->params};
    struct cubes *cubes = one->cubes;
    struct matches matches;

    if (one->program->width != program->width) {
        return false;
    }
    matches_find(&before, &after, &matches);
    const bool follows = are_near(matches.fresh, one->program, program);
    if (follows) {
        cubes->edit++;
        keep_seen(cubes, one->program, picture, matches.renumbered);
        if (cubes->trunk) {
            trunk_rename(cubes->trunk, &matches);
            trunk_end(cubes->trunk);
        }
        program->width->renew(program, cubes, picture->params, matches.changed, &matches);
        cubes->params = memory_resize(cubes->params, numbers_bytes(program), 1);
        memcpy(cubes->params, picture->params, numbers_bytes(program));
    }
    matches_finish(&matches);
    return follows;
}

/* --- those that are kept --- */

static bool is_same(const struct kept *one, const float *params)
{
    return memcmp(one->cubes->params, params, numbers_bytes(one->program)) == 0;
}

/* How much of a picture is known: less with each condition that fails. */
static int value_of(const struct kept *one, const struct engine_picture *picture)
{
    return one->program != picture->program
               ? 0
               : 1 + is_same(one, picture->params) + 2 * seen_has(&one->cubes->seen, picture);
}

static struct cubes *create(const struct engine_picture *picture)
{
    struct cubes *cubes = memory_alloc(1, sizeof *cubes);

    cubes->params = memory_alloc(numbers_bytes(picture->program), 1);
    memcpy(cubes->params, picture->params, numbers_bytes(picture->program));
    if (picture->program->count >= TRUNK_TAPE) {
        cubes->trunk = trunk_create();
    }
    for (int i = 0; i < ENGINE_THREADS * ENGINE_SPACES; i++) {
        cubes->of[i / ENGINE_SPACES][i % ENGINE_SPACES].trunk = cubes->trunk;
    }
    return cubes;
}

/* Those of this program that fit the picture best; NULL: there are none. */
static struct kept *find_own(struct engine_cubes *kept, const struct engine_picture *picture)
{
    struct kept *best = NULL;
    int most = 0;

    for (int i = 0; i < KEPT; i++) {
        const int value = value_of(&kept->kept[i], picture);
        if (value > most) {
            best = &kept->kept[i];
            most = value;
        }
    }
    return best;
}

static struct kept *find_followed(struct engine_cubes *kept, const struct engine_picture *picture)
{
    for (int i = 0; i < KEPT; i++) {
        if (kept->kept[i].cubes && follow(&kept->kept[i], picture)) {
            return &kept->kept[i];
        }
    }
    return NULL;
}

static bool fits(const struct kept *one, const struct engine_picture *picture)
{
    return is_same(one, picture->params) || change(one->cubes, picture->program, picture->params);
}

struct cubes *cubes_take(struct engine_cubes *kept, const struct engine_picture *picture,
                         uint32_t *out_picture)
{
    struct kept *best = find_own(kept, picture);
    const uint32_t edit = best ? best->cubes->edit : 0;

    *out_picture = ++kept->pictures;
    if (best ? !fits(best, picture) : !(best = find_followed(kept, picture))) {
        return create(picture);
    }
    struct cubes *cubes = best->cubes;
    cubes->renewed = cubes->edit != edit;
    best->cubes = NULL;
    drop(best);
    return cubes;
}

static size_t bytes_of(const struct cubes *cubes, const struct engine_program *program)
{
    size_t bytes = numbers_bytes(program) + seen_bytes(&cubes->seen) + trunk_bytes(cubes->trunk);

    for (int i = 0; i < ENGINE_THREADS; i++) {
        bytes += noted_bytes(&cubes->noted[i]);
    }
    for (int i = 0; i < ENGINE_THREADS * ENGINE_SPACES; i++) {
        const struct cells *cells = &cubes->of[i / ENGINE_SPACES][i % ENGINE_SPACES];
        bytes += cells->capacity * (sizeof *cells->at + sizeof *cells->news) +
                 cells->room * sizeof *cells->tapes + cells->drops_room * sizeof *cells->drops;
    }
    return bytes;
}

size_t cubes_bytes_most(void)
{
    const size_t memory = (size_t)sysconf(_SC_PHYS_PAGES) * (size_t)sysconf(_SC_PAGESIZE);
    size_t most = LIMIT_CUBES_BYTES;
    struct rlimit limit;

    if (memory / MEMORY_PART < most) {
        most = memory / MEMORY_PART;
    }
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur / ALLOWED_PART < most) {
        most = limit.rlim_cur / ALLOWED_PART;
    }
    return most;
}

void cubes_give(struct engine_cubes *kept, struct engine_program *program, struct cubes *cubes)
{
    const size_t most = cubes_bytes_most();
    size_t bytes = 0;

    if (bytes_of(cubes, program) > most) {
        seen_finish(&cubes->seen);
    }
    if (cubes->trunk && !trunk_has_ended(cubes->trunk) && bytes_of(cubes, program) > most) {
        forget_own(cubes);
    }
    drop(&kept->kept[KEPT - 1]);
    memmove(&kept->kept[1], &kept->kept[0], (KEPT - 1) * sizeof kept->kept[0]);
    kept->kept[0] = (struct kept){cubes, engine_program_ref(program), bytes_of(cubes, program)};
    for (int i = 0; i < KEPT; i++) {
        bytes += kept->kept[i].bytes;
        if (bytes > most) {
            drop(&kept->kept[i]);
        }
    }
}
