/* SPDX-License-Identifier: MIT */
/* fieldcast doctor: one line for everything that serving needs, and what to do where it fails.
 * Changes nothing but the shader cache. */
#include <errno.h>
#include <glob.h>
#include <netdb.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "command.h"
#include "local_render.h"
#include "protocol/memory.h"
#include "renderer/worker/worker.h"
#include "server/embedded.h"
#include "server/store/store.h"

enum { DEVICES_MAX = 16 };
#define DISK_WANTED (1ULL << 30)

enum verdict { GOOD, WARNING, BAD };

/* One check; returns 1 where it is BAD, so that callers can count. */
static int say(enum verdict verdict, const char *what, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static int say(enum verdict verdict, const char *what, const char *format, ...)
{
    static const char *const marks[] = {[GOOD] = "ok  ", [WARNING] = "warn", [BAD] = "FAIL"};
    va_list args;

    printf("%s  %-14s", marks[verdict], what);
    va_start(args, format);
    vprintf(format, args);
    va_end(args);
    putchar('\n');
    return verdict == BAD;
}

/* --- drawing --- */

static void list_devices(const struct device_params *params)
{
    struct device_report rows[DEVICES_MAX];
    const size_t count = renderer_devices(params, rows, DEVICES_MAX);

    for (size_t i = 0; i < count; i++) {
        printf("      device %zu      %s: %s\n", i, rows[i].name, rows[i].verdict);
    }
    if (count == 0) {
        printf("      no EGL device is listed\n");
    }
}

/* A GPU that is there, but not for this user, is the usual reason for drawing in software. */
static void explain_software(void)
{
    glob_t nodes;
    bool closed = false;

    if (glob("/dev/dri/renderD*", 0, NULL, &nodes) == 0) {
        for (size_t i = 0; i < nodes.gl_pathc; i++) {
            if (access(nodes.gl_pathv[i], R_OK | W_OK) != 0) {
                say(WARNING, "gpu", "%s is closed to this user; join its group (render)",
                    nodes.gl_pathv[i]);
                closed = true;
            }
        }
        globfree(&nodes);
    }
    if (!closed) {
        say(WARNING, "gpu", "none was found; all is drawn by the CPU, which works but is slow");
    }
}

static int check_drawing(const struct options *options)
{
    struct error err = {0};
    struct renderer_params params;

    local_render_params(options, &params);
    list_devices(&params.device);
    struct renderer *renderer = renderer_create(&params, &err);
    if (!renderer) {
        say(BAD, "drawing", "%s%s%s", err.place, *err.place ? ": " : "", err.message);
        return say(BAD, "drawing",
                   "a device is used from OpenGL 3.3 on, through EGL; --device auto draws without "
                   "one, by the engine");
    }
    const struct renderer_info *info = renderer_info(renderer);
    if (info->none) {
        say(GOOD, "drawing",
            "by the engine, without a graphics device; a GPU is used from OpenGL 3.3 on");
    } else {
        say(GOOD, "drawing", "%s, OpenGL %s, %s", info->name, info->version, info->device);
        say(GOOD, "stage", "%s; the device has %s", render_stage_names[info->stage],
            info->compute ? "compute and fragment shaders"
                          : "fragment shaders alone: OpenGL below 4.3");
    }
    if (info->software) {
        explain_software();
    }
    renderer_destroy(renderer);
    if (!params.device.cache_dir) {
        say(WARNING, "cache", "compiled shaders are not kept");
        return 0;
    }
    return say(GOOD, "cache", "%s", params.device.cache_dir);
}

/* Before any thread runs, as it starts a process. */
static int check_confinement(const struct options *options)
{
    struct worker_params params = {
        .confine = (enum confine_mode)option_int(options, OPTION_CONFINE),
    };
    struct confinement confined = {0};
    struct error err = {0};

    local_render_params(options, &params.renderer);
    fflush(stdout);
    const bool draws = worker_try(&params, &confined, &err);
    if (params.confine == CONFINE_OFF) {
        return say(WARNING, "confinement", "off (--confine)");
    }
    if (!draws) {
        return say(BAD, "confinement",
                   "the driver does not start in a confined process: %s; if it does here, "
                   "serve with --confine off",
                   err.message);
    }
    if (!confined.files || !confined.calls) {
        return say(params.confine == CONFINE_STRICT ? BAD : WARNING, "confinement", "%s",
                   confined.why);
    }
    return say(GOOD, "confinement",
               "the render process writes to its cache alone, opens no socket, starts no program");
}

/* --- the machine --- */

/* `path` or the nearest directory above it that exists. Caller frees. */
static char *nearest_existing(const char *path)
{
    char *copy = memory_text(path);

    while (access(copy, F_OK) != 0) {
        char *slash = strrchr(copy, '/');
        if (!slash || slash == copy) {
            strcpy(copy, slash ? "/" : ".");
            break;
        }
        *slash = '\0';
    }
    return copy;
}

static int check_data(const char *path)
{
    char *existing = nearest_existing(path);
    const bool made = strcmp(existing, path) == 0;
    struct statvfs disk;
    int bad = 0;

    if (access(existing, W_OK | X_OK) != 0) {
        bad = say(BAD, "data", "%s: %s: %s", path, existing, strerror(errno));
    } else if (statvfs(existing, &disk) != 0) {
        bad = say(BAD, "data", "%s: %s", existing, strerror(errno));
    } else {
        const unsigned long long room = (unsigned long long)disk.f_bavail * disk.f_frsize;
        say(room < DISK_WANTED ? WARNING : GOOD, "data", "%s%s, %.1f GiB free", path,
            made ? "" : " (will be made)", (double)room / (1 << 30));
    }
    free(existing);
    return bad;
}

static int check_store(const char *path)
{
    struct error err = {0};

    if (!store_check(path, &err)) {
        return say(BAD, "scenes",
                   "%s: %s; what can be read is served, the rest is lost without a "
                   "copy",
                   err.place, err.message);
    }
    return say(GOOD, "scenes", "no damage is found");
}

static int try_bind(const struct addrinfo *address)
{
    int one = 1;
    const int fd = socket(address->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);

    if (fd < 0) {
        return errno;
    }
    setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
    int result = 0;
    if (bind(fd, address->ai_addr, address->ai_addrlen) != 0 || listen(fd, 1) != 0) {
        result = errno;
    }
    close(fd);
    return result;
}

static int check_port(const char *host, const char *port)
{
    struct addrinfo hints = {.ai_socktype = SOCK_STREAM,
                             .ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE};
    struct addrinfo *address;
    const int status = getaddrinfo(host, port, &hints, &address);

    if (status != 0) {
        return say(BAD, "port", "%s: %s", host, gai_strerror(status));
    }
    const int failure = try_bind(address);
    freeaddrinfo(address);
    if (failure == EADDRINUSE) {
        return say(BAD, "port", "%s port %s is in use, perhaps by another fieldcast", host, port);
    }
    if (failure != 0) {
        return say(BAD, "port", "%s port %s: %s", host, port, strerror(failure));
    }
    return say(GOOD, "port", "%s port %s is free", host, port);
}

/* Every live connection is a descriptor; the rest is for the store, the worker and requests. */
static int check_descriptors(void)
{
    enum { WANTED = 2 * LIMIT_SESSIONS + 256 };
    struct rlimit limit;
    if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < WANTED) {
        say(WARNING, "open files", "%llu are allowed, %d sessions want %d (ulimit -n)",
            (unsigned long long)limit.rlim_cur, LIMIT_SESSIONS, WANTED);
    } else {
        say(GOOD, "open files", "enough are allowed");
    }
    return 0;
}

static int check_page(void)
{
    if (page_count == 0) {
        say(WARNING, "page", "not built in (`make web`, then `make`); the rest works without it");
    } else {
        say(GOOD, "page", "built in, %zu files, %zu example scenes", page_count, examples_count);
    }
    return 0;
}

int command_doctor(const struct options *options)
{
    puts("fieldcast " FIELDCAST_VERSION);
    int bad = check_confinement(options);
    bad += check_drawing(options);
    bad += check_data(option_text(options, OPTION_DATA));
    bad += check_store(option_text(options, OPTION_DATA));
    bad += check_port(option_text(options, OPTION_HOST), option_text(options, OPTION_PORT));
    bad += check_descriptors();
    bad += check_page();
    return bad > 0 ? EXIT_FAILED : EXIT_OK;
}
