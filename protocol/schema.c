/* SPDX-License-Identifier: MIT */
/* The tables as JSON Schema, and as the registry that editors read. */
#include "schema.h"

#include <stdio.h>
#include <string.h>

#include "limits.h"
#include "messages.h"
#include "nodes.h"
#include "scene_parts.h"

#define NAME_PATTERN "^[A-Za-z0-9_.-]{1,64}$"

/* --- JSON Schema --- */

static cJSON *typed(const char *type)
{
    cJSON *schema = cJSON_CreateObject();
    cJSON_AddStringToObject(schema, "type", type);
    return schema;
}

static cJSON *reference(const char *definition)
{
    char text[96];
    cJSON *schema = cJSON_CreateObject();
    snprintf(text, sizeof text, "#/$defs/%s", definition);
    cJSON_AddStringToObject(schema, "$ref", text);
    return schema;
}

static cJSON *constant(const char *text)
{
    cJSON *schema = cJSON_CreateObject();
    cJSON_AddStringToObject(schema, "const", text);
    return schema;
}

static cJSON *name_schema(void)
{
    cJSON *schema = typed("string");
    cJSON_AddStringToObject(schema, "pattern", NAME_PATTERN);
    return schema;
}

static cJSON *number_schema(const struct param *param)
{
    bool whole = param->type == PARAM_INT || param->type == PARAM_IVEC3;
    cJSON *schema = typed(whole ? "integer" : "number");
    double min, max;
    param_range(param, &min, &max);
    cJSON_AddNumberToObject(schema, param->above_min ? "exclusiveMinimum" : "minimum", min);
    cJSON_AddNumberToObject(schema, "maximum", max);
    if (param->nonzero) {
        cJSON *not = cJSON_AddObjectToObject(schema, "not");
        cJSON_AddNumberToObject(not, "const", 0);
    }
    return schema;
}

static cJSON *vector_schema(cJSON *part, int count)
{
    cJSON *schema = typed("array");
    cJSON_AddItemToObject(schema, "items", part);
    cJSON_AddNumberToObject(schema, "minItems", count);
    cJSON_AddNumberToObject(schema, "maxItems", count);
    return schema;
}

static cJSON *numbers_schema(const struct param *param)
{
    cJSON *schema = vector_schema(number_schema(param), param_components(param->type));
    if (param->direction) {
        cJSON *not = cJSON_AddObjectToObject(schema, "not");
        cJSON_AddItemToObject(not, "const", cJSON_CreateIntArray((const int[]){0, 0, 0}, 3));
    }
    if (param->uniform) {
        cJSON *either = cJSON_CreateObject();
        cJSON *forms = cJSON_AddArrayToObject(either, "anyOf");
        cJSON_AddItemToArray(forms, schema);
        cJSON_AddItemToArray(forms, number_schema(param));
        return either;
    }
    return schema;
}

static cJSON *choices_schema(const struct param *param)
{
    cJSON *schema = cJSON_CreateObject();
    cJSON *choices = cJSON_AddArrayToObject(schema, "enum");
    for (int i = 0; param->choices[i]; i++) {
        cJSON_AddItemToArray(choices, cJSON_CreateString(param->choices[i]));
    }
    return schema;
}

static cJSON *text_schema(const struct param *param)
{
    cJSON *schema = typed("string");
    if (param->type == PARAM_MATERIAL) {
        cJSON_AddStringToObject(schema, "pattern", "^[A-Za-z0-9_.-]{0,64}$");
    } else {
        cJSON_AddNumberToObject(schema, "maxLength", LIMIT_NAME_BYTES);
        cJSON_AddStringToObject(schema, "pattern", "^[^\x01-\x1f\x7f]*$");
    }
    return schema;
}

