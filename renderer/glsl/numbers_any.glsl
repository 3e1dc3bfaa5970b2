/* SPDX-License-Identifier: MIT */
/* Stands between map() and surface(): from here on N takes indices that are not constant. */
#undef N
#define N(i) N_ANY(i)
