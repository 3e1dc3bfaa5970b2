/* SPDX-License-Identifier: MIT */
#ifndef TESTS_SUPPORT_PEAK_H
#define TESTS_SUPPORT_PEAK_H

/* The most memory that this process ever had. */
long peak_mib(void);
/* What is allocated now, for programs with AddressSanitizer, whose peak holds much that was freed;
 * elsewhere the same as peak_mib(). */
long peak_held_mib(void);

#endif
