/* SPDX-License-Identifier: MIT */
/* What a thread was at when it crashed, told by the exit status of its process: the cause is known
 * for sure. Signals that a process sends say nothing of that. Neither does abort(), by which
 * allocations fail: anybody may have taken the memory. */
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

/* From here on, in the whole process; where a sanitizer looks at a signal, that signal is its. */
void crash_watch(void);
/* What this thread is at from here on. */
void crash_thread(enum crash_work work);
/* That of an exit status. */
enum crash_work crash_of(int exit_status);

#endif
