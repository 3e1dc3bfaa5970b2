/* SPDX-License-Identifier: MIT */
/* Which calls of the kernel are refused: a seccomp filter, made from a table. The table names what
 * reaches beyond the process. What drivers need is not known well enough for the opposite. */
#include <asm/ioctls.h>
#include <asm/sockios.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/sched.h>
#include <linux/seccomp.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "confine.h"

#if defined(__x86_64__)
#define ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define ARCHITECTURE AUDIT_ARCH_AARCH64
#elif defined(__riscv) && __riscv_xlen == 64
#define ARCHITECTURE AUDIT_ARCH_RISCV64
#elif defined(__powerpc64__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
#define ARCHITECTURE AUDIT_ARCH_PPC64LE
#endif

#ifdef ARCHITECTURE

/* LeakSanitizer starts a process at the end, which traces this one. It has itself killed when this
 * one dies; else it would wait for locks of the dead one for ever. */
#if defined(__SANITIZE_ADDRESS__)
#define LOOKS_FOR_LEAKS 1
#else
#define LOOKS_FOR_LEAKS 0
#endif

enum {
    NEWEST = 450, /* set_mempolicy_home_node of Linux 5.17; what is newer is unknown here */
    NEW_NAMES = CLONE_NEWNS | CLONE_NEWCGROUP | CLONE_NEWUTS | CLONE_NEWIPC | CLONE_NEWUSER |
                CLONE_NEWPID | CLONE_NEWNET,
};

enum when { ALWAYS, IF_SAME, IF_OTHER, IF_ANY };

struct rule {
    int call;
    enum when when; /* by (argument & mask): is `value`, is not, has any bit */
    int argument;
    uint32_t mask, value;
    int error; /* 0: EPERM */
};

#define ALL 0xffffffffU
#define SELF 0xffffffffU /* as a value: the process' own number */

