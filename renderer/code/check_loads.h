/* SPDX-License-Identifier: MIT */
/* What drivers take long to compile, beyond what it takes to run: added to the size of code, not to
 * its work. Private to this folder. */
#ifndef RENDERER_CODE_CHECK_LOADS_H
#define RENDERER_CODE_CHECK_LOADS_H

#include "tree.h"

/* Components times weight of a call of the table. */
long check_work_of_builtin(const struct expr *expr);
/* Of the expression itself, without what is in it. */
long check_load(const struct expr *expr);
/* Of all indices in a place that is assigned to, beyond reading them. */
long check_load_written(const struct expr *place);
/* Of the statement itself, without what is in it. */
long check_load_of_statement(const struct stmt *stmt);

#endif
