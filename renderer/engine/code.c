/* SPDX-License-Identifier: MIT */
/* Users' code for a vector of points: the steps of renderer/code/machine.h over a frame of vectors.
 * A float is a float there, whole numbers are the bits of int and uint, a bool is a mask.
 *
 * Lanes that jump elsewhere than others wait. The lanes that are deepest in calls go on, of these
 * the ones whose step comes first, so all meet again where their ways do. */

typedef vf each_function(struct lanes *c, vb m, vf x, vf y, vf z);
typedef vf one_function(struct lanes *c, vb m, const vf *x, const vf *y, const vf *z);
typedef void all_function(struct lanes *c, vb m, const vf *x, const vf *y, const vf *z, vf *out);

enum {
    STEP_BITS = 16, /* of a lane's position: calls that are not open, then the step */
    NOT_WAITING = INT32_MAX,
    CALLS_MAX = LIMIT_CODE_DEPTH + 1,
    PARTS_MAX = 16,
};

/* Lanes `m` are at step `at`, `depth` calls deep; others wait. */
struct walk {
    struct lanes *c;
    const struct engine_code *code;
    vf *frame;
    vb m, started;
    bool apart; /* not all that started */
    int at, depth;
    vi waiting;  /* where, NOT_WAITING */
    int nearest; /* of these */
    vi returns[CALLS_MAX];
};

/* --- where lanes are --- */

static int position(int depth, int at)
{
    return (CALLS_MAX - depth) << STEP_BITS | at;
}

static void let_wait(struct walk *w, vb m, int where)
{
    w->waiting = vi_select(m, vi_all(where), w->waiting);
    w->m &= ~m;
    w->apart = true;
    w->nearest = where < w->nearest ? where : w->nearest;
}

static void find_nearest(struct walk *w)
{
    w->nearest = NOT_WAITING;
    for (int i = 0; i < LANES; i++) {
        w->nearest = w->waiting[i] < w->nearest ? w->waiting[i] : w->nearest;
    }
}

/* Those who wait nearest go on. */
static void go_on(struct walk *w)
{
    const int where = w->nearest;

    w->m = w->waiting == where;
    w->waiting = vi_select(w->m, vi_all(NOT_WAITING), w->waiting);
    w->apart = lanes_any(w->started & ~w->m);
    w->depth = CALLS_MAX - (where >> STEP_BITS);
    w->at = where & ((1 << STEP_BITS) - 1);
    find_nearest(w);
}

/* Some lanes go ahead to step `to`, the others to the next. */
static void branch(struct walk *w, vb jumps, int to)
{
    if (!lanes_any(w->m & ~jumps)) {
        w->at = to;
        return;
    }
    if (lanes_any(jumps)) {
        let_wait(w, jumps, position(w->depth, to));
    }
    w->at++;
}

/* Each lane to where it was called from. */
static void come_back(struct walk *w)
{
    if (w->depth == 0) {
        w->m = vb_zero;
        return;
    }
    const vi to = w->returns[--w->depth];
    const int first = to[lanes_first(w->m)];
    vb others = w->m & (to != first);
    w->at = first;
    while (lanes_any(others)) {
        const int other = to[lanes_first(others)];
        const vb same = others & (to == other);
        let_wait(w, same, position(w->depth, other));
        others &= ~same;
    }
}

/* --- what a step computes --- */

static void put(const struct walk *w, vf *to, vf x)
{
    *to = w->apart ? vf_select(w->m, x, *to) : x;
}

/* The places may overlap. */
static void put_all(const struct walk *w, vf *to, const vf *from, int count, int stride)
{
    if (to > from && stride) {
        for (int i = count; i-- > 0;) {
            put(w, to + i, from[i]);
        }
        return;
    }
    const vf first = from[0];
    for (int i = 0; i < count; i++) {
        put(w, to + i, stride ? from[i] : first);
    }
}

