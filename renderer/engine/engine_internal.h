/* SPDX-License-Identifier: MIT */
/* Shared by the files of the engine that are compiled for each vector width. */
#ifndef RENDERER_ENGINE_INTERNAL_H
#define RENDERER_ENGINE_INTERNAL_H

#include "engine.h"
#ifdef LANES
#include "lanes.h"
#endif
#include "renderer/code/machine.h"
#include "renderer/field/shader.h"
#include "trunk.h"

struct cubes;
struct explored;
struct extent;
struct noted;
struct seen_picture;

/* The functions that run operations of one kind. A field has few kinds. */
struct operation_kind {
    uint8_t op; /* enum field_op */
    uint32_t choices;
    const struct node_type *type;
    void (*function)(void), (*share)(void), (*cell)(void);
    double (*reach)(const double *n);
    int partial;                    /* FIELD_LOOP: sdf_domain.partial */
    const struct engine_code *code; /* FIELD_SHAPE: NULL, or a user's, instead of `function` */
};

/* An operation. It is small, because long tapes are bound by the bandwidth of memory. */
struct operation {
    uint8_t op;           /* enum field_op */
    bool mixes;           /* FIELD_COMBINE: surfaces mix, or one is chosen */
    bool prunes;          /* FIELD_COMBINE: an operand may be left out */
    bool lesser;          /* FIELD_COMBINE: the lesser distance, nothing else */
    bool unsteady;        /* FIELD_SHAPE: it has the numbers FIELD_UNSTEADY, FIELD_LOOSE */
    uint8_t rule, kernel; /* FIELD_COMBINE: enum sdf_rule; its choice */
    uint16_t kind;        /* among the program's */
    uint16_t a, b, point, out;
    uint32_t params, seen;
    uint32_t length; /* of a loop: operations from its first to its last */
};

/* A tape is a list of indices of operations; with a bit set, FIELD_COMBINE takes its second operand
 * alone. */
enum {
    TAPE_MOVE = 0x40000000,
    CUBE_CHILDREN = 8,
    BOUND_TAPE = 48, /* so many operations take longer than more steps by a bound (bounds.c) */
};
#define TAPE_NEGATE 0x80000000u

/* A cube of space, and its tape: the operations that matter in it. */
struct cell {
    int32_t corner[3];        /* its least coordinates, in units of the grid */
    uint8_t bits;             /* its side is 2 to so many of these */
    bool made;                /* it has a tape of its own; else it uses its parent's */
    bool owns;                /* its words among the tapes are no other cube's */
    bool splits;              /* its children are worth their cost; false without an own tape */
    bool worn;                /* the same, because its tape was used so often */
    uint16_t uses;            /* of its tape, while it is the smallest */
    uint16_t dropping;        /* the union of its `drops` */
    int32_t parent, children; /* the first of eight; 0: not made yet */
    float distance;           /* of the field in its centre */
    float centre[3], half;    /* the tape holds for LOOSE times this */
    uint32_t tape, count;     /* among the tapes */
    uint32_t drops;           /* what its children's tapes leave out, for each word of its own */
    const uint32_t *words;    /* its tape, where threads share it, or NULL */
    struct trunk_cube *trunk; /* what threads share of its children, with their drops, or NULL */
    uint32_t picture;         /* for which `splits` was decided, by its camera */
    /* Which squares of a part of a picture have used it (tile.c), a bit for each: by running its
     * tape, or as what bound_at() found. */
    uint32_t part;
    uint16_t run, found;
};

/* When what is used of a cube was last changed, in edits (renew.c). */
struct cell_news {
    uint32_t run;   /* its tape, or a number of an operation in it */
    uint32_t found; /* what bound_at() answers there */
};

struct cells {
    struct trunk *trunk; /* of all threads; NULL: they share nothing */
    float grid;          /* units of the grid in one of length, a power of two */
    struct cell *at;
    struct cell_news *news; /* of each */
    uint32_t times;         /* counts how often all cubes were made anew */
    size_t count, capacity;
    uint32_t *tapes;
    size_t used, room, wasted; /* words; those of tapes that were made again */
    uint16_t *drops;
    size_t drops_used, drops_room;
    int32_t last, bound_last; /* the cubes of the last questions, for a tape and for a bound */
};

static inline const uint32_t *cell_tape(const struct cells *cells, const struct cell *cell)
{
    return cell->words ? cell->words : cells->tapes + cell->tape;
}

static inline uint16_t *cell_drops(const struct cells *cells, const struct cell *cell)
{
    return cell->trunk ? cell->trunk->drops : cells->drops + cell->drops;
}

/* A builtin function that users' code calls. The smallest ones are computed in place. */
enum engine_direct { CALL_FUNCTION, CALL_MIN, CALL_MAX, CALL_ABS, CALL_CLAMP };
struct engine_call {
    void (*function)(void);
    bool gives_one; /* of a vector or matrix, one number */
    enum engine_direct direct;
};

/* A user's code. */
struct engine_code {
    const struct machine_code *machine;
    struct engine_call *calls;        /* of each step */
    uint16_t places[MACHINE_NUMBERS]; /* of the numbers that it declares, from the head of the
                                          shape's block or material on */
    bool whole;                       /* it gives all of a surface */
};

