/* SPDX-License-Identifier: MIT */
/* Numbers that many files use. */

#define PI 3.14159265
#define HALF_MAX 65504.0 /* the greatest number of 16 bits */
#define INFINITY uintBitsToFloat(0x7f800000u)