static cJSON *param_schema(const struct param *param)
{
    cJSON *schema = NULL;
    switch (param->type) {
    case PARAM_FLOAT:
    case PARAM_INT:
        schema = number_schema(param);
        break;
    case PARAM_VEC2:
    case PARAM_VEC3:
    case PARAM_VEC4:
    case PARAM_IVEC3:
    case PARAM_COLOR:
        schema = numbers_schema(param);
        break;
    case PARAM_BOOL:
        schema = typed("boolean");
        break;
    case PARAM_BVEC3:
        schema = vector_schema(typed("boolean"), 3);
        break;
    case PARAM_ENUM:
        schema = choices_schema(param);
        break;
    case PARAM_TEXT:
    case PARAM_MATERIAL:
    case PARAM_POINTS:
    case PARAM_CODE:
    case PARAM_MODEL:
    case PARAM_FUNCTION:
    case PARAM_ROWS:
        schema = text_schema(param);
        break;
    }
    cJSON_AddStringToObject(schema, "description", param->doc);
    cJSON_AddItemToObject(schema, "default", param_default(param));
    return schema;
}

static void add_properties(cJSON *properties, const struct record_type *type)
{
    for (const struct param *param = type->params; param->name; param++) {
        cJSON_AddItemToObject(properties, param->name, param_schema(param));
    }
}

/* An object that knows its members; `*out_properties` are to be filled. */
static cJSON *closed_object(const char *doc, cJSON **out_properties)
{
    cJSON *schema = typed("object");
    cJSON_AddStringToObject(schema, "description", doc);
    *out_properties = cJSON_AddObjectToObject(schema, "properties");
    cJSON_AddFalseToObject(schema, "additionalProperties");
    return schema;
}

static cJSON *record_schema(const struct record_type *type)
{
    cJSON *properties, *schema = closed_object(type->doc, &properties);
    add_properties(properties, type);
    return schema;
}

static void require(cJSON *schema, const char *name)
{
    cJSON *required = cJSON_GetObjectItemCaseSensitive(schema, "required");
    if (!required) {
        required = cJSON_AddArrayToObject(schema, "required");
    }
    cJSON_AddItemToArray(required, cJSON_CreateString(name));
}

/* Where `member` is `type`, the member `values` is as the type's row says. */
static cJSON *condition(const char *member, const char *values, const struct record_type *type)
{
    cJSON *rule = cJSON_CreateObject();
    cJSON *properties = cJSON_AddObjectToObject(cJSON_AddObjectToObject(rule, "if"), "properties");
    cJSON_AddItemToObject(properties, member, constant(type->name));
    properties = cJSON_AddObjectToObject(cJSON_AddObjectToObject(rule, "then"), "properties");
    cJSON_AddItemToObject(properties, values, record_schema(type));
    return rule;
}

static cJSON *node_schema(void)
{
    cJSON *properties, *schema = closed_object("A node of the scene.", &properties);
    cJSON *types, *children, *rules;
    cJSON_AddItemToObject(properties, "id", name_schema());
    types = cJSON_AddArrayToObject(cJSON_AddObjectToObject(properties, "type"), "enum");
    add_properties(properties, &node_common_type);
    cJSON_AddItemToObject(properties, "transform", reference("transform"));
    cJSON_AddItemToObject(properties, "params", typed("object"));
    children = typed("array");
    cJSON_AddItemToObject(properties, "children", children);
    cJSON_AddItemToObject(children, "items", reference("node"));
    cJSON_AddNumberToObject(children, "maxItems", LIMIT_CHILDREN);
    require(schema, "type");
    rules = cJSON_AddArrayToObject(schema, "allOf");
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct record_type *type = &node_type_at(i)->record;
        cJSON_AddItemToArray(types, cJSON_CreateString(type->name));
        cJSON_AddItemToArray(rules, condition("type", "params", type));
    }
    return schema;
}

