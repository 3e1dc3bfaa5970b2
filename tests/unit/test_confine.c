/* SPDX-License-Identifier: MIT */
/* What a confined process can still do, and what it cannot: each call in a process of its own. */
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <semaphore.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "renderer/worker/confine.h"

enum { NOT_CONFINED = 250, NEXT_CALL = 451 };

static char folder[] = "/tmp/fieldcast-confine-XXXXXX";

static const char *in_folder(const char *name)
{
    static char path[4][256];
    static unsigned turn;
    char *out = path[turn++ % 4];

    snprintf(out, sizeof path[0], "%s/%s", folder, name);
    return out;
}

/* What `act` returns in a process that is confined first; at most 249. */
static int confined(int (*act)(int data), int data)
{
    int status;
    const pid_t child = fork();

    if (child == 0) {
        struct confinement in_force = {0};
        confine_privileges();
        confine_files(&in_force, in_folder("cache"));
        confine_calls(&in_force);
        _exit(in_force.files && in_force.calls ? act(data) : NOT_CONFINED);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* --- refused --- */

static int call_nonsense(int number)
{
    return syscall(number, -1, -1, -1, -1, -1, -1) == -1 ? errno : 0;
}

static const int refused[] = {
    SYS_socket,
    SYS_connect,
    SYS_bind,
    SYS_listen,
    SYS_accept,
    SYS_accept4,
    SYS_io_uring_setup,
    SYS_io_uring_enter,
    SYS_execve,
    SYS_execveat,
    SYS_unshare,
    SYS_setns,
    SYS_kill,
    SYS_tkill,
    SYS_tgkill,
    SYS_rt_sigqueueinfo,
    SYS_pidfd_open,
    SYS_pidfd_getfd,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_kcmp,
    SYS_setpriority,
    SYS_truncate,
    SYS_fchmod,
    SYS_fchmodat,
    SYS_fchown,
    SYS_fchownat,
    SYS_setxattr,
    SYS_fsetxattr,
    SYS_open_by_handle_at,
    SYS_mount,
    SYS_umount2,
    SYS_pivot_root,
    SYS_chroot,
    SYS_move_mount,
    SYS_open_tree,
    SYS_fsopen,
    SYS_mount_setattr,
    SYS_setuid,
    SYS_setgid,
    SYS_setreuid,
    SYS_setresuid,
    SYS_setgroups,
    SYS_capset,
    SYS_bpf,
    SYS_perf_event_open,
    SYS_userfaultfd,
    SYS_add_key,
    SYS_request_key,
    SYS_keyctl,
    SYS_kexec_load,
    SYS_init_module,
    SYS_finit_module,
    SYS_delete_module,
    SYS_reboot,
    SYS_swapon,
    SYS_acct,
    SYS_syslog,
    SYS_sethostname,
    SYS_settimeofday,
    SYS_clock_settime,
    SYS_personality,
    SYS_prlimit64,
#ifdef SYS_chmod
    SYS_chmod,
    SYS_chown,
    SYS_fork,
    SYS_vfork,
#endif
};

static void calls_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        if (confined(call_nonsense, refused[i]) != EPERM) {
            fail_msg("call %d: %d", refused[i], confined(call_nonsense, refused[i]));
        }
    }
    /* What libc goes without, as on an older kernel. */
    assert_int_equal(confined(call_nonsense, SYS_clone3), ENOSYS);
    assert_int_equal(confined(call_nonsense, SYS_openat2), ENOSYS);
    assert_int_equal(confined(call_nonsense, NEXT_CALL), ENOSYS);
}

static int call_with(int which)
{
    switch (which) {
    case 0:
        return syscall(SYS_clone, CLONE_NEWUSER | SIGCHLD, 0, 0, 0, 0) == -1 ? errno : 0;
    case 1:
        return ioctl(STDERR_FILENO, TIOCSTI, "x") == -1 ? errno : 0;
    case 2:
        return fcntl(STDERR_FILENO, F_SETOWN, getppid()) == -1 ? errno : 0;
    case 3:
#if defined(__SANITIZE_ADDRESS__) /* the process that looks for leaks dies with this one */
        return EPERM;
#else
        return prctl(PR_SET_PDEATHSIG, 0) == -1 ? errno : 0;
#endif
    case 4:
        return open(in_folder("cache/old"), O_RDONLY | O_TRUNC) == -1 ? errno : 0;
    case 5:
        return kill(0, 0) == -1 ? errno : 0;
    default:
        return 0;
    }
}

static void arguments_refused(void **state)
{
    (void)state;
    for (int i = 0; i < 6; i++) {
        if (confined(call_with, i) != EPERM) {
            fail_msg("case %d: %d", i, confined(call_with, i));
        }
    }
}

static int touch_file(int which)
{
    static const struct {
        const char *path;
        int flags;
    } files[] = {
        {"outside", O_RDONLY},         {"outside", O_WRONLY},          {"new", O_WRONLY | O_CREAT},
        {".", O_RDONLY | O_DIRECTORY}, {"cache/../outside", O_WRONLY}, {"cache/link", O_WRONLY},
    };

    return open(in_folder(files[which].path), files[which].flags, 0600) < 0 ? errno : 0;
}

