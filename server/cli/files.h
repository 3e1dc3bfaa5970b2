/* SPDX-License-Identifier: MIT */
/* Whole files: read, replaced at once, and the directories they stand in. */
#ifndef SERVER_FILES_H
#define SERVER_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "protocol/error.h"

/* At most `limit` bytes of a file, or of stdin for "-", with a NUL behind them. NULL and `err`
 * (its place is `path`) on failure. Caller frees. */
char *file_read(const char *path, size_t limit, size_t *out_length, struct error *err);

/* A file that becomes `path` when it is whole: it is written beside it and renamed, so that `path`
 * stays as it was until then. "-" is stdout; what is no regular file (a pipe, a device) is written
 * in place. */
struct file_writer {
    FILE *file;
    char *path, *temporary; /* NULL: written in place */
};
bool file_writer_open(struct file_writer *writer, const char *path, struct error *err);
/* Closes it; `whole` is false after a failure: then `path` stays as it was. */
bool file_writer_close(struct file_writer *writer, bool whole, struct error *err);

/* Makes `path` hold exactly these bytes, in the same way. */
bool file_replace(const char *path, const void *bytes, size_t length, struct error *err);

/* mkdir -p, for the user alone. */
bool directory_make(const char *path, struct error *err);
/* rm -rf of a directory that this program made for itself. */
void directory_remove(const char *path);

#endif
