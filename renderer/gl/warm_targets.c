/* SPDX-License-Identifier: MIT */
#include "warm_targets.h"

static const GLenum sky_units[WARM_MAPS] = {UNIT_ENVIRONMENT_MAP, UNIT_SPECULAR_MAP,
                                            UNIT_IRRADIANCE_MAP};

/* The program runs with tapes of nothing. */
static void make_tapes(struct warm_targets *targets, const struct gl *gl)
{
    static const uint32_t nothing[TAPES_ROW][4];

    targets->tapes = tape_texture_create(gl, 1);
    tape_texture_write(targets->tapes, gl, 0, 1, nothing);
}

static void make_skies(struct warm_targets *targets, const struct gl *gl)
{
    for (int i = 0; i < WARM_MAPS; i++) {
        const int levels = sky_units[i] == UNIT_IRRADIANCE_MAP ? 1 : 2;

        gl->ActiveTexture(GL_TEXTURE0 + sky_units[i]);
        gl->GenTextures(1, &targets->maps[i]);
        gl->BindTexture(GL_TEXTURE_2D, targets->maps[i]);
        texture_set_environment(gl, levels);
        texture_allocate(gl, GL_RGBA16F, levels, 4, 2);
    }
}

bool warm_targets_prepare(struct warm_targets *targets, const struct gl *gl, bool fragment,
                          struct error *err)
{
    if (!targets->tapes) {
        make_tapes(targets, gl);
    }
    if (fragment && !targets->has_fragment) {
        targets->has_fragment = fragment_targets_init(&targets->fragment, gl, GROUP_SIDE, err);
        make_skies(targets, gl);
    } else if (!fragment && !targets->has_passes) {
        targets->has_passes = targets_init(&targets->passes, gl, GROUP_SIDE, err);
    }
    return fragment ? targets->has_fragment : targets->has_passes;
}

void warm_targets_finish(struct warm_targets *targets, const struct gl *gl)
{
    targets_finish(&targets->passes, gl);
    fragment_targets_finish(&targets->fragment, gl);
    gl->DeleteTextures(WARM_MAPS, targets->maps);
    gl->DeleteTextures(1, &targets->tapes);
    *targets = (struct warm_targets){0};
}

void warm_targets_run(const struct warm_targets *targets, const struct gl *gl,
                      enum program_stage stage, const struct pass *pass)
{
    const struct dispatch_args dispatch = {.width = GROUP_SIDE, .height = GROUP_SIDE};

    if (stage < STAGE_COUNT) {
        targets_bind(&targets->passes, gl);
        targets_bind_field(&targets->passes, gl, &targets->passes.eye);
        pass_compute(pass, gl, &dispatch, PASS_ARGS(struct sample_args, .sample_index = 0));
        return;
    }
    fragment_targets_bind(&targets->fragment, gl);
    for (int i = 0; i < WARM_MAPS; i++) {
        texture_bind(gl, sky_units[i], targets->maps[i]);
    }
    if (stage == STAGE_STARTS) {
        fragment_targets_draw(&targets->fragment, gl, FRAGMENT_STARTS, pass, &dispatch,
                              (struct pass_args){0});
    } else {
        fragment_targets_draw(&targets->fragment, gl, FRAGMENT_SAMPLES, pass, &dispatch,
                              PASS_ARGS(struct trace_args, .sample_index = 0));
    }
}
