/* SPDX-License-Identifier: MIT */
#include "trial.h"

#include <stdlib.h>

#include "protocol/memory.h"

static const struct error none;

static struct trial *queue(struct trials *trials, struct field_trial *asks, bool late)
{
    struct trial **last = &trials->first;
    struct trial *trial = memory_alloc(1, sizeof *trial);

    trial->references = 1;
    trial->late = late;
    trial->asks = asks;
    trial->us = trials->now_us;
    while (*last) {
        last = &(*last)->next;
    }
    *last = trial;
    return trial;
}

struct trial *trial_begin(struct trials *trials, struct field *field)
{
    return field->code_count + field->shader_count > 0
               ? queue(trials, field_trial_create(field), false)
               : NULL;
}

struct trial *trial_follow(struct trials *trials, struct trial *before, struct field *field)
{
    if (!before) {
        return NULL;
    }
    struct field_trial *asks = field_trial_create(field);
    if (trial_is_over(before) && !field_trial_is_same(before->asks, asks)) {
        return queue(trials, asks, true);
    }
    field_trial_destroy(asks);
    return trial_ref(before);
}

struct trial *trial_ref(struct trial *trial)
{
    if (trial) {
        trial->references++;
    }
    return trial;
}

static void leave(struct trials *trials, const struct trial *trial)
{
    struct trial **at = &trials->first;

    while (*at && *at != trial) {
        at = &(*at)->next;
    }
    if (*at) {
        *at = trial->next;
    }
}

void trial_unref(struct trials *trials, struct trial *trial)
{
    if (!trial || --trial->references > 0) {
        return;
    }
    leave(trials, trial);
    field_trial_destroy(trial->asks);
    free(trial);
}

bool trial_is_over(const struct trial *trial)
{
    return !trial || trial->late || field_trial_is_over(trial->asks);
}

const struct error *trial_error(const struct trial *trial)
{
    return trial && !trial->late ? field_trial_error(trial->asks) : &none;
}

const struct error *trial_warning(const struct trial *trial)
{
    return trial ? field_trial_warning(trial->asks) : &none;
}

static struct trial *find_least(const struct trials *trials)
{
    struct trial *least = trials->first;

    for (struct trial *trial = least; trial; trial = trial->next) {
        least = trial->us < least->us ? trial : least;
    }
    return least;
}

bool trials_go_on(struct trials *trials, int64_t us)
{
    struct trial *trial = find_least(trials);

    if (!trial) {
        return false;
    }
    trials->now_us = trial->us;
    trial->us += us;
    field_trial_go_on(trial->asks, us);
    if (!field_trial_is_over(trial->asks)) {
        return false;
    }
    leave(trials, trial);
    trial->next = NULL;
    return true;
}
