/* SPDX-License-Identifier: MIT */
/* The messages of a live connection: their tables, reading and describing them. The binary header
 * is frame_header.c. */
#include "messages.h"

#include <string.h>

#include "code_text.h"
#include "edit.h"
#include "json.h"
#include "limits.h"
#include "nodes.h"
#include "suggest.h"

enum member_kind {
    MEMBER_VALUE,
    MEMBER_CLIENT,
    MEMBER_KEY,
    MEMBER_RECORD,
    MEMBER_OPERATIONS,
    MEMBER_NODES,
    MEMBER_OBJECT
};

struct message_member {
    struct param param; /* of MEMBER_OBJECT and the like only name and doc; `max` ids of nodes */
    bool required;
    enum member_kind kind;
    size_t into;                      /* MEMBER_RECORD, MEMBER_NODES: offset in struct message */
    const struct record_type *record; /* MEMBER_RECORD */
};

struct message_type {
    const char *name;
    const char *doc;
    const struct message_member *members; /* ends with a row without a name */
};

#define MEMBERS(...) ((const struct message_member[]){__VA_ARGS__, {.param = {.name = NULL}}})
#define INTO(member) .into = offsetof(struct message, member)
#define EXACT_MAX 9007199254740991.0 /* whole numbers up to here are exact in JSON */
#define COUNT PARAM_INT, .min = 0, .max = EXACT_MAX
#define SMALL PARAM_INT, .min = 0, .max = 4294967295.0
#define SIDE PARAM_INT, .min = 1, .max = LIMIT_VIEW_SIDE
#define TILE                                                                                       \
    PARAM_INT, .min = THUMBNAIL_LEAST, .max = LIMIT_THUMBNAIL_WIDTH, .def = {THUMBNAIL_WIDTH}
#define AT PARAM_FLOAT, .min = 0, .max = LIMIT_VIEW_SIDE

static const char *const qualities[] = {"auto", "smooth", "sharp", NULL};
static const char *const levels[] = {"info", "warning", "error", NULL};
static const char *const refusals[] = {"too_slow", "crashed", NULL};

/* clang-format off */
#define EDIT_NUMBER {.param = {"edit", PARAM_INT, .min = 1, .max = EXACT_MAX, \
                      .doc = "Counts the edits, undos and redos of this client."}, .required = true}
/* Where in a text an error is. */
#define TEXT_PLACE \
    {.param = {"line", COUNT, .doc = "Line in the text at the place, from 1."}}, \
    {.param = {"column", COUNT, .doc = "Column in it, from 1."}}
#define SKIPPED \
    {.param = {"skipped", .doc = "Of an undo or redo: operations left out, since somebody else" \
                                 " has changed their places. An edit of them does them."}, \
     .kind = MEMBER_OPERATIONS}
#define REVISION {.param = {"revision", COUNT, .doc = "Revision of the scene."}, .required = true}

