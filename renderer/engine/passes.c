/* SPDX-License-Identifier: MIT */
/* The samples of a part of a tile: passes over its pixels, of many steps, each of a few vectors of
 * rays. Drawing may pause after any step, so that it stops within a fraction of a millisecond; what
 * is drawn stays in the hand. */

enum { LISTED_STEP = 8 * LANES }; /* pixels */

/* --- steps --- */

static void add_row(struct hand *hand, int number)
{
    const int y = number * (LANES / ACROSS);

    for (int x = 0; x < hand->width; x += ACROSS) {
        const vi left = x + lanes_number % ACROSS, top = y + lanes_number / ACROSS;
        add_sample(hand, (left < hand->width) & (top < hand->height), left, top, hand->pass.number);
    }
}

static void add_listed(struct hand *hand, int number)
{
    const int until = smaller((number + 1) * LISTED_STEP, hand->listed_count);

    for (int i = number * LISTED_STEP; i < until; i += LANES) {
        vi at = vi_zero;
        for (int k = 0; k < LANES && i + k < until; k++) {
            at[k] = hand->listed[i + k];
        }
        add_sample(hand, i + lanes_number < until, at % SIDE, at / SIDE, hand->pass.number);
    }
}

#include "sparse.c"

/* --- passes --- */

static int parts_of(int whole, int part)
{
    return (whole + part - 1) / part;
}

static struct pass pass_over_all(const struct hand *hand, int number)
{
    return (struct pass){number, parts_of(hand->height, LANES / ACROSS), 0, add_row};
}

static struct pass pass_over_listed(const struct hand *hand, int number)
{
    return (struct pass){number, parts_of(hand->listed_count, LISTED_STEP), 0, add_listed};
}

static bool is_sparse(const struct hand *hand)
{
    return hand->canvas->picture.sparse && hand->work->from == 0;
}

static struct pass sparse_pass(struct hand *hand, int number)
{
    if (number == 0) {
        list_corners(hand);
        return pass_over_listed(hand, number);
    }
    return (struct pass){number, parts_of(hand->height - 1, SPARSE_STEP), 0, draw_blocks};
}

/* One for each sample of the pixels. */
static struct pass pass_of(struct hand *hand, int number)
{
    const struct engine_work *work = hand->work;

    if (number == 0 || hand->canvas->picture.smoothing != ENGINE_ADAPTIVE) {
        return pass_over_all(hand, number);
    }
    if (work->from > 0 && number == work->from) {
        list_again(hand, number);
    } else if (number == 1) {
        list_edges(hand);
    }
    return pass_over_listed(hand, number);
}

static void begin_pass(struct hand *hand, int number)
{
    hand->pass = is_sparse(hand) ? sparse_pass(hand, number) : pass_of(hand, number);
}

static int count_passes(const struct hand *hand)
{
    return is_sparse(hand) ? SPARSE_PASSES : hand->work->until;
}

static void begin_samples(struct hand *hand)
{
    if (hand->work->from == 0) {
        memset(hand->pixels, 0, sizeof hand->pixels);
        memset(hand->counted, 0, sizeof hand->counted);
    } else {
        keep(hand, true);
    }
    begin_pass(hand, hand->work->from);
}

/* Asked after each step: whether this thread shall stop for now, with all others. */
static bool is_paused(struct hand *hand)
{
    const struct engine_pause *pause = hand->work->pause;

    if (!atomic_load(hand->paused) && pause->wanted && pause->wanted(pause->data)) {
        atomic_store(hand->paused, true);
    }
    return atomic_load(hand->paused);
}

/* False: a pause came first. Each call does a step at least. */
static bool draw_samples(struct hand *hand)
{
    const int passes = count_passes(hand);

    while (hand->pass.number < passes) {
        if (hand->pass.done < hand->pass.steps) {
            hand->pass.step(hand, hand->pass.done++);
            if (is_paused(hand)) {
                return false;
            }
        } else if (hand->pass.number + 1 < passes) {
            begin_pass(hand, hand->pass.number + 1);
        } else {
            hand->pass.number++;
        }
    }
    return true;
}
