/* SPDX-License-Identifier: MIT */
/* The schema holds every table, and its references lead somewhere. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "protocol/limits.h"
#include "protocol/messages.h"
#include "protocol/nodes.h"
#include "protocol/picture.h"
#include "protocol/schema.h"

static cJSON *schema;

static int set_up(void **state)
{
    (void)state;
    schema = schema_build();
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    cJSON_Delete(schema);
    return 0;
}

/* "a/b/c" below `json`; fails where a step is missing. */
static const cJSON *at(const cJSON *json, const char *path)
{
    char copy[200], *save = NULL;

    snprintf(copy, sizeof copy, "%s", path);
    for (char *name = strtok_r(copy, "/", &save); name; name = strtok_r(NULL, "/", &save)) {
        const cJSON *next = cJSON_GetObjectItemCaseSensitive(json, name);
        if (!next) {
            fail_msg("the schema has no %s (at %s)", path, name);
        }
        json = next;
    }
    return json;
}

static void check_references(const cJSON *json)
{
    const char *reference = json_member_text(json, "$ref", NULL);

    if (reference) {
        assert_int_equal(strncmp(reference, "#/", 2), 0);
        at(schema, reference + 2);
    }
    for (const cJSON *item = json->child; item; item = item->next) {
        check_references(item);
    }
}

static void is_a_schema(void **state)
{
    (void)state;
    assert_string_equal(at(schema, "$schema")->valuestring,
                        "https://json-schema.org/draft/2020-12/schema");
    assert_true(cJSON_IsFalse(at(schema, "additionalProperties")));
    assert_string_equal(at(schema, "properties/format/const")->valuestring, "fieldcast/1");
    check_references(schema);
    char *text = json_print(schema, true);
    struct error err = {0};
    cJSON *again = json_parse(text, strlen(text), &err);
    assert_non_null(again); /* our own pre-scan takes it */
    cJSON_Delete(again);
    free(text);
}

static const cJSON *rule_for(const char *type)
{
    const cJSON *rule;

    cJSON_ArrayForEach(rule, at(schema, "$defs/node/allOf"))
    {
        if (strcmp(at(rule, "if/properties/type/const")->valuestring, type) == 0) {
            return at(rule, "then/properties/params");
        }
    }
    fail_msg("no rule for %s", type);
    return NULL;
}

static void every_node_has_a_rule(void **state)
{
    (void)state;
    assert_int_equal(cJSON_GetArraySize(at(schema, "$defs/node/properties/type/enum")),
                     (int)node_type_count());
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct record_type *type = &node_type_at(i)->record;
        const cJSON *params = rule_for(type->name);
        assert_int_equal(cJSON_GetArraySize(at(params, "properties")),
                         (int)record_type_count(type));
        for (const struct param *param = type->params; param->name; param++) {
            assert_string_equal(
                at(at(at(params, "properties"), param->name), "description")->valuestring,
                param->doc);
        }
    }
    const cJSON *radius = at(rule_for("sphere"), "properties/radius");
    assert_float_equal(at(radius, "exclusiveMinimum")->valuedouble, 0, 0);
    assert_float_equal(at(radius, "maximum")->valuedouble, LIMIT_COORDINATE, 0);
    assert_float_equal(at(radius, "default")->valuedouble, 0.5, 0);
    assert_string_equal(at(rule_for("repeat"), "properties/count/items/type")->valuestring,
                        "integer");
    assert_int_equal(cJSON_GetArraySize(at(schema, "$defs/transform/properties/scale/anyOf")), 2);
    assert_int_equal(cJSON_GetArraySize(at(rule_for("plane"), "properties/normal/not/const")), 3);
}

static void what_documents_declare(void **state)
{
    (void)state;
    static const char *const lists[] = {"primitives", "shaders", "materials", "models"};

    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++) {
        const cJSON *list = at(at(schema, "properties"), lists[i]);
        assert_true(at(list, "maxProperties")->valuedouble > 1);
        at(list, "additionalProperties/$ref");
    }
    assert_string_equal(at(schema, "$defs/primitive/properties/params/items/$ref")->valuestring,
                        "#/$defs/declaration");
    assert_float_equal(at(schema, "$defs/shader/properties/code/maxLength")->valuedouble,
                       LIMIT_CODE_BYTES, 0);
    assert_null(cJSON_GetObjectItem(rule_for("field"), "additionalProperties"));
    assert_null(cJSON_GetObjectItem(rule_for("model"), "additionalProperties"));
    assert_true(cJSON_IsFalse(at(rule_for("sphere"), "additionalProperties")));
    assert_string_equal(at(schema, "$defs/model/anyOf")->child->child->valuestring, "#/$defs/node");
    const cJSON *form = at(schema, "$defs/model/anyOf")->child->next;
    assert_string_equal(at(form, "properties/params/items/$ref")->valuestring, "#/$defs/setting");
    assert_null(cJSON_GetObjectItem(at(schema, "$defs/setting/properties"), "default"));
    at(schema, "$defs/setting/properties/sets/pattern");
    assert_float_equal(at(rule_for("polygon"), "properties/points/minItems")->valuedouble, 3, 0);
    const cJSON *surface = at(rule_for("implicit"), "properties/parametric");
    assert_int_equal(cJSON_GetArraySize(at(surface, "properties")), 7);
    assert_true(cJSON_IsFalse(at(surface, "additionalProperties")));
    assert_float_equal(at(surface, "anyOf")->child->child->valuedouble, 0, 0);
    assert_float_equal(at(at(surface, "anyOf")->child->next, "minProperties")->valuedouble, 5, 0);
    int forms = cJSON_GetArraySize(at(schema, "$defs/material/oneOf")), built_in = 0;
    while (shader_types[built_in].name) {
        built_in++;
    }
    assert_int_equal(forms, built_in + 1);
}

