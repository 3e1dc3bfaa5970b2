/* SPDX-License-Identifier: MIT */
/* Steps of undo, for history.c. */
#ifndef PROTOCOL_HISTORY_INTERNAL_H
#define PROTOCOL_HISTORY_INTERNAL_H

#include "edit.h"

/* What undoes, or redoes, one or several edits. */
struct step {
    char *group, *label;
    cJSON *ops;
    size_t count;
    size_t bytes;  /* of the operations and values, about */
    bool values;   /* nothing but values are set: places may be joined */
    void *places;  /* search tree: the value that was set last at each place (struct place_value) */
    void *records; /* search tree of texts: the records that these places are in */
    struct step *next; /* of those that no stack holds any more */
};

/* `applied`: what the step takes back, in canonical form. Takes `inverse`. */
struct step *step_create(const char *group, const char *label, const cJSON *applied,
                         cJSON *inverse);
void step_destroy(struct step *step);
/* Puts `newer` in front of the step and frees it; false where they are too many together. */
bool step_join(struct step *step, struct step *newer);
/* Of a step of values: takes out the operations that would replace another value than the one that
 * the step's edits left there, and gives them as an array; NULL where there is none. The scene
 * stays as it is. */
cJSON *step_take_overwritten(struct step *step, struct scene *scene);
/* Puts them in again. Takes `taken`, which may be NULL. */
void step_give_back(struct step *step, cJSON *taken);

#endif
