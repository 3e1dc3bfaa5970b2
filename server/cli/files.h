/* SPDX-License-Identifier: MIT */
/* Whole files: reading, atomic replacement, and directories. */
#ifndef SERVER_FILES_H
#define SERVER_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "protocol/error.h"

/* Reads a file of at most `limit` bytes, or stdin for "-", and adds a NUL. NULL and `err` (its
 * place is `path`) on failure. Caller frees. */
char *file_read(const char *path, size_t limit, size_t *out_length, struct error *err);

/* Writes a file without a name and gives it that of `path` when it is complete, so `path` is never
 * incomplete and nothing is left of a process that was ended. On file systems without such files it
 * is one beside `path`. "-" is stdout. A pipe or a device is written in place. */
struct file_writer {
    FILE *file;
    char *path, *temporary; /* the second is NULL while there is no such name */
    bool nameless;          /* false, and no `temporary`: written in place */
};
bool file_writer_open(struct file_writer *writer, const char *path, struct error *err);
/* Closes the file. Pass `whole` as false after a failure; then `path` stays unchanged. */
bool file_writer_close(struct file_writer *writer, bool whole, struct error *err);

/* Replaces the content of `path`, in the same way. */
bool file_replace(const char *path, const void *bytes, size_t length, struct error *err);

/* Creates a directory and its parents, accessible to this user alone. */
bool directory_make(const char *path, struct error *err);
/* Removes a directory that this program has made, with its content. */
void directory_remove(const char *path);

#endif
