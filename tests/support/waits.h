/* SPDX-License-Identifier: MIT */
/* Whether a thread goes on without a pause, which no clock can tell on a busy machine. */
#ifndef TESTS_SUPPORT_WAITS_H
#define TESTS_SUPPORT_WAITS_H

/* How often the calling thread has given up its processor to wait for something. */
long waits_of_thread(void);

#endif
