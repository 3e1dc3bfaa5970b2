/* SPDX-License-Identifier: MIT */
/* Statements and functions as steps. */
#include "lower.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

static void lower_statement(struct lower *lower, const struct stmt *stmt);

static void add_jump(struct jumps *jumps, size_t step)
{
    if (jumps->count == jumps->capacity) {
        jumps->capacity = jumps->capacity > 0 ? 2 * jumps->capacity : 8;
        jumps->steps = memory_resize(jumps->steps, jumps->capacity, sizeof *jumps->steps);
    }
    jumps->steps[jumps->count++] = step;
}

static void land_all(struct lower *lower, struct jumps *jumps)
{
    for (size_t i = 0; i < jumps->count; i++) {
        lower_land(lower, jumps->steps[i]);
    }
    free(jumps->steps);
}

static void lower_statements(struct lower *lower, const struct stmt *list)
{
    for (; list; list = list->next) {
        lower_statement(lower, list);
    }
}

/* A place that lasts until the block ends. */
static uint16_t alloc_local(struct lower *lower, int count)
{
    const uint16_t at = lower_alloc(lower, count);

    lower->locals = lower->top;
    return at;
}

/* What a variable holds that was given nothing. */
static void lower_nothing(struct lower *lower, const struct variable *variable)
{
    if (type_is_surface(variable->type)) {
        lower_move(lower, variable->at_frame,
                   lower_number(lower, BASE_FLOAT, surface_defaults, SURFACE_NUMBERS),
                   SURFACE_NUMBERS);
        return;
    }
    lower_step(lower, (struct step){.kind = STEP_ZERO,
                                    .n = (uint16_t)type_components(variable->type),
                                    .out = variable->at_frame});
}

static void lower_declaration(struct lower *lower, const struct stmt *stmt)
{
    struct variable *variable = stmt->variable;

    if (variable->value) {
        return; /* wherever it is used, its value is */
    }
    const int count = type_components(variable->type);
    variable->at_frame = alloc_local(lower, count);
    if (stmt->expr && lower_has_parts(stmt->expr)) {
        lower_parts(lower, stmt->expr, variable->at_frame);
    } else if (stmt->expr) {
        lower_move(lower, variable->at_frame, lower_value(lower, stmt->expr), count);
    } else {
        lower_nothing(lower, variable);
    }
}

static void lower_if(struct lower *lower, const struct stmt *stmt)
{
    const size_t no = lower_jump(lower, STEP_UNLESS, lower_value(lower, stmt->expr));

    lower_statement(lower, stmt->body);
    if (stmt->other) {
        const size_t end = lower_jump(lower, STEP_JUMP, 0);
        lower_land(lower, no);
        lower_statement(lower, stmt->other);
        lower_land(lower, end);
    } else {
        lower_land(lower, no);
    }
}

/* variable = start + counter * step */
static void lower_counter(struct lower *lower, const struct stmt *stmt, uint16_t counter)
{
    const struct type type = stmt->variable->type;
    const enum base base = (enum base)type.base;
    struct operand at = {counter, false};

    if (base != BASE_FLOAT) {
        at.at = lower_join(lower, STEP_CONVERT, 1, at, (struct operand){MACHINE_NOWHERE, false},
                           (struct step){.extra = type.base, .base = BASE_FLOAT});
    }
    if (stmt->step != 1) {
        const struct operand step = {lower_number(lower, base, &stmt->step, 1), false};
        at.at = lower_arithmetic(lower, OP_MULTIPLY, type, at, step);
    }
    if (stmt->start != 0) {
        const struct operand start = {lower_number(lower, base, &stmt->start, 1), false};
        at.at = lower_arithmetic(lower, OP_ADD, type, at, start);
    }
    lower_move(lower, stmt->variable->at_frame, at.at, 1);
}

static void lower_for(struct lower *lower, const struct stmt *stmt)
{
    static const double zero = 0;
    struct jumps breaks = {0}, continues = {0};
    struct jumps *outer_breaks = lower->breaks, *outer_continues = lower->continues;
    double trips = stmt->trips;

    if (stmt->trips == 0) {
        return;
    }
    const uint16_t counter = alloc_local(lower, 1);
    stmt->variable->at_frame = alloc_local(lower, 1);
    lower_move(lower, counter, lower_number(lower, BASE_FLOAT, &zero, 1), 1);
    const size_t top = lower->label = lower->code->step_count;
    lower_counter(lower, stmt, counter);
    lower->breaks = &breaks;
    lower->continues = &continues;
    lower_statement(lower, stmt->body);
    lower->breaks = outer_breaks;
    lower->continues = outer_continues;
    land_all(lower, &continues);
    lower_step(lower, (struct step){.kind = STEP_LOOP,
                                    .out = (uint16_t)top,
                                    .a = counter,
                                    .b = lower_number(lower, BASE_FLOAT, &trips, 1)});
    land_all(lower, &breaks);
}

static void lower_return(struct lower *lower, const struct stmt *stmt)
{
    if (stmt->expr) {
        lower_move(lower, lower->function->result_at, lower_value(lower, stmt->expr),
                   type_components(stmt->expr->type));
    }
    lower_step(lower, (struct step){.kind = STEP_RETURN});
}

