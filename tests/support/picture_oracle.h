/* SPDX-License-Identifier: MIT */
/* Large pictures of scenes in files against the C evaluator, at some of their pixels.
 *
 * Normals are gradients over half of a pixel's footprint, which is half a pixel in radius, by
 * either way. A depth is off when the place is farther from the surface than one footprint,
 * measured at right angles to it, and farther along the ray than a thousandth. */
#ifndef TESTS_SUPPORT_PICTURE_ORACLE_H
#define TESTS_SUPPORT_PICTURE_ORACLE_H

#include "oracle.h"

enum { PICTURE_ORACLE_WIDTH = 640, PICTURE_ORACLE_HEIGHT = 360 };

/* Every so manyth pixel each way of the scene in a file is asked for. */
struct oracle *picture_oracle_create(const char *path, int every);
/* Of the scene in a file, as drawn. */
struct oracle_tally picture_oracle_judge(const struct oracle *oracle, struct renderer *renderer,
                                         const char *path);
/* `rough`: depth and normal are not looked at. */
bool picture_oracle_agrees(const char *path, const struct oracle_tally *tally, bool rough);
/* Asks and judges; the picture has to be more than a quarter covered. */
void picture_oracle_assert(struct renderer *renderer, const char *path, int every, bool rough);

#endif
