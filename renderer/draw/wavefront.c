/* SPDX-License-Identifier: MIT */
#include "wavefront.h"

#include "tile_clock.h"

void wavefront_mark(struct wavefront *wavefront, enum frame_stage stage)
{
    tile_clock_mark(wavefront->gl, wavefront->software, wavefront->slot, stage);
}

/* --- the passes of one wavefront --- */

/* Which samples, and where time goes. */
struct ray_batch {
    enum pass_mode mode;
    enum target_list list; /* of PASS_LIST */
    bool follows;          /* the rays are no first ones: all time is FRAME_RAYS */
};

static const struct ray_batch whole_tile = {.mode = PASS_TILE};

static struct dispatch_args dispatch_of(const struct wavefront *w, const struct ray_batch *batch)
{
    struct dispatch_args dispatch = w->tile;

    dispatch.mode = batch->mode;
    dispatch.list = w->targets->lists[batch->list];
    return dispatch;
}

static void mark(struct wavefront *w, const struct ray_batch *batch, enum frame_stage stage)
{
    wavefront_mark(w, batch->follows ? FRAME_RAYS : stage);
}

static void run_field(const struct wavefront *w, enum program_stage stage,
                      const struct ray_batch *batch)
{
    const struct dispatch_args dispatch = dispatch_of(w, batch);

    pass_compute(
        program_pass(w->program, stage), w->gl, &dispatch,
        PASS_ARGS(struct sample_args, .sample_index = w->sample, .first = !batch->follows));
}

static void run_static(const struct wavefront *w, enum static_pass pass,
                       const struct ray_batch *batch, struct pass_args args)
{
    const struct dispatch_args dispatch = dispatch_of(w, batch);

    pass_compute(&w->static_programs->passes[pass], w->gl, &dispatch, args);
}

static bool is_empty(const struct wavefront *w, enum target_list list)
{
    uint32_t head[4] = {0};

    if (!w->software) {
        return false; /* asking would wait for the device; nothing is soon done */
    }
    w->gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, w->targets->lists[list]);
    w->gl->GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof head, head);
    return head[3] == 0;
}

static void find_coarsely(struct wavefront *w)
{
    targets_bind_field(w->targets, w->gl, &w->targets->eye);
    run_field(w, STAGE_MARCH, &(struct ray_batch){.mode = PASS_COARSE});
}

static void find(struct wavefront *w, const struct ray_batch *batch)
{
    const struct ray_set *eye = &w->targets->eye;

    targets_bind_static(w->targets, w->gl, eye, eye);
    run_static(w, STATIC_CAMERA, batch, PASS_ARGS(struct sample_args, .sample_index = w->sample));
    if (w->sample == 0) {
        find_coarsely(w);
    }
    targets_bind_field(w->targets, w->gl, eye);
    run_field(w, STAGE_MARCH, batch);
    mark(w, batch, FRAME_MARCH);
}

static void find_material(struct wavefront *w, const struct ray_batch *batch)
{
    targets_bind_field(w->targets, w->gl, &w->targets->eye);
    run_field(w, STAGE_MATERIAL, batch);
    mark(w, batch, FRAME_MATERIAL);
}

/* From all samples of the batch to one light, through what is transmissive. */
static void transmit_light(struct wavefront *w, const struct ray_batch *batch, int light)
{
    const struct targets *targets = w->targets;
    const struct ray_set *eye = &targets->eye, *own = &targets->light;
    struct ray_batch on = {.mode = PASS_LIST, .list = LIST_TRANSMISSION, .follows = true};
    enum target_list next = LIST_TRANSMISSION_NEXT;

    targets_bind_static(targets, w->gl, eye, own);
    targets_begin_list(targets, w->gl, on.list);
    run_static(w, STATIC_TRANSMISSION, batch,
               PASS_ARGS(struct transmission_args, .light = light, .phase = TRANSMISSION_AIM));
    for (int i = 1; i <= w->settings->transmission_depth && !is_empty(w, on.list); i++) {
        const enum target_list before = on.list;

        targets_bind_field(targets, w->gl, own);
        run_field(w, STAGE_MARCH, &on);
        run_field(w, STAGE_MATERIAL, &on);
        targets_bind_static(targets, w->gl, own, own);
        targets_begin_list(targets, w->gl, next);
        const int phase =
            i == w->settings->transmission_depth ? TRANSMISSION_END : TRANSMISSION_STEP;
        run_static(w, STATIC_TRANSMISSION, &on,
                   PASS_ARGS(struct transmission_args, .light = light, .phase = phase));
        on.list = next;
        next = before;
    }
    wavefront_mark(w, FRAME_RAYS);
}

