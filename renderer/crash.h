/* SPDX-License-Identifier: MIT */
/* The work of a thread that crashed, encoded in the exit status of its process. The cause is then
 * certain. It is not after a signal sent by a process, nor after abort(), which follows a failed
 * allocation: any thread may have used up the memory. */
#ifndef RENDERER_CRASH_H
#define RENDERER_CRASH_H

enum crash_work {
    CRASH_ANYWHERE, /* the process ends by the signal */
    CRASH_COMPILING,
    CRASH_READING,
    CRASH_OPENING,
    CRASH_DRAWING,
    CRASH_WORKS
};
enum { CRASH_STATUS = 64 }; /* exit status, added to an enum crash_work */

/* Installs handlers for the whole process. Signals that a sanitizer handles are left to it. */
void crash_watch(void);
/* Sets the work of this thread. */
void crash_thread(enum crash_work work);
/* That work, for the threads that are started to help with it. */
enum crash_work crash_thread_work(void);
/* The work that an exit status encodes. */
enum crash_work crash_of(int exit_status);

#endif
