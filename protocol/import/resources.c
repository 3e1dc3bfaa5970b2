/* SPDX-License-Identifier: MIT */
/* Primitives, shaders and materials: rows out of "[float] [Range(0, 1)] _Blend", numbers out of
 * "(0.5, 0.1, 0.5)". */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "import_internal.h"
#include "protocol/memory.h"

enum { RESERVED_IDS = 32, WORD_BYTES = 64 };

/* Types of properties: as annotations name them, and as we declare them. */
static const struct property_type {
    const char *name, *type;
    int components;
} property_types[] = {
    {"float", "float", 1}, {"float2", "vec2", 2}, {"float3", "vec3", 3}, {"float4", "vec4", 4},
    {"int", "int", 1},     {"int2", "ivec2", 2},  {"int3", "ivec3", 3},  {"int4", "ivec4", 4},
};
enum { PROPERTY_TYPES = sizeof property_types / sizeof property_types[0] };

static const struct property_type *find_type(const char *name)
{
    for (size_t i = 0; i < PROPERTY_TYPES; i++) {
        if (strcmp(property_types[i].name, name) == 0) {
            return &property_types[i];
        }
    }
    return NULL;
}

/* A member that has to be there. */
static const struct import_value *need(const struct importing *importing,
                                       const struct import_item *item,
                                       const struct import_value *object, const char *name,
                                       enum import_kind kind)
{
    const struct import_value *member = NULL;

    if (import_take(importing, item, object, name, kind, &member) && !member) {
        import_fail(importing, item, object, "%s is missing", name);
    }
    return member && member->kind == kind ? member : NULL;
}

static const char *skip_space(const char *at)
{
    while (isspace((unsigned char)*at)) {
        at++;
    }
    return at;
}

/* --- primitives --- */

int import_data_read(const char *code)
{
    int most = 0;

    for (const char *at = strstr(code, "data"); at; at = strstr(at, "data")) {
        at = skip_space(at + 4);
        if (*at != '[') {
            continue;
        }
        at = skip_space(at + 1);
        const int index = isdigit((unsigned char)at[0]) && !isalnum((unsigned char)at[1])
                              ? *at - '0'
                              : IMPORT_DATA_MAX - 1; /* not known before it runs */
        if (index < IMPORT_DATA_MAX && index >= most) {
            most = index + 1;
        }
    }
    return most;
}

static void add_row(cJSON *rows, const char *name, const char *type, const double *range)
{
    cJSON *row = cJSON_CreateObject();

    cJSON_AddStringToObject(row, "name", name);
    cJSON_AddStringToObject(row, "type", type);
    if (range) {
        cJSON_AddItemToObject(row, "range", cJSON_CreateDoubleArray(range, 2));
    }
    cJSON_AddItemToArray(rows, row);
}

cJSON *import_primitive(struct importing *importing, const struct import_item *item)
{
    static const char *const members[] = {"name", "id", "code", NULL};
    const struct import_value *id = need(importing, item, item->value, "id", IMPORT_NUMBER);
    const struct import_value *code =
        id ? need(importing, item, item->value, "code", IMPORT_TEXT) : NULL;

    if (!code || !import_check_members(importing, item, item->value, members)) {
        return NULL;
    }
    if (id->number != floor(id->number) || id->number < RESERVED_IDS) {
        import_fail(importing, item, id,
                    "id: expected a whole number of at least %d: those below are built in",
                    RESERVED_IDS);
        return NULL;
    }
    cJSON *primitive = cJSON_CreateObject();
    cJSON *rows = cJSON_AddArrayToObject(primitive, "params");
    for (int i = 0; i < item->numbers; i++) {
        char name[16];

        snprintf(name, sizeof name, "data%d", i);
        add_row(rows, name, "float", NULL);
        /* Something to see where a node says nothing. */
        cJSON_AddNumberToObject(cJSON_GetArrayItem(rows, i), "default", 0.5);
    }
    cJSON_AddStringToObject(primitive, "code", code->text);
    cJSON_AddStringToObject(primitive, "doc", item->name);
    return primitive;
}

/* --- shaders --- */

/* What a property says of itself. */
struct property {
    const struct property_type *type;
    char name[WORD_BYTES];
    bool has_range;
    double range[2];
};

