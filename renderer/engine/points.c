/* SPDX-License-Identifier: MIT */
/* The field at points, without a picture. */

#define POINTS_REACH 64.0f /* farther out there are no cubes */

struct looker {
    struct lanes lanes;
    struct frame_uniforms frame;
    struct dispatch_block dispatch;
    struct scene_block scene;
    struct cells spaces[ENGINE_SPACES];
};

static struct looker *looker_create(const struct engine_program *program, const float *params,
                                    float reach)
{
    struct looker *looker = aligned_room(sizeof *looker);

    memset(looker, 0, sizeof *looker);
    looker->scene =
        (struct scene_block){program->scene.material_base, program->scene.material_stride};
    looker->frame.max_distance = reach;
    struct lanes *c = &looker->lanes;
    c->program = program;
    c->frame = &looker->frame;
    c->dispatch = &looker->dispatch;
    c->scene = &looker->scene;
    c->params = params;
    c->frames = frames_create(program);
    c->machine = aligned_room(sizeof *c->machine);
    c->threads = 1;
    c->picture = 1;
    c->spaces = c->cells = looker->spaces;
    cells_begin(c);
    return looker;
}

static void looker_destroy(struct looker *looker)
{
    frames_destroy(looker->lanes.program, looker->lanes.frames);
    free(looker->lanes.machine);
    cells_finish(looker->spaces);
    free(looker);
}

/* The cube of at most this half that a lane is in; the root where it is in none. */
static int32_t cube_at(struct lanes *c, const struct spots *s, int lane, float half)
{
    int32_t at = 0;

    cells_limit(c);
    while (s->in[lane] && c->cells->at[at].half > half && c->cells->at[at].bits > 0) {
        at = child_at(c, at, s, lane);
        cell_ready(c, at);
    }
    return at;
}

/* At LANES points, each by a cube that holds for it. Answers how many operations ran for each. */
static uint64_t look(struct lanes *c, const vf *p, float half, vf *out)
{
    const struct spots spots = spots_of(c->cells, p);
    vb m = vb_all(true);
    uint64_t ran = 0;

    while (lanes_any(m)) {
        const int32_t at = cube_at(c, &spots, lanes_first(m), half);
        const struct cell *cell = &c->cells->at[at];
        const vb held = cell_lanes(cell, m, p) | (lanes_number == lanes_first(m));
        run(machine_of(c->machine, c, held, p), cell_tape(c->cells, cell), cell->count);
        *out = vf_select(held, c->machine->d[0], *out);
        m &= ~held;
        ran += lanes_count(held) * cell->count;
    }
    return ran;
}

static uint64_t distances(const struct engine_program *program, const float *params,
                          const float (*points)[3], size_t count, float half, float *out)
{
    struct looker *looker = looker_create(program, params, POINTS_REACH);
    uint64_t ran = 0;

    for (size_t first = 0; first < count; first += LANES) {
        vf p[3], d = vf_zero;
        for (int lane = 0; lane < LANES; lane++) {
            const size_t at = first + (size_t)lane < count ? first + (size_t)lane : count - 1;
            for (int i = 0; i < 3; i++) {
                p[i][lane] = points[at][i];
            }
        }
        ran += look(&looker->lanes, p, half, &d);
        for (int lane = 0; lane < LANES && first + (size_t)lane < count; lane++) {
            out[first + (size_t)lane] = d[lane];
        }
    }
    looker_destroy(looker);
    return ran;
}
