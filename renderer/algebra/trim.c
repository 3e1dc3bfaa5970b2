/* SPDX-License-Identifier: MIT */
#include "trim.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#define THICKNESS 0.01 /* of the longest side */

/* A child of `parent`; its parameters. */
static cJSON *add_child(cJSON *children, const char *type)
{
    cJSON *node = cJSON_CreateObject();

    cJSON_AddItemToArray(children, node);
    cJSON_AddStringToObject(node, "type", type);
    return cJSON_AddObjectToObject(node, "params");
}

static double two_digits(double number)
{
    char text[32];

    snprintf(text, sizeof text, "%.1e", number);
    return strtod(text, NULL);
}

cJSON *trim_node(const char *equation, const cJSON *parametric, const double size[3])
{
    const double thickness = two_digits(THICKNESS * fmax(fmax(size[0], size[1]), size[2]));
    cJSON *node = cJSON_CreateObject();

    cJSON_AddStringToObject(node, "type", "intersection");
    cJSON *children = cJSON_AddArrayToObject(node, "children");
    cJSON *sheet = add_child(children, "implicit"), *patch = add_child(children, "parametric");
    cJSON_AddStringToObject(sheet, "equation", equation);
    cJSON_AddItemToObject(sheet, "parametric", cJSON_Duplicate(parametric, true));
    cJSON_AddStringToObject(sheet, "mode", "sheet");
    cJSON_AddItemToObject(sheet, "size", cJSON_CreateDoubleArray(size, 3));
    cJSON_AddNumberToObject(sheet, "thickness", thickness);
    cJSON_AddItemToObject(patch, "surface", cJSON_Duplicate(parametric, true));
    cJSON_AddNumberToObject(patch, "thickness", 2 * thickness);
    return node;
}
