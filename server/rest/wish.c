/* SPDX-License-Identifier: MIT */
#include "wish.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "renderer/renderer.h"

enum { PLACE_BYTES = 100 };

static void wish_init(struct wish *wish)
{
    *wish = (struct wish){0};
    record_init(&wish->picture, &picture_type);
}

void wish_finish(struct wish *wish)
{
    record_finish(&wish->picture);
    cJSON_Delete(wish->camera);
    wish->camera = NULL;
}

static int whole(const struct wish *wish, const char *name)
{
    return (int)record_number(&wish->picture, name);
}

/* --- what the table cannot say --- */

static bool set_format(struct wish *wish, const char *name, enum error_kind kind, const char *place,
                       struct error *err)
{
    wish->format = image_format_find(name);
    return wish->format >= 0 || error_set(err, kind, place, "%.40s is not png, jpg or npy", name);
}

static bool check_region(const struct wish *wish, const char *place, struct error *err)
{
    const double *region = record_vector(&wish->picture, "region");

    for (int i = 0; i < 4; i++) {
        if (region[i] != floor(region[i])) {
            return error_set(err, ERROR_INVALID, place, "%g is not a whole number", region[i]);
        }
    }
    return true;
}

/* `prefix`: how places of members begin. */
static bool check(struct wish *wish, const char *prefix, struct error *err)
{
    const char *outputs = record_text(&wish->picture, "aov");
    char place[PLACE_BYTES];

    snprintf(place, sizeof(place), "%saov", prefix);
    if (!aovs_read(*outputs ? outputs : aov_name(AOV_COLOR), wish->aovs, place, err)) {
        return false;
    }
    snprintf(place, sizeof(place), "%sregion", prefix);
    return check_region(wish, place, err);
}

/* --- from a query --- */

static bool parse_numbers(const char *text, int count, double *out)
{
    for (int i = 0; i < count; i++) {
        char *end;

        /* strtod would take hexadecimal, blanks and names of infinities too. */
        if (!strchr("+-.0123456789", *text) || !*text || text[strcspn(text, "xXnN")] != '\0') {
            return false;
        }
        out[i] = strtod(text, &end);
        if (end == text || !isfinite(out[i]) || *end != (i + 1 < count ? ',' : '\0')) {
            return false;
        }
        text = end + 1;
    }
    return true;
}

static cJSON *parse_bool(const char *text)
{
    const bool yes = strcmp(text, "true") == 0 || strcmp(text, "1") == 0;

    return yes || strcmp(text, "false") == 0 || strcmp(text, "0") == 0 ? cJSON_CreateBool(yes)
                                                                       : cJSON_CreateString(text);
}

/* The JSON of a value as the row's type wants it. */
static cJSON *parse_value(const struct param *param, const char *text, const char *place,
                          struct error *err)
{
    const int count = param_components(param->type);
    double numbers[4];

    if (param->type == PARAM_BOOL) {
        return parse_bool(text);
    }
    if (param->type == PARAM_ENUM || param_is_text(param->type)) {
        return cJSON_CreateString(text);
    }
    if (!parse_numbers(text, count, numbers)) {
        error_set(err, ERROR_INVALID, place, "%.60s is not %s%s", text,
                  count == 1 ? "a number" : "numbers with commas: ",
                  count == 1   ? ""
                  : count == 3 ? "x,y,z"
                               : "x,y,width,height");
        return NULL;
    }
    return count == 1 ? cJSON_CreateNumber(numbers[0]) : cJSON_CreateDoubleArray(numbers, count);
}

static bool query_member(struct wish *wish, const char *name, const char *text, struct error *err)
{
    const int of_picture = record_type_find(&picture_type, name);
    const int of_camera = record_type_find(&camera_type, name);
    char place[PLACE_BYTES];
    cJSON *json;
    bool ok = true;

    snprintf(place, sizeof(place), "?%.64s", name);
    if (of_picture < 0 && of_camera < 0) {
        return error_set(err, ERROR_INVALID, place, "there is no such parameter");
    }
    json = parse_value(of_picture >= 0 ? &picture_type.params[of_picture]
                                       : &camera_type.params[of_camera],
                       text, place, err);
    if (!json) {
        return false;
    }
    if (of_picture >= 0) {
        ok = record_read_value(&wish->picture, of_picture, json, place, err);
        cJSON_Delete(json);
    } else {
        wish->camera = wish->camera ? wish->camera : cJSON_CreateObject();
        cJSON_AddItemToObject(wish->camera, name, json);
    }
    return ok;
}

