/* SPDX-License-Identifier: MIT */
/* A long tape that is run again after an edit, for what a cube's children leave out, need not be
 * run whole. Between two operations where the first slot alone holds a distance, that distance and
 * the points that were made are all that is known. Such checkpoints are kept behind the drops of
 * the tape. A run begins at the last one before what has changed, and ends where one behind that
 * is as it was. */

enum {
    CHECKPOINT_WORDS = 128, /* from one to the next, at least */
    CHECKPOINT_TAPE = 512,  /* shorter tapes have none */
};

/* In the middles of the children. */
struct checkpoint {
    uint32_t at;     /* words before it; 0: it is none, nor is there one behind */
    uint64_t points; /* a hash of those that were made before */
    float distance[CUBE_CHILDREN], loose[CUBE_CHILDREN];
};

/* A tape before an edit. */
struct tape_past {
    uint32_t count;       /* of its words */
    uint32_t first, last; /* of these, how many at either end are the same, with their numbers */
    const uint16_t *drops;
    const struct checkpoint *checkpoints;
    size_t checkpoint_count;
};

/* While a tape is run. */
struct checkpoints {
    uint16_t *room; /* of the tape's */
    size_t count, most;
    const struct checkpoint *ahead, *end; /* the next of those before the edit */
    uint32_t shift;                       /* from its place to that in the tape now */
    uint32_t same;                        /* the tape is as it was from here on */
    uint32_t due, note;                   /* where the next may be of use; where it is noted */
    uint32_t ended;                       /* where the run ended */
    uint64_t points;                      /* as in a checkpoint */
};

static void checkpoint_put(struct checkpoints *w, const struct checkpoint *checkpoint)
{
    if (w->count < w->most) {
        memcpy(w->room + w->count++ * (sizeof *checkpoint / sizeof *w->room), checkpoint,
               sizeof *checkpoint);
    }
    w->note = checkpoint->at + CHECKPOINT_WORDS;
}

static void find_due(struct checkpoints *w)
{
    w->due = w->note;
    if (w->ahead < w->end && (int32_t)(w->ahead->at + w->shift - w->due) < 0) {
        w->due = w->ahead->at + w->shift;
    }
}

static struct checkpoint checkpoint_here(const struct machine *v, uint32_t at)
{
    struct checkpoint here = {.at = at, .points = v->checkpoints->points};

    for (int k = 0; k < CUBE_CHILDREN && k < LANES; k++) {
        here.distance[k] = v->d[0][k];
        here.loose[k] = v->loose[0][k];
    }
    return here;
}

/* Whether the rest of the tape is known: it and what it begins with are as before the edit. */
static bool knows_the_rest(struct machine *v, uint32_t at)
{
    struct checkpoints *w = v->checkpoints;

    if (!w || at < w->due) {
        return false;
    }
    const struct checkpoint here = checkpoint_here(v, at);
    while (w->ahead < w->end && (int32_t)(w->ahead->at + w->shift - at) < 0) {
        w->ahead++;
    }
    if (w->ahead < w->end && w->ahead->at + w->shift == at && at >= w->same &&
        w->ahead->points == here.points &&
        memcmp(w->ahead->distance, here.distance, sizeof here.distance) == 0 &&
        memcmp(w->ahead->loose, here.loose, sizeof here.loose) == 0) {
        w->ended = at;
        return true;
    }
    if (at >= w->note) {
        checkpoint_put(w, &here);
    }
    find_due(w);
    return false;
}

/* One more (FNV-1a, over whole floats). */
static void hash_point(struct checkpoints *w, const vf p[3])
{
    for (int k = 0; k < 3 * CUBE_CHILDREN; k++) {
        const float number = p[k / CUBE_CHILDREN][k % CUBE_CHILDREN % LANES];
        uint32_t bits;
        memcpy(&bits, &number, sizeof bits);
        w->points = (w->points ^ bits) * UINT64_C(0x100000001b3);
    }
}

static void run_point(struct machine *v, const struct operation *in)
{
    const vf *const from = v->p[in->point];
    vf *const to = v->p[in->out];

    if (in->op == FIELD_TRANSFORM) {
        place(v->c->own, from, to);
    } else {
        CALL(map_function, kind_of(v, in)->function)(v->c, v->m, from, to);
    }
    if (v->checkpoints && v->depth == 0) {
        hash_point(v->checkpoints, to);
    }
}

/* The points that the tape makes before a place, and the distance there. */
static void go_to(struct machine *v, const uint32_t *tape, const struct checkpoint *checkpoint)
{
    for (uint32_t i = 0; i < checkpoint->at; i++) {
        const struct operation *in = &v->c->program->operations[tape[i] & TAPE_INDEX];
        if (in->op == FIELD_LOOP) {
            i += in->length;
        } else if (in->op == FIELD_TRANSFORM || in->op == FIELD_WARP) {
            v->c->own = v->c->params + 4 * (size_t)in->params;
            run_point(v, in);
        }
    }
    for (int k = 0; k < LANES; k++) {
        v->d[0][k] = checkpoint->distance[k % CUBE_CHILDREN];
        v->loose[0][k] = checkpoint->loose[k % CUBE_CHILDREN];
    }
}

/* Where to begin. Checkpoints up to there stay. */
static uint32_t begin_again(struct machine *v, const uint32_t *tape, const struct tape_past *past)
{
    struct checkpoints *w = v->checkpoints;
    const struct checkpoint *from = NULL;

    w->ahead = past->checkpoints;
    w->end = past->checkpoints + past->checkpoint_count;
    for (; w->ahead < w->end && w->ahead->at <= past->first; w->ahead++) {
        checkpoint_put(w, from = w->ahead);
    }
    if (from) {
        go_to(v, tape, from);
    }
    return from ? from->at : 0;
}

/* What is left out before the run and behind it, and the checkpoints there. */
static void take_the_rest(struct machine *v, const struct tape_past *past, uint32_t begun,
                          uint32_t count)
{
    struct checkpoints *w = v->checkpoints;

    memcpy(v->drops, past->drops, begun * sizeof *v->drops);
    memcpy(v->drops + w->ended, past->drops + (w->ended - w->shift),
           (count - w->ended) * sizeof *v->drops);
    for (; w->ended < count && w->ahead < w->end; w->ahead++) {
        struct checkpoint moved = *w->ahead;
        moved.at += w->shift;
        checkpoint_put(w, &moved);
    }
}
