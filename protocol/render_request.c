/* SPDX-License-Identifier: MIT */
#include "render_request.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "limits.h"
#include "nodes.h"

/* clang-format off */
const struct record_type delivery_type = {"delivery", "How a picture comes to who asked for it.",
    (const struct param[]){
    {"exact", PARAM_BOOL, .doc = "Waits for the newest revision."},
    {"in_rounds", PARAM_BOOL, .doc = "Several pictures, of ever more samples."},
    {"sparse", PARAM_BOOL, .doc = "Fewer rays than pixels, where these are alike."},
    {"chroma_halved", PARAM_BOOL, .doc = "JPEG with a quarter of the colours."},
    {"fast", PARAM_BOOL, .doc = "PNG that is quick to write."},
    {"zipped", PARAM_BOOL, .doc = "A ZIP also of one picture."},
    {"guide", PARAM_BOOL, .doc = "A guide instead of pictures; of the output id, raw."},
    {"depths", PARAM_BOOL, .doc = "Depths of its blocks behind the picture; of color and depth."},
    {"stream", PARAM_TEXT, .doc = "Name of the stream that goes on with it."},
    {"base", PARAM_INT, .min = 0, .max = 2147483647,
     .doc = "The order of the last picture that the client has of the stream; 0: none."},
    {"whole", PARAM_BOOL, .doc = "Behind a difference from that the whole picture too."},
    {.name = NULL}}};
/* clang-format on */

void render_request_init(struct render_request *request)
{
    *request = (struct render_request){.codec = CODEC_PNG};
    record_init(&request->picture, &picture_type);
    record_init(&request->camera, &camera_type);
    record_init(&request->section, &section_type);
    record_init(&request->delivery, &delivery_type);
}

void render_request_finish(struct render_request *request)
{
    record_finish(&request->picture);
    record_finish(&request->camera);
    record_finish(&request->section);
    record_finish(&request->delivery);
    id_set_finish(&request->isolate);
}

void render_request_copy(struct render_request *to, const struct render_request *from)
{
    to->codec = from->codec;
    record_copy(&to->picture, &from->picture);
    record_copy(&to->camera, &from->camera);
    record_copy(&to->section, &from->section);
    record_copy(&to->delivery, &from->delivery);
    id_set_copy(&to->isolate, &from->isolate);
}

bool render_request_equal(const struct render_request *a, const struct render_request *b)
{
    return a->codec == b->codec && record_equal(&a->picture, &b->picture) &&
           record_equal(&a->camera, &b->camera) && record_equal(&a->section, &b->section) &&
           record_equal(&a->delivery, &b->delivery) && id_set_equal(&a->isolate, &b->isolate);
}

/* --- places --- */

static const struct {
    const char *start;
    char separator; /* between "camera" or "section" and its member */
} forms[] = {
    [REQUEST_JSON] = {"/", '/'}, [REQUEST_QUERY] = {"?", '.'}, [REQUEST_OPTION] = {"--", '-'}};

static const char *place_of(char out[ERROR_PLACE_BYTES], enum request_form form, const char *name)
{
    if (form == REQUEST_JSON) {
        return error_place(out, "", name);
    }
    snprintf(out, ERROR_PLACE_BYTES, "%s%.64s", forms[form].start, name);
    return out;
}

/* --- a member from its text --- */

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

static bool set_text(struct record *record, int index, const char *text, const char *place,
                     struct error *err)
{
    cJSON *json = parse_value(&record->type->params[index], text, place, err);
    const bool ok = json && record_set(record, index, json, place, err);

    cJSON_Delete(json);
    return ok;
}

bool render_request_set_text(struct render_request *request, enum request_form form,
                             const char *name, const char *text, struct error *err)
{
    const char separator = forms[form].separator;
    struct record *record = &request->picture, *const parts[] = {&request->camera,
                                                                 &request->section};
    const char *member = name, *meant = NULL;
    char place[ERROR_PLACE_BYTES];

    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        const size_t length = strlen(parts[i]->type->name);

        if (strncmp(name, parts[i]->type->name, length) == 0 && name[length] == separator) {
            record = parts[i];
            member = name + length + 1;
        }
        meant = record_type_find(parts[i]->type, name) >= 0 ? parts[i]->type->name : meant;
    }
    const int index = record_type_find(record->type, member);
    place_of(place, form, name);
    if (index >= 0) {
        return set_text(record, index, text, place, err);
    }
    return meant ? error_set(err, ERROR_INVALID, place,
                             "there is no such parameter; did you mean \"%s%c%.40s\"?", meant,
                             separator, name)
                 : error_set(err, ERROR_INVALID, place, "there is no such parameter");
}

/* --- from JSON --- */

static bool read_format(struct render_request *request, const cJSON *json, struct error *err)
{
    const char *word = cJSON_IsString(json) ? json->valuestring : "?";

    request->codec = codec_find(word);
    return request->codec ||
           error_set(err, ERROR_INVALID, "/format", "%.40s is not " CODEC_CHOICES, word);
}

