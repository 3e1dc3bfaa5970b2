/* SPDX-License-Identifier: MIT */
/* fieldcast serve: options become serve_params. The daemon itself is in serve.c. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "files.h"
#include "huge_pages.h"
#include "protocol/memory.h"
#include "server/serve.h"

enum { TOKEN_MIN = 16, TOKEN_MAX = 200, TOKEN_FILE_MAX = 4096 };

/* The parts between commas, ended by NULL; they point into `*out_text`. Caller frees both. */
static const char **split(const char *list, char **out_text)
{
    size_t count = 1;

    for (const char *c = list; *c; c++) {
        count += *c == ',';
    }
    const char **parts = memory_alloc(count + 1, sizeof *parts);
    char *text = memory_text(list);
    size_t used = 0;
    for (char *part = strtok(text, ", "); part; part = strtok(NULL, ", ")) {
        parts[used++] = part;
    }
    *out_text = text;
    return parts;
}

/* The token travels in a header and in a WebSocket subprotocol, hence the plain characters. */
static char *read_token(const char *path, struct error *err)
{
    size_t length;
    char *text = file_read(path, TOKEN_FILE_MAX, &length, err);

    if (!text) {
        return NULL;
    }
    text[strcspn(text, "\r\n")] = '\0';
    const size_t bytes = strlen(text);
    if (bytes >= TOKEN_MIN && bytes <= TOKEN_MAX &&
        strspn(text, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_.~") ==
            bytes) {
        return text;
    }
    error_set(err, ERROR_INVALID, path,
              "the first line must be a token of %d to %d letters, digits, - _ . ~", TOKEN_MIN,
              TOKEN_MAX);
    free(text);
    return NULL;
}

static int run(const struct options *options, struct serve_params *params)
{
    char *origins_text = NULL, *hosts_text = NULL;
    const char **origins = NULL, **hosts = NULL;
    const char *list = option_text(options, OPTION_ALLOW_ORIGIN);

    if (list) {
        params->allowed_origins = origins = split(list, &origins_text);
    }
    list = option_text(options, OPTION_ALLOW_HOST);
    if (list) {
        params->allowed_hosts = hosts = split(list, &hosts_text);
    }
    const char *const worker_args[] = {"--device-index",
                                       option_text(options, OPTION_DEVICE_INDEX),
                                       "--cache",
                                       option_text(options, OPTION_CACHE),
                                       "--worker-memory",
                                       option_text(options, OPTION_WORKER_MEMORY),
                                       "--stage",
                                       option_text(options, OPTION_STAGE),
                                       "--programs",
                                       option_text(options, OPTION_PROGRAMS),
                                       "--confine",
                                       option_text(options, OPTION_CONFINE),
                                       "--code-time",
                                       option_text(options, OPTION_CODE_TIME),
                                       "--tile-time",
                                       option_text(options, OPTION_TILE_TIME),
                                       NULL};
    params->worker_args = worker_args;
    const int status = serve(params);
    free(origins);
    free(origins_text);
    free(hosts);
    free(hosts_text);
    return status;
}

int command_serve(const struct options *options)
{
    struct error err = {0};
    char *token = NULL;
    const char *token_file = option_text(options, OPTION_TOKEN_FILE);
    const char *data = option_text(options, OPTION_DATA);

    if ((token_file && !(token = read_token(token_file, &err))) || !directory_make(data, &err)) {
        fputs("fieldcast: ", stderr);
        error_print(&err, stderr);
        free(token);
        return EXIT_USAGE;
    }
    struct serve_params params = {
        .bind = option_text(options, OPTION_HOST),
        .port = option_int(options, OPTION_PORT),
        .data_dir = data,
        .web_dir = option_text(options, OPTION_WEB),
        .device = (enum device_kind)option_int(options, OPTION_DEVICE),
        .token = token,
        .worker_silence_ms = option_int(options, OPTION_WORKER_SILENCE),
        .worker_busy_ms = option_int(options, OPTION_WORKER_BUSY),
        .code_refused = switch_find(option_text(options, OPTION_CODE)) == 0,
        .log_level = option_text(options, OPTION_LOG_LEVEL),
    };
    huge_pages_ask(); /* for its workers */
    const int status = run(options, &params);
    free(token);
    return status;
}