/* The next word of letters, digits and _; "" where none is. */
static const char *take_word(const char *at, char out[WORD_BYTES])
{
    size_t used = 0;

    at = skip_space(at);
    while (isalnum((unsigned char)*at) || *at == '_') {
        if (used + 1 < WORD_BYTES) {
            out[used++] = *at;
        }
        at++;
    }
    out[used] = '\0';
    return skip_space(at);
}

/* A number of plain decimals; NULL: there is none. */
static const char *take_number(const char *at, double *out)
{
    char *end;

    at = skip_space(at);
    const size_t length = strspn(at, "+-.0123456789eE");
    *out = strtod(at, &end);
    return length > 0 && end == at + length && isfinite(*out) ? skip_space(end) : NULL;
}

/* Numbers with commas between them, `close` behind them; NULL where it is not so. */
static const char *take_numbers(const char *at, int count, char close, double *out)
{
    for (int i = 0; i < count && at; i++) {
        at = take_number(at, &out[i]);
        if (at && *at == (i + 1 < count ? ',' : close)) {
            at += *at != '\0';
        } else {
            at = NULL;
        }
    }
    return at;
}

/* Behind '[': "float]" or "Range(0, 1)]". */
static const char *take_annotation(const char *at, struct property *out)
{
    char word[WORD_BYTES];
    const struct property_type *type;

    at = take_word(at, word);
    type = find_type(word);
    if (type && !out->type) {
        out->type = type;
    } else if (strcmp(word, "Range") == 0 && *at == '(' && !out->has_range) {
        at = take_numbers(at + 1, 2, ')', out->range);
        out->has_range = true;
        at = at ? skip_space(at) : NULL;
    } else {
        return NULL;
    }
    return at && *at == ']' ? skip_space(at + 1) : NULL;
}

static bool read_property(const struct importing *importing, const struct import_item *item,
                          const struct import_value *value, struct property *out)
{
    const char *at = value->kind == IMPORT_TEXT ? skip_space(value->text) : NULL;

    memset(out, 0, sizeof *out);
    while (at && *at == '[') {
        at = take_annotation(at + 1, out);
    }
    at = at ? take_word(at, out->name) : NULL;
    return (at && *at == '\0' && *out->name && out->type) ||
           import_fail(importing, item, value,
                       "expected a property as \"[float] [Range(0, 1)] _Name\", of type float, "
                       "float2, float3, float4, int, int2, int3 or int4");
}

static bool is_colour(const struct property *property)
{
    return strcmp(property->type->type, "vec3") == 0 && !property->has_range &&
           (strcasestr(property->name, "color") || strcasestr(property->name, "colour"));
}

/* The list of a shader's properties: no longer than what a shader may declare. */
static const struct import_value *properties_of(const struct importing *importing,
                                                const struct import_item *shader)
{
    const struct import_value *list =
        need(importing, shader, shader->value, "properties", IMPORT_LIST);

    if (list && list->count > LIMIT_DECLARED) {
        import_fail_limit(importing, shader, list, list->count, "properties", LIMIT_DECLARED);
        return NULL;
    }
    return list;
}

cJSON *import_shader(struct importing *importing, const struct import_item *item)
{
    static const char *const members[] = {"name", "properties", "code", NULL};
    const struct import_value *list = properties_of(importing, item);
    const struct import_value *code =
        list ? need(importing, item, item->value, "code", IMPORT_TEXT) : NULL;

    if (!code || !import_check_members(importing, item, item->value, members)) {
        return NULL;
    }
    cJSON *shader = cJSON_CreateObject();
    cJSON *rows = cJSON_AddArrayToObject(shader, "properties");
    for (const struct import_value *one = list->first; one; one = one->next) {
        struct property property;

        if (!read_property(importing, item, one, &property)) {
            cJSON_Delete(shader);
            return NULL;
        }
        add_row(rows, property.name, is_colour(&property) ? "color" : property.type->type,
                property.has_range ? property.range : NULL);
    }
    cJSON_AddStringToObject(shader, "code", code->text);
    cJSON_AddStringToObject(shader, "lighting", "unlit");
    cJSON_AddStringToObject(shader, "doc", item->name);
    return shader;
}

/* --- materials --- */

/* The annotation of the shader for this name. */
static bool find_property(const struct importing *importing, const struct import_item *item,
                          const struct import_item *shader, const struct import_value *name,
                          struct property *out)
{
    const struct import_value *list = import_member(shader->value, "properties");

