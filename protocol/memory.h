/* SPDX-License-Identifier: MIT */
/* Allocation that never fails, for cJSON too: without memory the program aborts and its supervisor
 * starts a new one. Everything given out here is freed with free(). */
#ifndef PROTOCOL_MEMORY_H
#define PROTOCOL_MEMORY_H

#include <stddef.h>

/* Zeroed; never NULL, even for nothing. */
void *memory_alloc(size_t count, size_t size);
void *memory_resize(void *block, size_t count, size_t size);
char *memory_text(const char *text);

/* A list that grows by itself: its room is the next power of two. Returns `items` with room for one
 * behind the `count` that there are. */
void *memory_one_more(void *items, size_t count, size_t size);

/* The same of pointers, with a free slot at `position`. */
void *memory_open_slot(void *items, size_t count, size_t position);
void memory_close_slot(void *items, size_t count, size_t position);

/* Call it when very many blocks were freed. glibc joins them at the next large allocation, which
 * then takes tens of milliseconds, and may be one under a lock. */
void memory_settle(void);

#endif
