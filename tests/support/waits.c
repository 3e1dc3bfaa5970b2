/* SPDX-License-Identifier: MIT */
#include "waits.h"

#include <sys/resource.h>

long waits_of_thread(void)
{
    struct rusage usage;

    getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_nvcsw;
}
