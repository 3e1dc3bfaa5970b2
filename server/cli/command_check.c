/* SPDX-License-Identifier: MIT */
/* fieldcast check: are these documents right, can they be drawn, how well are their equations
 * drawn, and are these those of the parametric surfaces beside them? */
#include <string.h>

#include "command.h"
#include "local_render.h"
#include "protocol/kinds.h"
#include "renderer/renderer.h"
#include "server/algebra.h"
#include "server/embedded.h"

/* What is wrong at a place of the document in the file. */
static void print_at(const char *file, const struct error *err, FILE *out)
{
    fprintf(out, "%s: ", file);
    error_print(err, out);
}

/* --- certificates --- */

struct proving {
    const char *file;
    struct algebra *algebra; /* NULL until one is needed */
    bool fit;                /* all so far */
};

static void tell(struct proving *proving, const char *place, const struct algebra_proof *proof)
{
    const bool checked = proof->verdict != SURFACE_NOT_CHECKED;
    FILE *out = checked ? stdout : stderr;

    const cJSON *covered = cJSON_GetObjectItemCaseSensitive(proof->coverage, "text");

    fprintf(out, "%s%s: %s: %s: %s%s%s\n", checked ? "" : "fieldcast: warning: ", proving->file,
            place, surface_verdicts[proof->verdict], proof->reason, covered ? "; " : "",
            covered ? covered->valuestring : "");
    proving->fit = proving->fit && proof->verdict != SURFACE_DOES_NOT_FIT;
}

static void prove(struct proving *proving, const struct node *node)
{
    struct error err = {0};
    struct algebra_proof proof = {.verdict = SURFACE_NOT_CHECKED};
    char place[ERROR_PLACE_BYTES];

    snprintf(place, sizeof place, "/nodes/%s/params/parametric", node->id);
    if (!proving->algebra) {
        proving->algebra = algebra_create(&err);
    }
    if (!proving->algebra || !algebra_verify(proving->algebra, &node->params, &proof, &err)) {
        snprintf(proof.reason, sizeof proof.reason, "%s", err.message);
    }
    tell(proving, place, &proof);
    cJSON_Delete(proof.coverage);
}

static void prove_tree(struct proving *proving, const struct node *top)
{
    for (const struct node *node = top; node; node = node_next(node, top)) {
        if (record_type_find(node->params.type, "parametric") >= 0 &&
            strcmp(record_text(&node->params, "parametric"), "{}") != 0) {
            prove(proving, node);
        }
    }
}

/* False where the equation of one is not that of its surface. */
static bool prove_all(const char *file, const struct scene *scene)
{
    struct proving proving = {.file = file, .fit = true};

    prove_tree(&proving, scene->root);
    for (size_t i = 0; i < scene->models.count; i++) {
        prove_tree(&proving, scene->models.items[i]->root);
    }
    if (proving.algebra) {
        algebra_stop(proving.algebra);
        algebra_destroy(proving.algebra);
    }
    return proving.fit;
}

/* --- equations --- */

/* A warning where more is drawn than the equation has. */
static void tell_quality(void *data, const struct equation_quality *quality)
{
    const bool wall = quality->kind == QUALITY_POLE || quality->kind == QUALITY_JUMP;
    const bool unsafe = wall || quality->thin || quality->left_out > 0;
    char text[QUALITY_TEXT_BYTES];

    if (quality->kind != QUALITY_UNKNOWN) {
        fprintf(unsafe ? stderr : stdout, "%s%s: %s: %s%s\n", unsafe ? "fieldcast: warning: " : "",
                (const char *)data, quality->place, equation_quality_text(quality, text),
                wall ? "; the sign changes there and a wall is drawn" : "");
    }
}

/* --- documents --- */

static void warn(const char *file, const struct error *warning)
{
    fputs("fieldcast: warning: ", stderr);
    print_at(file, warning, stderr);
}

/* A document names its picture, which is a file of its own. */
static void warn_of_picture(const char *file, const struct scene *scene)
{
    struct error warning = {0};
    const char *image = record_text(&scene->environment, "image");

    if (record_number(&scene->environment, "type") == SKY_IMAGE && !example_files_find(image)) {
        error_set(&warning, ERROR_NOT_FOUND, "/environment/image",
                  "the document needs the file with the SHA-256 %s, which is not looked at", image);
        warn(file, &warning);
    }
}

static bool check(const char *name)
{
    struct error err = {0}, warning = {0};
    struct scene *scene = scene_open(name, &err);
    bool ok = scene && renderer_check(scene, &warning, &err);

    if (!scene) {
        error_print(&err, stdout);
    } else if (!ok) {
        print_at(name, &err, stdout);
    } else if (warning.kind != ERROR_NONE) {
        warn(name, &warning);
    }
    if (scene) {
        warn_of_picture(name, scene);
    }
    if (ok) {
        field_qualities(scene, NULL, tell_quality, (void *)name);
    }
    ok = scene && prove_all(name, scene) && ok;
    scene_destroy(scene);
    return ok;
}

int command_check(const struct options *options)
{
    int status = EXIT_OK;

    for (int i = 0; i < options->operand_count; i++) {
        status = check(options->operands[i]) ? status : EXIT_FAILED;
    }
    return status;
}
