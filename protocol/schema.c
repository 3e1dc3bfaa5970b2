/* SPDX-License-Identifier: MIT */
/* The tables as JSON Schema, and as the registry that editors read. */
#include "schema.h"

#include <stdio.h>
#include <string.h>

#include "ideal.h"
#include "limits.h"
#include "messages.h"
#include "nodes.h"
#include "picture.h"
#include "scene_internal.h"
#include "surface.h"

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
    cJSON *schema = typed(param_is_whole(param->type) ? "integer" : "number");
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

    if (param->type == PARAM_ASSET) {
        cJSON_AddStringToObject(schema, "pattern", "^([0-9a-f]{64})?$");
    } else if (param->type == PARAM_TEXT || param->type == PARAM_CODE ||
               param->type == PARAM_EQUATION) {
        const bool lines = param->type != PARAM_TEXT;
        cJSON_AddNumberToObject(schema, "maxLength", (double)param_text_bytes(param->type));
        cJSON_AddStringToObject(schema, "pattern",
                                lines ? "^[^\x01-\x08\x0b-\x1f\x7f]*$" : "^[^\x01-\x1f\x7f]*$");
    } else {
        cJSON_AddStringToObject(schema, "pattern", "^[A-Za-z0-9_.-]{0,64}$");
    }
    return schema;
}

static cJSON *points_schema(const struct param *param)
{
    static const struct param point = {.type = PARAM_VEC2};
    cJSON *schema = typed("array");

    cJSON_AddItemToObject(schema, "items", numbers_schema(&point));
    cJSON_AddNumberToObject(schema, "minItems", param->min);
    cJSON_AddNumberToObject(schema, "maxItems", param->max);
    return schema;
}

/* {}, or all parts and the ranges of two letters. */
static cJSON *surface_schema(void)
{
    static const struct param part = {.type = PARAM_EQUATION}, range = {.type = PARAM_VEC2};
    cJSON *schema = typed("object");
    cJSON *properties = cJSON_AddObjectToObject(schema, "properties");

    for (int i = 0; i < SURFACE_MEMBERS; i++) {
        cJSON_AddItemToObject(properties, surface_names[i],
                              i < SURFACE_PARTS ? text_schema(&part) : numbers_schema(&range));
    }
    cJSON_AddFalseToObject(schema, "additionalProperties");
    cJSON *forms = cJSON_AddArrayToObject(schema, "anyOf");
    cJSON *none = cJSON_CreateObject(), *whole = cJSON_CreateObject();
    cJSON_AddNumberToObject(none, "maxProperties", 0);
    cJSON_AddItemToObject(whole, "required", cJSON_CreateStringArray(surface_names, SURFACE_PARTS));
    cJSON_AddNumberToObject(whole, "minProperties", SURFACE_PARTS + SURFACE_PARAMETERS);
    cJSON_AddNumberToObject(whole, "maxProperties", SURFACE_PARTS + SURFACE_PARAMETERS);
    cJSON_AddItemToArray(forms, none);
    cJSON_AddItemToArray(forms, whole);
    return schema;
}

/* Of all resources of a kind; their names are the members. */
static cJSON *names_schema(const char *definition, double most)
{
    cJSON *schema = typed("object");

    cJSON_AddItemToObject(schema, "propertyNames", name_schema());
    cJSON_AddItemToObject(schema, "additionalProperties", reference(definition));
    cJSON_AddNumberToObject(schema, "maxProperties", most);
    return schema;
}

