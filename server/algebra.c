/* SPDX-License-Identifier: MIT */
#include "algebra.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "protocol/ideal.h"
#include "protocol/json.h"
#include "protocol/limits.h"
#include "protocol/memory.h"
#include "tasks.h"

enum { NICE = 10 };

struct algebra {
    struct tasks *tasks;
    pthread_mutex_t lock;
    pid_t child;       /* 0: none */
    const void *owner; /* of the child */
    bool stopped;
};

struct question {
    char **argv;                                /* the first is left free for the path */
    void (*tell)(void *data, const char *line); /* NULL: the answer is all that is printed */
    void *data;
};

/* --- the process --- */

static void bound(int resource, rlim_t value)
{
    const struct rlimit limit = {value, value};

    setrlimit(resource, &limit);
}

/* In the child, after fork: calls that are safe there alone. */
static void become(char *const argv[], int output)
{
    sigset_t none;

    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    dup2(output, STDOUT_FILENO);
    setpriority(PRIO_PROCESS, 0, NICE);
    bound(RLIMIT_CPU, LIMIT_ALGEBRA_SECONDS);
    bound(RLIMIT_CORE, 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) /* they reserve terabytes */
    bound(RLIMIT_AS, LIMIT_ALGEBRA_BYTES);
#endif
    execv(argv[0], argv);
    _exit(127);
}

/* The end of a pipe that its output comes from; -1: it did not start. */
static int start(struct algebra *algebra, const struct question *question)
{
    int ends[2];

    if (pipe2(ends, O_CLOEXEC) != 0) {
        return -1;
    }
    pthread_mutex_lock(&algebra->lock);
    const pid_t child = algebra->stopped ? -1 : fork();
    if (child == 0) {
        become(question->argv, ends[1]);
    }
    algebra->child = child > 0 ? child : 0;
    algebra->owner = question->data;
    pthread_mutex_unlock(&algebra->lock);
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        return -1;
    }
    return ends[0];
}

/* The last line, which is the answer; the lines in front of it are told. NULL: nothing came. */
static char *read_answer(int file, const struct question *question)
{
    char *line = NULL, *last = NULL;
    size_t room = 0;
    FILE *in = fdopen(file, "r");

    while (getline(&line, &room, in) > 0) {
        if (last && question->tell) {
            question->tell(question->data, last);
        }
        free(last);
        last = line;
        line = NULL;
        room = 0;
    }
    free(line);
    fclose(in);
    return last;
}

