/* SPDX-License-Identifier: MIT */
#include "preload.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void preload(char **argv, const char *name)
{
    char path[4096], options[4096];
    const char *end = strrchr(argv[0], '/'), *before = getenv("ASAN_OPTIONS");
    const char *loaded = getenv("LD_PRELOAD");

    if (loaded && strstr(loaded, name)) {
        return;
    }
    snprintf(path, sizeof path, "%.*s/../support/drivers/%s.so", end ? (int)(end - argv[0]) : 0,
             argv[0], name);
    snprintf(options, sizeof options, "%s:verify_asan_link_order=0", before ? before : "");
    if (access(path, R_OK) == 0 && setenv("LD_PRELOAD", path, 1) == 0 &&
        setenv("ASAN_OPTIONS", options, 1) == 0) {
        execv("/proc/self/exe", argv);
    }
    printf("Bail out! %s cannot be loaded\n", path);
    exit(1);
}

void *preload_symbol(const char *name)
{
    return dlsym(RTLD_DEFAULT, name);
}
