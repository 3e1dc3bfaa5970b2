/* SPDX-License-Identifier: MIT */
/* A field as operations with the functions that run them. */
#include <stdlib.h>
#include <string.h>

#include "changes.h"
#include "protocol/memory.h"

/* Of those that the processor has, from the widest; NULL behind the last. */
static const struct engine_width *width_at(size_t index)
{
#ifdef __x86_64__
    static const struct engine_width *const widths[] = {&engine_16, &engine_8, &engine_4, NULL};
    const size_t first = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                                 __builtin_cpu_supports("avx512bw") &&
                                 __builtin_cpu_supports("avx512dq")
                             ? 0
                         : __builtin_cpu_supports("avx2") ? 1
                                                          : 2;
#else
    static const struct engine_width *const widths[] = {&engine_4, NULL};
    const size_t first = 0;
#endif
    return first + index < sizeof widths / sizeof widths[0] ? widths[first + index] : NULL;
}

const struct engine_width *engine_widest(void)
{
    return width_at(0);
}

int engine_lanes(size_t index)
{
    const struct engine_width *width = width_at(index);

    return width ? width->lanes : 0;
}

static const struct engine_width *width_of(int lanes)
{
    const struct engine_width *width = width_at(0);

    for (size_t i = 0; lanes > 0 && width && width->lanes != lanes; i++) {
        width = width_at(i);
    }
    return width;
}

static void (*find(const struct engine_width *width, const struct field_instruction *in,
                   enum shader_kernel kernel))(void)
{
    for (size_t i = 0; i < width->kernel_count; i++) {
        const struct kernel_row *row = &width->kernels[i];
        if (row->kernel == kernel && row->choices == in->choices && row->type == in->type->number) {
            return row->function;
        }
    }
    return NULL;
}

/* Which function it calls first; false: none is needed. */
static bool first_kernel(const struct field_instruction *in, enum shader_kernel *out)
{
    switch (in->op) {
    case FIELD_SHAPE:
        *out = KERNEL_SHAPE;
        return true;
    case FIELD_COMBINE:
        *out = KERNEL_COMBINE;
        return true;
    case FIELD_DISTANCE:
        *out = KERNEL_CHANGE;
        return true;
    case FIELD_WARP:
        *out = KERNEL_MAP;
        return true;
    case FIELD_AFTER:
        *out = KERNEL_AFTER;
        return true;
    case FIELD_LOOP:
        *out = KERNEL_FIRST;
        return true;
    default:
        return false;
    }
}

/* With its functions; false: one is missing. */
static bool make_kind(const struct engine_program *program, struct operation_kind *out,
                      const struct field_instruction *in)
{
    const struct engine_width *width = program->width;
    enum shader_kernel kernel;

    *out = (struct operation_kind){.op = (uint8_t)in->op, .choices = in->choices, .type = in->type};
    if (in->op == FIELD_SHAPE && !in->sdf) {
        out->code = &program->codes[in->choices];
        return true;
    }
    out->reach = in->op == FIELD_COMBINE ? in->sdf->reach : NULL;
    out->partial = in->op == FIELD_LOOP ? in->sdf->domain->partial : 0;
    if (first_kernel(in, &kernel)) {
        out->function = find(width, in, kernel);
        out->share = kernel == KERNEL_COMBINE ? find(width, in, KERNEL_SHARE)
                     : kernel == KERNEL_FIRST ? find(width, in, KERNEL_LAST)
                                              : NULL;
        out->cell = kernel == KERNEL_FIRST ? find(width, in, KERNEL_CELL) : NULL;
        return out->function != NULL;
    }
    return true;
}

/* Among those of the program; its `kind_count`: there is none. */
static size_t find_kind(const struct engine_program *program, const struct field_instruction *in)
{
    size_t i = 0;

    while (i < program->kind_count &&
           !(program->kinds[i].op == in->op && program->kinds[i].choices == in->choices &&
             program->kinds[i].type == in->type)) {
        i++;
    }
    return i;
}

