/* SPDX-License-Identifier: MIT */
#include "thumbnails.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hub.h"
#include "image_cache.h"
#include "protocol/code_text.h"
#include "protocol/id_set.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "render_queue.h"
#include "room_state.h"
#include "server/clock.h"
#include "server/digest.h"
#include "session.h"
#include "stream.h"

enum {
    SLICE_US = 4000, /* of a pump */
    PAUSE_TIMES = 3, /* what a pump took, before the next one looks */
    WAITING = 32,    /* of a session, to be sent: more might leave the cache before */
};

/* All thumbnails share the drawing time of one client. So tiles of other pictures are short while
 * they are drawn, and a thumbnail waits for milliseconds instead of a whole tile. */
#define ACCOUNT "thumbnails"

struct thumbnails {
    struct hub *hub; /* while something is drawn */
    struct image_cache cache;
    uint64_t turns;
    uint32_t job; /* the order at the worker; 0: none */
    char key[THUMBNAIL_KEY_BYTES];
    struct session *session; /* that it is drawn for first */
    int64_t rests_until_us;
};

struct thumbnails *thumbnails_create(void)
{
    struct thumbnails *thumbnails = memory_alloc(1, sizeof *thumbnails);

    thumbnails->cache.limit = LIMIT_THUMBNAIL_CACHE_BYTES;
    return thumbnails;
}

void thumbnails_destroy(struct thumbnails *thumbnails)
{
    if (thumbnails) {
        image_cache_finish(&thumbnails->cache);
        free(thumbnails);
    }
}

static void cancel(struct hub *hub)
{
    struct thumbnails *all = hub->thumbnails;

    if (all->job) {
        metric_add(&hub->metrics, METRIC_THUMBNAILS_CANCELLED, 1);
        render_queue_cancel(hub, all->job);
    }
    all->job = 0;
    all->session = NULL;
}

/* --- what a session wants --- */

static struct thumbnail *find(const struct thumbnail_list *list, const struct thumbnail *like)
{
    for (size_t i = 0; i < list->count; i++) {
        struct thumbnail *item = &list->items[i];

        if (item->kind == like->kind && item->width == like->width &&
            strcmp(item->id, like->id) == 0) {
            return item;
        }
    }
    return NULL;
}

static void add_all(struct thumbnail_list *list, enum thumbnail_kind kind, const struct id_set *ids,
                    int width)
{
    list->items = memory_resize(list->items, list->count + ids->count + 1, sizeof *list->items);
    for (size_t i = 0; i < ids->count; i++) {
        struct thumbnail *item = &list->items[list->count++];

        *item = (struct thumbnail){.kind = kind, .width = width};
        snprintf(item->id, sizeof item->id, "%s", ids->ids[i]);
    }
}

void thumbnails_ask(struct session *session, const struct message *message)
{
    struct thumbnail_list *old = session->thumbnails, wanted = *old;
    const int width = (int)json_member_number(message->json, "width", THUMBNAIL_WIDTH);

    wanted.items = NULL;
    wanted.count = 0;
    add_all(&wanted, THUMBNAIL_NODE, &message->nodes, width);
    add_all(&wanted, THUMBNAIL_NODE, &message->large, 8 * width / 3);
    add_all(&wanted, THUMBNAIL_MATERIAL, &message->materials, width);
    for (size_t i = 0; i < wanted.count; i++) {
        const struct thumbnail *known = find(old, &wanted.items[i]);

        if (known) {
            wanted.items[i] = *known;
        }
    }
    free(old->items);
    *old = wanted;
    supervisor_wake(session->hub->supervisor);
}

void thumbnails_acknowledge(struct session *session, uint32_t number)
{
    if (number == session->thumbnails->number) {
        session->thumbnails->unacknowledged = false;
        supervisor_wake(session->hub->supervisor);
    }
}

void thumbnails_stop(struct session *session)
{
    if (session->hub->thumbnails->session == session) {
        cancel(session->hub);
    }
    free(session->thumbnails->items);
    session->thumbnails->items = NULL;
    session->thumbnails->count = 0;
}

/* --- looking and drawing --- */

/* The document of the part. NULL: it is too large. `*out_known` false: the scene does not have
 * it. */
static cJSON *print_part(const struct scene *scene, const struct thumbnail *item, bool *out_known)
{
    const struct node *node = NULL;
    const struct resource *material = NULL;

    if (item->kind == THUMBNAIL_NODE) {
        node = scene_find(scene, item->id);
    } else {
        material = resource_find(&scene->materials, item->id);
    }
    *out_known = node || material;
    return node       ? scene_part_of_node(scene, node, LIMIT_THUMBNAIL_NODES)
           : material ? scene_part_of_material(scene, material)
                      : NULL;
}

