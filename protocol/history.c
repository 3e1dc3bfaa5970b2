/* SPDX-License-Identifier: MIT */
/* Undo and redo: for each author two stacks of steps (history_step.c). */
#include <stdlib.h>
#include <string.h>

#include "history_internal.h"
#include "limits.h"
#include "memory.h"

enum { FULL_AUTHORS = 4 }; /* have room in a scene with all that one may keep */

struct stack {
    struct step **items;
    size_t count;
};

struct author {
    char *name;
    struct stack undo, redo;
    size_t bytes;        /* of both */
    struct author *next; /* the one heard of before this one */
};

struct history {
    struct author *newest;
    struct step *dropped; /* in no stack any more */
};

/* --- stacks --- */

static void drop(struct history *history, struct step *step)
{
    step->next = history->dropped;
    history->dropped = step;
}

static void drop_oldest(struct history *history, struct stack *stack)
{
    drop(history, stack->items[0]);
    stack->count--;
    memmove(stack->items, stack->items + 1, stack->count * sizeof *stack->items);
}

static void drop_above(struct history *history, struct stack *stack, size_t left)
{
    while (stack->count > left) {
        drop(history, stack->items[--stack->count]);
    }
}

static void push(struct history *history, struct stack *stack, struct step *step)
{
    if (!stack->items) {
        stack->items = memory_alloc(LIMIT_UNDO_GROUPS, sizeof *stack->items);
    }
    if (stack->count == LIMIT_UNDO_GROUPS) {
        drop_oldest(history, stack);
    }
    stack->items[stack->count++] = step;
}

static size_t bytes_in(const struct stack *stack)
{
    size_t bytes = 0;

    for (size_t i = 0; i < stack->count; i++) {
        bytes += stack->items[i]->bytes;
    }
    return bytes;
}

static void clear(struct history *history, struct stack *stack)
{
    drop_above(history, stack, 0);
    free(stack->items);
    stack->items = NULL;
}

/* --- authors --- */

static void author_destroy(struct history *history, struct author *author)
{
    clear(history, &author->undo);
    clear(history, &author->redo);
    free(author->name);
    free(author);
}

static struct author *find_author(const struct history *history, const char *name)
{
    struct author *author = history->newest;

    while (author && strcmp(author->name, name) != 0) {
        author = author->next;
    }
    return author;
}

static struct stack *stack_of(struct author *author, bool redo)
{
    return redo ? &author->redo : &author->undo;
}

static struct author **link_of(struct history *history, const char *name)
{
    struct author **link = &history->newest;

    while (*link && strcmp((*link)->name, name) != 0) {
        link = &(*link)->next;
    }
    return link;
}

/* Forgets those who were not heard of for longest: beyond their number, and the memory of all. */
static void forget_oldest(struct history *history)
{
    struct author **link = &history->newest;
    size_t bytes = 0;

    for (int kept = 0; *link && kept < LIMIT_SESSIONS; kept++) {
        bytes += (*link)->bytes;
        if (kept > 0 && bytes > (size_t)FULL_AUTHORS * LIMIT_UNDO_BYTES) {
            break;
        }
        link = &(*link)->next;
    }
    while (*link) {
        struct author *oldest = *link;
        *link = oldest->next;
        author_destroy(history, oldest);
    }
}

/* Finds or makes the author and puts it in front. */
static struct author *hear_of(struct history *history, const char *name)
{
    struct author **link = link_of(history, name);
    struct author *author = *link;

    if (author) {
        *link = author->next;
    } else {
        author = memory_alloc(1, sizeof *author);
        author->name = memory_text(name);
    }
    author->next = history->newest;
    history->newest = author;
    forget_oldest(history);
    return author;
}

/* Of an author whose steps are others now: drops the oldest beyond the memory that they may have,
 * but not the newest, which is the last to redo or to undo. */
static void weigh(struct history *history, struct author *author, bool redo)
{
    const size_t undo_left = redo ? 0 : 1;

    for (;;) {
        author->bytes = bytes_in(&author->undo) + bytes_in(&author->redo);
        if (author->bytes <= LIMIT_UNDO_BYTES || author->undo.count + author->redo.count <= 1) {
            return;
        }
        drop_oldest(history, author->undo.count > undo_left ? &author->undo : &author->redo);
    }
}

/* --- public --- */

struct history *history_create(void)
{
    return memory_alloc(1, sizeof(struct history));
}

void history_clear(struct history *history)
{
    while (history->newest) {
        struct author *author = history->newest;
        history->newest = author->next;
        author_destroy(history, author);
    }
}

void history_destroy(struct history *history)
{
    if (history) {
        history_clear(history);
        history_discard(history->dropped);
    }
    free(history);
}

size_t history_bytes(const struct history *history)
{
    size_t bytes = 0;

    for (const struct author *author = history->newest; author; author = author->next) {
        bytes += author->bytes;
    }
    return bytes;
}

struct step *history_take_dropped(struct history *history, size_t *out_bytes)
{
    struct step *dropped = history->dropped;

    history->dropped = NULL;
    *out_bytes = 0;
    for (const struct step *step = dropped; step; step = step->next) {
        *out_bytes += step->bytes;
    }
    return dropped;
}

void history_forget(struct history *history, const char *author_name)
{
    struct author **link = link_of(history, author_name);
    struct author *author = *link;

    if (author) {
        *link = author->next;
        author_destroy(history, author);
    }
}

struct step *history_prepare(const struct history_entry *entry)
{
    return step_create(entry->group, entry->label, entry->applied, entry->inverse);
}

