/* SPDX-License-Identifier: MIT */
#include "huge_pages.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* glibc's manual: Memory Allocation Tunables. 1: by madvise(), so the kernel's setting decides. */
#define TUNABLES "GLIBC_TUNABLES"
#define HUGE_PAGES "glibc.malloc.hugetlb"

bool huge_pages_ask(void)
{
    const char *set = getenv(TUNABLES);
    char with[4096];

    if (set && strstr(set, HUGE_PAGES)) {
        return false;
    }
    const int length =
        snprintf(with, sizeof with, "%s%s" HUGE_PAGES "=1", set ? set : "", set && *set ? ":" : "");
    return length < (int)sizeof with && setenv(TUNABLES, with, 1) == 0;
}

void huge_pages_use(char *const *argv)
{
    const bool news = huge_pages_ask();

#ifndef __SANITIZE_ADDRESS__ /* it has a malloc() of its own */
    if (news) {
        execv("/proc/self/exe", argv);
    }
#else
    (void)news;
    (void)argv;
#endif
}
