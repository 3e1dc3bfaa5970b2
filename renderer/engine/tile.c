/* SPDX-License-Identifier: MIT */
/* Pixels of a small tile, LANES at a time, by a thread with its own memory of them. */

enum {
    TILE = 64,       /* pixels to a side */
    ACROSS = 4,      /* pixels of a vector: neighbours, because lanes wait for the slowest */
    SPARSE_STEP = 4, /* side of a sparse tile's blocks (sparse.c) */
    /* With its margin, and whole blocks of a sparse one; a multiple of lanes' pixels. */
    SIDE = TILE + 2 * ENGINE_MARGIN + 2 * SPARSE_STEP,
    BLOCKS = SIDE / BLOCK_SIDE + 1, /* to a side: they are the picture's, not the tile's */
};

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

struct hand;

/* Goes over the pixels of a part once. */
struct pass {
    int number, steps, done;
    void (*step)(struct hand *hand, int number);
};

/* A thread's own. `left`, `top`: of the tile with its margin, in the picture. `inner`: the tile's
 * own pixels in it. */
struct hand {
    struct lanes lanes;
    struct dispatch_block dispatch;
    struct scene_block scene;
    const struct engine_canvas *canvas;
    const struct engine_work *work;
    uint64_t rays; /* that followed others */
    int left, top, width, height;
    struct engine_rect inner;
    /* The part that it has begun and not ended, NULL: none, and how far that is: passes.c. */
    const struct engine_part *part;
    struct pass pass;
    atomic_bool *paused;           /* all threads stop for now */
    uint32_t times;                /* of the cubes, before the part was begun */
    float starts[BLOCKS * BLOCKS]; /* how far the rays of each block are free */
    float geometry[SIDE * SIDE * 4], pixels[SIDE * SIDE * 4], counted[SIDE * SIDE * 2];
    float distances[SIDE * SIDE]; /* of a sparse tile, where they are wanted */
    bool wants_distances;
    int listed[SIDE * SIDE], listed_count;
    int number;          /* among the canvas's */
    struct noted *noted; /* its cubes' */
    /* The squares of the part that need a pixel: by its column a bit for each in a row of them, by
     * its row one for each first in a row. */
    uint16_t columns[SIDE], rows[SIDE];
};

/* --- which squares a pixel is for --- */

/* Those of a stretch of pixels, from `inner` on, that reach at most `zone` pixels too far. */
static void find_squares(uint16_t *out, int count, int inner, int length, int zone, int step)
{
    const int squares = (length + SQUARE - 1) / SQUARE;

    for (int i = 0; i < count; i++) {
        out[i] = 0;
        for (int k = 0; k < squares; k++) {
            const bool behind = k == 0 || i >= inner + k * SQUARE - zone;
            const bool before = k == squares - 1 || i < inner + (k + 1) * SQUARE + zone;
            out[i] |= (uint16_t)((behind && before) << k * step);
        }
    }
}

/* A part's pixels are made of none that are further away than the margin and a sparse tile's
 * blocks. */
static void begin_notes(struct hand *hand)
{
    const struct engine_picture *picture = &hand->canvas->picture;
    const struct engine_rect inner = hand->inner;
    const int zone = picture->margin + (picture->sparse ? SPARSE_STEP : 0);

    find_squares(hand->columns, hand->width, inner.x, inner.width, zone, 1);
    find_squares(hand->rows, hand->height, inner.y, inner.height, zone, SQUARES);
    hand->times = cubes_times(hand->lanes.spaces);
    hand->noted->part++;
    hand->noted->count = hand->noted->value_bytes = 0;
    memset(hand->noted->materials, 0, sizeof hand->noted->materials);
}

