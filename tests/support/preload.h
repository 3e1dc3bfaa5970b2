/* SPDX-License-Identifier: MIT */
/* A test that wants a library of support/drivers in front of libc. */
#ifndef TESTS_SUPPORT_PRELOAD_H
#define TESTS_SUPPORT_PRELOAD_H

/* Starts this program again behind the library, if it is not. The first thing in main. */
void preload(char **argv, const char *name);
/* A function of it; NULL: there is none. */
void *preload_symbol(const char *name);

#endif
