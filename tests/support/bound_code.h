/* SPDX-License-Identifier: MIT */
/* Users' code that is as large as may be, out of statements by chance: what a driver is slow at. */
#ifndef TESTS_SUPPORT_BOUND_CODE_H
#define TESTS_SUPPORT_BOUND_CODE_H

#include "random_scene.h"
#include "renderer/code/code.h"

/* Kinds of statements that there are. */
size_t bound_code_kinds(void);
const char *bound_code_kind(size_t kind);

/* A text of as many statements as code_compile accepts, times `share`. `kind`: all of this kind,
 * on the same variables, each out of the one before; -1: of few kinds, nested in blocks, branches,
 * loops and functions, all by chance. Caller frees. */
char *bound_code_make(struct random *random, enum code_use use, int kind, double share);

#endif
