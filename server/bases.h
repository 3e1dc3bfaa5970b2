/* SPDX-License-Identifier: MIT */
/* Groebner bases that are made while the client who asked looks on. A client that knows the id may
 * look and cancel. The newest ones are kept, of one client a quarter at most. Any thread. */
#ifndef SERVER_BASES_H
#define SERVER_BASES_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>

#include "protocol/record.h"
#include "server/algebra.h"

struct bases;

enum { BASIS_ID_BYTES = 33 };

struct bases *bases_create(struct algebra *algebra);
void bases_destroy(struct bases *bases); /* after algebra_destroy; may be NULL */

/* Begins one when it is the client's turn. `asked`: ideal_type, copied. */
bool bases_add(struct bases *bases, const char *client, const struct record *asked,
               char out_id[BASIS_ID_BYTES], struct error *err);
/* {"state": waiting, running, done, failed or cancelled, "steps": those from number `from` on,
 * "next": the number after them, "answer" or "error"}; NULL: there is none. Caller frees. */
cJSON *bases_look(struct bases *bases, const char *id, size_t from);
bool bases_cancel(struct bases *bases, const char *id); /* false: there is none */

#endif
