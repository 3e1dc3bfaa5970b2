/* SPDX-License-Identifier: MIT */
/* The table of options in words: --help and the README's table. */
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "options.h"

enum { LINE = 92, INDENT = 30 };

/* Prints words from column `column` on, broken before LINE and indented to `indent`. */
static void print_wrapped(FILE *out, const char *text, int column, int indent)
{
    const char *gap = "";

    while (*text) {
        const int word = (int)strcspn(text, " ");
        if (*gap && column + 1 + word > LINE) {
            fprintf(out, "\n%*s", indent, "");
            column = indent;
            gap = "";
        }
        fprintf(out, "%s%.*s", gap, word, text);
        column += word + (*gap != '\0');
        gap = " ";
        text += word;
        text += strspn(text, " ");
    }
    fputc('\n', out);
}

/* The place where the default is, in the words of the documentation, not of this machine. */
static void default_words(const struct option_row *row, char *out, size_t size)
{
    static const char *const bases[] = {[BASE_NONE] = "",
                                        [BASE_DATA] = "~/.local/share/",
                                        [BASE_CONFIG] = "~/.config/",
                                        [BASE_CACHE] = "~/.cache/"};

    snprintf(out, size, "%s%s", row->fallback ? bases[row->base] : "",
             row->fallback ? row->fallback : "");
}

static void choice_words(const struct option_row *row, char *out, size_t size)
{
    out[0] = '\0';
    for (size_t i = 0; row->choice && row->choice(i); i++) {
        const size_t used = strlen(out);
        snprintf(out + used, size - used, "%s%s", i ? ", " : "", row->choice(i));
    }
}

static void print_option(FILE *out, const struct option_row *row)
{
    char head[64], text[512], words[128];
    int column = snprintf(head, sizeof head, "  %s%c%s--%s%s%s", row->letter ? "-" : "",
                          row->letter ? row->letter : ' ', row->letter ? ", " : "   ", row->name,
                          row->value ? " " : "", row->value ? row->value : "");

    fputs(head, out);
    fprintf(out, "%*s", column < INDENT ? INDENT - column : 2, "");
    column = column < INDENT ? INDENT : column + 2;

    int used = snprintf(text, sizeof text, "%s", row->doc);
    choice_words(row, words, sizeof words);
    if (*words) {
        used += snprintf(text + used, sizeof text - (size_t)used, " %s of %s.",
                         row->type == OPTION_CHOICES ? "Any" : "One", words);
    }
    if (row->type == OPTION_INT) {
        used +=
            snprintf(text + used, sizeof text - (size_t)used, " %.0f to %.0f.", row->min, row->max);
    }
    default_words(row, words, sizeof words);
    if (*words) {
        snprintf(text + used, sizeof text - (size_t)used, " [%s]", words);
    }
    print_wrapped(out, text, column, INDENT);
}

void options_help(const struct command *command, FILE *out)
{
    fprintf(out, "Usage: fieldcast %s [OPTION]...%s%s%s\n\n", command->name,
            command->operands ? " " : "", command->operands ? command->operands : "",
            command->many ? "..." : "");
    print_wrapped(out, command->doc, 0, 0);
    if (command->more) {
        fputc('\n', out);
        print_wrapped(out, command->more, 0, 0);
    }
    fputs("\nOptions:\n", out);
    bool stored = false;
    for (int i = 0; i < OPTION_COUNT; i++) {
        const struct option_row *row = option_row((enum option)i);
        if (!(row->commands >> command_id(command) & 1U)) {
            continue;
        }
        print_option(out, row);
        stored = stored || row->stored;
    }
    if (stored) {
        fputs("\nMost options can also be set in the environment (FIELDCAST_PORT for --port) and "
              "in the\n"
              "config file (`port = 8080`); `fieldcast help options` lists which.\n",
              out);
    }
}

static void print_commands(FILE *out, const struct option_row *row)
{
    bool first = true;

    for (int i = 0; i < COMMAND_COUNT; i++) {
        const struct command *command = command_at((enum command_id)i);
        if (command->hidden || !(row->commands >> i & 1U)) {
            continue;
        }
        fprintf(out, "%s%s", first ? "" : " ", command->name);
        first = false;
    }
}

void options_table(FILE *out)
{
    fputs("| option | default | of | variable | |\n|---|---|---|---|---|\n", out);
    for (int i = 0; i < OPTION_COUNT; i++) {
        const struct option_row *row = option_row((enum option)i);
        char variable[64] = "", words[128];
        if (i == OPTION_HELP) {
            continue;
        }
        if (row->stored || i == OPTION_CONFIG) {
            option_variable(row, variable, sizeof variable);
        }
        default_words(row, words, sizeof words);
        fprintf(out, "| `--%s%s%s` | %s%s%s | ", row->name, row->value ? " " : "",
                row->value ? row->value : "", *words ? "`" : "", words, *words ? "`" : "");
        print_commands(out, row);
        choice_words(row, words, sizeof words);
        const char *of = row->type == OPTION_CHOICES ? " Any of " : " One of ";
        fprintf(out, " | %s%s%s | %s%s%s%s |\n", *variable ? "`" : "", variable,
                *variable ? "`" : "", row->doc, *words ? of : "", words, *words ? "." : "");
    }
}
