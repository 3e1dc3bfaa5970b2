/* SPDX-License-Identifier: MIT */
#include "portrait.h"

#include <math.h>
#include <string.h>

#include "protocol/json.h"
#include "protocol/messages.h"
#include "renderer/draw/camera.h"
#include "renderer/geometry.h"

/* A warm key light from the left above the camera, a cool one from the right that fills its
 * shadows, one from behind that draws the outline, and a bright room around. */
static const char SETTING[] =
    "{\"lights\":["
    "{\"type\":\"directional\",\"direction\":[0.3,-1,-0.75],\"color\":[1,0.96,0.9],"
    "\"intensity\":2.7,\"size\":10},"
    "{\"type\":\"directional\",\"direction\":[-1,-0.25,0.15],\"color\":[0.8,0.9,1],"
    "\"intensity\":0.6,\"shadow\":\"none\"},"
    "{\"type\":\"directional\",\"direction\":[0.5,-0.4,0.8],\"intensity\":1.3,"
    "\"shadow\":\"none\"}],"
    "\"environment\":{\"zenith\":[0.75,0.8,0.9],\"horizon\":[0.85,0.85,0.85],"
    "\"ground\":[0.3,0.29,0.28],\"sun\":false},"
    "\"render\":{\"level\":\"still\",\"samples\":3,\"transparent\":true}}";

static const double TOWARDS_EYE[3] = {0.5, 0.42, 0.757};

enum {
    COLUMNS = 24, /* rays that look for the outline */
    ROWS = 16,
    PASSES = 3,
    STEPS = 64,           /* of a ray */
    WORK = 8000000,       /* operations of all rays, about */
    BOX_HALF = 2,         /* of what has no end at all */
    BOX_OF_THICKNESS = 6, /* half of the box of what has no end, for each unit of half the rest */
};
static const double FOV = 22;      /* degrees */
static const double GROUND = 0.02; /* around what stands on it, of its length and depth */
static const double MARGIN = 1.08; /* around the outline */

/* --- what has no end --- */

/* The box of what has an end, else one around its middle. */
static struct bounds cut_bounds(struct bounds box)
{
    double half = 0;

    for (int i = 0; i < 3; i++) {
        if (isfinite(box.low[i]) && isfinite(box.high[i])) {
            half = fmax(half, (box.high[i] - box.low[i]) / 2);
        }
    }
    half = fmax(BOX_HALF, BOX_OF_THICKNESS * half);
    for (int i = 0; i < 3; i++) {
        const bool low = isfinite(box.low[i]), high = isfinite(box.high[i]);

        if (!low) {
            box.low[i] = high ? box.high[i] - half / 4 : -half;
        }
        if (!high) {
            box.high[i] = low ? box.low[i] + half / 4 : half;
        }
    }
    return box;
}

static cJSON *make_box(const struct bounds *bounds)
{
    cJSON *box = cJSON_CreateObject();
    cJSON *transform = cJSON_AddObjectToObject(box, "transform");
    cJSON *params = cJSON_AddObjectToObject(box, "params");
    double middle[3], size[3];

    for (int i = 0; i < 3; i++) {
        middle[i] = (bounds->low[i] + bounds->high[i]) / 2;
        size[i] = fmax(bounds->high[i] - bounds->low[i], 1e-3);
    }
    cJSON_AddStringToObject(box, "type", "box");
    cJSON_AddItemToObject(transform, "translation", cJSON_CreateDoubleArray(middle, 3));
    cJSON_AddItemToObject(params, "size", cJSON_CreateDoubleArray(size, 3));
    return box;
}

