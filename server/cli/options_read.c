/* SPDX-License-Identifier: MIT */
/* Collects the values of options: defaults, then config file, environment, command line, so that
 * the later ones win. */
#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "options.h"
#include "protocol/suggest.h"

static bool applies(const struct option_row *row, const struct command *command)
{
    return row->commands >> command_id(command) & 1U;
}

/* The row called `name`, of `length` bytes, or by a single letter; OPTION_COUNT: none. */
static enum option find_option(const struct command *command, const char *name, size_t length)
{
    for (int i = 0; i < OPTION_COUNT; i++) {
        const struct option_row *row = option_row((enum option)i);
        if (!applies(row, command)) {
            continue;
        }
        if ((strlen(row->name) == length && strncmp(row->name, name, length) == 0) ||
            (row->letter && length == 1 && row->letter == *name)) {
            return (enum option)i;
        }
    }
    return OPTION_COUNT;
}

/* Says that `name` is no option, and which one may have been meant. */
static bool unknown(const struct command *command, const char *place, const char *name,
                    const char *of, struct error *err)
{
    struct suggestion suggestion = {.text = name};
    char hint[64];

    for (int i = 0; i < OPTION_COUNT; i++) {
        const struct option_row *row = option_row((enum option)i);
        if (command ? applies(row, command) : row->stored) {
            suggest_consider(&suggestion, row->name);
        }
    }
    return error_set(err, ERROR_INVALID, place, "is no option of %s%s", of,
                     suggest_hint(&suggestion, hint, sizeof hint));
}

/* --- config file --- */

static char *trimmed(char *text)
{
    while (isspace((unsigned char)*text)) {
        text++;
    }
    char *end = text + strlen(text);
    while (end > text && isspace((unsigned char)end[-1])) {
        end--;
    }
    *end = '\0';
    return text;
}

/* One line: empty, a # comment, or `name = value`. Options of other commands are checked too, so
 * that one file serves all. */
static bool read_line(struct options *options, char *line, const char *place, struct error *err)
{
    char *name = trimmed(line);

    if (*name == '\0' || *name == '#') {
        return true;
    }
    char *equals = strchr(name, '=');
    if (!equals) {
        return error_set(err, ERROR_SYNTAX, place, "expected `name = value`");
    }
    *equals = '\0';
    name = trimmed(name);
    char *value = trimmed(equals + 1);
    char full[192];
    snprintf(full, sizeof full, "%s: %s", place, name);
    for (int i = 0; i < OPTION_COUNT; i++) {
        const struct option_row *row = option_row((enum option)i);
        if (row->stored && strcmp(row->name, name) == 0) {
            return option_set(options, (enum option)i, value, SOURCE_FILE, full, err);
        }
    }
    return unknown(NULL, full, name, "the config file", err);
}

static bool read_file(struct options *options, struct error *err)
{
    const struct option_value *config = &options->values[OPTION_CONFIG];

    if (!config->text) {
        return true;
    }
    FILE *file = fopen(config->text, "r");
    if (!file && errno == ENOENT && config->source == SOURCE_DEFAULT) {
        return true;
    }
    if (!file) {
        return error_set(err, ERROR_INVALID, config->text, "%s", strerror(errno));
    }
    char *line = NULL;
    size_t size = 0;
    bool ok = true;
    for (int number = 1; ok && getline(&line, &size, file) >= 0; number++) {
        char place[160];
        snprintf(place, sizeof place, "%s:%d", config->text, number);
        ok = read_line(options, line, place, err);
    }
    free(line);
    fclose(file);
    return ok;
}

/* --- environment --- */

static bool read_environment(struct options *options, struct error *err)
{
    for (int i = 0; i < OPTION_COUNT; i++) {
        const struct option_row *row = option_row((enum option)i);
        char variable[64];
        option_variable(row, variable, sizeof variable);
        const char *text = getenv(variable);
        if (row->stored && text && applies(row, options->command) &&
            !option_set(options, (enum option)i, text, SOURCE_ENVIRONMENT, variable, err)) {
            return false;
        }
    }
    return true;
}

/* --- command line --- */