static int move_file(int which)
{
    int result = 0;

    switch (which) {
    case 0:
        result = rename(in_folder("cache/old"), in_folder("moved"));
        break;
    case 1:
        result = rename(in_folder("outside"), in_folder("cache/moved"));
        break;
    case 2:
        result = link(in_folder("outside"), in_folder("cache/second"));
        break;
    case 3:
        result = symlink("/", in_folder("cache/root"));
        break;
    case 4:
        result = mkfifo(in_folder("cache/pipe"), 0600);
        break;
    default:
        result = unlink(in_folder("outside"));
    }
    return result != 0 ? errno : 0;
}

static void files_refused(void **state)
{
    (void)state;
    for (int i = 0; i < 6; i++) {
        const int opened = confined(touch_file, i), moved = confined(move_file, i);
        if (opened != EACCES || (moved != EACCES && moved != EXDEV)) {
            fail_msg("case %d: %d, %d", i, opened, moved);
        }
    }
}

static sem_t go;

static void *call_later(void *out)
{
    sem_wait(&go);
    *(int *)out = socket(AF_UNIX, SOCK_STREAM, 0) < 0 ? errno : 0;
    return out;
}

/* A driver's threads are there before its calls are refused. */
static void threads_before(void **state)
{
    int status;
    const pid_t child = fork();

    (void)state;
    if (child == 0) {
        struct confinement in_force = {0};
        pthread_t thread;
        int error = 0;
        sem_init(&go, 0, 0);
        pthread_create(&thread, NULL, call_later, &error);
        confine_calls(&in_force);
        sem_post(&go);
        pthread_join(thread, NULL);
        _exit(in_force.calls ? error : NOT_CONFINED);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(WEXITSTATUS(status), EPERM);
}

/* --- what a driver needs --- */

static void *nothing(void *data)
{
    return data;
}

static int use_cache(void)
{
    struct stat status;
    const int fd =
        mkdir(in_folder("cache/ab"), 0700) == 0 && mkdir(in_folder("cache/cd"), 0700) == 0
            ? open(in_folder("cache/ab/new.tmp"), O_RDWR | O_CREAT | O_EXCL, 0600)
            : -1;

    return fd >= 0 && write(fd, "text", 4) == 4 && ftruncate(fd, 2) == 0 && close(fd) == 0 &&
           rename(in_folder("cache/ab/new.tmp"), in_folder("cache/ab/new")) == 0 &&
           rename(in_folder("cache/ab/new"), in_folder("cache/cd/new")) == 0 &&
           stat(in_folder("cache/cd/new"), &status) == 0 && status.st_size == 2 &&
           unlink(in_folder("cache/cd/new")) == 0 && rmdir(in_folder("cache/ab")) == 0 &&
           rmdir(in_folder("cache/cd")) == 0;
}

static int use_machine(int data)
{
    int pair[2];
    pthread_t thread;
    struct rlimit limit;

    if (!use_cache()) {
        return 1;
    }
    if (pthread_create(&thread, NULL, nothing, NULL) != 0 || pthread_join(thread, NULL) != 0) {
        return 2;
    }
    if (mmap(NULL, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) ==
            MAP_FAILED ||
        memfd_create("pixels", 0) < 0) {
        return 3;
    }
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, pair) != 0 || send(pair[0], "x", 1, 0) != 1 ||
        eventfd(0, 0) < 0) {
        return 4;
    }
    if (open("/usr/lib", O_RDONLY | O_DIRECTORY) < 0 || open("/proc/self/maps", O_RDONLY) < 0 ||
        open("/dev/null", O_RDWR) < 0 || open("/etc/ld.so.cache", O_RDONLY) < 0) {
        return 5;
    }
    if (kill(getpid(), 0) != 0 || raise(SIGCONT) != 0 || getrlimit(RLIMIT_AS, &limit) != 0 ||
        setrlimit(RLIMIT_AS, &limit) != 0) {
        return 6;
    }
    return data;
}

static void work_goes_on(void **state)
{
    (void)state;
    assert_int_equal(confined(use_machine, 0), 0);
}

static int make_files(void **state)
{
    (void)state;
    assert_non_null(mkdtemp(folder));
    assert_int_equal(mkdir(in_folder("cache"), 0700), 0);
    close(open(in_folder("outside"), O_WRONLY | O_CREAT, 0600));
    close(open(in_folder("cache/old"), O_WRONLY | O_CREAT, 0600));
    return symlink(in_folder("outside"), in_folder("cache/link"));
}

static int remove_files(void **state)
{
    static const char *const names[] = {"cache/link", "cache/old", "cache", "outside", ""};

    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        assert_int_equal(remove(in_folder(names[i])), 0);
    }
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(calls_refused), cmocka_unit_test(arguments_refused),
        cmocka_unit_test(files_refused), cmocka_unit_test(threads_before),
        cmocka_unit_test(work_goes_on),
    };

    return cmocka_run_group_tests(tests, make_files, remove_files);
}
