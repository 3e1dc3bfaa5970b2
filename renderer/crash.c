/* SPDX-License-Identifier: MIT */
#include "crash.h"

#include <signal.h>
#include <stddef.h>
#include <unistd.h>

static _Thread_local volatile sig_atomic_t thread_work;

/* Stays installed until a thread without work crashes: of two that crash at the same time, neither
 * may end the process by its signal while the other tells its work. */
static void on_crash(int number, siginfo_t *info, void *context)
{
    const int work = thread_work;

    (void)context;
    if (info->si_code > 0 && work != CRASH_ANYWHERE) {
        _exit(CRASH_STATUS + work);
    }
    signal(number, SIG_DFL);
    raise(number); /* delivered when this returns */
}

void crash_watch(void)
{
    static const int numbers[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE};
    const struct sigaction watch = {.sa_sigaction = on_crash, .sa_flags = SA_SIGINFO};

    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        struct sigaction old;

        if (sigaction(numbers[i], NULL, &old) == 0 && old.sa_handler == SIG_DFL) {
            sigaction(numbers[i], &watch, NULL);
        }
    }
}

void crash_thread(enum crash_work work)
{
    thread_work = work;
}

enum crash_work crash_thread_work(void)
{
    return (enum crash_work)thread_work;
}

enum crash_work crash_of(int exit_status)
{
    const int work = exit_status - CRASH_STATUS;

    return work > CRASH_ANYWHERE && work < CRASH_WORKS ? (enum crash_work)work : CRASH_ANYWHERE;
}
