/* SPDX-License-Identifier: MIT */
/* What the render process gives up: privileges and files before a driver is loaded, calls of the
 * kernel once it is. Nothing given up comes back, and threads started later have no more. */
#ifndef RENDERER_CONFINE_H
#define RENDERER_CONFINE_H

#include <stdbool.h>

enum confine_mode {
    CONFINE_AUTO,   /* as far as the kernel can see to it */
    CONFINE_STRICT, /* all of it, or nothing is drawn */
    CONFINE_OFF,    /* privileges alone are given up */
};

/* What is in force. */
struct confinement {
    bool files, calls;
    char why[160]; /* what the kernel said of the first that is not; "": nothing */
};

/* Before any other thread runs: no privilege is gained any more by starting a program, all
 * capabilities go, and memory is never written to a file. Refusals of the kernel are not told. */
void confine_privileges(void);

/* Before any other thread runs (Landlock holds for a thread and those that it starts): files are
 * written beneath `cache_dir` alone (NULL: nowhere), and read there and where drivers are. Devices
 * that draw stay open to both. What is open already stays so. No process outside can be traced. */
void confine_files(struct confinement *out, const char *cache_dir);

/* All threads: no socket is made, no program or process started, no other process reached, no
 * right of a file changed (seccomp). A refused call fails with EPERM. */
void confine_calls(struct confinement *out);

#endif
