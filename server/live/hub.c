/* SPDX-License-Identifier: MIT */
#include "hub.h"

#include <string.h>

#include "protocol/code_text.h"
#include "room_state.h"
#include "server/clock.h"
#include "server/doorbell.h"

void hub_lock(struct hub *hub)
{
    pthread_mutex_lock(&hub->lock);
    doorbells_hold();
    hub->locked_us = clock_thread_us();
}

/* Under the lock, so that no other thread writes the longest time. */
static void measure(struct hub *hub)
{
    const int64_t us = clock_thread_us() - hub->locked_us;

    if (us > metric_get(&hub->metrics, METRIC_LOCK_LONGEST)) {
        metric_set(&hub->metrics, METRIC_LOCK_LONGEST, us);
    }
}

void hub_unlock(struct hub *hub)
{
    measure(hub);
    pthread_mutex_unlock(&hub->lock);
    doorbells_release();
}

void hub_wait(struct hub *hub, pthread_cond_t *condition)
{
    measure(hub);
    doorbells_release(); /* some of them may wake who signals the condition */
    pthread_cond_wait(condition, &hub->lock);
    doorbells_hold();
    hub->locked_us = clock_thread_us();
}

void hub_wait_until(struct hub *hub, pthread_cond_t *condition, int64_t until_us)
{
    const struct timespec until = {until_us / 1000000, until_us % 1000000 * 1000};

    measure(hub);
    doorbells_release();
    pthread_cond_clockwait(condition, &hub->lock, CLOCK_MONOTONIC, &until);
    doorbells_hold();
    hub->locked_us = clock_thread_us();
}

bool hub_id_is_valid(const char *id)
{
    const size_t length = strlen(id);

    return length > 0 && length <= LIMIT_ID_BYTES &&
           strspn(id, "abcdefghijklmnopqrstuvwxyz0123456789-") == length;
}

static bool refuse_code(const char *place, struct error *err)
{
    return error_set(err, ERROR_FORBIDDEN, place, "this server takes no code (option `code`)");
}

bool hub_accepts_scene(const struct hub *hub, const struct scene *scene, struct error *err)
{
    char place[ERROR_PLACE_BYTES];

    return !hub->code_refused || !code_text_in_scene(scene) ||
           refuse_code(code_text_changed(scene, NULL, place), err);
}

bool hub_accepts_edit(const struct hub *hub, const cJSON *ops, struct error *err)
{
    char place[ERROR_PLACE_BYTES];

    return !hub->code_refused || !ops || !code_text_find(ops, place) || refuse_code(place, err);
}

struct room *hub_find_room(const struct hub *hub, const char *id)
{
    struct room *room = hub->rooms;

    while (room && strcmp(room->id, id) != 0) {
        room = room->next;
    }
    return room;
}
