/* SPDX-License-Identifier: MIT */
/* The table of commands, and the way from the arguments of the program to one of them. */
#include "command.h"

#include <string.h>
#include <sys/prctl.h>

#include "huge_pages.h"
#include "protocol/suggest.h"

/* clang-format off */
static const struct command table[COMMAND_COUNT] = {
    [COMMAND_SERVE] = {"serve", .run = command_serve,
        .doc = "Serve the editor, the live connections and the REST interface on one port.",
        .more = "Prints the address when ready. SIGTERM and SIGINT drain: clients are told, edits "
                "are stored, then the program ends."},
    [COMMAND_RENDER] = {"render", .operands = "SCENE.json", .draws = true, .run = command_render,
        .doc = "Draw a scene into a file: the same pixels as the server's.",
        .more = "SCENE.json may be `-` for stdin, or `example:NAME` for a scene that is built in."},
    [COMMAND_CHECK] = {"check", .operands = "SCENE.json", .many = true, .run = command_check,
        .doc = "Check documents: code, the limits of drawing, equations of surfaces.",
        .more = "Prints `file: place: what is wrong` for each that breaks a rule or cannot be "
                "drawn, and fails if one does. Each equation with a parametric surface beside it "
                "is proved: `verified`, `does not fit` (a failure too), or on stderr `not checked` "
                "(a warning). Needs no GPU."},
    [COMMAND_SHADER] = {"shader", .operands = "SCENE.json", .run = command_shader,
        .doc = "Print the GLSL that a scene is drawn with.",
        .more = "All of one pass as a GPU gets it, with every file that it includes; numbers of "
                "the scene stand in a buffer, N(i). Or the whole picture as a shader of its own, "
                "for other programs. Needs no GPU."},
    [COMMAND_IMPORT] = {"import", .operands = "DIR", .run = command_import,
        .doc = "Make a scene document of a folder in the JSON format of Schneider's thesis.",
        .more = "Reads all *.json files in and below DIR: primitives, shaders, materials, models, "
                "scenes. What was put right while reading is told as `file:line:column: what`."},
    [COMMAND_IMPLICITIZE] = {"implicitize", .operands = "X Y Z", .exactly = 3,
        .run = command_implicitize,
        .doc = "Find the equation of a parametric surface.",
        .more = "X, Y and Z are expressions in two of the letters s, t, u, v: polynomials, "
                "fractions, and sin, cos, exp of a letter that stands in these alone. Prints the "
                "equation in x, y, z with its certificate as JSON, or why there is none. Write -- "
                "before an expression that begins with a minus sign."},
    [COMMAND_GROEBNER] = {"groebner", .operands = "POLYNOMIAL", .many = true,
        .run = command_groebner,
        .doc = "Make the reduced Groebner basis of an ideal.",
        .more = "Prints the basis, the elimination ideal and what became of the pairs as JSON. "
                "`a = b` is the polynomial a - b. Write -- before one that begins with a minus "
                "sign."},
    [COMMAND_SCHEMA] = {"schema", .run = command_schema,
        .doc = "Print the JSON Schema of scene documents, with the registry of nodes in it."},
    [COMMAND_DOCTOR] = {"doctor", .run = command_doctor,
        .doc = "Say what this machine draws with and why, and what is missing."},
    [COMMAND_BENCH] = {"bench", .draws = true, .run = command_bench,
        .doc = "Measure drawing, compiling, encoding and storing; prints JSON."},
    [COMMAND_WORKER] = {"worker", .hidden = true, .draws = true, .run = command_worker,
        .doc = "The render process of `serve`, which alone starts it."},
};
/* clang-format on */

const struct command *command_at(enum command_id id)
{
    return &table[id];
}

enum command_id command_id(const struct command *command)
{
    return (enum command_id)(command - table);
}

const struct command *command_find(const char *name)
{
    for (int i = 0; i < COMMAND_COUNT; i++) {
        if (strcmp(table[i].name, name) == 0) {
            return &table[i];
        }
    }
    return NULL;
}

static void print_help(FILE *out)
{
    fputs("Usage: fieldcast COMMAND [OPTION]...\n\n"
          "A render server for scenes made of signed distance fields.\n\nCommands:\n",
          out);
    for (int i = 0; i < COMMAND_COUNT; i++) {
        if (!table[i].hidden) {
            fprintf(out, "  %-13s%s\n", table[i].name, table[i].doc);
        }
    }
    fputs("\n`fieldcast COMMAND --help` says more; `fieldcast help options` lists all options;\n"
          "`fieldcast --version` names the version.\n",
          out);
}

static int unknown(const char *name)
{
    struct suggestion suggestion = {.text = name};
    char hint[64];

    for (int i = 0; i < COMMAND_COUNT; i++) {
        if (!table[i].hidden) {
            suggest_consider(&suggestion, table[i].name);
        }
    }
    fprintf(stderr, "fieldcast: %s: is no command%s\n", name,
            suggest_hint(&suggestion, hint, sizeof hint));
    fputs("`fieldcast --help` lists the commands.\n", stderr);
    return EXIT_USAGE;
}

/* fieldcast help [COMMAND|options] */
static int help(const char *topic)
{
    const struct command *command = topic ? command_find(topic) : NULL;

    if (topic && strcmp(topic, "options") == 0) {
        options_table(stdout);
    } else if (command) {
        options_help(command, stdout);
    } else if (topic) {
        return unknown(topic);
    } else {
        print_help(stdout);
    }
    return EXIT_OK;
}

/* A command that could not print all has failed, whatever it says itself. */
static int printed(int status)
{
    if (fflush(stdout) == 0 && !ferror(stdout)) {
        return status;
    }
    fputs("fieldcast: stdout: not all could be written\n", stderr);
    return status == EXIT_OK ? EXIT_FAILED : status;
}

static int run(const struct command *command, int argc, char **argv)
{
    struct options options;
    struct error err = {0};
    int status = EXIT_USAGE;

    if (!options_read(&options, command, argc, argv, &err)) {
        fprintf(stderr, "fieldcast: ");
        error_print(&err, stderr);
        fprintf(stderr, "`fieldcast %s --help` lists what it takes.\n", command->name);
    } else if (option_flag(&options, OPTION_HELP)) {
        options_help(command, stdout);
        status = EXIT_OK;
    } else {
        status = command->run(&options);
    }
    options_finish(&options);
    /* Who starts a daemon may leave before it ends. */
    return command_id(command) == COMMAND_SERVE ? status : printed(status);
}

static bool is(const char *word, const char *a, const char *b)
{
    return strcmp(word, a) == 0 || strcmp(word, b) == 0;
}

int command_main(int argc, char **argv)
{
    if (argc < 2) {
        print_help(stderr);
        return EXIT_USAGE;
    }
    const char *name = argv[1];
    if (is(name, "--version", "version")) {
        puts("fieldcast " FIELDCAST_VERSION);
        return printed(EXIT_OK);
    }
    if (is(name, "--help", "help") || strcmp(name, "-h") == 0) {
        return printed(help(argc > 2 ? argv[2] : NULL));
    }
    const struct command *command = command_find(name);
    if (command) {
        prctl(PR_SET_NAME, "fieldcast"); /* of one that was started as /proc/self/exe it is `exe` */
        if (command->draws) {
            huge_pages_use(argv);
        }
        return run(command, argc - 2, argv + 2);
    }
    return unknown(name);
}
