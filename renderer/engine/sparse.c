/* SPDX-License-Identifier: MIT */
/* A tile by fewer rays: every fourth pixel along both axes has one, and all pixels of a block whose
 * corners differ. The others are interpolated (after Akimoto, Mase and Suenaga: Pixel-selected ray
 * tracing, IEEE Computer Graphics and Applications 11(5), 1991). Blocks are those of the picture,
 * and a pixel depends on its own block alone, so tiles do not show. A block is not divided further:
 * its 16 pixels are neighbours, whose rays cost less together than a few that are far apart. */

/* First rays are listed in squares so wide, because the rays of a vector wait for the slowest. */
enum { SPARSE_GROUP = 4 * SPARSE_STEP, SPARSE_PASSES = 2 };

/* More than this between two corners of a block asks for rays between them. */
#define SEEN_MOST 0.06f  /* of what seen_at() gives */
#define TURN_LEAST 0.95f /* cosine of two normals' angle */
#define DEPTH_MOST 1.1f  /* one distance in parts of the other */

/* Lanes of `seen`. */
static bool light_differs(const vf seen[4], int a, int b)
{
    float difference = 0;

    for (int k = 0; k < 4; k++) {
        difference = f_max(difference, fabsf(seen[k][a] - seen[k][b]));
    }
    return difference > SEEN_MOST;
}

static float dot_normals(const float *a, const float *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* It has a normal. */
static bool is_hit(const float *geometry)
{
    return dot_normals(geometry, geometry) > 0;
}

/* The surface turns, or one lies behind the other. */
static bool shape_differs(const float *a, const float *b)
{
    const float near = f_min(fabsf(a[3]), fabsf(b[3])), far = f_max(fabsf(a[3]), fabsf(b[3]));

    return (is_hit(a) || is_hit(b)) && (dot_normals(a, b) < TURN_LEAST || far > near * DEPTH_MOST);
}

/* Whether pixels between the corners can be told from these. */
static bool is_even(struct hand *hand, const int corners[4])
{
    static const int pairs[][2] = {{0, 3}, {1, 2}, {0, 1}};
    vi at = vi_zero;
    vf seen[4];

    for (int i = 0; i < 4; i++) {
        at[i] = corners[i];
    }
    const vf here[2] = {(vf)(at % SIDE), (vf)(at / SIDE)};
    spmd_seen_at(&hand->lanes, lanes_number < 4, here, seen);
    for (int i = 0; i < 3; i++) {
        const int a = pairs[i][0], b = pairs[i][1];
        if (light_differs(seen, a, b) ||
            shape_differs(hand->geometry + 4 * corners[a], hand->geometry + 4 * corners[b])) {
            return false;
        }
    }
    return true;
}

static void list_group(struct hand *hand, int left, int top)
{
    for (int y = top; y < top + SPARSE_GROUP && y < hand->height; y += SPARSE_STEP) {
        for (int x = left; x < left + SPARSE_GROUP && x < hand->width; x += SPARSE_STEP) {
            hand->listed[hand->listed_count++] = y * SIDE + x;
        }
    }
}

static void list_corners(struct hand *hand)
{
    hand->listed_count = 0;
    for (int y = 0; y < hand->height; y += SPARSE_GROUP) {
        for (int x = 0; x < hand->width; x += SPARSE_GROUP) {
            list_group(hand, x, y);
        }
    }
}

/* All pixels that the tile or its margin shows but the first, which has a ray. */
static void draw_block(struct hand *hand, int left, int top)
{
    const struct engine_rect inner = hand->inner;
    const int margin = hand->canvas->picture.margin;

    for (int i = 0; i < SPARSE_STEP * SPARSE_STEP; i += LANES) {
        const vi at = i + lanes_number;
        const vi x = left + at % SPARSE_STEP, y = top + at / SPARSE_STEP;
        const vb shown = (x >= inner.x - margin) & (x < inner.x + inner.width + margin) &
                         (y >= inner.y - margin) & (y < inner.y + inner.height + margin);
        if (lanes_any((at > 0) & shown)) {
            add_sample(hand, (at > 0) & shown, x, y, 0);
        }
    }
}

/* What lies at `x`, `y` of a block, from `count` floats of each corner. */
static void interpolate(float *values, int count, int to, const int corners[4], int x, int y)
{
    const float right = (float)x / SPARSE_STEP, down = (float)y / SPARSE_STEP;

    for (int k = 0; k < count; k++) {
        const float a = values[count * corners[0] + k], b = values[count * corners[1] + k];
        const float c = values[count * corners[2] + k], d = values[count * corners[3] + k];
        const float above = a + (b - a) * right, below = c + (d - c) * right;
        values[count * to + k] = above + (below - above) * down;
    }
}

/* The nearest corner's. */
static void fill_distances(struct hand *hand, const int corners[4])
{
    float *all = hand->distances;
    const float nearest =
        f_min(f_min(all[corners[0]], all[corners[1]]), f_min(all[corners[2]], all[corners[3]]));

    for (int y = 0; y < SPARSE_STEP; y++) {
        for (int x = y == 0; x < SPARSE_STEP; x++) {
            all[corners[0] + y * SIDE + x] = nearest;
        }
    }
}

/* A distance without end has no mean. */
static void fill_block(struct hand *hand, const int corners[4])
{
    bool all_hit = true;

    for (int i = 0; i < 4; i++) {
        all_hit = all_hit && is_hit(hand->geometry + 4 * corners[i]);
    }
    for (int i = 1; i < SPARSE_STEP * SPARSE_STEP; i++) {
        const int x = i % SPARSE_STEP, y = i / SPARSE_STEP, to = corners[0] + y * SIDE + x;
        interpolate(hand->pixels, 4, to, corners, x, y);
        interpolate(hand->counted, 2, to, corners, x, y);
        if (all_hit) {
            interpolate(hand->geometry, 4, to, corners, x, y);
        } else {
            memcpy(hand->geometry + 4 * to, hand->geometry + 4 * corners[0], 4 * sizeof(float));
        }
    }
}

/* A row of them, whose corners have rays. The tile is whole blocks wide and high, and one pixel
 * more. */
static void draw_blocks(struct hand *hand, int number)
{
    const int y = number * SPARSE_STEP;

    for (int x = 0; x < hand->width - 1; x += SPARSE_STEP) {
        const int at = y * SIDE + x, below = at + SPARSE_STEP * SIDE;
        const int corners[4] = {at, at + SPARSE_STEP, below, below + SPARSE_STEP};
        if (is_even(hand, corners)) {
            fill_block(hand, corners);
            if (hand->wants_distances) {
                fill_distances(hand, corners);
            }
        } else {
            draw_block(hand, x, y);
        }
    }
}