bool wish_from_query(struct wish *wish, const struct request *request, const char *format,
                     struct error *err)
{
    wish_init(wish);
    for (size_t i = 0; i < request->query_count; i++) {
        const char *name = request->query[i].name, *text = request->query[i].value;

        if (request_query(request, name) != text) {
            char place[PLACE_BYTES];

            snprintf(place, sizeof(place), "?%.64s", name);
            return error_set(err, ERROR_INVALID, place, "given twice");
        }
        if (!query_member(wish, name, text, err)) {
            return false;
        }
    }
    return set_format(wish, format, ERROR_NOT_FOUND, "?format", err) && check(wish, "?", err);
}

/* --- from JSON --- */

static bool json_member(struct wish *wish, const cJSON *member, struct error *err)
{
    const char *name = member->string;
    const char *text = cJSON_IsString(member) ? member->valuestring : "?";

    if (strcmp(name, "scene") == 0) {
        return true;
    }
    if (strcmp(name, "format") == 0) {
        return set_format(wish, text, ERROR_INVALID, "/format", err);
    }
    if (strcmp(name, "camera") == 0) {
        wish->camera = cJSON_Duplicate(member, true);
        return cJSON_IsObject(member) ||
               error_set(err, ERROR_INVALID, "/camera", "must be an object");
    }
    return record_read_member(&wish->picture, member, "", err);
}

bool wish_from_json(struct wish *wish, const cJSON *json, struct error *err)
{
    const cJSON *member;

    wish_init(wish);
    if (!cJSON_IsObject(json)) {
        return error_set(err, ERROR_SYNTAX, "", "the body must be an object");
    }
    cJSON_ArrayForEach(member, json)
    {
        if (!json_member(wish, member, err)) {
            return false;
        }
    }
    return check(wish, "/", err);
}

/* --- to the worker --- */

void wish_size(const struct wish *wish, int *out_width, int *out_height)
{
    const double *region = record_vector(&wish->picture, "region");

    *out_width = region[2] > 0 ? (int)region[2] : whole(wish, "width");
    *out_height = region[2] > 0 ? (int)region[3] : whole(wish, "height");
}

/* Adds the camera, unless it is the scene's as it is. */
static bool add_camera(cJSON *order, const struct wish *wish, const struct scene *scene,
                       bool whole_camera, struct error *err)
{
    struct record camera;
    const cJSON *member;
    bool ok = true;

    if (!wish->camera) {
        return true;
    }
    if (whole_camera) {
        record_init(&camera, &camera_type);
    } else {
        record_copy(&camera, &scene->camera);
    }
    cJSON_ArrayForEach(member, wish->camera)
    {
        int index = record_type_find(&camera_type, member->string);
        char place[PLACE_BYTES];

        snprintf(place, sizeof(place), "%s%.64s", whole_camera ? "/camera/" : "?", member->string);
        ok = ok && (index >= 0 ? record_set(&camera, index, member, place, err)
                               : error_set(err, ERROR_INVALID, place, "unknown member"));
    }
    if (ok) {
        record_print(&camera, cJSON_AddObjectToObject(order, "camera"));
    }
    record_finish(&camera);
    return ok;
}

/* What was not asked for is not said: the level and the scene decide then. */
static void add_picture(cJSON *order, const struct wish *wish)
{
    const double *region = record_vector(&wish->picture, "region");
    const int level = whole(wish, "level"), transparent = whole(wish, "transparent");
    char outputs[AOVS_TEXT_BYTES];

    cJSON_AddNumberToObject(order, "width", whole(wish, "width"));
    cJSON_AddNumberToObject(order, "height", whole(wish, "height"));
    if (region[2] > 0 || region[3] > 0) {
        cJSON_AddItemToObject(order, "region", cJSON_CreateDoubleArray(region, 4));
    }
    aovs_print(wish->aovs, outputs);
    cJSON_AddStringToObject(order, "aov", outputs);
    if (level >= 0) {
        cJSON_AddStringToObject(order, "level", quality_names[level]);
    }
    if (transparent >= 0) {
        cJSON_AddBoolToObject(order, "transparent", transparent);
    }
    cJSON_AddNumberToObject(order, "samples", whole(wish, "samples"));
    cJSON_AddStringToObject(order, "format", image_format_name((enum image_format)wish->format));
    cJSON_AddNumberToObject(order, "quality", whole(wish, "quality"));
    cJSON_AddBoolToObject(order, "exact", true);
}

cJSON *wish_order(const struct wish *wish, const struct scene *scene, bool whole_camera,
                  struct error *err)
{
    cJSON *order = cJSON_CreateObject();

    add_picture(order, wish);
    if (!add_camera(order, wish, scene, whole_camera, err)) {
        cJSON_Delete(order);
        return NULL;
    }
    return order;
}
