/* SPDX-License-Identifier: MIT */
/* The field program run in C: picking, probing, and the oracle for the GLSL that is made of it. */
#include <math.h>
#include <string.h>

#include "field.h"
#include "field_code.h"
#include "field_materials.h"

enum { MIXED_MAX = 4 };

/* A material's slot, its share of the whole (0: none), and the point in the space of the shape. */
struct material_share {
    size_t slot;
    double weight, place[3];
    double cuts; /* FIELD_CUTS_..., or 0 */
};

/* What is known of a surface besides its distance. */
struct material_mix {
    uint32_t leaf;
    double weight;                           /* of that leaf in what is seen */
    struct material_share shares[MIXED_MAX]; /* the strongest, in that order */
};

struct loop {
    size_t body; /* index of the first instruction in it */
    double first[3], last[3], cell[3];
};

struct machine {
    const struct field *field;
    struct material_mix *mixes; /* of each distance slot; NULL: distance alone */
    double d[FIELD_SLOTS_MAX];
    double p[FIELD_SLOTS_MAX][3];
    struct loop loops[LIMIT_NODE_DEPTH];
    int depth;
};

static void place(const double m[12], const double p[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = m[4 * i] * p[0] + m[4 * i + 1] * p[1] + m[4 * i + 2] * p[2] + m[4 * i + 3];
    }
}

static const float *material_numbers(const struct field *field, size_t slot)
{
    return field->params + 4 * (field->material_base + slot * field->material_stride);
}

/* A user's function, asked inside its box alone and cut by it: as in glsl/user.glsl. */
static double run_code(const struct field *field, const struct field_instruction *in,
                       const double p[3], const double *n)
{
    const double *cut = n + FIELD_HEAD_NUMBERS;
    double within[3], square = 0, face = -INFINITY;

    for (int i = 0; i < 3; i++) {
        const double beyond = fabs(p[i]) - cut[i];
        within[i] = fmin(fmax(p[i], -cut[i]), cut[i]);
        square += beyond > 0 ? beyond * beyond : 0;
        face = fmax(face, beyond);
    }
    double d =
        code_distance(field->codes[in->choices].code, within, cut + FIELD_CUT_NUMBERS, NULL) * n[0];
    return square > 0 ? hypot(sqrt(square) * cut[3], fmax(d, 0)) : fmax(d, face * cut[3]);
}

static void run_shape(struct machine *m, const struct field_instruction *in, const double *n)
{
    double local[3];

    place(n, m->p[in->point], local);
    n += 12;
    m->d[in->a] = in->sdf ? in->sdf->shape(local, n + FIELD_HEAD_NUMBERS) * n[0]
                          : run_code(m->field, in, local, n);
    if (!m->mixes) {
        return;
    }
    m->mixes[in->a] = (struct material_mix){.leaf = (uint32_t)n[FIELD_LEAF], .weight = 1};
    m->mixes[in->a].shares[0] =
        (struct material_share){.slot = (size_t)n[FIELD_SLOT],
                                .weight = 1,
                                .place = {local[0], local[1], local[2]},
                                .cuts = n[FIELD_SLOT] - floor(n[FIELD_SLOT])};
}

/* Takes a material in, in the place of the weakest if it is new. */
static void add_material_share(struct material_share shares[MIXED_MAX],
                               const struct material_share *more, double share)
{
    const double weight = more->weight * share;
    int i = 0;

    while (i < MIXED_MAX && !(shares[i].weight > 0 && shares[i].slot == more->slot &&
                              shares[i].cuts == more->cuts)) {
        i++;
    }
    if (i < MIXED_MAX) {
        const double sum = shares[i].weight + weight;
        shares[i] = weight > shares[i].weight ? *more : shares[i];
        shares[i].weight = sum;
    } else if (weight > shares[--i].weight) {
        shares[i] = *more;
        shares[i].weight = weight;
    }
    for (; i > 0 && shares[i].weight > shares[i - 1].weight; i--) {
        const struct material_share before = shares[i - 1];
        shares[i - 1] = shares[i];
        shares[i] = before;
    }
}

