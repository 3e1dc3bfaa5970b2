/* SPDX-License-Identifier: MIT */
/* Whole files. */
#include "files.h"
#include "protocol/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool failed(const char *path, struct error *err)
{
    return error_set(err, ERROR_INVALID, path, "%s", strerror(errno));
}

static char *read_all(int fd, const char *path, size_t limit, size_t *out_length, struct error *err)
{
    size_t capacity = 65536, length = 0;
    char *text = memory_alloc(capacity, 1);
    for (;;) {
        ssize_t got = read(fd, text + length, capacity - length - 1);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            failed(path, err);
            break;
        }
        length += (size_t)got;
        if (length > limit) {
            error_set(err, ERROR_TOO_LARGE, path, "is larger than the maximum of %zu bytes", limit);
            break;
        }
        if (got == 0) {
            text[length] = '\0';
            *out_length = length;
            return text;
        }
        if (capacity - length < 2) {
            capacity *= 2;
            text = memory_resize(text, capacity, 1);
        }
    }
    free(text);
    return NULL;
}

char *file_read(const char *path, size_t limit, size_t *out_length, struct error *err)
{
    if (strcmp(path, "-") == 0) {
        return read_all(STDIN_FILENO, "stdin", limit, out_length, err);
    }
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) {
        failed(path, err);
        return NULL;
    }
    char *text = read_all(fd, path, limit, out_length, err);
    close(fd);
    return text;
}

static bool write_all(int fd, const char *bytes, size_t length)
{
    while (length > 0) {
        ssize_t wrote = write(fd, bytes, length);
        if (wrote < 0 && errno == EINTR) {
            continue;
        }
        if (wrote < 0) {
            return false;
        }
        bytes += wrote;
        length -= (size_t)wrote;
    }
    return true;
}

static bool write_in_place(const char *path, const void *bytes, size_t length, struct error *err)
{
    int fd = open(path, O_WRONLY | O_CLOEXEC);
    if (fd < 0) {
        return failed(path, err);
    }
    bool ok = write_all(fd, bytes, length) || failed(path, err);
    close(fd);
    return ok;
}

/* mkstemp makes files for the user alone; this one gets the mode that open() would give. */
static bool finish_temporary(int fd, const void *bytes, size_t length)
{
    mode_t mask = umask(0);
    umask(mask);
    return write_all(fd, bytes, length) && fchmod(fd, 0666 & ~mask) == 0 && fsync(fd) == 0;
}

bool file_replace(const char *path, const void *bytes, size_t length, struct error *err)
{
    if (strcmp(path, "-") == 0) {
        return write_all(STDOUT_FILENO, bytes, length) || failed("stdout", err);
    }
    struct stat status;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode)) {
        return write_in_place(path, bytes, length, err);
    }

    char *temporary = NULL;
    if (asprintf(&temporary, "%s.XXXXXX", path) < 0) {
        abort();
    }
    int fd = mkostemp(temporary, O_CLOEXEC);
    bool ok = fd >= 0 && finish_temporary(fd, bytes, length) && rename(temporary, path) == 0;
    if (!ok) {
        failed(path, err);
        if (fd >= 0) {
            unlink(temporary);
        }
    }
    if (fd >= 0) {
        close(fd);
    }
    free(temporary);
    return ok;
}

bool directory_make(const char *path, struct error *err)
{
    char *copy = memory_text(path);
    bool ok = true;
    for (char *end = copy + 1; ok; end++) {
        if (*end != '/' && *end != '\0') {
            continue;
        }
        char kept = *end;
        *end = '\0';
        ok = mkdir(copy, 0700) == 0 || errno == EEXIST || errno == EISDIR;
        *end = kept;
        if (kept == '\0') {
            break;
        }
    }
    struct stat status;
    if (ok && stat(path, &status) == 0 && !S_ISDIR(status.st_mode)) {
        errno = ENOTDIR;
        ok = false;
    }
    if (!ok) {
        failed(path, err);
    }
    free(copy);
    return ok;
}

static int remove_entry(const char *path, const struct stat *status, int kind, struct FTW *walk)
{
    (void)status;
    (void)kind;
    (void)walk;
    return remove(path);
}

void directory_remove(const char *path)
{
    enum { OPEN_DIRECTORIES = 16 };
    nftw(path, remove_entry, OPEN_DIRECTORIES, FTW_DEPTH | FTW_PHYS);
}
