/* SPDX-License-Identifier: MIT */
/* The field program: a scene's tree of nodes as a flat list of typed instructions in post-order,
 * and one buffer with every number. It is evaluated in C by field_distance and related functions
 * (double precision), and in GLSL by the text of shader.h.
 *
 * The structure (instructions, hence GLSL) depends on the types of the nodes and on their nesting.
 * Everything else is numbers: transforms, parameters, ids, materials and their assignment, and the
 * visibility of nodes. Two fields of equal structure_hash share one GLSL program.
 *
 * A hidden node has no effect on the field, its bounds or the answers of GLSL. Its shapes are at
 * the distance FIELD_FAR. An operation whose result would differ from that without the operand
 * takes the visible side alone (enum field_side). The C evaluator skips hidden nodes. A hidden node
 * that no program contains yet is left out.
 *
 * Transforms are folded: a shape lies in the space of the domain modifier around it, or of the
 * scene. Its distance is scaled to the scene by the smallest scale of each level. A field
 * never changes faster than the distance, and is negative inside.
 *
 * Immutable after field_compile. An edit makes another field, by field_patch where possible. One
 * thread counts the references. Another thread may read while the owner holds one for it. */
#ifndef RENDERER_FIELD_H
#define RENDERER_FIELD_H

#include <stdint.h>

#include "protocol/limits.h"
#include "protocol/scene.h"
#include "renderer/code/code.h"
#include "renderer/field/section.h"
#include "renderer/sdf/bounds.h"
#include "renderer/sdf/sdf.h"

enum field_op {
    FIELD_EMPTY,     /* d[a] = far away */
    FIELD_SHAPE,     /* d[a] = shape(matrix * p[point]) * scale */
    FIELD_COMBINE,   /* d[a] = combine(d[a], d[b]) */
    FIELD_DISTANCE,  /* d[a] = change(d[a]) */
    FIELD_TRANSFORM, /* p[out] = matrix * p[point] */
    FIELD_WARP,      /* p[out] = map(p[point]) */
    FIELD_AFTER,     /* d[a] = after(d[a], p[point]) */
    FIELD_LOOP,     /* d[a] = far away; for each cell around p[point]: p[out] = that cell's point */
    FIELD_LOOP_END, /* d[a] = min(d[a], d[b]) */
    FIELD_GUARD,    /* g = distance of p[point] to a box; unless 0 = g or g < d[a]: to the end */
    FIELD_GUARD_END, /* where g > 0: d[a] = max(d[a], g) */
};

/* What a FIELD_COMBINE with `seen` makes of its operands: both, or one alone as it is. */
enum field_side { FIELD_FIRST = -1, FIELD_BOTH, FIELD_SECOND };

struct field_instruction {
    enum field_op op;
    const struct node_type *type; /* NULL for FIELD_EMPTY */
    const struct sdf *sdf;        /* NULL for a shape of a user's code */
    uint16_t a, b;                /* distance slots */
    uint16_t point, out;          /* point slots; 0 is the point asked for */
    /* What enumerated parameters hold, eight bits each, the last lowest; of a shape of a user's
     * code: which of field.codes it is; of a polynomial FIELD_POLYNOMIAL, of patches
     * FIELD_PATCHES. */
    uint32_t choices;
    uint32_t params;    /* first vec4 of what it reads */
    uint32_t arguments; /* the same for the C evaluator: index into field.arguments */
    /* Index into field.params, 0: none. Of FIELD_COMBINE its enum field_side; of FIELD_AFTER what
     * the distance is at least: FIELD_FAR where nothing is seen of it, else -FIELD_FAR. */
    uint32_t seen;
    /* No part of the shape, for the C evaluator: */
    bool hidden; /* nothing is seen of it */
    enum field_side side;
};

/* A shape's block of numbers: three rows of its matrix, then (scale, leaf, material slot,
 * transmissive, away), then its parameters. Blocks of domain modifiers: three rows, then the row's
 * own vec4s.
 *
 * `away` is added to the distance: 0, or FIELD_FAR where the shape is not seen.
 *
 * `transmissive` is 1 where the material lets light through, -1 where it does not, and 0 where the
 * shape cuts another, as every child but the first of a difference or an intersection does. GLSL
 * may look at the opaque or at the transmissive shapes alone (`field_mask` in
 * glsl/field_mask.glsl); C sees all.
 *
 * Where the shape cuts another, its face is that other's, in the material of the cut: light goes
 * through only where both let it. FIELD_CUTS_... is then added to the slot, a whole number. */
enum {
    FIELD_MATRIX_VEC4S = 3,
    FIELD_HEAD_NUMBERS = 5,
    /* Components of the head. */
    FIELD_SCALE = 0,
    FIELD_LEAF = 1,
    FIELD_SLOT = 2,
    FIELD_TRANSMISSIVE = 3,
    FIELD_AWAY = 4,
};
#define FIELD_CUTS_TRANSMISSIVE 0.25
#define FIELD_CUTS_OPAQUE 0.5
#define FIELD_FAR 1e9 /* empty space is this far away, as in glsl/field_mask.glsl */

