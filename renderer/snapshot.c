/* SPDX-License-Identifier: MIT */
/* From a scene to what a picture needs of it. */
#include "renderer_internal.h"

#include <math.h>
#include <stdlib.h>

#include "protocol/memory.h"
#include "snapshot_programs.h"

/* How far the document's camera is from what it looks at: the size of what is of interest. */
static double scene_scale(const struct record *camera)
{
    const double *a = record_vector(camera, "position"), *b = record_vector(camera, "target");
    const double scale = sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                              (a[2] - b[2]) * (a[2] - b[2]));

    return scale > 1e-6 ? scale : 1;
}

struct field *snapshot_field(const struct scene *scene, const struct field_options *options,
                             struct error *err)
{
    struct field *field = field_compile_as(scene, options, err);
    struct field_options less = *options;

    if (!field && options->drawn) {
        less.drawn = NULL;
        field = field_compile_as(scene, &less, err);
    }
    return field;
}

/* Whether any material asks for rays. */
static bool is_reflective(const struct field *field)
{
    const size_t slots = field->material_count + 2; /* with the default and the floor's */

    for (size_t i = 0; i < slots; i++) {
        const float *material =
            field->params + 4 * (field->material_base + i * field->material_stride);
        if (material[FIELD_REFLECTIVITY] > 0 || material[FIELD_TRANSMISSION] > 0) {
            return true;
        }
    }
    return false;
}

static bool is_equation(const struct field *field, const struct field_instruction *in)
{
    return in->op == FIELD_SHAPE &&
           (in->sdf ? in->choices == FIELD_POLYNOMIAL : field->codes[in->choices].own);
}

/* Rows of a shape's matrix are as long as its space is pressed. */
static bool is_scaled_along_an_axis(const double matrix[12])
{
    double square[3];

    for (int i = 0; i < 3; i++) {
        const double *row = matrix + 4 * i;
        square[i] = row[0] * row[0] + row[1] * row[1] + row[2] * row[2];
    }
    const double most = fmax(square[0], fmax(square[1], square[2]));
    const double least = fmin(square[0], fmin(square[1], square[2]));
    return most > 1.0001 * least;
}

/* Whether a field rises by less than the way from its surface: where space is warped, and of shapes
 * that know but a bound. Equations have estimates. Fractals are rough, which darkens them. */
static bool rises_slowly(const struct field *field, const struct field_instruction *in)
{
    if (in->op != FIELD_SHAPE) {
        return in->op == FIELD_AFTER && in->type->lipschitz == 0;
    }
    const bool rough = in->sdf && in->sdf->trips;
    return !is_equation(field, in) && (!in->sdf || (in->type->exactness == BOUND && !rough) ||
                                       is_scaled_along_an_axis(field->arguments + in->arguments));
}

static void note_bounds(const struct field *field, struct scene_bounds *extent)
{
    for (size_t i = 0; i < field->instruction_count; i++) {
        const struct field_instruction *in = &field->instructions[i];

        extent->rise = extent->rise || rises_slowly(field, in);
        extent->estimates = extent->estimates || is_equation(field, in);
    }
}

/* While the outermost shape is dragged, rays begin where they did before, and the rest of the
 * picture is the same (engine/seen.h). */
static double bounds_step(double scale)
{
    enum { PARTS = 8 };

    return exp2(floor(log2(scale))) / PARTS;
}

/* `limit_loops`: the driver ends long ones. */
struct scene_bounds snapshot_bounds(const struct geometry *geometry, const struct record *camera,
                                    bool limit_loops)
{
    const struct field *field = geometry->field;
    const struct bounds bounds = geometry_bounds(geometry);
    struct scene_bounds extent = {.scale = scene_scale(camera),
                                  .transmissive = field->transmissive,
                                  .reflective = is_reflective(field),
                                  .step = bounds_step(scene_scale(camera)),
                                  .loop_trips = (int)field->loop_trips,
                                  .limit_loops = limit_loops};

    for (int i = 0; i < 3; i++) {
        extent.min[i] = bounds.low[i];
        extent.max[i] = bounds.high[i];
        extent.transmissive_min[i] = field->transmissive_bounds.low[i];
        extent.transmissive_max[i] = field->transmissive_bounds.high[i];
    }
    note_bounds(field, &extent);
    return extent;
}

static bool has_fewer_steps(const struct snapshot *snapshot)
{
    struct frame_uniforms block = snapshot->frame;
    struct render_settings settings;

    return render_settings_make(&settings, &block, &snapshot->render,
                                &(struct settings_request){.level = -1}, &snapshot->extent);
}

/* Why a picture that a scene names is not read; false: it may be. */
static bool is_unreadable(const struct renderer *renderer, const char *id, struct error *out)
{
    static const char place[] = "/environment/image";
    const struct asset *image = assets_find(renderer->assets, id);
    const struct renderer_verdict *verdict = renderer_find_verdict(renderer, 0, id);

    if (verdict && verdict->refused == ERROR_TOO_SLOW) {
        error_set_slow(out, place, "reading this picture takes", verdict->measured_ms,
                       verdict->limit_ms);
    } else if (verdict && verdict->refused != ERROR_NONE) {
        error_set(out, verdict->refused, place, "reading this picture ended the render process");
    } else if (!image) {
        error_set(out, ERROR_NOT_FOUND, place, "no such file is known here");
    } else {
        *out = image->problem;
    }
    return out->kind != ERROR_NONE;
}