static const struct rule table[] = {
    /* sockets; socketpair reaches nobody */
    {SYS_socket, .when = ALWAYS},
    {SYS_connect, .when = ALWAYS},
    {SYS_bind, .when = ALWAYS},
    {SYS_listen, .when = ALWAYS},
    {SYS_accept, .when = ALWAYS},
    {SYS_accept4, .when = ALWAYS},
    {SYS_io_uring_setup, .when = ALWAYS}, /* would go round this filter */
    {SYS_io_uring_enter, .when = ALWAYS},
    {SYS_io_uring_register, .when = ALWAYS},
    /* programs and processes */
    {SYS_execve, .when = ALWAYS},
    {SYS_execveat, .when = ALWAYS},
#ifdef SYS_fork
    {SYS_fork, .when = ALWAYS},
    {SYS_vfork, .when = ALWAYS},
#endif
    {SYS_clone, IF_ANY, 0, NEW_NAMES, 0, 0},
#if !LOOKS_FOR_LEAKS
    {SYS_clone, IF_SAME, 0, CLONE_THREAD, 0, 0},
    {SYS_prctl, IF_SAME, 0, ALL, PR_SET_PDEATHSIG, 0}, /* it ends with the front */
    {SYS_ptrace, .when = ALWAYS},
#endif
    {SYS_clone3, .when = ALWAYS, .error = ENOSYS}, /* its flags are in memory; clone() follows */
    {SYS_unshare, .when = ALWAYS},
    {SYS_setns, .when = ALWAYS},
    /* other processes */
    {SYS_kill, IF_OTHER, 0, ALL, SELF, 0},
    {SYS_tkill, .when = ALWAYS},
    {SYS_tgkill, IF_OTHER, 0, ALL, SELF, 0},
    {SYS_rt_sigqueueinfo, IF_OTHER, 0, ALL, SELF, 0},
    {SYS_rt_tgsigqueueinfo, IF_OTHER, 0, ALL, SELF, 0},
    {SYS_pidfd_open, .when = ALWAYS},
    {SYS_pidfd_getfd, .when = ALWAYS},
    {SYS_pidfd_send_signal, .when = ALWAYS},
    {SYS_fcntl, IF_SAME, 1, ALL, F_SETOWN, 0}, /* signals of descriptors go to anybody */
    {SYS_fcntl, IF_SAME, 1, ALL, F_SETOWN_EX, 0},
    {SYS_fcntl, IF_SAME, 1, ALL, F_SETSIG, 0},
    {SYS_ioctl, IF_SAME, 1, ALL, FIOSETOWN, 0},
    {SYS_ioctl, IF_SAME, 1, ALL, SIOCSPGRP, 0},
    {SYS_ioctl, IF_SAME, 1, ALL, TIOCSTI, 0}, /* types into the terminal of stderr */
    {SYS_ioctl, IF_SAME, 1, ALL, TIOCLINUX, 0},
    {SYS_process_vm_readv, .when = ALWAYS},
    {SYS_process_vm_writev, .when = ALWAYS},
    {SYS_process_madvise, .when = ALWAYS},
    {SYS_kcmp, .when = ALWAYS},
    {SYS_move_pages, .when = ALWAYS},
    {SYS_migrate_pages, .when = ALWAYS},
    {SYS_prlimit64, IF_OTHER, 0, ALL, 0, 0},
    {SYS_setpriority, .when = ALWAYS},
    {SYS_sched_setattr, .when = ALWAYS},
    {SYS_ioprio_set, .when = ALWAYS},
    /* files, besides Landlock */
    {SYS_truncate, .when = ALWAYS}, /* unknown to its versions 1 and 2, as the next are */
#ifdef SYS_open
    {SYS_open, IF_SAME, 1, O_ACCMODE | O_TRUNC, O_RDONLY | O_TRUNC, 0},
#endif
    {SYS_openat, IF_SAME, 2, O_ACCMODE | O_TRUNC, O_RDONLY | O_TRUNC, 0},
    {SYS_openat2, .when = ALWAYS, .error = ENOSYS}, /* its flags are in memory */
#ifdef SYS_chmod
    {SYS_chmod, .when = ALWAYS},
    {SYS_chown, .when = ALWAYS},
    {SYS_lchown, .when = ALWAYS},
#endif
    {SYS_fchmod, .when = ALWAYS},
    {SYS_fchmodat, .when = ALWAYS},
    {SYS_fchown, .when = ALWAYS},
    {SYS_fchownat, .when = ALWAYS},
    {SYS_setxattr, .when = ALWAYS},
    {SYS_lsetxattr, .when = ALWAYS},
    {SYS_fsetxattr, .when = ALWAYS},
    {SYS_removexattr, .when = ALWAYS},
    {SYS_lremovexattr, .when = ALWAYS},
    {SYS_fremovexattr, .when = ALWAYS},
    {SYS_name_to_handle_at, .when = ALWAYS},
    {SYS_open_by_handle_at, .when = ALWAYS},
    {SYS_fanotify_init, .when = ALWAYS},
    {SYS_mount, .when = ALWAYS},
    {SYS_umount2, .when = ALWAYS},
    {SYS_pivot_root, .when = ALWAYS},
    {SYS_chroot, .when = ALWAYS},
    {SYS_move_mount, .when = ALWAYS},
    {SYS_open_tree, .when = ALWAYS},
    {SYS_fsopen, .when = ALWAYS},
    {SYS_fsconfig, .when = ALWAYS},
    {SYS_fsmount, .when = ALWAYS},
    {SYS_fspick, .when = ALWAYS},
    {SYS_mount_setattr, .when = ALWAYS},
    {SYS_quotactl, .when = ALWAYS},
    /* who this is */
    {SYS_setuid, .when = ALWAYS},
    {SYS_setgid, .when = ALWAYS},
    {SYS_setreuid, .when = ALWAYS},
    {SYS_setregid, .when = ALWAYS},
    {SYS_setresuid, .when = ALWAYS},
    {SYS_setresgid, .when = ALWAYS},
    {SYS_setgroups, .when = ALWAYS},
    {SYS_setfsuid, .when = ALWAYS},
    {SYS_setfsgid, .when = ALWAYS},
    {SYS_capset, .when = ALWAYS},
    {SYS_setsid, .when = ALWAYS},
    {SYS_setpgid, .when = ALWAYS},
    {SYS_personality, .when = ALWAYS},
    /* parts of the kernel that nothing here needs and where faults are often found */
    {SYS_bpf, .when = ALWAYS},
    {SYS_perf_event_open, .when = ALWAYS},
    {SYS_userfaultfd, .when = ALWAYS},
    {SYS_add_key, .when = ALWAYS},
    {SYS_request_key, .when = ALWAYS},
    {SYS_keyctl, .when = ALWAYS},
    {SYS_kexec_load, .when = ALWAYS},
    {SYS_kexec_file_load, .when = ALWAYS},
    {SYS_init_module, .when = ALWAYS},
    {SYS_finit_module, .when = ALWAYS},
    {SYS_delete_module, .when = ALWAYS},
    {SYS_reboot, .when = ALWAYS},
    {SYS_swapon, .when = ALWAYS},
    {SYS_swapoff, .when = ALWAYS},
    {SYS_acct, .when = ALWAYS},
    {SYS_syslog, .when = ALWAYS},
    {SYS_sethostname, .when = ALWAYS},
    {SYS_setdomainname, .when = ALWAYS},
    {SYS_settimeofday, .when = ALWAYS},
    {SYS_clock_settime, .when = ALWAYS},
    {SYS_clock_adjtime, .when = ALWAYS},
    {SYS_adjtimex, .when = ALWAYS},
#if defined(__x86_64__)
    {SYS_ioperm, .when = ALWAYS},
    {SYS_iopl, .when = ALWAYS},
    {SYS_modify_ldt, .when = ALWAYS},
#endif
};

