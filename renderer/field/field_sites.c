/* SPDX-License-Identifier: MIT */
/* Where nodes stand in a program. */
#include "field_sites.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

struct field_sites *sites_create(void)
{
    return memory_alloc(1, sizeof(struct field_sites));
}

void sites_destroy(struct field_sites *sites)
{
    if (sites) {
        free(sites->at);
        free(sites->table);
        free(sites->material_shaders);
        free(sites->transmissive);
        free(sites->repaint);
        free(sites);
    }
}

/* --- places --- */

static struct site_place place_of(const struct builder *b)
{
    return (struct site_place){.instructions = (uint32_t)b->field->instruction_count,
                               .vec4s = (uint32_t)b->field->vec4_count,
                               .arguments = (uint32_t)b->argument_count,
                               .index = b->index,
                               .loops = (uint32_t)b->loops,
                               .trips = b->trips};
}

static void go_to(struct builder *b, const struct site_place *place)
{
    b->field->instruction_count = place->instructions;
    b->field->vec4_count = place->vec4s;
    b->argument_count = place->arguments;
    b->index = place->index;
    b->loops = place->loops;
    b->trips = place->trips;
}

static bool is_same_place(const struct site_place *a, const struct site_place *b)
{
    return a->instructions == b->instructions && a->vec4s == b->vec4s &&
           a->arguments == b->arguments && a->index == b->index;
}

