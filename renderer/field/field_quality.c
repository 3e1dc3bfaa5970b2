/* SPDX-License-Identifier: MIT */
#include "field_quality.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "field_code.h"
#include "field_parametric.h"
#include "renderer/code/equation_expand.h"
#include "renderer/code/equation_pole.h"
#include "renderer/code/equation_value.h"
#include "renderer/sdf/patches.h"

/* A ray that passes a ball of the clip's size at TOLERANCE takes some 2,000 steps. */
enum { RAYS = 400, STEPS = 2048, EVALUATIONS = 40000 };
/* Of field_work: a third of a second. */
#define WORK 4e8
/* Parts of the clip's extent. */
#define TOLERANCE 2e-6 /* here a ray has met the surface */
#define NEAR 3e-4      /* and so far behind the sign has to change */

/* --- rays --- */

struct walk {
    const struct field *field;
    const struct equation *equation;
    const double *letters;
    bool sheet;
    double from[3], way[3]; /* from where the clip begins; of length 1 */
    double length, extent;
    int evaluations; /* so far */
};

static double distance_at(struct walk *walk, double t)
{
    double p[3];

    for (int i = 0; i < 3; i++) {
        p[i] = walk->from[i] + t * walk->way[i];
    }
    walk->evaluations++;
    return field_distance(walk->field, p);
}

/* Of the equation itself: where it is drawn by rounded coefficients, double roots have signs. A
 * sheet is as thick as the sign of its distance says. */
static bool is_inside(struct walk *walk, double t)
{
    double p[3];

    for (int i = 0; i < 3; i++) {
        p[i] = walk->from[i] + t * walk->way[i];
    }
    return walk->sheet ? distance_at(walk, t) < 0
                       : equation_value(walk->equation, p, walk->letters) < 0;
}

static bool is_inside_soon(struct walk *walk, double t)
{
    bool inside = is_inside(walk, t);

    for (double step = TOLERANCE; step < NEAR && !inside; step *= 2) {
        t += step * walk->extent;
        inside = is_inside(walk, t);
    }
    return inside;
}

/* It leaves the clip, or ends where the sign changes. */
static bool is_resolved(struct walk *walk)
{
    double t = 0;

    for (int i = 0; i < STEPS && t <= walk->length; i++) {
        const double d = distance_at(walk, t);
        if (d < TOLERANCE * walk->extent) {
            return is_inside_soon(walk, t);
        }
        t += d;
    }
    return t > walk->length;
}

/* How far the clip reaches from a point in it. */
static double reach(const struct equation_clip *clip, const double p[3], const double way[3])
{
    double least = INFINITY, along = 0, square = -clip->half[0] * clip->half[0];

    for (int i = 0; i < 3; i++) {
        along += p[i] * way[i];
        square += p[i] * p[i];
        if (way[i] != 0) {
            least = fmin(least, (clip->half[i] - copysign(1, way[i]) * p[i]) / fabs(way[i]));
        }
    }
    return clip->ball ? sqrt(fmax(along * along - square, 0)) - along : least;
}

/* The whole way through the clip along line n. */
static bool find_walk(const struct equation_clip *clip, int n, struct walk *walk)
{
    double p[3], back[3];

    equation_line(clip, n, p, walk->way);
    const double length = hypot(hypot(walk->way[0], walk->way[1]), walk->way[2]);
    for (int i = 0; i < 3; i++) {
        walk->way[i] /= length;
        back[i] = -walk->way[i];
    }
    const double before = reach(clip, p, back);
    walk->length = before + reach(clip, p, walk->way);
    for (int i = 0; i < 3; i++) {
        walk->from[i] = p[i] + before * back[i];
    }
    return length > 0;
}

/* The same node in a scene of its own. */
static struct field *compile_alone(const struct node *node)
{
    cJSON *document = cJSON_CreateObject(), *root;
    struct error err = {0};

    cJSON_AddStringToObject(document, "format", "fieldcast/1");
    root = cJSON_AddObjectToObject(document, "root");
    cJSON_AddStringToObject(root, "type", node->type->record.name);
    record_print(&node->params, cJSON_AddObjectToObject(root, "params"));
    struct scene *scene = scene_read(document, &err);
    struct field *field = scene ? field_compile(scene, &err) : NULL;
    scene_destroy(scene);
    cJSON_Delete(document);
    return field;
}