static bool make(struct engine_program *program, struct operation *out,
                 const struct field_instruction *in)
{
    const size_t kind = find_kind(program, in);

    if (kind == program->kind_count) {
        if (kind == program->kind_room) {
            program->kind_room = 2 * kind + 16;
            program->kinds =
                memory_resize(program->kinds, program->kind_room, sizeof *program->kinds);
        }
        if (kind > UINT16_MAX || !make_kind(program, &program->kinds[kind], in)) {
            return false;
        }
        program->kind_count++;
    }
    *out = (struct operation){.op = (uint8_t)in->op,
                              .kind = (uint16_t)kind,
                              .a = in->a,
                              .b = in->b,
                              .point = in->point,
                              .out = in->out,
                              .params = in->params,
                              .seen = in->seen};
    out->unsteady = in->op == FIELD_SHAPE &&
                    (!in->sdf || in->choices == FIELD_POLYNOMIAL || in->choices == FIELD_PATCHES);
    return true;
}

/* What a slot holds at this place of the field, and which loops are open. */
struct reading {
    bool mixed[FIELD_SLOTS_MAX];
    /* A shape in it has no bound on its slope, and is in a space that is repeated, or longer than
     * ours: nobody follows where it is steady. */
    bool steep[FIELD_SLOTS_MAX];
    uint32_t loops[LIMIT_NODE_DEPTH];
    int depth, bent; /* open loops; open changes of space that lengthen */
};

static bool has_steps(const struct node_type *type)
{
    return type && (type->kind == KIND_EQUATION || type->kind == KIND_SURFACE);
}

static bool read_one(struct engine_program *program, struct reading *r,
                     const struct field_instruction *in)
{
    const uint32_t at = (uint32_t)program->count;
    struct operation *to = &program->operations[at];
    const bool bends = in->type && in->type->kind == KIND_DOMAIN && in->type->lipschitz == 0;

    if (in->op == FIELD_GUARD || in->op == FIELD_GUARD_END) {
        return true;
    }
    if (!make(program, to, in)) {
        return false;
    }
    program->count++;
    if (in->op == FIELD_SHAPE || in->op == FIELD_EMPTY) {
        r->mixed[in->a] = false;
        r->steep[in->a] = has_steps(in->type) && r->depth + r->bent > 0;
    } else if (in->op == FIELD_COMBINE) {
        to->mixes = in->sdf->soft || r->mixed[in->a] || r->mixed[in->b];
        r->mixed[in->a] = to->mixes;
        r->steep[in->a] = r->steep[in->a] || r->steep[in->b];
        to->prunes = in->sdf->reach && r->depth == 0 && r->bent == 0 && !r->steep[in->a];
        to->lesser = in->sdf->rule == SDF_ANY && in->sdf->reach && !in->sdf->soft;
        to->rule = (uint8_t)in->sdf->rule;
        to->kernel = (uint8_t)(in->choices & 0xff);
    } else if (in->op == FIELD_LOOP) {
        r->loops[r->depth++] = at;
    } else if (in->op == FIELD_LOOP_END) {
        to->length = at - r->loops[--r->depth];
        program->operations[at - to->length].length = to->length;
        program->operations[at - to->length].b = in->b;
        r->mixed[in->a] = r->mixed[in->b];
        r->steep[in->a] = r->steep[in->b];
    }
    r->bent += bends && in->op == FIELD_WARP;
    r->bent -= bends && in->op == FIELD_AFTER && r->bent > 0;
    return true;
}

/* --- users' code --- */

static const struct call_row *find_call(const struct engine_width *width, const struct step *s)
{
    for (size_t i = 0; i < width->call_count; i++) {
        const struct call_row *row = &width->calls[i];
        if (row->row == s->extra && row->base == s->base &&
            row->size == (s->kind == STEP_TOGETHER ? s->n : 1)) {
            return row;
        }
    }
    return NULL;
}

