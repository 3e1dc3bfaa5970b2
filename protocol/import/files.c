/* SPDX-License-Identifier: MIT */
/* The files of a folder: what each is, what it is called, and what names what. */
#include <search.h>
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

bool import_fail_limit(const struct importing *importing, const struct import_item *item,
                       const struct import_value *value, size_t count, const char *what,
                       size_t most)
{
    return error_set_at(importing->err, ERROR_LIMIT, item->path, value->line, value->column,
                        "%zu %s are above the maximum %zu", count, what, most);
}

static bool fail_member(const struct importing *importing, const struct import_item *item,
                        const struct import_value *member, const char *const *names)
{
    struct suggestion suggestion = {.text = member->name};
    char hint[64];

    for (int i = 0; names[i]; i++) {
        suggest_consider(&suggestion, names[i]);
    }
    return import_fail(importing, item, member, "there is no member \"%.64s\" here%s", member->name,
                       suggest_hint(&suggestion, hint, sizeof hint));
}

bool import_check_members(const struct importing *importing, const struct import_item *item,
                          const struct import_value *object, const char *const *names)
{
    for (const struct import_value *member = object->first; member; member = member->next) {
        int i = 0;

        while (names[i] && strcmp(names[i], member->name) != 0) {
            i++;
        }
        if (!names[i]) {
            return fail_member(importing, item, member, names);
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

/* --- names --- */

static int compare_roles(enum import_role a, enum import_role b)
{
    return (a > b) - (a < b);
}

static int compare_keys(const struct import_name *a, const struct import_name *b)
{
    return a->role != b->role ? compare_roles(a->role, b->role) : strcmp(a->text, b->text);
}

/* Of one text the higher rank first, then the earlier file. */
static int compare_names(const void *one, const void *other)
{
    const struct import_name *a = one, *b = other;
    const int keys = compare_keys(a, b);

    return keys != 0            ? keys
           : a->rank != b->rank ? b->rank - a->rank
                                : (a->item > b->item) - (a->item < b->item);
}

static void sort_names(struct importing *importing)
{
    importing->names = memory_alloc(2 * importing->count, sizeof *importing->names);
    for (size_t i = 0; i < importing->count; i++) {
        struct import_item *item = &importing->items[i];
        const bool by_file = roles[item->role].by_file;

        importing->names[2 * i] =
            (struct import_name){item->role, item->stem, by_file ? 2 : 1, item};
        importing->names[2 * i + 1] =
            (struct import_name){item->role, item->name, by_file ? 1 : 2, item};
    }
    qsort(importing->names, 2 * importing->count, sizeof *importing->names, compare_names);
}

/* The first of this text, NULL: none. `*out_left`: names from there to the end. */
static const struct import_name *find_name(const struct importing *importing, enum import_role role,
                                           const char *text, size_t *out_left)
{
    const struct import_name wanted = {.role = role, .text = text};
    size_t low = 0, high = 2 * importing->count;

    while (low < high) {
        const size_t middle = low + (high - low) / 2;

        if (compare_keys(&importing->names[middle], &wanted) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    *out_left = 2 * importing->count - low;
    return *out_left > 0 && compare_keys(&importing->names[low], &wanted) == 0
               ? &importing->names[low]
               : NULL;
}

bool import_has(const struct importing *importing, enum import_role role, const char *name)
{
    size_t left;

    return find_name(importing, role, name, &left) != NULL;
}

/* Says that there is none, and which one was probably meant. */
static void fail_find(const struct importing *importing, const struct import_item *item,
                      const struct import_value *value, enum import_role role, const char *name)
{
    struct suggestion suggestion = {.text = name};
    char hint[64];

    for (size_t i = 0; i < 2 * importing->count; i++) {
        if (importing->names[i].role == role && *importing->names[i].text) {
            suggest_consider(&suggestion, importing->names[i].text);
        }
    }
    import_fail(importing, item, value, "no file has the %s \"%.64s\"%s", roles[role].what, name,
                suggest_hint(&suggestion, hint, sizeof hint));
}

struct import_item *import_find(const struct importing *importing, const struct import_item *item,
                                const struct import_value *value, enum import_role role,
                                const char *name)
{
    size_t left;
    const struct import_name *found = find_name(importing, role, name, &left);

    if (!found) {
        fail_find(importing, item, value, role, name);
        return NULL;
    }
    if (left > 1 && compare_keys(&found[0], &found[1]) == 0 && found[0].rank == found[1].rank) {
        import_fail(importing, item, value, "\"%.64s\" may be the %s of %.60s or of %.60s", name,
                    roles[role].what, found[0].item->path, found[1].item->path);
        return NULL;
    }
    return found->item;
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

/* Ids given so far, and what was tried for names that several files have. */
struct ids {
    void *used;  /* search tree of items, by role and id */
    void *tried; /* the same of struct tried */
};

struct tried {
    enum import_role role;
    char base[LIMIT_ID_BYTES + 1];
    int number; /* up to this all are used */
};

static int compare_used(const void *one, const void *other)
{
    const struct import_item *a = one, *b = other;

    return a->role != b->role ? compare_roles(a->role, b->role) : strcmp(a->id, b->id);
}

static int compare_tried(const void *one, const void *other)
{
    const struct tried *a = one, *b = other;

    return a->role != b->role ? compare_roles(a->role, b->role) : strcmp(a->base, b->base);
}

static bool id_is_used(const struct ids *ids, const struct import_item *item)
{
    return tfind(item, &ids->used, compare_used) ||
           (item->role == IMPORT_SHADER && record_type_in(shader_types, item->id));
}

static struct tried *tried_of(struct ids *ids, const struct import_item *item)
{
    struct tried *fresh = memory_alloc(1, sizeof *fresh);

    *fresh = (struct tried){.role = item->role, .number = 1};
    snprintf(fresh->base, sizeof fresh->base, "%s", item->id);
    struct tried *found = *(struct tried **)tsearch(fresh, &ids->tried, compare_tried);
    if (found != fresh) {
        free(fresh);
    }
    return found;
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

static void give_id(struct ids *ids, struct import_item *item)
{
    enum { NUMBER_BYTES = 8 };
    const bool named = *item->name && item->role != IMPORT_MATERIAL;
    size_t used =
        make_valid(item->id, named ? item->name : item->stem, LIMIT_ID_BYTES - NUMBER_BYTES);

    if (used == 0) {
        used = (size_t)snprintf(item->id, sizeof item->id, "%s", roles[item->role].what);
    }
    struct tried *tried = id_is_used(ids, item) ? tried_of(ids, item) : NULL;
    while (id_is_used(ids, item)) {
        snprintf(item->id + used, sizeof item->id - used, "-%d", ++tried->number);
    }
    tsearch(item, &ids->used, compare_used);
}

static void leave(void *item)
{
    (void)item;
}

static void give_ids(struct importing *importing)
{
    struct ids ids = {.used = NULL};

    for (size_t i = 0; i < importing->count; i++) {
        give_id(&ids, &importing->items[i]);
    }
    tdestroy(ids.used, leave);
    tdestroy(ids.tried, free);
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
    give_ids(importing);
    sort_names(importing);
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
    free(importing->names);
}
