/* SPDX-License-Identifier: MIT */
#include "patient.h"

#include <semaphore.h>
#include <stdatomic.h>
#include <stdint.h>
#include <sys/resource.h>
#include <time.h>

#include "slice.h"

enum { PATIENT_NICE = 5, NS = 1000000000, NS_OF_MS = 1000000 };

static struct {
    pthread_mutex_t lock;
    pthread_cond_t change;
    atomic_int what; /* enum patient_drawing */
} drawing = {.lock = PTHREAD_MUTEX_INITIALIZER, .change = PTHREAD_COND_INITIALIZER};

/* Until which time of its processor clock a thread works beside drawing, and beside what. */
static _Thread_local int64_t works_until_ns;
static _Thread_local int works_beside;

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
    slice_long();
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

/* --- giving way --- */

static struct timespec now_of(clockid_t clock)
{
    struct timespec now;

    clock_gettime(clock, &now);
    return now;
}

static int64_t worked_ns(void)
{
    const struct timespec now = now_of(CLOCK_THREAD_CPUTIME_ID);

    return (int64_t)now.tv_sec * NS + now.tv_nsec;
}

void patient_draws(enum patient_drawing what)
{
    if (atomic_load(&drawing.what) == (int)what) {
        return;
    }
    pthread_mutex_lock(&drawing.lock);
    atomic_store(&drawing.what, (int)what);
    if (what < PATIENT_SHARED) { /* nobody waits for urgent pictures alone to end */
        pthread_cond_broadcast(&drawing.change);
    }
    pthread_mutex_unlock(&drawing.lock);
}

/* False: the time is over first. */
static bool wait_for_less(enum patient_drawing least)
{
    struct timespec until = now_of(CLOCK_MONOTONIC);
    int result = 0;

    until.tv_nsec += PATIENT_WAIT_MS * NS_OF_MS;
    until.tv_sec += until.tv_nsec / NS;
    until.tv_nsec %= NS;
    pthread_mutex_lock(&drawing.lock);
    while (result == 0 && atomic_load(&drawing.what) >= (int)least) {
        result = pthread_cond_clockwait(&drawing.change, &drawing.lock, CLOCK_MONOTONIC, &until);
    }
    pthread_mutex_unlock(&drawing.lock);
    return result == 0;
}

void patient_give_way(enum patient_drawing least)
{
    const int what = atomic_load(&drawing.what);

    if (what < (int)least || (what <= works_beside && worked_ns() < works_until_ns)) {
        return;
    }
    const bool paused = wait_for_less(least) ||
                        (atomic_load(&drawing.what) == PATIENT_URGENT && wait_for_less(least));
    works_until_ns = paused ? 0 : worked_ns() + PATIENT_WORK_MS * NS_OF_MS;
    works_beside = atomic_load(&drawing.what);
}
