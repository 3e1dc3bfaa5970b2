/* SPDX-License-Identifier: MIT */
#include "compiles.h"

#include <stdlib.h>
#include <string.h>

#include "hub.h"
#include "room_state.h"
#include "server_message.h"
#include "session.h"

static size_t class_of(size_t nodes)
{
    size_t class = 0;

    while (nodes > 1 && class + 1 < COMPILES_CLASSES) {
        nodes /= 2;
        class ++;
    }
    return class;
}

void compiles_record(struct compiles *compiles, size_t nodes, int64_t ms)
{
    const size_t class = class_of(nodes);

    compiles->classes[class].ms[compiles->classes[class].count++ % COMPILES_KEPT] = ms;
}

static int compare(const void *a, const void *b)
{
    const int64_t first = *(const int64_t *)a, second = *(const int64_t *)b;

    return (first > second) - (first < second);
}

int64_t compiles_expected(const struct compiles *compiles, size_t nodes)
{
    const size_t class = class_of(nodes), ever = compiles->classes[class].count;
    const size_t count = ever < COMPILES_KEPT ? ever : COMPILES_KEPT;
    int64_t sorted[COMPILES_KEPT];

    if (count == 0) {
        return -1;
    }
    memcpy(sorted, compiles->classes[class].ms, sizeof sorted);
    qsort(sorted, count, sizeof *sorted, compare);
    return sorted[count / 2];
}

static struct shared_buffer *message(const struct room *room, bool over, int64_t now_ms)
{
    const int64_t expected = compiles_expected(room->hub->compiles, room->scene->node_count);
    cJSON *json = message_begin("compiling");

    cJSON_AddNumberToObject(json, "revision", (double)room->revision);
    cJSON_AddBoolToObject(json, "over", over);
    cJSON_AddNumberToObject(json, "elapsed_ms", (double)(now_ms - room->compiling_since));
    if (expected >= 0) {
        cJSON_AddNumberToObject(json, "expected_ms", (double)expected);
    }
    return message_print(json);
}

static void tell_all(const struct room *room, bool over, int64_t now_ms)
{
    struct shared_buffer *text = message(room, over, now_ms);

    for (struct session *session = room->sessions; session; session = session->next) {
        session_send(session, text);
    }
    shared_buffer_unref(text);
}

/* The worker has been told of a state of which it has not said yet whether it can be drawn. */
static bool is_waited_for(const struct room *room)
{
    return room->sent > room->settled;
}

static void end(struct room *room, int64_t now_ms)
{
    if (room->compiling_told) {
        tell_all(room, true, now_ms);
        if (room->shown >= room->sent && room->sent > 0) {
            compiles_record(room->hub->compiles, room->scene->node_count,
                            now_ms - room->compiling_since);
        }
    }
    room->compiling_told = false;
    room->compiling_since = 0;
}

int64_t compiles_watch(struct room *room, int64_t now_ms)
{
    if (!is_waited_for(room)) {
        end(room, now_ms);
        return 0;
    }
    if (room->compiling_since == 0) {
        room->compiling_since = now_ms;
    }
    if (!room->compiling_told && now_ms >= room->compiling_since + COMPILES_TOLD_MS) {
        room->compiling_told = true;
        tell_all(room, false, now_ms);
    }
    return room->compiling_told ? 0 : room->compiling_since + COMPILES_TOLD_MS;
}

void compiles_tell(struct session *session, const struct room *room, int64_t now_ms)
{
    if (room->compiling_told) {
        session_say(session, message(room, false, now_ms));
    }
}
