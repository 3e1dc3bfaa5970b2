/* SPDX-License-Identifier: MIT */
/* Which snapshot of a scene a picture shows; scenes with nodes isolated. */
#include "renderer_internal.h"

#include <stdlib.h>
#include <string.h>

static char *make_key(const struct job_desc *desc)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    if (!out) {
        abort();
    }
    for (size_t i = 0; i < desc->isolated_count; i++) {
        fprintf(out, "%s\n", desc->isolated[i]);
    }
    if (fclose(out) != 0) {
        abort();
    }
    return text;
}

static void empty_view(struct renderer *renderer, struct isolated_view *view)
{
    snapshot_unref(renderer, view->newest);
    snapshot_unref(renderer, view->drawable);
    free(view->key);
    *view = (struct isolated_view){0};
}

/* The view with this key, or an empty one that takes it; else the least recently used gives way. */
static struct isolated_view *find_view(struct resident *resident, const struct job_desc *desc)
{
    struct isolated_view *oldest = resident->isolated;
    char *key = make_key(desc);

    for (int i = 0; i < ISOLATIONS_KEPT; i++) {
        struct isolated_view *view = &resident->isolated[i];

        if (view->key && strcmp(view->key, key) == 0) {
            free(key);
            return view;
        }
        if (view->last_use < oldest->last_use) {
            oldest = view;
        }
    }
    empty_view(resident->renderer, oldest);
    oldest->key = key;
    return oldest;
}

/* Of the program that the newest state of the scene has: what stands in there is kept. */
static struct snapshot *make_snapshot(struct resident *resident, const struct job_desc *desc,
                                      struct error *err)
{
    const struct field_options options = {
        .drawn = resident->newest->geometry.field,
        .isolated = desc->isolated,
        .isolated_count = desc->isolated_count,
    };
    uint64_t refused; /* the scene itself is of that structure, or not drawn for it */
    struct field *field = snapshot_field(resident->scene, &options, err);

    return field ? snapshot_create(resident->renderer, resident->scene, resident->revision, NULL,
                                   upload_create(field), &refused, err)
                 : NULL;
}

/* Takes over what has become drawable. */
static void advance(struct renderer *renderer, struct isolated_view *view)
{
    if (view->newest && view->newest != view->drawable &&
        snapshot_state(view->newest) == PROGRAM_READY) {
        snapshot_unref(renderer, view->drawable);
        view->drawable = snapshot_ref(view->newest);
    }
}

/* A state that is no field leaves what was drawn before it. */
static void renew(struct resident *resident, struct isolated_view *view,
                  const struct job_desc *desc, struct error *err)
{
    if (view->newest && view->renewals == resident->renewals) {
        return;
    }
    snapshot_unref(resident->renderer, view->newest);
    view->newest = resident->newest ? make_snapshot(resident, desc, err) : NULL;
    view->renewals = resident->renewals;
    if (!resident->newest && err) {
        *err = resident->error;
    }
}

struct snapshot *resident_snapshot(struct resident *resident, const struct job_desc *desc,
                                   struct error *err)
{
    struct snapshot *newest = resident->newest, *drawable = resident->drawable;

    if (desc->isolated_count > 0) {
        struct isolated_view *view = find_view(resident, desc);

        view->last_use = ++resident->uses;
        renew(resident, view, desc, err);
        advance(resident->renderer, view);
        newest = view->newest;
        drawable = view->drawable;
    } else if (!newest && err) {
        *err = resident->error;
    }
    return desc->exact || !drawable || (newest && snapshot_is_bridged(newest)) ? newest : drawable;
}

void resident_forget_views(struct resident *resident)
{
    for (int i = 0; i < ISOLATIONS_KEPT; i++) {
        empty_view(resident->renderer, &resident->isolated[i]);
    }
}
