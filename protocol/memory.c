/* SPDX-License-Identifier: MIT */
/* Allocation that never fails. */
#include "memory.h"

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void *memory_alloc(size_t count, size_t size)
{
    void *block = calloc(count ? count : 1, size ? size : 1);

    if (!block) {
        abort();
    }
    return block;
}

void *memory_resize(void *block, size_t count, size_t size)
{
    if (size && count > SIZE_MAX / size) {
        abort();
    }
    const size_t bytes = count * size;
    void *resized = realloc(block, bytes > 0 ? bytes : 1);
    if (!resized) {
        abort();
    }
    return resized;
}

static void *alloc_for_json(size_t size)
{
    return memory_alloc(size, 1);
}

/* Without memory cJSON would leave out members, or take a good text for a bad one. */
__attribute__((constructor)) static void serve_json(void)
{
    cJSON_InitHooks(&(cJSON_Hooks){.malloc_fn = alloc_for_json, .free_fn = free});
}

char *memory_text(const char *text)
{
    const size_t bytes = strlen(text) + 1;

    return memcpy(memory_alloc(bytes, 1), text, bytes);
}

void *memory_one_more(void *items, size_t count, size_t size)
{
    const bool full = (count & (count - 1)) == 0;

    return full ? memory_resize(items, count ? 2 * count : 1, size) : items;
}

void *memory_open_slot(void *items, size_t count, size_t position)
{
    void **slots = memory_one_more(items, count, sizeof *slots);

    memmove(slots + position + 1, slots + position, (count - position) * sizeof *slots);
    return slots;
}

void memory_close_slot(void *items, size_t count, size_t position)
{
    void **slots = items;

    memmove(slots + position, slots + position + 1, (count - position - 1) * sizeof *slots);
}

void memory_settle(void)
{
    enum { LARGE = 1 << 16 }; /* for joining, and not for a mapping of its own */
    void *volatile block = malloc(LARGE);

    free(block);
}
