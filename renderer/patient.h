/* SPDX-License-Identifier: MIT */
/* Threads whose work may wait for drawing. They take no lock for longer than some instructions. */
#ifndef RENDERER_PATIENT_H
#define RENDERER_PATIENT_H

#include <pthread.h>
#include <stdbool.h>

/* As pthread_create(). Where both want a processor, the thread gets a third of the time of one that
 * draws. Returns when it has that priority, which may not be changed later (confine.h). False:
 * there is no thread. */
bool patient_create(pthread_t *out, void *(*main)(void *), void *data);

#endif
