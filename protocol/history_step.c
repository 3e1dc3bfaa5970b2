/* SPDX-License-Identifier: MIT */
/* One step of undo: its operations, and the values that its edits left at their places. */
#include <search.h>
#include <stdlib.h>
#include <string.h>

#include "history_internal.h"
#include "limits.h"
#include "memory.h"

struct place_value {
    char *at;
    cJSON *value;
};

static void place_value_destroy(void *item)
{
    struct place_value *place = item;

    free(place->at);
    cJSON_Delete(place->value);
    free(place);
}

static int compare_places(const void *a, const void *b)
{
    const struct place_value *first = a, *second = b;

    return strcmp(first->at, second->at);
}

static const char *text_of(const cJSON *op, const char *name)
{
    return cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(op, name));
}

static bool is_set(const cJSON *op)
{
    const char *name = text_of(op, "op");

    return name && strcmp(name, "set") == 0 && text_of(op, "at");
}

static struct place_value *find_place(const struct step *step, const char *at)
{
    struct place_value wanted = {.at = (char *)at};
    void *found = at ? tfind(&wanted, &step->places, compare_places) : NULL;

    return found ? *(struct place_value **)found : NULL;
}

/* Of memory, about. */
static size_t bytes_of(const cJSON *value)
{
    size_t bytes = 0;

    for (; value; value = value->next) {
        bytes += sizeof *value + (value->string ? strlen(value->string) : 0) +
                 (value->valuestring ? strlen(value->valuestring) : 0) + bytes_of(value->child);
    }
    return bytes;
}

static int compare_texts(const void *a, const void *b)
{
    return strcmp(a, b);
}

/* "/nodes/body/transform" of "/nodes/body/transform/scale"; caller frees. */
static char *record_of(const char *at)
{
    return strndup(at, (size_t)(strrchr(at, '/') - at));
}

static void remember_record(struct step *step, const char *at)
{
    char *record = record_of(at);
    char **kept = tsearch(record, &step->records, compare_texts);

    if (*kept != record) {
        free(record);
    }
}

/* Takes `value`. */
static void remember_place(struct step *step, const char *at, cJSON *value)
{
    struct place_value *place = find_place(step, at);

    if (!place) {
        place = memory_alloc(1, sizeof *place);
        place->at = memory_text(at);
        tsearch(place, &step->places, compare_places);
        remember_record(step, at);
    }
    step->bytes += bytes_of(value);
    step->bytes -= bytes_of(place->value);
    cJSON_Delete(place->value);
    place->value = value;
}

/* Sets a value on which no other operation depends, as one may on a type, on what is declared, and
 * on which model a node names. */
static bool sets_value(const cJSON *op)
{
    static const char *const others[] = {"/type",  "/shader", "/primitive",
                                         "/model", "/params", "/properties"};

    if (!is_set(op)) {
        return false;
    }
    const char *last = strrchr(text_of(op, "at"), '/');
    for (size_t i = 0; last && i < sizeof others / sizeof others[0]; i++) {
        if (strcmp(last, others[i]) == 0) {
            return false;
        }
    }
    return last;
}

struct step *step_create(const char *group, const char *label, const cJSON *applied, cJSON *inverse)
{
    struct step *step = memory_alloc(1, sizeof *step);

    step->group = memory_text(group ? group : "");
    step->label = memory_text(label ? label : "");
    step->ops = inverse;
    step->bytes = bytes_of(inverse);
    step->values = true;
    for (const cJSON *op = inverse->child; op; op = op->next) {
        step->values = step->values && sets_value(op);
        step->count++;
    }
    for (const cJSON *op = applied->child; op; op = op->next) {
        if (is_set(op)) {
            const cJSON *value = cJSON_GetObjectItemCaseSensitive(op, "value");
            remember_place(step, text_of(op, "at"), cJSON_Duplicate(value, true));
        }
    }
    return step;
}

void step_destroy(struct step *step)
{
    tdestroy(step->places, place_value_destroy);
    tdestroy(step->records, free);
    cJSON_Delete(step->ops);
    free(step->group);
    free(step->label);
    free(step);
}

/* --- joining --- */

/* Drops what the step would set again later: only its older value counts. */
static void drop_places(struct step *newer, const struct step *step)
{
    for (cJSON *op = newer->ops->child, *next; op; op = next) {
        next = op->next;
        if (find_place(step, text_of(op, "at"))) {
            cJSON_Delete(cJSON_DetachItemViaPointer(newer->ops, op));
            newer->count--;
        }
    }
}

static void take_place(const void *node, VISIT visit, void *data)
{
    struct place_value *place = *(struct place_value *const *)node;

    if (visit == postorder || visit == leaf) {
        remember_place(data, place->at, place->value);
        place->value = NULL;
    }
}

bool step_join(struct step *step, struct step *newer)
{
    if (step->count + newer->count > LIMIT_OPERATIONS) {
        return false;
    }
    step->values = step->values && newer->values;
    if (step->values) {
        drop_places(newer, step);
    }
    step->count += newer->count;
    step->bytes += bytes_of(newer->ops->child);
    while (newer->ops->child) {
        cJSON *last = cJSON_DetachItemViaPointer(newer->ops, newer->ops->child->prev);
        cJSON_InsertItemInArray(step->ops, 0, last);
    }
    twalk_r(newer->places, take_place, step);
    if (*newer->label) {
        char *label = step->label;
        step->label = newer->label;
        newer->label = label;
    }
    step_destroy(newer);
    return true;
}

/* --- what others did meanwhile --- */

/* Whether the value at the operation's place is another one now. It is found by doing the operation
 * and taking it back. */
static bool is_overwritten(struct scene *scene, const cJSON *op, const struct place_value *left)
{
    cJSON *ops = cJSON_CreateArray(), *inverse = NULL;
    bool overwritten = false;

    cJSON_AddItemReferenceToArray(ops, (cJSON *)op);
    if (edit_apply(scene, ops, NULL, &inverse, NULL)) {
        for (const cJSON *back = inverse->child; back; back = back->next) {
            const cJSON *now = cJSON_GetObjectItemCaseSensitive(back, "value");
            overwritten = overwritten || (is_set(back) && !strcmp(text_of(back, "at"), left->at) &&
                                          !cJSON_Compare(now, left->value, true));
        }
        edit_apply(scene, inverse, NULL, NULL, NULL);
    }
    cJSON_Delete(inverse);
    cJSON_Delete(ops);
    return overwritten;
}

/* What the step's edits left at a place; NULL where that is not known: where a whole record was set
 * as well as one of its values. */
static const struct place_value *left_at(const struct step *step, const char *at)
{
    char *record = record_of(at);
    const bool both = find_place(step, record) || tfind(at, &step->records, compare_texts);

    free(record);
    return both ? NULL : find_place(step, at);
}

cJSON *step_take_overwritten(struct step *step, struct scene *scene)
{
    cJSON *taken = NULL;

    for (cJSON *op = step->values ? step->ops->child : NULL, *next; op; op = next) {
        const struct place_value *left = left_at(step, text_of(op, "at"));
        next = op->next;
        if (left && is_overwritten(scene, op, left)) {
            taken = taken ? taken : cJSON_CreateArray();
            cJSON_AddItemToArray(taken, cJSON_DetachItemViaPointer(step->ops, op));
            step->count--;
        }
    }
    return taken;
}

void step_give_back(struct step *step, cJSON *taken)
{
    while (taken && taken->child) {
        cJSON_AddItemToArray(step->ops, cJSON_DetachItemViaPointer(taken, taken->child));
        step->count++;
    }
    cJSON_Delete(taken);
}
