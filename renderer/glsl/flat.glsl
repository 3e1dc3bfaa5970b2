/* SPDX-License-Identifier: MIT */
/* Distance functions of two-dimensional shapes; in C they are in renderer/sdf/flat.c. */
