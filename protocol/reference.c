/* SPDX-License-Identifier: MIT */
/* Markdown out of the tables. */
#include "reference.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "limits.h"
#include "memory.h"
#include "nodes.h"
#include "picture.h"

struct page {
    char *text;
    size_t length, capacity;
};

static void add(struct page *page, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void add(struct page *page, const char *format, ...)
{
    char piece[2048];
    va_list args;

    va_start(args, format);
    size_t length = (size_t)vsnprintf(piece, sizeof piece, format, args);
    va_end(args);
    length = length < sizeof piece ? length : sizeof piece - 1;
    if (page->length + length + 1 > page->capacity) {
        page->capacity = 2 * (page->length + length + 1);
        page->text = memory_resize(page->text, page->capacity, 1);
    }
    memcpy(page->text + page->length, piece, length + 1);
    page->length += length;
}

static void add_default(struct page *page, const struct param *param)
{
    cJSON *json = param_default(param);
    char *text = json_print(json, false);

    add(page, "%s", strcmp(text, "\"\"") == 0 ? "–" : text);
    free(text);
    cJSON_Delete(json);
}

static void add_range(struct page *page, const struct param *param)
{
    char low[32], high[32];
    double min, max;

    if (param->choices) {
        for (int i = 0; param->choices[i]; i++) {
            add(page, "%s`%s`", i ? " " : "", param->choices[i]);
        }
        return;
    }
    if (param->min == 0 && param->max == 0 && param->type != PARAM_COLOR) {
        add(page, param->direction ? "not all 0" : param->nonzero ? "not 0" : "");
        return;
    }
    param_range(param, &min, &max);
    json_number(min, low);
    json_number(max, high);
    if (max < LIMIT_COORDINATE) {
        add(page, "%s%s to %s", param->above_min ? "above " : "", low, high);
    } else {
        add(page, "%s %s", param->above_min ? "above" : "from", low);
    }
}

static void add_params(struct page *page, const struct record_type *type)
{
    if (!type->params->name) {
        return;
    }
    add(page, "| parameter | type | default | range | |\n|---|---|---|---|---|\n");
    for (const struct param *param = type->params; param->name; param++) {
        add(page, "| `%s` | %s%s%s | ", param->name, param_type_name(param->type),
            param->unit != UNIT_NONE ? ", " : "",
            param->unit != UNIT_NONE ? param_unit_name(param->unit) : "");
        add_default(page, param);
        add(page, " | ");
        add_range(page, param);
        add(page, " | %s |\n", param->doc);
    }
    add(page, "\n");
}

static void add_node(struct page *page, const struct node_type *type)
{
    const char *name = type->record.name;
    const bool measured = type->group == GROUP_PRIMITIVE || type->group == GROUP_SHAPE;

    add(page, "### %s\n<img src=\"reference/%s.jpg\" width=\"192\" height=\"144\" alt=\"\">\n\n%s",
        name, name, type->record.doc);
    if (measured) {
        add(page, type->exactness == EXACT ? " Exact distance." : " A bound of the distance.");
    }
    if (type->creased) {
        add(page,
            " It has creases within every pixel: a normal is that of some place in the pixel, "
            "and a depth is right to two pixels' width.");
    }
    add(page, "\n\n");
    add_params(page, &type->record);
    add(page, "Source: %s\n\n", type->source);
}

static void add_nodes(struct page *page)
{
    static const struct {
        enum node_group group;
        const char *title, *text;
    } groups[] = {
        {GROUP_PRIMITIVE, "Primitives", "Solids; with children they are their union."},
        {GROUP_SHAPE, "Two-dimensional shapes",
         "Made for `extrude` and `revolve`; alone they are prisms without an end along Z."},
        {GROUP_OPERATION, "Operations", "They combine all their children in order."},
        {GROUP_MODIFIER, "Modifiers", "They change the union of their children."},
        {GROUP_STRUCTURE, "Structure", "Order, instances, and code of your own."},
    };
    for (size_t i = 0; i < sizeof groups / sizeof groups[0]; i++) {
        add(page, "## %s\n%s\n\n", groups[i].title, groups[i].text);
        const struct node_type *type;
        for (size_t k = 0; (type = node_type_at(k)); k++) {
            if (type->group == groups[i].group) {
                add_node(page, type);
            }
        }
    }
}

static void add_record(struct page *page, const char *level, const struct record_type *type)
{
    add(page, "%s %s\n%s\n\n", level, type->name, type->doc);
    add_params(page, type);
}

static void add_outputs(struct page *page)
{
    add(page, "## Outputs\nWhat can be asked of a picture; the array forms are numbers as they are."
              "\n\n| output | numbers | picture | |\n|---|---|---|---|\n");
    for (int i = 0; i < AOV_COUNT; i++) {
        const struct aov_row *aov = aov_row(i);
        add(page, "| `%s` | %d %s | %s | %s |\n", aov->name, aov->channels,
            aov->whole ? "uint32" : "float32", aov->picture ? "yes" : "no", aov->doc);
    }
    add(page, "\nThe picture of `steps` is black where there are none and white from %d on.\n\n",
        STEPS_WHITE);
}

static void add_limits(struct page *page)
{
    size_t count;
    const struct limit *limits = limits_table(&count);

    add(page, "## Limits\n| limit | | |\n|---|---|---|\n");
    for (size_t i = 0; i < count; i++) {
        add(page, "| `%s` | %ld %s | %s |\n", limits[i].name, limits[i].value, limits[i].unit,
            limits[i].doc);
    }
}

char *reference_markdown(void)
{
    static const struct {
        const char *title, *text;
        const struct record_type *types;
    } lists[] = {
        {"Lights",
         "What a matt surface throws back of a light goes evenly to all sides: facing a light of "
         "colour times intensity L it is as bright as its own colour times L / pi. Highlights of "
         "`standard` add up to what is mirrored of L. Surroundings as bright as 1 everywhere make "
         "a white surface 1. So a light of intensity pi is what other programs call 1.",
         light_types},
        {"Volumes", "Up to `volumes` of them, which may overlap: their densities add up.",
         volume_types},
        {"Shaders",
         "A surface transmits light where `transmission` is above 0, or `opacity` is below 1. "
         "Light that is not reflected is refracted. The colour of `standard` tints it; other "
         "shaders do not. Inside, the attenuation absorbs a part of it. A property whose row does "
         "not mention transmitted light does not change it. The face of a cut has the material of "
         "the cutting node: an opaque node cuts opaque faces into glass, and glass cuts no "
         "transmissive face into an opaque node.",
         shader_types}};
    static const struct record_type *const records[] = {
        &node_common_type, &transform_type, &camera_type, &environment_type,
        &render_type,      &primitive_type, &shader_type, &model_type};
    struct page page = {0};
    add(&page, "# Reference\nEverything that a scene may hold. Written by `make docs` out of the "
               "tables of this folder.\n\n");
    add_nodes(&page);
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++) {
        add(&page, "## %s\n%s\n\n", lists[i].title, lists[i].text);
        for (const struct record_type *type = lists[i].types; type->name; type++) {
            add_record(&page, "###", type);
        }
    }
    for (size_t i = 0; i < sizeof records / sizeof records[0]; i++) {
        add_record(&page, "##", records[i]);
    }
    add_outputs(&page);
    add_limits(&page);
    return page.text;
}