static cJSON *list_schema(const char *definition, double most)
{
    cJSON *schema = typed("array");

    cJSON_AddItemToObject(schema, "items", reference(definition));
    cJSON_AddNumberToObject(schema, "maxItems", most);
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
    case PARAM_IVEC2:
    case PARAM_IVEC3:
    case PARAM_IVEC4:
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
    case PARAM_POINTS:
        schema = points_schema(param);
        break;
    case PARAM_SURFACE:
        schema = surface_schema();
        break;
    case PARAM_ROWS:
        schema = list_schema("declaration", LIMIT_DECLARED);
        break;
    case PARAM_TEXT:
    case PARAM_MATERIAL:
    case PARAM_CODE:
    case PARAM_EQUATION:
    case PARAM_MODEL:
    case PARAM_FUNCTION:
    case PARAM_ASSET:
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

/* Where `member` is `type`, the member `values` is as the type's row says, if `open` with more. */
static cJSON *condition(const char *member, const char *values, const struct record_type *type,
                        bool open)
{
    cJSON *rule = cJSON_CreateObject();
    cJSON *properties = cJSON_AddObjectToObject(cJSON_AddObjectToObject(rule, "if"), "properties");

    cJSON_AddItemToObject(properties, member, constant(type->name));
    properties = cJSON_AddObjectToObject(cJSON_AddObjectToObject(rule, "then"), "properties");
    cJSON *record = record_schema(type);
    if (open) {
        cJSON_DeleteItemFromObject(record, "additionalProperties");
    }
    cJSON_AddItemToObject(properties, values, record);
    return rule;
}

static cJSON *node_schema(void)
{
    cJSON *properties, *schema = closed_object("A node of the scene.", &properties);
    cJSON *types, *rules;

    cJSON_AddItemToObject(properties, "id", name_schema());
    types = cJSON_AddArrayToObject(cJSON_AddObjectToObject(properties, "type"), "enum");
    add_properties(properties, &node_common_type);
    cJSON_AddItemToObject(properties, "transform", reference("transform"));
    cJSON_AddItemToObject(properties, "params", typed("object"));
    cJSON_AddItemToObject(properties, "children", list_schema("node", LIMIT_CHILDREN));
    require(schema, "type");
    rules = cJSON_AddArrayToObject(schema, "allOf");
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        cJSON_AddItemToArray(types, cJSON_CreateString(type->record.name));
        cJSON_AddItemToArray(rules, condition("type", "params", &type->record,
                                              type->kind == KIND_CODE || type->kind == KIND_MODEL));
    }
    return schema;
}

/* Of a kind whose list is an array: each type of its table is a form. */
static cJSON *listed_schema(const struct record_type *type)
{
    cJSON *schema = cJSON_CreateObject();
    cJSON *forms = cJSON_AddArrayToObject(schema, "oneOf");

    for (; type->name; type++) {
        cJSON *properties, *form = closed_object(type->doc, &properties);
        cJSON_AddItemToObject(properties, "id", name_schema());
        cJSON_AddItemToObject(properties, "type", constant(type->name));
        add_properties(properties, type);
        require(form, "type");
        cJSON_AddItemToArray(forms, form);
    }
    return schema;
}

/* A type that the document declares itself: no built-in one, and any values. */
static cJSON *own_shader_form(void)
{
    cJSON *properties,
        *form = closed_object("A material of a shader of the document.", &properties);
    cJSON *shader = name_schema(), *names;

    names = cJSON_AddArrayToObject(cJSON_AddObjectToObject(shader, "not"), "enum");
    for (const struct record_type *type = shader_types; type->name; type++) {
        cJSON_AddItemToArray(names, cJSON_CreateString(type->name));
    }
    cJSON_AddItemToObject(properties, "shader", shader);
    cJSON_AddItemToObject(properties, "properties", typed("object"));
    require(form, "shader");
    return form;
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
    cJSON_AddItemToArray(forms, own_shader_form());
    return schema;
}

