/* SPDX-License-Identifier: MIT */
#include "vocabulary.h"

#include <stdlib.h>

#include "builder.h"
#include "protocol/memory.h"
#include "shader.h"

enum { ROOM_LEAST = 4 };

static bool has_function(enum field_op op)
{
    return op == FIELD_SHAPE || op == FIELD_COMBINE || op == FIELD_DISTANCE || op == FIELD_WARP ||
           op == FIELD_AFTER || op == FIELD_LOOP;
}

static int compare(const void *a, const void *b)
{
    const struct vocabulary_kind *x = a, *y = b;
    const int types = (x->type ? x->type->number : -1) - (y->type ? y->type->number : -1);

    return x->op != y->op             ? (x->op > y->op) - (x->op < y->op)
           : types != 0               ? types
           : x->choices != y->choices ? (x->choices > y->choices) - (x->choices < y->choices)
                                      : x->code - y->code;
}

static struct vocabulary_kind kind_of(const struct field_instruction *in)
{
    return (struct vocabulary_kind){in->op, in->type, in->choices,
                                    in->op == FIELD_SHAPE && !in->sdf};
}

static int rounded(int count)
{
    int room = ROOM_LEAST;

    while (room < count) {
        room *= 2;
    }
    return room;
}

/* Without those that are there already, as most are: a field has few kinds. */
static void add(struct vocabulary *v, size_t *room, const struct vocabulary_kind *kind)
{
    for (size_t i = v->count; i-- > 0;) {
        if (compare(&v->kinds[i], kind) == 0) {
            return;
        }
    }
    if (v->count == *room) {
        *room = 2 * *room + 16;
        v->kinds = memory_resize(v->kinds, *room, sizeof *v->kinds);
    }
    v->kinds[v->count++] = *kind;
}

struct vocabulary vocabulary_of(const struct field *field)
{
    struct vocabulary v = {.points = rounded(field->point_slots),
                           .distances = rounded(field->distance_slots)};
    size_t room = 0;
    int depth = 0, deepest = 0;

    for (size_t i = 0; i < field->instruction_count; i++) {
        const struct field_instruction *in = &field->instructions[i];
        depth += in->op == FIELD_LOOP ? 1 : in->op == FIELD_LOOP_END ? -1 : 0;
        deepest = depth > deepest ? depth : deepest;
        if (has_function(in->op)) {
            const struct vocabulary_kind kind = kind_of(in);
            add(&v, &room, &kind);
        }
    }
    v.loops = deepest > 0 ? rounded(deepest) : 0;
    qsort(v.kinds, v.count, sizeof *v.kinds, compare);
    return v;
}

void vocabulary_finish(struct vocabulary *vocabulary)
{
    free(vocabulary->kinds);
    *vocabulary = (struct vocabulary){0};
}

size_t vocabulary_find(const struct vocabulary *vocabulary, const struct vocabulary_kind *kind)
{
    for (size_t i = 0; i < vocabulary->count; i++) {
        if (compare(&vocabulary->kinds[i], kind) == 0) {
            return i;
        }
    }
    return 0;
}

static uint64_t hash_codes(uint64_t state, const struct field_code *codes, size_t count)
{
    state = builder_hash(state, (uint32_t)count);
    for (size_t i = 0; i < count; i++) {
        state = builder_hash(state, (uint32_t)codes[i].hash);
        state = builder_hash(state, (uint32_t)(codes[i].hash >> 32));
    }
    return state;
}

uint64_t vocabulary_hash(const struct vocabulary *vocabulary, const struct field *field)
{
    uint64_t state = BUILDER_HASH_START;

    for (size_t i = 0; i < vocabulary->count; i++) {
        const struct vocabulary_kind *kind = &vocabulary->kinds[i];
        state = builder_hash(state, (uint32_t)kind->op | (uint32_t)kind->code << 8);
        state = builder_hash(state, kind->type ? (uint32_t)kind->type->number : 0);
        state = builder_hash(state, kind->choices);
    }
    state = builder_hash(state, (uint32_t)vocabulary->points);
    state = builder_hash(state, (uint32_t)vocabulary->distances);
    state = builder_hash(state, (uint32_t)vocabulary->loops);
    state = hash_codes(state, field->codes, field->code_count);
    return hash_codes(state, field->shaders, field->shader_count);
}