    for (const struct import_value *one = list->first; one; one = one->next) {
        if (!read_property(importing, shader, one, out)) {
            return false;
        }
        if (strcmp(out->name, name->text) == 0) {
            return true;
        }
    }
    return import_fail(importing, item, name, "the shader \"%.64s\" has no property \"%.64s\"",
                       *shader->name ? shader->name : shader->stem, name->text);
}

/* "(0.5, 0.1, 0.5)", or "0.5" of a single number. */
static bool read_numbers(const char *text, int count, double *out)
{
    const char *at = skip_space(text);

    if (*at == '(') {
        at = take_numbers(at + 1, count, ')', out);
        at = at ? skip_space(at) : NULL;
    } else {
        at = count == 1 ? take_numbers(at, 1, '\0', out) : NULL;
    }
    return at && *at == '\0';
}

static cJSON *read_value(const struct importing *importing, const struct import_item *item,
                         const struct import_value *property, const struct property *declared)
{
    const struct import_value *type, *value = import_member(property, "value");
    const int count = declared->type->components;
    double numbers[4];

    if (!import_take(importing, item, property, "type", IMPORT_TEXT, &type)) {
        return NULL;
    }
    if (type && strcmp(type->text, declared->type->name) != 0) {
        import_fail(importing, item, type, "type: the shader says that %s is a %s", declared->name,
                    declared->type->name);
        return NULL;
    }
    if (value && value->kind == IMPORT_NUMBER && count == 1) {
        numbers[0] = value->number;
    } else if (!value || value->kind != IMPORT_TEXT || !read_numbers(value->text, count, numbers)) {
        static const char *const forms[] = {"", "0.5", "(0.5, 1)", "(0.5, 1, 0)", "(0.5, 1, 0, 1)"};
        import_fail(importing, item, value ? value : property, "value: expected a text as \"%s\"",
                    forms[count]);
        return NULL;
    }
    return count == 1 ? cJSON_CreateNumber(numbers[0]) : cJSON_CreateDoubleArray(numbers, count);
}

static bool add_property(struct importing *importing, const struct import_item *item,
                         const struct import_item *shader, const struct import_value *property,
                         cJSON *properties)
{
    static const char *const members[] = {"name", "type", "value", NULL};
    const struct import_value *name;
    struct property declared;
    cJSON *value;

    if (property->kind != IMPORT_OBJECT) {
        return import_fail(importing, item, property,
                           "expected a property {\"name\", \"type\", \"value\"}");
    }
    name = need(importing, item, property, "name", IMPORT_TEXT);
    if (!name || !import_check_members(importing, item, property, members) ||
        !find_property(importing, item, shader, name, &declared)) {
        return false;
    }
    if (cJSON_HasObjectItem(properties, name->text)) {
        return import_fail(importing, item, name, "\"%.64s\" is given twice", name->text);
    }
    value = read_value(importing, item, property, &declared);
    if (value) {
        char place[2 * WORD_BYTES + LIMIT_ID_BYTES];

        snprintf(place, sizeof place, "%s/properties/%s", item->id, declared.name);
        import_mark(importing, "materials", place, item, property);
        cJSON_AddItemToObject(properties, declared.name, value);
    }
    return value != NULL;
}

cJSON *import_material(struct importing *importing, const struct import_item *item)
{
    static const char *const members[] = {"name", "base_shader", "properties", NULL};
    const struct import_value *base =
        need(importing, item, item->value, "base_shader", IMPORT_TEXT);
    const struct import_value *list = NULL;

    if (!base || !import_check_members(importing, item, item->value, members) ||
        !import_take(importing, item, item->value, "properties", IMPORT_LIST, &list)) {
        return NULL;
    }
    const struct import_item *shader =
        import_find(importing, item, base, IMPORT_SHADER, base->text);
    if (!shader || !properties_of(importing, shader)) {
        return NULL;
    }
    cJSON *material = cJSON_CreateObject();
    cJSON_AddStringToObject(material, "shader", shader->id);
    cJSON *properties = cJSON_AddObjectToObject(material, "properties");
    for (const struct import_value *one = list ? list->first : NULL; one; one = one->next) {
        if (!add_property(importing, item, shader, one, properties)) {
            cJSON_Delete(material);
            return NULL;
        }
    }
    return material;
}
