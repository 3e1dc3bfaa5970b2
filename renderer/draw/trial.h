/* SPDX-License-Identifier: MIT */
/* Trial runs of users' code before it is drawn, in short slices, so that no other picture waits.
 * Snapshots of one program share a trial. Belongs to the drawing thread. */
#ifndef RENDERER_TRIAL_H
#define RENDERER_TRIAL_H

#include "renderer/field/field.h"

struct trial {
    int references;
    bool late; /* the code is drawn already, with other numbers: only warnings follow */
    struct field_trial *asks;
    int64_t us;         /* time used; begins at now_us: a new trial does not go first */
    struct trial *next; /* among those that are under way */
};
/* The trials under way. The one with the least time runs next, so that none waits for the end of
 * another. */
struct trials {
    struct trial *first;
    int64_t now_us; /* `us` of the trial that ran last */
};

/* Starts a trial of the field's code; NULL: it has none. */
struct trial *trial_begin(struct trials *trials, struct field *field);
/* The trial of a snapshot that takes over the program of an earlier one: a reference of the earlier
 * trial (`before`), or a new trial where numbers of the code have changed. NULL where `before` is
 * NULL. */
struct trial *trial_follow(struct trials *trials, struct trial *before, struct field *field);
struct trial *trial_ref(struct trial *trial);                 /* NULL: NULL */
void trial_unref(struct trials *trials, struct trial *trial); /* NULL: nothing */
bool trial_is_over(const struct trial *trial);                /* NULL: it is */
/* ERROR_NONE: no error is known yet. */
const struct error *trial_error(const struct trial *trial); /* NULL: ERROR_NONE */
const struct error *trial_warning(const struct trial *trial);
/* Runs trials for so many microseconds. True: one has ended. */
bool trials_go_on(struct trials *trials, int64_t us);

#endif
