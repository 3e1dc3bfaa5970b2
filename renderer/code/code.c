/* SPDX-License-Identifier: MIT */
/* The public face: compiled code, and running it. */
#include "code.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "code_internal.h"
#include "lower.h"
#include "parser.h"
#include "protocol/memory.h"
#include "writer.h"

static bool check_length_of(const char *text, struct error *err)
{
    const size_t length = strlen(text);

    return length <= LIMIT_CODE_BYTES ||
           error_set_at(err, ERROR_LIMIT, "", 1, 1,
                        "code of %zu bytes, above the maximum %d (code_bytes)", length,
                        LIMIT_CODE_BYTES);
}

struct code *code_compile(const struct code_source *source, struct error *err)
{
    if (!source->ours && !check_length_of(source->text, err)) {
        return NULL;
    }
    struct code *code = memory_alloc(1, sizeof *code);
    code->use = source->use;
    tree_init(&code->tree, err);
    code->tree.ours = source->ours;
    if (!parser_read(&code->tree, source->text) || !check_tree(&code->tree, source) ||
        !lower_tree(&code->tree, &code->machine)) {
        code_destroy(code);
        return NULL;
    }
    code->tree.err = NULL;
    return code;
}

void code_destroy(struct code *code)
{
    if (code) {
        tree_finish(&code->tree);
        machine_code_finish(&code->machine);
        free(code);
    }
}

void code_write(const struct code *code, const char *name, int source_number, FILE *out)
{
    writer_write(&code->tree, code->use, name, source_number, out);
}

const struct machine_code *code_steps(const struct code *code)
{
    return &code->machine;
}

int code_trips(const struct code *code)
{
    return (int)code->tree.entry->trips;
}

int code_size(const struct code *code)
{
    return (int)code->tree.entry->size;
}

int code_work(const struct code *code)
{
    return (int)code->tree.entry->work;
}

/* --- running --- */

/* What the document declares. */
static void set_numbers(const struct machine_code *code, const double *n, double *frame)
{
    double *to = frame + code->numbers, *data = frame + code->data;

    for (int i = 0; i < code->number_count; i++) {
        to[i] = code->number_bases[i] == BASE_INT    ? floor(n[i] + 0.5)
                : code->number_bases[i] == BASE_BOOL ? n[i] != 0
                                                     : n[i];
    }
    for (int i = 0; i < code->data_count; i++) {
        data[i] = i < code->number_count ? n[i] : 0;
    }
}

/* Frames are not cleared: whatever is read was written before. */
#if __has_attribute(uninitialized)
#define UNSET __attribute__((uninitialized))
#else
#define UNSET
#endif

/* What goes into the frame before a run, and what comes out. */
struct code_call {
    const double *p, *numbers;
    const struct code_shading *shading;
    struct code_fault *fault;
    double out[SURFACE_NUMBERS];
};

static void run(const struct code *code, struct code_call *call, double *frame)
{
    if (call->p) {
        memcpy(frame + code->machine.point, call->p, 3 * sizeof *call->p);
    }
    if (code->tree.shading_used) {
        memcpy(frame + code->machine.shading, call->shading, sizeof *call->shading);
    }
    machine_prepare(&code->machine, frame);
    set_numbers(&code->machine, call->numbers, frame);
    machine_run(&code->machine, code->machine.entry, frame, call->fault);
    memcpy(call->out, frame + code->machine.result,
           (size_t)code->machine.result_count * sizeof *call->out);
}

static __attribute__((noinline)) void run_small(const struct code *code, struct code_call *call)
{
    double frame[MACHINE_FRAME_SMALL] UNSET;
    run(code, call, frame);
}

static __attribute__((noinline)) void run_large(const struct code *code, struct code_call *call)
{
    double frame[MACHINE_FRAME] UNSET;
    run(code, call, frame);
}

static void run_any(const struct code *code, struct code_call *call)
{
    if (call->fault) {
        *call->fault = (struct code_fault){0};
    }
    if (machine_frame_size(&code->machine) <= MACHINE_FRAME_SMALL) {
        run_small(code, call);
    } else {
        run_large(code, call);
    }
}

double code_distance(const struct code *code, const double p[3], const double *n,
                     struct code_fault *fault)
{
    struct code_call call = {.p = p, .numbers = n, .fault = fault};

    run_any(code, &call);
    return fabs(call.out[0]) < CODE_FAR ? call.out[0] : CODE_FAR;
}

bool code_gives_surface(const struct code *code)
{
    return type_is_surface(code->tree.entry->result);
}

bool code_is_transmissive(const struct code *code)
{
    return code_gives_surface(code) && code->tree.transmissive;
}

/* Where something is no number: magenta, as colours are. */
void code_surface(const struct code *code, const struct code_shading *at, const double *n,
                  struct code_surface *out, struct code_fault *fault)
{
    struct code_call call = {.shading = at, .numbers = n, .fault = fault};
    bool is_number = true;

    run_any(code, &call);
    for (int i = 0; i < SURFACE_NUMBERS; i++) {
        is_number = is_number && fabs(call.out[i]) < CODE_FAR;
    }
    if (!is_number) {
        memcpy(call.out, surface_defaults, sizeof call.out);
        call.out[0] = call.out[2] = 1;
        call.out[1] = 0;
    }
    for (int i = 0; i < SURFACE_MEMBERS; i++) {
        const struct surface_member *member = &surface_members[i];
        for (double *x = call.out + member->at; x < call.out + member->at + member->rows; x++) {
            *x = fmin(fmax(*x, member->low), member->high);
        }
    }
    static_assert(sizeof *out == sizeof call.out, "members in their order");
    memcpy(out, call.out, sizeof *out);
}

void code_shade(const struct code *code, const struct code_shading *at, const double *n,
                double out_rgba[4], struct code_fault *fault)
{
    static const double magenta[4] = {1, 0, 1, 1};
    struct code_call call = {.shading = at, .numbers = n, .fault = fault, .out = {0, 0, 0, 1}};
    bool is_color = true;

    run_any(code, &call);
    for (int i = 0; i < 4; i++) {
        is_color = is_color && fabs(call.out[i]) < CODE_FAR;
    }
    for (int i = 0; i < 4; i++) {
        const double most = i < 3 ? CODE_BRIGHT : 1;
        out_rgba[i] = is_color ? fmin(fmax(call.out[i], 0), most) : magenta[i];
    }
}