static void lower_block(struct lower *lower, const struct stmt *stmt)
{
    uint16_t locals = lower->locals;

    if (stmt->kind == STMT_FOR) {
        lower_for(lower, stmt);
    } else if (stmt->kind == STMT_IF) {
        lower_if(lower, stmt);
    } else {
        lower_statements(lower, stmt->body);
    }
    lower->locals = locals;
}

static void lower_statement(struct lower *lower, const struct stmt *stmt)
{
    switch (stmt->kind) {
    case STMT_BLOCK:
    case STMT_IF:
    case STMT_FOR:
        lower_block(lower, stmt);
        break;
    case STMT_DECLARE:
        lower_statements(lower, stmt->body);
        if (stmt->variable) {
            lower_declaration(lower, stmt);
        }
        break;
    case STMT_EXPR:
        lower_effect(lower, stmt->expr);
        break;
    case STMT_RETURN:
        lower_return(lower, stmt);
        break;
    case STMT_BREAK:
        add_jump(lower->breaks, lower_jump(lower, STEP_JUMP, 0));
        break;
    case STMT_CONTINUE:
        add_jump(lower->continues, lower_jump(lower, STEP_JUMP, 0));
        break;
    case STMT_EMPTY:
    case STMT_FUNCTION:
        break;
    }
    lower->top = lower->locals;
}

static void lower_function(struct lower *lower, struct function *function)
{
    lower->function = function;
    lower->top = lower->peak;
    function->result_at = alloc_local(lower, type_components(function->result));
    for (struct variable *v = function->parameters; v; v = v->next) {
        v->at_frame = alloc_local(lower, type_components(v->type));
    }
    function->entry = (uint16_t)(lower->label = lower->code->step_count);
    for (struct variable *v = function->parameters; v; v = v->next) {
        if (v->direction == DIRECTION_OUT) {
            lower_nothing(lower, v);
        }
    }
    lower_statement(lower, function->body);
    lower_step(lower, (struct step){.kind = STEP_RETURN});
}

/* Constants move down to where the values end. */
static void close_up(const struct lower *lower)
{
    struct machine_code *code = lower->code;
    const uint16_t by = (uint16_t)(MACHINE_VALUES - lower->peak);

    for (size_t i = 0; i < code->step_count; i++) {
        struct step *s = &code->steps[i];
        uint16_t *const places[] = {&s->a, &s->b, &s->c, &s->out};
        const int count = s->kind >= STEP_JUMP ? 3 : 4; /* where they jump is no place */
        for (int k = 0; k < count; k++) {
            if (*places[k] >= MACHINE_VALUES && *places[k] != MACHINE_NOWHERE) {
                *places[k] = (uint16_t)(*places[k] - by);
            }
        }
    }
    code->value_count = lower->peak;
}

/* Places for what the code is given. */
static void lower_inputs(struct lower *lower, const struct tree *tree)
{
    enum { SHADING_NUMBERS = 13 };
    struct machine_code *out = lower->code;
    out->number_count = tree->number_count;
    out->data_count = tree->data_used ? tree->data_count : 0;
    for (const struct variable *v = tree->declared; v; v = v->next) {
        memset(out->number_bases + v->first, v->type.base, (size_t)type_components(v->type));
    }
    out->numbers = alloc_local(lower, out->number_count);
    out->data = alloc_local(lower, out->data_count);
    out->shading = tree->shading_used ? alloc_local(lower, SHADING_NUMBERS) : MACHINE_NOWHERE;
}

bool lower_tree(struct tree *tree, struct machine_code *out)
{
    struct lower lower = {.code = out, .keep = true};

    lower_inputs(&lower, tree);
    for (struct function *f = tree->called; f; f = f->next_called) {
        if (f->reachable) {
            lower_function(&lower, f);
        }
    }
    out->entry = tree->entry->entry;
    out->point = tree->entry->parameters ? tree->entry->parameters->at_frame : MACHINE_NOWHERE;
    out->result = tree->entry->result_at;
    out->result_count = type_components(tree->entry->result);
    close_up(&lower);
    return !lower.full ||
           tree_fail_limit(tree, tree->entry->at, "values in use", MACHINE_VALUES, "code_size");
}

bool lower_constant(const struct expr *expr, struct machine_code *scratch, double *out)
{
    const size_t bytes = (size_t)type_components(expr->type) * sizeof *out;
    struct lower lower = {.code = scratch};

    scratch->step_count = scratch->constant_count = 0;
    uint16_t at = lower_value(&lower, expr);
    lower_step(&lower, (struct step){.kind = STEP_RETURN});
    if (lower.full) {
        return false;
    }
    close_up(&lower);
    at = (uint16_t)(at >= MACHINE_VALUES ? at - MACHINE_VALUES + lower.peak : at);
    double *frame = memory_alloc(machine_frame_size(scratch), sizeof *frame);
    machine_prepare(scratch, frame);
    machine_run(scratch, 0, frame, NULL);
    memcpy(out, frame + at, bytes);
    free(frame);
    return true;
}
