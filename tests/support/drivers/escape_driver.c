/* SPDX-License-Identifier: MIT */
/* What a driver in the wrong hands would try: loaded in front of another (LD_PRELOAD), it tries to
 * reach the rest of the machine when the first picture is drawn, on the thread that draws and on
 * one that was started with the driver. Each act is a line of ESCAPE_REPORT: thread, act, errno.
 *
 * ESCAPE_DATA: a directory that is none of its business, with files `secret` and `spare`.
 * ESCAPE_WITHOUT: `landlock` or `seccomp`, which the kernel is said not to have. */
#include <EGL/egl.h>
#include <GL/glcorearb.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

static PFNGLFENCESYNCPROC real_fence;
static pthread_t loaded; /* the thread that was started with the driver */
static sem_t go;
static const char *thread_name;

/* errno of what returned `result`, which is closed where it is a descriptor. */
static int failure(int result)
{
    const int error = result < 0 ? errno : 0;

    if (result > STDERR_FILENO) {
        close(result);
    }
    return error;
}

static const char *beside(const char *name)
{
    static char path[4096];

    snprintf(path, sizeof path, "%s/%s", getenv("ESCAPE_DATA"), name);
    return path;
}

static const char *of_parent(const char *name)
{
    static char path[64];

    snprintf(path, sizeof path, "/proc/%d/%s", (int)getppid(), name);
    return path;
}

static int make_socket(void)
{
    return failure(socket(AF_INET, SOCK_STREAM, 0));
}

static int make_unix_socket(void)
{
    return failure(socket(AF_UNIX, SOCK_DGRAM, 0));
}

static int start_process(void)
{
    const pid_t child = fork();

    if (child == 0) {
        _exit(0);
    }
    if (child > 0) {
        waitpid(child, NULL, 0);
    }
    return child < 0 ? errno : 0;
}

static int start_program(void)
{
    char *const argv[] = {"true", NULL};
    pid_t child;
    const int error = posix_spawn(&child, "/bin/true", NULL, NULL, argv, argv + 1);

    if (error == 0) {
        waitpid(child, NULL, 0);
    }
    return error;
}

static int become_program(void)
{
    static volatile int error;
    char *const argv[] = {"true", NULL};
    const pid_t child = vfork();

    error = child < 0 ? errno : 0;
    if (child <= 0) { /* without a child it would end the report where it is not refused */
        execve("/bin/true", argv, argv + 1);
        error = errno;
    }
    if (child == 0) {
        _exit(1);
    }
    if (child > 0) {
        waitpid(child, NULL, 0);
    }
    return error;
}

static int write_new(void)
{
    return failure(open(beside("new"), O_WRONLY | O_CREAT, 0600));
}

static int write_old(void)
{
    return failure(open(beside("secret"), O_WRONLY));
}

static int read_old(void)
{
    return failure(open(beside("secret"), O_RDONLY));
}

static int list(void)
{
    return failure(open(beside("."), O_RDONLY | O_DIRECTORY));
}

static int cut_by_opening(void)
{
    return failure(open(beside("secret"), O_RDONLY | O_TRUNC));
}

static int cut_by_name(void)
{
    return failure(truncate(beside("secret"), 0));
}

static int change_rights(void)
{
    return failure(chmod(beside("secret"), 0666));
}

static int make_directory(void)
{
    return failure(mkdir(beside("folder"), 0700) == 0 ? rmdir(beside("folder")) : -1);
}

static int make_pipe(void)
{
    return failure(mkfifo(beside("pipe"), 0600) == 0 ? unlink(beside("pipe")) : -1);
}

static int rename_old(void)
{
    char from[4096];

    snprintf(from, sizeof from, "%s", beside("secret"));
    const int error = failure(rename(from, beside("moved")));
    if (error == 0) {
        rename(beside("moved"), from);
    }
    return error;
}

static int remove_old(void)
{
    const int error = failure(unlink(beside("spare")));

    if (error == 0) {
        failure(open(beside("spare"), O_WRONLY | O_CREAT, 0600)); /* for the other thread */
    }
    return error;
}

static int trace_parent(void)
{
    const pid_t parent = getppid();
    int status;

    if (ptrace(PTRACE_SEIZE, parent, NULL, NULL) != 0) {
        return errno;
    }
    ptrace(PTRACE_INTERRUPT, parent, NULL, NULL);
    waitpid(parent, &status, __WALL);
    ptrace(PTRACE_DETACH, parent, NULL, NULL);
    return 0;
}

static int read_parent(void)
{
    char byte;
    struct iovec here = {&byte, 1}, there = {&failure, 1};

    errno = 0;
    process_vm_readv(getppid(), &here, 1, &there, 1, 0);
    return errno == EFAULT ? 0 : errno; /* it has other addresses */
}

static int open_parent(void)
{
    return failure(open(of_parent("mem"), O_RDWR));
}

static int read_environment(void)
{
    return failure(open(of_parent("environ"), O_RDONLY));
}