/* Behind the head of a shape of a user's code, which takes two vec4s: (half of the box that cuts
 * it, scale), (unsteady, loose, jump, 0), then what it declares. Distances above `unsteady` alone
 * change no faster than the way, others may differ by `jump` more; none is below minus `unsteady`:
 * see equation_unsteady() and, for estimates, polynomial.h. 0: all are steady. Any two distances
 * may differ by `loose` more than the way: see patches_loose(). */
enum {
    FIELD_HEAD_VEC4S = 2,
    FIELD_CUT_VEC4S = 2,
    FIELD_CUT_NUMBERS = SDF_CUT_NUMBERS,
    FIELD_UNSTEADY = 4,
    FIELD_LOOSE = 5,
    FIELD_JUMP = 6,
};
#define FIELD_UNCUT 1e9 /* half of a box without an end */
/* Behind these of a polynomial: the numbers of renderer/sdf/polynomial.h. */
#define FIELD_POLYNOMIAL UINT32_MAX
/* And of patches those of renderer/sdf/patches.h. */
#define FIELD_PATCHES (UINT32_MAX - 1)

/* A guard's two vec4s: (centre of the box, from the slot's lengths to the scene's), (half, 0).
 *
 * What stands between the guard and its end only lowers d[a] to the distance of what is in the
 * box: where the box is farther than d[a] that changes nothing, and where it is nearer, so much is
 * sure to be free. Guards are left out where surfaces are asked for: that happens once. */

/* The first vec4s of a material: (diffuse, gloss), (specular, 0), (emission, shader), (ambient,
 * unlit), (reflectivity, transmission, index of refraction, model), (absorption, 0), each as in
 * glsl/surface.glsl. Shader i + 1 is field.shaders[i], whose parameters follow; 0: none. The colour
 * that a shader gives is added to diffuse, or to emission where it is unlit. */
enum {
    FIELD_MATERIAL_VEC4S = 6,
    FIELD_MATERIAL_NUMBERS = 4 * FIELD_MATERIAL_VEC4S,
    /* Components of these numbers. */
    FIELD_DIFFUSE = 0,
    FIELD_GLOSS = 3,
    FIELD_SPECULAR = 4,
    FIELD_EMISSION = 8,
    FIELD_SHADER = 11,
    FIELD_AMBIENT = 12,
    FIELD_UNLIT = 15,
    FIELD_REFLECTIVITY = 16,
    FIELD_TRANSMISSION = 17,
    FIELD_IOR = 18,
    FIELD_MODEL = 19,
    FIELD_ABSORPTION = 20,
};

/* No nesting needs more: two slots for each level and one for the whole. */
enum { FIELD_SLOTS_MAX = 2 * LIMIT_NODE_DEPTH + 4 };

struct field_leaf {
    uint32_t number; /* 1 + pre-order index over all nodes, hidden ones too */
    char *id;
};

/* Where a parameter lies in the block of its node; vec4 is -1 where it is not there (choices,
 * texts). */
struct param_slot {
    int vec4, component, count;
};

/* Code that a field calls: user_I or shade_I in GLSL. */
struct field_code {
    const char *text; /* only to tell codes apart while compiling */
    bool own;         /* ours (shades.h and equation_code.h in renderer/code), not a user's */
    struct code *code;
    char place[ERROR_PLACE_BYTES];            /* of the text in the document */
    uint64_t hash;                            /* of the text and of what it declares */
    struct param_slot places[SDF_PARAMS_MAX]; /* of what it declares, in a block of `vec4s` */
    int place_count, vec4s;
};

struct field {
    struct field_instruction *instructions;
    size_t instruction_count;
    float *params;          /* 4 * vec4_count: blocks, one material for each slot, padding */
    size_t vec4_count;      /* the same for every field of this structure_hash */
    size_t material_base;   /* vec4 of slot 0, the default material; slot i + 1 is materials[i] */
    size_t material_stride; /* vec4s of one slot */
    size_t material_count;  /* without the default and the floor's, which is the last */
    struct field_code *codes, *shaders;
    size_t code_count, shader_count;
    double *arguments; /* the numbers again, as the C evaluator reads them */
    size_t argument_count;
    struct field_leaf *leaves; /* ascending */
    size_t leaf_count;
    size_t shape_count; /* FIELD_SHAPEs */
    size_t code_size;   /* of users' code: code_size() for each shape and each shader */
    uint64_t *members;  /* hashes of the nodes that stand in the program, ascending */
    size_t member_count;
    int point_slots, distance_slots;
    uint64_t structure_hash;
    /* At most so many loop iterations for one evaluation. A driver that bounds a shader's loops
     * must be kept from steps * (1 + loop_trips) above its bound. */
    uint32_t loop_trips;
    struct bounds bounds;               /* of what is seen */
    struct bounds transmissive_bounds;  /* of what light goes through in it */
    bool transmissive;                  /* there is any of that */
    const struct field_code *user_code; /* the first that is not ours; NULL: none */
    int references;
    /* For field_patch: the one that was compiled, which owns all but the numbers and arguments of
     * this one (NULL: this is it), patches since then, and where nodes stand (of the newest). */
    struct field *base;
    uint64_t version;
    struct field_sites *sites;
};