/* The next evaluations are for LANES rectangles of pixels. */
static void note_squares(struct hand *hand, vb m, vi left, vi top, int side)
{
    uint16_t squares = 0;

    for (int i = 0; i < LANES && hand->lanes.noted; i++) {
        if (m[i]) {
            const int right = left[i] + side - 1, bottom = top[i] + side - 1;
            const int x[2] = {left[i] < 0 ? 0 : left[i],
                              right < hand->width ? right : hand->width - 1};
            const int y[2] = {top[i] < 0 ? 0 : top[i],
                              bottom < hand->height ? bottom : hand->height - 1};
            squares |= (uint16_t)((hand->columns[x[0]] | hand->columns[x[1]]) *
                                  (hand->rows[y[0]] | hand->rows[y[1]]));
        }
    }
    hand->noted->squares = squares;
}

enum { PART_SQUARES = SQUARES * SQUARES };

static const struct cell *noted_cell(const struct hand *hand, uint32_t word)
{
    const struct cells *space = &hand->lanes.spaces[word >> NOTED_SPACE];

    return &space->at[word & ((1 << NOTED_SPACE) - 1)];
}

/* With room for the cubes that it has used. */
static struct seen_square *make_square(const struct hand *hand, int x, int y, size_t cubes)
{
    const struct engine_rect inner = hand->inner;
    struct seen_square *square = memory_alloc(1, sizeof *square + cubes * sizeof square->used[0]);

    square->rect =
        (struct engine_rect){hand->left + inner.x + x, hand->top + inner.y + y,
                             smaller(SQUARE, inner.width - x), smaller(SQUARE, inner.height - y)};
    square->edit = hand->canvas->cubes->edit;
    square->times = cubes_times(hand->lanes.spaces);
    square->thread = (uint8_t)hand->number;
    return square;
}

/* Each noted cube to the squares that have used it. */
static void take_cubes(const struct hand *hand, struct seen_square *const made[PART_SQUARES])
{
    const struct noted *noted = hand->noted;

    for (size_t i = 0; i < noted->count; i++) {
        const uint32_t word = noted->cubes[i];
        const struct cell *cell = noted_cell(hand, word);
        for (uint32_t left = cell->run | cell->found; left; left &= left - 1) {
            const int number = __builtin_ctz(left);
            struct seen_square *square = made[number];
            square->used[square->count++] = word | (cell->run >> number & 1 ? NOTED_RUN : 0) |
                                            (cell->found >> number & 1 ? NOTED_FOUND : 0);
        }
    }
}

/* Each noted value to the squares that it is for. */
static void take_values(const struct noted *noted, struct seen_square *const made[PART_SQUARES])
{
    const char *const end = noted->values + noted->value_bytes;
    size_t bytes[PART_SQUARES] = {0};
    const struct noted_value *value;

    for (const char *at = noted->values; at < end; at += noted_value_bytes(value)) {
        value = (const void *)at;
        for (uint32_t left = value->squares; left; left &= left - 1) {
            bytes[__builtin_ctz(left)] += noted_value_bytes(value);
        }
    }
    for (int i = 0; i < PART_SQUARES; i++) {
        if (made[i]) {
            made[i]->values = memory_alloc(bytes[i], 1);
        }
    }
    for (const char *at = noted->values; at < end; at += noted_value_bytes(value)) {
        value = (const void *)at;
        for (uint32_t left = value->squares; left; left &= left - 1) {
            struct seen_square *square = made[__builtin_ctz(left)];
            memcpy(square->values + square->bytes_of_values, at, noted_value_bytes(value));
            square->bytes_of_values += noted_value_bytes(value);
        }
    }
}

/* Where cubes were made anew since the part was begun, it is not known what is used. */
static void end_notes(struct hand *hand)
{
    struct noted *noted = hand->noted;
    struct seen_square *made[PART_SQUARES] = {NULL};
    size_t counts[PART_SQUARES] = {0};

    if (hand->times != cubes_times(hand->lanes.spaces)) {
        return;
    }
    for (size_t i = 0; i < noted->count; i++) {
        const struct cell *cell = noted_cell(hand, noted->cubes[i]);
        for (uint32_t left = cell->run | cell->found; left; left &= left - 1) {
            counts[__builtin_ctz(left)]++;
        }
    }
    for (int y = 0; y < hand->inner.height; y += SQUARE) {
        for (int x = 0; x < hand->inner.width; x += SQUARE) {
            const int number = x / SQUARE + SQUARES * (y / SQUARE);
            made[number] = make_square(hand, x, y, counts[number]);
            made[number]->materials = noted->materials[number];
            noted->made = memory_one_more((void *)noted->made, noted->made_count, sizeof(void *));
            noted->made[noted->made_count++] = made[number];
        }
    }
    take_cubes(hand, made);
    take_values(noted, made);
}

