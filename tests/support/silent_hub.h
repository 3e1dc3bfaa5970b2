/* SPDX-License-Identifier: MIT */
/* A hub without connections, in a directory of its own. Its worker is the test's program, which
 * says nothing then: what is told to it is lost. */
#ifndef TESTS_SUPPORT_SILENT_HUB_H
#define TESTS_SUPPORT_SILENT_HUB_H

#include "server/live/hub_life.h"

/* The first of main: true where the program was started as the worker, and has been one. */
bool silent_hub_was_worker(int argc, char **argv);
struct hub *silent_hub_open(void);
/* With the snapshots that the server stores at its end. */
void silent_hub_close(struct hub *hub);
/* For cmocka's groups: the directory of all hubs, which know what those before have stored. */
int silent_hub_make_directory(void **state);
int silent_hub_remove_directory(void **state);

#endif