static void put_product(const struct walk *w, const struct step *s, vf *to, const vf *a,
                        const vf *b)
{
    vf out[PARTS_MAX];
    const int rows = s->n, inner = s->c, columns = s->extra;

    for (int column = 0; column < columns; column++) {
        for (int row = 0; row < rows; row++) {
            vf sum = a[row] * b[column * inner];
            for (int i = 1; i < inner; i++) {
                sum += a[i * rows + row] * b[column * inner + i];
            }
            out[column * rows + row] = sum;
        }
    }
    put_all(w, to, out, rows * columns, 1);
}

static void put_together(const struct walk *w, const struct step *s)
{
    const struct engine_call *call = &w->code->calls[s - w->code->machine->steps];
    const vf *const x = w->frame + s->a;
    const vf *const y = s->b == MACHINE_NOWHERE ? x : w->frame + s->b;
    const vf *const z = s->c == MACHINE_NOWHERE ? x : w->frame + s->c;
    vf out[PARTS_MAX];

    if (call->gives_one) {
        put(w, w->frame + s->out, CALL(one_function, call->function)(w->c, w->m, x, y, z));
        return;
    }
    if (!w->apart) { /* kernels write nothing before they have read all */
        CALL(all_function, call->function)(w->c, w->m, x, y, z, w->frame + s->out);
        return;
    }
    CALL(all_function, call->function)(w->c, w->m, x, y, z, out);
    put_all(w, w->frame + s->out, out, s->parts, 1);
}

static vf compare(enum base base, bool or_equal, vf a, vf b)
{
    switch (base) {
    case BASE_INT:
        return (vf)(or_equal ? (vi)a <= (vi)b : (vi)a < (vi)b);
    case BASE_UINT:
        return (vf)(or_equal ? (vu)a <= (vu)b : (vu)a < (vu)b);
    default:
        return (vf)(or_equal ? a <= b : a < b);
    }
}

static vf all_equal(const struct step *s, const vf *a, const vf *b)
{
    vb same = vb_all(true);

    for (int i = 0; i < s->n; i++) {
        same &= s->base == BASE_FLOAT ? a[i] == b[i] : (vi)a[i] == (vi)b[i];
    }
    return (vf)same;
}

static vf whole(const struct step *s, vf x, vf y)
{
    const vu a = (vu)x, b = (vu)y;
    vu out = vu_zero;

    switch ((enum op)s->extra) {
    case OP_ADD:
        return (vf)(a + b);
    case OP_SUBTRACT:
        return (vf)(a - b);
    case OP_MULTIPLY:
        return (vf)(a * b);
    case OP_SHIFT_LEFT:
        return (vf)(a << (b & 31u));
    case OP_SHIFT_RIGHT:
        return s->flags & STEP_UNSIGNED ? (vf)(a >> (b & 31u)) : (vf)((vi)a >> (vi)(b & 31u));
    case OP_BIT_AND:
        return (vf)(a & b);
    case OP_BIT_OR:
        return (vf)(a | b);
    case OP_BIT_XOR:
        return (vf)(a ^ b);
    default: /* no vectors divide whole numbers */
        for (int i = 0; i < LANES; i++) {
            out[i] = machine_whole((enum op)s->extra, a[i], b[i], s->flags & STEP_UNSIGNED);
        }
        return (vf)out;
    }
}

/* The bounds are those of glsl/code.glsl: floats just inside of what the types hold. */
static vf convert_float(vf x, enum base to)
{
    switch (to) {
    case BASE_INT:
        x = vf_clamp(vf_select(x == x, x, vf_zero), vf_all(-2147483520.0f), vf_all(2147483520.0f));
        return (vf)vi_of_f(x);
    case BASE_UINT:
        x = vf_clamp(vf_select(x == x, x, vf_zero), vf_zero, vf_all(4294967040.0f));
        return (vf)vu_of_f(x);
    default:
        return (vf)(x != 0.0f);
    }
}

