/* SPDX-License-Identifier: MIT */
#include "peak.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#ifdef __SANITIZE_ADDRESS__
size_t __sanitizer_get_current_allocated_bytes(void);
#endif

long peak_mib(void)
{
    long kib = 0;
    FILE *file = fopen("/proc/self/status", "r");
    char line[200];

    assert_non_null(file);
    while (kib == 0 && fgets(line, sizeof line, file)) {
        (void)sscanf(line, "VmHWM: %ld kB", &kib);
    }
    fclose(file);
    assert_true(kib > 0);
    return kib / 1024;
}

long peak_held_mib(void)
{
#ifdef __SANITIZE_ADDRESS__
    return (long)(__sanitizer_get_current_allocated_bytes() >> 20);
#else
    return peak_mib();
#endif
}