static cJSON *light_schema(void)
{
    cJSON *schema = cJSON_CreateObject();
    cJSON *forms = cJSON_AddArrayToObject(schema, "oneOf");
    for (const struct record_type *type = light_types; type->name; type++) {
        cJSON *properties, *form = closed_object(type->doc, &properties);
        cJSON_AddItemToObject(properties, "id", name_schema());
        cJSON_AddItemToObject(properties, "type", constant(type->name));
        add_properties(properties, type);
        require(form, "type");
        cJSON_AddItemToArray(forms, form);
    }
    return schema;
}

static cJSON *material_schema(void)
{
    cJSON *schema = cJSON_CreateObject();
    cJSON *forms = cJSON_AddArrayToObject(schema, "oneOf");
    for (const struct record_type *type = shader_types; type->name; type++) {
        cJSON *properties, *form = closed_object(type->doc, &properties);
        cJSON_AddItemToObject(properties, "shader", constant(type->name));
        cJSON_AddItemToObject(properties, "properties", record_schema(type));
        require(form, "shader");
        cJSON_AddItemToArray(forms, form);
    }
    return schema;
}

static void add_document(cJSON *schema, cJSON *properties)
{
    static const char *const reserved[] = {"shaders", "primitives", "models"};
    cJSON_AddItemToObject(properties, "format", constant(SCENE_FORMAT));
    add_properties(properties, &scene_info_type);
    cJSON_AddItemToObject(properties, "camera", reference("camera"));
    cJSON *lights = typed("array");
    cJSON_AddItemToObject(lights, "items", reference("light"));
    cJSON_AddNumberToObject(lights, "maxItems", LIMIT_LIGHTS);
    cJSON_AddItemToObject(properties, "lights", lights);
    cJSON *materials = typed("object");
    cJSON_AddItemToObject(materials, "propertyNames", name_schema());
    cJSON_AddItemToObject(materials, "additionalProperties", reference("material"));
    cJSON_AddNumberToObject(materials, "maxProperties", LIMIT_MATERIALS);
    cJSON_AddItemToObject(properties, "materials", materials);
    cJSON_AddItemToObject(properties, "environment", reference("environment"));
    cJSON_AddItemToObject(properties, "render", reference("render"));
    for (size_t i = 0; i < sizeof reserved / sizeof reserved[0]; i++) {
        cJSON *empty = typed("object");
        cJSON_AddNumberToObject(empty, "maxProperties", 0);
        cJSON_AddItemToObject(properties, reserved[i], empty);
    }
    cJSON_AddItemToObject(properties, "root", reference("node"));
    require(schema, "format");
    require(schema, "root");
}

static void add_definitions(cJSON *schema)
{
    const struct record_type *const records[] = {&transform_type, &camera_type, &environment_type,
                                                 &render_type};
    cJSON *definitions = cJSON_AddObjectToObject(schema, "$defs");
    for (size_t i = 0; i < sizeof records / sizeof records[0]; i++) {
        cJSON_AddItemToObject(definitions, records[i]->name, record_schema(records[i]));
    }
    cJSON_AddItemToObject(definitions, "light", light_schema());
    cJSON_AddItemToObject(definitions, "material", material_schema());
    cJSON_AddItemToObject(definitions, "node", node_schema());
}

/* --- x-fieldcast --- */

static cJSON *describe_params(const struct record_type *type)
{
    cJSON *list = cJSON_CreateArray();
    for (const struct param *param = type->params; param->name; param++) {
        cJSON_AddItemToArray(list, param_describe(param));
    }
    return list;
}

/* Every type takes children; this says what it is made for. */
static const char *children_word(enum node_group group)
{
    static const char *const words[] = {
        [GROUP_PRIMITIVE] = "none", [GROUP_SHAPE] = "none",     [GROUP_OPERATION] = "many",
        [GROUP_MODIFIER] = "one",   [GROUP_STRUCTURE] = "many",
    };
    return words[group];
}

