/* SPDX-License-Identifier: MIT */
/* Privileges. Files are in confine_files.c, calls of the kernel in confine_calls.c. */
#include "confine.h"

#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

static void drop_capabilities(void)
{
    struct __user_cap_header_struct head = {.version = _LINUX_CAPABILITY_VERSION_3};
    const struct __user_cap_data_struct none[_LINUX_CAPABILITY_U32S_3] = {{0}};

    syscall(SYS_capset, &head, none);
}

void confine_privileges(void)
{
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    drop_capabilities();
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
}
