/* SPDX-License-Identifier: MIT */
/* Groebner bases for people who want to see how they are made. One thread. */
#ifndef RENDERER_ALGEBRA_WORKBENCH_H
#define RENDERER_ALGEBRA_WORKBENCH_H

#include <cjson/cJSON.h>
#include <stdio.h>

#include "groebner.h"
#include "protocol/record.h"

/* `asked`: ideal_type. Prints a line of JSON for each step to `steps`: {"pair": [i, j], "outcome",
 * "degree", "sugar", "divisions", "waiting"}, for a pair that was added also "element", "leading"
 * and "terms"; elements count from 0, the generators first. The first 2,000 are reported, then one
 * in a hundred. The answer is {"letters", "basis", "counts", "cpu_ms"}, with
 * "elimination" where letters are eliminated, and with "quotients", "rest" and "scale" of a
 * dividend. NULL: `err`. */
cJSON *workbench_basis(const struct record *asked, FILE *steps, struct error *err);
/* {"made", "coprime", "chain", "zero", "added", "divisions", "degree"} */
cJSON *workbench_counts(const struct groebner_counts *counts);

#endif
