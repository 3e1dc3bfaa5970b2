/* SPDX-License-Identifier: MIT */
/* The render process: one loop that reads packets, draws one tile of the most urgent picture, and
 * answers. Nothing in it waits but poll(). */
#include "worker.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "encoder.h"
#include "protocol/memory.h"
#include "protocol/messages.h"

enum {
    READ_BYTES = 65536,
    OUT_FULL = 64 << 20, /* nothing is drawn while the front has so much to read */
    COMPILE_POLL_MS = 4,
    OLDEST_EVERY = 8,     /* tiles */
    EXIT_DEVICE_LOST = 3, /* the front starts another */
};

/* A scene, and what the front was told of it. */
struct held {
    char *name;
    struct resident *resident;
    uint64_t told_shown, told_broken;
    struct held *next;
};

/* A picture that was asked for. */
struct task {
    uint64_t number; /* the front's */
    int priority;
    struct job *job; /* NULL once the picture is with the encoder */
    struct encode_params encode;
    bool newest;
    bool cancelled; /* while with the encoder */
    uint64_t received_us, begun_us;
    uint64_t revision;
    int width, height;
    struct job_times times;
    struct task *next; /* in order of arrival */
};

struct worker {
    int fd, wake_fd;
    struct renderer *renderer;
    struct encoder *encoder;
    struct packet_reader in;
    uint8_t *out; /* bytes from out_sent to out_length are still to be sent */
    size_t out_sent, out_length, out_capacity;
    struct held *scenes;
    struct task *tasks;
    uint64_t steps;
    int status; /* -1 while running */
};

static uint64_t now_us(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000 + (uint64_t)t.tv_nsec / 1000;
}

/* --- answers --- */

static cJSON *answer(const char *type)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "type", type);
    return json;
}

/* Queues a packet; takes `json`. */
static void send_packet(struct worker *w, cJSON *json, const void *payload, size_t payload_length)
{
    size_t length;
    uint8_t *bytes = packet_pack(json, payload, payload_length, &length);

    if (w->out_sent > 0) {
        memmove(w->out, w->out + w->out_sent, w->out_length - w->out_sent);
        w->out_length -= w->out_sent;
        w->out_sent = 0;
    }
    if (w->out_length + length > w->out_capacity) {
        w->out_capacity = 2 * (w->out_length + length);
        w->out = memory_resize(w->out, w->out_capacity, 1);
    }
    memcpy(w->out + w->out_length, bytes, length);
    w->out_length += length;
    free(bytes);
    cJSON_Delete(json);
}

static void add_error(cJSON *json, const struct error *err)
{
    cJSON_AddStringToObject(json, "code", error_kind_name(err->kind));
    cJSON_AddStringToObject(json, "place", err->place);
    cJSON_AddStringToObject(json, "message", err->message);
}

static void send_failed(struct worker *w, uint64_t job, const struct error *err)
{
    cJSON *json = answer("failed");

    cJSON_AddNumberToObject(json, "job", (double)job);
    add_error(json, err);
    send_packet(w, json, NULL, 0);
}

static void send_broken(struct worker *w, const char *scene, uint64_t revision,
                        const struct error *err)
{
    cJSON *json = answer("broken");

    cJSON_AddStringToObject(json, "scene", scene);
    cJSON_AddNumberToObject(json, "revision", (double)revision);
    add_error(json, err);
    send_packet(w, json, NULL, 0);
}

static void send_ready(struct worker *w)
{
    const struct renderer_info *info = renderer_info(w->renderer);
    cJSON *json = answer("ready");
    cJSON *renderer = cJSON_AddObjectToObject(json, "renderer");

    cJSON_AddStringToObject(renderer, "name", info->name);
    cJSON_AddStringToObject(renderer, "version", info->version);
    cJSON_AddStringToObject(renderer, "device", info->device);
    cJSON_AddBoolToObject(renderer, "software", info->software);
    send_packet(w, json, NULL, 0);
}

static uint64_t resident_bytes(void)
{
    unsigned long pages = 0;
    FILE *statm = fopen("/proc/self/statm", "r");

    if (statm) {
        if (fscanf(statm, "%*u %lu", &pages) != 1) {
            pages = 0;
        }
        fclose(statm);
    }
    return (uint64_t)pages * (uint64_t)sysconf(_SC_PAGESIZE);
}

