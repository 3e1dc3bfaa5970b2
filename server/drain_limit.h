/* SPDX-License-Identifier: MIT */
/* The end of a drain that hangs. Slow is not hung: what counts is how long the process is still,
 * and how much of the processor it uses (renderer/vigil.h). */
#ifndef SERVER_DRAIN_LIMIT_H
#define SERVER_DRAIN_LIMIT_H

enum { DRAIN_STILL_MS = 8000, DRAIN_BUSY_MS = 120000 };

/* From here on the process exits with status 1 when it was still for DRAIN_STILL_MS or has used
 * DRAIN_BUSY_MS of the processor; with a second SIGTERM or SIGINT at once. Both are blocked. */
void drain_limit(void);

#endif