static const struct message_type client_messages[MESSAGE_COUNT] = {
    [MESSAGE_HELLO] = {"hello", "The first message.", MEMBERS(
        {.param = {"client", PARAM_TEXT, .doc = "8 to 64 of A-Z a-z 0-9 _ -: the author."},
         .required = true, .kind = MEMBER_CLIENT},
        {.param = {"key", PARAM_TEXT, .doc = "What welcome told this client: 32 of 0-9 a-f."},
         .kind = MEMBER_KEY},
        {.param = {"name", PARAM_TEXT, .doc = "Shown to others."}},
        {.param = {"revision", COUNT, .doc = "The last one known, to resume."}},
        {.param = {"epoch", PARAM_TEXT, .doc = "The one that the revision belongs to."}})},
    [MESSAGE_VIEW] = {"view", "What this client wants to see; only the newest counts.", MEMBERS(
        {.param = {"seq", SMALL, .doc = "Counts up; frames name the newest that they show."},
         .required = true},
        {.param = {"width", SIDE, .doc = "Device pixels."}, .required = true},
        {.param = {"height", SIDE, .doc = "Device pixels."}, .required = true},
        {.param = {"camera", .doc = "What differs from the document's; absent: nothing."},
         .kind = MEMBER_RECORD, INTO(view.camera), .record = &camera_type},
        {.param = {"aov", PARAM_ENUM, .choices = aov_picture_names, .doc = "Which output."}},
        {.param = {"quality", PARAM_ENUM, .choices = qualities,
          .doc = "Speed or sharpness in motion."}},
        {.param = {"visible", PARAM_BOOL, .def = {1}, .doc = "false stops frames."}},
        {.param = {"guides", PARAM_BOOL,
          .doc = "true: a frame at rest tells which node each pixel shows."}},
        {.param = {"depths", PARAM_BOOL,
          .doc = "true: a frame of a moving view tells how far its pixels are."}},
        {.param = {"deltas", PARAM_BOOL,
          .doc = "true: a frame may be what differs from an earlier one."}},
        {.param = {"isolate", .max = LIMIT_ISOLATED,
          .doc = "Ids: this client's pictures and picks show these nodes and what is below them."
                 " Absent, or none in the scene: all."},
         .kind = MEMBER_NODES, INTO(view.isolate)},
        {.param = {"section", .doc = "A plane that cuts this client's pictures and picks; absent:"
                                     " nothing is cut."},
         .kind = MEMBER_RECORD, INTO(view.section), .record = &section_type})},
    [MESSAGE_EDIT] = {"edit", "Changes the scene.", MEMBERS(
        EDIT_NUMBER,
        {.param = {"ops", .doc = "The operations."}, .required = true, .kind = MEMBER_OPERATIONS},
        {.param = {"group", PARAM_TEXT, .doc = "Edits of one group are one step of undo."}},
        {.param = {"label", PARAM_TEXT, .doc = "What the edit does, for people."}})},
    [MESSAGE_UNDO] = {"undo", "Undoes this author's newest step.", MEMBERS(EDIT_NUMBER)},
    [MESSAGE_REDO] = {"redo", "Redoes this author's newest step undone.", MEMBERS(EDIT_NUMBER)},
    [MESSAGE_PICK] = {"pick", "Asks what is under the pointer.", MEMBERS(
        {.param = {"pick", SMALL, .doc = "Comes back with the answer."}, .required = true},
        {.param = {"x", AT, .doc = "Pixels from the left."}, .required = true},
        {.param = {"y", AT, .doc = "Pixels from the top."}, .required = true},
        {.param = {"seq", SMALL, .doc = "The view meant."}},
        {.param = {"through", PARAM_BOOL,
          .doc = "true: what is behind it is listed too."}})},
    [MESSAGE_BOUNDS] = {"bounds", "Asks how large nodes are.", MEMBERS(
        {.param = {"bounds", SMALL, .doc = "Comes back with the answer."}, .required = true},
        {.param = {"nodes", .max = LIMIT_ISOLATED,
          .doc = "Their ids. Absent, or none in the scene: all."},
         .kind = MEMBER_NODES, INTO(nodes)})},
    [MESSAGE_ACK] = {"ack", "A frame was shown.", MEMBERS(
        {.param = {"frame", SMALL, .doc = "Its number."}, .required = true})},
    [MESSAGE_RETRY] = {"retry", "What was too slow, or crashed, is tried again.", MEMBERS(
        {.param = {"place", PARAM_TEXT, .doc = "Of the notice; absent: whatever it is."}})},
    [MESSAGE_THUMBNAILS] = {"thumbnails",
        "Whose thumbnails this client shows; only the newest counts.", MEMBERS(
        {.param = {"nodes", .max = LIMIT_THUMBNAILS,
          .doc = "Ids of nodes on screen. Those that the scene does not have are ignored."},
         .kind = MEMBER_NODES, INTO(nodes)},
        {.param = {"large", .max = LIMIT_THUMBNAILS, .doc = "The same, 8/3 as wide."},
         .kind = MEMBER_NODES, INTO(large)},
        {.param = {"materials", .max = LIMIT_THUMBNAILS, .doc = "Names of materials on screen."},
         .kind = MEMBER_NODES, INTO(materials)},
        {.param = {"width", TILE,
          .doc = "Device pixels of a small one; the height is 2/3 of it. Absent: 96."}})},
    [MESSAGE_ACK_THUMBNAILS] = {"ack_thumbnails", "Thumbnails were taken.", MEMBERS(
        {.param = {"number", SMALL, .doc = "Of their message."}, .required = true})},
};

