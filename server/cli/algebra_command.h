/* SPDX-License-Identifier: MIT */
/* What the commands of the algebra share. */
#ifndef SERVER_ALGEBRA_COMMAND_H
#define SERVER_ALGEBRA_COMMAND_H

#include "server/algebra.h"

/* Asks once and prints the answer as JSON; an error goes to stderr. The exit status. */
int algebra_command_run(bool (*ask)(struct algebra *algebra, const void *question, cJSON **out,
                                    struct error *err),
                        const void *question);

#endif