static void on_picture(void *data, const struct picture_answer *answer, const struct error *err)
{
    struct thumbnails *all = data;
    struct hub *hub = all->hub;

    struct shared_buffer *picture =
        shared_buffer_create(answer ? answer->bytes : "", answer ? answer->length : 0);

    (void)err;
    image_cache_add(&all->cache, all->key, CODEC_PNG, 0, picture);
    shared_buffer_unref(picture);
    metric_add(&hub->metrics, METRIC_THUMBNAILS_DRAWN, 1);
    all->job = 0;
    all->session = NULL;
    supervisor_wake(hub->supervisor);
}

/* Takes `document`. */
static void draw(struct session *session, const struct thumbnail *item, const char *key,
                 char *document)
{
    struct hub *hub = session->hub;
    struct thumbnails *all = hub->thumbnails;
    struct render_order order = {.portrait = true,
                                 .priority = RENDER_THUMBNAIL,
                                 .account = ACCOUNT,
                                 .again = true,
                                 .on_done = on_picture,
                                 .data = all};

    order.document = document;
    render_request_init(&order.request);
    record_put(&order.request.picture, "width", item->width);
    record_put(&order.request.picture, "height", thumbnail_height(item->width));
    record_put(&order.request.delivery, "exact", true);
    snprintf(all->key, sizeof all->key, "%s", key);
    all->hub = hub;
    all->session = session;
    all->job = render_queue_submit(hub, &order, NULL);
}

/* What the part looks like at this revision: known, or drawn first. */
static void look(struct session *session, struct thumbnail *item)
{
    struct thumbnails *all = session->hub->thumbnails;
    const struct room *room = session->room;
    char digest[ASSET_ID_CHARACTERS + 1], key[THUMBNAIL_KEY_BYTES] = "-";
    bool known;
    cJSON *part = print_part(room->scene, item, &known);
    char *text;

    if (part && session->hub->code_refused) {
        code_text_remove(part);
    }
    text = part ? json_print(part, false) : NULL;
    cJSON_Delete(part);
    if (text) {
        digest_text(text, strlen(text), digest);
        snprintf(key, sizeof key, "%d %s", item->width, digest);
    }
    if (text && strcmp(key, item->sent) != 0 && !image_cache_find(&all->cache, key)) {
        draw(session, item, key, text);
        text = NULL;
    } else {
        metric_add(&session->hub->metrics, METRIC_THUMBNAILS_REUSED,
                   text && strcmp(key, item->key) != 0 && strcmp(key, all->key) != 0);
        item->looked = room->revision;
        snprintf(item->key, sizeof item->key, "%s", known ? key : item->sent);
    }
    free(text);
}

/* --- sending --- */

static bool is_due(const struct thumbnail *item, uint64_t revision)
{
    return item->looked == revision && strcmp(item->key, item->sent) != 0;
}

/* False: its picture has left the cache. */
static bool add_picture(struct hub *hub, struct thumbnail *item, FILE *out)
{
    const bool none = strcmp(item->key, "-") == 0;
    const struct cached_image *picture =
        none ? NULL : image_cache_find(&hub->thumbnails->cache, item->key);
    const size_t length = picture ? picture->bytes->length : 0;
    uint8_t row[THUMBNAIL_ROW_BYTES];

    if (!picture && !none) {
        item->looked = 0;
        return false;
    }
    thumbnail_row_pack(&(struct thumbnail_row){.kind = item->kind,
                                               .id_bytes = strlen(item->id),
                                               .width = item->width,
                                               .height = thumbnail_height(item->width),
                                               .bytes = length},
                       row);
    fwrite(row, sizeof row, 1, out);
    fputs(item->id, out);
    if (picture) {
        fwrite(picture->bytes->bytes, 1, length, out);
    }
    memcpy(item->sent, item->key, sizeof item->sent);
    return true;
}

static void send_message(struct session *session, uint8_t *bytes, size_t length, uint16_t count)
{
    struct thumbnail_list *list = session->thumbnails;
    const struct thumbnail_header header = {
        .count = count, .number = ++list->number, .revision = session->room->revision};
    struct shared_buffer *message;

    thumbnail_header_pack(&header, bytes);
    message = shared_buffer_create(bytes, length);
    send_queue_behind(&session->send_queue, message);
    shared_buffer_unref(message);
    list->unacknowledged = true;
    metric_add(&session->hub->metrics, METRIC_THUMBNAILS_SENT, count);
    metric_add(&session->hub->metrics, METRIC_THUMBNAIL_BYTES, (int64_t)length);
    session->wake(session->connection);
}

static void send_due(struct session *session)
{
    const uint8_t header[THUMBNAIL_HEADER_BYTES] = {0};
    struct thumbnail_list *list = session->thumbnails;
    char *bytes = NULL;
    size_t length = 0;
    uint16_t count = 0;
    FILE *out = open_memstream(&bytes, &length);

    if (!out) {
        abort();
    }
    fwrite(header, sizeof header, 1, out);
    for (size_t i = 0; i < list->count && ftell(out) < THUMBNAIL_MESSAGE_BYTES; i++) {
        if (is_due(&list->items[i], session->room->revision)) {
            count += add_picture(session->hub, &list->items[i], out);
        }
    }
    fclose(out);
    if (count > 0) {
        send_message(session, (uint8_t *)bytes, length, count);
    }
    free(bytes);
}