/* The program of a scene, with one reference. NULL and `err` where transforms multiply to numbers
 * that no float can hold. Hidden nodes are left out. */
struct field *field_compile(const struct scene *scene, struct error *err);
/* What else a program is to be. */
struct field_options {
    /* Hidden nodes that stand in this one stay in the program: where nothing else has changed it
     * has the same shape. NULL: none. */
    const struct field *drawn;
    /* Ids of nodes: with any of them in the scene, only their subtrees are seen, inside of what is
     * around them. That is a matter of numbers. The floor stays. An operation does not see operands
     * without them: of a difference, the first that is seen is what others are taken from. */
    const char *const *isolated;
    size_t isolated_count;
    bool patchable; /* field_patch can have it: where nodes stand is kept; not with `isolated` */
    /* Operands of unions that have no end are not seen, nor is the floor. */
    bool ended;
};
struct field *field_compile_as(const struct scene *scene, const struct field_options *options,
                               struct error *err);
struct field *field_ref(struct field *field);
void field_unref(struct field *field); /* NULL: nothing */

/* Whether it is small enough for compilers of shaders. */
bool field_can_be_compiled(const struct field *field);
/* The same for shaders that read it as data. */
bool field_can_be_interpreted(const struct field *field);

/* The id of the leaf with this number; NULL: none has it. */
const char *field_leaf_id(const struct field *field, uint32_t number);

/* The places of parameters (ending with a row whose name is NULL) behind the head of a block.
 * The first `used` components are taken. Returns how many vec4s it has from there. */
int field_layout(const struct param *params, int used, struct param_slot out[SDF_PARAMS_MAX]);

/* Tries out users' code at many points, a while at a time: with the numbers of up to 8 shapes of
 * each code, and of a shader's first material. Holds the field. */
struct field_trial;
#define FIELD_TRIAL_ALL INT64_MAX
struct field_trial *field_trial_create(struct field *field);
void field_trial_destroy(struct field_trial *trial); /* NULL: nothing */
/* Whether both try the same code with the same numbers. */
bool field_trial_is_same(const struct field_trial *a, const struct field_trial *b);
/* For about so many microseconds, at least at one point. */
void field_trial_go_on(struct field_trial *trial, int64_t us);
bool field_trial_is_over(const struct field_trial *trial);
/* With place and line, where something is no number: it cannot be drawn. */
const struct error *field_trial_error(const struct field_trial *trial);
/* Of a function that changes faster than it should. ERROR_NONE: there is none. */
const struct error *field_trial_warning(const struct field_trial *trial);
/* All of it at once; false and `err`: field_trial_error. */
bool field_try(struct field *field, struct error *out_warning, struct error *err);

/* --- evaluation --- */

double field_distance(const struct field *field, const double p[3]);

struct field_surface {
    double distance;
    uint32_t number;                         /* of the leaf of greatest weight; 0: empty space */
    double material[FIELD_MATERIAL_NUMBERS]; /* mixed by weight, laid out as in the buffer */
};
/* How a point is looked at, for shaders. */
struct field_view {
    double normal[3], direction[3], distance;
};
/* `view` may be NULL: then all of it is 0. */
struct field_surface field_surface(const struct field *field, const double p[3],
                                   const struct field_view *view);

/* Unit vector along the gradient, by the corners of a tetrahedron of half edge `h` (Quilez,
 * Normals for an SDF, iquilezles.org/articles/normalsSDF). */
void field_normal(const struct field *field, const double p[3], double h, double out[3]);

/* Sphere tracing (Hart 1996). The first point of the ray within `tolerance` of the surface: its
 * distance along the unit vector `direction`; -1 where there is none below `max_distance`. */
double field_march(const struct field *field, const double origin[3], const double direction[3],
                   double max_distance, double tolerance);

/* The same of what a section leaves, with a bound on its steps, each of which evaluates the field
 * once. */
double field_march_within(const struct field *field, const double origin[3],
                          const double direction[3], const struct section *section,
                          double max_distance, double tolerance, int max_steps);

/* Instructions of one evaluation, and operations of code in it, at most. */
uint64_t field_work(const struct field *field);

#endif
