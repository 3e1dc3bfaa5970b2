/* SPDX-License-Identifier: MIT */
/* Pictures drawn by fragment shaders: one program does a whole sample of each pixel of a tile. */
#include <string.h>

#include "draw_gl.h"
#include "tile_clock.h"

void draw_fragment_finish(struct draw *draw)
{
    pass_finish(&draw->mask, draw->gl);
    pass_finish(&draw->count, draw->gl);
    for (int i = 0; i < DRAW_SETS; i++) {
        fragment_targets_finish(&draw->fragment[i], draw->gl);
    }
}

bool draw_fragment_prepare(struct draw *draw, struct error *err)
{
    const struct pass_source mask = {.file = "mask_pass.glsl"}, count = {.file = "rays_pass.glsl"};
    bool ok = pass_init(&draw->mask, draw->gl, &mask, err) &&
              pass_init(&draw->count, draw->gl, &count, err);

    for (int i = 0; ok && i < DRAW_SETS; i++) {
        ok = fragment_targets_init(&draw->fragment[i], draw->gl, draw->side, err);
    }
    if (!ok) {
        draw_fragment_finish(draw);
        return false;
    }
    draw->compilations += 2;
    return true;
}

static bool begin(struct draw *draw, struct draw_picture *picture, const struct draw_scene *scene,
                  const struct frame_uniforms *block, struct error *err)
{
    (void)scene;
    return draw_gl_begin(draw, picture, SHADER_FRAGMENT, block, err);
}

static void keep_rounds(struct draw *draw, struct draw_picture *picture, struct tile region)
{
    draw_gl_keep(draw, picture, region, GL_RGBA32F);
}

/* --- a tile --- */

static const struct fragment_targets *targets_of(const struct draw *draw,
                                                 const struct draw_picture *picture)
{
    return &draw->fragment[draw_set_of(picture)];
}

static void bind(const struct draw *draw, const struct draw_picture *picture,
                 const struct draw_scene *scene)
{
    fragment_targets_bind(targets_of(draw, picture), draw->gl);
    draw_gl_bind(draw, picture, scene);
}

/* The tile's sums: from the targets, or back into them. */
static void keep(const struct draw *draw, const struct draw_picture *picture,
                 const struct tile_in_flight *slot, bool back)
{
    const GLuint *samples = targets_of(draw, picture)->samples;

    draw_gl_copy_kept(draw->gl, picture, slot->tile, samples[SAMPLE_PIXELS],
                      samples[SAMPLE_COUNTED], back);
}

static void run(const struct draw *draw, const struct draw_picture *picture,
                const struct tile_in_flight *slot, enum fragment_target target,
                const struct pass *pass, struct pass_args args)
{
    const struct dispatch_args dispatch = draw_gl_dispatch(picture, slot);

    fragment_targets_draw(targets_of(draw, picture), draw->gl, target, pass, &dispatch, args);
}

/* How far the rays of each block are free. */
static void find_starts(const struct draw *draw, const struct draw_picture *picture,
                        const struct draw_scene *scene, struct tile_in_flight *slot)
{
    run(draw, picture, slot, FRAGMENT_STARTS, program_pass(scene->program, STAGE_STARTS),
        (struct pass_args){0});
    tile_clock_mark(draw->gl, draw->software, slot, FRAME_MARCH);
}

static void add_sample(const struct draw *draw, const struct draw_picture *picture,
                       const struct draw_scene *scene, struct tile_in_flight *slot, int sample)
{
    const struct render_settings *settings = &picture->settings;
    const enum program_stage last = draw_last_stage(picture);

    run(draw, picture, slot, FRAGMENT_SAMPLES, program_pass(scene->program, STAGE_SAMPLE),
        PASS_ARGS(struct trace_args, .sample_index = sample, .rays = settings->rays,
                  .depth = picture->transmissive ? settings->transmission_depth : 0,
                  .shadows = last >= STAGE_SHADOW, .lights = last == STAGE_COUNT,
                  .masked = sample > 0 && settings->antialiasing == ANTIALIASING_ADAPTIVE));
    tile_clock_mark(draw->gl, draw->software, slot, FRAME_SHADE);
}

/* Marks the pixels that the settings sample again, of which each had `samples`; 0: one, whose edges
 * are wanted. */
static void find_edges(const struct draw *draw, const struct draw_picture *picture,
                       struct tile_in_flight *slot, int samples)
{
    const struct dispatch_args dispatch = draw_gl_dispatch(picture, slot);

    if (picture->settings.antialiasing == ANTIALIASING_ADAPTIVE) {
        run(draw, picture, slot, FRAGMENT_MASK, &draw->mask,
            PASS_ARGS(struct listing_args, .width = dispatch.width, .height = dispatch.height,
                      .samples = samples));
        tile_clock_mark(draw->gl, draw->software, slot, FRAME_RESOLVE);
    }
}

