/* SPDX-License-Identifier: MIT */
/* A question about an ideal of polynomials, as command line, REST and page ask it: one record. What
 * the names mean stands in renderer/algebra/order.h and groebner.h. */
#ifndef PROTOCOL_IDEAL_H
#define PROTOCOL_IDEAL_H

#include "record.h"

enum order_kind { ORDER_LEX, ORDER_GRLEX, ORDER_GREVLEX };
extern const char *const order_names[]; /* NULL at the end, as below */

enum pair_strategy { STRATEGY_NORMAL, STRATEGY_SUGAR, STRATEGY_FIRST };
extern const char *const strategy_names[];

/* By which pairs are left out. */
enum criteria { CRITERIA_BOTH, CRITERIA_COPRIME, CRITERIA_CHAIN, CRITERIA_NONE };
extern const char *const criteria_names[];

extern const struct record_type ideal_type;

#endif