static const struct message_type server_messages[] = {
    {"welcome", "Answers hello.", MEMBERS(
        {.param = {"session", PARAM_TEXT, .doc = "Name of this connection."}, .required = true},
        {.param = {"scene", PARAM_TEXT, .doc = "Id of the scene."}, .required = true},
        REVISION,
        {.param = {"epoch", PARAM_TEXT,
          .doc = "Revisions of different epochs have nothing in common."},
         .required = true},
        {.param = {"author", PARAM_TEXT, .doc = "What others are told of who this client is."},
         .required = true},
        {.param = {"key", PARAM_TEXT,
          .doc = "Secret of this client: who says its name has to show it."},
         .required = true},
        {.param = {"renderer", .doc = "name, version, software, stage, device."}, .required = true,
         .kind = MEMBER_OBJECT},
        {.param = {"last_edit", COUNT, .doc = "Newest edit of this client in the log; 0: none."},
         .required = true},
        {.param = {"undo", COUNT, .doc = "Steps of this client left to undo."}, .required = true},
        {.param = {"redo", COUNT, .doc = "Steps left to redo."}, .required = true},
        {.param = {"undo_labels", .doc = "Names of this client's newest steps, newest first."},
         .kind = MEMBER_OBJECT},
        {.param = {"redo_labels", .doc = "The same of steps that can be redone."},
         .kind = MEMBER_OBJECT},
        {.param = {"limits", .doc = "Limits by name."}, .required = true, .kind = MEMBER_OBJECT})},
    {"document", "Replaces everything.", MEMBERS(
        REVISION,
        {.param = {"document", .doc = "The scene document."},
         .required = true, .kind = MEMBER_OBJECT})},
    {"applied", "The author's edit is in; once more after its commit.", MEMBERS(
        EDIT_NUMBER, REVISION,
        {.param = {"durable", PARAM_BOOL, .doc = "Whether it is committed."}, .required = true},
        {.param = {"undo", COUNT, .doc = "Steps left to undo."}, .required = true},
        {.param = {"redo", COUNT, .doc = "Steps left to redo."}, .required = true},
        SKIPPED)},
    {"changed", "Somebody else's edit, or the result of one's own undo or redo.", MEMBERS(
        REVISION,
        {.param = {"author", PARAM_TEXT, .doc = "`author` of its welcome, or rest."},
         .required = true},
        {.param = {"ops", .doc = "The operations in canonical form."}, .required = true,
         .kind = MEMBER_OPERATIONS},
        {.param = {"edit", COUNT, .doc = "Only to the author: number of the undo or redo."}})},
    {"rejected", "An edit was refused; nothing was changed.", MEMBERS(
        EDIT_NUMBER,
        {.param = {"code", PARAM_TEXT, .doc = "Kind of error."}, .required = true},
        {.param = {"place", PARAM_TEXT, .doc = "Where."}, .required = true},
        {.param = {"message", PARAM_TEXT, .doc = "Why, with value and limit."}, .required = true},
        TEXT_PLACE, SKIPPED)},
    {"picked", "What is under the pointer; null where nothing is.", MEMBERS(
        {.param = {"pick", SMALL, .doc = "Number of the question."}, .required = true},
        REVISION,
        {.param = {"node", PARAM_TEXT, .doc = "Id of the node, or null."}, .required = true},
        {.param = {"position", PARAM_VEC3, .doc = "Where it was hit."}},
        {.param = {"normal", PARAM_VEC3, .doc = "Direction of the surface."}},
        {.param = {"distance", PARAM_FLOAT, .doc = "From the eye."}},
        {.param = {"through", .max = LIMIT_PICK_THROUGH,
          .doc = "Where it was asked for: ids of the shapes whose surfaces the ray passes, into"
                 " solids and out of them, the nearest first."},
         .kind = MEMBER_NODES})},
    {"bounded", "A box in the world around what is to be seen of nodes.", MEMBERS(
        {.param = {"bounds", SMALL, .doc = "Number of the question."}, .required = true},
        REVISION,
        {.param = {"low", PARAM_VEC3,
          .doc = "Least coordinates, or null: nothing is to be seen, or it has no end."}},
        {.param = {"high", PARAM_VEC3, .doc = "Greatest coordinates, or null."}})},
    {"compiling", "The newest state is being made ready; the picture is of an older one.", MEMBERS(
        REVISION,
        {.param = {"over", PARAM_BOOL, .doc = "It can be drawn, or never will be."},
         .required = true},
        {.param = {"elapsed_ms", COUNT, .doc = "How long it has taken so far."}, .required = true},
        {.param = {"expected_ms", COUNT,
          .doc = "How long scenes of that size took before; absent: that is not known."}})},
    {"notice", "Something to show.", MEMBERS(
        {.param = {"level", PARAM_ENUM, .choices = levels, .doc = "How bad it is."},
         .required = true},
        {.param = {"code", PARAM_TEXT, .doc = "What it is, for programs."}, .required = true},
        {.param = {"message", PARAM_TEXT, .doc = "What it is, for people."}, .required = true},
        {.param = {"place", PARAM_TEXT, .doc = "Where in the document."}},
        TEXT_PLACE,
        {.param = {"measured", COUNT,
          .doc = "Of what was too slow: milliseconds of processor time that it took, and more."}},
        {.param = {"limit", COUNT, .doc = "Milliseconds that it might take."}},
        {.param = {"reason", PARAM_ENUM, .choices = refusals,
          .doc = "Why a scene is left out."}})},
    {"bye", "The last message.", MEMBERS(
        {.param = {"reason", PARAM_TEXT, .doc = "Why the connection ends."}, .required = true},
        {.param = {"retry_ms", COUNT, .doc = "When to come back; absent: never."}})},
};
/* clang-format on */

