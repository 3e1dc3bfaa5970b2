/* SPDX-License-Identifier: MIT */
#include "slice.h"

#include <linux/sched/types.h>
#include <stdint.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { NS_OF_US = 1000, THIS_THREAD = 0 };

/* 0: as long as others have. What else is set of the thread stays. */
static void set_runtime(uint64_t ns)
{
    struct sched_attr attributes = {0};

    if (syscall(SYS_sched_getattr, THIS_THREAD, &attributes, sizeof attributes, 0) == 0) {
        attributes.sched_runtime = ns;
        syscall(SYS_sched_setattr, THIS_THREAD, &attributes, 0);
    }
}

void slice_short(void)
{
    set_runtime((uint64_t)SLICE_SHORT_US * NS_OF_US);
}

void slice_long(void)
{
    set_runtime((uint64_t)SLICE_LONG_US * NS_OF_US);
}

void slice_drawing(void)
{
    set_runtime((uint64_t)SLICE_DRAWING_US * NS_OF_US);
}