/* Of pixels of the tile. Blocks are those of the picture, whatever the tile. */
static vi block_of(const struct hand *hand, vi x, vi y)
{
    const vi across = ((x + hand->left) >> BLOCK_BITS) - (hand->left >> BLOCK_BITS);
    const vi down = ((y + hand->top) >> BLOCK_BITS) - (hand->top >> BLOCK_BITS);

    return down * BLOCKS + across;
}

/* From the block of pixel `from` to that of the last of `count`. */
static int blocks_of(int from, int count)
{
    return ((from + count - 1) >> BLOCK_BITS) - (from >> BLOCK_BITS) + 1;
}

static void find_starts(struct hand *hand)
{
    const int across = blocks_of(hand->left, hand->width);
    const int count = across * blocks_of(hand->top, hand->height);

    for (int i = 0; i < count; i += LANES) {
        const vi at = i + lanes_number, column = at % across, row = at / across;
        note_squares(hand, at < count,
                     (column + (hand->left >> BLOCK_BITS)) * BLOCK_SIDE - hand->left,
                     (row + (hand->top >> BLOCK_BITS)) * BLOCK_SIDE - hand->top, BLOCK_SIDE);
        const vf block[2] = {(vf)(column + (hand->left >> BLOCK_BITS)),
                             (vf)(row + (hand->top >> BLOCK_BITS))};
        const vf start = spmd_block_start(&hand->lanes, at < count, block);
        for (int k = 0; k < LANES && i + k < count; k++) {
            hand->starts[row[k] * BLOCKS + column[k]] = start[k];
        }
    }
}

static uint8_t *place_of(const struct hand *hand, const struct engine_output *output, int x, int y)
{
    const struct engine_rect tile = hand->work->tile;
    const size_t bytes = (size_t)output->channels * (output->floats ? sizeof(float) : 1);

    return output->pixels + (size_t)(y - tile.y) * output->stride + (size_t)(x - tile.x) * bytes;
}

static void write_pixel(const struct engine_output *output, uint8_t *to, const vf *color, int lane)
{
    for (int k = 0; k < output->channels; k++) {
        const float value = color[k][lane];
        if (output->floats) {
            memcpy(to + (size_t)k * sizeof value, &value, sizeof value);
        } else {
            to[k] = (uint8_t)(f_min(f_max(0.0f, value), 1.0f) * 255.0f + 0.5f);
        }
    }
}

static bool is_light(const struct engine_output *output)
{
    return output->kind == OUT_COLOR || output->kind == OUT_LINEAR;
}

/* Of a sparse tile's pixels most have no ray. */
static bool is_between_rays(const struct hand *hand, const struct engine_output *output)
{
    return hand->canvas->picture.sparse && output->kind == OUT_DEPTH;
}

static bool wants_distances(const struct hand *hand)
{
    for (size_t o = 0; o < hand->work->output_count; o++) {
        if (is_between_rays(hand, &hand->work->outputs[o])) {
            return true;
        }
    }
    return false;
}

static void note_distances(struct hand *hand, vb m, vi at, const vf *met)
{
    vf color[4];

    spmd_output_of(&hand->lanes, m, OUT_DEPTH, met, color);
    for (int i = 0; i < LANES; i++) {
        if (m[i]) {
            hand->distances[at[i]] = color[0][i];
        }
    }
}