static void send_pong(struct worker *w, const cJSON *ping)
{
    const struct renderer_counters counters = renderer_counters(w->renderer);
    cJSON *json = answer("pong");

    cJSON_AddNumberToObject(json, "ping", json_member_number(ping, "ping", 0));
    cJSON_AddNumberToObject(json, "compilations", (double)counters.compilations);
    cJSON_AddNumberToObject(json, "cache_hits", (double)counters.cache_hits);
    cJSON_AddNumberToObject(json, "tiles", (double)counters.tiles);
    cJSON_AddNumberToObject(json, "pictures", (double)counters.pictures);
    cJSON_AddNumberToObject(json, "resident_bytes", (double)resident_bytes());
    send_packet(w, json, NULL, 0);
}

static void send_frame(struct worker *w, const struct task *task, const struct encoding *encoding)
{
    cJSON *json = answer("frame");

    cJSON_AddNumberToObject(json, "job", (double)task->number);
    cJSON_AddNumberToObject(json, "revision", (double)task->revision);
    cJSON_AddBoolToObject(json, "newest", task->newest);
    cJSON_AddNumberToObject(json, "width", task->width);
    cJSON_AddNumberToObject(json, "height", task->height);
    cJSON_AddStringToObject(json, "mime", image_format_mime(task->encode.format));
    cJSON_AddNumberToObject(json, "march_us", task->times.march_us);
    cJSON_AddNumberToObject(json, "light_us", task->times.light_us);
    cJSON_AddNumberToObject(json, "read_us", task->times.read_us);
    cJSON_AddNumberToObject(json, "encode_us", encoding->encode_us);
    cJSON_AddNumberToObject(json, "queue_us", (double)(task->begun_us - task->received_us));
    send_packet(w, json, encoding->bytes, encoding->length);
}

/* --- scenes --- */

static struct held **find_held(struct worker *w, const char *name)
{
    struct held **at = &w->scenes;

    while (*at && strcmp((*at)->name, name) != 0) {
        at = &(*at)->next;
    }
    return at;
}

static void drop_held(struct held **at)
{
    struct held *gone = *at;

    *at = gone->next;
    resident_destroy(gone->resident);
    free(gone->name);
    free(gone);
}

/* Tells the front what has become drawable, or never will. */
static void announce(struct worker *w)
{
    for (struct held *held = w->scenes; held; held = held->next) {
        const uint64_t shown = resident_shown_revision(held->resident);
        const uint64_t revision = resident_revision(held->resident);
        const struct error *err = resident_error(held->resident);

        if (shown != held->told_shown) {
            cJSON *json = answer("shown");
            cJSON_AddStringToObject(json, "scene", held->name);
            cJSON_AddNumberToObject(json, "revision", (double)shown);
            send_packet(w, json, NULL, 0);
            held->told_shown = shown;
        }
        if (err->kind != ERROR_NONE && held->told_broken != revision) {
            send_broken(w, held->name, revision, err);
            held->told_broken = revision;
        }
    }
}

/* Whether somebody waits for the compiler. */
static bool is_compiling(const struct worker *w)
{
    for (const struct held *held = w->scenes; held; held = held->next) {
        if (resident_shown_revision(held->resident) != resident_revision(held->resident) &&
            resident_error(held->resident)->kind == ERROR_NONE) {
            return true;
        }
    }
    for (const struct task *task = w->tasks; task; task = task->next) {
        if (task->job && !job_step_possible(task->job)) {
            return true;
        }
    }
    return false;
}

static void on_scene(struct worker *w, const cJSON *packet)
{
    const char *name = json_member_text(packet, "scene", "");
    const uint64_t revision = (uint64_t)json_member_number(packet, "revision", 0);
    struct held **at = find_held(w, name);
    struct error err = {0};
    struct scene *scene = scene_read(cJSON_GetObjectItemCaseSensitive(packet, "document"), &err);
    struct held *held;

    if (*at) {
        drop_held(at);
    }
    if (!scene) {
        send_broken(w, name, revision, &err);
        return;
    }
    held = memory_alloc(1, sizeof *held);
    held->name = memory_text(name);
    held->resident = resident_create(w->renderer, scene, revision);
    held->next = w->scenes;
    w->scenes = held;
}

