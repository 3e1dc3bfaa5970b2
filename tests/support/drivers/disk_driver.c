/* SPDX-License-Identifier: MIT */
/* See disk_driver.h. */
#include "disk_driver.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

static char directory[4096];
static int failing_call, failing_nth, failing_error;
static int counts[DISK_CALLS_COUNT];
static int record_fd = -1;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

disk_arm_function disk_arm;
disk_count_function disk_count;
disk_record_function disk_record;
disk_note_function disk_note;

void disk_arm(const char *path, enum disk_call call, int nth, int error)
{
    snprintf(directory, sizeof directory, "%s", path);
    memset(counts, 0, sizeof counts);
    failing_call = call;
    failing_nth = nth;
    failing_error = error;
}

int disk_count(enum disk_call call)
{
    return counts[call];
}

void disk_record(int fd)
{
    record_fd = fd;
}

static void put(const void *bytes, size_t length)
{
    const char *from = bytes;

    while (length > 0) {
        const long done = syscall(SYS_write, record_fd, from, length);
        if (done <= 0) {
            abort();
        }
        from += done;
        length -= (size_t)done;
    }
}

static void record(enum disk_call call, const char *path, int64_t at, const void *bytes,
                   size_t length)
{
    if (record_fd < 0) {
        return;
    }
    const struct disk_entry entry = {call, (uint32_t)strlen(path), (uint32_t)length, at};
    pthread_mutex_lock(&lock);
    put(&entry, sizeof entry);
    put(path, strlen(path));
    put(bytes, length);
    pthread_mutex_unlock(&lock);
}

void disk_note(int64_t number)
{
    record(DISK_NOTE, "", number, NULL, 0);
}

static bool is_ours(const char *path)
{
    return *directory && strncmp(path, directory, strlen(directory)) == 0;
}

/* False: none of ours. */
static bool path_of(int fd, char out[4096])
{
    char link[64];

    if (!*directory) {
        return false;
    }
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    const long length = syscall(SYS_readlink, link, out, 4095);
    if (length <= 0) {
        return false;
    }
    out[length] = '\0';
    return is_ours(out);
}

/* errno of this call, DISK_SHORT, or 0. */
static int fault(enum disk_call call)
{
    const int number = __atomic_add_fetch(&counts[call], 1, __ATOMIC_SEQ_CST);
    const bool fails = (int)call == failing_call && number == failing_nth;

    if (fails && failing_error == DISK_KILLED) {
        kill(getpid(), SIGKILL);
        pause(); /* no other thread does the call meanwhile */
    }
    return fails ? failing_error : 0;
}

#define REAL(name) ((typeof(&name))dlsym(RTLD_NEXT, #name))

/* Recorded before it is done: nobody can know of it earlier. */
static size_t allowed(int fd, enum disk_call call, const void *bytes, size_t length, int64_t at)
{
    char path[4096];

    if (!path_of(fd, path)) {
        return length;
    }
    const int error = fault(call);
    if (error > 0) {
        errno = error;
        return 0;
    }
    if (error == DISK_SHORT) {
        length = (length + 1) / 2;
    }
    if (bytes) {
        record(call, path, at, bytes, length);
    }
    return length;
}

ssize_t write(int fd, const void *bytes, size_t length)
{
    char path[4096];
    const int64_t at = path_of(fd, path) ? lseek(fd, 0, SEEK_CUR) : 0;
    const size_t now = allowed(fd, DISK_WRITE, bytes, length, at);

    return now == 0 && length > 0 ? -1 : REAL(write)(fd, bytes, now);
}

ssize_t pwrite64(int fd, const void *bytes, size_t length, off64_t at)
{
    const size_t now = allowed(fd, DISK_WRITE, bytes, length, at);

    return now == 0 && length > 0 ? -1 : REAL(pwrite64)(fd, bytes, now, at);
}

ssize_t read(int fd, void *bytes, size_t length)
{
    const size_t now = allowed(fd, DISK_READ, NULL, length, 0);

    return now == 0 && length > 0 ? -1 : REAL(read)(fd, bytes, now);
}

ssize_t pread64(int fd, void *bytes, size_t length, off64_t at)
{
    const size_t now = allowed(fd, DISK_READ, NULL, length, 0);

    return now == 0 && length > 0 ? -1 : REAL(pread64)(fd, bytes, now, at);
}

int ftruncate64(int fd, off64_t size)
{
    char path[4096];

    if (path_of(fd, path)) {
        const int error = fault(DISK_CUT);
        if (error > 0) {
            errno = error;
            return -1;
        }
        record(DISK_CUT, path, size, NULL, 0);
    }
    return REAL(ftruncate64)(fd, size);
}

/* Recorded when it is done. */
static int synced(int fd, int (*real)(int fd))
{
    char path[4096];
    const bool ours = path_of(fd, path);
    const int error = ours ? fault(DISK_SYNC) : 0;

    if (error > 0) {
        errno = error;
        return -1;
    }
    const int result = real(fd);
    if (ours && result == 0) {
        record(DISK_SYNC, path, 0, NULL, 0);
    }
    return result;
}

int fsync(int fd)
{
    return synced(fd, REAL(fsync));
}

int fdatasync(int fd)
{
    return synced(fd, REAL(fdatasync));
}

static int opened(const char *path, int flags, mode_t mode, int (*real)(const char *, int, ...))
{
    const bool ours = is_ours(path);
    const int error = ours ? fault(DISK_OPEN) : 0;
    struct stat status;

    if (error > 0) {
        errno = error;
        return -1;
    }
    const bool is_new = ours && (flags & O_CREAT) && stat(path, &status) != 0;
    const int fd = real(path, flags, mode);
    if (is_new && fd >= 0) {
        record(DISK_MADE, path, 0, NULL, 0);
    }
    return fd;
}

static mode_t mode_of(int flags, va_list list)
{
    return flags & (O_CREAT | O_TMPFILE) ? va_arg(list, mode_t) : 0;
}

int open(const char *path, int flags, ...)
{
    va_list list;

    va_start(list, flags);
    const mode_t mode = mode_of(flags, list);
    va_end(list);
    return opened(path, flags, mode, REAL(open));
}

int open64(const char *path, int flags, ...)
{
    va_list list;

    va_start(list, flags);
    const mode_t mode = mode_of(flags, list);
    va_end(list);
    return opened(path, flags, mode, REAL(open64));
}

int mkdir(const char *path, mode_t mode)
{
    const int result = REAL(mkdir)(path, mode);

    if (result == 0 && is_ours(path)) {
        record(DISK_MADE, path, 1, NULL, 0);
    }
    return result;
}

int unlink(const char *path)
{
    const int error = is_ours(path) ? fault(DISK_REMOVE) : 0;

    if (error > 0) {
        errno = error;
        return -1;
    }
    const int result = REAL(unlink)(path);
    if (result == 0 && is_ours(path)) {
        record(DISK_REMOVE, path, 0, NULL, 0);
    }
    return result;
}

/* DISK_FAULT="PATH CALL NTH ERRNO", of a program that is no test. */
__attribute__((constructor)) static void arm_by_environment(void)
{
    static const char *const names[] = {
#define X(name, text) text,
        DISK_CALLS(X)
#undef X
    };
    const char *text = getenv("DISK_FAULT");
    char path[4096], name[16];
    int nth, error;

    if (!text || sscanf(text, "%4095s %15s %d %d", path, name, &nth, &error) != 4) {
        return;
    }
    for (int call = 0; call < DISK_CALLS_COUNT; call++) {
        if (strcmp(names[call], name) == 0) {
            disk_arm(path, (enum disk_call)call, nth, error);
        }
    }
}
