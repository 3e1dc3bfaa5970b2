/* SPDX-License-Identifier: MIT */
/* Memory in pages of 2 MiB, for processes that draw: the first picture of a scene takes megabytes,
 * and a page of 4 KiB costs the kernel up to 10 us. */
#ifndef SERVER_HUGE_PAGES_H
#define SERVER_HUGE_PAGES_H

#include <stdbool.h>

/* For all processes that this one starts from here on. False: they have it already, or cannot. Call
 * it before there is another thread. */
bool huge_pages_ask(void);

/* For this one too: starts the program anew with the same arguments, those of main(), because glibc
 * reads the setting from the environment before main(). Returns where there is nothing to do. Call
 * it before there is a thread or an open file. */
void huge_pages_use(char *const *argv);

#endif