enum { ROWS = sizeof table / sizeof table[0], HEAD = 6, MOST_OF_A_ROW = 6 };

#define AT(member) ((uint32_t)offsetof(struct seccomp_data, member))
#define FAIL(number) (SECCOMP_RET_ERRNO | ((uint32_t)(number)&SECCOMP_RET_DATA))

static const struct sock_filter load_call = BPF_STMT(BPF_LD | BPF_W | BPF_ABS, AT(nr));

/* The call's number is loaded before and afterwards. The low half of an argument, which is all that
 * the kernel looks at in these, comes first in memory on all of ARCHITECTURE. */
static size_t write_rule(const struct rule *rule, struct sock_filter *out)
{
    const uint32_t value = rule->value == SELF ? (uint32_t)getpid() : rule->value;
    const uint32_t fail = FAIL(rule->error ? rule->error : EPERM);
    const bool same = rule->when == IF_SAME;
    size_t count = 0;

    if (rule->when == ALWAYS) {
        out[count++] =
            (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (uint32_t)rule->call, 0, 1);
        out[count++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, fail);
        return count;
    }
    out[count++] =
        (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (uint32_t)rule->call, 0, 5);
    out[count++] = (struct sock_filter)BPF_STMT(
        BPF_LD | BPF_W | BPF_ABS, AT(args) + (uint32_t)rule->argument * sizeof(uint64_t));
    out[count++] = (struct sock_filter)BPF_STMT(BPF_ALU | BPF_AND | BPF_K, rule->mask);
    out[count++] = rule->when == IF_ANY
                       ? (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, 0, 1, 0)
                       : (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value,
                                                      same ? 0 : 1, same ? 1 : 0);
    out[count++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, fail);
    out[count++] = load_call;
    return count;
}

/* Another architecture numbers its calls differently; on x86 every process may use one. */
static size_t write_filter(struct sock_filter *out)
{
    size_t count = 0;

    out[count++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, AT(arch));
    out[count++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, ARCHITECTURE, 1, 0);
    out[count++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, FAIL(ENOSYS));
    out[count++] = load_call;
    out[count++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JGT | BPF_K, NEWEST, 0, 1);
    out[count++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, FAIL(ENOSYS));
    for (size_t i = 0; i < ROWS; i++) {
        count += write_rule(&table[i], out + count);
    }
    out[count++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    return count;
}

static void put_in_force(struct confinement *out)
{
    struct sock_filter filter[HEAD + ROWS * MOST_OF_A_ROW + 1];
    const struct sock_fprog program = {.len = (unsigned short)write_filter(filter),
                                       .filter = filter};

    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    const long result =
        syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &program);
    out->calls = result == 0;
    if (result != 0 && !*out->why) {
        snprintf(out->why, sizeof out->why, "system calls: %s",
                 result < 0 ? strerror(errno) : "a thread has a filter of its own");
    }
}

#endif

void confine_calls(struct confinement *out)
{
#ifdef ARCHITECTURE
    put_in_force(out);
#else
    if (!*out->why) {
        snprintf(out->why, sizeof out->why, "system calls: unknown on this processor");
    }
#endif
}