static bool is_same_box(const struct bounds *a, const struct bounds *b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

static bool is_same_result(const struct result *a, const struct result *b)
{
    return a->hidden == b->hidden && a->apart == b->apart && a->solid == b->solid &&
           a->shown == b->shown && a->transmissive == b->transmissive &&
           is_same_box(&a->box, &b->box) && is_same_box(&a->transmissive_box, &b->transmissive_box);
}

/* --- nodes --- */

static struct site *add(struct builder *b, const struct node *node)
{
    struct field_sites *sites = b->sites;

    if (sites->count == sites->capacity) {
        sites->capacity = 2 * sites->capacity + 64;
        sites->at = memory_resize(sites->at, sites->capacity, sizeof *sites->at);
    }
    struct site *site = &sites->at[sites->count++];
    *site = (struct site){.node = node,
                          .parent = b->site,
                          .same = SITES_NONE,
                          .position = b->position,
                          .last = SITES_NONE,
                          .first_changed = SITES_NONE,
                          .last_changed = SITES_NONE};
    return site;
}

uint32_t sites_open(struct builder *b, const struct node *node)
{
    if (!b->sites) {
        return SITES_NONE;
    }
    const uint32_t index = b->next_site++;
    const struct site_place here = place_of(b);
    struct site *site = b->again ? &b->sites->at[index] : add(b, node);
    b->failed = b->failed || (b->again && !is_same_place(&here, &site->start));
    b->whole = b->whole || (b->again && site->change == SITE_ALL);
    site->start = here;
    if (b->before) {
        site->before = *b->before;
    }
    sites_leave_out(b);
    b->site = index;
    return index;
}

void sites_close(struct builder *b, uint32_t index, const struct result *result)
{
    if (!b->sites) {
        return;
    }
    struct site *site = &b->sites->at[index];
    site->stop = place_of(b);
    site->stop.loops -= site->start.loops;
    site->stop.trips -= site->start.trips;
    site->end = b->next_site;
    site->result = *result;
    site->change = SITE_SAME;
    site->first_changed = site->last_changed = SITES_NONE;
    b->site = site->parent;
    if (site->position != SITES_NONE && !b->again) {
        b->sites->at[site->parent].last = index;
    }
}

void sites_leave_out(struct builder *b)
{
    b->before = NULL;
    b->position = SITES_NONE;
}

/* NULL: no site follows in the one around. */
static struct site *next_site(const struct builder *b)
{
    struct site *site = b->next_site < b->sites->count ? &b->sites->at[b->next_site] : NULL;

    return site && site->parent == b->site ? site : NULL;
}

bool sites_has(const struct builder *b, const struct node *node)
{
    const struct site *site = next_site(b);

    return site && site->node == node;
}

bool sites_has_changed(const struct builder *b)
{
    return b->whole || b->sites->at[b->next_site].change != SITE_SAME;
}

bool sites_is_empty(const struct builder *b)
{
    return !b->sites->at[b->next_site].result.solid;
}

struct result sites_take(struct builder *b)
{
    struct site *site = &b->sites->at[b->next_site];
    const struct site_place here = place_of(b);
    struct site_place behind = site->stop;

    sites_leave_out(b);
    b->failed = b->failed || !is_same_place(&here, &site->start);
    behind.loops += here.loops;
    behind.trips += here.trips;
    site->start = here;
    site->change = SITE_SAME;
    go_to(b, &behind);
    b->next_site = site->end;
    return site->result;
}

/* Where all is as it was from this operand on: the next that has changed, or the last. */
static uint32_t next_changed(const struct builder *b, uint32_t index)
{
    const struct site *around = &b->sites->at[b->site];

    if (around->first_changed == SITES_NONE || index > around->last_changed) {
        return around->last;
    }
    return index < around->first_changed ? around->first_changed : index;
}

size_t sites_operand(struct builder *b, size_t index, struct result *own)
{
    if (!b->sites) {
        return index;
    }
    b->before = own;
    b->position = (uint32_t)index;
    if (!b->again) {
        return index;
    }
    const struct site_place here = place_of(b);
    struct site *site = next_site(b);
    if (!site || site->position != index) {
        return index; /* it has no part in the program */
    }
    const bool same = !b->whole && site->change == SITE_SAME &&
                      is_same_place(&here, &site->start) && here.loops == site->start.loops &&
                      here.trips == site->start.trips && is_same_result(own, &site->before);
    if (same) {
        b->next_site = next_changed(b, b->next_site);
        site = &b->sites->at[b->next_site];
        go_to(b, &site->start);
        *own = site->before;
    }
    site->before = *own;
    b->position = site->position;
    return site->position;
}

bool sites_set_scale(struct builder *b, double scale)
{
    if (!b->sites) {
        return true;
    }
    struct site *site = &b->sites->at[b->site];
    const bool other = site->scale != scale;
    site->scale = scale;
    return other;
}

bool sites_set_guarded(struct builder *b, bool guarded)
{
    if (b->sites) {
        struct site *site = &b->sites->at[b->site];
        b->failed = b->failed || (b->again && site->guarded != guarded);
        site->guarded = guarded;
    }
    return guarded && !b->failed;
}

void sites_pass_guard(struct builder *b)
{
    if (b->again) {
        b->field->instruction_count += b->sites->at[b->site].guarded;
    }
}

void sites_shift(struct builder *b)
{
    for (size_t i = b->site + 1; b->sites && i < b->sites->count; i++) {
        b->sites->at[i].start.instructions++;
        b->sites->at[i].stop.instructions++;
    }
}

/* --- again --- */

static bool is_same_instruction(const struct field_instruction *a,
                                const struct field_instruction *b)
{
    return a->op == b->op && a->type == b->type && a->sdf == b->sdf && a->a == b->a &&
           a->b == b->b && a->point == b->point && a->out == b->out && a->choices == b->choices &&
           a->params == b->params && a->arguments == b->arguments && a->seen == b->seen &&
           a->side == b->side;
}

void sites_compare(struct builder *b, size_t index, const struct field_instruction *instruction)
{
    const struct field *there = b->field->base;

    b->failed = b->failed || index >= there->instruction_count ||
                !is_same_instruction(&there->instructions[index], instruction);
}

size_t sites_touch(struct builder *b, enum sites_list list, size_t first, size_t count)
{
    const struct field *there = b->field->base;
    const size_t most = list == SITES_PARAMS ? there->vec4_count : there->argument_count;
    struct sites_patch *patch = &b->sites->patches[b->sites->version % SITES_PATCHES];
    struct sites_range *ranges = patch->ranges[list];
    const size_t used = patch->counts[list];

    if (first + count > most) {
        b->failed = true;
        return 0;
    }
    if (used > 0 && ranges[used - 1].end == first) {
        ranges[used - 1].end += count;
    } else if (used < SITES_RANGES_MAX) {
        ranges[patch->counts[list]++] = (struct sites_range){first, first + count};
    } else {
        patch->all = true;
    }
    return first;
}

/* --- sites of nodes --- */

static size_t slot_of(const struct field_sites *sites, const struct node *node)
{
    size_t slot = (size_t)((uintptr_t)node / 16 * UINT64_C(0x9e3779b97f4a7c15) >> 32);

    for (slot &= sites->table_size - 1; sites->table[slot] != SITES_NONE;
         slot = (slot + 1) & (sites->table_size - 1)) {
        if (sites->at[sites->table[slot]].node == node) {
            break;
        }
    }
    return slot;
}

static void make_table(struct field_sites *sites)
{
    sites->table_size = 64;
    while (sites->table_size < 2 * sites->count) {
        sites->table_size *= 2;
    }
    sites->table = memory_alloc(sites->table_size, sizeof *sites->table);
    memset(sites->table, 0xff, sites->table_size * sizeof *sites->table);
    for (size_t i = 0; i < sites->count; i++) {
        const size_t slot = slot_of(sites, sites->at[i].node);
        sites->at[i].same = sites->table[slot];
        sites->table[slot] = (uint32_t)i;
    }
}

/* What is around it has a change inside. */
static void mark_around(struct field_sites *sites, uint32_t index)
{
    for (uint32_t around; (around = sites->at[index].parent) != SITES_NONE; index = around) {
        struct site *site = &sites->at[around];
        site->change = site->change == SITE_ALL ? SITE_ALL : SITE_INSIDE;
        if (sites->at[index].position == SITES_NONE) {
            continue;
        }
        if (site->first_changed == SITES_NONE) {
            site->first_changed = site->last_changed = index;
        }
        site->first_changed = index < site->first_changed ? index : site->first_changed;
        site->last_changed = index > site->last_changed ? index : site->last_changed;
    }
}

static uint32_t first_site(struct field_sites *sites, const struct node *node)
{
    if (!sites->table) {
        make_table(sites);
    }
    return sites->table[slot_of(sites, node)];
}

static void mark_site(struct field_sites *sites, uint32_t index, enum site_change change)
{
    struct site *site = &sites->at[index];

    site->change = change > site->change ? change : site->change;
    mark_around(sites, index);
}

bool sites_mark(struct field_sites *sites, const struct node *node, enum site_change change)
{
    const uint32_t first = first_site(sites, node);

    for (uint32_t i = first; i != SITES_NONE; i = sites->at[i].same) {
        mark_site(sites, i, change);
    }
    return first != SITES_NONE;
}

static bool is_within(const struct field_sites *sites, uint32_t index, const struct node *around)
{
    while (index != SITES_NONE && sites->at[index].node != around) {
        index = sites->at[index].parent;
    }
    return index != SITES_NONE;
}

void sites_mark_within(struct field_sites *sites, const struct node *node,
                       const struct node *around, enum site_change change)
{
    for (uint32_t i = first_site(sites, node); i != SITES_NONE; i = sites->at[i].same) {
        if (is_within(sites, i, around)) {
            mark_site(sites, i, change);
        }
    }
}