static vf convert(enum base from, enum base to, vf x)
{
    if (from == BASE_FLOAT) {
        return convert_float(x, to);
    }
    if (from == BASE_BOOL) {
        return to == BASE_FLOAT ? vf_of_b((vb)x) : (vf)vi_of_b((vb)x);
    }
    return to == BASE_BOOL ? (vf)((vi)x != 0) : from == BASE_INT ? vf_of_i((vi)x) : vf_of_u((vu)x);
}

/* The number at `a` kept in 0 ... c - 1, times n. */
static vi index_of(const struct step *s, vf a)
{
    const vi at = s->base == BASE_UINT ? (vi)vu_min((vu)a, vu_all(s->c - 1u))
                                       : vi_clamp((vi)a, vi_zero, vi_all(s->c - 1));

    return at * s->n;
}

/* The same for all lanes needs no choice between them. */
#define PUT_EACH(value)                                                                            \
    if (w->apart) {                                                                                \
        for (int i = 0; i < s->n; i++) {                                                           \
            out[i] = vf_select(w->m, value, out[i]);                                               \
        }                                                                                          \
    } else {                                                                                       \
        for (int i = 0; i < s->n; i++) {                                                           \
            out[i] = value;                                                                        \
        }                                                                                          \
    }
#define EACH(value)                                                                                \
    PUT_EACH(value)                                                                                \
    break
#define A a[i * step_a]
#define B b[i * step_b]

static void compute_call(const struct walk *w, const struct step *s)
{
    const struct engine_call *call = &w->code->calls[s - w->code->machine->steps];
    vf *const out = w->frame + s->out;
    const vf *a = w->frame + s->a, *b = s->kind == STEP_ONE ? a : w->frame + s->b;
    const vf *c = s->kind == STEP_THREE ? w->frame + s->c : a;
    const int step_a = !(s->flags & SPREAD_A), step_b = !(s->flags & SPREAD_B);
    const int step_c = s->kind == STEP_THREE ? !(s->flags & SPREAD_C) : step_a;

    switch (call->direct) {
    case CALL_MIN:
        PUT_EACH(vf_min(A, B))
        break;
    case CALL_MAX:
        PUT_EACH(vf_max(A, B))
        break;
    case CALL_ABS:
        PUT_EACH(vf_abs(A))
        break;
    case CALL_CLAMP:
        PUT_EACH(vf_min(vf_max(A, B), c[i * step_c]))
        break;
    case CALL_FUNCTION:
        PUT_EACH(CALL(each_function, call->function)(w->c, w->m, A, B, c[i * step_c]))
    }
}

/* Steps that only move what is there. */
static void move(const struct walk *w, const struct step *s)
{
    vf *const out = w->frame + s->out, copy[4];
    const vf *const a = w->frame + s->a, *const b = w->frame + s->b;

    switch ((enum step_kind)s->kind) {
    case STEP_MOVE:
        put_all(w, out, a, s->n, !(s->flags & SPREAD_A));
        break;
    case STEP_GATHER:
        EACH(a[s->extra >> (2 * i) & 3]);
    case STEP_SCATTER:
        memcpy(copy, a, s->n * sizeof *copy);
        for (int i = 0; i < s->n; i++) {
            put(w, out + (s->extra >> (2 * i) & 3), copy[i]);
        }
        break;
    case STEP_LOAD:
        EACH(lanes_pick(a, (vi)*b + i, w->m));
    case STEP_STORE:
        for (int i = 0; i < s->n; i++) {
            lanes_put(out, (vi)*b + i, a[i], w->m);
        }
        break;
    default:
        EACH(vf_zero);
    }
}

