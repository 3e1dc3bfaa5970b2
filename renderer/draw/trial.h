/* SPDX-License-Identifier: MIT */
/* Trial runs of users' code before it is drawn, in short slices, so that no other picture waits.
 * Snapshots of one program share a trial. Belongs to the drawing thread. */
#ifndef RENDERER_TRIAL_H
#define RENDERER_TRIAL_H

#include "renderer/field/field.h"

struct trial {
    int references;
    bool late; /* the code is drawn already, with other numbers: this one only warns */
    struct field_trial *asks;
    int64_t us;         /* that it took, as if it had had its part of the time before it came */
    struct trial *next; /* among those that are under way */
};
/* Those under way, in order. The one that took the least goes on, so that none waits for the end of
 * another. */
struct trials {
    struct trial *first;
    int64_t now_us; /* of the one that went on last */
};

/* Under way; NULL: the field has no code. */
struct trial *trial_begin(struct trials *trials, struct field *field);
/* Of the field of a snapshot that takes the program of another one over, with that one's trial: the
 * same, unless numbers of the code are others. `before` NULL: NULL. */
struct trial *trial_follow(struct trials *trials, struct trial *before, struct field *field);
struct trial *trial_ref(struct trial *trial);                 /* NULL: NULL */
void trial_unref(struct trials *trials, struct trial *trial); /* NULL: nothing */
bool trial_is_over(const struct trial *trial);                /* NULL: it is */
/* ERROR_NONE: it can be drawn, as far as is known. */
const struct error *trial_error(const struct trial *trial); /* NULL: ERROR_NONE */
const struct error *trial_warning(const struct trial *trial);
/* For so many microseconds; true: one is over. */
bool trials_go_on(struct trials *trials, int64_t us);

#endif
