/* SPDX-License-Identifier: MIT */
/* The patch alone as a node: the sheet of its equation where it is within the parametric surface,
 * which is a sheet of twice the thickness. So it ends half of that behind the ends of the ranges,
 * and what lies as near to the patch elsewhere stays too. */
#ifndef RENDERER_ALGEBRA_TRIM_H
#define RENDERER_ALGEBRA_TRIM_H

#include <cjson/cJSON.h>

/* `equation` is a polynomial; `parametric` is what surface_read takes. Caller deletes. */
cJSON *trim_node(const char *equation, const cJSON *parametric, const double size[3]);

#endif
