/* SPDX-License-Identifier: MIT */
/* fieldcast worker: the render process, started by `serve` with its sockets at WORKER_FD and
 * WORKER_PULSE_FD. */
#include <signal.h>

#include "command.h"
#include "local_render.h"
#include "renderer/worker/worker.h"

int command_worker(const struct options *options)
{
    /* A signal from the terminal reaches both processes, but only the front decides when to end. */
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN);
    struct worker_params params = {
        .pulse_fd = WORKER_PULSE_FD,
        .memory_limit_bytes = (size_t)option_int(options, OPTION_WORKER_MEMORY) << 20,
        .confine = (enum confine_mode)option_int(options, OPTION_CONFINE),
    };
    local_render_params(options, &params.renderer);
    params.renderer.code_ms = option_int(options, OPTION_CODE_TIME);
    params.renderer.tile_ms = option_int(options, OPTION_TILE_TIME);
    return worker_run(WORKER_FD, &params);
}
