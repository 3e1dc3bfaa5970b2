/* SPDX-License-Identifier: MIT */
#include <stdlib.h>

#include "cubes.h"
#include "protocol/memory.h"

/* In larger fields rays that are far apart share no tape: a sparse picture of the temple (245)
 * takes as long as one of all rays, one of the snowman (84) less. */
enum { SPARSE_OPERATIONS = 128 };

struct engine_canvas *engine_canvas_create(struct engine_cubes *cubes,
                                           const struct engine_picture *picture)
{
    struct engine_canvas *canvas = memory_alloc(1, sizeof *canvas);

    canvas->picture = *picture;
    canvas->keeper = cubes;
    canvas->picture.sparse &= picture->program->count <= SPARSE_OPERATIONS;
    canvas->cubes = cubes_take(cubes, &canvas->picture, &canvas->number);
    /* While the camera moves, nobody needs to know what pictures are made of. */
    canvas->seeks = !picture->sparse || canvas->cubes->renewed ||
                    seen_has(&canvas->cubes->seen, &canvas->picture);
    return canvas;
}

void engine_canvas_keep(struct engine_canvas *canvas, struct engine_rect region)
{
    const size_t pixels = (size_t)region.width * (size_t)region.height;

    canvas->kept = region;
    canvas->pixels = memory_alloc(4 * pixels, sizeof *canvas->pixels);
    canvas->counted = memory_alloc(2 * pixels, sizeof *canvas->counted);
}

void cells_finish(struct cells spaces[ENGINE_SPACES])
{
    for (int i = 0; i < ENGINE_SPACES; i++) {
        free(spaces[i].at);
        free(spaces[i].news);
        free(spaces[i].tapes);
        free(spaces[i].drops);
    }
}

void engine_canvas_destroy(struct engine_canvas *canvas)
{
    if (!canvas) {
        return;
    }
    for (int i = 0; i < ENGINE_THREADS; i++) {
        canvas->picture.program->width->hand_destroy(canvas->hands[i]);
    }
    cubes_give(canvas->keeper, canvas->picture.program, canvas->cubes);
    free(canvas->parts);
    free(canvas->pixels);
    free(canvas->counted);
    free(canvas);
}

/* What is kept between rounds is of all samples, and is drawn. */
static bool is_whole(const struct engine_canvas *canvas, const struct engine_work *work)
{
    return canvas->kept.width == 0 && work->from == 0 &&
           work->until == canvas->picture.frame->samples;
}

struct engine_drawn engine_draw(struct engine_canvas *canvas, struct engine_rect tile, int from,
                                int until, const struct engine_output *outputs, size_t count,
                                const struct engine_pause *pause)
{
    const struct engine_work work = {tile, from, until, outputs, count, pause};

    if (canvas->seeks && is_whole(canvas, &work)) {
        canvas->seen = seen_open(&canvas->cubes->seen, &canvas->picture, outputs, count);
    }
    canvas->seeks = false;
    return canvas->picture.program->width->draw(canvas, &work);
}
