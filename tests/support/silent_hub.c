/* SPDX-License-Identifier: MIT */
#include "silent_hub.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "renderer/worker/worker.h"

static char directory[] = "/tmp/fieldcast-hub-XXXXXX";

bool silent_hub_was_worker(int argc, char **argv)
{
    char bytes[4096];

    if (argc < 2 || strcmp(argv[1], "worker") != 0) {
        return false;
    }
    while (read(WORKER_FD, bytes, sizeof bytes) > 0) {
    }
    return true;
}

struct hub *silent_hub_open(void)
{
    static const char *const worker[] = {"test", "worker", NULL};
    struct error err = {0};
    struct hub *hub = hub_create(&(struct hub_params){.data_dir = directory,
                                                      .worker_argv = worker,
                                                      .worker_silence_ms = INT32_MAX,
                                                      .worker_busy_ms = INT32_MAX},
                                 &err);

    assert_string_equal(err.message, "");
    assert_non_null(hub);
    return hub;
}

void silent_hub_close(struct hub *hub)
{
    hub_drain(hub);
    hub_destroy(hub);
}

int silent_hub_make_directory(void **state)
{
    (void)state;
    return mkdtemp(directory) ? 0 : -1;
}

int silent_hub_remove_directory(void **state)
{
    char command[100];

    (void)state;
    snprintf(command, sizeof command, "rm -r %s", directory);
    return system(command);
}