/* --- texts --- */

/* What an operation asks of its kind: a function that calls those of all kinds. */
struct request {
    enum field_op op;
    enum shader_kernel kernel;
    const char *result, *name, *parameters, *arguments, *otherwise;
};

static const struct request map_requests[] = {
    {FIELD_SHAPE, KERNEL_SHAPE, "float", "shape_of", "vec3 p", "p", "FAR"},
    {FIELD_COMBINE, KERNEL_COMBINE, "float", "combine_of", "float a, float b", "a, b", "a"},
    {FIELD_DISTANCE, KERNEL_CHANGE, "float", "change_of", "float d", "d", "d"},
    {FIELD_WARP, KERNEL_MAP, "vec3", "warp_of", "vec3 p", "p", "p"},
    {FIELD_AFTER, KERNEL_AFTER, "float", "after_of", "float d, vec3 p", "d, p", "d"},
    {FIELD_LOOP, KERNEL_FIRST, "vec3", "first_of", "vec3 p", "p", "p"},
    {FIELD_LOOP, KERNEL_LAST, "vec3", "last_of", "vec3 p", "p", "p"},
    {FIELD_LOOP, KERNEL_CELL, "vec3", "cell_of", "vec3 p, vec3 cell", "p, cell", "p"},
};
static const struct request share_request = {FIELD_COMBINE,      KERNEL_SHARE, "float", "share_of",
                                             "float a, float b", "a, b",       "0.0"};

static void write_request(FILE *out, const struct vocabulary *v, const struct field *field,
                          const struct request *request)
{
    char name[32];

    for (size_t i = 0; i < v->count; i++) {
        const struct vocabulary_kind *kind = &v->kinds[i];
        snprintf(name, sizeof name, "%s_%zu", request->name, i);
        if (kind->op == request->op && kind->code) {
            shader_code_kernel(out, name, field, kind->choices);
        } else if (kind->op == request->op) {
            shader_kernel(out, name, kind->type, kind->choices, request->kernel);
        }
    }
    fprintf(out, "%s %s(int kind, %s)\n{\nswitch (kind) {\n", request->result, request->name,
            request->parameters);
    for (size_t i = 0; i < v->count; i++) {
        if (v->kinds[i].op == request->op) {
            fprintf(out, "case %zu:\nreturn %s_%zu(%s);\n", i, request->name, i,
                    request->arguments);
        }
    }
    fprintf(out, "default:\nreturn %s;\n}\n}\n", request->otherwise);
}

static void write_head(FILE *out, const struct vocabulary *v, const struct field *field)
{
    fprintf(out,
            "#define FIELD_TAPES\n#define TAPE_POINTS %d\n#define TAPE_DISTANCES %d\n"
            "#define TAPE_LOOPS %d\n#define TAPE_CELLS %d\n#include \"tapes.glsl\"\n",
            v->points, v->distances, v->loops, SDF_REPEAT_CELLS_MAX);
    shader_functions(out, field);
    fputs("#ifndef FIELD_KERNELS\n#define FIELD_KERNELS\n", out);
    for (size_t i = 0; i < sizeof map_requests / sizeof map_requests[0]; i++) {
        write_request(out, v, field, &map_requests[i]);
    }
    write_request(out, v, field, &share_request);
    fputs("#endif\n#include \"tapes_run.glsl\"\n", out);
}

static char *write_text(const struct vocabulary *v, const struct field *field, bool surface)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    if (!out) {
        abort();
    }
    write_head(out, v, field);
    if (surface) {
        shader_ask(out, field);
        fputs("#include \"tapes_surface.glsl\"\n", out);
    }
    if (fclose(out) != 0) {
        abort();
    }
    return text;
}

char *vocabulary_map(const struct vocabulary *vocabulary, const struct field *field)
{
    return write_text(vocabulary, field, false);
}

char *vocabulary_surface(const struct vocabulary *vocabulary, const struct field *field)
{
    return write_text(vocabulary, field, true);
}
