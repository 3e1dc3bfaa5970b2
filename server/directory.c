/* SPDX-License-Identifier: MIT */
#include "directory.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "protocol/memory.h"

void directory_sync_parent(const char *path)
{
    char *parent = memory_text(path), *end = parent + strlen(parent);

    while (end > parent && end[-1] == '/') {
        *--end = '\0';
    }
    char *slash = strrchr(parent, '/');
    if (slash) {
        slash[slash == parent] = '\0';
    }
    const int fd = open(slash ? parent : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd >= 0) {
        fsync(fd);
        close(fd);
    }
    free(parent);
}