const char *message_name(enum message_kind kind)
{
    return client_messages[kind].name;
}

/* --- reading --- */

static bool check_client(const cJSON *json, const char *place, struct error *err)
{
    const char *text = cJSON_IsString(json) ? json->valuestring : "";
    const size_t length = strlen(text);

    return (length >= 8 && record_name_valid(text) && !strchr(text, '.')) ||
           error_set(err, ERROR_INVALID, place, "expected 8 to %d of A-Z a-z 0-9 _ -",
                     LIMIT_ID_BYTES);
}

static bool check_key(const cJSON *json, const char *place, struct error *err)
{
    const char *text = cJSON_IsString(json) ? json->valuestring : "";

    return (strlen(text) == MESSAGE_KEY_CHARACTERS &&
            strspn(text, "0123456789abcdef") == MESSAGE_KEY_CHARACTERS) ||
           error_set(err, ERROR_INVALID, place, "expected %d of 0-9 a-f", MESSAGE_KEY_CHARACTERS);
}

static bool read_member(struct message *out, const struct message_member *member, const cJSON *json,
                        const char *place, struct error *err)
{
    void *into = (char *)out + member->into;
    double number[4];

    switch (member->kind) {
    case MEMBER_CLIENT:
        return check_client(json, place, err);
    case MEMBER_KEY:
        return check_key(json, place, err);
    case MEMBER_RECORD:
        return record_read(into, json, place, err);
    case MEMBER_OPERATIONS:
        return edit_check(json, err);
    case MEMBER_NODES:
        return id_set_read(into, json, (int)member->param.max, place, err);
    case MEMBER_OBJECT:
        return cJSON_IsObject(json) || error_set(err, ERROR_SYNTAX, place, "expected an object");
    case MEMBER_VALUE:
        break;
    }
    return param_read(&member->param, json, number, place, err);
}

static const struct message_member *find_member(const struct message_type *type, const char *name)
{
    for (const struct message_member *member = type->members; member->param.name; member++) {
        if (strcmp(member->param.name, name) == 0) {
            return member;
        }
    }
    return NULL;
}

static bool fail_member(const struct message_type *type, const char *name, const char *place,
                        struct error *err)
{
    struct suggestion suggestion = {.text = name};
    char hint[64];

    for (const struct message_member *member = type->members; member->param.name; member++) {
        suggest_consider(&suggestion, member->param.name);
    }
    return error_set(err, ERROR_SYNTAX, place, "\"%s\" has no member \"%.64s\"%s", type->name, name,
                     suggest_hint(&suggestion, hint, sizeof hint));
}

static bool read_members(struct message *out, struct error *err)
{
    const struct message_type *type = &client_messages[out->kind];

    for (const cJSON *item = out->json->child; item; item = item->next) {
        const struct message_member *member = find_member(type, item->string);
        char place[ERROR_PLACE_BYTES];
        error_place(place, "", item->string);
        if (!member && strcmp(item->string, "type") != 0) {
            return fail_member(type, item->string, place, err);
        }
        if (member && !read_member(out, member, item, place, err)) {
            return false;
        }
    }
    for (const struct message_member *member = type->members; member->param.name; member++) {
        if (member->required && !cJSON_GetObjectItemCaseSensitive(out->json, member->param.name)) {
            return error_set(err, ERROR_SYNTAX, "", "\"%s\" lacks the member \"%s\"", type->name,
                             member->param.name);
        }
    }
    return true;
}

