/* SPDX-License-Identifier: MIT */
/* Which files can be opened, and for what: Landlock. */
#include <errno.h>
#include <fcntl.h>
#include <glob.h>
#include <linux/landlock.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "confine.h"

#ifndef LANDLOCK_ACCESS_FS_TRUNCATE
#define LANDLOCK_ACCESS_FS_TRUNCATE (1ULL << 14)
#endif

#define READ (LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR)
#define USE (READ | LANDLOCK_ACCESS_FS_WRITE_FILE)
#define KEEP                                                                                       \
    (USE | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_DIR |                             \
     LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REFER |   \
     LANDLOCK_ACCESS_FS_TRUNCATE)
#define OF_A_FILE                                                                                  \
    (LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_READ_FILE |   \
     LANDLOCK_ACCESS_FS_TRUNCATE)

/* By the version of Landlock; later ones add nothing about files that is needed here. */
static const uint64_t known[] = {
    [1] = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1,
    [2] = (LANDLOCK_ACCESS_FS_REFER << 1) - 1,
    [3] = (LANDLOCK_ACCESS_FS_TRUNCATE << 1) - 1, /* confine_calls.c: what stands for it before */
};
enum { VERSIONS = sizeof known / sizeof known[0] };

/* Libraries, settings and the state of the machine as drivers read them; and this program, for the
 * names in a report of a sanitizer. Not all of /etc and /run: there are secrets of others. */
static const struct {
    const char *pattern;
    uint64_t access;
} places[] = {
    {"/usr", READ},
    {"/lib*", READ},
    {"/opt", READ},
    {"/nix/store", READ},
    {"/gnu/store", READ},
    {"/snap", READ},
    {"/app", READ},
    {"/proc", READ},
    {"/sys", READ},
    {"/proc/self/exe", READ},
    {"/etc/ld.so.*", READ},
    {"/etc/glvnd", READ},
    {"/etc/egl", READ},
    {"/etc/drirc", READ},
    {"/etc/nvidia", READ},
    {"/etc/passwd", READ},
    {"/etc/nsswitch.conf", READ},
    {"/etc/localtime", READ},
    {"/run/opengl-driver*", READ},
    {"/run/udev/data", READ},
    {"/dev", LANDLOCK_ACCESS_FS_READ_DIR},
    {"/dev/*random", READ},
    {"/dev/null", USE},
    {"/dev/zero", USE},
    {"/dev/dri", USE},
    {"/dev/nvidia*", USE},
    {"/dev/kfd", USE},
    {"/dev/dxg", USE},
    {"/dev/mali*", USE},
    {"/dev/dma_heap", USE},
    {"/dev/udmabuf", USE},
};

/* Where a user may have drivers of their own: paths with colons between them. */
static const char *const variables[] = {
    "LD_LIBRARY_PATH",           "LIBGL_DRIVERS_PATH",
    "GBM_BACKENDS_PATH",         "GBM_DRIVERS_PATH",
    "__EGL_VENDOR_LIBRARY_DIRS", "__EGL_VENDOR_LIBRARY_FILENAMES",
    "LIBGL_DRIVERS_DIR",         "__EGL_EXTERNAL_PLATFORM_CONFIG_DIRS",
};

/* What is not there needs no rule. */
static void allow(int rules, const char *path, uint64_t access)
{
    struct stat status;
    const int fd = open(path, O_PATH | O_CLOEXEC);

    if (fd < 0) {
        return;
    }
    if (fstat(fd, &status) == 0 && !S_ISDIR(status.st_mode)) {
        access &= OF_A_FILE;
    }
    const struct landlock_path_beneath_attr beneath = {.allowed_access = access, .parent_fd = fd};
    syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0);
    close(fd);
}

static void allow_pattern(int rules, const char *pattern, uint64_t access)
{
    glob_t found;

    if (glob(pattern, 0, NULL, &found) == 0) {
        for (size_t i = 0; i < found.gl_pathc; i++) {
            allow(rules, found.gl_pathv[i], access);
        }
        globfree(&found);
    }
}

static void allow_variable(int rules, const char *name, uint64_t access)
{
    const char *value = getenv(name);
    char *copy = value ? strdup(value) : NULL, *rest = copy, *path;

    while (copy && (path = strsep(&rest, ":"))) {
        if (*path == '/') {
            allow(rules, path, access);
        }
    }
    free(copy);
}

static void refused(struct confinement *out, const char *what)
{
    snprintf(out->why, sizeof out->why, "files: %s: %s", what, strerror(errno));
}

void confine_files(struct confinement *out, const char *cache_dir)
{
    const long version =
        syscall(SYS_landlock_create_ruleset, NULL, 0, LANDLOCK_CREATE_RULESET_VERSION);

    if (version < 1) {
        refused(out, "the kernel has no Landlock");
        return;
    }
    const uint64_t handled = known[version < VERSIONS ? version : VERSIONS - 1];
    const struct landlock_ruleset_attr all = {.handled_access_fs = handled};
    const int rules = (int)syscall(SYS_landlock_create_ruleset, &all, sizeof all, 0);
    if (rules < 0) {
        refused(out, "no rules can be made");
        return;
    }
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        allow_pattern(rules, places[i].pattern, places[i].access & handled);
    }
    for (size_t i = 0; i < sizeof variables / sizeof variables[0]; i++) {
        allow_variable(rules, variables[i], READ);
    }
    if (cache_dir) {
        allow(rules, cache_dir, KEEP & handled);
    }
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    out->files = syscall(SYS_landlock_restrict_self, rules, 0) == 0;
    if (!out->files) {
        refused(out, "the rules cannot be put in force");
    }
    close(rules);
}
