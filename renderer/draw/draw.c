/* SPDX-License-Identifier: MIT */
/* Passes over a tile, timing, read-back. */
#include "draw.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "protocol/memory.h"

enum {
    /* Of 64, 128, 256 and 512 none was clearly faster on two llvmpipe threads; with this one an
     * urgent picture waits for about a tenth of a second. A GPU wants more work at once. */
    TILE_SOFTWARE = 256,
    TILE_GPU = 1024,
    FENCE_WAIT_MS = 60000, /* beyond it the device is taken for lost */
};

static const struct draw_form forms[] = {
    {AOV_COLOR, false, "OUT_COLOR", OUT_BYTES, GL_RGBA, GL_UNSIGNED_BYTE, 4, true, true},
    {AOV_COLOR, true, "OUT_LINEAR", OUT_FLOATS, GL_RGBA, GL_FLOAT, 16, true, true},
    {AOV_DEPTH, false, "OUT_DEPTH", OUT_FLOATS, GL_RED, GL_FLOAT, 4, false, false},
    {AOV_DEPTH, true, "OUT_DEPTH", OUT_FLOATS, GL_RED, GL_FLOAT, 4, false, false},
    {AOV_NORMAL, false, "OUT_NORMAL", OUT_BYTES, GL_RGBA, GL_UNSIGNED_BYTE, 4, false, false},
    {AOV_NORMAL, true, "OUT_NORMAL_RAW", OUT_FLOATS, GL_RGB, GL_FLOAT, 12, false, false},
    {AOV_ID, false, "OUT_ID", OUT_BYTES, GL_RGBA, GL_UNSIGNED_BYTE, 4, true, false},
    {AOV_ID, true, "OUT_ID_RAW", OUT_UINTS, GL_RED_INTEGER, GL_UNSIGNED_INT, 4, true, false},
};
enum { FORM_COUNT = sizeof forms / sizeof forms[0] };

struct draw {
    const struct gl *gl;
    bool software;
    struct targets targets;
    struct pass resolve[FORM_COUNT]; /* linked when first needed */
    uint64_t compilations;
};

static uint64_t now_us(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000 + (uint64_t)t.tv_nsec / 1000;
}

const struct draw_form *draw_form_find(enum aov aov, bool floats)
{
    for (size_t i = 0; i < FORM_COUNT; i++) {
        if (forms[i].aov == aov && forms[i].floats == floats) {
            return &forms[i];
        }
    }
    return NULL;
}

void draw_numbers_init(struct draw_numbers *out, const struct draw *draw, const float *numbers,
                       size_t count, size_t capacity)
{
    const struct gl *gl = draw->gl;
    const bool texture = numbers_in_texture(gl, draw->software, capacity);
    const GLenum target = texture ? GL_TEXTURE_BUFFER : GL_UNIFORM_BUFFER;
    float *padded = memory_alloc(capacity, 16);

    memcpy(padded, numbers, count * 16);
    *out = (struct draw_numbers){0};
    gl->GenBuffers(1, &out->buffer);
    gl->BindBuffer(target, out->buffer);
    gl->BufferData(target, (GLsizeiptr)(16 * capacity), padded, GL_STATIC_DRAW);
    free(padded);
    if (texture) {
        gl->GenTextures(1, &out->texture);
        gl->ActiveTexture(GL_TEXTURE0 + UNIT_NUMBERS);
        gl->BindTexture(GL_TEXTURE_BUFFER, out->texture);
        gl->TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, out->buffer);
    }
}

void draw_numbers_finish(struct draw_numbers *numbers, const struct gl *gl)
{
    gl->DeleteBuffers(1, &numbers->buffer);
    gl->DeleteTextures(1, &numbers->texture);
    *numbers = (struct draw_numbers){0};
}

static void bind_numbers(const struct draw_numbers *numbers, const struct gl *gl)
{
    if (numbers->texture) {
        gl->ActiveTexture(GL_TEXTURE0 + UNIT_NUMBERS);
        gl->BindTexture(GL_TEXTURE_BUFFER, numbers->texture);
    } else {
        gl->BindBufferBase(GL_UNIFORM_BUFFER, BINDING_NUMBERS, numbers->buffer);
    }
}

struct draw *draw_create(const struct gl *gl, bool software, int tile_side, struct error *err)
{
    struct draw *draw = memory_alloc(1, sizeof *draw);
    const int side = tile_side > 0 ? tile_side : software ? TILE_SOFTWARE : TILE_GPU;

