/* SPDX-License-Identifier: MIT */
#include "picture_oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "drawing.h"

static const struct oracle_bounds exact = {
    .overlap = 0.995, .depths = 0.005, .normals = 0.02, .ids = 0.01};
static const struct oracle_bounds coarse = {
    .overlap = 0.995, .depths = 1, .normals = 1, .ids = 0.01};

static bool is_near(const struct oracle_found *found, double depth, double footprint)
{
    const double off = fabs(depth - found->t);

    return off <= 1e-3 * found->t || off * found->slant <= footprint;
}

struct oracle *picture_oracle_create(const char *path, int every)
{
    const struct oracle_params params = {.width = PICTURE_ORACLE_WIDTH / every,
                                         .height = PICTURE_ORACLE_HEIGHT / every,
                                         .every = every,
                                         .tolerance = 1e-6,
                                         .end_of_sight = 0.95,
                                         .degrees = 5,
                                         .is_near = is_near};
    struct scene *scene = drawing_read(path);
    struct oracle *oracle = oracle_create(scene, &params);

    scene_destroy(scene);
    return oracle;
}

struct oracle_tally picture_oracle_judge(const struct oracle *oracle, struct renderer *renderer,
                                         const char *path)
{
    struct resident *resident = drawing_resident(renderer, path);
    const struct oracle_tally tally = oracle_judge(oracle, renderer, resident);

    resident_destroy(resident);
    return tally;
}

bool picture_oracle_agrees(const char *path, const struct oracle_tally *tally, bool rough)
{
    return oracle_agrees(path, tally, rough ? &coarse : &exact, false);
}

void picture_oracle_assert(struct renderer *renderer, const char *path, int every, bool rough)
{
    struct oracle *oracle = picture_oracle_create(path, every);
    const struct oracle_tally tally = picture_oracle_judge(oracle, renderer, path);
    const int places = PICTURE_ORACLE_WIDTH / every * (PICTURE_ORACLE_HEIGHT / every);

    oracle_destroy(oracle);
    assert_true(tally.either > places / 4);
    assert_true(picture_oracle_agrees(path, &tally, rough));
}
