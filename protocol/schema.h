/* SPDX-License-Identifier: MIT */
/* The tables as JSON Schema 2020-12. Besides the standard keywords the result has the member
 * "x-fieldcast": the registry as the editor reads it (README.md). */
#ifndef PROTOCOL_SCHEMA_H
#define PROTOCOL_SCHEMA_H

#include <cjson/cJSON.h>

/* Caller frees. */
cJSON *schema_build(void);

#endif
