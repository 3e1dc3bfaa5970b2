/* SPDX-License-Identifier: MIT */
/* The requested graphics device, and the results of trying each. */
#ifndef RENDERER_DEVICE_H
#define RENDERER_DEVICE_H

#include <stdbool.h>

enum device_kind { DEVICE_AUTO, DEVICE_GPU, DEVICE_SOFTWARE, DEVICE_NONE, DEVICE_KINDS };
extern const char *const device_kind_names[DEVICE_KINDS];

struct device_params {
    enum device_kind kind; /* DEVICE_GPU: an error where there is only software; DEVICE_NONE: no
                              device is opened */
    int index;             /* among those of egl_report; -1: the best */
    const char *cache_dir; /* for Mesa's shader cache; NULL: the driver's default */
    bool debug;            /* the driver is asked for its debug output */
};

/* What `doctor` shows: one line per EGL device, why it was or was not chosen. */
struct device_report {
    char name[192];
    char verdict[192];
    bool software, usable, chosen;
};

#endif
