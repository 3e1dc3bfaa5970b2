/* SPDX-License-Identifier: MIT */
#include "device.h"

const char *const device_kind_names[DEVICE_KINDS] = {
    [DEVICE_AUTO] = "auto",
    [DEVICE_GPU] = "gpu",
    [DEVICE_SOFTWARE] = "software",
    [DEVICE_NONE] = "none",
};