/* The document's root becomes its intersection with a box, of the same material. */
static void cut(cJSON *document, const struct bounds *bounds)
{
    cJSON *root = cJSON_DetachItemFromObjectCaseSensitive(document, "root");
    cJSON *whole = cJSON_CreateObject(), *children;
    const cJSON *material = cJSON_GetObjectItemCaseSensitive(root, "material");

    cJSON_AddStringToObject(whole, "type", "intersection");
    if (material) {
        cJSON_AddItemToObject(whole, "material", cJSON_Duplicate(material, true));
    }
    children = cJSON_AddArrayToObject(whole, "children");
    cJSON_AddItemToArray(children, root);
    cJSON_AddItemToArray(children, make_box(bounds));
    cJSON_AddItemToObject(document, "root", whole);
}

/* --- where the camera stands --- */

struct aim {
    double target[3], distance; /* of the eye, which is at TOWARDS_EYE */
};

static void aim_record(const struct aim *aim, struct record *camera)
{
    cJSON *json = cJSON_CreateObject();
    double eye[3];

    for (int i = 0; i < 3; i++) {
        eye[i] = aim->target[i] + aim->distance * TOWARDS_EYE[i];
    }
    cJSON_AddItemToObject(json, "position", cJSON_CreateDoubleArray(eye, 3));
    cJSON_AddItemToObject(json, "target", cJSON_CreateDoubleArray(aim->target, 3));
    cJSON_AddNumberToObject(json, "fov", FOV);
    record_read(camera, json, "/camera", NULL); /* too far away: it stays where it is */
    cJSON_Delete(json);
}

/* What rays have met. */
struct outline {
    double low[2], high[2]; /* in cells */
    double near, far;       /* along the view */
};

static void add_hit(struct outline *outline, int column, int row, double depth)
{
    outline->low[0] = fmin(outline->low[0], column);
    outline->low[1] = fmin(outline->low[1], row);
    outline->high[0] = fmax(outline->high[0], column + 1);
    outline->high[1] = fmax(outline->high[1], row + 1);
    outline->near = fmin(outline->near, depth);
    outline->far = fmax(outline->far, depth);
}

/* A ray meets what comes as near as half a cell, so that nothing is passed over. False: there is
 * nothing, or no time to look. */
static bool find_outline(const struct geometry *geometry, const struct camera *camera,
                         double distance, struct outline *out)
{
    const double cell = 2 * tan(FOV * M_PI / 360) / ROWS;
    const uint64_t work = geometry_work(geometry) * STEPS * COLUMNS * ROWS;
    const struct section none = {0};
    struct geometry_ray ray = {.section = &none,
                               .max_distance = 3 * distance,
                               .tolerance = cell / 2 * distance,
                               .max_steps = STEPS};

    *out = (struct outline){{COLUMNS, ROWS}, {0, 0}, INFINITY, 0};
    if (work / 4 > WORK) { /* most rays take few steps */
        return false;
    }
    for (int row = 0; row < ROWS; row++) {
        for (int column = 0; column < COLUMNS; column++) {
            camera_ray(camera, COLUMNS, ROWS, column + 0.5, row + 0.5, ray.origin, ray.direction);
            const struct geometry_hit found = geometry_trace(geometry, &ray);
            if (found.hit) {
                add_hit(out, column, row, found.distance);
            }
        }
    }
    return out->far > 0;
}

/* Turns to the middle of the outline and comes so near that it fills the picture. */
static void follow(struct aim *aim, const struct outline *outline, const struct camera *camera)
{
    const double depth = (outline->near + outline->far) / 2;
    const double x = (outline->low[0] + outline->high[0]) / COLUMNS - 1;
    const double y = 1 - (outline->low[1] + outline->high[1]) / ROWS;
    const double part = fmax((outline->high[0] - outline->low[0]) / COLUMNS,
                             (outline->high[1] - outline->low[1]) / ROWS);

    for (int i = 0; i < 3; i++) {
        aim->target[i] = camera->eye[i] +
                         depth * (camera->forward[i] + x * camera->right[i] + y * camera->up[i]);
    }
    /* What is nearer than the middle looks larger. */
    aim->distance = MARGIN * part * depth + (depth - outline->near) * (1 - part);
}