/* Outputs but light, of what the first sample of pixels x, y met. */
static void write_met(struct hand *hand, vb m, vi x, vi y, const vf *met)
{
    const struct engine_rect inner = hand->inner;

    m &= (x >= inner.x) & (y >= inner.y) & (x < inner.x + inner.width) &
         (y < inner.y + inner.height);
    for (size_t o = 0; o < hand->work->output_count; o++) {
        const struct engine_output *output = &hand->work->outputs[o];
        vf color[4];
        if (is_light(output) || is_between_rays(hand, output)) {
            continue;
        }
        if (output->kind == OUT_ID_RAW) {
            color[0] = spmd_id_bits(&hand->lanes, m, met);
        } else {
            spmd_output_of(&hand->lanes, m, output->kind, met, color);
        }
        for (int i = 0; i < LANES; i++) {
            if (m[i]) {
                write_pixel(output, place_of(hand, output, hand->left + x[i], hand->top + y[i]),
                            color, i);
            }
        }
    }
}

/* One more sample of LANES pixels of the tile, at x, y of it. */
static void add_sample(struct hand *hand, vb m, vi x, vi y, int index)
{
    struct lanes *c = &hand->lanes;
    const struct engine_picture *picture = &hand->canvas->picture;
    const vf pixel[2] = {(vf)(x + hand->left), (vf)(y + hand->top)};
    const vf start = lanes_gather(hand->starts, block_of(hand, x, y), m);
    vf total[4] = {0}, geometry[4] = {0}, met[SPMD_Met] = {0}, light[4] = {0}, counts[2] = {0};

    note_squares(hand, m, x, y, 1);
    const vi rays =
        spmd_trace(c, m, pixel, start, index, picture->rays, picture->transmission_depth,
                   picture->shadows, picture->lights, total, geometry, met);

    spmd_sample_sums(c, m, total, light, counts);
    const vi at = y * SIDE + x;
    if (index == 0) {
        write_met(hand, m, x, y, met);
        if (hand->wants_distances) {
            note_distances(hand, m, at, met);
        }
    }
    for (int i = 0; i < LANES; i++) {
        if (!m[i]) {
            continue;
        }
        for (int k = 0; k < 4; k++) {
            hand->pixels[4 * at[i] + k] += light[k][i];
        }
        for (int k = 0; k < 2; k++) {
            hand->counted[2 * at[i] + k] += counts[k][i];
        }
        for (int k = 0; k < 4 && index == 0; k++) {
            hand->geometry[4 * at[i] + k] = geometry[k][i];
        }
        hand->rays += (uint64_t)rays[i];
    }
}

/* Pixels that are worth more samples, of those that had one. */
static void list_edges(struct hand *hand)
{
    hand->listed_count = 0;
    for (int y = 1; y < hand->height - 1; y++) {
        for (int x = 1; x < hand->width - 1; x += LANES) {
            const vi left = x + lanes_number;
            const vb m = left < hand->width - 1;
            const vf here[2] = {(vf)vi_select(m, left, vi_all(1)), (vf)vi_all(y)};
            const vb edge = m & spmd_is_edge(&hand->lanes, m, here);
            for (int i = 0; i < LANES; i++) {
                if (edge[i]) {
                    hand->listed[hand->listed_count++] = y * SIDE + left[i];
                }
            }
        }
    }
}

/* --- sums that are kept --- */

/* The tile's sums from the canvas, or to it. */
static void keep(struct hand *hand, bool back)
{
    const struct engine_canvas *canvas = hand->canvas;
    const struct engine_rect kept = canvas->kept;
    const struct engine_rect inner = hand->inner;

    for (int y = inner.y; y < inner.y + inner.height; y++) {
        const size_t at = (size_t)(hand->top + y - kept.y) * (size_t)kept.width +
                          (size_t)(hand->left + inner.x - kept.x);
        float *const own[] = {hand->pixels + 4 * (y * SIDE + inner.x),
                              hand->counted + 2 * (y * SIDE + inner.x)};
        float *const theirs[] = {canvas->pixels + 4 * at, canvas->counted + 2 * at};
        for (int i = 0; i < 2; i++) {
            const size_t bytes = (size_t)inner.width * (i == 0 ? 4 : 2) * sizeof(float);
            memcpy(back ? own[i] : theirs[i], back ? theirs[i] : own[i], bytes);
        }
    }
}