    draw->gl = gl;
    draw->software = software;
    if (!targets_init(&draw->targets, gl, side, side, err)) {
        free(draw);
        return NULL;
    }
    gl->PixelStorei(GL_PACK_ALIGNMENT, 1);
    return draw;
}

void draw_destroy(struct draw *draw)
{
    if (!draw) {
        return;
    }
    for (size_t i = 0; i < FORM_COUNT; i++) {
        pass_finish(&draw->resolve[i], draw->gl);
    }
    targets_finish(&draw->targets, draw->gl);
    free(draw);
}

void draw_tile_size(const struct draw *draw, int samples, int *out_width, int *out_height)
{
    /* Whole blocks, so that a block has the same rays whatever the size of tiles. */
    *out_width = draw->targets.width / samples / BLOCK_SIDE * BLOCK_SIDE;
    *out_height = draw->targets.height / samples / BLOCK_SIDE * BLOCK_SIDE;
}

uint64_t draw_compilations(const struct draw *draw)
{
    return draw->compilations;
}

/* The resolve pass of a form. */
static struct pass *resolve_pass(struct draw *draw, const struct draw_form *form, struct error *err)
{
    static const char *const files[] = {"frame.glsl", "resolve.glsl", NULL};
    struct pass *pass = &draw->resolve[form - forms];
    char defines[64];

    if (pass->program == 0) {
        snprintf(defines, sizeof defines, "#define %s\n", form->define);
        if (!pass_init(pass, draw->gl, &(struct pass_source){.defines = defines, .files = files},
                       err)) {
            return NULL;
        }
        draw->compilations++;
    }
    return pass;
}

bool draw_begin(struct draw *draw, struct draw_picture *out, const struct frame_block *block,
                const struct draw_form *form, struct error *err)
{
    const struct gl *gl = draw->gl;
    struct draw_picture picture = {.form = form, .samples = block->size[2]};
    int width, height;

    if (!resolve_pass(draw, form, err)) {
        return false;
    }
    draw_tile_size(draw, picture.samples, &width, &height);
    gl->GenBuffers(1, &picture.frame);
    gl->BindBuffer(GL_UNIFORM_BUFFER, picture.frame);
    gl->BufferData(GL_UNIFORM_BUFFER, sizeof *block, block, GL_STATIC_DRAW);
    for (int i = 0; i < DRAW_SLOTS; i++) {
        struct draw_slot *slot = &picture.slots[i];
        gl->GenBuffers(1, &slot->buffer);
        gl->BindBuffer(GL_PIXEL_PACK_BUFFER, slot->buffer);
        gl->BufferData(GL_PIXEL_PACK_BUFFER, (GLsizeiptr)width * height * form->read_bytes, NULL,
                       GL_STREAM_READ);
        gl->GenQueries(3, slot->queries);
    }
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    if (!gl_check(gl, "making the buffers of a picture", err)) {
        draw_end(draw, &picture);
        return false;
    }
    *out = picture;
    return true;
}

void draw_end(struct draw *draw, struct draw_picture *picture)
{
    const struct gl *gl = draw->gl;

    gl->DeleteBuffers(1, &picture->frame);
    for (int i = 0; i < DRAW_SLOTS; i++) {
        struct draw_slot *slot = &picture->slots[i];
        if (slot->fence) {
            gl->DeleteSync(slot->fence);
        }
        gl->DeleteBuffers(1, &slot->buffer);
        gl->DeleteQueries(3, slot->queries);
    }
    *picture = (struct draw_picture){0};
}

/* Marks a moment: on a GPU in its queue, on the CPU after all work so far. */
static void mark(const struct draw *draw, struct draw_slot *slot, int index, uint64_t *out_us)
{
    if (draw->software) {
        draw->gl->Finish();
        *out_us = now_us();
    } else {
        draw->gl->QueryCounter(slot->queries[index], GL_TIMESTAMP);
    }
}

static void start_read(const struct draw *draw, const struct draw_form *form,
                       struct draw_slot *slot)
{
    const struct gl *gl = draw->gl;

    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, slot->buffer);
    gl->ReadPixels(0, 0, slot->tile.width, slot->tile.height, form->read_format, form->read_type,
                   NULL);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    slot->fence = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl->Flush();
}

