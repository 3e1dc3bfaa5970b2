/* SPDX-License-Identifier: MIT */
/* What a mixture is made of. */

#include "mixture.glsl"
#include "params.glsl"

/* The first number of the material in a slot. */
int material_place(float slot);

#ifdef USER_SHADERS
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
#endif

void mix_materials(Mixture m, Shading at, out Surface s)
{
    s = surface_begin(m);
    for (int left = 4; left > 0 && m.shares.x > 0.0; left--) {
        int i = material_place(m.slots.x);
        MaterialValues values = MaterialValues(P_ANY(i), P_ANY(i + 1), P_ANY(i + 2), P_ANY(i + 3),
                                               P_ANY(i + 4), P_ANY(i + 5));
#ifdef USER_SHADERS
        if (values.emission.w > 0.0) {
            at.object_position = m.place_x;
            apply_shader(at, i, values);
        }
#endif
        surface_add(s, m, values);
        mixture_next(m);
    }
}
