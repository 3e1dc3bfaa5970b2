/* SPDX-License-Identifier: MIT */
/* What a struct code is. Private to this folder. */
#ifndef RENDERER_CODE_INTERNAL_H
#define RENDERER_CODE_INTERNAL_H

#include "machine.h"

struct code {
    struct tree tree;
    struct machine_code machine;
    enum code_use use;
};

/* What stands for a distance that is none, and the greatest colour: as in glsl/code.glsl. */
#define CODE_FAR 1e9
#define CODE_BRIGHT 65504.0

#endif
