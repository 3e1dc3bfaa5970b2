/* SPDX-License-Identifier: MIT */
/* How long the calling thread may keep a processor that others want (sched_setattr(2),
 * `sched_runtime`; Linux 6.12). */
#ifndef RENDERER_SLICE_H
#define RENDERER_SLICE_H

enum { SLICE_SHORT_US = 1000, SLICE_DRAWING_US = 2500, SLICE_LONG_US = 20000 };

/* For a thread that is woken, works for a moment and waits again: with short slices Linux gives it
 * the processor of one that computes as soon as it is woken. Its share of the time stays the same.
 * Threads and processes that it creates from here on have them too. No effect on older kernels and
 * in a process that is confined (renderer/worker/confine.h). */
void slice_short(void);
/* For threads that draw, some of which live for one tile. Linux lets a new thread go before others
 * for half a slice, so those that are woken need slices of less than that. */
void slice_drawing(void);
/* For a thread that computes while nobody waits for it. Its share of the time stays the same, but a
 * thread with shorter slices that is woken meanwhile goes first. Without that it waits for the next
 * tick of the kernel, up to 4 ms. */
void slice_long(void);

#endif
