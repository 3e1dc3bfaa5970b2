/* SPDX-License-Identifier: MIT */
/* fieldcast schema: the JSON Schema of scene documents. */
#include <stdlib.h>

#include "command.h"
#include "protocol/json.h"
#include "protocol/schema.h"

int command_schema(const struct options *options)
{
    (void)options;
    cJSON *schema = schema_build();
    char *text = json_print(schema, true);
    puts(text);
    free(text);
    cJSON_Delete(schema);
    return fflush(stdout) == 0 ? EXIT_OK : EXIT_FAILED;
}
