/* SPDX-License-Identifier: MIT */
/* The files of a folder: what each is, what it is called, and what names what. */
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "import_internal.h"
#include "protocol/memory.h"
#include "protocol/nodes.h"
#include "protocol/suggest.h"
#include "protocol/utf8.h"

static const char extension[] = ".json";

/* What a file is can be told from the members it has to have. Of models and materials others name
 * the file, of shaders and primitives the name. */
static const struct role {
    const char *what;
    const char *list;       /* of the document */
    const char *members[2]; /* all of these */
    bool by_file;
} roles[IMPORT_ROLES] = {
    [IMPORT_SCENE] = {"scene", NULL, {"scene"}, true},
    [IMPORT_MODEL] = {"model", "models", {"model"}, true},
    [IMPORT_MATERIAL] = {"material", "materials", {"base_shader"}, true},
    [IMPORT_SHADER] = {"shader", "shaders", {"properties", "code"}, false},
    [IMPORT_PRIMITIVE] = {"primitive", "primitives", {"id", "code"}, false},
};

const char *import_role_list(enum import_role role)
{
    return roles[role].list;
}

/* --- shared with the other files --- */

bool import_fail(const struct importing *importing, const struct import_item *item,
                 const struct import_value *value, const char *format, ...)
{
    char message[sizeof importing->err->message];
    va_list args;

    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    return error_set_at(importing->err, ERROR_INVALID, item->path, value->line, value->column, "%s",
                        message);
}

bool import_check_members(const struct importing *importing, const struct import_item *item,
                          const struct import_value *object, const char *const *names)
{
    for (const struct import_value *member = object->first; member; member = member->next) {
        struct suggestion suggestion = {.text = member->name};
        char hint[64];
        int i = 0;

        for (; names[i] && strcmp(names[i], member->name) != 0; i++) {
            suggest_consider(&suggestion, names[i]);
        }
        if (!names[i]) {
            return import_fail(importing, item, member, "there is no member \"%.64s\" here%s",
                               member->name, suggest_hint(&suggestion, hint, sizeof hint));
        }
    }
    return true;
}

bool import_take(const struct importing *importing, const struct import_item *item,
                 const struct import_value *object, const char *name, enum import_kind kind,
                 const struct import_value **out)
{
    static const char *const kinds[] = {
        [IMPORT_NULL] = "null",         [IMPORT_BOOL] = "true or false",
        [IMPORT_NUMBER] = "a number",   [IMPORT_TEXT] = "a text in quotes",
        [IMPORT_LIST] = "a list [...]", [IMPORT_OBJECT] = "an object {...}"};

    *out = import_member(object, name);
    return !*out || (*out)->kind == kind ||
           import_fail(importing, item, *out, "%s: expected %s", name, kinds[kind]);
}

bool import_has(const struct importing *importing, enum import_role role, const char *name)
{
    for (size_t i = 0; i < importing->count; i++) {
        const struct import_item *one = &importing->items[i];

        if (one->role == role && (strcmp(one->stem, name) == 0 || strcmp(one->name, name) == 0)) {
            return true;
        }
    }
    return false;
}

struct import_item *import_find(const struct importing *importing, const struct import_item *item,
                                const struct import_value *value, enum import_role role,
                                const char *name)
{
    struct suggestion suggestion = {.text = name};
    struct import_item *found = NULL, *other = NULL;
    int best = 0;
    char hint[64];

    for (size_t i = 0; i < importing->count; i++) {
        struct import_item *one = &importing->items[i];
        const bool by_file = strcmp(one->stem, name) == 0, by_name = strcmp(one->name, name) == 0;
        const int rank = (roles[role].by_file ? by_file : by_name) ? 2 : by_file || by_name;

        if (one->role != role) {
            continue;
        }
        suggest_consider(&suggestion, one->stem);
        if (*one->name) {
            suggest_consider(&suggestion, one->name);
        }
        if (rank > best) {
            best = rank;
            found = one;
            other = NULL;
        } else if (rank > 0 && rank == best) {
            other = one;
        }
    }
    if (!found) {
        import_fail(importing, item, value, "no file has the %s \"%.64s\"%s", roles[role].what,
                    name, suggest_hint(&suggestion, hint, sizeof hint));
    } else if (other) {
        import_fail(importing, item, value, "\"%.64s\" may be the %s of %.60s or of %.60s", name,
                    roles[role].what, found->path, other->path);
    }
    return other ? NULL : found;
}

void import_mark(struct importing *importing, const char *list, const char *name,
                 const struct import_item *item, const struct import_value *value)
{
    if (importing->mark_count == importing->mark_room) {
        importing->mark_room = importing->mark_room ? 2 * importing->mark_room : 64;
        importing->marks =
            memory_resize(importing->marks, importing->mark_room, sizeof *importing->marks);
    }
    struct import_mark *mark = &importing->marks[importing->mark_count++];
    *mark = (struct import_mark){.item = item, .line = value->line, .column = value->column};
    snprintf(mark->place, sizeof mark->place, "/%s/%s", list, name);
}

