/* SPDX-License-Identifier: MIT */
/* What a point of a field's surface is, by its tapes. */

#include "materials.glsl"
#include "tapes_run.glsl"

int material_place(float slot)
{
    uvec4 head = TAPE_TEXEL(0);
    return int(head.z) + int(head.w) * int(slot);
}

void surface(vec3 p, Shading at, out Surface s)
{
    Mixture m;
    Cube cube = cube_at(p, false, tapes_unit());
    run(int(cube.row.y), int(cube.row.z), p, true, m);
    mix_materials(m, at, s);
}
