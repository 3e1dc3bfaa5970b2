/* SPDX-License-Identifier: MIT */
/* Modifiers: mod_ changes a distance, dom_ changes the point that the children see. The numbers of
 * dom_ functions are computed in C (renderer/sdf/ tells how, and why bounds hold). */

#include "shapes.glsl"

/* Grows outwards. */
float mod_round(float d, float radius)
{
    return d - radius;
}

/* A wall on both sides of the surface. */
float mod_shell(float d, float thickness)
{
    return abs(d) - thickness;
}

/* Shows the positive side on both sides; axes are 0 or 1. */
vec3 dom_mirror(vec3 p, vec4 axes)
{
    return mix(p, abs(p), axes.xyz);
}

/* Repetition: the first cell that may hold the nearest copy. */
vec3 dom_repeat_first(vec3 p, vec4 spacing, vec4 limit, vec4 centre, vec4 reach)
{
    vec3 half_cell = fract(limit.xyz);
    vec3 x = (p - centre.xyz) / spacing.xyz - half_cell + 0.5;
    return clamp(floor(x - reach.xyz) + half_cell, -limit.xyz, limit.xyz);
}

/* Repetition: the last such cell. */
vec3 dom_repeat_last(vec3 p, vec4 spacing, vec4 limit, vec4 centre, vec4 reach)
{
    vec3 half_cell = fract(limit.xyz);
    vec3 x = (p - centre.xyz) / spacing.xyz - half_cell + 0.5;
    return clamp(floor(x + reach.xyz) + half_cell, -limit.xyz, limit.xyz);
}

/* Repetition: the point in a cell. */
vec3 dom_repeat_cell(vec3 p, vec3 cell, vec4 spacing, vec4 limit, vec4 centre, vec4 reach)
{
    return p - spacing.xyz * cell;
}

/* The middle of the cells that may hold the nearest copy around Y. */
float polar_middle(vec3 p, vec4 polar)
{
    float phi = p.x == 0.0 && p.z == 0.0 ? 0.0 : atan(p.z, p.x);
    return (phi - polar.z) / polar.y + 0.5;
}

/* Repetition around Y: the first cell that may hold the nearest copy; (radius, angle from copy to
 * copy, middle of the child's angle, reach), (copies, slack, 1 / (1 + slack), scale). */
vec3 dom_repeat_polar_first(vec3 p, vec4 polar, vec4 more)
{
    return vec3(floor(polar_middle(p, polar) - polar.w), 0.0, 0.0);
}

/* Repetition around Y: the last such cell. */
vec3 dom_repeat_polar_last(vec3 p, vec4 polar, vec4 more)
{
    float middle = polar_middle(p, polar);
    float last = min(floor(middle + polar.w), floor(middle - polar.w) + more.x - 1.0);
    return vec3(last, 0.0, 0.0);
}

/* Repetition around Y: the point in a cell. */
vec3 dom_repeat_polar_cell(vec3 p, vec3 cell, vec4 polar, vec4 more)
{
    float c = cos(polar.y * cell.x), s = sin(polar.y * cell.x);
    return vec3(c * p.x + s * p.z - polar.x, p.y, c * p.z - s * p.x);
}

/* Repetition around Y: a bound where not all copies are looked at. */
float dom_repeat_polar_after(float d, vec3 p, vec4 polar, vec4 more)
{
    return (d - length(p.xz) * more.y * more.w) * more.z;
}

/* How many cells there are from first to last. */
float cell_count(vec3 first, vec3 last)
{
    vec3 n = last - first + 1.0;
    return floor(n.x * n.y * n.z + 0.5);
}

/* The cell after this one: X runs fastest. */
vec3 cell_next(vec3 cell, vec3 first, vec3 last)
{
    cell.x += 1.0;
    if (cell.x > last.x) {
        cell.x = first.x;
        cell.y += 1.0;
    }
    if (cell.y > last.y) {
        cell.y = first.y;
        cell.z += 1.0;
    }
    return cell;
}

/* The point before the middle was pulled apart: (size, scale). */
vec3 dom_elongate(vec3 p, vec4 elongate)
{
    return p - clamp(p, -elongate.xyz, elongate.xyz);
}

/* Adds the way to the faces of the block in the middle, where that is inside. */
float dom_elongate_after(float d, vec3 p, vec4 elongate)
{
    vec3 face = abs(p) - elongate.xyz;
    return d < 0.0 ? d + min(max(face.x, max(face.y, face.z)), 0.0) * elongate.w : d;
}

/* The section's point: all of them are at z = 0. */
vec3 dom_extrude(vec3 p, vec4 extrude)
{
    return vec3(p.xy, 0.0);
}

/* Ends the section's prism: (half height, scale, rounding times scale). */
float dom_extrude_after(float d, vec3 p, vec4 extrude)
{
    float along = (abs(p.z) - extrude.x) * extrude.y;
    return corner(d + extrude.z, along + extrude.z) - extrude.z;
}

/* The section's point, which goes around Y: (offset). */
vec3 dom_revolve(vec3 p, vec4 revolve)
{
    return vec3(length(p.xz) - revolve.x, p.y, 0.0);
}