static void compute(const struct walk *w, const struct step *s)
{
    vf *const out = w->frame + s->out;
    const vf *const a = w->frame + s->a, *const b = w->frame + s->b;
    const int step_a = !(s->flags & SPREAD_A), step_b = !(s->flags & SPREAD_B);

    switch ((enum step_kind)s->kind) {
    case STEP_ADD:
        EACH(A + B);
    case STEP_SUBTRACT:
        EACH(A - B);
    case STEP_MULTIPLY:
        EACH(A * B);
    case STEP_DIVIDE:
        EACH(A / vf_select(B == 0.0f, vf_all((float)BUILTIN_TINY), B));
    case STEP_NEGATE:
        EACH(-A);
    case STEP_LESS:
    case STEP_LESS_EQUAL:
        EACH(compare((enum base)s->base, s->kind == STEP_LESS_EQUAL, A, B));
    case STEP_EQUAL:
        put(w, out, all_equal(s, a, b));
        break;
    case STEP_NOT:
        EACH((vf) ~(vb)A);
    case STEP_WHOLE:
        EACH(whole(s, A, B));
    case STEP_CONVERT:
        EACH(convert((enum base)s->base, (enum base)s->extra, A));
    case STEP_PRODUCT:
        put_product(w, s, out, a, b);
        break;
    case STEP_ONE:
    case STEP_TWO:
    case STEP_THREE:
        compute_call(w, s);
        break;
    case STEP_TOGETHER:
        put_together(w, s);
        break;
    case STEP_INDEX:
        put(w, out, (vf)(index_of(s, *a) + (s->b == MACHINE_NOWHERE ? vi_zero : (vi)*b)));
        break;
    default:
        move(w, s);
    }
}
#undef A
#undef B
#undef EACH
#undef PUT_EACH

/* One that leads elsewhere. */
static void take_step(struct walk *w, const struct step *s)
{
    vf *const counter = w->frame + s->a;

    switch ((enum step_kind)s->kind) {
    case STEP_JUMP:
        w->at = s->out;
        break;
    case STEP_UNLESS:
        branch(w, w->m & ~(vb)*counter, s->out);
        break;
    case STEP_LOOP: /* lanes that are here have gone around as often */
        put(w, counter, *counter + 1.0f);
        w->at = lanes_any(w->m & (*counter < w->frame[s->b])) ? s->out : w->at + 1;
        break;
    case STEP_CALL:
        w->returns[w->depth] = vi_select(w->m, vi_all(w->at + 1), w->returns[w->depth]);
        w->depth++;
        w->at = s->out;
        break;
    default:
        come_back(w);
    }
}

/* From the code's entry, in its frame, for these lanes. */
static void walk(struct lanes *c, vb m, const struct engine_code *code, vf *frame)
{
    struct walk w = {.c = c,
                     .code = code,
                     .frame = frame,
                     .m = m,
                     .started = m,
                     .at = (int)code->machine->entry,
                     .waiting = vi_all(NOT_WAITING),
                     .nearest = NOT_WAITING};

    for (;;) {
        const struct step *s = &code->machine->steps[w.at];
        if (s->kind >= STEP_JUMP) {
            take_step(&w, s);
        } else { /* the one call of a long function, which becomes a part of this one */
            compute(&w, s);
            w.at++;
            if (!w.apart) { /* nobody waits, and nobody leaves */
                continue;
            }
        }
        if (!lanes_any(w.m)) {
            if (w.nearest == NOT_WAITING) {
                return;
            }
            go_on(&w);
        } else if (position(w.depth, w.at) >= w.nearest) {
            let_wait(&w, w.m, position(w.depth, w.at));
            go_on(&w);
        }
    }
}

/* --- frames --- */

/* A thread's own; each is made when its code first runs. */
static vf **frames_create(const struct engine_program *program)
{
    return memory_alloc(program->code_count + 1, sizeof(vf *));
}

static void frames_destroy(const struct engine_program *program, vf **frames)
{
    for (size_t i = 0; i < program->code_count; i++) {
        free(frames[i]);
    }
    free(frames);
}