static void follow_rays(struct walk *walk, const struct equation_clip *clip,
                        struct equation_quality *quality)
{
    const double most = fmin(EVALUATIONS, WORK / (double)field_work(walk->field));

    for (int n = 0; n < RAYS && walk->evaluations < most; n++) {
        if (find_walk(clip, n, walk)) {
            quality->rays++;
            quality->unresolved += !is_resolved(walk);
        }
    }
}

/* --- nodes --- */

static enum equation_quality_kind kind_of(int degree, enum equation_break found)
{
    return degree >= 0              ? QUALITY_POLYNOMIAL
           : found == EQUATION_POLE ? QUALITY_POLE
           : found == EQUATION_JUMP ? QUALITY_JUMP
                                    : QUALITY_SAFE;
}

static void judge(const struct node *node, const struct field_call *call,
                  struct equation_quality *quality)
{
    struct equation_errors errors;
    struct equation *equation = equation_read(call->text, equation_letters, &errors);
    struct field *field = equation ? compile_alone(node) : NULL;
    struct equation_clip clip = {.ball = call->form.ball};
    double letters[EQUATION_LETTERS];

    for (int i = 0; equation_letters[i]; i++) {
        letters[i] = record_number(&node->params, equation_letters[i]);
    }
    for (int i = 0; i < 3; i++) {
        clip.half[i] = call->size[i] / 2;
    }
    if (field) {
        struct walk walk = {.field = field,
                            .equation = equation,
                            .letters = letters,
                            .sheet = call->form.sheet,
                            .extent = call->extent};
        const int degree = equation_degree(equation);
        quality->degree = degree;
        quality->kind =
            kind_of(degree, degree < 0 ? equation_pole(equation, letters, &clip, quality->at)
                                       : EQUATION_UNBROKEN);
        for (int i = 0; i < 3; i++) {
            quality->at[i] = fabs(quality->at[i]) < 1e-9 * call->extent ? 0 : quality->at[i];
        }
        follow_rays(&walk, &clip, quality);
    }
    field_unref(field);
    free(equation);
}

/* --- parametric surfaces --- */

/* The numbers of a field that consists of one; NULL: it has none. */
static const double *patches_of(const struct field *field)
{
    for (size_t i = 0; field && i < field->instruction_count; i++) {
        const struct field_instruction *in = &field->instructions[i];
        if (in->sdf == &sdf_patches) {
            return field->arguments + in->arguments + 12 + FIELD_HEAD_NUMBERS + FIELD_CUT_NUMBERS;
        }
    }
    return NULL;
}

/* The greatest way between both at four points, where a polynomial through 0, 1/3, 2/3 and 1 is off
 * the most. -1: the patch is left out. */
static double patch_error(const double *n, int patch, const struct surface_reading *reading,
                          const struct parametric_source *from, double *room)
{
    static const double at[][2] = {{0.13, 0.13}, {0.87, 0.5}, {0.5, 0.87}, {0.5, 0.5}};
    const double side = patches_side(from->levels);
    double worst = 0;
    int place[2];

    patches_place(patch, place);
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
        double drawn[3], meant[3];
        if (!patches_point(n, patch, at[i][0], at[i][1], drawn)) {
            return -1;
        }
        surface_point(reading, from->letters, (place[0] + at[i][0]) / side,
                      (place[1] + at[i][1]) / side, room, meant);
        const double way =
            hypot(hypot(drawn[0] - meant[0], drawn[1] - meant[1]), drawn[2] - meant[2]);
        worst = isfinite(way) ? fmax(worst, way) : INFINITY;
    }
    return worst;
}

static void judge_patches(const double *n, const struct parametric_source *from,
                          struct equation_quality *quality)
{
    double room[LIMIT_EQUATION_NODES + 1];
    struct surface_reading reading;
    struct equation_errors errors;
    int part;

