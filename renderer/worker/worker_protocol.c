/* SPDX-License-Identifier: MIT */
/* The tables of packets, and how their members become JSON and come back. Both ends are one
 * program: a member that is missing is zero, an enum is its number. */
#include "worker_protocol.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "protocol/memory.h"
#include "protocol/messages.h"

enum member_type {
    MEMBER_NONE,
    MEMBER_TEXT,
    MEMBER_INT, /* and enums */
    MEMBER_U32,
    MEMBER_U64,  /* counts, which a double holds */
    MEMBER_HASH, /* 64 bits, which none holds */
    MEMBER_DOUBLE,
    MEMBER_BOOL,
    MEMBER_JSON,
    MEMBER_ERROR,
    MEMBER_TIMES,
    MEMBER_REQUEST,
};

struct member {
    const char *name;
    enum member_type type;
    size_t offset;
};

struct packet_row {
    bool payload;
    const struct member *members;
};

#define M(TYPE, path)                                                                              \
    {                                                                                              \
#path, MEMBER_##TYPE, offsetof(struct packet, path)                                        \
    }
#define MEMBERS(...)                                                                               \
    (const struct member[])                                                                        \
    {                                                                                              \
        __VA_ARGS__,                                                                               \
        {                                                                                          \
            .name = NULL                                                                           \
        }                                                                                          \
    }
#define STATE M(TEXT, state.scene), M(U64, state.revision)
#define SUSPECT M(TEXT, suspect.scene), M(U64, suspect.revision)

static const struct packet_row to_worker[TO_WORKER_COUNT] = {
    [TO_WORKER_ASSET] = {true, MEMBERS(M(TEXT, asset.asset))},
    [TO_WORKER_SCENE] = {true, MEMBERS(M(TEXT, scene.scene), M(U64, scene.revision),
                                       M(BOOL, scene.portrait))},
    [TO_WORKER_EDIT] = {false,
                        MEMBERS(M(TEXT, edit.scene), M(U64, edit.revision), M(JSON, edit.ops))},
    [TO_WORKER_DROP] = {false, MEMBERS(M(TEXT, state.scene))},
    [TO_WORKER_JUDGE] = {false, MEMBERS(M(HASH, judge.structure_hash), M(TEXT, judge.asset),
                                        M(INT, judge.refused), M(INT, judge.measured_ms),
                                        M(INT, judge.limit_ms), M(INT, judge.times))},
    [TO_WORKER_PACE] = {false, MEMBERS(M(DOUBLE, pace.pace))},
    [TO_WORKER_RENDER] = {false, MEMBERS(M(U32, render.job), M(TEXT, render.scene),
                                         M(TEXT, render.account), M(INT, render.priority),
                                         M(INT, render.patience), M(BOOL, render.careful),
                                         M(REQUEST, render.request))},
    [TO_WORKER_CANCEL] = {false, MEMBERS(M(U32, job.job))},
    [TO_WORKER_STOP] = {false, MEMBERS({.name = NULL})},
    [TO_WORKER_PING] = {false, MEMBERS(M(U64, ping.ping))},
};