/* Those that had `samples`. */
static void list_again(struct hand *hand, int samples)
{
    hand->listed_count = 0;
    for (int y = 1; y < hand->height - 1; y++) {
        for (int x = 1; x < hand->width - 1; x++) {
            if (hand->counted[2 * (y * SIDE + x)] >= (float)samples) {
                hand->listed[hand->listed_count++] = y * SIDE + x;
            }
        }
    }
}

/* --- a tile --- */

static void write_light(struct hand *hand, const struct engine_output *output)
{
    const bool blend = hand->canvas->picture.smoothing == ENGINE_BLEND;
    const struct engine_rect inner = hand->inner;
    const int right = inner.x + inner.width;

    for (int y = inner.y; y < inner.y + inner.height; y++) {
        for (int x = inner.x; x < right; x += LANES) {
            const vb m = x + lanes_number < right;
            const vi column = vi_select(m, x + lanes_number, vi_all(x));
            const vf here[2] = {(vf)column, (vf)vi_all(y)};
            const vf pixel[2] = {(vf)(column + hand->left), (vf)vi_all(y + hand->top)};
            vf light[4], color[4];
            spmd_pixel_light(&hand->lanes, m, here, blend, light);
            if (output->kind == OUT_COLOR) {
                spmd_pixel_color(&hand->lanes, m, light, pixel, color);
            } else {
                memcpy(color, light, sizeof color);
            }
            for (int i = 0; i < LANES && m[i]; i++) {
                write_pixel(output, place_of(hand, output, hand->left + x + i, hand->top + y),
                            color, i);
            }
        }
    }
}

static void write_distances(struct hand *hand, const struct engine_output *output)
{
    const struct engine_rect inner = hand->inner;

    for (int y = inner.y; y < inner.y + inner.height; y++) {
        memcpy(place_of(hand, output, hand->left + inner.x, hand->top + y),
               hand->distances + y * SIDE + inner.x, (size_t)inner.width * sizeof(float));
    }
}

/* A stretch of the picture's pixels to whole blocks of a sparse tile, with the line behind. */
static void widen(int *from, int *until)
{
    *from &= -SPARSE_STEP;
    *until = ((*until - 1) & -SPARSE_STEP) + SPARSE_STEP + 1;
}

/* Its samples follow (passes.c). */
static void begin_part(struct hand *hand, struct engine_rect rect)
{
    const struct engine_picture *picture = &hand->canvas->picture;
    const int margin = picture->margin;
    int left = rect.x - margin, top = rect.y - margin;
    int right = rect.x + rect.width + margin, bottom = rect.y + rect.height + margin;

    if (picture->sparse) {
        widen(&left, &right);
        widen(&top, &bottom);
    }
    hand->left = hand->dispatch.origin[0] = left;
    hand->top = hand->dispatch.origin[1] = top;
    hand->width = right - left;
    hand->height = bottom - top;
    hand->inner = (struct engine_rect){rect.x - left, rect.y - top, rect.width, rect.height};
    if (hand->lanes.noted) {
        begin_notes(hand);
    }
    hand->wants_distances = wants_distances(hand);
    find_starts(hand);
}

static void end_part(struct hand *hand)
{
    if (hand->lanes.noted) {
        end_notes(hand);
    }
    for (size_t i = 0; i < hand->work->output_count; i++) {
        if (is_light(&hand->work->outputs[i])) {
            write_light(hand, &hand->work->outputs[i]);
        } else if (is_between_rays(hand, &hand->work->outputs[i])) {
            write_distances(hand, &hand->work->outputs[i]);
        }
    }
    if (hand->canvas->kept.width > 0) {
        keep(hand, false);
    }
}