    if (!surface_reading_init(&reading, &from->surface, &part, &errors)) {
        return;
    }
    quality->kind = QUALITY_SAMPLED;
    quality->patches = patches_side(from->levels) * patches_side(from->levels);
    for (int i = 0; i < quality->patches; i++) {
        const double error = patch_error(n, i, &reading, from, room);
        quality->left_out += error < 0;
        quality->error = fmax(quality->error, error);
    }
    surface_reading_finish(&reading);
}

static void judge_surface(const struct node *node, struct equation_quality *quality)
{
    struct parametric_source from;
    struct field *field = compile_alone(node);
    const double *n = patches_of(field);

    if (n && parametric_source_of(node, &from)) {
        judge_patches(n, &from, quality);
        quality->box = patches_box(n);
        quality->thin = quality->error > record_number(&node->params, "thickness") / 2;
        cJSON_Delete(from.json);
    }
    field_unref(field);
}

/* --- all --- */

struct telling {
    const struct scene *scene;
    const char *node;
    void (*tell)(void *data, const struct equation_quality *quality);
    void *data;
};

static void tell_node(const struct telling *telling, const struct node *node)
{
    struct equation_quality quality = {.kind = QUALITY_UNKNOWN, .degree = -1};
    struct field_call call;

    snprintf(quality.node, sizeof quality.node, "%s", node->id);
    if (node->type->kind == KIND_EQUATION && field_call_of(telling->scene, node, &call)) {
        snprintf(quality.place, sizeof quality.place, "%s", call.place);
        judge(node, &call, &quality);
    } else if (node->type->kind == KIND_SURFACE &&
               strcmp(record_text(&node->params, "surface"), "{}") != 0) {
        snprintf(quality.place, sizeof quality.place, "/nodes/%s/params/surface", node->id);
        judge_surface(node, &quality);
    } else {
        return;
    }
    telling->tell(telling->data, &quality);
}

static void tell_tree(const struct telling *telling, const struct node *top)
{
    for (const struct node *node = top; node; node = node_next(node, top)) {
        if (!telling->node || strcmp(node->id, telling->node) == 0) {
            tell_node(telling, node);
        }
    }
}

void field_qualities(const struct scene *scene, const char *node,
                     void (*tell)(void *data, const struct equation_quality *quality), void *data)
{
    const struct telling telling = {scene, node, tell, data};

    tell_tree(&telling, scene->root);
    for (size_t i = 0; i < scene->models.count; i++) {
        tell_tree(&telling, scene->models.items[i]->root);
    }
}

/* --- words --- */

const char *equation_quality_text(const struct equation_quality *quality,
                                  char out[QUALITY_TEXT_BYTES])
{
    const double percent = quality->rays > 0 ? 100.0 * quality->unresolved / quality->rays : 0;
    const double *at = quality->at;
    char what[120], share[40] = "";

    if (quality->kind == QUALITY_POLYNOMIAL) {
        snprintf(what, sizeof what, "exact polynomial of degree %d", quality->degree);
    } else if (quality->kind == QUALITY_SAFE) {
        snprintf(what, sizeof what, "safe");
    } else if (quality->kind == QUALITY_SAMPLED) {
        char holes[48] = "";
        if (quality->left_out > 0) {
            snprintf(holes, sizeof holes, ", %d of them not finite", quality->left_out);
        }
        snprintf(what, sizeof what, "%d patches, off by %.1e%s%s", quality->patches, quality->error,
                 quality->thin ? ", more than half of the thickness" : "", holes);
    } else if (quality->kind == QUALITY_UNKNOWN) {
        snprintf(what, sizeof what, "unknown: it cannot be drawn");
    } else {
        snprintf(what, sizeof what, "unsafe: %s at (%.3g, %.3g, %.3g)",
                 quality->kind == QUALITY_POLE ? "pole" : "jump", at[0], at[1], at[2]);
    }
    if (percent > 0) {
        snprintf(share, sizeof share, ", %s%.0f %% unresolved", percent < 1 ? "below " : "",
                 fmax(percent, 1));
    }
    snprintf(out, QUALITY_TEXT_BYTES, "%s%s", what, share);
    return out;
}
