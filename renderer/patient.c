/* SPDX-License-Identifier: MIT */
#include "patient.h"

#include <sys/resource.h>

enum { PATIENT_NICE = 5 };

/* Linux has a priority for each thread. */
void patient_thread(void)
{
    setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + PATIENT_NICE);
}
