/* SPDX-License-Identifier: MIT */
/* The commands of the program: `fieldcast NAME`. Each is one function in command_NAME.c. */
#ifndef SERVER_COMMAND_H
#define SERVER_COMMAND_H

#include <stdbool.h>
#include <stddef.h>

#include "options.h"

enum command_id {
    COMMAND_SERVE,
    COMMAND_RENDER,
    COMMAND_CHECK,
    COMMAND_SHADER,
    COMMAND_IMPORT,
    COMMAND_IMPLICITIZE,
    COMMAND_GROEBNER,
    COMMAND_SCHEMA,
    COMMAND_DOCTOR,
    COMMAND_BENCH,
    COMMAND_WORKER,
    COMMAND_COUNT
};

/* Results of commands, which are the exit status of the program. */
enum { EXIT_OK = 0, EXIT_FAILED = 1, EXIT_USAGE = 2 };

struct command {
    const char *name;
    const char *operands; /* as help shows them; NULL: it takes none */
    bool many;            /* more than one operand is allowed */
    int exactly;          /* so many operands, whose names `operands` has; 0: as above */
    bool hidden;          /* for the program itself; help does not show it */
    bool draws;           /* in its own process: huge_pages.h */
    const char *doc;      /* one line */
    const char *more;     /* the rest of --help, may be NULL */
    int (*run)(const struct options *options);
};

const struct command *command_at(enum command_id id);
const struct command *command_find(const char *name); /* NULL: none */
enum command_id command_id(const struct command *command);
/* `argc` and `argv` of main(): finds the command, reads its options, runs it. */
int command_main(int argc, char **argv);

int command_serve(const struct options *options);
int command_render(const struct options *options);
int command_check(const struct options *options);
int command_shader(const struct options *options);
int command_import(const struct options *options);
int command_implicitize(const struct options *options);
int command_groebner(const struct options *options);
int command_schema(const struct options *options);
int command_doctor(const struct options *options);
int command_bench(const struct options *options);
int command_worker(const struct options *options);

#endif
