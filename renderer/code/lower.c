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
    uint16_t at = lower_alloc(lower, count);
    lower->locals = lower->top;
    return at;
}

/* What a variable holds that was given nothing. */
static void lower_nothing(struct lower *lower, const struct variable *variable)
{
    if (type_is_surface(variable->type)) {
        lower_move(lower, variable->at_frame,
                   lower_number(lower, surface_defaults, SURFACE_NUMBERS), SURFACE_NUMBERS);
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
    int count = type_components(variable->type);
    variable->at_frame = alloc_local(lower, count);
    if (stmt->expr) {
        lower_move(lower, variable->at_frame, lower_value(lower, stmt->expr), count);
    } else {
        lower_nothing(lower, variable);
    }
}

static void lower_if(struct lower *lower, const struct stmt *stmt)
{
    size_t no = lower_jump(lower, STEP_UNLESS, lower_value(lower, stmt->expr));
    lower_statement(lower, stmt->body);
    if (stmt->other) {
        size_t end = lower_jump(lower, STEP_JUMP, 0);
        lower_land(lower, no);
        lower_statement(lower, stmt->other);
        lower_land(lower, end);
    } else {
        lower_land(lower, no);
    }
}

static struct step join(enum step_kind kind, uint16_t out, uint16_t a, uint16_t b)
{
    return (struct step){.kind = (uint8_t)kind, .parts = 1, .n = 1, .out = out, .a = a, .b = b};
}

/* variable = start + counter * step */
static void lower_counter(struct lower *lower, const struct stmt *stmt, uint16_t counter)
{
    uint16_t at = stmt->variable->at_frame, from = counter;
    if (stmt->step != 1) {
        lower_step(lower, join(STEP_MULTIPLY, at, from, lower_number(lower, &stmt->step, 1)));
        from = at;
    }
    lower_step(lower, join(STEP_ADD, at, from, lower_number(lower, &stmt->start, 1)));
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
    uint16_t counter = alloc_local(lower, 1);
    stmt->variable->at_frame = alloc_local(lower, 1);
    lower_move(lower, counter, lower_number(lower, &zero, 1), 1);
    size_t top = lower->label = lower->code->step_count;
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
                                    .b = lower_number(lower, &trips, 1)});
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
    uint16_t by = (uint16_t)(MACHINE_VALUES - lower->peak);
    for (size_t i = 0; i < code->step_count; i++) {
        struct step *s = &code->steps[i];
        uint16_t *const places[] = {&s->a, &s->b, &s->c, &s->out};
        int count = s->kind >= STEP_JUMP ? 3 : 4; /* where they jump is no place */
        for (int k = 0; k < count; k++) {
            if (*places[k] >= MACHINE_VALUES && *places[k] != MACHINE_NOWHERE) {
                *places[k] = (uint16_t)(*places[k] - by);
            }
        }
    }
    code->value_count = lower->peak;
}

bool lower_tree(struct tree *tree, struct machine_code *out)
{
    enum { SHADING_NUMBERS = 13 };
    struct lower lower = {.code = out, .keep = true};
    int numbers = tree->number_count > tree->data_count ? tree->number_count : tree->data_count;
    out->numbers = alloc_local(&lower, numbers);
    out->shading = alloc_local(&lower, tree->shading_used ? SHADING_NUMBERS : 0);
    for (struct function *f = tree->called; f; f = f->next_called) {
        if (f->reachable) {
            lower_function(&lower, f);
        }
    }
    out->result = tree->entry->result_at;
    close_up(&lower);
    return !lower.full ||
           tree_fail_limit(tree, tree->entry->at, "values in use", MACHINE_VALUES, "code_size");
}

bool lower_constant(const struct expr *expr, struct machine_code *scratch, double *out)
{
    size_t bytes = (size_t)type_components(expr->type) * sizeof *out;
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
