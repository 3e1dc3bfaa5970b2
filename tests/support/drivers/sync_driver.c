/* SPDX-License-Identifier: MIT */
/* A disk that makes its writer wait: loaded in front of libc (LD_PRELOAD). From the moment that the
 * file SYNC_FILE exists, the next fdatasync never ends if the file is empty; else it computes now
 * and then, as on a busy machine, for as many seconds as the file has bytes. */
#include <dlfcn.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { COMPUTES_MS = 10, PAUSE_US = 40000 };

static double seconds(clockid_t clock)
{
    struct timespec now;

    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void compute_now_and_then(double length)
{
    const double end = seconds(CLOCK_MONOTONIC) + length;

    while (seconds(CLOCK_MONOTONIC) < end) {
        const double pause = seconds(CLOCK_THREAD_CPUTIME_ID) + 1e-3 * COMPUTES_MS;

        while (seconds(CLOCK_THREAD_CPUTIME_ID) < pause) {
        }
        usleep(PAUSE_US);
    }
}

int fdatasync(int fd)
{
    static int (*real)(int);
    struct stat file;
    const char *path = getenv("SYNC_FILE");

    if (path && stat(path, &file) == 0) {
        unlink(path);
        if (file.st_size == 0) {
            for (;;) {
                pause();
            }
        }
        compute_now_and_then((double)file.st_size);
    }
    if (!real) {
        real = (int (*)(int))dlsym(RTLD_NEXT, "fdatasync");
    }
    return real(fd);
}
