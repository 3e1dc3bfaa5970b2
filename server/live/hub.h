/* SPDX-License-Identifier: MIT */
/* What all threads share, under one mutex: open scenes (rooms), the list of scenes, live sessions,
 * and pictures being rendered. Each of these has its own header. Sections under the lock are short:
 * no code in them waits for the disk, a socket or the worker.
 *
 * Threads: acceptor | HTTP | WebSocket | supervisor of the worker | picker | tasks | store writer |
 * main (signals).
 * Order of locks: load_lock, lock, then the private ones of store, supervisor, http, ws, tasks. */
#ifndef SERVER_HUB_H
#define SERVER_HUB_H

#include <pthread.h>
#include <stdatomic.h>

#include "protocol/scene.h"
#include "renderer/renderer.h"
#include "server/metrics.h"
#include "server/net/access.h"
#include "server/store/store.h"
#include "server/tasks.h"
#include "supervisor.h"

struct catalog;
struct compiles;
struct picker;
struct image_cache;
struct quarantine;
struct render_queue;
struct room;
struct asset_index;
struct library;
struct thumbnails;
struct ws;

struct hub {
    pthread_mutex_t lock;         /* guards everything below that changes */
    int64_t locked_us;            /* clock_thread_us of its holder when it took the lock */
    pthread_mutex_t load_lock[2]; /* one for light scenes, one for heavy ones; before `lock` */
    pthread_cond_t released;      /* with `lock`: somebody has released a document */
    struct access access;
    struct metrics metrics; /* atomic by itself */
    struct store *store;
    struct supervisor *supervisor;
    struct picker *picker;
    struct tasks *tasks;
    struct algebra *algebra;     /* finds equations */
    struct questions *questions; /* that it is asked */
    struct ws *ws;               /* set before its thread starts */
    const char *web_dir;
    bool code_refused;            /* users' code is neither accepted nor compiled */
    char *schema, schema_tag[32]; /* of /v1/schema.json; never change */

    struct catalog *catalog;
    struct asset_index *assets;
    struct library *library;
    struct room *rooms;
    struct render_queue *render_queue;
    struct quarantine *quarantine;
    struct compiles *compiles;
    struct image_cache *image_cache;
    struct thumbnails *thumbnails;
    struct renderer_info renderer; /* of the newest worker; name "" before the first */
    int64_t next_cleaning;         /* clock_ms */
    atomic_bool draining;
    atomic_bool hopeless; /* no device draws: the program ends */
};

void hub_lock(struct hub *hub);
void hub_unlock(struct hub *hub);
/* Lets go of the lock until the condition is signalled. */
void hub_wait(struct hub *hub, pthread_cond_t *condition);
/* The same, until `until_us` of clock_us at most. */
void hub_wait_until(struct hub *hub, pthread_cond_t *condition, int64_t until_us);
/* The open room with that id; NULL: none is open. Under the lock. */
struct room *hub_find_room(const struct hub *hub, const char *id);
/* Refuse users' code where the server accepts none: false and ERROR_FORBIDDEN, with the place of
 * the code in the scene or in the operations. NULL: operations without code. */
bool hub_accepts_scene(const struct hub *hub, const struct scene *scene, struct error *err);
bool hub_accepts_edit(const struct hub *hub, const cJSON *ops, struct error *err);
/* `[a-z0-9-]{1,64}` */
bool hub_id_is_valid(const char *id);

#endif
