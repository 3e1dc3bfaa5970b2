/* SPDX-License-Identifier: MIT */
/* What the render process gives up before it reads anything of users or loads a driver. */
#ifndef RENDERER_CONFINE_H
#define RENDERER_CONFINE_H

/* Before any other thread runs: no privilege is gained any more by starting a program, all
 * capabilities go, and memory is never written to a file. Says nothing where the kernel refuses. */
void confine(void);

#endif
