/* SPDX-License-Identifier: MIT */
/* Undo and redo: for each author two stacks of steps, each step the edit that undoes or redoes. */
#include <search.h>
#include <stdlib.h>
#include <string.h>

#include "edit.h"
#include "limits.h"
#include "memory.h"

struct step {
    char *group;
    cJSON *ops;
    size_t count;
    bool values;  /* nothing but values are set: places may be joined */
    void *places; /* search tree of the places set, while `values` */
};

struct stack {
    struct step **items;
    size_t count;
};

struct author {
    char *name;
    struct stack undo, redo;
    struct author *next; /* the one heard of before this one */
};

struct history {
    struct author *newest;
};

/* --- steps --- */

static void keep(void *item)
{
    (void)item;
}

static int compare_places(const void *a, const void *b)
{
    return strcmp(a, b);
}

static void step_destroy(struct step *step)
{
    tdestroy(step->places, keep);
    cJSON_Delete(step->ops);
    free(step->group);
    free(step);
}

static const char *place_of(const cJSON *op)
{
    return cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(op, "at"));
}

/* Sets a value on which no other operation depends, as one may on a type, on what is declared, and
 * on which model a node names. */
static bool sets_value(const cJSON *op)
{
    static const char *const others[] = {"/type",  "/shader", "/primitive",
                                         "/model", "/params", "/properties"};
    const char *name = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(op, "op"));
    if (!name || strcmp(name, "set") != 0 || !place_of(op)) {
        return false;
    }
    const char *last = strrchr(place_of(op), '/');
    for (size_t i = 0; last && i < sizeof others / sizeof others[0]; i++) {
        if (strcmp(last, others[i]) == 0) {
            return false;
        }
    }
    return last;
}

static struct step *step_create(const char *group, cJSON *ops)
{
    struct step *step = memory_alloc(1, sizeof *step);
    step->group = memory_text(group ? group : "");
    step->ops = ops;
    step->values = true;
    for (const cJSON *op = ops->child; op; op = op->next) {
        step->values = step->values && sets_value(op);
        step->count++;
    }
    for (const cJSON *op = step->values ? ops->child : NULL; op; op = op->next) {
        tsearch(place_of(op), &step->places, compare_places);
    }
    return step;
}

/* Drops what the step would set again later: only its older value counts. */
static void drop_places(struct step *newer, const struct step *step)
{
    for (cJSON *op = newer->ops->child, *next; op; op = next) {
        next = op->next;
        if (tfind(place_of(op), &step->places, compare_places)) {
            cJSON_Delete(cJSON_DetachItemViaPointer(newer->ops, op));
            newer->count--;
        }
    }
}

/* Puts `newer` in front of the step and frees it; false where they are too many together. */
static bool step_join(struct step *step, struct step *newer)
{
    if (step->count + newer->count > LIMIT_OPERATIONS) {
        return false;
    }
    if (step->values && newer->values) {
        drop_places(newer, step);
    } else {
        tdestroy(step->places, keep);
        step->places = NULL;
        step->values = false;
    }
    step->count += newer->count;
    while (newer->ops->child) {
        cJSON *last = cJSON_DetachItemViaPointer(newer->ops, newer->ops->child->prev);
        cJSON_InsertItemInArray(step->ops, 0, last);
        if (step->values) {
            tsearch(place_of(last), &step->places, compare_places);
        }
    }
    step_destroy(newer);
    return true;
}

/* --- stacks --- */

static void push(struct stack *stack, struct step *step)
{
    if (!stack->items) {
        stack->items = memory_alloc(LIMIT_UNDO_GROUPS, sizeof *stack->items);
    }
    if (stack->count == LIMIT_UNDO_GROUPS) {
        step_destroy(stack->items[0]);
        stack->count--;
        memmove(stack->items, stack->items + 1, stack->count * sizeof *stack->items);
    }
    stack->items[stack->count++] = step;
}

static void clear(struct stack *stack)
{
    while (stack->count > 0) {
        step_destroy(stack->items[--stack->count]);
    }
    free(stack->items);
    stack->items = NULL;
}

/* --- authors --- */

static void author_destroy(struct author *author)
{
    clear(&author->undo);
    clear(&author->redo);
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

/* Forgets those who were not heard of for longest. */
static void forget_oldest(struct history *history)
{
    struct author **link = &history->newest;
    for (int kept = 0; *link && kept < LIMIT_SESSIONS; kept++) {
        link = &(*link)->next;
    }
    while (*link) {
        struct author *oldest = *link;
        *link = oldest->next;
        author_destroy(oldest);
    }
}

/* Finds or makes the author and puts it in front. */
static struct author *hear_of(struct history *history, const char *name)
{
    struct author **link = &history->newest;
    while (*link && strcmp((*link)->name, name) != 0) {
        link = &(*link)->next;
    }
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

/* --- public --- */

struct history *history_create(void)
{
    return memory_alloc(1, sizeof(struct history));
}

void history_destroy(struct history *history)
{
    while (history && history->newest) {
        struct author *author = history->newest;
        history->newest = author->next;
        author_destroy(author);
    }
    free(history);
}

void history_record(struct history *history, const char *author_name, const char *group,
                    cJSON *inverse)
{
    struct author *author = hear_of(history, author_name);
    struct step *step = step_create(group, inverse);
    struct stack *undo = &author->undo;
    struct step *newest = undo->count > 0 ? undo->items[undo->count - 1] : NULL;
    clear(&author->redo);
    bool joins = newest && *step->group && strcmp(step->group, newest->group) == 0;
    if (!joins || !step_join(newest, step)) {
        push(undo, step);
    }
}

/* Applies the newest step of one stack and puts what takes it back on the other. A step of which
 * nothing applies any more is gone: the next call reaches the one below. */
static bool go(struct stack *from, struct stack *to, struct scene *scene, cJSON **out_applied,
               struct error *err)
{
    struct step *step = from->items[--from->count];
    cJSON *inverse;
    bool ok = edit_apply_some(scene, step->ops, out_applied, &inverse, err);
    if (ok) {
        push(to, step_create(NULL, inverse));
    }
    step_destroy(step);
    return ok;
}

bool history_undo(struct history *history, struct scene *scene, const char *author_name,
                  cJSON **out_applied, struct error *err)
{
    struct author *author = find_author(history, author_name);
    if (!author || author->undo.count == 0) {
        return error_set(err, ERROR_NOT_FOUND, "", "there is nothing to undo");
    }
    return go(&author->undo, &author->redo, scene, out_applied, err);
}

bool history_redo(struct history *history, struct scene *scene, const char *author_name,
                  cJSON **out_applied, struct error *err)
{
    struct author *author = find_author(history, author_name);
    if (!author || author->redo.count == 0) {
        return error_set(err, ERROR_NOT_FOUND, "", "there is nothing to redo");
    }
    return go(&author->redo, &author->undo, scene, out_applied, err);
}

void history_depth(const struct history *history, const char *author_name, size_t *out_undo,
                   size_t *out_redo)
{
    const struct author *author = find_author(history, author_name);
    *out_undo = author ? author->undo.count : 0;
    *out_redo = author ? author->redo.count : 0;
}