static const struct packet_row to_front[TO_FRONT_COUNT] = {
    [TO_FRONT_READY] = {false,
                        MEMBERS(M(TEXT, ready.name), M(TEXT, ready.version), M(TEXT, ready.device),
                                M(BOOL, ready.software), M(U32, ready.stage), M(BOOL, ready.files),
                                M(BOOL, ready.calls), M(TEXT, ready.why))},
    [TO_FRONT_SHOWN] = {false, MEMBERS(STATE)},
    [TO_FRONT_BROKEN] = {false,
                         MEMBERS(STATE, M(ERROR, state.error), M(HASH, state.structure_hash))},
    [TO_FRONT_WARNED] = {false, MEMBERS(STATE, M(INT, state.warning), M(ERROR, state.error))},
    [TO_FRONT_COMPILING] = {false, MEMBERS(SUSPECT, M(HASH, suspect.structure_hash))},
    [TO_FRONT_READING] = {false, MEMBERS(SUSPECT, M(TEXT, suspect.asset))},
    [TO_FRONT_OPENING] = {false, MEMBERS(SUSPECT)},
    [TO_FRONT_DRAWING] = {false, MEMBERS(SUSPECT, M(U32, suspect.job))},
    [TO_FRONT_SLOW] = {false, MEMBERS(SUSPECT, M(HASH, suspect.structure_hash),
                                      M(TEXT, suspect.asset), M(BOOL, suspect.still),
                                      M(INT, suspect.measured_ms), M(INT, suspect.limit_ms))},
    [TO_FRONT_FRAME] = {true,
                        MEMBERS(M(U32, frame.job), M(U64, frame.revision), M(BOOL, frame.newest),
                                M(BOOL, frame.more), M(INT, frame.rounds.done),
                                M(INT, frame.rounds.count), M(INT, frame.width),
                                M(INT, frame.height), M(INT, frame.codec), M(BOOL, frame.key),
                                M(U32, frame.whole_bytes), M(DOUBLE, frame.drawn_part),
                                M(TIMES, frame.times))},
    [TO_FRONT_PROGRESS] = {false, MEMBERS(M(U32, job.job))},
    [TO_FRONT_FAILED] = {false, MEMBERS(M(U32, failed.job), M(BOOL, failed.begun),
                                        M(ERROR, failed.error))},
    [TO_FRONT_PONG] = {false,
                       MEMBERS(M(U64, pong.ping), M(U64, pong.steps), M(BOOL, pong.idle),
                               M(U64, pong.counters.compilations), M(U64, pong.counters.cache_hits),
                               M(U64, pong.counters.tiles), M(U64, pong.counters.pictures),
                               M(U64, pong.resident_bytes), M(DOUBLE, pong.pace))},
};

/* NULL: there is none. */
static const struct packet_row *row_of(enum packet_way way, int kind)
{
    const int count = way == PACKET_TO_WORKER ? TO_WORKER_COUNT : TO_FRONT_COUNT;

    return kind < 0 || kind >= count ? NULL
                                     : &(way == PACKET_TO_WORKER ? to_worker : to_front)[kind];
}

bool packet_has_payload(enum packet_way way, int kind)
{
    const struct packet_row *row = row_of(way, kind);

    return row && row->payload;
}

/* --- to JSON --- */

static cJSON *print_error(const struct error *err)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddNumberToObject(json, "kind", err->kind);
    cJSON_AddStringToObject(json, "place", err->place);
    cJSON_AddStringToObject(json, "message", err->message);
    cJSON_AddNumberToObject(json, "line", err->line);
    cJSON_AddNumberToObject(json, "column", err->column);
    cJSON_AddNumberToObject(json, "measured", err->measured_ms);
    cJSON_AddNumberToObject(json, "limit", err->limit_ms);
    return json;
}

static cJSON *print_hash(uint64_t hash)
{
    char text[17];

    snprintf(text, sizeof text, "%016" PRIx64, hash);
    return cJSON_CreateString(text);
}

static cJSON *print_times(const struct job_times *times)
{
    cJSON *list = cJSON_CreateArray();

    for (int i = 0; i < FRAME_STAGES; i++) {
        cJSON_AddItemToArray(list, cJSON_CreateNumber(times->us[i]));
    }
    return list;
}