bool draw_tile(struct draw *draw, struct draw_picture *picture, const struct program *program,
               const struct draw_numbers *numbers, struct tile tile, int index, struct error *err)
{
    const struct gl *gl = draw->gl;
    const struct draw_form *form = picture->form;
    struct draw_slot *slot = &picture->slots[index];
    const int width = tile.width * picture->samples, height = tile.height * picture->samples;
    uint64_t times[3] = {0};

    slot->tile = tile;
    slot->times = (struct job_times){0};
    gl->BindVertexArray(draw->targets.vertices);
    targets_bind(&draw->targets, gl);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, BINDING_FRAME, picture->frame);
    bind_numbers(numbers, gl);
    mark(draw, slot, 0, &times[0]);
    pass_compute_coarse(program_pass(program, STAGE_MARCH), gl, tile.x, tile.y, width, height);
    pass_compute(program_pass(program, STAGE_MARCH), gl, tile.x, tile.y, width, height);
    if (form->matter) {
        pass_compute(program_pass(program, STAGE_MATTER), gl, tile.x, tile.y, width, height);
    }
    mark(draw, slot, 1, &times[1]);
    if (form->light) {
        pass_compute(program_pass(program, STAGE_LIGHT), gl, tile.x, tile.y, width, height);
    }
    gl->Viewport(0, 0, tile.width, tile.height);
    gl->BindFramebuffer(GL_FRAMEBUFFER, draw->targets.out_buffers[form->kind]);
    pass_draw(&draw->resolve[form - forms], gl, tile.x, tile.y);
    mark(draw, slot, 2, &times[2]);
    slot->times.march_us = (uint32_t)(times[1] - times[0]);
    slot->times.light_us = (uint32_t)(times[2] - times[1]);
    start_read(draw, form, slot);
    return gl_check(gl, "drawing a tile", err);
}

static void fetch_times(const struct draw *draw, struct draw_slot *slot)
{
    GLuint64 ns[3] = {0};

    if (draw->software) {
        return;
    }
    for (int i = 0; i < 3; i++) {
        draw->gl->GetQueryObjectui64v(slot->queries[i], GL_QUERY_RESULT, &ns[i]);
    }
    slot->times.march_us = (uint32_t)((ns[1] - ns[0]) / 1000);
    slot->times.light_us = (uint32_t)((ns[2] - ns[1]) / 1000);
}

static bool wait_fence(const struct draw *draw, struct draw_slot *slot, struct error *err)
{
    const struct gl *gl = draw->gl;
    const GLenum got = gl->ClientWaitSync(slot->fence, GL_SYNC_FLUSH_COMMANDS_BIT,
                                          (GLuint64)FENCE_WAIT_MS * 1000000);

    gl->DeleteSync(slot->fence);
    slot->fence = NULL;
    if (gl->GetGraphicsResetStatus && gl->GetGraphicsResetStatus() != GL_NO_ERROR) {
        return error_set(err, ERROR_UNAVAILABLE, "", "the graphics device was reset");
    }
    if (got != GL_ALREADY_SIGNALED && got != GL_CONDITION_SATISFIED) {
        return error_set(err, ERROR_UNAVAILABLE, "", "a tile was not drawn within %d s",
                         FENCE_WAIT_MS / 1000);
    }
    return true;
}

bool draw_collect(struct draw *draw, struct draw_picture *picture, int index, uint8_t *to,
                  size_t stride, struct error *err)
{
    const struct gl *gl = draw->gl;
    struct draw_slot *slot = &picture->slots[index];
    const size_t row = (size_t)slot->tile.width * (size_t)picture->form->read_bytes;
    const uint64_t start = now_us();
    const uint8_t *from;

    if (!wait_fence(draw, slot, err)) {
        return false;
    }
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, slot->buffer);
    from = gl->MapBufferRange(GL_PIXEL_PACK_BUFFER, 0,
                              (GLsizeiptr)(row * (size_t)slot->tile.height), GL_MAP_READ_BIT);
    if (from) {
        for (int y = 0; y < slot->tile.height; y++) {
            memcpy(to + (size_t)y * stride, from + (size_t)y * row, row);
        }
        gl->UnmapBuffer(GL_PIXEL_PACK_BUFFER);
    }
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    fetch_times(draw, slot);
    slot->times.read_us = (uint32_t)(now_us() - start);
    return from ? gl_check(gl, "reading pixels", err)
                : error_set(err, ERROR_UNAVAILABLE, "", "the pixels of a tile cannot be mapped");
}
