/* SPDX-License-Identifier: MIT */
/* What a C test that takes minutes says on its way. Every C test prints line by line. */
#ifndef TESTS_SUPPORT_PROGRESS_H
#define TESTS_SUPPORT_PROGRESS_H

/* A comment in TAP. */
void progress(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
