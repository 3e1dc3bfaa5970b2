/* SPDX-License-Identifier: MIT */
/* The field at points, without a picture: the whole program, wherever they are. */

static void distances(const struct engine_program *program, const float *params,
                      const float (*points)[3], size_t count, float *out)
{
    static const struct frame_uniforms no_frame;
    static const struct dispatch_block no_dispatch;
    struct scene_block scene = {program->scene.material_base, program->scene.material_stride};
    struct lanes c = {.program = program,
                      .frame = &no_frame,
                      .dispatch = &no_dispatch,
                      .scene = &scene,
                      .params = params,
                      .frames = frames_create(program),
                      .machine = aligned_room(sizeof *c.machine)};
    uint32_t *const tape = memory_alloc(program->count, sizeof *tape);
    for (size_t i = 0; i < program->count; i++) {
        tape[i] = (uint32_t)i;
    }
    for (size_t first = 0; first < count; first += LANES) {
        vf p[3];
        for (int lane = 0; lane < LANES; lane++) {
            const size_t at = first + (size_t)lane < count ? first + (size_t)lane : count - 1;
            for (int i = 0; i < 3; i++) {
                p[i][lane] = points[at][i];
            }
        }
        run(machine_of(c.machine, &c, vb_all(true), p), tape, program->count);
        for (int lane = 0; lane < LANES && first + (size_t)lane < count; lane++) {
            out[first + (size_t)lane] = c.machine->d[0][lane];
        }
    }
    free(tape);
    free(c.machine);
    frames_destroy(program, c.frames);
}