static vf constant(enum base base, double x)
{
    switch (base) {
    case BASE_FLOAT:
        return vf_all((float)x);
    case BASE_BOOL:
        return (vf)vb_all(x != 0);
    default:
        return (vf)vu_all((uint32_t)(int64_t)x);
    }
}

/* The frame of a code, with the constants in it. It is longer than the code needs by
 * what a kernel may read behind a number that it takes as a vector. */
static vf *frame_of(struct lanes *c, const struct engine_code *code)
{
    const struct machine_code *machine = code->machine;
    vf **const at = &c->frames[code - c->program->codes];

    if (!*at) {
        const size_t count = machine_frame_size(machine) + PARTS_MAX;
        *at = aligned_alloc(sizeof(vf), count * sizeof(vf));
        if (!*at) {
            abort();
        }
        memset(*at, 0, count * sizeof(vf));
        for (size_t i = 0; i < machine->constant_count; i++) {
            (*at)[machine->value_count + i] =
                constant((enum base)machine->constant_bases[i], machine->constants[i]);
        }
    }
    return *at;
}

static vf declared(enum base base, vf x)
{
    switch (base) {
    case BASE_INT:
        return (vf)vi_of_f(vf_floor(x + 0.5f));
    case BASE_BOOL:
        return (vf)(x != 0.0f);
    default:
        return x;
    }
}

static void set_number(const struct machine_code *machine, vf *frame, int i, vf x)
{
    frame[machine->numbers + i] = declared((enum base)machine->number_bases[i], x);
    if (i < machine->data_count) {
        frame[machine->data + i] = x;
    }
}

static void set_no_data(const struct machine_code *machine, vf *frame)
{
    for (int i = machine->number_count; i < machine->data_count; i++) {
        frame[machine->data + i] = vf_zero;
    }
}

/* --- what asks --- */

/* A user's distance function at p. */
static vf run_code(struct lanes *c, vb m, const struct engine_code *code, const vf *p)
{
    const struct machine_code *machine = code->machine;
    vf *const frame = frame_of(c, code);
    vf point[3];

    spmd_kernel_code_point(c, m, p, point);
    memcpy(frame + machine->point, point, sizeof point);
    for (int i = 0; i < machine->number_count; i++) {
        set_number(machine, frame, i, vf_all(c->own[code->places[i]]));
    }
    set_no_data(machine, frame);
    walk(c, m, code, frame);
    return spmd_kernel_code_shape(c, m, frame[machine->result], p);
}

static void shade(struct lanes *c, vb m, const struct engine_code *code, vi material, const vf *at,
                  vf *color, vf *surface)
{
    const struct machine_code *machine = code->machine;
    vf *const frame = frame_of(c, code);

    if (machine->shading != MACHINE_NOWHERE) {
        memcpy(frame + machine->shading, at, SPMD_Shading * sizeof *at);
    }
    for (int i = 0; i < machine->number_count; i++) {
        set_number(machine, frame, i, lanes_gather(c->params + code->places[i], 4 * material, m));
    }
    set_no_data(machine, frame);
    walk(c, m, code, frame);
    const vf *const result = frame + machine->result;
    vf *const to = code->whole ? surface : color;
    for (int i = 0; i < machine->result_count; i++) {
        to[i] = vf_select(m, result[i], to[i]);
    }
    if (machine->result_count == 3) {
        color[3] = vf_select(m, vf_all(1.0f), color[3]);
    }
}

static vi spmd_ask_shader(struct lanes *c, vb m, vi shader, vi material, const vf *at, vf *color,
                          vf *surface)
{
    vi says = vi_zero;

    while (lanes_any(m)) {
        const int asked = shader[lanes_first(m)];
        const vb same = m & (shader == asked);
        const struct engine_code *code = &c->program->codes[c->program->distances + asked - 1];
        shade(c, same, code, material, at, color, surface);
        says = vi_select(same, vi_all(code->whole ? 2 : 1), says);
        m &= ~same;
    }
    return says;
}
