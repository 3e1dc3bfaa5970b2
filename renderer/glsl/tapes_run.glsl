/* SPDX-License-Identifier: MIT */
/* Runs tapes. The engine does the same for vectors (engine/interpret.c). */

#include "frame.glsl"
#include "mixing.glsl"
#include "tapes.glsl"

/* By the kinds of the field's vocabulary (renderer/field/vocabulary.c). */
float shape_of(int kind, vec3 p);
float combine_of(int kind, float a, float b);
float share_of(int kind, float a, float b);
float change_of(int kind, float d);
vec3 warp_of(int kind, vec3 p);
float after_of(int kind, float d, vec3 p);
vec3 first_of(int kind, vec3 p);
vec3 last_of(int kind, vec3 p);
vec3 cell_of(int kind, vec3 p, vec3 cell);

struct Cube {
    uvec4 row;    /* of the tapes */
    uvec4 around; /* the row of its parent */
    ivec3 corner; /* on the grid */
    int bits;     /* its side is 2 to so many of the grid's units */
};

float tapes_unit()
{
    return uintBitsToFloat(TAPE_TEXEL(1).x);
}

/* Where the space begins that field_mask tells. */
int tapes_space()
{
    return TAPE_SPACES + TAPE_SPACE_TEXELS * (field_mask == 0.0 ? 0 : field_mask > 0.0 ? 1 : 2);
}

float cube_half(Cube cube, float unit)
{
    return 0.5 * exp2(float(cube.bits)) * unit;
}

/* Whether all surfaces are so far away that the distance in its middle bounds those in it. */
bool cube_bounds(Cube cube, float unit)
{
    return cube.around.z > uint(TAPE_BOUND) &&
           abs(uintBitsToFloat(cube.row.w)) > 2.0 * cube_half(cube, unit);
}

/* The last answer of cube_at(): often the next one. */
Cube found;
bool found_bound = false;
float found_mask = -1.0; /* of nothing */

/* The smallest cube around a point; with `bound` the largest one that bounds the field there, if
 * there is any. */
Cube cube_at(vec3 p, bool bound, float unit)
{
    int here = tapes_space();
    uvec4 space = TAPE_TEXEL(here);
    ivec3 start = ivec3(TAPE_TEXEL(here + 1).xyz);
    int first = int(space.x);
    vec3 place = floor(p / unit) + float(TAPE_ORIGIN);
    bool outside = any(lessThan(place, vec3(0.0))) ||
                   any(greaterThanEqual(place, vec3(float(1 << TAPE_GRID_BITS))));
    ivec3 spot = ivec3(outside ? vec3(0.0) : place);
    ivec3 apart = spot ^ found.corner;
    if (!outside && found_mask == field_mask && found_bound == bound &&
        (apart.x | apart.y | apart.z) >> found.bits == 0) {
        return found;
    }
    apart = spot ^ start;
    bool inside = !outside && (apart.x | apart.y | apart.z) >> int(space.z) == 0;
    Cube cube = inside ? Cube(TAPE_TEXEL(first + int(space.y)), uvec4(0u), start, int(space.z))
                       : Cube(TAPE_TEXEL(first), uvec4(0u), ivec3(0), TAPE_GRID_BITS);

    for (int left = cube.bits;
         left > 0 && !outside && cube.row.x != 0u && !(bound && cube_bounds(cube, unit)); left--) {
        cube.bits--;
        ivec3 upper = (spot >> cube.bits) & 1;
        cube.corner += upper << cube.bits;
        cube.around = cube.row;
        cube.row = TAPE_TEXEL(first + int(cube.row.x) + upper.x + 2 * upper.y + 4 * upper.z);
    }
    found = cube;
    found_bound = bound;
    found_mask = outside ? -1.0 : field_mask;
    return cube;
}

/* No point of the cube is nearer to a surface than the middle is, less its way there. */
float cube_bound(Cube cube, vec3 p, float unit)
{
    vec3 middle = (vec3(cube.corner - TAPE_ORIGIN) + 0.5 * exp2(float(cube.bits))) * unit;
    float distance = uintBitsToFloat(cube.row.w), bound = abs(distance) - length(p - middle);
    return distance < 0.0 ? -bound : bound;
}

float tape_number(uint index)
{
    return P_ANY(int(index >> 2))[index & 3u];
}

/* The slots of a tape. Compute shaders keep a few in the memory of their work group, where an index
 * that is no constant costs less: a union of 6,000 shapes then takes three quarters of the time. */
#if defined(GROUP) && TAPE_DISTANCES + 4 * TAPE_POINTS <= 64
shared float tape_distances[TAPE_DISTANCES][GROUP_SIZE];
shared vec3 tape_points[TAPE_POINTS][GROUP_SIZE];
#define D(i) tape_distances[i][gl_LocalInvocationIndex]
#define POINT(i) tape_points[i][gl_LocalInvocationIndex]
#define TAPE_ARRAYS
#else
#define D(i) distances[i]
#define POINT(i) points[i]
#define TAPE_ARRAYS                                                                                \
    float distances[TAPE_DISTANCES];                                                               \
    vec3 points[TAPE_POINTS];
#endif