/* `of_model`: it sets something of the model's tree, and has its default there. */
static cJSON *declaration_schema(const char *about, bool of_model)
{
    static const struct param doc = {.type = PARAM_TEXT}, number = {.type = PARAM_FLOAT};
    cJSON *properties, *schema = closed_object(about, &properties);
    cJSON *name = typed("string"), *types;

    cJSON_AddStringToObject(name, "pattern", "^(?!gl_)(?!.*__)[A-Za-z_][A-Za-z0-9_]{0,63}$");
    cJSON_AddItemToObject(properties, "name", name);
    types = cJSON_AddArrayToObject(cJSON_AddObjectToObject(properties, "type"), "enum");
    for (int i = 0; declared_param_types[i]; i++) {
        cJSON_AddItemToArray(types, cJSON_CreateString(declared_param_types[i]));
    }
    for (int i = 0; declared_param_aliases[i].name; i++) {
        cJSON_AddItemToArray(types, cJSON_CreateString(declared_param_aliases[i].name));
    }
    if (of_model) {
        cJSON *sets = typed("string");
        cJSON_AddStringToObject(sets, "pattern",
                                "^/nodes/[^/]+/(params|transform)/[^/.]+(\\.[xyzw])?$");
        cJSON_AddItemToObject(properties, "sets", sets);
    } else {
        cJSON_AddTrueToObject(properties, "default");
    }
    cJSON_AddItemToObject(properties, "range", vector_schema(number_schema(&number), 2));
    cJSON_AddItemToObject(properties, "doc", text_schema(&doc));
    require(schema, "name");
    require(schema, "type");
    if (of_model) {
        require(schema, "sets");
    }
    return schema;
}

/* A node, or one with what may be other in each instance. */
static cJSON *model_schema(void)
{
    cJSON *schema = cJSON_CreateObject();
    cJSON *forms = cJSON_AddArrayToObject(schema, "anyOf");
    cJSON *properties, *form = closed_object(model_type.doc, &properties);

    cJSON_AddItemToObject(properties, model_type.params[0].name,
                          list_schema("setting", LIMIT_DECLARED));
    cJSON_AddItemToObject(properties, "root", reference("node"));
    require(form, "root");
    cJSON_AddItemToArray(forms, reference("node"));
    cJSON_AddItemToArray(forms, form);
    return schema;
}

static void add_document(cJSON *schema, cJSON *properties)
{
    cJSON_AddItemToObject(properties, "format", constant(SCENE_FORMAT));
    add_properties(properties, &scene_info_type);
    cJSON_AddItemToObject(properties, "camera", reference("camera"));
    for (const struct resource_kind *kind = resource_kinds; kind->list; kind++) {
        cJSON_AddItemToObject(properties, kind->list,
                              kind->array ? list_schema(kind->item, (double)kind->limit)
                                          : names_schema(kind->item, (double)kind->limit));
    }
    cJSON_AddItemToObject(properties, "environment", reference("environment"));
    cJSON_AddItemToObject(properties, "render", reference("render"));
    cJSON_AddItemToObject(properties, "root", reference("node"));
    require(schema, "format");
    require(schema, "root");
}