/* Reads the option at argv[0]; returns how many arguments it took, 0 on failure. */
static int read_option(struct options *options, int argc, char **argv, struct error *err)
{
    const char *argument = argv[0];
    const char *name = argument + (argument[1] == '-' ? 2 : 1);
    const char *equals = strchr(name, '=');
    const size_t length = equals ? (size_t)(equals - name) : strlen(name);
    char place[64];

    snprintf(place, sizeof place, "%.*s", (int)(name - argument + (ptrdiff_t)length), argument);

    enum option option = OPTION_COUNT;
    if ((argument[1] == '-') == (length > 1)) {
        option = find_option(options->command, name, length);
    }
    if (option == OPTION_COUNT) {
        char where[64];
        snprintf(where, sizeof where, "fieldcast %s", options->command->name);
        unknown(options->command, place, place + (name - argument), where, err);
        return 0;
    }
    const struct option_row *row = option_row(option);
    const char *value = equals                     ? equals + 1
                        : row->type == OPTION_FLAG ? "yes"
                        : argc > 1                 ? argv[1]
                                                   : NULL;
    if (!value) {
        error_set(err, ERROR_INVALID, place, "needs a value: %s", row->value);
        return 0;
    }
    if (!option_set(options, option, value, SOURCE_ARGUMENT, place, err)) {
        return 0;
    }
    return equals || row->type == OPTION_FLAG ? 1 : 2;
}

static bool read_arguments(struct options *options, int argc, char **argv, struct error *err)
{
    options->operands = argv;
    bool only_operands = false;
    for (int i = 0; i < argc;) {
        const bool option = argv[i][0] == '-' && argv[i][1] != '\0' && !only_operands;
        if (!option) {
            argv[options->operand_count++] = argv[i++];
            continue;
        }
        if (strcmp(argv[i], "--") == 0) {
            only_operands = true;
            i++;
            continue;
        }
        const int taken = read_option(options, argc - i, argv + i, err);
        if (taken == 0) {
            return false;
        }
        i += taken;
    }
    return true;
}

static bool check_operands(const struct options *options, struct error *err)
{
    const struct command *command = options->command;
    const int count = options->operand_count;

    if (command->operands && (count == 0 || count < command->exactly)) {
        return error_set(err, ERROR_INVALID, command->name, "needs %s", command->operands);
    }
    const int most = !command->operands ? 0
                     : command->many    ? count
                     : command->exactly ? command->exactly
                                        : 1;
    if (count > most) {
        return error_set(err, ERROR_INVALID, command->name, "does not take '%s'",
                         options->operands[most]);
    }
    return true;
}

static bool set_defaults(struct options *options, struct error *err)
{
    for (int i = 0; i < OPTION_COUNT; i++) {
        const struct option_row *row = option_row((enum option)i);
        char *text = applies(row, options->command) ? option_default(row) : NULL;
        bool ok =
            !text || option_set(options, (enum option)i, text, SOURCE_DEFAULT, row->name, err);
        free(text);
        if (!ok) {
            return false;
        }
    }
    return true;
}

/* FIELDCAST_CONFIG names the file; it cannot stand in the file itself. */
static bool find_config(struct options *options, struct error *err)
{
    const char *path = getenv("FIELDCAST_CONFIG");

    if (!path || options->values[OPTION_CONFIG].source != SOURCE_DEFAULT) {
        return true;
    }
    return option_set(options, OPTION_CONFIG, path, SOURCE_ENVIRONMENT, "FIELDCAST_CONFIG", err);
}

/* The command line is read first, because it names the config file; then the weaker sources fill a
 * second set, over which the arguments are laid. */
bool options_read(struct options *options, const struct command *command, int argc, char **argv,
                  struct error *err)
{
    struct options given = {.command = command};

    *options = (struct options){.command = command};
    bool ok = read_arguments(&given, argc, argv, err);
    if (ok && option_flag(&given, OPTION_HELP)) {
        *options = given;
        return true;
    }
    ok = ok && set_defaults(options, err);
    if (ok && given.values[OPTION_CONFIG].text) {
        ok = option_set(options, OPTION_CONFIG, given.values[OPTION_CONFIG].text, SOURCE_ARGUMENT,
                        "--config", err);
    }
    ok = ok && find_config(options, err) && read_file(options, err) &&
         read_environment(options, err);
    for (int i = 0; ok && i < OPTION_COUNT; i++) {
        if (given.values[i].source == SOURCE_NONE) {
            continue;
        }
        free(options->values[i].text);
        options->values[i] = given.values[i];
        given.values[i].text = NULL;
    }
    options->operands = given.operands;
    options->operand_count = given.operand_count;
    options_finish(&given);
    return ok && check_operands(options, err);
}

void options_finish(struct options *options)
{
    for (int i = 0; i < OPTION_COUNT; i++) {
        free(options->values[i].text);
        options->values[i].text = NULL;
    }
}
