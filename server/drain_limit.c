/* SPDX-License-Identifier: MIT */
#include "drain_limit.h"

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include "clock.h"
#include "renderer/vigil.h"

static void end_at_once(int signal)
{
    (void)signal;
    _exit(1);
}

static void *watch(void *unused)
{
    struct vigil vigil = {0};
    struct vigil_use use;

    while (vigil.still_ms <= DRAIN_STILL_MS && vigil.spent_ms <= DRAIN_BUSY_MS) {
        usleep(1000 * VIGIL_LOOK_MS);
        if (vigil_use_of(getpid(), gettid(), &use)) {
            vigil_look(&vigil, clock_ms(), &use);
        }
    }
    fprintf(stderr, "fieldcast: the drain %s, ending now\n",
            vigil.still_ms > DRAIN_STILL_MS ? "hangs" : "took too long");
    _exit(1);
    return unused;
}

void drain_limit(void)
{
    const struct sigaction action = {.sa_handler = end_at_once};
    pthread_t thread;
    sigset_t set;

    if (pthread_create(&thread, NULL, watch, NULL) == 0) {
        pthread_detach(thread);
    }
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGINT, &action, NULL);
    sigemptyset(&set);
    sigaddset(&set, SIGTERM);
    sigaddset(&set, SIGINT);
    pthread_sigmask(SIG_UNBLOCK, &set, NULL);
}