static enum engine_direct direct_of(const struct step *s)
{
    static const struct {
        const char *name;
        enum engine_direct direct;
    } rows[] = {{"min", CALL_MIN}, {"max", CALL_MAX}, {"abs", CALL_ABS}, {"clamp", CALL_CLAMP}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (s->base == BASE_FLOAT && strcmp(builtin_table[s->extra].name, rows[i].name) == 0) {
            return rows[i].direct;
        }
    }
    return CALL_FUNCTION;
}

/* `block`: components before the numbers that it declares. */
static bool make_code(const struct engine_width *width, struct engine_code *out,
                      const struct field_code *code, int block)
{
    const struct machine_code *machine = code_steps(code->code);
    int count = 0;

    out->machine = machine;
    out->whole = code_gives_surface(code->code);
    out->calls = memory_alloc(machine->step_count, sizeof *out->calls);
    for (size_t i = 0; i < machine->step_count; i++) {
        const struct step *s = &machine->steps[i];
        if (s->kind < STEP_ONE || s->kind > STEP_TOGETHER) {
            continue;
        }
        const struct call_row *row = find_call(width, s);
        if (!row) {
            return false;
        }
        out->calls[i] = (struct engine_call){row->function, row->gives_one, direct_of(s)};
    }
    for (int i = 0; i < code->place_count; i++) {
        const struct param_slot *place = &code->places[i];
        for (int k = 0; k < place->count; k++) {
            out->places[count++] = (uint16_t)(block + 4 * place->vec4 + place->component + k);
        }
    }
    return true;
}

static bool make_codes(struct engine_program *program)
{
    const struct field *field = program->field;
    bool ok = true;

    program->distances = field->code_count;
    program->code_count = field->code_count + field->shader_count;
    program->codes = memory_alloc(program->code_count, sizeof *program->codes);
    for (size_t i = 0; i < program->code_count; i++) {
        const bool shades = i >= program->distances;
        const struct field_code *code =
            shades ? &field->shaders[i - program->distances] : &field->codes[i];
        const int block =
            shades ? FIELD_MATERIAL_VEC4S : FIELD_MATRIX_VEC4S + FIELD_HEAD_VEC4S + FIELD_CUT_VEC4S;
        ok = ok && make_code(program->width, &program->codes[i], code, 4 * block);
    }
    return ok;
}

struct engine_program *engine_program_create(struct field *field, int lanes, int threads)
{
    struct engine_program *program = memory_alloc(1, sizeof *program);
    struct reading reading = {.depth = 0};
    bool ok = true;

    program->references = 1;
    program->field = field_ref(field);
    program->width = width_of(lanes);
    program->threads = threads;
    ok = program->width && make_codes(program);

    program->operations = memory_alloc(field->instruction_count, sizeof *program->operations);
    program->scene.material_base = (int)field->material_base;
    program->scene.material_stride = (int)field->material_stride;
    for (size_t i = 0; ok && i < field->instruction_count; i++) {
        ok = read_one(program, &reading, &field->instructions[i]);
    }
    if (!ok) {
        engine_program_destroy(program);
        return NULL;
    }
    changes_find_extents(program);
    return program;
}

uint64_t engine_distances(const struct engine_program *program, const float *params,
                          const float (*points)[3], size_t count, float half, float *out)
{
    return program->width->distances(program, params, points, count, half, out);
}

struct engine_program *engine_program_ref(struct engine_program *program)
{
    if (program) {
        program->references++;
    }
    return program;
}

void engine_program_destroy(struct engine_program *program)
{
    if (program && --program->references == 0) {
        for (size_t i = 0; i < program->code_count; i++) {
            free(program->codes[i].calls);
        }
        free(program->codes);
        free(program->operations);
        free(program->extents);
        free(program->kinds);
        field_unref(program->field);
        free(program);
    }
}