/* `problem`: why it has no picture; ERROR_NONE: there is none that it wants and has not. Nothing is
 * said of a scene that names no picture yet. */
static void surround(struct renderer *renderer, struct snapshot *snapshot, const char *image,
                     struct engine_map *maps, const struct error *problem)
{
    if (problem->kind != ERROR_NONE) {
        environment_leave_out(&snapshot->frame);
    }
    if (snapshot->warning.error.kind == ERROR_NONE && image[0]) {
        snapshot->warning = (struct warning){WARNING_ASSET, *problem};
    }
    snapshot->environment = environments_get(renderer->environments, &snapshot->frame, image, maps,
                                             &snapshot->environment_us);
}

/* What does not depend on the program. A picture is waited for. */
static void look_around(struct renderer *renderer, struct snapshot *snapshot,
                        const struct scene *scene)
{
    const char *image = record_text(&scene->environment, "image");
    struct error problem = {0};

    frame_uniforms_set_scene(&snapshot->frame, scene, &snapshot->extent);
    snapshot->fewer_steps = has_fewer_steps(snapshot);
    if (snapshot->frame.sky_kind != SKY_IMAGE ||
        environments_have(renderer->environments, &snapshot->frame, image) ||
        is_unreadable(renderer, image, &problem)) {
        surround(renderer, snapshot, image, NULL, &problem);
        return;
    }
    snapshot->picture = pictures_want(renderer->pictures, assets_find(renderer->assets, image));
    snapshot->next = renderer->waiting;
    renderer->waiting = snapshot;
}

/* It waits for its picture no longer. */
static void leave_waiting(struct renderer *renderer, struct snapshot *snapshot)
{
    struct snapshot **at = &renderer->waiting;

    if (!snapshot->picture) {
        return;
    }
    while (*at != snapshot) {
        at = &(*at)->next;
    }
    *at = snapshot->next;
    picture_unref(renderer->pictures, snapshot->picture);
    snapshot->picture = NULL;
}

void snapshots_settle(struct renderer *renderer)
{
    for (struct snapshot *snapshot = renderer->waiting, *next; snapshot; snapshot = next) {
        struct picture *picture = snapshot->picture;

        next = snapshot->next;
        if (!picture_is_done(picture)) {
            continue;
        }
        const bool made = picture_maps(picture) != NULL;
        surround(renderer, snapshot, picture_id(picture), picture_maps(picture),
                 picture_problem(picture));
        if (made) {
            snapshot->environment_us += picture_us(picture);
        }
        leave_waiting(renderer, snapshot);
    }
}

struct snapshot *snapshot_create(struct renderer *renderer, const struct scene *scene,
                                 uint64_t revision, const struct snapshot *before,
                                 struct upload *upload, uint64_t *out_refused, struct error *err)
{
    struct field *field = upload->field;
    struct snapshot *snapshot;

    snapshot = memory_alloc(1, sizeof *snapshot);
    snapshot->references = 1;
    snapshot->revision = revision;
    snapshot->upload = upload;
    snapshot->geometry = (struct geometry){.field = field};
    snapshot->structure_hash = snapshot_structure(renderer, field, scene);
    if (!snapshot_find_back_end(renderer, snapshot, scene, before, out_refused, err)) {
        snapshot_unref(renderer, snapshot);
        return NULL;
    }
    record_copy(&snapshot->camera, &scene->camera);
    record_copy(&snapshot->render, &scene->render);
    snapshot->extent = snapshot_bounds(&snapshot->geometry, &scene->camera,
                                       renderer->info.software && !snapshot->engine);
    look_around(renderer, snapshot, scene);
    return snapshot;
}

uint64_t snapshot_structure_with_code(const struct snapshot *snapshot)
{
    return snapshot->geometry.field->user_code ? snapshot->structure_hash : 0;
}

const struct error *snapshot_error(const struct snapshot *snapshot)
{
    return snapshot->error.kind != ERROR_NONE ? &snapshot->error : trial_error(snapshot->trial);
}

enum program_state snapshot_state(const struct snapshot *snapshot)
{
    const bool waits =
        snapshot_is_compiling(snapshot) || snapshot->picture || !trial_is_over(snapshot->trial);

    return snapshot_error(snapshot)->kind != ERROR_NONE ? PROGRAM_FAILED
           : waits                                      ? PROGRAM_PENDING
                                                        : PROGRAM_READY;
}

struct warning snapshot_warning(const struct snapshot *snapshot)
{
    const struct error *warning = trial_warning(snapshot->trial);

    return warning->kind != ERROR_NONE ? (struct warning){WARNING_LIPSCHITZ, *warning}
                                       : snapshot->warning;
}

struct snapshot *snapshot_ref(struct snapshot *snapshot)
{
    snapshot->references++;
    return snapshot;
}

void snapshot_unref(struct renderer *renderer, struct snapshot *snapshot)
{
    if (!snapshot || --snapshot->references > 0) {
        return;
    }
    leave_waiting(renderer, snapshot);
    snapshot_leave_back_end(renderer, snapshot);
    upload_unref(snapshot->upload, &renderer->gl);
    environment_unref(renderer->environments, snapshot->environment);
    record_finish(&snapshot->camera);
    record_finish(&snapshot->render);
    free(snapshot);
}