/* The distance at a point by a tape; `surfaces`: what is there, too. */
float run(int tape, int count, vec3 p0, const bool surfaces, out Mixture result)
{
    TAPE_ARRAYS
    Mixture m[TAPE_DISTANCES];
#if TAPE_LOOPS > 0
    vec3 first[TAPE_LOOPS], last[TAPE_LOOPS], cell[TAPE_LOOPS];
    int left[TAPE_LOOPS];
    int depth = 0;
#endif
    uvec4 head = TAPE_TEXEL(0);
    int operations = int(head.x), words = int(head.y);

    POINT(0) = p0;
    for (int i = zero; i < count; i++) {
        int at = tape + i;
        uvec4 four = TAPE_TEXEL(words + (at >> 2));
        uvec2 two = (at & 2) == 0 ? four.xy : four.zw;
        uint word = (at & 1) == 0 ? two.x : two.y;
        int row = operations + 2 * int(word & uint(TAPE_INDEX));
        uvec4 operation = TAPE_TEXEL(row);
        int op = int(operation.x & 0xffu), kind = int(operation.x >> 16);
        int a = int(operation.y & 0xffffu), b = int(operation.y >> 16);
        int point = int(operation.z & 0xffffu), to = int(operation.z >> 16);
        own = int(operation.w);
        int needed = op == TAPE_OP_SHAPE ? TAPE_AHEAD : TAPE_AHEAD_OTHERS;
        for (int k = 0; k < TAPE_AHEAD; k++) {
            if (k < needed) {
                ahead[k] = P_ANY(own + k);
            }
        }
        if (word >> 30 != 0u) {
            D(a) = word >> 31 != 0u ? -D(b) : D(b);
            if (surfaces) {
                m[a] = m[b];
                m[a].d = D(a);
            }
            continue;
        }
        switch (op) {
        case TAPE_OP_SHAPE: {
            D(a) = shape_of(kind, POINT(point));
            if (surfaces) {
                vec4 numbers = P(3);
                m[a] = alone(D(a), numbers.y, numbers.z, local(POINT(point), P(0), P(1), P(2)));
            }
            break;
        }
        case TAPE_OP_COMBINE: {
            bool both_seen = (operation.x & uint(TAPE_SEEN)) == 0u;
            float side = both_seen ? 0.0 : tape_number(TAPE_TEXEL(row + 1).x);
            if (surfaces) {
                float share = sided_share(share_of(kind, D(a), D(b)), side);
                float both = sided(combine_of(kind, D(a), D(b)), D(a), D(b), side);
                if ((operation.x & uint(TAPE_MIXES)) != 0u) {
                    m[a] = mixed(both, share, m[a], m[b]);
                } else {
                    m[a] = chosen(both, share, m[a], m[b]);
                }
                D(a) = both;
            } else {
                D(a) = sided(combine_of(kind, D(a), D(b)), D(a), D(b), side);
            }
            break;
        }
        case TAPE_OP_DISTANCE:
            D(a) = change_of(kind, D(a));
            break;
        case TAPE_OP_TRANSFORM:
            POINT(to) = local(POINT(point), P(0), P(1), P(2));
            break;
        case TAPE_OP_WARP:
            POINT(to) = warp_of(kind, POINT(point));
            break;
        case TAPE_OP_AFTER:
            D(a) = max(after_of(kind, D(a), POINT(point)), tape_number(TAPE_TEXEL(row + 1).x));
            break;
#if TAPE_LOOPS > 0
        case TAPE_OP_LOOP: {
            first[depth] = first_of(kind, POINT(point));
            last[depth] = last_of(kind, POINT(point));
            cell[depth] = first[depth];
            left[depth] = min(int(cell_count(first[depth], last[depth])), TAPE_CELLS);
            D(a) = FAR;
            if (surfaces) {
                m[a] = mixture_far();
            }
            if (left[depth] > 0) {
                POINT(to) = cell_of(kind, POINT(point), cell[depth]);
                depth++;
            } else {
                i += int(TAPE_TEXEL(row + 1).y);
            }
            break;
        }
        case TAPE_OP_LOOP_END: {
            int inner = depth - 1;
            if (D(b) < D(a)) {
                D(a) = D(b);
                if (surfaces) {
                    m[a] = m[b];
                }
            }
            cell[inner] = cell_next(cell[inner], first[inner], last[inner]);
            left[inner]--;
            if (left[inner] > 0) {
                POINT(to) = cell_of(kind, POINT(point), cell[inner]);
                i -= int(TAPE_TEXEL(row + 1).y);
            } else {
                depth = inner;
            }
            break;
        }
#endif
        default: {
            D(a) = FAR;
            if (surfaces) {
                m[a] = mixture_far();
            }
            break;
        }
        }
        if (surfaces && (op == TAPE_OP_DISTANCE || op == TAPE_OP_AFTER)) {
            m[a].d = D(a);
        }
    }
    if (surfaces) {
        result = m[0];
    }
    return D(0);
}

float map(vec3 p)
{
    Mixture none;
    Cube cube = cube_at(p, false, tapes_unit());
    return run(int(cube.row.y), int(cube.row.z), p, false, none);
}

float tapes_bound(vec3 p, float enough)
{
    Mixture none;
    float unit = tapes_unit();
    Cube cube = cube_at(p, enough < FAR, unit);
    if (enough < FAR && cube_bounds(cube, unit)) {
        float bound = cube_bound(cube, p, unit);
        if (abs(bound) >= enough) {
            return bound;
        }
        cube = cube_at(p, false, unit);
    }
    return run(int(cube.row.y), int(cube.row.z), p, false, none);
}