static void on_edit(struct worker *w, const cJSON *packet)
{
    const char *name = json_member_text(packet, "scene", "");
    const uint64_t revision = (uint64_t)json_member_number(packet, "revision", 0);
    const cJSON *ops = cJSON_GetObjectItemCaseSensitive(packet, "ops");
    struct held *held = *find_held(w, name);
    struct error err = {0};

    if (!held) {
        error_set(&err, ERROR_NOT_FOUND, "scene", "no scene \"%s\" is held", name);
    }
    if (!held || !resident_edit(held->resident, ops, revision, &err)) {
        send_broken(w, name, revision, &err);
    }
}

static void on_drop(struct worker *w, const cJSON *packet)
{
    struct held **at = find_held(w, json_member_text(packet, "scene", ""));

    if (*at) {
        drop_held(at);
    }
}

/* --- pictures --- */

static void drop_task(struct task **at)
{
    struct task *gone = *at;

    *at = gone->next;
    job_destroy(gone->job);
    free(gone);
}

static bool read_format(const cJSON *packet, struct encode_params *out, struct error *err)
{
    const int format = image_format_find(json_member_text(packet, "format", "png"));

    if (format < 0) {
        return error_set(err, ERROR_INVALID, "format", "\"%s\" is not png, jpg or npy",
                         json_member_text(packet, "format", ""));
    }
    *out = (struct encode_params){
        .format = (enum image_format)format,
        .quality = (int)json_member_number(packet, "quality", 0),
        .chroma_halved = json_member_bool(packet, "chroma_halved", false),
        .fast = json_member_bool(packet, "fast", false),
    };
    return true;
}

static bool read_camera(const cJSON *packet, struct record *out, bool *out_given, struct error *err)
{
    const cJSON *camera = cJSON_GetObjectItemCaseSensitive(packet, "camera");

    *out_given = camera != NULL;
    return !camera || record_read(out, camera, "/camera", err);
}

/* A whole number of the packet; -1 where it does not fit an int. */
static int read_int(const cJSON *packet, const char *name, int fallback)
{
    const double value = json_member_number(packet, name, fallback);

    return value >= 0 && value < 1e9 ? (int)value : -1;
}

static struct job *make_job(struct worker *w, const cJSON *packet, struct task *task,
                            struct error *err)
{
    const char *name = json_member_text(packet, "scene", "");
    const char *aov_text = json_member_text(packet, "aov", "color");
    const int aov = aov_find(aov_text);
    struct held *held = *find_held(w, name);
    struct record camera;
    struct job *job = NULL;
    bool given;

    if (!held) {
        error_set(err, ERROR_NOT_FOUND, "scene", "no scene \"%s\" is held", name);
        return NULL;
    }
    if (aov < 0) {
        error_set(err, ERROR_INVALID, "aov", "\"%s\" is not color, depth, normal or id", aov_text);
        return NULL;
    }
    record_init(&camera, &camera_type);
    if (read_format(packet, &task->encode, err) && read_camera(packet, &camera, &given, err)) {
        const struct job_desc desc = {
            .width = read_int(packet, "width", 0),
            .height = read_int(packet, "height", 0),
            .camera = given ? &camera : NULL,
            .aov = (enum aov)aov,
            .samples = read_int(packet, "samples", 0),
            .exact = json_member_bool(packet, "exact", false),
            .as_floats = task->encode.format == IMAGE_NPY,
        };
        task->width = desc.width;
        task->height = desc.height;
        job = job_create(held->resident, &desc, err);
    }
    record_finish(&camera);
    if (job) {
        task->revision = job_revision(job);
        task->newest = task->revision == resident_revision(held->resident);
    }
    return job;
}

static void on_render(struct worker *w, const cJSON *packet)
{
    struct task *task = memory_alloc(1, sizeof *task);
    struct task **last = &w->tasks;
    struct error err = {0};

    task->number = (uint64_t)json_member_number(packet, "job", 0);
    task->priority = (int)json_member_number(packet, "priority", 0);
    task->received_us = now_us();
    task->job = make_job(w, packet, task, &err);
    if (!task->job) {
        send_failed(w, task->number, &err);
        free(task);
        return;
    }
    while (*last) {
        last = &(*last)->next;
    }
    *last = task;
}

static void on_cancel(struct worker *w, const cJSON *packet)
{
    const uint64_t number = (uint64_t)json_member_number(packet, "job", 0);

    for (struct task **at = &w->tasks; *at; at = &(*at)->next) {
        if ((*at)->number == number) {
            if ((*at)->job) {
                drop_task(at);
            } else {
                (*at)->cancelled = true;
            }
            return;
        }
    }
}

