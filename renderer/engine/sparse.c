/* SPDX-License-Identifier: MIT */
/* A tile by fewer rays: every fourth pixel along both axes has one, others only where their
 * neighbours differ (Akimoto, Mase and Suenaga: Pixel-selected ray tracing, IEEE Computer Graphics
 * and Applications 11(5), 1991). The rest is interpolated. Pixels with rays are those of the
 * picture, whatever the tile. */

/* Blocks are visited in squares so wide, because the rays of a vector wait for the slowest. */
enum { SPARSE_GROUP = 4 * SPARSE_STEP };

/* More than this between two pixels of a block asks for rays between them. */
#define LIGHT_COARSE 0.06f /* of the root of light, which is about equal steps for the eye */
#define LIGHT_FINE 0.12f   /* the same for neighbours of one pixel, which may blur a little */
#define TURN_LEAST 0.95f   /* cosine of two normals' angle */
#define DEPTH_MOST 1.1f    /* one distance in parts of the other */

static bool light_differs(const float *a, const float *b, float most)
{
    float difference = 0;
    for (int k = 0; k < 4; k++) {
        const float from = sqrtf(f_max(a[k], 0.0f)), to = sqrtf(f_max(b[k], 0.0f));
        difference = f_max(difference, fabsf(from - to));
    }
    return difference > most;
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
static bool is_even(const struct hand *hand, int at, int size)
{
    const int right = at + size, below = at + size * SIDE, across = below + size;
    const int pairs[][2] = {{at, across}, {right, below}, {at, right}};
    const bool coarse = size > 2;
    for (int i = 0; i < 3; i++) {
        const int a = pairs[i][0], b = pairs[i][1];
        if (light_differs(hand->pixels + 4 * a, hand->pixels + 4 * b,
                          coarse ? LIGHT_COARSE : LIGHT_FINE) ||
            (coarse && shape_differs(hand->geometry + 4 * a, hand->geometry + 4 * b))) {
            return false;
        }
    }
    return true;
}

static void want(struct hand *hand, int at)
{
    if (!hand->wanted[at]) {
        hand->wanted[at] = true;
        hand->listed[hand->listed_count++] = at;
    }
}

/* Four blocks in its place, whose corners want rays. */
static void split(struct hand *hand, int at, int size)
{
    const int half = size / 2, down = half * SIDE;
    const int places[] = {at + half, at + down, at + down + half, at + down + size,
                          at + 2 * down + half};
    for (int i = 0; i < (half > 1 ? 5 : 3); i++) {
        want(hand, places[i]);
    }
    for (int i = 0; i < 4; i++) {
        hand->blocks[at + i % 2 * half + i / 2 * down] = (uint8_t)half;
    }
}

/* Blocks of a group that are so large. */
static void refine_group(struct hand *hand, int left, int top, int size)
{
    for (int y = top; y < top + SPARSE_GROUP && y < hand->height - 1; y += size) {
        for (int x = left; x < left + SPARSE_GROUP && x < hand->width - 1; x += size) {
            const int at = y * SIDE + x;
            if (hand->blocks[at] == size && !is_even(hand, at, size)) {
                split(hand, at, size);
            }
        }
    }
}

/* The first rays of a group, and its blocks. */
static void begin_group(struct hand *hand, int left, int top, int size)
{
    for (int y = top; y < top + SPARSE_GROUP && y < hand->height; y += size) {
        for (int x = left; x < left + SPARSE_GROUP && x < hand->width; x += size) {
            hand->blocks[y * SIDE + x] = SPARSE_STEP;
            want(hand, y * SIDE + x);
        }
    }
}

static void each_group(struct hand *hand, int size, void (*visit)(struct hand *, int, int, int))
{
    hand->listed_count = 0;
    for (int y = 0; y < hand->height; y += SPARSE_GROUP) {
        for (int x = 0; x < hand->width; x += SPARSE_GROUP) {
            visit(hand, x, y, size);
        }
    }
    add_to_listed(hand, 0);
}

/* `to` at `x`, `y` of a block whose first corner is `corner`. */
static void interpolate(float *to, const float *corner, int size, int x, int y)
{
    const float *below = corner + 4 * SIDE * size;
    const float right = (float)x / (float)size, down = (float)y / (float)size;
    for (int k = 0; k < 4; k++) {
        const float above = corner[k] + (corner[4 * size + k] - corner[k]) * right;
        const float under = below[k] + (below[4 * size + k] - below[k]) * right;
        to[k] = above + (under - above) * down;
    }
}

/* A distance without end has no mean. */
static void fill_pixel(struct hand *hand, int to, int at, int size, int x, int y)
{
    const int corners[] = {at, at + size, at + size * SIDE, at + size * SIDE + size};
    bool all_hit = true;
    for (int i = 0; i < 4; i++) {
        all_hit = all_hit && is_hit(hand->geometry + 4 * corners[i]);
    }
    interpolate(hand->pixels + 4 * to, hand->pixels + 4 * at, size, x, y);
    if (all_hit) {
        interpolate(hand->geometry + 4 * to, hand->geometry + 4 * at, size, x, y);
    } else {
        memcpy(hand->geometry + 4 * to, hand->geometry + 4 * at, 4 * sizeof(float));
    }
    hand->counted[to] = 1;
}

/* All pixels of a block but its first. Those with rays for the sake of a neighbour, too: so a
 * pixel depends on its own block alone, and not on where the tile ends. */
static void fill_block(struct hand *hand, int at, int size)
{
    for (int i = 1; i < size * size; i++) {
        const int x = i % size, y = i / size;
        fill_pixel(hand, at + y * SIDE + x, at, size, x, y);
    }
}

/* The corners of small blocks may lie within large ones, which come later. */
static void fill_blocks(struct hand *hand, int size)
{
    for (int y = 0; y < hand->height - 1; y++) {
        for (int x = 0; x < hand->width - 1; x++) {
            if (hand->blocks[y * SIDE + x] == size) {
                fill_block(hand, y * SIDE + x, size);
            }
        }
    }
}

static void draw_sparse(struct hand *hand)
{
    memset(hand->wanted, 0, sizeof hand->wanted);
    memset(hand->blocks, 0, sizeof hand->blocks);
    each_group(hand, SPARSE_STEP, begin_group);
    for (int size = SPARSE_STEP; size > 1; size /= 2) {
        each_group(hand, size, refine_group);
    }
    for (int size = 2; size <= SPARSE_STEP; size *= 2) {
        fill_blocks(hand, size);
    }
}
