/* SPDX-License-Identifier: MIT */
/* A thread for each processor takes small tiles of the one that is asked for. */
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <unistd.h>

enum {
    /* The side of a part, in pixels. Parts of 32 cost 5 % more in total than those of 64 (TILE),
     * parts of 16 cost 20 %. */
    PART_LEAST = 16,
    PARTS = 2, /* of a tile, for each thread, unless they would be too small */
};

struct crew {
    void (*task)(struct crew *crew); /* what each thread does */
    int threads;                     /* at most */
    cpu_set_t anywhere, elsewhere;   /* processors: this process's; all but that of the caller */
    atomic_int next, next_thread;
    enum crash_work crash; /* the work of the thread that draws */
    /* Drawing: */
    struct engine_canvas *canvas;
    const struct engine_work *work;
    pthread_mutex_t lock; /* of `taken` in the canvas's parts */
    atomic_uint_least64_t rays;
    atomic_bool paused;
    struct expedition *expedition; /* explore.c */
    struct survey *survey;         /* survey.c */
    /* Renewing: */
    struct engine_program *program;
    struct cubes *cubes;
    const float *params;
    const uint8_t *changed;
    const struct matches *matches;
};

static struct hand *hand_create(const struct engine_canvas *canvas, int threads, int number)
{
    const struct engine_picture *picture = &canvas->picture;
    struct hand *hand = aligned_room(sizeof *hand);

    memset(hand, 0, offsetof(struct hand, starts));
    hand->canvas = canvas;
    hand->number = number;
    hand->noted = &canvas->cubes->noted[number];
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
    c->spaces = canvas->cubes->of[number];
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

/* What it knows of the field is worth keeping from tile to tile. */
static struct hand *hand_at(struct crew *crew, int number)
{
    struct hand **hand = &crew->canvas->hands[number];

    if (!*hand) {
        *hand = hand_create(crew->canvas, crew->threads, number);
    }
    (*hand)->work = crew->work;
    (*hand)->paused = &crew->paused;
    (*hand)->lanes.noted = crew->canvas->seen ? (*hand)->noted : NULL;
    return *hand;
}

/* The canvas's next. */
static struct hand *hand_of(struct crew *crew)
{
    return hand_at(crew, atomic_fetch_add(&crew->next_thread, 1));
}

static void set_taken(struct crew *crew, struct engine_part *part, int thread, bool taken)
{
    pthread_mutex_lock(&crew->lock);
    part->thread = thread;
    part->taken = taken;
    pthread_mutex_unlock(&crew->lock);
}

/* Goes on with a part that this hand had begun. After a pause the same hand has to end it. */
static void draw_part(struct crew *crew, struct hand *hand, struct engine_part *part)
{
    if (hand->part != part) {
        begin_part(hand, part->rect);
        begin_samples(hand);
        hand->part = part;
    }
    if (draw_samples(hand)) {
        end_part(hand);
        hand->part = NULL;
    } else {
        set_taken(crew, part, hand->number, false);
    }
    atomic_fetch_add(&crew->rays, hand->rays);
    hand->rays = 0;
}

/* The next part that this thread may draw; NULL: there is none. Threads take parts in order, so one
 * that a thread has begun comes before those that it has not. */
static struct engine_part *next_part(struct crew *crew, int thread)
{
    struct engine_part *part = NULL;

