/* SPDX-License-Identifier: MIT */
/* A strict reader of handles (struct param): where they are for the values of a record. */
#ifndef TESTS_SUPPORT_HANDLE_H
#define TESTS_SUPPORT_HANDLE_H

#include "protocol/record.h"

enum { HANDLE_POINTS = 4 };

/* `skin` is a point of the surface of a ball or disc of this radius, on the x axis, with `out`
 * along it. */
#define HANDLE_SKIN 0.5

/* How many points there are; 0: the text cannot be read, has more than HANDLE_POINTS, or names what
 * is neither a number of the record nor one of these. */
int handle_points(const char *text, const struct record *record, double out[HANDLE_POINTS][3]);

#endif
