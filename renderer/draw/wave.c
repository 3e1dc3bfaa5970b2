/* SPDX-License-Identifier: MIT */
#include "wave.h"

#include "tile_clock.h"

void wave_mark(struct wave *wave, enum frame_stage stage)
{
    tile_clock_mark(wave->gl, wave->software, wave->slot, stage);
}

/* --- the passes of one wave --- */

/* Which samples, and where time goes. */
struct round {
    enum pass_mode mode;
    enum target_list list; /* of PASS_LIST */
    bool follows;          /* the rays are no first ones: all time is FRAME_RAYS */
};

static const struct round whole_tile = {.mode = PASS_TILE};

static struct pass_place place_of(const struct wave *w, const struct round *round)
{
    struct pass_place place = w->tile;

    place.mode = round->mode;
    place.list = w->targets->lists[round->list];
    return place;
}

static void mark(struct wave *w, const struct round *round, enum frame_stage stage)
{
    wave_mark(w, round->follows ? FRAME_RAYS : stage);
}

static void run_field(const struct wave *w, enum program_stage stage, const struct round *round)
{
    const struct pass_place place = place_of(w, round);

    pass_compute(
        program_pass(w->program, stage), w->gl, &place,
        PASS_ARGS(struct sample_args, .sample_index = w->sample, .first = !round->follows));
}

static void run_common(const struct wave *w, enum common_pass pass, const struct round *round,
                       struct pass_args args)
{
    const struct pass_place place = place_of(w, round);

    pass_compute(&w->common->passes[pass], w->gl, &place, args);
}

static bool is_empty(const struct wave *w, enum target_list list)
{
    uint32_t head[4] = {0};

    if (!w->software) {
        return false; /* asking would wait for the device; nothing is soon done */
    }
    w->gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, w->targets->lists[list]);
    w->gl->GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof head, head);
    return head[3] == 0;
}

static void find_coarsely(struct wave *w)
{
    targets_bind_field(w->targets, w->gl, &w->targets->eye);
    run_field(w, STAGE_MARCH, &(struct round){.mode = PASS_COARSE});
}

static void find(struct wave *w, const struct round *round)
{
    const struct ray_set *eye = &w->targets->eye;

    targets_bind_common(w->targets, w->gl, eye, eye);
    run_common(w, COMMON_CAMERA, round, PASS_ARGS(struct sample_args, .sample_index = w->sample));
    if (w->sample == 0) {
        find_coarsely(w);
    }
    targets_bind_field(w->targets, w->gl, eye);
    run_field(w, STAGE_MARCH, round);
    mark(w, round, FRAME_MARCH);
}

static void find_matter(struct wave *w, const struct round *round)
{
    targets_bind_field(w->targets, w->gl, &w->targets->eye);
    run_field(w, STAGE_MATTER, round);
    mark(w, round, FRAME_MATTER);
}

/* From all samples of the round to one light, through what is clear. */
static void colour_light(struct wave *w, const struct round *round, int light)
{
    const struct targets *targets = w->targets;
    const struct ray_set *eye = &targets->eye, *own = &targets->light;
    struct round on = {.mode = PASS_LIST, .list = LIST_CLEAR, .follows = true};
    enum target_list next = LIST_CLEAR_NEXT;

    targets_bind_common(targets, w->gl, eye, own);
    targets_begin_list(targets, w->gl, on.list);
    run_common(w, COMMON_CLEAR, round,
               PASS_ARGS(struct clear_args, .light = light, .phase = CLEAR_AIM));
    for (int i = 1; i <= w->plan->clear_depth && !is_empty(w, on.list); i++) {
        const enum target_list before = on.list;

        targets_bind_field(targets, w->gl, own);
        run_field(w, STAGE_MARCH, &on);
        run_field(w, STAGE_MATTER, &on);
        targets_bind_common(targets, w->gl, own, own);
        targets_begin_list(targets, w->gl, next);
        const int phase = i == w->plan->clear_depth ? CLEAR_END : CLEAR_STEP;
        run_common(w, COMMON_CLEAR, &on,
                   PASS_ARGS(struct clear_args, .light = light, .phase = phase));
        on.list = next;
        next = before;
    }
    wave_mark(w, FRAME_RAYS);
}

