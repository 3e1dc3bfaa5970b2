/* SPDX-License-Identifier: MIT */
#include "server_message.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/json.h"

struct shared_buffer *message_print(cJSON *message)
{
    char *text = json_print(message, false);
    struct shared_buffer *buffer = shared_buffer_create(text, strlen(text));

    free(text);
    cJSON_Delete(message);
    return buffer;
}

cJSON *message_begin(const char *type)
{
    cJSON *message = cJSON_CreateObject();

    cJSON_AddStringToObject(message, "type", type);
    return message;
}

static struct shared_buffer *joined(char *text, size_t length)
{
    struct shared_buffer *buffer = shared_buffer_create(text, length);

    free(text);
    return buffer;
}

struct shared_buffer *message_document(uint64_t revision, const char *document, size_t bytes)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    fprintf(out, "{\"type\":\"document\",\"revision\":%" PRIu64 ",\"document\":", revision);
    fwrite(document, 1, bytes, out);
    fputc('}', out);
    fclose(out);
    return joined(text, length);
}

/* An author's id needs no escapes: letters, digits, - and _ only. */
struct shared_buffer *message_changed(uint64_t revision, const char *author, const char *ops,
                                      int64_t edit)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    fprintf(out, "{\"type\":\"changed\",\"revision\":%" PRIu64 ",\"author\":\"%s\",", revision,
            author);
    if (edit > 0) {
        fprintf(out, "\"edit\":%" PRId64 ",", edit);
    }
    fprintf(out, "\"ops\":%s}", ops);
    fclose(out);
    return joined(text, length);
}

static void add_skipped(cJSON *message, const cJSON *skipped)
{
    if (skipped) {
        cJSON_AddItemToObject(message, "skipped", cJSON_Duplicate(skipped, true));
    }
}

struct shared_buffer *message_applied(int64_t edit, uint64_t revision, bool durable, size_t undo,
                                      size_t redo, const cJSON *skipped)
{
    cJSON *message = message_begin("applied");

    cJSON_AddNumberToObject(message, "edit", (double)edit);
    cJSON_AddNumberToObject(message, "revision", (double)revision);
    cJSON_AddBoolToObject(message, "durable", durable);
    cJSON_AddNumberToObject(message, "undo", (double)undo);
    cJSON_AddNumberToObject(message, "redo", (double)redo);
    add_skipped(message, skipped);
    return message_print(message);
}

/* Line and column only where the error is in a text. */
static void add_error(cJSON *message, const struct error *err)
{
    cJSON_AddStringToObject(message, "place", err->place);
    cJSON_AddStringToObject(message, "message", err->message);
    if (err->line > 0) {
        cJSON_AddNumberToObject(message, "line", err->line);
        cJSON_AddNumberToObject(message, "column", err->column);
    }
    if (err->retry_ms > 0) {
        cJSON_AddNumberToObject(message, "retry_ms", err->retry_ms);
    }
    if (err->limit_ms > 0) {
        cJSON_AddNumberToObject(message, "measured", err->measured_ms);
        cJSON_AddNumberToObject(message, "limit", err->limit_ms);
    }
}

struct shared_buffer *message_rejected(int64_t edit, const struct error *err, const cJSON *skipped)
{
    cJSON *message = message_begin("rejected");

    cJSON_AddNumberToObject(message, "edit", (double)edit);
    cJSON_AddStringToObject(message, "code", error_kind_name(err->kind));
    add_error(message, err);
    add_skipped(message, skipped);
    return message_print(message);
}

static cJSON *fault(const char *level, const char *code, const struct error *err)
{
    cJSON *message = message_begin("notice");

    cJSON_AddStringToObject(message, "level", level);
    cJSON_AddStringToObject(message, "code", code);
    add_error(message, err);
    return message;
}

struct shared_buffer *message_fault(const char *level, const char *code, const struct error *err)
{
    return message_print(fault(level, code, err));
}

struct shared_buffer *message_left_out(const struct error *why)
{
    cJSON *message = fault("error", "scene_left_out", why);

    cJSON_AddStringToObject(message, "reason", error_kind_name(why->kind));
    return message_print(message);
}

struct shared_buffer *message_notice(const char *level, const char *code, const char *place,
                                     const char *text)
{
    struct error err = {0};

    error_set(&err, ERROR_NONE, place, "%s", text);
    return message_fault(level, code, &err);
}

struct shared_buffer *message_bye(const char *reason, int retry_ms)
{
    cJSON *message = message_begin("bye");

    cJSON_AddStringToObject(message, "reason", reason);
    if (retry_ms >= 0) {
        cJSON_AddNumberToObject(message, "retry_ms", retry_ms);
    }
    return message_print(message);
}
