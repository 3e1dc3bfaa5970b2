/* SPDX-License-Identifier: MIT */
/* A disk that fails, and one that remembers: loaded in front of libc (LD_PRELOAD), it sees what is
 * done to the files beneath one directory. A test finds these functions by dlsym. */
#ifndef TESTS_SUPPORT_DISK_DRIVER_H
#define TESTS_SUPPORT_DISK_DRIVER_H

#include <stdint.h>

/* X(NAME, "name") */
#define DISK_CALLS(X)                                                                              \
    X(OPEN, "open")                                                                                \
    X(READ, "read")                                                                                \
    X(WRITE, "write")                                                                              \
    X(CUT, "ftruncate")                                                                            \
    X(SYNC, "fsync")                                                                               \
    X(REMOVE, "unlink")

enum disk_call {
#define X(name, text) DISK_##name,
    DISK_CALLS(X)
#undef X
        DISK_CALLS_COUNT,
    /* in a record alone */
    DISK_MADE = DISK_CALLS_COUNT, /* an entry of a directory is new */
    DISK_NOTE,
};

/* Instead of an errno. */
enum {
    DISK_SHORT = -1,  /* half of it is written or read */
    DISK_KILLED = -2, /* the process ends before it */
};

struct disk_entry {
    uint32_t call;        /* enum disk_call */
    uint32_t path_length; /* of the path behind this, and then */
    uint32_t length;      /* of what was written */
    int64_t at;           /* offset, size, or number of a note */
};

/* From here on: the call of this kind that comes as number `nth` fails once; 0: none. */
typedef void disk_arm_function(const char *directory, enum disk_call call, int nth, int error);
typedef int disk_count_function(enum disk_call call);
/* Entries go to `fd`; -1: no more. */
typedef void disk_record_function(int fd);
typedef void disk_note_function(int64_t number);

#endif
