/* SPDX-License-Identifier: MIT */
/* fieldcast schema: the JSON Schema of scene documents, or all of it to read. */
#include <stdlib.h>

#include "command.h"
#include "protocol/json.h"
#include "protocol/reference.h"
#include "protocol/schema.h"

static char *schema_text(void)
{
    cJSON *schema = schema_build();
    char *text = json_print(schema, true);

    cJSON_Delete(schema);
    return text;
}

int command_schema(const struct options *options)
{
    const bool reference = option_flag(options, OPTION_REFERENCE);
    char *text = reference ? reference_markdown() : schema_text();

    fputs(text, stdout);
    fputs(reference ? "" : "\n", stdout);
    free(text);
    return EXIT_OK;
}
