/* SPDX-License-Identifier: MIT */
/* Fractals, minimal surfaces and landscapes; in C they are in renderer/sdf/fractals.c. */
