/* SPDX-License-Identifier: MIT */
/* Users' code by chance, the same on every machine. */
#ifndef TESTS_SUPPORT_RANDOM_CODE_H
#define TESTS_SUPPORT_RANDOM_CODE_H

#include "random_scene.h"

/* A distance function of several statements; all numbers in it stay small. Caller frees. */
char *random_code_make(struct random *random);
/* Changes a few characters: what comes of it seldom means anything. */
void random_code_damage(struct random *random, char *text, size_t size);
/* Puts another word, number or operator in the place of one: what comes of it often does. */
void random_code_swap(struct random *random, char *text, size_t size);

#endif