static void lists_are_described(void **state)
{
    (void)state;
    static const struct {
        const char *list, *of;
        const struct record_type *types;
    } lists[] = {{"lights", "light", light_types}, {"volumes", "volume", volume_types}};
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++) {
        const cJSON *list = at(at(schema, "properties"), lists[i].list);
        const cJSON *form = at(at(at(schema, "$defs"), lists[i].of), "oneOf")->child;
        assert_non_null(strstr(at(list, "items/$ref")->valuestring, lists[i].of));
        for (const struct record_type *type = lists[i].types; type->name; type++) {
            assert_string_equal(at(form, "properties/type/const")->valuestring, type->name);
            assert_int_equal(cJSON_GetArraySize(at(form, "properties")),
                             (int)record_type_count(type) + 2);
            form = form->next;
        }
        assert_null(form);
    }
    assert_string_equal(at(schema, "$defs/environment/properties/image/pattern")->valuestring,
                        "^([0-9a-f]{64})?$");
}

static void assert_described(const cJSON *rows, const struct record_type *type)
{
    assert_int_equal(cJSON_GetArraySize(rows), (int)record_type_count(type));
    for (int i = 0; type->params[i].name; i++) {
        cJSON *expected = param_describe(&type->params[i]);
        assert_true(cJSON_Compare(cJSON_GetArrayItem(rows, i), expected, true));
        cJSON_Delete(expected);
    }
}

/* What a condition names stands in the same record, and can hold what it is compared with. */
static void assert_condition(const struct record_type *type, const struct param *param)
{
    char name[64] = "";
    const char *at = param->when + strcspn(param->when, "!=~");

    memcpy(name, param->when, (size_t)(at - param->when));
    const char kind = *at;
    at += kind == '!';
    assert_int_equal(*at, kind == '~' ? '~' : '=');
    const struct param *other = type->params;
    while (other->name && strcmp(other->name, name) != 0) {
        other++;
    }
    assert_non_null(other->name);
    assert_ptr_not_equal(other, param);
    if (kind == '~') {
        assert_true(other->type == PARAM_EQUATION || other->type == PARAM_SURFACE);
        assert_string_equal(at + 1, param->name);
        return;
    }
    cJSON *value = other->type == PARAM_ENUM ? cJSON_CreateString(at + 1) : cJSON_Parse(at + 1);
    double read[4];
    assert_true(param_read(other, value, read, "", NULL));
    cJSON_Delete(value);
}

static void conditions_are_described(void **state)
{
    (void)state;
    const struct record_type *const tables[] = {light_types, shader_types, volume_types};
    const struct record_type *const records[] = {&camera_type, &environment_type, &render_type};
    int found = 0;

    for (size_t i = 0; i < 3; i++) {
        for (const struct record_type *type = tables[i]; type->name; type++) {
            for (const struct param *param = type->params; param->name; param++) {
                if (param->when) {
                    assert_condition(type, param);
                    found++;
                }
            }
        }
        for (const struct param *param = records[i]->params; param->name; param++) {
            if (param->when) {
                assert_condition(records[i], param);
                found++;
            }
        }
    }
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct record_type *type = &node_type_at(i)->record;
        for (const struct param *param = type->params; param->name; param++) {
            if (param->when) {
                assert_condition(type, param);
                found++;
            }
        }
    }
    assert_true(found > 0);
}

/* Words for one thing on two scales; the page converts between them. */
static bool is_converted(const char *word)
{
    static const char *const words[] = {"gloss", "roughness", "opacity", "transmission"};

    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strcmp(words[i], word) == 0) {
            return true;
        }
    }
    return false;
}

/* A word is said once in each shader, and by another one too, else it says nothing. */
static void assert_meaning(const struct record_type *shader, const struct param *param)
{
    int others = 0;

    for (const struct record_type *type = shader_types; type->name; type++) {
        for (const struct param *row = type->params; row->name; row++) {
            if (row != param && row->means && strcmp(row->means, param->means) == 0) {
                assert_ptr_not_equal(type, shader);
                others++;
            }
        }
    }
    assert_true(others > 0 || is_converted(param->means));
}

