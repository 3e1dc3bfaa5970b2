/* SPDX-License-Identifier: MIT */
#include "compiled.h"

#include <stdlib.h>

#include "protocol/json.h"

struct field *compile_field(const struct scene *scene)
{
    struct error err = {0};
    struct field *field = field_compile(scene, &err);

    if (!field) {
        error_print(&err, stderr);
        abort();
    }
    return field;
}

char *root_text(const struct scene *scene)
{
    cJSON *json = node_to_json(scene->root);
    char *text = json_print(json, false);

    cJSON_Delete(json);
    return text;
}