static void add_definitions(cJSON *schema)
{
    const struct record_type *const records[] = {&transform_type,   &camera_type,
                                                 &environment_type, &render_type,
                                                 &primitive_type,   &shader_type};
    cJSON *definitions = cJSON_AddObjectToObject(schema, "$defs");

    for (size_t i = 0; i < sizeof records / sizeof records[0]; i++) {
        cJSON_AddItemToObject(definitions, records[i]->name, record_schema(records[i]));
    }
    cJSON_AddItemToObject(definitions, "declaration",
                          declaration_schema("A parameter that is declared.", false));
    cJSON_AddItemToObject(
        definitions, "setting",
        declaration_schema("A number of a model that instances may have of their own.", true));
    cJSON_AddItemToObject(definitions, "model", model_schema());
    cJSON_AddItemToObject(definitions, "light", listed_schema(light_types));
    cJSON_AddItemToObject(definitions, "volume", listed_schema(volume_types));
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

/* Of what may be absent, and has no default then. */
static cJSON *describe_request(const struct record_type *type)
{
    cJSON *list = describe_params(type), *row;

    cJSON_ArrayForEach(row, list)
    {
        cJSON_DeleteItemFromObjectCaseSensitive(row, "default");
    }
    return list;
}

/* Every type takes children; this says what it is made for. */
static const char *children_word(const struct node_type *type)
{
    static const char *const words[] = {
        [GROUP_PRIMITIVE] = "none", [GROUP_SHAPE] = "none",     [GROUP_OPERATION] = "many",
        [GROUP_MODIFIER] = "one",   [GROUP_STRUCTURE] = "many",
    };

    return type->kind == KIND_MODEL || type->kind == KIND_CODE ? "none" : words[type->group];
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
        cJSON_AddStringToObject(row, "children", children_word(type));
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

/* What a document declares, and by what types. */
static cJSON *describe_resources(void)
{
    cJSON *resources = cJSON_CreateObject();

    cJSON_AddItemToObject(resources, "primitive", describe_params(&primitive_type));
    cJSON_AddItemToObject(resources, "shader", describe_params(&shader_type));
    cJSON_AddItemToObject(resources, "model", describe_params(&model_type));
    cJSON *types = cJSON_AddArrayToObject(resources, "declared_types");
    for (int i = 0; declared_param_types[i]; i++) {
        cJSON_AddItemToArray(types, cJSON_CreateString(declared_param_types[i]));
    }
    return resources;
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

static cJSON *described(const char *name, const char *doc)
{
    cJSON *row = cJSON_CreateObject();

    cJSON_AddStringToObject(row, "name", name);
    cJSON_AddStringToObject(row, "doc", doc);
    return row;
}

/* How numbers become colours: from 0 to the greatest, evenly. */
static cJSON *describe_scale(void)
{
    cJSON *scale = cJSON_CreateObject(), *colors = cJSON_AddArrayToObject(scale, "colors");

    for (int i = 0; i < STEPS_COLORS; i++) {
        const unsigned char *c = steps_colors[i];
        char text[8];
        snprintf(text, sizeof text, "#%02x%02x%02x", c[0], c[1], c[2]);
        cJSON_AddItemToArray(colors, cJSON_CreateString(text));
    }
    cJSON_AddNumberToObject(scale, "greatest", STEPS_WHITE);
    return scale;
}

static cJSON *describe_outputs(void)
{
    cJSON *list = cJSON_CreateArray();

    for (int i = 0; i < AOV_COUNT; i++) {
        const struct aov_row *aov = aov_row(i);
        cJSON *row = described(aov->name, aov->doc);
        cJSON_AddNumberToObject(row, "channels", aov->channels);
        cJSON_AddBoolToObject(row, "picture", aov->picture);
        if (i == AOV_STEPS) {
            cJSON_AddItemToObject(row, "scale", describe_scale());
        }
        cJSON_AddItemToArray(list, row);
    }
    return list;
}

static cJSON *describe_levels(void)
{
    cJSON *list = cJSON_CreateArray();

    for (int i = 0; i < QUALITY_COUNT; i++) {
        const struct quality *level = quality_row(i);
        cJSON_AddItemToArray(list, described(quality_names[i], level->doc));
    }
    return list;
}

static cJSON *describe_stages(void)
{
    cJSON *list = cJSON_CreateArray();

    for (int i = 0; i < FRAME_STAGES; i++) {
        const struct stage_row *stage = stage_row(i);
        cJSON_AddItemToArray(list, described(stage->name, stage->doc));
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
    cJSON_AddItemToObject(registry, "volumes", describe_types(volume_types));
    cJSON_AddItemToObject(registry, "shaders", describe_types(shader_types));
    cJSON_AddItemToObject(registry, "resources", describe_resources());
    cJSON_AddItemToObject(registry, "camera", describe_params(&camera_type));
    cJSON_AddItemToObject(registry, "environment", describe_params(&environment_type));
    cJSON_AddItemToObject(registry, "render", describe_params(&render_type));
    cJSON_AddItemToObject(registry, "outputs", describe_outputs());
    cJSON_AddItemToObject(registry, "levels", describe_levels());
    cJSON_AddItemToObject(registry, "stages", describe_stages());
    cJSON_AddItemToObject(registry, "picture", describe_request(&picture_type));
    cJSON_AddItemToObject(registry, "section", describe_request(&section_type));
    cJSON_AddItemToObject(registry, "ideal", describe_params(&ideal_type));
    cJSON_AddItemToObject(registry, "implicitize", describe_params(&surface_question_type));
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
