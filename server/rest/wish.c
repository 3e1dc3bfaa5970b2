/* SPDX-License-Identifier: MIT */
#include "wish.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/messages.h"
#include "renderer/renderer.h"

enum { PLACE_BYTES = 100 };

/* What stands before the members of a camera in a query; so its height is not the picture's. */
static const char camera_prefix[] = "camera.";

void wish_finish(struct wish *wish)
{
    cJSON_Delete(wish->picture);
    cJSON_Delete(wish->camera);
    *wish = (struct wish){0};
}

static bool set_member(struct wish *wish, int index, const cJSON *json, const char *place,
                       struct error *err)
{
    const struct param *param = &picture_type.params[index];
    double numbers[4];

    if (!param_read(param, json, numbers, place, err)) {
        return false;
    }
    cJSON_AddItemToObject(wish->picture, param->name, cJSON_Duplicate(json, true));
    return true;
}

/* --- what the table cannot say --- */

static bool set_format(struct wish *wish, const char *name, enum error_kind kind, const char *place,
                       struct error *err)
{
    wish->format = image_format_find(name);
    return wish->format >= 0 || error_set(err, kind, place, "%.40s is not png, jpg or npy", name);
}

/* That it lies inside of the picture is known where the picture is. */
static bool check_region(const struct wish *wish, const char *place, struct error *err)
{
    const cJSON *region = cJSON_GetObjectItemCaseSensitive(wish->picture, "region"), *part;

    cJSON_ArrayForEach(part, region)
    {
        if (part->valuedouble != floor(part->valuedouble)) {
            return error_set(err, ERROR_INVALID, place, "%g is not a whole number",
                             part->valuedouble);
        }
    }
    if (region && (cJSON_GetArrayItem(region, 2)->valueint < 1 ||
                   cJSON_GetArrayItem(region, 3)->valueint < 1)) {
        return error_set(err, ERROR_INVALID, place, "holds no pixel");
    }
    return true;
}

