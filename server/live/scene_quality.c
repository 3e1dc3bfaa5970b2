/* SPDX-License-Identifier: MIT */
#include "scene_quality.h"

#include "hub_rooms.h"
#include "protocol/limits.h"
#include "protocol/scene.h"
#include "renderer/renderer.h"
#include "room_apart.h"
#include "server/net/shared_buffer.h"

static const char *const words[] = {
    [QUALITY_POLYNOMIAL] = "exact polynomial",
    [QUALITY_SAFE] = "safe",
    [QUALITY_POLE] = "unsafe",
    [QUALITY_JUMP] = "unsafe",
    [QUALITY_SAMPLED] = "sampled",
    [QUALITY_UNKNOWN] = "unknown",
};

/* A member of the list `data`. */
static void add(void *data, const struct equation_quality *quality)
{
    const bool pole = quality->kind == QUALITY_POLE, jump = quality->kind == QUALITY_JUMP;
    char text[QUALITY_TEXT_BYTES];
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "node", quality->node);
    cJSON_AddStringToObject(json, "place", quality->place);
    cJSON_AddStringToObject(json, "quality", words[quality->kind]);
    if (quality->degree >= 0) {
        cJSON_AddNumberToObject(json, "degree", quality->degree);
    }
    if (pole || jump) {
        cJSON_AddItemToObject(json, pole ? "pole" : "jump",
                              cJSON_CreateDoubleArray(quality->at, 3));
    }
    if (quality->kind == QUALITY_SAMPLED) {
        cJSON_AddNumberToObject(json, "patches", quality->patches);
        cJSON_AddNumberToObject(json, "left_out", quality->left_out);
        cJSON_AddNumberToObject(json, "error", quality->error);
        cJSON_AddBoolToObject(json, "thin", quality->thin);
        cJSON *box = cJSON_AddArrayToObject(json, "box");
        cJSON_AddItemToArray(box, cJSON_CreateDoubleArray(quality->box.low, 3));
        cJSON_AddItemToArray(box, cJSON_CreateDoubleArray(quality->box.high, 3));
    }
    cJSON_AddNumberToObject(json, "rays", quality->rays);
    cJSON_AddNumberToObject(json, "unresolved", quality->unresolved);
    cJSON_AddStringToObject(json, "text", equation_quality_text(quality, text));
    cJSON_AddItemToArray(data, json);
}

static bool is_judged(const struct node *node)
{
    return node->type->kind == KIND_EQUATION || node->type->kind == KIND_SURFACE;
}

static int count_equations(const struct node *top)
{
    int count = 0;

    for (const struct node *node = top; node; node = node_next(node, top)) {
        count += is_judged(node);
    }
    return count;
}

static bool check_count(const struct scene *scene, struct error *err)
{
    int count = count_equations(scene->root);

    for (size_t i = 0; i < scene->models.count; i++) {
        count += count_equations(scene->models.items[i]->root);
    }
    return count <= LIMIT_JUDGED_EQUATIONS ||
           error_set(err, ERROR_LIMIT, "?node",
                     "the scene has %d equations, above the maximum %d (judged_equations); "
                     "?node=ID asks for one",
                     count, LIMIT_JUDGED_EQUATIONS);
}

static bool check_node(const struct scene *scene, const char *id, struct error *err)
{
    const struct node *node = scene_find(scene, id);

    return (node && is_judged(node)) ||
           error_set(err, ERROR_NOT_FOUND, "?node", "there is no node %.64s with an equation", id);
}

/* A copy of the document as it is. */
static struct scene *take(struct hub *hub, const char *id, uint64_t *out_revision,
                          struct error *err)
{
    struct room *room = hub_lock_room(hub, id, err);

    if (!room) {
        return NULL;
    }
    struct shared_buffer *text = room_text(room);
    *out_revision = room->revision;
    hub_unlock(hub);
    struct scene *scene = scene_parse_printed((const char *)text->bytes, text->length - 1, err);
    shared_buffer_unref(text);
    return scene;
}

cJSON *scene_quality(struct hub *hub, const char *id, const char *node, struct error *err)
{
    uint64_t revision;
    struct scene *scene = take(hub, id, &revision, err);
    cJSON *json = NULL;

    if (scene && (node ? check_node(scene, node, err) : check_count(scene, err))) {
        json = cJSON_CreateObject();
        cJSON_AddNumberToObject(json, "revision", (double)revision);
        field_qualities(scene, node, add, cJSON_AddArrayToObject(json, "equations"));
    }
    scene_destroy(scene);
    return json;
}