static cJSON *describe_nodes(void)
{
    cJSON *list = cJSON_CreateArray();
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        cJSON *row = cJSON_CreateObject();
        cJSON_AddStringToObject(row, "type", type->record.name);
        cJSON_AddStringToObject(row, "group", node_group_name(type->group));
        cJSON_AddStringToObject(row, "exactness", type->exactness == EXACT ? "exact" : "bound");
        cJSON_AddStringToObject(row, "doc", type->record.doc);
        cJSON_AddStringToObject(row, "words", type->words);
        cJSON_AddStringToObject(row, "source", type->source);
        cJSON_AddStringToObject(row, "children", children_word(type->group));
        cJSON_AddItemToObject(row, "params", describe_params(&type->record));
        cJSON_AddItemToArray(list, row);
    }
    return list;
}

static cJSON *describe_types(const struct record_type *type)
{
    cJSON *list = cJSON_CreateArray();
    for (; type->name; type++) {
        cJSON *row = cJSON_CreateObject();
        cJSON_AddStringToObject(row, "type", type->name);
        cJSON_AddStringToObject(row, "doc", type->doc);
        cJSON_AddItemToObject(row, "params", describe_params(type));
        cJSON_AddItemToArray(list, row);
    }
    return list;
}

static cJSON *describe_limits(void)
{
    size_t count;
    const struct limit *limits = limits_table(&count);
    cJSON *list = cJSON_CreateArray();
    for (size_t i = 0; i < count; i++) {
        cJSON *row = cJSON_CreateObject();
        cJSON_AddStringToObject(row, "name", limits[i].name);
        cJSON_AddNumberToObject(row, "value", (double)limits[i].value);
        cJSON_AddStringToObject(row, "unit", limits[i].unit);
        cJSON_AddStringToObject(row, "doc", limits[i].doc);
        cJSON_AddItemToArray(list, row);
    }
    return list;
}

static cJSON *describe_errors(void)
{
    static const enum error_kind kinds[] = {
#define X(name, wire, status) ERROR_##name,
        ERROR_KINDS(X)
#undef X
    };
    cJSON *list = cJSON_CreateArray();
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (kinds[i] != ERROR_NONE) {
            cJSON *row = cJSON_CreateObject();
            cJSON_AddStringToObject(row, "code", error_kind_name(kinds[i]));
            cJSON_AddNumberToObject(row, "status", error_kind_status(kinds[i]));
            cJSON_AddItemToArray(list, row);
        }
    }
    return list;
}

static cJSON *describe_registry(void)
{
    cJSON *registry = cJSON_CreateObject();
    cJSON_AddItemToObject(registry, "nodes", describe_nodes());
    cJSON_AddItemToObject(registry, "node", describe_params(&node_common_type));
    cJSON_AddItemToObject(registry, "transform", describe_params(&transform_type));
    cJSON_AddItemToObject(registry, "lights", describe_types(light_types));
    cJSON_AddItemToObject(registry, "shaders", describe_types(shader_types));
    cJSON_AddItemToObject(registry, "camera", describe_params(&camera_type));
    cJSON_AddItemToObject(registry, "environment", describe_params(&environment_type));
    cJSON_AddItemToObject(registry, "render", describe_params(&render_type));
    cJSON_AddItemToObject(registry, "limits", describe_limits());
    cJSON_AddItemToObject(registry, "errors", describe_errors());
    cJSON_AddItemToObject(registry, "messages", messages_describe());
    return registry;
}

cJSON *schema_build(void)
{
    cJSON *properties,
        *schema = closed_object("A scene made of signed distance fields.", &properties);
    cJSON_AddStringToObject(schema, "$schema", "https://json-schema.org/draft/2020-12/schema");
    cJSON_AddStringToObject(schema, "title", "fieldcast scene document");
    add_document(schema, properties);
    add_definitions(schema);
    cJSON_AddItemToObject(schema, "x-fieldcast", describe_registry());
    return schema;
}