/* The most urgent picture that can go on, and now and then the oldest, so that a stream of urgent
 * ones cannot stop a picture for good. Those waiting for a compiler let others pass. */
static struct task **choose_task(struct worker *w)
{
    const bool oldest = w->steps % OLDEST_EVERY == 0;
    struct task **best = NULL;

    for (struct task **at = &w->tasks; *at; at = &(*at)->next) {
        if ((*at)->job && (!best || (!oldest && (*at)->priority < (*best)->priority)) &&
            job_step_possible((*at)->job)) {
            best = at;
        }
    }
    return best;
}

static void hand_to_encoder(struct worker *w, struct task *task)
{
    struct encoding *encoding = memory_alloc(1, sizeof *encoding);

    encoding->job = task->number;
    encoding->priority = task->priority;
    encoding->params = task->encode;
    encoding->data = task;
    task->times = job_times(task->job);
    encoding->image = job_take_image(task->job);
    job_destroy(task->job);
    task->job = NULL;
    encoder_add(w->encoder, encoding);
}

/* One tile. */
static void step(struct worker *w, struct task **at)
{
    struct task *task = *at;

    w->steps++;
    if (task->begun_us == 0) {
        task->begun_us = now_us();
    }
    switch (job_step(task->job)) {
    case JOB_WAITING:
    case JOB_RUNNING:
        break;
    case JOB_DONE:
        hand_to_encoder(w, task);
        break;
    case JOB_FAILED:
        send_failed(w, task->number, job_error(task->job));
        if (job_error(task->job)->kind == ERROR_UNAVAILABLE) {
            w->status = EXIT_DEVICE_LOST;
        }
        drop_task(at);
        break;
    }
}

static void collect_encodings(struct worker *w)
{
    struct encoding *encoding;
    uint64_t count;

    if (read(w->wake_fd, &count, sizeof count) < 0) {
        return;
    }
    while ((encoding = encoder_take(w->encoder))) {
        struct task **at = &w->tasks;
        while (*at != encoding->data) {
            at = &(*at)->next;
        }
        if (!(*at)->cancelled && encoding->ok) {
            send_frame(w, *at, encoding);
        } else if (!(*at)->cancelled) {
            send_failed(w, (*at)->number, &encoding->error);
        }
        drop_task(at);
        encoding_destroy(encoding);
    }
}

/* --- questions --- */

static void add_vector(cJSON *json, const char *name, const double v[3])
{
    cJSON_AddItemToObject(json, name, cJSON_CreateDoubleArray(v, 3));
}

static void on_pick(struct worker *w, const cJSON *packet)
{
    struct held *held = *find_held(w, json_member_text(packet, "scene", ""));
    const int width = read_int(packet, "width", 0), height = read_int(packet, "height", 0);
    cJSON *json = answer("picked");
    struct pick_result result = {0};
    struct record camera;
    bool given;

    record_init(&camera, &camera_type);
    if (held && width > 0 && height > 0 && read_camera(packet, &camera, &given, NULL)) {
        result =
            resident_pick(held->resident, given ? &camera : NULL, width, height,
                          json_member_number(packet, "x", 0), json_member_number(packet, "y", 0));
    }
    record_finish(&camera);
    cJSON_AddNumberToObject(json, "pick", json_member_number(packet, "pick", 0));
    cJSON_AddNumberToObject(json, "revision",
                            held ? (double)resident_shown_revision(held->resident) : 0);
    if (result.hit) {
        cJSON_AddStringToObject(json, "node", result.node);
        add_vector(json, "position", result.position);
        add_vector(json, "normal", result.normal);
        cJSON_AddNumberToObject(json, "distance", result.distance);
    } else {
        cJSON_AddNullToObject(json, "node");
    }
    send_packet(w, json, NULL, 0);
}

/* --- the loop --- */

static void on_stop(struct worker *w, const cJSON *packet)
{
    (void)packet;
    w->status = 0;
}

static void on_packet(struct worker *w, const cJSON *packet)
{
    static const struct {
        const char *type;
        void (*handle)(struct worker *w, const cJSON *packet);
    } rows[] = {
        {"scene", on_scene},   {"edit", on_edit}, {"drop", on_drop},   {"render", on_render},
        {"cancel", on_cancel}, {"pick", on_pick}, {"ping", send_pong}, {"stop", on_stop},
    };
    const char *type = json_member_text(packet, "type", "");
    struct error err = {0};

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (strcmp(rows[i].type, type) == 0) {
            rows[i].handle(w, packet);
            return;
        }
    }
    error_set(&err, ERROR_INVALID, "type", "\"%s\" is no packet to a worker", type);
    send_failed(w, (uint64_t)json_member_number(packet, "job", 0), &err);
}

