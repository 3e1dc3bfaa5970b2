/* SPDX-License-Identifier: MIT */
/* What all threads share, under one mutex: open scenes (rooms), the list of scenes, live sessions,
 * pictures being rendered. Sections under the lock are short: nothing in them waits for the disk,
 * a socket or the worker.
 *
 * Threads: acceptor | HTTP | WebSocket | supervisor of the worker | picker | tasks | store writer |
 * main (signals).
 * Order of locks: load_lock, lock, then the private ones of store, supervisor, http, ws, tasks. */
#ifndef SERVER_HUB_H
#define SERVER_HUB_H

#include <pthread.h>
#include <stdatomic.h>

#include "catalog.h"
#include "compiles.h"
#include "picker.h"
#include "pictures.h"
#include "protocol/scene.h"
#include "quarantine.h"
#include "renders.h"
#include "server/metrics.h"
#include "server/net/access.h"
#include "server/store/store.h"
#include "server/tasks.h"
#include "supervisor.h"
#include "uploads.h"

struct room;
struct ws;

struct hub {
    pthread_mutex_t lock;         /* guards everything below that changes */
    pthread_mutex_t load_lock[2]; /* one load of a light, one of a heavy scene; before `lock` */
    pthread_cond_t released;      /* with `lock`: a document is held by nobody, or by one less */
    struct access access;
    struct metrics metrics; /* atomic by itself */
    struct store *store;
    struct supervisor *supervisor;
    struct picker *picker;
    struct tasks *tasks;
    struct ws *ws; /* set before its thread starts */
    const char *web_dir;
    bool code_refused;            /* no code of users is taken, nor compiled */
    char *schema, schema_tag[32]; /* of /v1/schema.json; never change */

    struct catalog catalog;
    struct uploads uploads;
    struct room *rooms;
    struct renders renders;
    struct quarantine quarantine;
    struct compiles compiles;
    struct pictures pictures;
    struct renderer_info renderer; /* of the newest worker; name "" before the first */
    int64_t next_cleaning;         /* clock_ms */
    atomic_bool draining;
    atomic_bool hopeless; /* no device draws: the program ends */
};

struct hub_params {
    struct access access;
    const char *data_dir;
    const char *web_dir;
    const char *const *worker_argv;
    int worker_silence_ms, worker_busy_ms;
    bool code_refused;
};

/* Opens the store, reads the list of scenes, starts the worker. */
struct hub *hub_create(const struct hub_params *params, struct error *err);
/* From here on edits are refused; commits what there is, with snapshots, and waits for it. */
void hub_drain(struct hub *hub);
/* Ends the worker and its thread; sessions may still go. */
void hub_stop(struct hub *hub);
/* After everybody who calls into the hub has stopped. */
void hub_destroy(struct hub *hub);

void hub_lock(struct hub *hub);
void hub_unlock(struct hub *hub);
/* Takes the lock and gives the open room, loaded if it was not. NULL, and the lock not held, when
 * there is no such scene or it cannot be read. */
struct room *hub_lock_room(struct hub *hub, const char *id, struct error *err);
/* The same for who changes the document: waits while somebody holds it. Threads of tasks only. */
struct room *hub_lock_room_to_change(struct hub *hub, const char *id, struct error *err);
bool hub_has_scene(struct hub *hub, const char *id);
/* Whether reading, printing or copying the scene takes long. Takes the lock. */
bool hub_scene_is_heavy(struct hub *hub, const char *id);
/* Whether it is in memory, or nowhere, and not heavy. Takes the lock. */
bool hub_is_ready(struct hub *hub, const char *id);
/* Creates a scene; takes the lock, returns holding it, like hub_lock_room. Takes `scene` and
 * `text`, which is what it prints as, in any case. `id` "" finds one. `then` runs after the commit
 * on the store's thread. */
struct room *hub_lock_new_room(struct hub *hub, const char *id, struct scene *scene, char *text,
                               void (*then)(void *data), void *data, struct error *err);
/* Under the lock: forgets and deletes the scene; the room is gone afterwards. */
void hub_delete_room(struct hub *hub, struct room *room, void (*then)(void *data), void *data);
/* Whether code of users may come in: refuses (ERROR_FORBIDDEN, with its place) a scene, or
 * operations, that have some where the server takes none. */
bool hub_accepts_scene(const struct hub *hub, const struct scene *scene, struct error *err);
bool hub_accepts_edit(const struct hub *hub, const cJSON *ops, struct error *err);
/* `[a-z0-9-]{1,64}` */
bool hub_id_is_valid(const char *id);

#endif