static int signal_parent(void)
{
    return failure(kill(getppid(), SIGCONT));
}

static int signal_thread_of_parent(void)
{
    return failure((int)syscall(SYS_tgkill, getppid(), getppid(), SIGCONT));
}

static int signal_by_descriptor(void)
{
    const int fd = (int)syscall(SYS_pidfd_open, getppid(), 0);
    const int error =
        fd < 0 ? errno : failure((int)syscall(SYS_pidfd_send_signal, fd, SIGCONT, NULL, 0));

    failure(fd);
    return error;
}

static int signal_by_socket(void)
{
    return failure(fcntl(3, F_SETOWN, getppid()));
}

static int limit_parent(void)
{
    struct rlimit limit;

    return failure(prlimit(getppid(), RLIMIT_CORE, NULL, &limit));
}

static int outlive_parent(void)
{
    return failure((int)syscall(SYS_prctl, 1 /* PR_SET_PDEATHSIG */, SIGKILL, 0, 0, 0));
}

static int change_user(void)
{
    return failure((int)syscall(SYS_setuid, getuid()));
}

static const struct {
    const char *name;
    int (*act)(void);
} acts[] = {
    {"make a socket", make_socket},
    {"make a Unix socket", make_unix_socket},
    {"start a process", start_process},
    {"start a program", start_program},
    {"become a program", become_program},
    {"write a new file", write_new},
    {"write a file", write_old},
    {"read a file", read_old},
    {"list a directory", list},
    {"cut a file by opening it", cut_by_opening},
    {"cut a file by its name", cut_by_name},
    {"change the rights of a file", change_rights},
    {"make a directory", make_directory},
    {"make a pipe", make_pipe},
    {"rename a file", rename_old},
    {"remove a file", remove_old},
    {"trace the parent", trace_parent},
    {"read the parent", read_parent},
    {"open the parent", open_parent},
    {"read the parent's environment", read_environment},
    {"signal the parent", signal_parent},
    {"signal a thread of the parent", signal_thread_of_parent},
    {"signal the parent by a descriptor", signal_by_descriptor},
    {"signal the parent by a socket", signal_by_socket},
    {"limit the parent", limit_parent},
    {"outlive the parent", outlive_parent},
    {"change the user", change_user},
};

static void try_all(void)
{
    for (size_t i = 0; i < sizeof acts / sizeof acts[0]; i++) {
        const int error = acts[i].act();
        FILE *report = fopen(getenv("ESCAPE_REPORT"), "a");
        if (!report) {
            abort();
        }
        fprintf(report, "%s\t%s\t%d\n", thread_name, acts[i].name, error);
        fclose(report);
    }
}

static void *wait_and_try(void *data)
{
    sem_wait(&go);
    thread_name = "loaded";
    try_all();
    return data;
}

EGLAPI EGLBoolean EGLAPIENTRY eglInitialize(EGLDisplay display, EGLint *major, EGLint *minor)
{
    static EGLBoolean (*real)(EGLDisplay display, EGLint * major, EGLint * minor);

    if (!real) {
        real = (typeof(real))dlsym(RTLD_NEXT, "eglInitialize");
        sem_init(&go, 0, 0);
        pthread_create(&loaded, NULL, wait_and_try, NULL);
    }
    return real(display, major, minor);
}

/* A tile is drawn. */
static GLsync APIENTRY fence(GLenum condition, GLbitfield flags)
{
    static bool tried;

    if (!tried && getenv("ESCAPE_REPORT")) {
        tried = true;
        thread_name = "drawing";
        try_all();
        sem_post(&go);
        pthread_join(loaded, NULL);
    }
    return real_fence(condition, flags);
}

EGLAPI __eglMustCastToProperFunctionPointerType EGLAPIENTRY eglGetProcAddress(const char *name)
{
    static __eglMustCastToProperFunctionPointerType (*real)(const char *name);

    if (!real) {
        real = (typeof(real))dlsym(RTLD_NEXT, "eglGetProcAddress");
    }
    if (strcmp(name, "glFenceSync") != 0) {
        return real(name);
    }
    real_fence = (PFNGLFENCESYNCPROC)real(name);
    return (__eglMustCastToProperFunctionPointerType)fence;
}

/* libc's, for a kernel that has less. */
long syscall(long number, ...)
{
    static long (*real)(long number, ...);
    const char *without = getenv("ESCAPE_WITHOUT");
    long arguments[6];
    va_list list;

    if (!real) {
        real = (typeof(real))dlsym(RTLD_NEXT, "syscall");
    }
    va_start(list, number);
    for (int i = 0; i < 6; i++) {
        arguments[i] = va_arg(list, long);
    }
    va_end(list);
    if (without && ((number == SYS_landlock_create_ruleset && strcmp(without, "landlock") == 0) ||
                    (number == SYS_seccomp && strcmp(without, "seccomp") == 0))) {
        errno = ENOSYS;
        return -1;
    }
    return real(number, arguments[0], arguments[1], arguments[2], arguments[3], arguments[4],
                arguments[5]);
}
