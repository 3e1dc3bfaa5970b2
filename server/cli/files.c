/* SPDX-License-Identifier: MIT */
/* Whole files. */
#include "files.h"
#include "protocol/memory.h"
#include "server/directory.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
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
        const ssize_t got = read(fd, text + length, capacity - length - 1);
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
    const int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) {
        failed(path, err);
        return NULL;
    }
    char *text = read_all(fd, path, limit, out_length, err);
    close(fd);
    return text;
}

static bool is_special(const char *path)
{
    struct stat status;

    return stat(path, &status) == 0 && !S_ISREG(status.st_mode);
}

/* It goes with the process, whatever ends that. -1: the file system has no such files, or there is
 * no way to name one later. */
static int open_nameless(const char *path)
{
    char *folder = memory_text(path), *slash = strrchr(folder, '/');

    if (slash) {
        slash[slash == folder] = '\0';
    }
    const int fd = access("/proc/self/fd", X_OK) == 0
                       ? open(slash ? folder : ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600)
                       : -1;
    free(folder);
    return fd;
}

static int open_temporary(struct file_writer *writer)
{
    const int fd = open_nameless(writer->path);

    writer->nameless = fd >= 0;
    if (writer->nameless) {
        return fd;
    }
    if (asprintf(&writer->temporary, "%s.XXXXXX", writer->path) < 0) {
        abort();
    }
    return mkostemp(writer->temporary, O_CLOEXEC);
}

static void writer_free(struct file_writer *writer)
{
    free(writer->path);
    free(writer->temporary);
    *writer = (struct file_writer){0};
}

bool file_writer_open(struct file_writer *writer, const char *path, struct error *err)
{
    *writer = (struct file_writer){.path = memory_text(path)};
    const int fd = strcmp(path, "-") == 0 ? fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0)
                   : is_special(path)     ? open(path, O_WRONLY | O_CLOEXEC)
                                          : open_temporary(writer);
    writer->file = fd < 0 ? NULL : fdopen(fd, "w");
    if (!writer->file) {
        failed(path, err);
        writer_free(writer);
        return false;
    }
    return true;
}

/* mkstemp makes files for the user alone; this one gets the mode that open() would give. */
static bool finish_temporary(FILE *file)
{
    const mode_t mask = umask(0);

    umask(mask);
    return fchmod(fileno(file), 0666 & ~mask) == 0 && fsync(fileno(file)) == 0;
}

/* rename() replaces a file, linkat() does not: so there is a name in between. */
static bool give_name(struct file_writer *writer)
{
    enum { TRIES = 100 };
    char own[32];

    snprintf(own, sizeof own, "/proc/self/fd/%d", fileno(writer->file));
    for (int i = 0; i < TRIES; i++) {
        unsigned number = 0;
        char *name = NULL;

        if (getrandom(&number, sizeof number, 0) != sizeof number ||
            asprintf(&name, "%s.%08x", writer->path, number) < 0) {
            abort();
        }
        if (linkat(AT_FDCWD, own, AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0) {
            writer->temporary = name;
            return true;
        }
        const int reason = errno;
        free(name);
        errno = reason;
        if (reason != EEXIST) {
            break;
        }
    }
    return false;
}

bool file_writer_close(struct file_writer *writer, bool whole, struct error *err)
{
    bool ok = fflush(writer->file) == 0 && !ferror(writer->file);

    if (writer->nameless || writer->temporary) {
        ok = whole && ok && finish_temporary(writer->file) &&
             (writer->temporary || give_name(writer)) &&
             rename(writer->temporary, writer->path) == 0;
    }
    if (whole && !ok) {
        failed(strcmp(writer->path, "-") == 0 ? "stdout" : writer->path, err);
    }
    if (writer->temporary && !ok) {
        unlink(writer->temporary);
    }
    fclose(writer->file);
    writer_free(writer);
    return whole && ok;
}

bool file_replace(const char *path, const void *bytes, size_t length, struct error *err)
{
    struct file_writer writer;

    if (!file_writer_open(&writer, path, err)) {
        return false;
    }
    fwrite(bytes, 1, length, writer.file);
    return file_writer_close(&writer, true, err);
}

bool directory_make(const char *path, struct error *err)
{
    char *copy = memory_text(path);
    bool ok = true;

    for (char *end = copy + 1; ok; end++) {
        if (*end != '/' && *end != '\0') {
            continue;
        }
        const char kept = *end;
        *end = '\0';
        if (mkdir(copy, 0700) == 0) {
            directory_sync_parent(copy);
        } else {
            ok = errno == EEXIST || errno == EISDIR;
        }
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
