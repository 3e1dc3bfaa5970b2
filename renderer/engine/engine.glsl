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

/* What a shader says of a point, with the numbers of the material at vec4 `material`: 1: its
 * colour; 2: all of a surface; 0: nothing. */
int ask_shader(int shader, int material, Shading at, out vec4 color, out CodeSurface s);

void apply_shader(Shading at, int material, inout MaterialValues values)
{
    bool unlit = values.ambient.w > 0.5;
    vec4 color = vec4(0.0);
    CodeSurface s;
    int says = ask_shader(int(values.emission.w), material, at, color, s);
    if (says == 2) {
        material_set_surface(values, code_surface(s), unlit);
    } else if (says == 1) {
        material_set_color(values, code_color(color).rgb, unlit);
    }
}

/* What the mixture is made of. */
void mix_materials(Mixture m, Shading at, out Surface s)
{
    s = surface_begin(m);
    while (m.shares.x > 0.0) {
        int i = scene.material_base + scene.material_stride * int(m.slots.x);
        MaterialValues values = MaterialValues(P_ANY(i), P_ANY(i + 1), P_ANY(i + 2), P_ANY(i + 3),
                                               P_ANY(i + 4), P_ANY(i + 5));
        if (values.emission.w > 0.0) {
            at.object_position = m.place_x;
            apply_shader(at, i, values);
        }
        surface_add(s, m, values);
        mixture_next(m);
    }
}

float id_bits(Met m)
{
    return uintBitsToFloat(m.surface.id);
}

Mixture mixed(float d, float share, Mixture a, Mixture b)
{
    return blend(d, share, a, b);
}

/* Both sides of an operation that never mixes. */
Mixture chosen(float d, float share, Mixture a, Mixture b)
{
    Mixture m = a;
    if (share > 0.5) {
        m = b;
    }
    m.d = d;
    return m;
}

/* Of a shape with this point in its space. */
Mixture alone(float d, float leaf, float slot, vec3 place)
{
    return mixture(vec3(d, leaf, slot), place);
}
