/* SPDX-License-Identifier: MIT */
/* What the text of a field calls (renderer/field/shader.c). */

#include "code.glsl"
#include "field_mask.glsl"
#include "flat.glsl"
#include "fractals.glsl"
#include "guard.glsl"
#include "modifiers.glsl"
#include "operations.glsl"
#include "patches.glsl"
#include "polynomial.glsl"
#include "shapes.glsl"
#include "solids.glsl"
#include "user.glsl"
#include "warps.glsl"