static void print_member(cJSON *json, const struct member *member, const void *at)
{
    const char *name = member->name;

    switch (member->type) {
    case MEMBER_TEXT:
        cJSON_AddStringToObject(json, name,
                                *(const char *const *)at ? *(const char *const *)at : "");
        break;
    case MEMBER_INT:
        cJSON_AddNumberToObject(json, name, *(const int *)at);
        break;
    case MEMBER_U32:
        cJSON_AddNumberToObject(json, name, *(const uint32_t *)at);
        break;
    case MEMBER_U64:
        cJSON_AddNumberToObject(json, name, (double)*(const uint64_t *)at);
        break;
    case MEMBER_HASH:
        cJSON_AddItemToObject(json, name, print_hash(*(const uint64_t *)at));
        break;
    case MEMBER_DOUBLE:
        cJSON_AddNumberToObject(json, name, *(const double *)at);
        break;
    case MEMBER_BOOL:
        cJSON_AddBoolToObject(json, name, *(const bool *)at);
        break;
    case MEMBER_JSON:
        cJSON_AddItemReferenceToObject(json, name, *(cJSON *const *)at);
        break;
    case MEMBER_ERROR:
        cJSON_AddItemToObject(json, name, print_error(at));
        break;
    case MEMBER_TIMES:
        cJSON_AddItemToObject(json, name, print_times(at));
        break;
    case MEMBER_REQUEST:
        cJSON_AddItemToObject(json, name,
                              render_request_print(*(const struct render_request *const *)at));
        break;
    case MEMBER_NONE:
        break;
    }
}

cJSON *packet_print(enum packet_way way, const struct packet *packet)
{
    cJSON *json = cJSON_CreateObject();

    for (const struct member *m = row_of(way, packet->kind)->members; m->name; m++) {
        print_member(json, m, (const char *)packet + m->offset);
    }
    return json;
}

/* --- and back --- */

static void read_error(const cJSON *json, struct error *out)
{
    error_set_at(out, (enum error_kind)json_member_number(json, "kind", ERROR_INTERNAL),
                 json_member_text(json, "place", ""), (int)json_member_number(json, "line", 0),
                 (int)json_member_number(json, "column", 0), "%s",
                 json_member_text(json, "message", ""));
    out->measured_ms = (int)json_member_number(json, "measured", 0);
    out->limit_ms = (int)json_member_number(json, "limit", 0);
}

static void read_times(const cJSON *list, struct job_times *out)
{
    const cJSON *number;
    int stage = 0;

    cJSON_ArrayForEach(number, list)
    {
        if (stage < FRAME_STAGES) {
            out->us[stage++] = (uint32_t)number->valuedouble;
        }
    }
}

static const struct render_request *read_request(struct packet *packet, const cJSON *json)
{
    packet->request = memory_alloc(1, sizeof *packet->request);
    render_request_init(packet->request);
    render_request_unpack(packet->request, json, &packet->malformed);
    return packet->request;
}

static void read_member(struct packet *packet, const struct member *member, void *at)
{
    cJSON *json = cJSON_GetObjectItemCaseSensitive(packet->json, member->name);
    const double number = cJSON_IsNumber(json) ? json->valuedouble : 0;

    switch (member->type) {
    case MEMBER_TEXT:
        *(const char **)at = cJSON_IsString(json) ? json->valuestring : "";
        break;
    case MEMBER_INT:
        *(int *)at = (int)number;
        break;
    case MEMBER_U32:
        *(uint32_t *)at = (uint32_t)number;
        break;
    case MEMBER_U64:
        *(uint64_t *)at = (uint64_t)number;
        break;
    case MEMBER_HASH:
        *(uint64_t *)at = cJSON_IsString(json) ? strtoull(json->valuestring, NULL, 16) : 0;
        break;
    case MEMBER_DOUBLE:
        *(double *)at = number;
        break;
    case MEMBER_BOOL:
        *(bool *)at = cJSON_IsTrue(json);
        break;
    case MEMBER_JSON:
        *(cJSON **)at = json;
        break;
    case MEMBER_ERROR:
        read_error(json, at);
        break;
    case MEMBER_TIMES:
        read_times(json, at);
        break;
    case MEMBER_REQUEST:
        *(const struct render_request **)at = read_request(packet, json);
        break;
    case MEMBER_NONE:
        break;
    }
}

bool packet_unpack(enum packet_way way, struct packet *packet)
{
    const struct packet_row *row = row_of(way, packet->kind);

    for (const struct member *m = row ? row->members : NULL; m && m->name; m++) {
        read_member(packet, m, (char *)packet + m->offset);
    }
    return row != NULL;
}