static bool find_kind(const cJSON *json, enum message_kind *out, struct error *err)
{
    const char *name = json_member_text(json, "type", NULL);

    if (!cJSON_IsObject(json) || !name) {
        return error_set(err, ERROR_SYNTAX, "/type", "expected an object with a text \"type\"");
    }
    struct suggestion suggestion = {.text = name};
    char hint[64];
    for (int kind = 0; kind < MESSAGE_COUNT; kind++) {
        if (strcmp(client_messages[kind].name, name) == 0) {
            *out = (enum message_kind)kind;
            return true;
        }
    }
    for (int kind = 0; kind < MESSAGE_COUNT; kind++) {
        suggest_consider(&suggestion, client_messages[kind].name);
    }
    return error_set(err, ERROR_SYNTAX, "/type", "unknown message \"%.64s\"%s", name,
                     suggest_hint(&suggestion, hint, sizeof hint));
}

bool message_read(const char *text, size_t length, struct message *out, struct error *err)
{
    if (length > LIMIT_MESSAGE_BYTES) {
        return error_set(err, ERROR_TOO_LARGE, "", "%zu bytes are above the maximum %d", length,
                         LIMIT_MESSAGE_BYTES);
    }
    *out = (struct message){.json = json_parse(text, length, err)};
    bool ok = out->json && find_kind(out->json, &out->kind, err);
    if (ok && out->kind == MESSAGE_VIEW) {
        render_request_init(&out->view);
    }
    ok = ok && read_members(out, err);
    if (ok && out->kind == MESSAGE_EDIT) {
        out->plain = !code_text_find(cJSON_GetObjectItemCaseSensitive(out->json, "ops"), NULL);
    }
    if (!ok) {
        message_finish(out);
    }
    return ok;
}

void message_finish(struct message *message)
{
    cJSON_Delete(message->json);
    message->json = NULL;
    render_request_finish(&message->view);
    id_set_finish(&message->nodes);
    id_set_finish(&message->large);
    id_set_finish(&message->materials);
}

double json_member_number(const cJSON *object, const char *name, double fallback)
{
    const cJSON *member = cJSON_GetObjectItemCaseSensitive(object, name);

    return cJSON_IsNumber(member) ? member->valuedouble : fallback;
}

const char *json_member_text(const cJSON *object, const char *name, const char *fallback)
{
    const cJSON *member = cJSON_GetObjectItemCaseSensitive(object, name);

    return cJSON_IsString(member) ? member->valuestring : fallback;
}

bool json_member_bool(const cJSON *object, const char *name, bool fallback)
{
    const cJSON *member = cJSON_GetObjectItemCaseSensitive(object, name);

    return cJSON_IsBool(member) ? cJSON_IsTrue(member) : fallback;
}

/* --- describing --- */

static cJSON *describe_member(const struct message_member *member)
{
    static const char *const names[] = {
        [MEMBER_OPERATIONS] = "operations",
        [MEMBER_NODES] = "nodes",
        [MEMBER_OBJECT] = "object",
    };
    cJSON *row;

    if (member->kind == MEMBER_VALUE || member->kind == MEMBER_CLIENT ||
        member->kind == MEMBER_KEY) {
        row = param_describe(&member->param);
        cJSON_DeleteItemFromObjectCaseSensitive(row, "default");
    } else {
        row = cJSON_CreateObject();
        cJSON_AddStringToObject(row, "name", member->param.name);
        cJSON_AddStringToObject(row, "type",
                                member->kind == MEMBER_RECORD ? member->record->name
                                                              : names[member->kind]);
        cJSON_AddStringToObject(row, "doc", member->param.doc);
    }
    cJSON_AddBoolToObject(row, "required", member->required);
    return row;
}

static cJSON *describe_messages(const struct message_type *types, size_t count)
{
    cJSON *list = cJSON_CreateArray();

    for (size_t i = 0; i < count; i++) {
        cJSON *row = cJSON_CreateObject();
        cJSON_AddStringToObject(row, "type", types[i].name);
        cJSON_AddStringToObject(row, "doc", types[i].doc);
        cJSON *members = cJSON_AddArrayToObject(row, "members");
        for (const struct message_member *member = types[i].members; member->param.name; member++) {
            cJSON_AddItemToArray(members, describe_member(member));
        }
        cJSON_AddItemToArray(list, row);
    }
    return list;
}

cJSON *messages_describe(void)
{
    cJSON *both = cJSON_CreateObject();

    cJSON_AddItemToObject(both, "client", describe_messages(client_messages, MESSAGE_COUNT));
    cJSON_AddItemToObject(
        both, "server",
        describe_messages(server_messages, sizeof server_messages / sizeof server_messages[0]));
    return both;
}
