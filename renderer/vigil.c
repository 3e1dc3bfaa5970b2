/* SPDX-License-Identifier: MIT */
#include "vigil.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* The letter after the name, which may hold any character: proc(5). */
static char state_of(pid_t process, const char *thread)
{
    char path[64], text[512];
    FILE *file;
    const char *end = NULL;

    snprintf(path, sizeof path, "/proc/%d/task/%.20s/stat", (int)process, thread);
    file = fopen(path, "r");
    if (file) {
        end = fgets(text, sizeof text, file) ? strrchr(text, ')') : NULL;
        fclose(file);
    }
    return end && end[1] == ' ' ? end[2] : '?';
}

static bool is_runnable(pid_t process, pid_t except)
{
    char path[64];
    DIR *threads;
    bool runnable = false;

    snprintf(path, sizeof path, "/proc/%d/task", (int)process);
    threads = opendir(path);
    for (const struct dirent *entry; threads && !runnable && (entry = readdir(threads));) {
        runnable = *entry->d_name != '.' && strtol(entry->d_name, NULL, 10) != except &&
                   state_of(process, entry->d_name) == 'R';
    }
    if (threads) {
        closedir(threads);
    }
    return runnable;
}

bool vigil_use_of(pid_t process, pid_t except, struct vigil_use *out)
{
    struct timespec cpu;
    clockid_t clock;

    if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &cpu) != 0) {
        return false;
    }
    out->cpu_ms = (int64_t)cpu.tv_sec * 1000 + cpu.tv_nsec / 1000000;
    out->runnable = is_runnable(process, except);
    return true;
}

void vigil_restart(struct vigil *vigil)
{
    *vigil = (struct vigil){0};
}

void vigil_look(struct vigil *vigil, int64_t now_ms, const struct vigil_use *use)
{
    const int64_t passed = now_ms - vigil->at_ms;
    const int64_t used = use->cpu_ms - vigil->last.cpu_ms;

    if (vigil->begun && passed < VIGIL_LOOK_MS) {
        return;
    }
    if (vigil->begun) {
        const bool still = !use->runnable && used * 100 < passed * VIGIL_STILL_PERCENT;

        /* Who watches may have been kept from it for as long. */
        vigil->still_ms =
            still ? vigil->still_ms + (passed < VIGIL_GAP_MS ? passed : VIGIL_GAP_MS) : 0;
        vigil->spent_ms += used;
    }
    vigil->begun = true;
    vigil->last = *use;
    vigil->at_ms = now_ms;
}
