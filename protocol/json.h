/* SPDX-License-Identifier: MIT */
/* Strict JSON: one pass over the bytes refuses what cJSON would let through, before cJSON sees
 * them. RFC 8259, UTF-8 (RFC 3629), depth, counts, string and number lengths, duplicate keys,
 * finite numbers, no NUL. */
#ifndef PROTOCOL_JSON_H
#define PROTOCOL_JSON_H

#include <cjson/cJSON.h>
#include <stddef.h>

#include "error.h"

/* Pre-scan and parse exactly `length` bytes. NULL and `err` ("line 3, column 7") on failure. */
cJSON *json_parse(const char *text, size_t length, struct error *err);
/* The same of what json_print has written, in any number of bytes and values: a scene that grows by
 * edits may become longer than what one client may send. */
cJSON *json_parse_printed(const char *text, size_t length, struct error *err);

/* Sorts the members of an object that may have `names` (NULL-terminated) and no other: that of
 * name i goes to found[i], NULL where absent. */
bool json_sort_members(const cJSON *object, const char *const *names, const cJSON **found,
                       const char *place, struct error *err);
/* The text of a member that has to be there: `json` is NULL where it is missing. */
bool json_read_text(const cJSON *json, const char **out, const char *place, const char *member,
                    struct error *err);

/* The shortest decimal text that reads back as the same number, in the form of ECMAScript's
 * Number::toString (-0 becomes 0, what is not finite becomes null); `out` holds 32 bytes. */
void json_number(double value, char out[32]);
/* Compact or pretty text; caller frees. Same input, same bytes;
 * numbers as json_number writes them (cJSON's own printer rounds). */
char *json_print(const cJSON *json, bool pretty);

#endif