static bool may_send(const struct session *session)
{
    const struct thumbnail_list *list = session->thumbnails;

    for (size_t i = 0; i < list->count && !list->unacknowledged; i++) {
        if (is_due(&list->items[i], session->room->revision)) {
            return true;
        }
    }
    return false;
}

/* --- whose turn it is --- */

/* When nothing has moved in the room for long enough. */
static int64_t rests_at(const struct room *room)
{
    int64_t at = 0;

    for (const struct session *session = room->sessions; session; session = session->next) {
        const int64_t rested = session->stream->changed_at + THUMBNAIL_REST_MS;

        at = rested > at ? rested : at;
    }
    return at;
}

/* NULL: there is none, or enough wait to be sent. */
static struct thumbnail *find_unseen(const struct session *session)
{
    const struct thumbnail_list *list = session->thumbnails;
    struct thumbnail *unseen = NULL;
    int waiting = 0;

    for (size_t i = 0; i < list->count && !session->close_code; i++) {
        waiting += is_due(&list->items[i], session->room->revision);
        if (!unseen && list->items[i].looked != session->room->revision) {
            unseen = &list->items[i];
        }
    }
    return waiting < WAITING ? unseen : NULL;
}

static int64_t earlier_us(int64_t a, int64_t b)
{
    return a && a < b ? a : b;
}

/* `*io_rest_us`: the end of the first rest of the others, where it is earlier; 0: there is none. */
static struct session *next_in_turn(const struct hub *hub, int64_t now_ms, int64_t *io_rest_us)
{
    const int64_t now_us = clock_us();
    struct session *best = NULL;

    for (struct room *room = hub->rooms; room; room = room->next) {
        if (room->suspended.kind != ERROR_NONE || rests_at(room) > now_ms) {
            continue;
        }
        for (struct session *session = room->sessions; session; session = session->next) {
            const int64_t rest_us = session->thumbnails->rests_until_us;

            if ((best && session->thumbnails->turn >= best->thumbnails->turn) ||
                !find_unseen(session)) {
                continue;
            }
            if (rest_us > now_us) {
                *io_rest_us = earlier_us(*io_rest_us, rest_us);
            } else {
                best = session;
            }
        }
    }
    return best;
}

/* Sends what is due in rooms at rest. Returns when the next of the others rests. */
static int64_t send_all(struct hub *hub, int64_t now_ms)
{
    int64_t next = 0;

    for (struct room *room = hub->rooms; room; room = room->next) {
        const int64_t rested = rests_at(room);

        for (struct session *session = room->sessions; session; session = session->next) {
            if (session->thumbnails->count > 0 && rested > now_ms) {
                next = clock_earlier(next, rested);
            } else if (!session->close_code && may_send(session)) {
                send_due(session);
            }
        }
    }
    return next;
}

static void charge(struct session *session, int64_t begun_us)
{
    struct thumbnail_list *list = session->thumbnails;
    const int64_t now_us = clock_us();
    const int64_t rest_us = workload_charge(&list->work, now_us, now_us - begun_us);

    list->rests_until_us = now_us + rest_us;
    metric_add(&session->hub->metrics, METRIC_THUMBNAIL_RESTS, rest_us > 0);
}

/* Looks at parts for a slice of time. Returns when to go on (clock_us), or 0. */
static int64_t look_in_turn(struct hub *hub, int64_t now_ms)
{
    struct thumbnails *all = hub->thumbnails;
    const int64_t begun_us = clock_us();
    int64_t at_us = begun_us, rest_us = 0;
    struct session *session = NULL;

    if (all->rests_until_us > begun_us) {
        return all->rests_until_us;
    }
    while (hub->render_queue->ready && !all->job && at_us < begun_us + SLICE_US &&
           (session = next_in_turn(hub, now_ms, &rest_us))) {
        session->thumbnails->turn = ++all->turns;
        look(session, find_unseen(session));
        charge(session, at_us);
        at_us = clock_us();
    }
    all->rests_until_us = at_us + PAUSE_TIMES * (at_us - begun_us);
    return session && !all->job ? all->rests_until_us : rest_us;
}

int64_t thumbnails_pump(struct hub *hub, int64_t now_ms)
{
    struct thumbnails *all = hub->thumbnails;

    if (all->job && (!all->session->room || rests_at(all->session->room) > now_ms)) {
        cancel(hub);
    }
    const int64_t next_us = hub->render_queue->ready && !all->job ? look_in_turn(hub, now_ms) : 0;
    const int64_t rested = send_all(hub, now_ms);
    return next_us ? clock_earlier(rested, now_ms + (next_us - clock_us()) / 1000 + 1) : rested;
}
