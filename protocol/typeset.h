/* SPDX-License-Identifier: MIT */
/* Texts of equations, typeset or with their errors, for whoever types them. Pure. */
#ifndef PROTOCOL_TYPESET_H
#define PROTOCOL_TYPESET_H

#include <cjson/cJSON.h>

#include "record.h"

/* What an equation is of: a node `implicit`, a shader `map`, a part of a surface. */
enum typeset_form { TYPESET_EQUATION, TYPESET_FUNCTION, TYPESET_EXPRESSION, TYPESET_FORMS };
extern const char *const typeset_forms[]; /* NULL at the end */

/* What is asked: `text` and `form`. */
extern const struct record_type typeset_type;
/* {"lines": [MathML]}, one for each definition and the last for the equation, or
 * {"errors": [{"line", "column", "message"}]}. Caller deletes. */
cJSON *typeset(const struct record *asked);

#endif
