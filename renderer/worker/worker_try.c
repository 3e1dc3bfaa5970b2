/* SPDX-License-Identifier: MIT */
/* Whether the driver goes on where it is confined, tried in a process that ends. */
#include <errno.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "worker.h"

struct outcome {
    struct confinement confined;
    struct error err;
    bool draws;
};

static void try_here(const struct worker_params *params, struct outcome *out)
{
    confine_privileges();
    if (params->confine != CONFINE_OFF) {
        confine_files(&out->confined, params->renderer.device.cache_dir);
    }
    struct renderer *renderer = renderer_create(&params->renderer, &out->err);
    if (params->confine != CONFINE_OFF) {
        confine_calls(&out->confined);
    }
    out->draws = renderer != NULL;
    renderer_destroy(renderer);
}

bool worker_try(const struct worker_params *params, struct confinement *out, struct error *err)
{
    struct outcome outcome = {0};
    int ends[2];
    pid_t child;

    if (pipe(ends) != 0 || (child = fork()) < 0) {
        return error_set(err, ERROR_INTERNAL, "", "no process: %s", strerror(errno));
    }
    if (child == 0) {
        try_here(params, &outcome);
        _exit(write(ends[1], &outcome, sizeof outcome) == sizeof outcome ? 0 : 1);
    }
    close(ends[1]);
    const bool told = read(ends[0], &outcome, sizeof outcome) == sizeof outcome;
    close(ends[0]);
    waitpid(child, NULL, 0);
    if (!told) {
        return error_set(err, ERROR_INTERNAL, "", "the driver ended the process");
    }
    *out = outcome.confined;
    *err = outcome.err;
    return outcome.draws;
}