static void find_shadow(struct wave *w, const struct round *round)
{
    targets_bind_field(w->targets, w->gl, &w->targets->eye);
    run_field(w, STAGE_SHADOW, round);
    mark(w, round, FRAME_SHADOW);
    for (int i = 0; i < w->lights && w->clear && w->plan->clear_depth > 0; i++) {
        colour_light(w, round, i);
    }
}

static void add_light(struct wave *w, const struct round *round, bool last)
{
    const struct ray_set *eye = &w->targets->eye;

    if (w->plan->volumes) {
        targets_bind_field(w->targets, w->gl, eye);
        run_field(w, STAGE_VOLUME, round);
        mark(w, round, FRAME_VOLUME);
    }
    targets_bind_common(w->targets, w->gl, eye, eye);
    run_common(w, w->plan->mirrors ? COMMON_SHADE : COMMON_PLAIN, round,
               PASS_ARGS(struct shade_args, .first = !round->follows, .last = last,
                         .haze = w->plan->volumes));
    mark(w, round, FRAME_SHADE);
}

/* All mirrored and broken rays of the samples, one of each sample in a round. */
static void follow(struct wave *w)
{
    struct round on = {.mode = PASS_LIST, .list = LIST_RAYS, .follows = true};
    enum target_list next = LIST_RAYS_NEXT;

    for (int i = 1; i <= w->plan->rays && !is_empty(w, on.list); i++) {
        const enum target_list before = on.list;

        targets_bind_field(w->targets, w->gl, &w->targets->eye);
        run_field(w, STAGE_MARCH, &on);
        run_field(w, STAGE_MATTER, &on);
        find_shadow(w, &on);
        targets_begin_list(w->targets, w->gl, next);
        add_light(w, &on, i == w->plan->rays);
        on.list = next;
        next = before;
    }
}

static void gather(struct wave *w, const struct round *round)
{
    targets_bind_common(w->targets, w->gl, &w->targets->eye, &w->targets->eye);
    run_common(w, COMMON_GATHER, round, PASS_ARGS(struct gather_args, .sample_index = w->sample));
    mark(w, round, FRAME_SHADE);
}

static void shade(struct wave *w, const struct round *round)
{
    targets_begin_list(w->targets, w->gl, LIST_RAYS);
    add_light(w, round, w->plan->rays == 0);
    follow(w);
    gather(w, round);
}

/* --- what draw.c asks for --- */

void wave_find(struct wave *w, enum program_stage last)
{
    find(w, &whole_tile);
    if (last >= STAGE_MATTER) {
        find_matter(w, &whole_tile);
    }
}

void wave_shadow(struct wave *w)
{
    find_shadow(w, &whole_tile);
}

void wave_shade(struct wave *w)
{
    shade(w, &whole_tile);
}

void wave_find_edges(struct wave *w)
{
    targets_bind_common(w->targets, w->gl, &w->targets->eye, &w->targets->eye);
    targets_begin_list(w->targets, w->gl, LIST_EDGES);
    run_common(w, COMMON_EDGES, &whole_tile,
               PASS_ARGS(struct listing_args, .width = w->tile.width, .height = w->tile.height));
    wave_mark(w, FRAME_RESOLVE);
}

void wave_resume(struct wave *w, int samples)
{
    find_coarsely(w);
    wave_mark(w, FRAME_MARCH);
    if (w->plan->antialiasing == ANTIALIASING_ADAPTIVE) {
        targets_bind_common(w->targets, w->gl, &w->targets->eye, &w->targets->eye);
        targets_begin_list(w->targets, w->gl, LIST_EDGES);
        run_common(w, COMMON_AGAIN, &whole_tile,
                   PASS_ARGS(struct listing_args, .width = w->tile.width, .height = w->tile.height,
                             .samples = samples));
        wave_mark(w, FRAME_RESOLVE);
    }
}

bool wave_sample_again(struct wave *w, int sample)
{
    const bool adaptive = w->plan->antialiasing == ANTIALIASING_ADAPTIVE;
    const struct round round = {.mode = adaptive ? PASS_LIST : PASS_TILE, .list = LIST_EDGES};

    if (adaptive && is_empty(w, LIST_EDGES)) {
        return false;
    }
    w->sample = sample;
    find(w, &round);
    find_matter(w, &round);
    find_shadow(w, &round);
    shade(w, &round);
    return true;
}
