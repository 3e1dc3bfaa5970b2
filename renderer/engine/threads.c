/* SPDX-License-Identifier: MIT */
/* A thread for each processor takes small tiles of the one that is asked for. */
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <unistd.h>

enum { TILE_LEAST = 16 };

struct crew {
    struct engine_canvas *canvas;
    const struct engine_work *work;
    int threads;
    enum crash_work crash;   /* the work of the thread that draws */
    int side, across, count; /* of small tiles; those in a row, and all of them */
    atomic_int next_tile, next_thread;
    atomic_uint_least64_t rays;
    cpu_set_t anywhere, elsewhere; /* processors: this process's; all but that of the caller */
};

static struct hand *hand_create(const struct engine_canvas *canvas, int threads,
                                struct cells *spaces)
{
    const struct engine_picture *picture = &canvas->picture;
    struct hand *hand = aligned_room(sizeof *hand);

    memset(hand, 0, offsetof(struct hand, starts));
    hand->canvas = canvas;
    hand->scene.material_base = picture->program->scene.material_base;
    hand->scene.material_stride = picture->program->scene.material_stride;
    struct lanes *c = &hand->lanes;
    c->program = picture->program;
    c->frame = picture->frame;
    c->dispatch = &hand->dispatch;
    c->scene = &hand->scene;
    c->maps = picture->maps;
    c->params = picture->params;
    c->tile = (struct lanes_tile){SIDE, hand->geometry, hand->pixels, hand->counted};
    c->frames = frames_create(c->program);
    c->machine = aligned_room(sizeof *c->machine);
    c->threads = threads;
    c->picture = canvas->number;
    c->spaces = spaces;
    for (int i = 0; i < ENGINE_SPACES; i++) {
        c->cells = &c->spaces[i];
        cells_begin(c);
    }
    c->cells = c->spaces;
    return hand;
}

static void hand_destroy(struct hand *hand)
{
    if (!hand) {
        return;
    }
    frames_destroy(hand->lanes.program, hand->lanes.frames);
    free(hand->lanes.machine);
    free(hand);
}

/* The canvas's next: what it knows of the field is worth keeping from tile to tile. */
static struct hand *hand_of(struct crew *crew)
{
    const int number = atomic_fetch_add(&crew->next_thread, 1);
    struct hand **hand = &crew->canvas->hands[number];

    if (!*hand) {
        *hand = hand_create(crew->canvas, crew->threads, crew->canvas->cubes->of[number]);
    }
    (*hand)->work = crew->work;
    (*hand)->rays = 0;
    return *hand;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

static void *take_tiles(void *argument)
{
    struct crew *crew = argument;
    const struct engine_rect tile = crew->work->tile;
    struct hand *hand = hand_of(crew);

    for (int i = atomic_fetch_add(&crew->next_tile, 1); i < crew->count;
         i = atomic_fetch_add(&crew->next_tile, 1)) {
        const int x = i % crew->across * crew->side, y = i / crew->across * crew->side;
        draw_tile(hand, tile.x + x, tile.y + y, smaller(crew->side, tile.width - x),
                  smaller(crew->side, tile.height - y));
    }
    atomic_fetch_add(&crew->rays, hand->rays);
    return NULL;
}

/* As large as leaves a part of the tile to each thread. */
static void divide(struct crew *crew)
{
    const struct engine_rect tile = crew->work->tile;

    crew->side = 2 * TILE;
    do {
        crew->side /= 2;
        crew->across = (tile.width + crew->side - 1) / crew->side;
        crew->count = crew->across * ((tile.height + crew->side - 1) / crew->side);
    } while (crew->side > TILE_LEAST && crew->count < 2 * crew->threads);
}

static void *help(void *argument)
{
    struct crew *crew = argument;

    crash_thread(crew->crash);
    sched_setaffinity(0, sizeof crew->anywhere, &crew->anywhere);
    return take_tiles(crew);
}

/* How many threads may run at once. */
static int find_processors(struct crew *crew)
{
    if (sched_getaffinity(0, sizeof crew->anywhere, &crew->anywhere) != 0) {
        CPU_ZERO(&crew->anywhere); /* more than it has room for */
        CPU_ZERO(&crew->elsewhere);
        return (int)sysconf(_SC_NPROCESSORS_ONLN);
    }
    const int here = sched_getcpu();
    crew->elsewhere = crew->anywhere;
    if (here >= 0) {
        CPU_CLR(here, &crew->elsewhere);
    }
    return CPU_COUNT(&crew->anywhere);
}

/* Threads begin elsewhere and then run anywhere: Linux may start a thread on its creator's
 * processor, and let it wait there for 10 ms while another processor is idle. */
static int start_helpers(struct crew *crew, pthread_t *threads, int most)
{
    pthread_attr_t attributes;
    int started = 0;

    pthread_attr_init(&attributes);
    if (CPU_COUNT(&crew->elsewhere) > 0) {
        pthread_attr_setaffinity_np(&attributes, sizeof crew->elsewhere, &crew->elsewhere);
    }
    while (started < most && pthread_create(&threads[started], &attributes, help, crew) == 0) {
        started++;
    }
    pthread_attr_destroy(&attributes);
    return started;
}

static uint64_t draw(struct engine_canvas *canvas, const struct engine_work *work)
{
    struct crew crew = {.canvas = canvas, .work = work, .crash = crash_thread_work()};
    pthread_t threads[ENGINE_THREADS];
    const int processors = find_processors(&crew), asked = canvas->picture.program->threads;

    crew.threads = smaller(asked > 0 ? asked : processors, ENGINE_THREADS);
    divide(&crew);
    atomic_init(&crew.next_tile, 0);
    atomic_init(&crew.next_thread, 0);
    atomic_init(&crew.rays, 0);
    int started = start_helpers(&crew, threads, smaller(crew.threads, crew.count) - 1);
    take_tiles(&crew);
    while (started > 0) {
        pthread_join(threads[--started], NULL);
    }
    return atomic_load(&crew.rays);
}