    pthread_mutex_lock(&crew->lock);
    for (size_t i = 0; i < crew->canvas->part_count && !part; i++) {
        struct engine_part *one = &crew->canvas->parts[i];
        if (!one->taken && (one->thread < 0 || one->thread == thread)) {
            part = one;
            part->taken = true;
        }
    }
    pthread_mutex_unlock(&crew->lock);
    return part;
}

/* Who drew a part before has its cubes. */
static void take_parts(struct crew *crew)
{
    struct hand *hand = hand_of(crew);
    struct engine_part *part;

    while (!atomic_load(&crew->paused) && (part = next_part(crew, hand->number))) {
        draw_part(crew, hand, part);
    }
}

static bool has_parts_left(const struct engine_canvas *canvas)
{
    size_t i = 0;

    while (i < canvas->part_count && canvas->parts[i].taken) {
        i++;
    }
    return i < canvas->part_count;
}

/* Of threads that did not run. */
static void draw_rest(struct crew *crew)
{
    for (size_t i = 0; i < crew->canvas->part_count && !atomic_load(&crew->paused); i++) {
        struct engine_part *part = &crew->canvas->parts[i];
        if (!part->taken) {
            part->taken = true;
            draw_part(crew, hand_at(crew, part->thread), part);
        }
    }
}

static int count_parts(struct engine_rect tile, int side)
{
    return ((tile.width + side - 1) / side) * ((tile.height + side - 1) / side);
}

/* As large as leaves some parts of the tile to each thread. */
static int side_of(const struct crew *crew)
{
    int side = TILE;

    while (side > PART_LEAST && count_parts(crew->work->tile, side) < PARTS * crew->threads) {
        side /= 2;
    }
    return side;
}

static size_t divide(struct engine_rect tile, int side, struct engine_part **out)
{
    const int across = (tile.width + side - 1) / side, down = (tile.height + side - 1) / side;
    size_t count = 0;

    *out = memory_alloc((size_t)across * (size_t)down, sizeof **out);
    for (int y = 0; y < tile.height; y += side) {
        for (int x = 0; x < tile.width; x += side) {
            (*out)[count++] =
                (struct engine_part){{tile.x + x, tile.y + y, smaller(side, tile.width - x),
                                      smaller(side, tile.height - y)},
                                     -1,
                                     false};
        }
    }
    return count;
}

static void *help(void *argument)
{
    struct crew *crew = argument;

    crash_thread(crew->crash);
    sched_setaffinity(0, sizeof crew->anywhere, &crew->anywhere);
    crew->task(crew);
    return NULL;
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

/* The caller is one of at most `most` threads. */
static void run_crew(struct crew *crew, int most)
{
    pthread_t threads[ENGINE_THREADS];

    crew->crash = crash_thread_work();
    atomic_init(&crew->next, 0);
    atomic_init(&crew->next_thread, 0);
    atomic_init(&crew->rays, 0);
    atomic_init(&crew->paused, false);
    int started = start_helpers(crew, threads, smaller(crew->threads, most) - 1);
    crew->task(crew);
    while (started > 0) {
        pthread_join(threads[--started], NULL);
    }
}

static void find_threads(struct crew *crew, const struct engine_program *program)
{
    const int processors = find_processors(crew);

    crew->threads = smaller(program->threads > 0 ? program->threads : processors, ENGINE_THREADS);
}

/* What all threads know of squares. */
static void take_squares(struct engine_canvas *canvas, const struct engine_work *work)
{
    for (int i = 0; i < ENGINE_THREADS; i++) {
        struct noted *noted = &canvas->cubes->noted[i];
        for (size_t k = 0; k < noted->made_count; k++) {
            seen_take(canvas->seen, noted->made[k], work);
        }
        noted->made_count = 0;
    }
}

static void verify(struct crew *crew)
{
    verify_squares(hand_of(crew));
}

/* What is to be drawn of a tile; answers how many pixels. */
static uint64_t begin_tile(struct crew *crew)
{
    struct engine_canvas *canvas = crew->canvas;
    uint64_t pixels = 0;

    if (canvas->seen && !canvas->verified) {
        crew->task = verify;
        run_crew(crew, crew->threads);
        canvas->verified = true;
    }
    canvas->part_count = canvas->seen ? seen_divide(canvas->seen, canvas->cubes, crew->work,
                                                    side_of(crew), &canvas->parts)
                                      : divide(crew->work->tile, side_of(crew), &canvas->parts);
    for (size_t i = 0; i < canvas->part_count; i++) {
        const struct engine_rect rect = canvas->parts[i].rect;
        pixels += (uint64_t)rect.width * (uint64_t)rect.height;
    }
    return pixels;
}

static void end_tile(struct engine_canvas *canvas)
{
    free(canvas->parts);
    canvas->parts = NULL;
    canvas->part_count = 0;
}

static struct engine_drawn draw(struct engine_canvas *canvas, const struct engine_work *work)
{
    struct crew crew = {.canvas = canvas, .work = work, .lock = PTHREAD_MUTEX_INITIALIZER};
    struct engine_drawn drawn = {0};

    find_threads(&crew, canvas->picture.program);
    if (!canvas->parts) {
        drawn.pixels = begin_tile(&crew);
    }
    if (canvas->part_count > 0) {
        crew.task = take_parts;
        run_crew(&crew,
                 canvas->part_count < ENGINE_THREADS ? (int)canvas->part_count : ENGINE_THREADS);
        draw_rest(&crew);
        drawn.paused = has_parts_left(canvas);
        drawn.rays = atomic_load(&crew.rays);
    }
    if (canvas->seen) {
        take_squares(canvas, work);
    }
    if (!drawn.paused) {
        end_tile(canvas);
    }
    return drawn;
}

/* --- renewing --- */

static void renew_some(struct crew *crew)
{
    int i;

    while ((i = atomic_fetch_add(&crew->next, 1)) < ENGINE_THREADS) {
        const struct renewal renewal = {
            .changed = crew->changed, .matches = crew->matches, .edit = crew->cubes->edit};
        renew_spaces(renewal, crew->program, crew->cubes->of[i], crew->params);
    }
}

static void renew(struct engine_program *program, struct cubes *cubes, const float *params,
                  const uint8_t *changed, const struct matches *matches)
{
    struct crew crew = {.task = renew_some,
                        .program = program,
                        .cubes = cubes,
                        .params = params,
                        .changed = changed,
                        .matches = matches};
    int used = 0;

    for (int i = 0; i < ENGINE_THREADS; i++) {
        used += cubes->of[i][0].count + cubes->of[i][1].count + cubes->of[i][2].count > 0;
    }
    find_threads(&crew, program);
    run_crew(&crew, used > 0 ? used : 1);
}