static void mix_mixes(struct material_mix *a, const struct material_mix *b, double share)
{
    const double wa = a->weight * (1 - share), wb = b->weight * share;

    a->leaf = wb > wa ? b->leaf : a->leaf;
    a->weight = fmax(wa, wb);
    for (int i = 0; i < MIXED_MAX; i++) {
        a->shares[i].weight *= 1 - share;
    }
    for (int i = 0; i < MIXED_MAX; i++) {
        add_material_share(a->shares, &b->shares[i], share);
    }
}

/* One operand alone. */
static void run_side(struct machine *m, const struct field_instruction *in)
{
    if (in->side == FIELD_SECOND) {
        m->d[in->a] = m->d[in->b];
        if (m->mixes) {
            m->mixes[in->a] = m->mixes[in->b];
        }
    }
}

static void run_combine(struct machine *m, const struct field_instruction *in, const double *n)
{
    double share;

    if (in->side != FIELD_BOTH) {
        run_side(m, in);
        return;
    }
    m->d[in->a] = in->sdf->combine(m->d[in->a], m->d[in->b], n, &share);
    if (m->mixes) {
        mix_mixes(&m->mixes[in->a], &m->mixes[in->b], share);
    }
}

static void run_empty(struct machine *m, uint16_t slot)
{
    m->d[slot] = FIELD_FAR;
    if (m->mixes) {
        m->mixes[slot] = (struct material_mix){.weight = 1, .shares = {{.weight = 1}}};
    }
}

static void run_loop(struct machine *m, const struct field_instruction *in, const double *n,
                     size_t body)
{
    struct loop *loop = &m->loops[m->depth++];

    loop->body = body;
    in->sdf->domain->range(m->p[in->point], n, loop->first, loop->last);
    memcpy(loop->cell, loop->first, sizeof loop->cell);
    in->sdf->domain->cell(m->p[in->point], loop->cell, n, m->p[in->out]);
    run_empty(m, in->a);
}

/* Takes the cell's result in; returns where to go on. */
static size_t run_loop_end(struct machine *m, const struct field_instruction *in, const double *n,
                           size_t next)
{
    if (m->d[in->b] < m->d[in->a]) {
        m->d[in->a] = m->d[in->b];
        if (m->mixes) {
            m->mixes[in->a] = m->mixes[in->b];
        }
    }
    struct loop *loop = &m->loops[m->depth - 1];
    for (int i = 0; i < 3; i++) {
        loop->cell[i] += 1;
        if (loop->cell[i] <= loop->last[i]) {
            in->sdf->domain->cell(m->p[in->point], loop->cell, n, m->p[in->out]);
            return loop->body;
        }
        loop->cell[i] = loop->first[i];
    }
    m->depth--;
    return next;
}

/* To a guard's box, in lengths of the scene; 0 inside. */
static double box_distance(const double p[3], const double *n)
{
    double q[3];

    for (int i = 0; i < 3; i++) {
        q[i] = fmax(fabs(p[i] - n[i]) - n[4 + i], 0);
    }
    return sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]) * n[3];
}

/* Returns where to go on. */
static size_t run_guard(const struct machine *m, const struct field_instruction *in,
                        const double *n, size_t next)
{
    const double distance = m->mixes ? 0 : box_distance(m->p[in->point], n);

    if (distance == 0 || distance < m->d[in->a]) {
        return next;
    }
    for (int depth = 1; depth > 0; next++) {
        const enum field_op op = m->field->instructions[next].op;
        depth += (op == FIELD_GUARD) - (op == FIELD_GUARD_END);
    }
    return next;
}

static void run_guard_end(struct machine *m, const struct field_instruction *in, const double *n)
{
    const double distance = m->mixes ? 0 : box_distance(m->p[in->point], n);

    if (distance > 0) {
        m->d[in->a] = fmax(m->d[in->a], distance);
    }
}