/* Its status. The number of the process stays its own until nobody can end it by that any more. */
static int wait_for(struct algebra *algebra)
{
    int status = 0;
    siginfo_t info;

    while (waitid(P_PID, (id_t)algebra->child, &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
    }
    pthread_mutex_lock(&algebra->lock);
    waitpid(algebra->child, &status, 0);
    algebra->child = 0;
    algebra->owner = NULL;
    pthread_mutex_unlock(&algebra->lock);
    return status;
}

/* --- answers --- */

static bool explain(int status, struct error *err)
{
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;

    if (signal == SIGXCPU || signal == SIGKILL) {
        return error_set(err, ERROR_TOO_SLOW, "",
                         "this took over %d s of processor time (algebra_seconds), or was "
                         "ended",
                         LIMIT_ALGEBRA_SECONDS);
    }
    if (signal) {
        return error_set(err, ERROR_LIMIT, "", "this took over %d MiB of memory (algebra_bytes)",
                         LIMIT_ALGEBRA_BYTES >> 20);
    }
    return error_set(err, ERROR_UNAVAILABLE, "",
                     "the program fieldcast-algebra did not start, or did not answer");
}

static double number_of(const cJSON *json, const char *name)
{
    const cJSON *member = cJSON_GetObjectItemCaseSensitive(json, name);

    return cJSON_IsNumber(member) ? member->valuedouble : 0;
}

static const char *text_of(const cJSON *json, const char *name)
{
    const cJSON *member = cJSON_GetObjectItemCaseSensitive(json, name);

    return cJSON_IsString(member) ? member->valuestring : "";
}

/* False where it tells an error. */
static bool check_answer(const cJSON *answer, struct error *err)
{
    const cJSON *told = cJSON_GetObjectItemCaseSensitive(answer, "error");

    if (!told) {
        return true;
    }
    return error_set_at(err, (enum error_kind)number_of(told, "kind"), text_of(told, "place"),
                        (int)number_of(told, "line"), (int)number_of(told, "column"), "%s",
                        text_of(told, "message"));
}

static bool ask(struct algebra *algebra, const struct question *question, cJSON **out,
                struct error *err)
{
    char path[PATH_MAX];
    const ssize_t end = readlink("/proc/self/exe", path, sizeof path - sizeof "-algebra");

    if (end <= 0) {
        return error_set(err, ERROR_INTERNAL, "", "/proc/self/exe: %s", strerror(errno));
    }
    memcpy(path + end, "-algebra", sizeof "-algebra");
    question->argv[0] = path;
    const int output = start(algebra, question);
    if (output < 0) {
        return error_set(err, ERROR_UNAVAILABLE, "", "fieldcast-algebra cannot be started");
    }
    char *text = read_answer(output, question);
    const int status = wait_for(algebra);
    *out = text && WIFEXITED(status) && WEXITSTATUS(status) == 0 ? cJSON_Parse(text) : NULL;
    free(text);
    if (!*out) {
        return explain(status, err);
    }
    if (!check_answer(*out, err)) {
        cJSON_Delete(*out);
        *out = NULL;
    }
    return *out != NULL;
}

static char *print_params(const struct record *params)
{
    cJSON *json = cJSON_CreateObject();

    record_print(params, json);
    char *text = json_print(json, false);
    cJSON_Delete(json);
    return text;
}

static void read_proof(cJSON *answer, struct algebra_proof *out)
{
    const char *verdict = text_of(answer, "verdict");

    *out = (struct algebra_proof){.verdict = SURFACE_NOT_CHECKED,
                                  .coverage =
                                      cJSON_DetachItemFromObjectCaseSensitive(answer, "coverage")};
    for (int i = 0; i < SURFACE_NOT_CHECKED; i++) {
        if (strcmp(verdict, surface_verdicts[i]) == 0) {
            out->verdict = (enum surface_verdict)i;
        }
    }
    snprintf(out->reason, sizeof out->reason, "%s", text_of(answer, "reason"));
}

bool algebra_verify(struct algebra *algebra, const struct record *params, struct algebra_proof *out,
                    struct error *err)
{
    char *text = print_params(params);
    char *argv[] = {NULL, "verify", text, NULL};
    cJSON *answer;
    bool ok = ask(algebra, &(struct question){.argv = argv}, &answer, err);

    free(text);
    if (ok) {
        read_proof(answer, out);
        cJSON_Delete(answer);
    } else if (err->kind == ERROR_TOO_SLOW || err->kind == ERROR_LIMIT) {
        *out = (struct algebra_proof){.verdict = SURFACE_NOT_CHECKED};
        snprintf(out->reason, sizeof out->reason, "too large: %s", err->message);
        ok = true;
    }
    return ok;
}

bool algebra_ask(struct algebra *algebra, const struct record *asked,
                 void (*tell)(void *data, const char *line), void *data, cJSON **out,
                 struct error *err)
{
    char *text = print_params(asked);
    char *argv[] = {NULL, asked->type == &ideal_type ? "groebner" : "implicitize", text, NULL};
    const bool ok =
        ask(algebra, &(struct question){.argv = argv, .tell = tell, .data = data}, out, err);

    free(text);
    return ok;
}

void algebra_cancel(struct algebra *algebra, const void *data)
{
    pthread_mutex_lock(&algebra->lock);
    if (algebra->child && algebra->owner == data) {
        kill(algebra->child, SIGKILL);
    }
    pthread_mutex_unlock(&algebra->lock);
}

/* --- its life --- */

struct algebra *algebra_create(struct error *err)
{
    struct algebra *algebra = memory_alloc(1, sizeof *algebra);

    pthread_mutex_init(&algebra->lock, NULL);
    algebra->tasks = tasks_create(NULL, err);
    if (!algebra->tasks) {
        algebra_destroy(algebra);
        return NULL;
    }
    return algebra;
}

bool algebra_add(struct algebra *algebra, const char *account, void (*run)(void *, bool dropped),
                 void *data, struct error *err)
{
    return tasks_add(algebra->tasks,
                     &(struct task_order){.scene = "",
                                          .account = account,
                                          .heavy = true, /* one at a time */
                                          .bounded = true,
                                          .run = run,
                                          .data = data},
                     err);
}

void algebra_stop(struct algebra *algebra)
{
    pthread_mutex_lock(&algebra->lock);
    algebra->stopped = true;
    if (algebra->child) {
        kill(algebra->child, SIGKILL);
    }
    pthread_mutex_unlock(&algebra->lock);
    tasks_stop(algebra->tasks);
}

void algebra_destroy(struct algebra *algebra)
{
    if (!algebra) {
        return;
    }
    if (algebra->tasks) {
        tasks_destroy(algebra->tasks);
    }
    pthread_mutex_destroy(&algebra->lock);
    free(algebra);
}
