/* SPDX-License-Identifier: MIT */
/* Questions of the algebra (algebra_ask) that are answered while the client who asked looks on. A
 * client that knows the id may look and cancel. The newest ones are kept, of one client a quarter
 * at most. Any thread. */
#ifndef SERVER_QUESTIONS_H
#define SERVER_QUESTIONS_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>

#include "protocol/record.h"
#include "server/algebra.h"

struct questions;

enum { QUESTION_ID_BYTES = 33 };

struct questions *questions_create(struct algebra *algebra);
void questions_destroy(struct questions *questions); /* after algebra_destroy; may be NULL */

/* Begins one when it is the client's turn. Copies `asked`. */
bool questions_add(struct questions *questions, const char *client, const struct record *asked,
                   char out_id[QUESTION_ID_BYTES], struct error *err);
/* {"state": waiting, running, done, failed or cancelled, "steps": those from number `from` on,
 * "next": the number after them, "answer" or "error"}; NULL: there is none of this type. Steps and
 * answer are raw, so it can only be printed. Caller frees. */
cJSON *questions_look(struct questions *questions, const struct record_type *type, const char *id,
                      size_t from);
/* False: there is none of this type. */
bool questions_cancel(struct questions *questions, const struct record_type *type, const char *id);

#endif