/* The number of rays in each column starts on its way back. */
static void count_rays(const struct draw *draw, const struct draw_picture *picture,
                       struct tile_in_flight *slot)
{
    const struct gl *gl = draw->gl;
    const struct dispatch_args dispatch = draw_gl_dispatch(picture, slot);

    if (slot->rays == 0) {
        gl->GenBuffers(1, &slot->rays);
        gl->BindBuffer(GL_PIXEL_PACK_BUFFER, slot->rays);
        gl->BufferData(GL_PIXEL_PACK_BUFFER, draw->side * (GLsizeiptr)sizeof(float), NULL,
                       GL_STREAM_READ);
    }
    run(draw, picture, slot, FRAGMENT_RAYS, &draw->count,
        PASS_ARGS(struct listing_args, .width = dispatch.width, .height = dispatch.height));
    draw_gl_read(gl, slot->rays, dispatch.width, 1, GL_RED, GL_FLOAT);
}

/* They are counted when a tile has all its samples. */
static bool counts_rays(const struct draw_picture *picture)
{
    return picture->settings.rays > 0 && picture->until >= picture->settings.samples;
}

/* All samples are there, or none is wanted: the tile's pixels start on their way back. */
static void finish_tile(struct draw *draw, struct draw_picture *picture,
                        struct tile_in_flight *slot)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        if (picture->formats[i]) {
            draw_gl_resolve(draw, picture, slot, &targets_of(draw, picture)->outputs,
                            picture->formats[i]);
        }
    }
    if (counts_rays(picture)) {
        count_rays(draw, picture, slot);
    }
    tile_clock_mark(draw->gl, draw->software, slot, FRAME_RESOLVE);
    if (picture->kept && picture->until < picture->settings.samples) {
        keep(draw, picture, slot, false);
    }
    draw_gl_send(draw, slot);
}

static bool draw_first(struct draw *draw, struct draw_picture *picture,
                       const struct draw_scene *scene, int index, struct error *err)
{
    struct tile_in_flight *slot = &picture->slots[index];
    const bool sampled = draw_is_sampled(picture);

    bind(draw, picture, scene);
    tile_clock_start(draw->gl, draw->software, slot);
    find_starts(draw, picture, scene, slot);
    if (picture->from > 0) {
        keep(draw, picture, slot, true);
    } else {
        fragment_targets_clear(targets_of(draw, picture), draw->gl);
        add_sample(draw, picture, scene, slot, 0);
    }
    if (sampled) {
        find_edges(draw, picture, slot, picture->from);
        slot->samples = picture->from > 0 ? picture->from : 1;
    } else {
        finish_tile(draw, picture, slot);
    }
    return gl_check(draw->gl, "drawing a tile", err);
}

static bool draw_more(struct draw *draw, struct draw_picture *picture,
                      const struct draw_scene *scene, int index, struct error *err)
{
    struct tile_in_flight *slot = &picture->slots[index];

    bind(draw, picture, scene);
    tile_clock_resume(draw->gl, draw->software, slot);
    add_sample(draw, picture, scene, slot, slot->samples);
    if (++slot->samples == picture->until) {
        finish_tile(draw, picture, slot);
    }
    return gl_check(draw->gl, "drawing a tile again", err);
}

/* --- the way back --- */

static void fetch_rays(struct draw *draw, const struct draw_picture *picture,
                       const struct tile_in_flight *slot)
{
    const struct gl *gl = draw->gl;
    const int width = draw_gl_dispatch(picture, slot).width;
    const float *columns;

    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, slot->rays);
    columns = gl->MapBufferRange(GL_PIXEL_PACK_BUFFER, 0, width * (GLsizeiptr)sizeof *columns,
                                 GL_MAP_READ_BIT);
    for (int i = 0; columns && i < width; i++) {
        draw->more_rays += (uint64_t)columns[i];
    }
    gl->UnmapBuffer(GL_PIXEL_PACK_BUFFER);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

static bool wait_for_tile(struct draw *draw, struct draw_picture *picture, int index,
                          struct error *err)
{
    struct tile_in_flight *slot = &picture->slots[index];
    const uint64_t start = draw_now_us();

    if (!draw_gl_wait(draw, slot, err)) {
        return false;
    }
    if (counts_rays(picture)) {
        fetch_rays(draw, picture, slot);
    }
    slot->stage_us[FRAME_READ] += draw_now_us() - start;
    return true;
}

const struct draw_backend draw_fragment = {
    begin, draw_gl_end, keep_rounds, draw_first, draw_more, wait_for_tile, draw_gl_collect,
};
