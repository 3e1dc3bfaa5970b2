/* SPDX-License-Identifier: MIT */
#ifndef TESTS_SUPPORT_PEAK_H
#define TESTS_SUPPORT_PEAK_H

/* The most memory that this process ever had. */
long peak_mib(void);

#endif