struct engine_width;

struct engine_program {
    int references;
    int threads;               /* 0: one for each processor */
    struct field *field;       /* which has the codes */
    struct engine_code *codes; /* distances, then shaders */
    size_t distances, code_count;
    const struct engine_width *width;
    struct operation *operations;
    size_t count;
    struct extent *extents; /* of each operation's numbers: changes.h */
    struct operation_kind *kinds;
    size_t kind_count, kind_room;
    struct {
        int material_base, material_stride;
    } scene;
};

/* A tile with what is around it. */
struct lanes_tile {
    int side; /* pixels in a row */
    float *geometry, *pixels, *counted;
};

struct kernel_row {
    int type;
    uint32_t choices;
    enum shader_kernel kernel;
    void (*function)(void);
};

/* Of a function that users' code calls, by its row in builtin_table. */
struct call_row {
    int row, base, size;
    bool gives_one;
    void (*function)(void);
};

/* Cubes of all shapes, of the opaque ones, and of the transmissive ones (field_mask). */
enum { ENGINE_SPACES = 3, ENGINE_THREADS = 64 };
void cells_finish(struct cells spaces[ENGINE_SPACES]);

struct hand; /* what a thread draws with: threads.c, tile.c */
struct engine_canvas {
    struct engine_picture picture;
    struct engine_cubes *keeper; /* has the cubes before and after this picture */
    struct cubes *cubes;
    uint32_t number;                    /* of the picture, above 0 */
    struct seen_picture *seen;          /* what is known of the last such picture; NULL: nothing */
    bool seeks;                         /* `seen` has not been looked up yet */
    bool verified;                      /* it is known which squares of `seen` are valid */
    struct hand *hands[ENGINE_THREADS]; /* each is made when it is first needed */
    struct engine_rect kept;            /* width 0: nothing is */
    float *pixels, *counted;   /* sums of the kept: four and two for each (glsl/sums.glsl) */
    struct engine_part *parts; /* of the tile that is being drawn; NULL: none is */
    size_t part_count;
};

/* The part of a tile that one thread draws at a time. */
struct engine_part {
    struct engine_rect rect;
    int thread; /* that has its cubes; -1: any */
    bool taken;
};

/* One call of engine_draw. */
struct engine_work {
    struct engine_rect tile;
    int from, until;
    const struct engine_output *outputs;
    size_t output_count;
    const struct engine_pause *pause;
};

struct engine_width {
    int lanes;
    const struct kernel_row *kernels;
    size_t kernel_count;
    const struct call_row *calls;
    size_t call_count;
    struct engine_drawn (*draw)(struct engine_canvas *canvas, const struct engine_work *work);
    /* Renews cubes for new numbers of the field. `changed`: for each operation, whether any of its
     * numbers changed (changes.h). `matches`: its tapes hold other indices; NULL: they do not. */
    void (*renew)(struct engine_program *program, struct cubes *cubes, const float *params,
                  const uint8_t *changed, const struct matches *matches);
    void (*hand_destroy)(struct hand *hand); /* NULL is nothing */
    uint64_t (*distances)(const struct engine_program *program, const float *params,
                          const float (*points)[3], size_t count, float half, float *out);
    /* Makes cubes where surfaces are, before any ray asks: of a space (mask: field_mask). */
    void (*explore)(const struct engine_program *program, const float *params,
                    const struct engine_extent *extent, float mask, struct explored *out);
    /* The same for new numbers of the field. `changed`: as above. */
    void (*explore_again)(const struct engine_program *program, const float *params,
                          const struct engine_extent *extent, float mask, const uint8_t *changed,
                          struct explored *explored);
    /* Makes a level of one of the maps. All levels but the first are made of the first. */
    void (*make_map)(const struct frame_uniforms *frame, struct engine_map maps[ENGINE_MAPS],
                     int number, int level);
};
extern const struct engine_width engine_16, engine_8, engine_4;
/* The widest that the processor has. */
const struct engine_width *engine_widest(void);

struct lanes;
struct machine;
struct scene_block {
    int material_base, material_stride;
};
struct dispatch_block {
    int origin[2];
    int mode, zero;
};
#define LANES_CONTEXT                                                                              \
    const struct engine_program *program;                                                          \
    const struct frame_uniforms *frame;                                                            \
    const struct dispatch_block *dispatch;                                                         \
    const struct scene_block *scene;                                                               \
    const struct engine_map *const *maps;                                                          \
    const float *params, *own;                                                                     \
    struct lanes_tile tile;                                                                        \
    struct cells *spaces, *cells;                                                                  \
    uint32_t picture;    /* number of the picture */                                               \
    struct noted *noted; /* what pixels depend on; NULL: not recorded */                           \
    int threads;         /* that have cells */                                                     \
    struct machine *machine;                                                                       \
    vb waiting; /* lanes that were told to ask again */                                            \
    vf **frames;

#ifdef LANES
static void lanes_texture(struct lanes *c, int unit, vb m, vf u, vf v, vf level, vf out[4]);
static int lanes_texture_size(struct lanes *c, int unit, int i);
static void lanes_texel(struct lanes *c, int unit, vb m, vi x, vi y, vi level, vf out[4]);
#endif

#endif
