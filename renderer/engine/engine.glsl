/* SPDX-License-Identifier: MIT */
/* What the engine runs for a vector of samples: functions of the shaders, from camera to pixel. */

#define USER_SHADERS 1
#define VOLUMES 1

#include "environment.glsl"
#include "field_surface.glsl"
#include "kernels.glsl"
#include "mixture.glsl"
#include "outputs.glsl"
#include "pixel.glsl"
#include "sample.glsl"
#include "starts.glsl"

/* Where the materials lie among the numbers. */
layout(binding = BINDING_PARAMS) uniform Scene {
    int material_base;
    int material_stride;
} scene;

#include "materials.glsl"
#include "mixing.glsl"

int material_place(float slot)
{
    return scene.material_base + scene.material_stride * int(slot);
}

float id_bits(Met m)
{
    return uintBitsToFloat(m.surface.id);
}
