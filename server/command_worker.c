/* SPDX-License-Identifier: MIT */
/* fieldcast worker: the render process, started by `serve` with its socket at WORKER_FD. */
#include <signal.h>
#include <sys/prctl.h>

#include "command.h"
#include "drawing.h"
#include "renderer/worker.h"

int command_worker(const struct options *options)
{
    /* A front that is killed takes its worker along. */
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    struct worker_params params = {
        .memory_limit_bytes = (size_t)option_int(options, OPTION_WORKER_MEMORY) << 20,
    };
    drawing_params(options, &params.renderer);
    return worker_run(WORKER_FD, &params);
}