static void meanings_are_described(void **state)
{
    (void)state;
    int found = 0;

    for (const struct record_type *type = shader_types; type->name; type++) {
        for (const struct param *param = type->params; param->name; param++) {
            if (param->means) {
                assert_meaning(type, param);
                found++;
            }
        }
    }
    assert_true(found > 0);
}

/* A word for 0 stands where 0 can, and the description says what it is. */
static void words_for_zero_are_described(void **state)
{
    (void)state;
    const struct record_type *const records[] = {&camera_type, &environment_type, &render_type};
    int found = 0;

    for (size_t i = 0; i < 3; i++) {
        for (const struct param *param = records[i]->params; param->name; param++) {
            if (param->zero) {
                double low, high;
                param_range(param, &low, &high);
                assert_true(low == 0 && !param->above_min && !param->nonzero);
                assert_non_null(strstr(param->doc, "0: "));
                found++;
            }
        }
    }
    assert_true(found > 0);
}

static void outputs_levels_stages(void **state)
{
    (void)state;
    const cJSON *registry = at(schema, "x-fieldcast");

    assert_int_equal(cJSON_GetArraySize(at(registry, "outputs")), AOV_COUNT);
    assert_string_equal(json_member_text(at(registry, "outputs")->child, "name", ""), "color");
    assert_int_equal(cJSON_GetArraySize(at(registry, "levels")), QUALITY_COUNT);
    assert_string_equal(json_member_text(at(registry, "levels")->child, "name", ""), "draft");
    assert_int_equal(cJSON_GetArraySize(at(registry, "stages")), FRAME_STAGES);
    assert_string_equal(json_member_text(at(registry, "stages")->child, "name", ""), "queue");
}

static void registry_is_complete(void **state)
{
    (void)state;
    const cJSON *registry = at(schema, "x-fieldcast");
    static const char *const members[] = {"type",  "group",    "exactness", "doc",
                                          "words", "children", "params"};

    assert_int_equal(cJSON_GetArraySize(at(registry, "nodes")), (int)node_type_count());
    for (size_t i = 0; i < node_type_count(); i++) {
        const cJSON *row = cJSON_GetArrayItem(at(registry, "nodes"), (int)i);
        for (size_t m = 0; m < sizeof members / sizeof members[0]; m++) {
            at(row, members[m]);
        }
        assert_string_equal(at(row, "type")->valuestring, node_type_at(i)->record.name);
        assert_described(at(row, "params"), &node_type_at(i)->record);
    }
    assert_described(at(registry, "node"), &node_common_type);
    assert_described(at(registry, "transform"), &transform_type);
    assert_described(at(registry, "camera"), &camera_type);
    assert_int_equal(cJSON_GetArraySize(at(registry, "section")),
                     (int)record_type_count(&section_type));
    assert_described(at(registry, "environment"), &environment_type);
    assert_described(at(registry, "render"), &render_type);
    for (int i = 0; light_types[i].name; i++) {
        const cJSON *row = cJSON_GetArrayItem(at(registry, "lights"), i);
        assert_described(at(row, "params"), &light_types[i]);
    }
    for (int i = 0; volume_types[i].name; i++) {
        const cJSON *row = cJSON_GetArrayItem(at(registry, "volumes"), i);
        assert_described(at(row, "params"), &volume_types[i]);
    }
    for (int i = 0; shader_types[i].name; i++) {
        const cJSON *row = cJSON_GetArrayItem(at(registry, "shaders"), i);
        assert_described(at(row, "params"), &shader_types[i]);
    }
    assert_described(at(registry, "resources/primitive"), &primitive_type);
    assert_described(at(registry, "resources/shader"), &shader_type);
    assert_described(at(registry, "resources/model"), &model_type);
    assert_string_equal(at(registry, "resources/declared_types")->child->valuestring, "float");
    size_t limits;
    limits_table(&limits);
    assert_int_equal(cJSON_GetArraySize(at(registry, "limits")), (int)limits);
    assert_string_equal(json_member_text(at(registry, "errors")->child, "code", ""), "syntax");
    at(registry, "messages/client");
    at(registry, "messages/server");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(is_a_schema, set_up, tear_down),
        cmocka_unit_test_setup_teardown(every_node_has_a_rule, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_documents_declare, set_up, tear_down),
        cmocka_unit_test_setup_teardown(lists_are_described, set_up, tear_down),
        cmocka_unit_test_setup_teardown(registry_is_complete, set_up, tear_down),
        cmocka_unit_test_setup_teardown(outputs_levels_stages, set_up, tear_down),
        cmocka_unit_test(conditions_are_described),
        cmocka_unit_test(meanings_are_described),
        cmocka_unit_test(words_for_zero_are_described),
    };

    return cmocka_run_group_tests_name("schema", tests, NULL, NULL);
}