static void find_shadow(struct wavefront *w, const struct ray_batch *batch)
{
    targets_bind_field(w->targets, w->gl, &w->targets->eye);
    run_field(w, STAGE_SHADOW, batch);
    mark(w, batch, FRAME_SHADOW);
    for (int i = 0; i < w->lights && w->transmissive && w->settings->transmission_depth > 0; i++) {
        transmit_light(w, batch, i);
    }
}

static void add_light(struct wavefront *w, const struct ray_batch *batch, bool last)
{
    const struct ray_set *eye = &w->targets->eye;

    if (w->settings->volumes) {
        targets_bind_field(w->targets, w->gl, eye);
        run_field(w, STAGE_VOLUME, batch);
        mark(w, batch, FRAME_VOLUME);
    }
    targets_bind_static(w->targets, w->gl, eye, eye);
    run_static(w, w->settings->reflective ? STATIC_SHADE : STATIC_PLAIN, batch,
               PASS_ARGS(struct shade_args, .first = !batch->follows, .last = last,
                         .volumes = w->settings->volumes));
    mark(w, batch, FRAME_SHADE);
}

/* All reflected and refracted rays of the samples, one of each sample in a batch. */
static void follow(struct wavefront *w)
{
    struct ray_batch on = {.mode = PASS_LIST, .list = LIST_RAYS, .follows = true};
    enum target_list next = LIST_RAYS_NEXT;

    for (int i = 1; i <= w->settings->rays && !is_empty(w, on.list); i++) {
        const enum target_list before = on.list;

        targets_bind_field(w->targets, w->gl, &w->targets->eye);
        run_field(w, STAGE_MARCH, &on);
        run_field(w, STAGE_MATERIAL, &on);
        find_shadow(w, &on);
        targets_begin_list(w->targets, w->gl, next);
        add_light(w, &on, i == w->settings->rays);
        on.list = next;
        next = before;
    }
}

static void accumulate(struct wavefront *w, const struct ray_batch *batch)
{
    targets_bind_static(w->targets, w->gl, &w->targets->eye, &w->targets->eye);
    run_static(w, STATIC_ACCUMULATE, batch,
               PASS_ARGS(struct accumulate_args, .sample_index = w->sample));
    mark(w, batch, FRAME_SHADE);
}

static void shade(struct wavefront *w, const struct ray_batch *batch)
{
    targets_begin_list(w->targets, w->gl, LIST_RAYS);
    add_light(w, batch, w->settings->rays == 0);
    follow(w);
    accumulate(w, batch);
}

/* --- what draw.c asks for --- */

void wavefront_find(struct wavefront *w, enum program_stage last)
{
    find(w, &whole_tile);
    if (last >= STAGE_MATERIAL) {
        find_material(w, &whole_tile);
    }
}

void wavefront_shadow(struct wavefront *w)
{
    find_shadow(w, &whole_tile);
}

void wavefront_shade(struct wavefront *w)
{
    shade(w, &whole_tile);
}

void wavefront_detect_edges(struct wavefront *w)
{
    targets_bind_static(w->targets, w->gl, &w->targets->eye, &w->targets->eye);
    targets_begin_list(w->targets, w->gl, LIST_EDGES);
    run_static(w, STATIC_EDGE_DETECT, &whole_tile,
               PASS_ARGS(struct listing_args, .width = w->tile.width, .height = w->tile.height));
    wavefront_mark(w, FRAME_RESOLVE);
}

void wavefront_resume(struct wavefront *w, int samples)
{
    find_coarsely(w);
    wavefront_mark(w, FRAME_MARCH);
    if (w->settings->antialiasing == ANTIALIASING_ADAPTIVE) {
        targets_bind_static(w->targets, w->gl, &w->targets->eye, &w->targets->eye);
        targets_begin_list(w->targets, w->gl, LIST_EDGES);
        run_static(w, STATIC_RESAMPLE, &whole_tile,
                   PASS_ARGS(struct listing_args, .width = w->tile.width, .height = w->tile.height,
                             .samples = samples));
        wavefront_mark(w, FRAME_RESOLVE);
    }
}

bool wavefront_resample(struct wavefront *w, int sample)
{
    const bool adaptive = w->settings->antialiasing == ANTIALIASING_ADAPTIVE;
    const struct ray_batch batch = {.mode = adaptive ? PASS_LIST : PASS_TILE, .list = LIST_EDGES};

    if (adaptive && is_empty(w, LIST_EDGES)) {
        return false;
    }
    w->sample = sample;
    find(w, &batch);
    find_material(w, &batch);
    find_shadow(w, &batch);
    shade(w, &batch);
    return true;
}