void history_discard(struct step *step)
{
    while (step) {
        struct step *next = step->next;

        step_destroy(step);
        step = next;
    }
}

static void record_edit(struct history *history, struct author *author,
                        const struct history_entry *entry)
{
    struct step *step = entry->step ? entry->step : history_prepare(entry);
    struct stack *undo = &author->undo;
    struct step *newest = undo->count > 0 ? undo->items[undo->count - 1] : NULL;

    clear(history, &author->redo);
    const bool joins = newest && *step->group && strcmp(step->group, newest->group) == 0;
    if (!joins || !step_join(newest, step)) {
        push(history, undo, step);
    }
}

static void record_move(struct history *history, struct stack *from, struct stack *to,
                        const struct history_entry *entry)
{
    push(history, to, step_create(NULL, entry->label, entry->applied, entry->inverse));
    drop_above(history, from, from->count > 0 ? from->count - 1 : 0);
}

void history_record(struct history *history, const struct history_entry *entry)
{
    struct author *author = hear_of(history, entry->author);

    drop_above(history, &author->undo, entry->undo); /* those above were found to be gone */
    drop_above(history, &author->redo, entry->redo);
    switch (entry->kind) {
    case HISTORY_EDIT:
        record_edit(history, author, entry);
        break;
    case HISTORY_UNDO:
        record_move(history, &author->undo, &author->redo, entry);
        break;
    case HISTORY_REDO:
        record_move(history, &author->redo, &author->undo, entry);
        break;
    }
    weigh(history, author, entry->kind == HISTORY_UNDO);
}

/* Tells of the first of the values that somebody else has set since. */
static bool fail_overwritten(const cJSON *skipped, struct error *err)
{
    const cJSON *at = cJSON_GetObjectItemCaseSensitive(skipped->child, "at");

    return error_set(err, ERROR_CONFLICT, cJSON_GetStringValue(at),
                     "somebody else has changed this since");
}

bool history_take(struct history *history, const char *author_name, bool redo,
                  struct history_move *out, struct error *err)
{
    struct author *author = find_author(history, author_name);
    struct stack *from = author ? stack_of(author, redo) : NULL;

    *out = (struct history_move){0};
    if (!from || from->count == 0) {
        return error_set(err, ERROR_NOT_FOUND, "", "there is nothing to %s",
                         redo ? "redo" : "undo");
    }
    out->undo = author->undo.count;
    out->redo = author->redo.count;
    out->step = from->items[--from->count];
    return true;
}

bool history_apply(struct history_move *move, struct scene *scene, struct error *err)
{
    struct step *step = move->step;
    cJSON *inverse = NULL;

    move->skipped = step_take_overwritten(step, scene);
    const bool ok = step->count > 0
                        ? edit_apply_some(scene, step->ops, &move->applied, &inverse, err)
                        : fail_overwritten(move->skipped, err);
    move->inverse = inverse;
    if (ok) {
        move->back = step_create(NULL, step->label, move->applied, inverse);
        move->label = move->back->label;
    } else {
        step_destroy(step);
        move->step = NULL;
    }
    return ok;
}

void history_put(struct history *history, const char *author_name, bool redo,
                 struct history_move *move)
{
    struct author *author = hear_of(history, author_name);

    push(history, stack_of(author, !redo), move->back);
    history_discard(move->step);
    move->step = move->back = NULL;
    weigh(history, author, !redo);
}

void history_return(struct history *history, const char *author_name, bool redo,
                    struct history_move *move)
{
    if (!move->step) {
        return;
    }
    step_give_back(move->step, move->skipped);
    push(history, stack_of(hear_of(history, author_name), redo), move->step);
    step_destroy(move->back);
    cJSON_Delete(move->applied);
    *move = (struct history_move){0};
}

void history_move_finish(struct history_move *move)
{
    cJSON_Delete(move->applied);
    cJSON_Delete(move->skipped);
    *move = (struct history_move){0};
}

static bool move_step(struct history *history, bool redo, struct scene *scene,
                      const char *author_name, struct history_move *out, struct error *err)
{
    struct history_move move;
    bool ok =
        history_take(history, author_name, redo, &move, err) && history_apply(&move, scene, err);

    if (ok) {
        history_put(history, author_name, redo, &move);
    }
    if (out) {
        *out = move;
    } else {
        history_move_finish(&move);
    }
    return ok;
}

bool history_undo(struct history *history, struct scene *scene, const char *author_name,
                  struct history_move *out, struct error *err)
{
    return move_step(history, false, scene, author_name, out, err);
}

bool history_redo(struct history *history, struct scene *scene, const char *author_name,
                  struct history_move *out, struct error *err)
{
    return move_step(history, true, scene, author_name, out, err);
}

void history_depth(const struct history *history, const char *author_name, size_t *out_undo,
                   size_t *out_redo)
{
    const struct author *author = find_author(history, author_name);

    *out_undo = author ? author->undo.count : 0;
    *out_redo = author ? author->redo.count : 0;
}

const cJSON *history_next(const struct history *history, const char *author_name, bool redo)
{
    const struct author *author = find_author(history, author_name);
    const struct stack *stack = !author ? NULL : redo ? &author->redo : &author->undo;

    return stack && stack->count > 0 ? stack->items[stack->count - 1]->ops : NULL;
}

const char *history_label(const struct history *history, const char *author_name, bool redo,
                          size_t index)
{
    const struct author *author = find_author(history, author_name);
    const struct stack *stack = !author ? NULL : redo ? &author->redo : &author->undo;

    return stack && index < stack->count ? stack->items[stack->count - 1 - index]->label : NULL;
}