static struct aim find_aim(const struct geometry *geometry)
{
    const struct bounds bounds = geometry_bounds(geometry);
    struct aim aim;
    struct record record;
    const double radius = bounds_sphere(&bounds, aim.target);

    aim.distance = fmax(radius, 1e-3) / sin(FOV * M_PI / 360);
    record_init(&record, &camera_type);
    for (int pass = 0; pass < PASSES; pass++) {
        struct outline outline;

        aim_record(&aim, &record);
        const struct camera camera = camera_from_record(&record, COLUMNS, ROWS);
        if (!find_outline(geometry, &camera, aim.distance, &outline)) {
            break;
        }
        follow(&aim, &outline, &camera);
    }
    record_finish(&record);
    return aim;
}

/* --- portraits --- */

static void add_setting(cJSON *document)
{
    cJSON *setting = json_parse(SETTING, sizeof SETTING - 1, NULL);

    while (setting->child) {
        cJSON *item = cJSON_DetachItemViaPointer(setting, setting->child);

        cJSON_AddItemToObject(document, item->string, item);
    }
    cJSON_Delete(setting);
}

/* Hides the planes, on which scenes stand. */
static void hide_planes(cJSON *node)
{
    cJSON *child;

    if (strcmp(json_member_text(node, "type", ""), "plane") == 0) {
        cJSON_DeleteItemFromObjectCaseSensitive(node, "visible");
        cJSON_AddFalseToObject(node, "visible");
    }
    cJSON_ArrayForEach(child, cJSON_GetObjectItemCaseSensitive(node, "children"))
    {
        hide_planes(child);
    }
}

static struct scene *read_scene(const cJSON *document, struct geometry *out_geometry,
                                struct error *err)
{
    struct scene *scene = scene_read(document, err);

    if (!scene || !geometry_init(out_geometry, scene, &(struct field_options){0}, err)) {
        scene_destroy(scene);
        return NULL;
    }
    return scene;
}

/* Of what has no end: the box of what stands on its planes, with some ground around it, or one in
 * its middle. */
static struct bounds find_box(const cJSON *document, const struct bounds *whole)
{
    cJSON *standing = cJSON_Duplicate(document, true);
    struct geometry geometry;

    hide_planes(cJSON_GetObjectItemCaseSensitive(standing, "root"));
    struct scene *scene = read_scene(standing, &geometry, NULL);
    struct bounds box = scene ? geometry_bounds(&geometry) : bounds_empty();
    const bool stands = !bounds_is_empty(&box) && bounds_is_finite(&box);
    if (stands) {
        box = bounds_grow(box, GROUND * (box.high[0] - box.low[0] + box.high[2] - box.low[2]));
    } else {
        box = cut_bounds(*whole);
    }
    if (scene) {
        geometry_finish(&geometry);
        scene_destroy(scene);
    }
    cJSON_Delete(standing);
    return box;
}

struct scene *portrait_scene(cJSON *document, struct error *err)
{
    struct geometry geometry;

    add_setting(document);
    struct scene *scene = read_scene(document, &geometry, err);
    struct bounds bounds = scene ? geometry_bounds(&geometry) : bounds_empty();
    if (scene && !bounds_is_empty(&bounds) && !bounds_is_finite(&bounds)) {
        const struct bounds box = find_box(document, &bounds);

        geometry_finish(&geometry);
        scene_destroy(scene);
        cut(document, &box);
        scene = read_scene(document, &geometry, err);
        bounds = scene ? geometry_bounds(&geometry) : bounds;
    }
    if (!scene) {
        return NULL;
    }
    if (bounds_is_empty(&bounds)) {
        error_set(err, ERROR_INVALID, "/root", "it shows nothing");
        scene_destroy(scene);
        scene = NULL;
    } else {
        const struct aim aim = find_aim(&geometry);

        aim_record(&aim, &scene->camera);
        record_put(&scene->render, "max_distance", fmin(4 * aim.distance, LIMIT_COORDINATE));
    }
    geometry_finish(&geometry);
    return scene;
}