/* --- ids --- */

static bool id_is_used(const struct importing *importing, const struct import_item *item)
{
    for (const struct import_item *other = importing->items; other < item; other++) {
        if (other->role == item->role && strcmp(other->id, item->id) == 0) {
            return true;
        }
    }
    return item->role == IMPORT_SHADER && record_type_in(shader_types, item->id);
}

/* What of a name an id may hold, with "-" for what it may not. */
static size_t make_valid(char out[LIMIT_ID_BYTES + 1], const char *name, size_t room)
{
    size_t used = 0;

    for (; *name && used < room; name++) {
        char one[2] = {*name, '\0'};

        if (record_name_valid(one)) {
            out[used++] = *name;
        } else if (used > 0 && out[used - 1] != '-') {
            out[used++] = '-';
        }
    }
    while (used > 0 && out[used - 1] == '-') {
        used--;
    }
    out[used] = '\0';
    return used;
}

static void give_id(const struct importing *importing, struct import_item *item)
{
    enum { NUMBER_BYTES = 8 };
    const bool named = *item->name && item->role != IMPORT_MATERIAL;
    size_t used =
        make_valid(item->id, named ? item->name : item->stem, LIMIT_ID_BYTES - NUMBER_BYTES);

    if (used == 0) {
        used = (size_t)snprintf(item->id, sizeof item->id, "%s", roles[item->role].what);
    }
    for (int number = 2; id_is_used(importing, item); number++) {
        snprintf(item->id + used, sizeof item->id - used, "-%d", number);
    }
}

/* --- reading the files --- */

static bool has_members(const struct import_value *object, const struct role *role)
{
    return import_member(object, role->members[0]) &&
           (!role->members[1] || import_member(object, role->members[1]));
}

static bool recognise(const struct importing *importing, struct import_item *item)
{
    const struct import_value *name = import_member(item->value, "name");

    while (item->role < IMPORT_ROLES && !has_members(item->value, &roles[item->role])) {
        item->role++;
    }
    if (item->role == IMPORT_ROLES) {
        return import_fail(
            importing, item, item->value,
            "neither a scene (with `scene`), a model (`model`), a material "
            "(`base_shader`), a shader (`properties`, `code`) nor a primitive (`id`, "
            "`code`)");
    }
    item->name = name && name->kind == IMPORT_TEXT ? name->text : "";
    return !name || name->kind == IMPORT_TEXT ||
           import_fail(importing, item, name, "name: expected a text in quotes");
}

bool import_reads(const char *path)
{
    const size_t length = strlen(path), end = sizeof extension - 1;

    return length > end && strcmp(path + length - end, extension) == 0;
}

/* The last part of a path without .json. A file system takes any bytes for a name: what a document
 * cannot hold becomes U+FFFD. */
static char *stem_of(const char *path)
{
    static const char replacement[] = "\xef\xbf\xbd";
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    size_t left = strlen(name) - (sizeof extension - 1), used = 0;
    char *stem = memory_alloc(left * (sizeof replacement - 1) + 1, 1);

    while (left > 0) {
        const size_t length = utf8_sequence(name, left), step = length ? length : 1;
        const bool plain = length > 0 && (unsigned char)*name >= 0x20 && *name != 0x7f;

        memcpy(stem + used, plain ? name : replacement, plain ? step : sizeof replacement - 1);
        used += plain ? step : sizeof replacement - 1;
        name += step;
        left -= step;
    }
    return stem;
}

bool import_read_files(struct importing *importing, const struct import_source *source,
                       cJSON *notes)
{
    importing->items = memory_alloc(source->count, sizeof *importing->items);
    for (size_t i = 0; i < source->count; i++) {
        const struct import_file *file = &source->files[i];
        struct import_item *item = &importing->items[importing->count];

        if (!import_reads(file->path)) {
            continue;
        }
        item->path = file->path;
        item->value = import_text_read(file->path, file->text, file->length, notes, importing->err);
        if (!item->value) {
            return false;
        }
        item->stem = stem_of(file->path);
        importing->count++;
        if (!recognise(importing, item)) {
            return false;
        }
    }
    for (size_t i = 0; i < importing->count; i++) {
        give_id(importing, &importing->items[i]);
    }
    return importing->count > 0 || error_set(importing->err, ERROR_INVALID, "",
                                             "there is no file whose name ends with %s", extension);
}

void import_finish_files(struct importing *importing)
{
    for (size_t i = 0; i < importing->count; i++) {
        import_value_destroy(importing->items[i].value);
        free(importing->items[i].stem);
        free(importing->items[i].materials);
    }
    free(importing->items);
}
