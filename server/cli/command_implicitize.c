/* SPDX-License-Identifier: MIT */
/* fieldcast implicitize: the program fieldcast-algebra, which lies beside this one, with a bound
 * of time and memory. */
#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "command.h"
#include "protocol/limits.h"

static void bound(int resource, rlim_t value)
{
    const struct rlimit limit = {value, value};
    setrlimit(resource, &limit);
}

static void start(char *const operands[])
{
    char path[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", path, sizeof path - sizeof "-algebra");
    if (length > 0) {
        strcpy(path + length, "-algebra");
        char *const argv[] = {path, operands[0], operands[1], operands[2], NULL};
        bound(RLIMIT_CPU, LIMIT_ALGEBRA_SECONDS);
        bound(RLIMIT_CORE, 0);
#ifndef __SANITIZE_ADDRESS__ /* it reserves terabytes of addresses */
        bound(RLIMIT_AS, LIMIT_ALGEBRA_BYTES);
#endif
        execv(path, argv);
    }
    fprintf(stderr, "fieldcast: fieldcast-algebra beside this program: %s\n", strerror(errno));
    _exit(EXIT_FAILED);
}

int command_implicitize(const struct options *options)
{
    int status = 0;
    if (options->operand_count != 3) {
        fputs("fieldcast: implicitize takes three expressions: X Y Z\n", stderr);
        return EXIT_USAGE;
    }
    const pid_t child = fork();
    if (child == 0) {
        start((char *const *)options->operands);
    }
    if (child < 0 || waitpid(child, &status, 0) != child) {
        fprintf(stderr, "fieldcast: fieldcast-algebra: %s\n", strerror(errno));
        return EXIT_FAILED;
    }
    if (WIFEXITED(status)) {
        return WEXITSTATUS(status);
    }
    if (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL) {
        fprintf(stderr, "fieldcast: more than %d s of processor time (algebra_seconds)\n",
                LIMIT_ALGEBRA_SECONDS);
    } else {
        fprintf(stderr, "fieldcast: more than %d MiB of memory (algebra_bytes)\n",
                LIMIT_ALGEBRA_BYTES >> 20);
    }
    return EXIT_FAILED;
}