/* What others may read is empty space. */
static void run_hidden(struct machine *m, const struct field_instruction *in)
{
    if (in->op == FIELD_SHAPE || in->op == FIELD_LOOP) {
        run_empty(m, in->a);
    }
}

static void run(struct machine *m, const double p[3])
{
    const struct field *field = m->field;

    memcpy(m->p[0], p, sizeof m->p[0]);
    m->depth = 0;
    for (size_t i = 0; i < field->instruction_count;) {
        const struct field_instruction *in = &field->instructions[i++];
        const double *n = field->arguments + in->arguments;
        if (in->hidden) {
            run_hidden(m, in);
            continue;
        }
        switch (in->op) {
        case FIELD_EMPTY:
            run_empty(m, in->a);
            break;
        case FIELD_SHAPE:
            run_shape(m, in, n);
            break;
        case FIELD_COMBINE:
            run_combine(m, in, n);
            break;
        case FIELD_DISTANCE:
            m->d[in->a] = in->sdf->change(m->d[in->a], n);
            break;
        case FIELD_TRANSFORM:
            place(n, m->p[in->point], m->p[in->out]);
            break;
        case FIELD_WARP:
            in->sdf->domain->map(m->p[in->point], n, m->p[in->out]);
            break;
        case FIELD_AFTER:
            m->d[in->a] = in->sdf->domain->after(m->d[in->a], m->p[in->point], n);
            break;
        case FIELD_LOOP:
            run_loop(m, in, n, i);
            break;
        case FIELD_LOOP_END:
            i = run_loop_end(m, in, n, i);
            break;
        case FIELD_GUARD:
            i = run_guard(m, in, n, i);
            break;
        case FIELD_GUARD_END:
            run_guard_end(m, in, n);
            break;
        }
    }
}

double field_distance(const struct field *field, const double p[3])
{
    struct machine machine;

    machine.field = field;
    machine.mixes = NULL;
    run(&machine, p);
    return machine.d[0];
}

/* What a shader says of the point. */
static void apply_shader(const struct code *code, const struct material_share *material_share,
                         const double p[3], const struct field_view *view, const double *numbers,
                         double material[FIELD_MATERIAL_NUMBERS])
{
    struct code_shading at = {.ray_distance = view->distance};
    double color[4];

    memcpy(at.world_position, p, sizeof at.world_position);
    memcpy(at.object_position, material_share->place, sizeof at.object_position);
    memcpy(at.world_normal, view->normal, sizeof at.world_normal);
    memcpy(at.ray_direction, view->direction, sizeof at.ray_direction);
    if (code_gives_surface(code)) {
        struct code_surface surface;
        code_surface(code, &at, numbers, &surface, NULL);
        field_put_surface(material, &surface);
        return;
    }
    code_shade(code, &at, numbers, color, NULL);
    double *to = material + (material[FIELD_UNLIT] > 0 ? FIELD_EMISSION : FIELD_DIFFUSE);
    for (int i = 0; i < 3; i++) {
        to[i] += color[i];
    }
}

/* The numbers of a material at a point. */
static void shade_material(const struct field *field, const struct material_share *material_share,
                           const double p[3], const struct field_view *view,
                           double out[FIELD_MATERIAL_NUMBERS])
{
    const float *block = material_numbers(field, material_share->slot);
    double numbers[4 * LIMIT_DECLARED];
    const int shader = field_shader_numbers(field, material_share->slot, numbers);

    for (int i = 0; i < FIELD_MATERIAL_NUMBERS; i++) {
        out[i] = block[i];
    }
    if (shader >= 0) {
        apply_shader(field->shaders[shader].code, material_share, p, view, numbers, out);
    }
    out[FIELD_TRANSMISSION] *= material_share->cuts != FIELD_CUTS_OPAQUE;
}

/* The mean of the materials by their shares. The model is that of the first; gloss, which means
 * another thing in each model, the mean of those that share it. */
