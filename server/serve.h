/* SPDX-License-Identifier: MIT */
/* The life of the daemon: it starts everything, waits for a signal, and drains. The options are in
 * server/cli/options.h; the command line fills struct serve_params. */
#ifndef SERVER_SERVE_H
#define SERVER_SERVE_H

#include <stdbool.h>
#include <stddef.h>

#include "renderer/renderer.h"

/* Zero is the default of every member. Lists end with NULL; strings are borrowed. */
struct serve_params {
    const char *bind;     /* an IPv4 or IPv6 address; NULL: 127.0.0.1 */
    int port;             /* 0: any free port, printed */
    const char *data_dir; /* made when missing; required */
    const char *web_dir;  /* page from this directory; NULL: the embedded one */
    enum device_kind device;
    const char *const *worker_args;     /* further arguments of `fieldcast worker` */
    const char *token;                  /* NULL: none; required unless bound to loopback */
    const char *const *allowed_origins; /* besides the server's own: "https://example.org" */
    const char *const *allowed_hosts;   /* besides localhost, when bound to loopback */
    int worker_silence_ms;              /* silent and still for so long: replaced; 0: 5000 */
    int worker_busy_ms;                 /* processor time used in silence; 0: 60000 */
    bool code_refused;                  /* users' code is neither accepted nor compiled */
    const char *log_level;              /* "error" "warning" "info" "debug"; NULL: "info" */
};

/* Runs until SIGTERM or SIGINT; returns the exit status. Prints
 * "fieldcast: listening on http://ADDRESS:PORT/" on stdout when ready, everything else on stderr.
 * The program must handle `argv[1] == "worker"` by worker_run(WORKER_FD): it is started again as
 * /proc/self/exe worker --device KIND worker_args... */
int serve(const struct serve_params *params);

#endif
