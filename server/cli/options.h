/* SPDX-License-Identifier: MIT */
/* The options. One table describes the command line, the environment, the config file, --help and
 * the table in the README. The commands interpret the values.
 * The first of these sources that names an option gives its value:
 *   --name VALUE or --name=VALUE     on the command line
 *
 *   FIELDCAST_NAME                   in the environment     } only for rows that are `stored`
 *
 *   name = VALUE                     in the config file     }
 * the table's default */
#ifndef SERVER_OPTIONS_H
#define SERVER_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "protocol/error.h"

enum option {
    OPTION_HOST,
    OPTION_PORT,
    OPTION_DATA,
    OPTION_TOKEN_FILE,
    OPTION_ALLOW_ORIGIN,
    OPTION_ALLOW_HOST,
    OPTION_WEB,
    OPTION_CODE,
    OPTION_LOG_LEVEL,
    OPTION_CODE_TIME,
    OPTION_TILE_TIME,
    OPTION_WORKER_SILENCE,
    OPTION_WORKER_BUSY,
    OPTION_WORKER_MEMORY,
    OPTION_CONFINE,
    OPTION_STAGE,
    OPTION_PROGRAMS,
    OPTION_DEVICE,
    OPTION_DEVICE_INDEX,
    OPTION_CACHE,
    OPTION_OUTPUT,
    OPTION_SCENE,
    OPTION_WIDTH,
    OPTION_HEIGHT,
    OPTION_AOV,
    OPTION_FORMAT,
    OPTION_ASSET,
    OPTION_LEVEL,
    OPTION_SAMPLES,
    OPTION_TRANSPARENT,
    OPTION_REGION,
    OPTION_QUALITY,
    OPTION_CAMERA_TYPE, /* --camera-NAME for each member of a camera */
    OPTION_CAMERA_POSITION,
    OPTION_CAMERA_TARGET,
    OPTION_CAMERA_UP,
    OPTION_CAMERA_FOV,
    OPTION_CAMERA_HEIGHT,
    OPTION_CAMERA_APERTURE,
    OPTION_CAMERA_FOCUS,
    OPTION_SECTION_NORMAL, /* --section-NAME for each member of a section */
    OPTION_SECTION_OFFSET,
    OPTION_METHOD,
    OPTION_RANGE_S, /* in the order of surface_names */
    OPTION_RANGE_T,
    OPTION_RANGE_U,
    OPTION_RANGE_V,
    OPTION_SIZE,
    OPTION_LETTERS, /* named as the members of ideal_type, up to OPTION_DIVIDE */
    OPTION_ORDER,
    OPTION_WEIGHTS,
    OPTION_ELIMINATE,
    OPTION_PRIME,
    OPTION_STRATEGY,
    OPTION_CRITERIA,
    OPTION_DIVIDE,
    OPTION_STEPS,
    OPTION_ROUNDS,
    OPTION_SCALE_DOWN,
    OPTION_ONLY,
    OPTION_PART,
    OPTION_REFERENCE,
    OPTION_PASS,
    OPTION_WEBGL,
    OPTION_PAGE,
    OPTION_CONFIG,
    OPTION_HELP,
    OPTION_COUNT
};

enum option_type {
    OPTION_FLAG, /* true when named; elsewhere `yes` or `no` */
    OPTION_INT,
    OPTION_NUMBER,
    OPTION_PAIR,   /* low,high */
    OPTION_VECTOR, /* x,y,z */
    OPTION_PIXELS, /* x,y,width,height: whole numbers */
    OPTION_TEXT,
    OPTION_LIST,  /* texts with commas between them */
    OPTION_FILES, /* may be repeated: paths with line ends between them */
    OPTION_PATH,  /* a leading ~/ is the home directory */
    OPTION_CHOICE,
    OPTION_CHOICES, /* several of them, with commas between them */
};

/* Where a relative default path starts: the XDG base directories. */
enum option_base { BASE_NONE, BASE_DATA, BASE_CONFIG, BASE_CACHE };

struct option_row {
    const char *name;  /* long form without dashes; also the key of the config file */
    char letter;       /* short form, or 0 */
    const char *value; /* what help calls the value; NULL for flags */
    enum option_type type;
    enum option_base base; /* OPTION_PATH: what the default is relative to */
    const char *fallback;  /* the default as text; NULL: not set */
    double min, max;       /* of numbers, and of every part of a vector or of pixels */
    const char *(*choice)(size_t index); /* the words of choices; NULL past the last */
    unsigned commands;                   /* bits 1 << enum command_id */
    bool stored;                         /* also read from environment and config file */
    const char *doc;
};

const struct option_row *option_row(enum option option);
/* The option with this name; OPTION_COUNT: none. */
enum option option_find(const char *name);
/* "FIELDCAST_TOKEN_FILE" for "token-file". */
void option_variable(const struct option_row *row, char *out, size_t size);
/* The default with its base directory resolved. Caller frees; NULL: there is none. */
char *option_default(const struct option_row *row);

enum option_source {
    SOURCE_NONE,
    SOURCE_DEFAULT,
    SOURCE_FILE,
    SOURCE_ENVIRONMENT,
    SOURCE_ARGUMENT
};

struct option_value {
    enum option_source source; /* SOURCE_NONE: no value and no default */
    char *text;                /* owned; NULL where not set */
    double number[4];          /* flags 0 or 1; a choice its index, several 1 << each */
};

struct command;

struct options {
    const struct command *command;
    struct option_value values[OPTION_COUNT];
    char **operands; /* into argv */
    int operand_count;
};

/* Reads the arguments after the command's name, the environment and the config file. `--help` ends
 * the reading: then only OPTION_HELP is set. Call options_finish also after a failure. */
bool options_read(struct options *options, const struct command *command, int argc, char **argv,
                  struct error *err);
void options_finish(struct options *options);

/* Checks `text` as the value of `option` and keeps a copy. `place` names its origin in errors. */
bool option_set(struct options *options, enum option option, const char *text,
                enum option_source source, const char *place, struct error *err);

const char *option_text(const struct options *options, enum option option); /* NULL: not set */
double option_number(const struct options *options, enum option option);
/* Also a choice's index, or the bits of several. */
int option_int(const struct options *options, enum option option);
bool option_flag(const struct options *options, enum option option);
const double *option_vector(const struct options *options, enum option option); /* NULL: not set */

/* --- words for the user --- */

void options_help(const struct command *command, FILE *out);
/* The README's table of all options, in Markdown. */
void options_table(FILE *out);

#endif