static bool read_member(struct render_request *request, const cJSON *member, struct error *err)
{
    if (strcmp(member->string, "format") == 0) {
        return read_format(request, member, err);
    }
    if (strcmp(member->string, "camera") == 0) {
        return record_read(&request->camera, member, "/camera", err);
    }
    if (strcmp(member->string, "section") == 0) {
        return record_read(&request->section, member, "/section", err);
    }
    return record_read_member(&request->picture, member, "", err);
}

bool render_request_read(struct render_request *request, const cJSON *object, struct error *err)
{
    const cJSON *member;

    cJSON_ArrayForEach(member, object)
    {
        if (!read_member(request, member, err)) {
            return false;
        }
    }
    return true;
}

/* --- what the rows cannot say --- */

/* That it lies inside of the picture is known where the picture is. */
static bool check_region(const struct record *picture, const char *place, struct error *err)
{
    const double *region = record_vector(picture, "region");

    if (!record_is_set(picture, "region")) {
        return true;
    }
    for (int i = 0; i < 4; i++) {
        if (region[i] != floor(region[i])) {
            return error_set(err, ERROR_INVALID, place, "%g is not a whole number", region[i]);
        }
    }
    return (region[2] >= 1 && region[3] >= 1) ||
           error_set(err, ERROR_INVALID, place, "holds no pixel");
}

/* Light is the output color's alone. */
static bool check_light(const struct render_request *request, const bool outputs[AOV_COUNT],
                        const char *place, struct error *err)
{
    for (int i = 0; request->codec == CODEC_HDR && i < AOV_COUNT; i++) {
        if (outputs[i] && i != AOV_COLOR) {
            return error_set(err, ERROR_INVALID, place, "%s is no light: format npy",
                             aov_name((enum aov)i));
        }
    }
    return true;
}

static const char *outputs_text(const struct record *picture)
{
    return record_is_set(picture, "aov") ? record_text(picture, "aov") : aov_name(AOV_COLOR);
}

bool render_request_check(struct render_request *request, enum request_form form, struct error *err)
{
    struct record *picture = &request->picture;
    bool outputs[AOV_COUNT];
    char place[ERROR_PLACE_BYTES], text[AOVS_TEXT_BYTES];

    if (!aovs_read(outputs_text(picture), outputs, place_of(place, form, "aov"), err) ||
        !check_light(request, outputs, place, err) ||
        !check_region(picture, place_of(place, form, "region"), err)) {
        return false;
    }
    aovs_print(outputs, text);
    record_put_text(picture, "aov", text);
    record_put(picture, "width", record_number(picture, "width"));
    record_put(picture, "height", record_number(picture, "height"));
    return true;
}

/* --- for the worker --- */

cJSON *render_request_print(const struct render_request *request)
{
    cJSON *object = cJSON_CreateObject();

    record_print(&request->picture, object);
    cJSON_AddStringToObject(object, "format", codec_name(request->codec));
    record_print(&request->camera, cJSON_AddObjectToObject(object, "camera"));
    record_print(&request->section, cJSON_AddObjectToObject(object, "section"));
    record_print(&request->delivery, cJSON_AddObjectToObject(object, "delivery"));
    cJSON_AddItemToObject(object, "isolate", id_set_print(&request->isolate));
    return object;
}

bool render_request_unpack(struct render_request *request, const cJSON *object, struct error *err)
{
    const cJSON *member;

    cJSON_ArrayForEach(member, object)
    {
        const bool ok =
            strcmp(member->string, "delivery") == 0
                ? record_read(&request->delivery, member, "/delivery", err)
            : strcmp(member->string, "isolate") == 0
                ? id_set_read(&request->isolate, member, LIMIT_ISOLATED, "/isolate", err)
                : read_member(request, member, err);
        if (!ok) {
            return false;
        }
    }
    return render_request_check(request, REQUEST_JSON, err);
}

/* --- what it says --- */

void render_request_see_from(struct render_request *request, const struct record *camera)
{
    struct record whole;

    if (record_is_empty(&request->camera)) {
        return;
    }
    record_copy(&whole, camera);
    record_merge(&whole, &request->camera);
    record_finish(&request->camera);
    request->camera = whole;
}

void render_request_outputs(const struct render_request *request, bool out[AOV_COUNT])
{
    aovs_read(outputs_text(&request->picture), out, "", NULL);
}

void render_request_size(const struct render_request *request, int *out_width, int *out_height)
{
    const double *region = record_vector(&request->picture, "region");
    const bool part = record_is_set(&request->picture, "region");

    *out_width = part ? (int)region[2] : render_request_int(request, "width");
    *out_height = part ? (int)region[3] : render_request_int(request, "height");
}

int64_t render_request_pixels(const struct render_request *request)
{
    return (int64_t)render_request_int(request, "width") * render_request_int(request, "height");
}

int render_request_int(const struct render_request *request, const char *name)
{
    return (int)record_number(&request->picture, name);
}

bool render_request_is(const struct render_request *request, const char *name)
{
    return record_number(&request->delivery, name) != 0;
}
