/* SPDX-License-Identifier: MIT */
#include "patient.h"

#include <semaphore.h>
#include <sys/resource.h>

enum { PATIENT_NICE = 5 };

typedef void *thread_main(void *);

struct start {
    thread_main *main;
    void *data;
    sem_t ready;
};

/* Linux has a priority for each thread. */
static void *run(void *data)
{
    struct start *start = data;
    thread_main *const main = start->main;
    void *const own = start->data;

    setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + PATIENT_NICE);
    sem_post(&start->ready);
    return main(own);
}

bool patient_create(pthread_t *out, thread_main *main, void *data)
{
    struct start start = {.main = main, .data = data};

    sem_init(&start.ready, 0, 0);
    const bool there = pthread_create(out, NULL, run, &start) == 0;
    while (there && sem_wait(&start.ready) != 0) {
        /* A signal came. */
    }
    sem_destroy(&start.ready);
    return there;
}
