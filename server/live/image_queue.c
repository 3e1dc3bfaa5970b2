/* SPDX-License-Identifier: MIT */
#include "image_queue.h"

#include <stdlib.h>
#include <string.h>

#include "hub.h"
#include "render_entry.h"
#include "room_state.h"
#include "server/clock.h"

/* One that waits. */
struct place {
    const struct render_entry *entry;
    int64_t pixels;
    int turn; /* of its client's, counted from 1 */
};

/* In the order of asking. */
struct line {
    struct place places[LIMIT_IMAGE_QUEUE];
    int count;
};

static bool is_own(const struct place *place, const char *account)
{
    return strcmp(place->entry->account, account) == 0;
}

static int turn_of(const struct line *line, int index)
{
    const struct place *place = &line->places[index];
    int turn = 1;

    for (int i = 0; i < line->count; i++) {
        const struct place *other = &line->places[i];
        const bool before =
            other->pixels < place->pixels || (other->pixels == place->pixels && i < index);

        turn += before && is_own(other, place->entry->account);
    }
    return turn;
}

static void form_line(const struct render_queue *queue, struct line *line)
{
    line->count = 0;
    for (const struct render_entry *entry = queue->first; entry && line->count < LIMIT_IMAGE_QUEUE;
         entry = entry->next) {
        if (entry->order.priority == RENDER_IMAGE) {
            line->places[line->count++] = (struct place){
                .entry = entry, .pixels = render_request_pixels(&entry->order.request)};
        }
    }
    for (int i = 0; i < line->count; i++) {
        line->places[i].turn = turn_of(line, i);
    }
}

static int own_count(const struct line *line, const char *account)
{
    int count = 0;

    for (int i = 0; i < line->count; i++) {
        count += is_own(&line->places[i], account);
    }
    return count;
}

/* Of one whose turn it is then and who asked as the `index`th. */
static int position_of(const struct line *line, int turn, int index)
{
    int position = 1;

    for (int i = 0; i < line->count; i++) {
        position += line->places[i].turn < turn || (line->places[i].turn == turn && i < index);
    }
    return position;
}

/* Until the first picture of a client is there. */
static int first_position(const struct line *line, const char *account)
{
    for (int i = 0; i < line->count; i++) {
        if (line->places[i].turn == 1 && is_own(&line->places[i], account)) {
            return position_of(line, 1, i);
        }
    }
    return 1;
}

/* --- who may ask --- */

static bool refuse(const struct hub *hub, const struct line *line, const char *account, bool share,
                   struct error *err)
{
    const struct render_queue *queue = hub->render_queue;
    const int own = own_count(line, account), waiting = share ? own : line->count;
    const int64_t each_ms = queue->image_ms > 0 ? queue->image_ms : 1000;
    const int64_t wait_ms = each_ms * (share ? first_position(line, account) : 1);

    error_set(err, share ? ERROR_SHARE : ERROR_UNAVAILABLE, "",
              "%d pictures%s wait already; the limit is %d", waiting,
              share ? " of this client" : "", share ? LIMIT_IMAGE_SHARE : LIMIT_IMAGE_QUEUE);
    err->retry_ms = (int)(wait_ms < RENDER_DEADLINE_MS ? wait_ms : RENDER_DEADLINE_MS);
    err->position = position_of(line, own + 1, line->count);
    return false;
}

bool image_queue_admits(struct hub *hub, const struct render_order *order, struct error *err)
{
    struct line line;

    form_line(hub->render_queue, &line);
    if (own_count(&line, order->account) >= LIMIT_IMAGE_SHARE) {
        metric_add(&hub->metrics, METRIC_IMAGES_OVER_SHARE, 1);
        return refuse(hub, &line, order->account, true, err);
    }
    if (line.count >= LIMIT_IMAGE_QUEUE) {
        metric_add(&hub->metrics, METRIC_IMAGES_OVER_QUEUE, 1);
        return refuse(hub, &line, order->account, false, err);
    }
    return true;
}

/* --- who waits --- */

void image_queue_each(const struct hub *hub, const char *account,
                      void (*see)(void *data, const struct image_place *place), void *data)
{
    const int64_t now = clock_ms();
    struct line line;

    form_line(hub->render_queue, &line);
    for (int i = 0; i < line.count; i++) {
        const struct render_entry *entry = line.places[i].entry;
        const int position = position_of(&line, line.places[i].turn, i);

        if (!is_own(&line.places[i], account)) {
            continue;
        }
        see(data, &(struct image_place){
                      .scene = entry->order.room ? entry->order.room->id : NULL,
                      .width = render_request_int(&entry->order.request, "width"),
                      .height = render_request_int(&entry->order.request, "height"),
                      .position = position,
                      .waited_ms = now - entry->asked,
                      .expected_ms = position * hub->render_queue->image_ms,
                  });
    }
}

int image_queue_clients(const struct hub *hub)
{
    struct line line;
    int count = 0;

    form_line(hub->render_queue, &line);
    for (int i = 0; i < line.count; i++) {
        count += line.places[i].turn == 1;
    }
    return count;
}