static void mix_materials(const struct field *field, const struct material_share shares[MIXED_MAX],
                          const double p[3], const struct field_view *view,
                          double out[FIELD_MATERIAL_NUMBERS])
{
    double gloss = 0, alike = 0, sum = 0, model = 0;

    for (int i = 0; i < MIXED_MAX; i++) {
        sum += shares[i].weight;
    }
    for (int i = 0; i < MIXED_MAX && shares[i].weight > 0; i++) {
        const double share = shares[i].weight / sum;
        double material[FIELD_MATERIAL_NUMBERS];
        shade_material(field, &shares[i], p, view, material);
        for (int j = 0; j < FIELD_MATERIAL_NUMBERS; j++) {
            out[j] += share * material[j];
        }
        model = i == 0 ? material[FIELD_MODEL] : model;
        if (material[FIELD_MODEL] == model) {
            alike += share;
            gloss += share * material[FIELD_GLOSS];
        }
    }
    out[FIELD_MODEL] = model;
    out[FIELD_GLOSS] = gloss / alike;
}

struct field_surface field_surface(const struct field *field, const double p[3],
                                   const struct field_view *view)
{
    static const struct field_view nowhere = {.distance = 0};
    struct material_mix mixes[FIELD_SLOTS_MAX];
    struct machine machine;

    machine.field = field;
    machine.mixes = mixes;
    run(&machine, p);
    struct field_surface out = {.distance = machine.d[0], .number = mixes[0].leaf};
    const struct material_share *shares = mixes[0].shares;
    mix_materials(field, shares, p, view ? view : &nowhere, out.material);
    return out;
}

void field_normal(const struct field *field, const double p[3], double h, double out[3])
{
    static const double corners[4][3] = {{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}};
    double sum[3] = {0};

    for (int i = 0; i < 4; i++) {
        double q[3];
        for (int j = 0; j < 3; j++) {
            q[j] = p[j] + h * corners[i][j];
        }
        const double d = field_distance(field, q);
        for (int j = 0; j < 3; j++) {
            sum[j] += d * corners[i][j];
        }
    }
    const double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    for (int j = 0; j < 3; j++) {
        out[j] = length > 0 ? sum[j] / length : j == 1;
    }
}

double field_march_within(const struct field *field, const double origin[3],
                          const double direction[3], const struct section *section,
                          double max_distance, double tolerance, int max_steps)
{
    double t = 0;

    for (int step = 0; step < max_steps && t < max_distance; step++) {
        double p[3];
        for (int i = 0; i < 3; i++) {
            p[i] = origin[i] + t * direction[i];
        }
        const double d = fmax(field_distance(field, p), section_beyond(section, p));
        if (d < tolerance) {
            return t;
        }
        t += d;
    }
    return -1;
}

double field_march(const struct field *field, const double origin[3], const double direction[3],
                   double max_distance, double tolerance)
{
    enum { STEPS_MAX = 10000 };
    static const struct section none = {0};
    return field_march_within(field, origin, direction, &none, max_distance, tolerance, STEPS_MAX);
}

/* Loops of shapes and modifiers themselves are in field.loop_trips. */
uint64_t field_work(const struct field *field)
{
    enum { WORK_MAX = INT32_MAX };
    uint64_t times[LIMIT_NODE_DEPTH + 1] = {1}, work = 1 + field->loop_trips;
    int depth = 0;
    for (size_t i = 0; i < field->instruction_count && work < WORK_MAX; i++) {
        const struct field_instruction *in = &field->instructions[i];
        uint64_t own = 1;
        if (in->op == FIELD_LOOP) {
            const int cells = in->sdf->domain->cells(field->arguments + in->arguments);
            depth++;
            times[depth] = times[depth - 1] * (uint64_t)cells;
            times[depth] = times[depth] < WORK_MAX ? times[depth] : WORK_MAX;
        } else if (in->op == FIELD_LOOP_END) {
            depth--;
        } else if (in->op == FIELD_SHAPE && !in->sdf) {
            own += (uint64_t)code_work(field->codes[in->choices].code);
        }
        work += times[depth] * own;
    }
    return work;
}
