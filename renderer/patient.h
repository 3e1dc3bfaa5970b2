/* SPDX-License-Identifier: MIT */
/* Threads whose work may wait for drawing. They take no lock for longer than some instructions. */
#ifndef RENDERER_PATIENT_H
#define RENDERER_PATIENT_H

#include <pthread.h>
#include <stdbool.h>

/* As pthread_create(). Where both want a processor, the thread gets a third of the time of one that
 * draws. Returns when it has that priority, which may not be changed later (worker/confine.h).
 * False: there is no thread. */
bool patient_create(pthread_t *out, void *(*main)(void *), void *data);

enum {
    PATIENT_WAIT_MS = 10, /* that a thread waits for drawing to pause, at most; twice for urgent */
    PATIENT_WORK_MS = 2,  /* after that it works so long beside drawing */
};

/* What is drawn. */
enum patient_drawing {
    PATIENT_FREE,   /* nothing */
    PATIENT_ALONE,  /* the pictures of one client */
    PATIENT_SHARED, /* those of several */
    PATIENT_URGENT, /* an urgent one of several */
};

/* Called by the drawing thread: what it draws from now on. */
void patient_draws(enum patient_drawing what);
/* Called between two pieces of work of a patient thread: waits while `least` or more is drawn, so
 * that pictures find the processors and their caches free, but goes on at times in any case. */
void patient_give_way(enum patient_drawing least);

#endif