/* `prefix`: how places of members begin. */
static bool check(struct wish *wish, const char *prefix, struct error *err)
{
    const char *outputs = json_member_text(wish->picture, "aov", aov_name(AOV_COLOR));
    char place[PLACE_BYTES];

    snprintf(place, sizeof(place), "%saov", prefix);
    if (!aovs_read(outputs, wish->aovs, place, err)) {
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

static cJSON *parse_bool(const char *text, const char *place, struct error *err)
{
    const int yes = switch_find(text);

    if (yes < 0) {
        error_set(err, ERROR_INVALID, place, "%.40s is none of true, false, on, off", text);
        return NULL;
    }
    return cJSON_CreateBool(yes);
}

/* The JSON of a value as the row's type wants it. */
static cJSON *parse_value(const struct param *param, const char *text, const char *place,
                          struct error *err)
{
    const int count = param_components(param->type);
    double numbers[4];

    if (param->type == PARAM_BOOL) {
        return parse_bool(text, place, err);
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

static bool query_picture(struct wish *wish, int index, const char *text, const char *place,
                          struct error *err)
{
    cJSON *json = parse_value(&picture_type.params[index], text, place, err);
    const bool ok = json && set_member(wish, index, json, place, err);

    cJSON_Delete(json);
    return ok;
}

/* Checked by the camera that it changes. */
static bool query_camera(struct wish *wish, int index, const char *text, const char *place,
                         struct error *err)
{
    const struct param *param = &camera_type.params[index];
    cJSON *json = parse_value(param, text, place, err);

    if (json) {
        wish->camera = wish->camera ? wish->camera : cJSON_CreateObject();
        cJSON_AddItemToObject(wish->camera, param->name, json);
    }
    return json != NULL;
}

static bool query_member(struct wish *wish, const char *name, const char *text, struct error *err)
{
    const size_t skipped = sizeof(camera_prefix) - 1;
    const bool of_camera = strncmp(name, camera_prefix, skipped) == 0;
    const int index = of_camera ? record_type_find(&camera_type, name + skipped)
                                : record_type_find(&picture_type, name);
    char place[PLACE_BYTES];

    snprintf(place, sizeof(place), "?%.64s", name);
    if (index >= 0) {
        return of_camera ? query_camera(wish, index, text, place, err)
                         : query_picture(wish, index, text, place, err);
    }
    if (record_type_find(&camera_type, name) >= 0) {
        return error_set(err, ERROR_INVALID, place,
                         "there is no such parameter; did you mean \"%s%.40s\"?", camera_prefix,
                         name);
    }
    return error_set(err, ERROR_INVALID, place, "there is no such parameter");
}

bool wish_from_query(struct wish *wish, const struct request *request, const char *format,
                     struct error *err)
{
    *wish = (struct wish){.picture = cJSON_CreateObject()};
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
    char place[ERROR_PLACE_BYTES];
    int index;

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
    error_place(place, "", name);
    index = record_type_find(&picture_type, name);
    return index >= 0 ? set_member(wish, index, member, place, err)
                      : record_type_unknown(&picture_type, name, place, err);
}

bool wish_from_json(struct wish *wish, const cJSON *json, struct error *err)
{
    const cJSON *member;

    *wish = (struct wish){.picture = cJSON_CreateObject(), .from_json = true};
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
    const cJSON *region = cJSON_GetObjectItemCaseSensitive(wish->picture, "region");

    if (region) {
        *out_width = cJSON_GetArrayItem(region, 2)->valueint;
        *out_height = cJSON_GetArrayItem(region, 3)->valueint;
    } else {
        *out_width = (int)json_member_number(wish->picture, "width", PICTURE_WIDTH);
        *out_height = (int)json_member_number(wish->picture, "height", PICTURE_HEIGHT);
    }
}

static bool change_camera(const struct wish *wish, const cJSON *member, struct record *camera,
                          struct error *err)
{
    const int index = record_type_find(&camera_type, member->string);
    char place[PLACE_BYTES];

    snprintf(place, sizeof(place), "%s%.64s", wish->from_json ? "/camera/" : "?camera.",
             member->string);
    return index >= 0 ? record_read_value(camera, index, member, place, err)
                      : record_type_unknown(&camera_type, member->string, place, err);
}

/* Adds the camera, unless it is the scene's as it is. */
static bool add_camera(cJSON *order, const struct wish *wish, const struct scene *scene,
                       struct error *err)
{
    struct record camera;
    const cJSON *member;
    bool ok = true;

    if (!wish->camera) {
        return true;
    }
    record_copy(&camera, &scene->camera);
    cJSON_ArrayForEach(member, wish->camera)
    {
        ok = ok && change_camera(wish, member, &camera, err);
    }
    if (ok) {
        record_print(&camera, cJSON_AddObjectToObject(order, "camera"));
    }
    record_finish(&camera);
    return ok;
}

static void set_number(cJSON *object, const char *name, double fallback)
{
    if (!cJSON_HasObjectItem(object, name)) {
        cJSON_AddNumberToObject(object, name, fallback);
    }
}

/* What was not asked for is not said: the level and the scene decide then. */
cJSON *wish_order(const struct wish *wish, const struct scene *scene, struct error *err)
{
    cJSON *order = cJSON_Duplicate(wish->picture, true);
    char outputs[AOVS_TEXT_BYTES];

    set_number(order, "width", PICTURE_WIDTH);
    set_number(order, "height", PICTURE_HEIGHT);
    aovs_print(wish->aovs, outputs);
    cJSON_DeleteItemFromObjectCaseSensitive(order, "aov");
    cJSON_AddStringToObject(order, "aov", outputs);
    cJSON_AddStringToObject(order, "format", image_format_name((enum image_format)wish->format));
    cJSON_AddBoolToObject(order, "exact", true);
    if (!add_camera(order, wish, scene, err)) {
        cJSON_Delete(order);
        return NULL;
    }
    return order;
}