static void receive(struct worker *w)
{
    uint8_t bytes[READ_BYTES];
    struct packet packet;
    ssize_t got;
    int state;

    while ((got = recv(w->fd, bytes, sizeof bytes, MSG_DONTWAIT)) > 0) {
        packet_reader_add(&w->in, bytes, (size_t)got);
    }
    if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
        w->status = 0; /* the front is gone */
        return;
    }
    while (w->status < 0 && (state = packet_reader_next(&w->in, &packet)) != 0) {
        if (state < 0) {
            struct error err = {0};
            error_set(&err, ERROR_SYNTAX, "", "a malformed packet");
            send_failed(w, 0, &err);
            w->status = 1; /* where the next packet begins is not known */
            return;
        }
        on_packet(w, packet.json);
        packet_finish(&packet);
    }
}

static void flush(struct worker *w)
{
    while (w->out_sent < w->out_length) {
        const ssize_t sent = send(w->fd, w->out + w->out_sent, w->out_length - w->out_sent,
                                  MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent < 0) {
            if (errno != EAGAIN && errno != EINTR) {
                w->status = 0;
            }
            return;
        }
        w->out_sent += (size_t)sent;
    }
}

static void run(struct worker *w)
{
    while (w->status < 0) {
        struct pollfd fds[2] = {{.fd = w->fd, .events = POLLIN},
                                {.fd = w->wake_fd, .events = POLLIN}};
        const bool full = w->out_length - w->out_sent > OUT_FULL;
        struct task **task = full ? NULL : choose_task(w);

        if (w->out_sent < w->out_length) {
            fds[0].events |= POLLOUT;
        }
        if (poll(fds, 2, task ? 0 : is_compiling(w) ? COMPILE_POLL_MS : -1) < 0 && errno != EINTR) {
            w->status = 1;
            return;
        }
        if (fds[0].revents & (POLLIN | POLLHUP | POLLERR)) {
            receive(w);
            task = full || w->status >= 0 ? NULL : choose_task(w);
        }
        if (task) {
            step(w, task);
        }
        if (fds[1].revents) {
            collect_encodings(w);
        }
        renderer_poll(w->renderer, 0);
        announce(w);
        flush(w);
    }
}

/* Address space beyond what the process has now. GPU drivers reserve any amount of it, so there it
 * bounds nothing that is scarce. */
static void limit_memory(const struct worker *w, size_t bytes)
{
    unsigned long pages = 0;
    FILE *statm =
        bytes > 0 && renderer_info(w->renderer)->software ? fopen("/proc/self/statm", "r") : NULL;

    if (!statm) {
        return;
    }
    if (fscanf(statm, "%lu", &pages) == 1) {
        const rlim_t most = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE) + bytes;
        setrlimit(RLIMIT_AS, &(struct rlimit){most, most});
    }
    fclose(statm);
}

static void finish(struct worker *w)
{
    while (w->scenes) {
        drop_held(&w->scenes);
    }
    encoder_destroy(w->encoder);
    while (w->tasks) {
        drop_task(&w->tasks);
    }
    renderer_destroy(w->renderer);
    packet_reader_finish(&w->in);
    free(w->out);
    if (w->wake_fd >= 0) {
        close(w->wake_fd);
    }
}

int worker_run(int fd, const struct worker_params *params)
{
    struct worker w = {.fd = fd, .status = -1};
    struct error err = {0};

    prctl(PR_SET_PDEATHSIG, SIGKILL);
    signal(SIGINT, SIG_IGN); /* a Ctrl-C at the terminal is for the front */
    w.wake_fd = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    w.renderer = renderer_create(&params->renderer, &err);
    w.encoder = w.renderer ? encoder_create(w.wake_fd, &err) : NULL;
    if (w.wake_fd < 0 || !w.encoder) {
        if (params->renderer.log) {
            params->renderer.log(params->renderer.log_data, err.message);
        }
        finish(&w);
        return 1;
    }
    limit_memory(&w, params->memory_limit_bytes);
    send_ready(&w);
    run(&w);
    flush(&w);
    finish(&w);
    return w.status;
}
